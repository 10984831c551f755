//! A textured box before a textured wall, moving sideways while a set's frames are taken: the scene of the rivals against lateral motion.
//!
//! The simulator's scene is traced at every frame's start, four by four rays a pixel, so that pixels at an edge see both surfaces; light,
//! waveform, noise and converter are the simulator's. Nothing blurs during a frame.

use super::image::Image;
use crate::frames::Geometry;
use crate::paper::camera::{Method, read};
use crate::paper::linearity::SEED;
use crate::physics::{Correlation, Draws, FREQUENCY_HZ, Object, Scene, Sensor, Shape, Surface};
use crate::units::phase_rad;
use std::f64::consts::TAU;

/// The middle of the camera's sensor, behind the camera's lens.
const GEOMETRY: Geometry = Geometry { width: 96, height: 64 };
/// Rays a pixel, along columns and rows.
const RAYS: usize = 4;
/// The front of the box, m, and half its width and height. No face lies where one check ends and the next begins.
const FRONT_M: f64 = 2.0;
const HALF_M: [f64; 2] = [0.32, 0.2];
const DEPTH_M: f64 = 0.3;
/// Edges of the checks, m, and reflectivities of the brighter ones, of the box and of the wall.
const CHECKS_M: [f64; 2] = [0.2, 0.3];
const REFLECTIVITIES: [f64; 2] = [0.45, 0.8];
/// Distances of the wall, m: one each for a run to the right and one to the left.
const WALLS_M: [f64; 4] = [2.6, 3.0, 3.4, 3.8];
/// Runs at a velocity.
pub const RUNS: usize = 2 * WALLS_M.len();
/// Pixels from an edge, along the row, within which errors count.
const NEAR: usize = 8;
const STREAM: u64 = 1 << 16;

/// A set of frames of the scene, and what is true of it.
#[derive(Debug, Clone)]
pub struct Take {
    /// What is measured with, DN above the pedestal, one image a frame.
    pub frames_dn: Vec<Image>,
    /// Sums of both taps, DN: the intensity, without the phase.
    pub sums_dn: Vec<Image>,
    /// The true range at the set's middle, m, of what the pixel's centre sees.
    pub true_m: Vec<f64>,
    /// Whether box and wall meet within eight pixels along the row, in the set's middle.
    pub near: Vec<bool>,
    /// The true motion at the set's middle, columns and rows a frame.
    pub motion: [Image; 2],
    /// Which object each pixel's centre sees at the start of each frame: 0 the box, 1 the wall.
    pub seen: Vec<Vec<usize>>,
}

/// The scene of run `run`: the box's middle is on the axis, or a part of a pixel beside it, at time 0.
fn scene(run: usize, velocity_m_s: f64) -> Scene {
    let wall_m = WALLS_M[run % WALLS_M.len()];
    let sign = if run < WALLS_M.len() { 1.0 } else { -1.0 };
    let beside_m = run as f64 / RUNS as f64 * FRONT_M / Sensor::vuris().focal_length_px;
    let object = |shape, number: usize, velocity_m_s| Object {
        shape,
        reflectivity: REFLECTIVITIES[number],
        check_m: Some(CHECKS_M[number]),
        velocity_m_s,
    };
    let moving = Shape::Box {
        low_m: [beside_m - HALF_M[0], -HALF_M[1], FRONT_M],
        high_m: [beside_m + HALF_M[0], HALF_M[1], FRONT_M + DEPTH_M],
    };
    let still =
        Shape::Panel { centre_m: [0.0, 0.0, wall_m], half_edges_m: [[9.0, 0.0, 0.0], [0.0, 9.0, 0.0]] };
    Scene { objects: vec![object(moving, 0, [sign * velocity_m_s, 0.0, 0.0]), object(still, 1, [0.0; 3])] }
}

/// What `taps` of a pixel collect at `time_s`, DN above the pedestal: the sensor's own modulation turned by these angles, rad.
fn exposed_dn(scene: &Scene, correlation: &Correlation, time_s: f64, taps_rad: [f64; 2]) -> [Vec<f64>; 2] {
    let sensor = Sensor::vuris();
    let fine = Geometry { width: RAYS * GEOMETRY.width, height: RAYS * GEOMETRY.height };
    let rays = scene.view(fine, RAYS as f64 * sensor.focal_length_px, time_s);
    let share = 1.0 / ((RAYS * RAYS) as f64 * sensor.gain_e_per_dn);
    let mut taps_dn = [vec![0.0; GEOMETRY.pixels()], vec![0.0; GEOMETRY.pixels()]];
    for (ray, surface) in rays.into_iter().enumerate() {
        let (row, column) = fine.row_column(ray);
        let pixel = row / RAYS * GEOMETRY.width + column / RAYS;
        let light = sensor.light(surface);
        let phase_rad = surface.map_or(0.0, |seen: Surface| phase_rad(seen.range_m, FREQUENCY_HZ));
        for (tap_dn, angle_rad) in taps_dn.iter_mut().zip(taps_rad) {
            let charge_e = light.amplitude_e * correlation.at(angle_rad - phase_rad) + light.offset_e;
            tap_dn[pixel] += share * charge_e;
        }
    }
    taps_dn
}

