//! What the camera looks at: objects, their reflectivity, their motion.

use super::shape::{Shape, Vector};
use crate::frames::Geometry;

/// One object: a shape with a reflectivity, moving or still.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Where it is at time 0.
    pub shape: Shape,
    /// Diffuse (Lambertian) reflectivity at the modulated light's wavelength, 0 to 1.
    pub reflectivity: f64,
    /// Edge of the checks in m, on which the reflectivity is halved; `None`: plain.
    pub check_m: Option<f64>,
    /// Velocity in m/s: to the right, down, away from the camera.
    pub velocity_m_s: Vector,
}

/// All objects; the nearest is seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The objects, in any order.
    pub objects: Vec<Object>,
}

/// What one pixel sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Index of the object in [`Scene::objects`].
    pub object: usize,
    /// Radial range from the pinhole, m, > 0.
    pub range_m: f64,
    /// Apparent reflectivity towards a light beside the camera: the object's, times the cosine of incidence (Lambert).
    pub reflectivity: f64,
}

impl Scene {
    /// A room for a camera of about 60° × 46°, ranges from about 1.6 to 4.4 m: a checked back wall, a floor, a
    /// slanted panel, a box and a sphere, all still, and a box in front that approaches at 1 m/s.
    ///
    /// Ranges stay below the 5 m that 30 MHz can tell apart, and cover more than two of the four-frame error's four cycles.
    /// The moving box faces the camera as a target on a rail does. At 25 ms a frame its four-frame error is a typical one:
    /// 30 mm RMS, as over all distances from 1 to 4.5 m (it is 40 mm at the worst of them).
    pub fn room() -> Self {
        let still =
            |shape, reflectivity| Object { shape, reflectivity, check_m: None, velocity_m_s: [0.0; 3] };
        let panel = |centre_m, u, v| Shape::Panel { centre_m, half_edges_m: [u, v] };
        let wall = panel([0.0, 0.0, 3.6], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]);
        let floor = panel([0.0, 1.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, 2.0]);
        let slanted = panel([-1.15, -0.7, 2.75], [0.4, 0.0, 0.55], [0.0, 0.42, 0.0]);
        let approaching = Shape::Box { low_m: [-0.4, -0.55, 1.9], high_m: [0.55, 0.2, 2.2] };
        Self {
            objects: vec![
                Object { check_m: Some(0.45), ..still(wall, 0.8) },
                still(floor, 0.7),
                still(slanted, 0.6),
                still(Shape::Box { low_m: [0.75, 0.35, 2.45], high_m: [1.2, 1.0, 2.9] }, 0.5),
                still(Shape::Sphere { centre_m: [-0.95, 0.58, 2.6], radius_m: 0.4 }, 0.5),
                Object { velocity_m_s: [0.0, 0.0, -1.0], ..still(approaching, 0.45) },
            ],
        }
    }

    /// A plain, still wall of reflectivity 1 across the axis at `distance_m` (> 0).
    pub fn wall(distance_m: f64) -> Self {
        let half_m = 100.0 * distance_m;
        let shape = Shape::Panel {
            centre_m: [0.0, 0.0, distance_m],
            half_edges_m: [[half_m, 0.0, 0.0], [0.0, half_m, 0.0]],
        };
        Self { objects: vec![Object { shape, reflectivity: 1.0, check_m: None, velocity_m_s: [0.0; 3] }] }
    }

    /// What every pixel sees at `time_s`, `[row, column]`; `None` where no object is.
    ///
    /// A pinhole of `focal_length_px` pixels (> 0) before the middle of the sensor; a pixel sees one point, its centre's.
    pub fn view(&self, geometry: Geometry, focal_length_px: f64, time_s: f64) -> Vec<Option<Surface>> {
        let centre = |count: usize| (count as f64 - 1.0) / 2.0;
        (0..geometry.pixels())
            .map(|pixel| {
                let (row, column) = geometry.row_column(pixel);
                let x = (column as f64 - centre(geometry.width)) / focal_length_px;
                let y = (row as f64 - centre(geometry.height)) / focal_length_px;
                let length = (x * x + y * y + 1.0).sqrt();
                self.nearest([x / length, y / length, 1.0 / length], time_s)
            })
            .collect()
    }

    fn nearest(&self, direction: Vector, time_s: f64) -> Option<Surface> {
        let seen = self.objects.iter().enumerate().filter_map(|(index, object)| {
            // An object that moves is a camera that moves the other way.
            let hit = object.shape.hit(object.velocity_m_s.map(|m_s| -m_s * time_s), direction)?;
            let reflectivity = object.reflectivity_at(hit.point_m) * hit.incidence_cosine;
            Some(Surface { object: index, range_m: hit.range_m, reflectivity })
        });
        seen.min_by(|a, b| a.range_m.total_cmp(&b.range_m))
    }
}

