//! The table of rivals against lateral motion: errors near the edges of a box that moves sideways.

use super::edges_2d::{crossed, replacements};
use super::image::Image;
use super::moving_edge::{RUNS, Take, take};
use super::optical_flow::{compensated, motion};
use crate::paper::camera::Method;
use crate::paper::figure::{Table, mm};
use crate::paper::residual::rms;
use crate::physics::{Correlation, FREQUENCY_HZ};
use rayon::prelude::*;

/// Velocities of the box, m/s.
pub const VELOCITIES_M_S: [f64; 4] = [0.0, 0.5, 1.0, 2.0];
/// The velocity whose shares the table has.
const SHARES_AT: usize = 2;
/// An error of more, m, is a wrong distance.
const WRONG_M: f64 = 0.1;

/// What is done against lateral motion.
#[derive(Debug)]
pub struct Remedy {
    /// Its name in the table.
    pub name: &'static str,
    /// Errors of the range, m, one a pixel; `None` where it gives none.
    pub errors_m: fn(&Method, &Take) -> Vec<Option<f64>>,
}

/// All, nothing at all among them.
pub const REMEDIES: [Remedy; 6] = [
    Remedy {
        name: "plain",
        errors_m: |method, take| errors_m(method, take, |pixel| frames_at(&take.frames_dn, pixel)),
    },
    Remedy { name: "optical flow", errors_m: |method, take| along(method, take, &motion(&take.sums_dn)) },
    Remedy {
        name: "the true motion, for optical flow",
        errors_m: |method, take| along(method, take, &take.motion),
    },
    Remedy {
        name: "the same, carried four pixels beyond the box",
        errors_m: |method, take| along(method, take, &carried(&take.motion)),
    },
    Remedy { name: "2D edges, left out", errors_m: left_out },
    Remedy { name: "2D edges, replaced", errors_m: replaced },
];

/// How far the box's motion is carried: as far as a window of the estimate reaches.
const CARRIED: i64 = 4;

/// The motion of the box, of pixels beside it, too.
fn carried(motion: &[Image; 2]) -> [Image; 2] {
    let geometry = motion[0].geometry;
    let fastest = |column: usize, row: usize| {
        let beside = (-CARRIED..=CARRIED).map(|step| motion[0].at(column as i64 + step, row as i64));
        beside
            .fold(0.0, |fastest: f64, a_frame| if a_frame.abs() > fastest.abs() { a_frame } else { fastest })
    };
    [Image::of(geometry, fastest), motion[1].clone()]
}

/// A pixel's values in all frames.
fn frames_at(frames_dn: &[Image], pixel: usize) -> Vec<f64> {
    frames_dn.iter().map(|frame| frame.values[pixel]).collect()
}

fn errors_m(method: &Method, take: &Take, frames: impl Fn(usize) -> Vec<f64>) -> Vec<Option<f64>> {
    let error = |(pixel, true_m): (usize, &f64)| Some(method.error_m(&frames(pixel), *true_m, FREQUENCY_HZ));
    take.true_m.iter().enumerate().map(error).collect()
}

fn along(method: &Method, take: &Take, motion: &[Image; 2]) -> Vec<Option<f64>> {
    let frames_dn = compensated(&take.frames_dn, motion);
    errors_m(method, take, |pixel| frames_at(&frames_dn, pixel))
}

fn left_out(method: &Method, take: &Take) -> Vec<Option<f64>> {
    let all = errors_m(method, take, |pixel| frames_at(&take.frames_dn, pixel));
    all.into_iter().zip(crossed(&take.sums_dn)).map(|(error, crossed)| error.filter(|_| !crossed)).collect()
}

fn replaced(method: &Method, take: &Take) -> Vec<Option<f64>> {
    let nearest = replacements(&take.sums_dn[0], &crossed(&take.sums_dn));
    errors_m(method, take, |pixel| frames_at(&take.frames_dn, nearest[pixel].unwrap_or(pixel)))
}

/// Errors near the edges, of all runs at a velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// RMS where there is a distance, m.
    pub rms_m: f64,
    /// Share of the pixels whose distance is wrong by more than 0.1 m.
    pub wrong: f64,
    /// Share of the pixels without a distance.
    pub without: f64,
}

