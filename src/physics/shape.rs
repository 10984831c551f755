//! Where a ray meets a shape: analytic intersections.

/// A point or a direction: x to the right, y down, z away from the camera; metres for points.
pub type Vector = [f64; 3];

/// A surface of the scene. The camera's pinhole is the origin.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A flat parallelogram, seen from both sides: centre and the two half edges (not parallel), m.
    Panel {
        /// Its centre.
        centre_m: Vector,
        /// From the centre to the middle of one edge.
        half_edges_m: [Vector; 2],
    },
    /// A sphere.
    Sphere {
        /// Its centre.
        centre_m: Vector,
        /// Its radius, > 0.
        radius_m: f64,
    },
    /// A box with edges along the axes: its least and its greatest corner, m.
    Box {
        /// Least x, y and z.
        low_m: Vector,
        /// Greatest x, y and z.
        high_m: Vector,
    },
}

/// Where a ray meets a shape first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Distance from the ray's origin, m, > 0.
    pub range_m: f64,
    /// The point, in the coordinates of the ray's origin.
    pub point_m: Vector,
    /// Cosine of the angle of incidence, 0 to 1.
    pub incidence_cosine: f64,
}

impl Shape {
    /// First intersection with the ray from `origin_m` along the unit vector `direction`.
    pub fn hit(&self, origin_m: Vector, direction: Vector) -> Option<Hit> {
        let (range_m, normal) = match self {
            Self::Panel { centre_m, half_edges_m: [u, v] } => {
                let normal = cross(*u, *v);
                let area_squared = dot(normal, normal);
                let range_m = dot(difference(*centre_m, origin_m), normal) / dot(direction, normal);
                let offset = difference(along(origin_m, direction, range_m), *centre_m);
                // Coordinates of the point in units of the half edges (Cramer's rule in the plane).
                let a = dot(cross(offset, *v), normal) / area_squared;
                let b = dot(cross(*u, offset), normal) / area_squared;
                (a.abs() <= 1.0 && b.abs() <= 1.0).then_some((range_m, normal))?
            }
            Self::Sphere { centre_m, radius_m } => {
                let to_centre = difference(*centre_m, origin_m);
                let nearest = dot(to_centre, direction);
                let chord_squared = radius_m * radius_m - dot(to_centre, to_centre) + nearest * nearest;
                // Negative where the ray passes by: a sphere's grazing ray has no stable normal, so it passes too.
                let range_m = (chord_squared > 0.0).then(|| nearest - chord_squared.sqrt())?;
                (range_m, difference(along(origin_m, direction, range_m), *centre_m))
            }
            Self::Box { low_m, high_m } => box_hit(*low_m, *high_m, origin_m, direction)?,
        };
        // Also refuses a NaN, from a ray parallel to a panel.
        (range_m > 0.0 && range_m.is_finite()).then(|| Hit {
            range_m,
            point_m: along(origin_m, direction, range_m),
            incidence_cosine: dot(direction, normal).abs() / dot(normal, normal).sqrt(),
        })
    }
}

/// Slab method (Kay and Kajiya 1986): the box is entered when the last of the three slabs is.
fn box_hit(low_m: Vector, high_m: Vector, origin_m: Vector, direction: Vector) -> Option<(f64, Vector)> {
    let (mut enter_m, mut leave_m, mut face) = (f64::NEG_INFINITY, f64::INFINITY, 0);
    for axis in 0..3 {
        let at = |bound: f64| (bound - origin_m[axis]) / direction[axis];
        let (a, b) = (at(low_m[axis]), at(high_m[axis]));
        if a.min(b) > enter_m {
            (enter_m, face) = (a.min(b), axis);
        }
        leave_m = leave_m.min(a.max(b));
    }
    let mut normal = [0.0; 3];
    normal[face] = 1.0;
    (enter_m <= leave_m).then_some((enter_m, normal))
}

fn along(origin_m: Vector, direction: Vector, range_m: f64) -> Vector {
    std::array::from_fn(|axis| origin_m[axis] + range_m * direction[axis])
}

fn difference(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const AHEAD: Vector = [0.0, 0.0, 1.0];

    #[test]
    fn a_ray_straight_ahead_meets_each_shape_where_it_begins() {
        let shapes = [
            Shape::Panel { centre_m: [0.0, 0.0, 2.0], half_edges_m: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] },
            Shape::Sphere { centre_m: [0.0, 0.0, 2.5], radius_m: 0.5 },
            Shape::Box { low_m: [-0.2, -0.3, 2.0], high_m: [0.4, 0.1, 3.0] },
        ];
        for shape in shapes {
            let hit = shape.hit([0.0; 3], AHEAD).unwrap();
            assert_eq!((hit.range_m, hit.incidence_cosine), (2.0, 1.0), "{shape:?}");
            assert_eq!(shape.hit([0.0, 2.0, 0.0], AHEAD), None, "{shape:?} is not that tall");
            assert_eq!(shape.hit([0.0, 0.0, 9.0], AHEAD), None, "{shape:?} is behind");
        }
    }

    #[test]
    fn a_tilted_panel_is_as_far_and_as_oblique_as_its_tilt_says() {
        // Normal along (1, 0, −1)/√2 through z = 2 on the axis.
        let panel =
            Shape::Panel { centre_m: [0.0, 0.0, 2.0], half_edges_m: [[1.0, 0.0, 1.0], [0.0, 1.0, 0.0]] };
        let hit = panel.hit([0.5, 0.0, 0.0], AHEAD).unwrap();
        assert!((hit.range_m - 2.5).abs() < 1e-15);
        assert!((hit.incidence_cosine - 0.5f64.sqrt()).abs() < 1e-15);
        assert_eq!(panel.hit([1.5, 0.0, 0.0], AHEAD), None);
        assert_eq!(panel.hit([0.0; 3], [0.0, 1.0, 0.0]), None, "parallel");
    }
}