impl Object {
    /// The reflectivity at a point in the object's own coordinates, before Lambert's cosine.
    fn reflectivity_at(&self, point_m: Vector) -> f64 {
        let dark = self.check_m.is_some_and(|edge_m| {
            // Half an edge off, so that no face along the axes lies on a boundary between checks.
            let check = |coordinate_m: f64| (coordinate_m / edge_m + 0.5).floor();
            let parity = point_m.into_iter().map(check).sum::<f64>().rem_euclid(2.0);
            parity > 0.5
        });
        if dark { self.reflectivity / 2.0 } else { self.reflectivity }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GEOMETRY: Geometry = Geometry { width: 160, height: 120 };

    #[test]
    fn every_pixel_of_the_room_sees_something_within_the_unambiguous_range() {
        let view = Scene::room().view(GEOMETRY, 140.0, 0.0);
        let ranges: Vec<f64> = view.iter().map(|surface| surface.unwrap().range_m).collect();
        assert!(ranges.iter().all(|range_m| (1.5..4.5).contains(range_m)));
        for object in 0..Scene::room().objects.len() {
            let pixels = view.iter().flatten().filter(|surface| surface.object == object).count();
            assert!(pixels > 300, "object {object} has {pixels} pixels");
        }
    }

    /// The recording format's radial distance = position · √(1 + (x² + y²)/focal_length²).
    #[test]
    fn a_wall_is_farther_towards_the_corners() {
        let view = Scene::wall(2.0).view(GEOMETRY, 220.0, 0.0);
        let (x, y) = (79.5f64, 59.5f64);
        let expected_m = 2.0 * (1.0 + (x * x + y * y) / (220.0 * 220.0)).sqrt();
        assert!((view[0].unwrap().range_m - expected_m).abs() < 1e-12);
    }

    #[test]
    fn an_object_moves_with_its_velocity() {
        let mut scene = Scene::wall(2.0);
        scene.objects[0].velocity_m_s[2] = -0.5;
        let pixel = Geometry { width: 1, height: 1 };
        let at = |time_s| scene.view(pixel, 1.0, time_s)[0].unwrap().range_m;
        assert_eq!((at(0.0), at(1.0)), (2.0, 1.5));
    }

    /// A box whose right edge is on the axis at time 0 moves to the right by a pixel of the front face's: f v t / z.
    #[test]
    fn an_object_moves_sideways_with_its_texture() {
        let shape = Shape::Box { low_m: [-1.0, -1.0, 2.0], high_m: [0.0, 1.0, 2.1] };
        let object = Object { shape, reflectivity: 1.0, check_m: Some(0.2), velocity_m_s: [0.1, 0.0, 0.0] };
        let scene = Scene { objects: vec![object] };
        let row = Geometry { width: 21, height: 1 };
        let seen = |time_s| scene.view(row, 200.0, time_s).iter().map(Option::is_some).collect::<Vec<_>>();
        let columns = |time_s| seen(time_s).iter().filter(|sees| **sees).count();
        // Column 10 is on the axis, where the edge is.
        assert_eq!((columns(0.001), columns(0.101), columns(0.501)), (11, 12, 16));
        let grey = |time_s: f64, column: usize| {
            let surface = scene.view(row, 200.0, time_s)[column].unwrap();
            // Without Lambert's cosine, 2 / range.
            surface.reflectivity * surface.range_m / 2.0
        };
        for column in 0..10 {
            assert!((grey(0.005, column) - grey(0.105, column + 1)).abs() < 1e-12, "{column}");
        }
    }
}