impl Near {
    fn of(errors_m: &[Option<f64>]) -> Self {
        let given: Vec<f64> = errors_m.iter().flatten().copied().collect();
        let share = |count: usize| count as f64 / errors_m.len() as f64;
        let wrong = given.iter().filter(|error_m| error_m.abs() > WRONG_M).count();
        Self { rms_m: rms(&given), wrong: share(wrong), without: share(errors_m.len() - given.len()) }
    }
}

/// What each of [`REMEDIES`] leaves near the edges at `velocity_m_s`, with noise.
pub fn near_edges(method: &Method, velocity_m_s: f64) -> Vec<Near> {
    let correlation = Correlation::measured();
    let of_run = |run: usize| {
        let take = take(method, &correlation, velocity_m_s, run, true);
        let near = |remedy: &Remedy| {
            let all = (remedy.errors_m)(method, &take).into_iter().zip(&take.near);
            all.filter(|(_, near)| **near).map(|(error_m, _)| error_m).collect::<Vec<_>>()
        };
        REMEDIES.iter().map(near).collect::<Vec<_>>()
    };
    let runs: Vec<Vec<Vec<Option<f64>>>> = (0..RUNS).into_par_iter().map(of_run).collect();
    let of = |remedy: usize| Near::of(&runs.iter().flat_map(|run| run[remedy].clone()).collect::<Vec<_>>());
    (0..REMEDIES.len()).map(of).collect()
}

/// The table.
pub fn table(methods: &[Method; 2]) -> Table {
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    let mut rows = Vec::new();
    for method in methods {
        let found = VELOCITIES_M_S.map(|velocity_m_s| near_edges(method, velocity_m_s));
        for (number, remedy) in REMEDIES.iter().enumerate() {
            let mut row = vec![format!("{}, {}", method.name, remedy.name)];
            row.extend(found.iter().map(|of_velocity| mm(of_velocity[number].rms_m)));
            let shares = found[SHARES_AT][number];
            row.extend([percent(shares.wrong), percent(shares.without)]);
            rows.push(row);
        }
    }
    let head = [
        "what",
        "still, mm",
        "0.5 m/s, mm",
        "1 m/s, mm",
        "2 m/s, mm",
        "1 m/s, off by more than 100 mm, %",
        "1 m/s, no distance, %",
    ];
    Table {
        name: "rivals-lateral",
        title: "Rivals against lateral motion: RMS error within eight pixels of a moving edge, 125 ms",
        head: head.map(str::to_owned).to_vec(),
        rows,
        notes: NOTES.map(str::to_owned).to_vec(),
    }
}

const NOTES: [&str; 4] = [
    "The scene is assumed: a box of 0.64 x 0.4 m with its front at 2 m moves sideways (1 m/s: 70 columns a second) before a still wall at \
     2.6, 3.0, 3.4 and 3.8 m, to the right and to the left, both with checks of 1 : 2; the simulator's camera, Table I with phases 0, noise. \
     True is what the pixel's centre sees at the set's middle; pixels at an edge see both surfaces, which is the error when all stands still.",
    "Optical flow: of the sums of both taps, which is assumed of the pixel (Lindner and Kolb 2009), by Lucas and Kanade's windows of 9 x 9 in \
     three sizes, constant within a set, in the middle's pixels; they took a variational flow. The next two rows have the true motion instead: with \
     the box's motion up to its edge, wall beside it is hidden in some frames; carried beyond the edge, it follows the box through all frames, and \
     finds wall in each. So a window that is too wide for the edge helps, where the wall is plain.",
    "2D edges: Lottner et al. 2007 is known here by its idea alone. The 2D camera is assumed to see what the sums of the taps show, in every \
     frame; Sobel's slope above a tenth of the mean is an edge; where it is in some frames and not in all, the distance is left out, or is the \
     nearest other pixel's. Gaps of up to four pixels \
     are closed. Checks that move count as edges, too, as they must: their distances are wrong.",
    "What this does not show: blur during a frame, other textures, and a velocity that changes within a set.",
];
