//! The order of the phase steps against motion, and the table of rivals against motion.

use super::binning::binned_rms_m;
use super::neighbours::{GRAIN, at_once_rms_m, texture_rms_m};
use crate::paper::camera::{Camera, Conditions, Method, Set};
use crate::paper::figure::{Table, mm};
use crate::paper::figure_07::with_falloff;
use crate::paper::motion::VELOCITY_M_S;
use crate::paper::residual::{rms, without_mean};
use crate::physics::FREQUENCY_HZ;
use crate::units::{phase_rad, range_m, wrap_rad};
use std::f64::consts::TAU;

const OFFSETS: u32 = 60;
const START_M: f64 = 2.0;

/// Every order of `count` steps.
pub fn orders(count: usize) -> Vec<Vec<usize>> {
    match count {
        0 => vec![Vec::new()],
        _ => {
            let shorter = orders(count - 1);
            let with_last = |order: &Vec<usize>| {
                let at = |place| [&order[..place], &[count - 1], &order[place..]].concat();
                (0..=order.len()).map(at).collect::<Vec<_>>()
            };
            shorter.iter().flat_map(with_last).collect()
        }
    }
}

/// RMS motion error, m, about its mean over a turn of phase offsets, at 2 m/s from 2 m on, static error subtracted: step `order[n]` is
/// taken n frames after the start.
pub fn ordered_rms_m(method: &Method, conditions: Conditions, order: &[usize]) -> f64 {
    let camera = Camera::new(conditions);
    let mut starts_s = vec![0.0; order.len()];
    for (frame, step) in order.iter().enumerate() {
        starts_s[*step] = frame as f64 * method.frame_period_s();
    }
    let error = |n: u32| {
        let offset_rad = TAU * f64::from(n) / f64::from(OFFSETS);
        let moving =
            Set { offset_rad, starts_s: starts_s.clone(), ..Set::moving(method, START_M, VELOCITY_M_S) };
        let still = Set { velocity_m_s: 0.0, ..moving.clone() };
        let apart_m = camera.error_m(method, &moving) - camera.error_m(method, &still);
        // Within half the unambiguous range.
        range_m(wrap_rad(phase_rad(apart_m, FREQUENCY_HZ)), FREQUENCY_HZ)
    };
    rms(&without_mean(&(0..OFFSETS).map(error).collect::<Vec<_>>()))
}

/// Orders whose errors differ by less, m, are as good as each other: the first of them stands for all.
const AS_GOOD_M: f64 = 1e-6;

/// The order with the least error of all.
fn best(method: &Method, conditions: &Conditions) -> Vec<usize> {
    let mut all = orders(method.steps_rad.len());
    all.sort();
    let mut best = (Vec::new(), f64::INFINITY);
    for order in all {
        let rms_m = ordered_rms_m(method, conditions.clone(), &order);
        if rms_m < best.1 - AS_GOOD_M {
            best = (order, rms_m);
        }
    }
    best.0
}

/// The table.
pub fn table(methods: &[Method; 2]) -> Table {
    let (plain, falloff) = (Conditions::table_1(), with_falloff(1.0));
    let row = |what: String, method: &Method, order: &[usize]| {
        let rms_m = |conditions: &Conditions| mm(ordered_rms_m(method, conditions.clone(), order));
        vec![what, rms_m(&plain), rms_m(&falloff), mm(binned_rms_m(method, 1))]
    };
    let mut rows = Vec::new();
    for method in methods {
        let usual: Vec<usize> = (0..method.steps_rad.len()).collect();
        let found = [(&plain, "without falloff"), (&falloff, "with falloff")]
            .map(|(conditions, what)| (best(method, conditions), what));
        rows.push(row(format!("{}, usual order", method.name), method, &usual));
        for (order, what) in found {
            rows.push(row(format!("{}, the best {what}: {order:?}", method.name), method, &order));
        }
    }
    let four = &methods[0];
    let usual = ordered_rms_m(four, plain.clone(), &[0, 1, 2, 3]);
    let usual_falloff = ordered_rms_m(four, falloff.clone(), &[0, 1, 2, 3]);
    let binned = mm(binned_rms_m(four, 4));
    rows.push(vec!["four frames, 2 x 2 binning".to_owned(), mm(usual), mm(usual_falloff), binned.clone()]);
    let [once, once_falloff] = [plain, falloff].map(|conditions| mm(at_once_rms_m(four, conditions)));
    let texture = format!("{} by texture", mm(texture_rms_m(four)));
    rows.push(vec!["four phases at once in neighbouring pixels".to_owned(), once, once_falloff, texture]);
    Table {
        name: "rivals-motion",
        title: "Rivals against motion error: 2 m/s, 125 ms, RMS over all phases",
        head: ["what", "without falloff, mm", "with falloff, mm", "still target, random, mm"].map(str::to_owned).to_vec(),
        rows,
        notes: vec![
            "Assumed: Table I with phases 0, start at 2 m, constant part of the light equal to the modulated one where it falls off, noise of the \
             simulator's camera. An order [0, 2, 1, 3] takes the third step second."
                .to_owned(),
            format!(
                "Four phases at once have no motion error, and an error by what differs between the four pixels: reflectivities of a standard deviation \
                 of {:.0} % (assumed). Edges are worse.",
                100.0 * GRAIN
            ),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_order_is_there_once() {
        let mut all = orders(5);
        all.sort();
        all.dedup();
        assert_eq!((all.len(), all[0].clone(), orders(1)), (120, vec![0, 1, 2, 3, 4], vec![vec![0]]));
    }
}