/// Run `run` (below [`RUNS`]) at `velocity_m_s`, by the steps and the frame period of `method`; without noise where `noisy` is not set.
pub fn take(method: &Method, correlation: &Correlation, velocity_m_s: f64, run: usize, noisy: bool) -> Take {
    let scene = scene(run, velocity_m_s);
    let middle = (method.steps_rad.len() as f64 - 1.0) / 2.0;
    let start_s = |frame: usize| (frame as f64 - middle) * method.frame_period_s();
    let focal_length_px = Sensor::vuris().focal_length_px;
    // The same noise for every velocity: what differs is not the draw.
    let mut draws = Draws::of(SEED, STREAM + run as u64);
    let image = |values: Vec<f64>| Image { geometry: GEOMETRY, values };
    let (mut frames_dn, mut sums_dn, mut seen) = (Vec::new(), Vec::new(), Vec::new());
    let objects = |time_s| -> Vec<usize> {
        let view = scene.view(GEOMETRY, focal_length_px, time_s);
        view.iter().map(|surface| surface.map_or(1, |surface| surface.object)).collect()
    };
    for (frame, step_rad) in method.steps_rad.iter().enumerate() {
        let taps_dn = exposed_dn(&scene, correlation, start_s(frame), [*step_rad, step_rad + TAU / 2.0]);
        let [own, other] = match noisy {
            true => taps_dn.map(|tap_dn| read(&tap_dn, 1, &mut draws)),
            false => taps_dn,
        };
        sums_dn.push(image(own.iter().zip(&other).map(|(own, other)| own + other).collect()));
        frames_dn.push(image(own));
        seen.push(objects(start_s(frame)));
    }
    let view = scene.view(GEOMETRY, focal_length_px, 0.0);
    let true_m = view.iter().map(|surface| surface.map_or(f64::NAN, |surface| surface.range_m)).collect();
    let between = objects(0.0);
    let near = |pixel: usize| {
        let (row, column) = GEOMETRY.row_column(pixel);
        let columns = column.saturating_sub(NEAR)..(column + NEAR + 1).min(GEOMETRY.width);
        columns.into_iter().any(|other| between[row * GEOMETRY.width + other] != between[pixel])
    };
    let across = |column: usize, row: usize| {
        let object = &scene.objects[between[row * GEOMETRY.width + column]];
        focal_length_px * object.velocity_m_s[0] * method.frame_period_s() / FRONT_M
    };
    Take {
        frames_dn,
        sums_dn,
        true_m,
        near: (0..GEOMETRY.pixels()).map(near).collect(),
        motion: [Image::of(GEOMETRY, across), Image::of(GEOMETRY, |_, _| 0.0)],
        seen,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pixel that sees the box in two frames and the wall in two has, for a sine, the phase of these four numbers by the textbook's
    /// formula: atan2(I1 − I3, I0 − I2), with I_n = A cos(n π/2 − φ) + B of whichever surface it saw.
    #[test]
    fn a_pixel_that_is_crossed_mixes_the_frames_of_two_surfaces() {
        let [four, _] = Method::both().unwrap();
        let take = take(&four, &Correlation::sinusoidal(), 2.0, 0, false);
        let still =
            |frame: usize| super::take(&four, &Correlation::sinusoidal(), 0.0, 0, false).seen[frame].clone();
        assert_eq!(still(0), still(3));
        // A wall of 2.6 m and a front of 2 m, in turns of 4.9965 m; amplitudes 0.8 / 2.6² and 0.45 / 2² of 10 000 DN, or half of it
        // on a dark check.
        let crossed = |pixel: &usize| {
            let seen: Vec<usize> = take.seen.iter().map(|seen| seen[*pixel]).collect();
            // Where the leading edge's whole pixels are: the middle row, a few pixels of either surface beside it.
            seen == [1, 1, 0, 0] && take.near[*pixel] && (24..40).contains(&(pixel / GEOMETRY.width))
        };
        let found: Vec<usize> = (0..GEOMETRY.pixels()).filter(crossed).collect();
        assert!(found.len() > 16, "{}", found.len());
        let mut furthest_m: f64 = 0.0;
        for pixel in found {
            let frames: Vec<f64> = take.frames_dn.iter().map(|frame| frame.values[pixel]).collect();
            let by_formula = (frames[1] - frames[3]).atan2(frames[0] - frames[2]);
            assert!((by_formula - four.algorithm.vector(&frames).arg()).abs() < 1e-9);
            furthest_m = furthest_m.max(four.error_m(&frames, take.true_m[pixel], FREQUENCY_HZ).abs());
        }
        // Not within what lies between the surfaces, 0.6 m.
        assert!(furthest_m > 0.3, "{furthest_m}");
    }

    /// 2 m/s at 2 m behind 140 pixels are 4.375 columns a frame of 31.25 ms.
    #[test]
    fn the_true_motion_is_the_boxs() {
        let [four, _] = Method::both().unwrap();
        let take = take(&four, &Correlation::sinusoidal(), 2.0, RUNS - 1, false);
        let pixel = GEOMETRY.width * 32 + 48;
        assert!((take.motion[0].values[pixel] + 4.375).abs() < 1e-9, "{}", take.motion[0].values[pixel]);
        assert_eq!((take.motion[0].values[0], take.near[0], take.near[pixel]), (0.0, false, false));
        let sees_box = |frame: usize| take.seen[frame].iter().filter(|object| **object == 0).count() as f64;
        assert!((sees_box(0) / sees_box(3) - 1.0).abs() < 0.1);
    }
}
