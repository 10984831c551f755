//! Table I, and figure 3: the spectrum of the correlation waveform, from 64 frames.

use super::camera::{Camera, Conditions, Set, read};
use super::figure::{Figure, Plot, Stroke, Table};
use super::linearity::SEED;
use crate::physics::{Draws, FREQUENCY_HZ};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Frames of a measurement.
const FRAMES: usize = 64;
/// Sets that are averaged: assumed.
const REPEATS: usize = 100;
const NOISE_STREAM: u64 = 4;
const STILL_M: f64 = 1.0;
/// What the paper measured: inverse of the amplitude relative to the fundamental's, harmonics 1 to 7.
pub const MEASURED: [f64; 7] = [1.0, 105.0, 31.0, 500.0, 1020.0, 926.0, 1449.0];

/// Amplitudes of the harmonics 0 to 31 relative to the fundamental's, from 64 frames; with noise or without.
pub fn spectrum(noise: bool) -> Vec<f64> {
    let steps_rad: Vec<f64> = (0..FRAMES).map(|n| TAU * n as f64 / FRAMES as f64).collect();
    let set = Set {
        range_m: STILL_M,
        velocity_m_s: 0.0,
        offset_rad: 0.0,
        frequency_hz: FREQUENCY_HZ,
        starts_s: vec![0.0; FRAMES],
    };
    let exact = Camera::new(Conditions::table_1()).frames_dn(&steps_rad, &set);
    let frames = if noise { read(&exact, REPEATS, &mut Draws::of(SEED, NOISE_STREAM)) } else { exact };
    let amplitude = |harmonic: usize| {
        let term = |(step, frame): (&f64, &f64)| Complex64::from_polar(*frame, -(harmonic as f64) * step);
        steps_rad.iter().zip(&frames).map(term).sum::<Complex64>().norm()
    };
    let fundamental = amplitude(1);
    // The constant part counts once in a sum, a cosine half.
    let share = |harmonic| if harmonic == 0 { 0.5 } else { 1.0 };
    (0..FRAMES / 2).map(|harmonic| share(harmonic) * amplitude(harmonic) / fundamental).collect()
}

/// Table I: the inverse of each relative amplitude, as 64 frames give it.
pub fn table() -> Table {
    let (exact, noisy) = (spectrum(false), spectrum(true));
    let row = |(measured, harmonic): (&f64, usize)| {
        let inverse = |spectrum: &[f64]| format!("{:.0}", 1.0 / spectrum[harmonic]);
        vec![harmonic.to_string(), format!("{measured:.0}"), inverse(&exact), inverse(&noisy)]
    };
    Table {
        name: "table-1",
        title: "Table I: inverse of each harmonic's amplitude relative to the fundamental's, from 64 simulated frames",
        head: ["harmonic", "paper", "without noise", "with noise"].map(str::to_owned).to_vec(),
        rows: MEASURED.iter().zip(1..).map(row).collect(),
        notes: vec![
            "Input and output are the same numbers here: what is tested is the measurement by 64 frames, not the waveform.".to_owned(),
            "Noise is assumed: that of the simulator's camera with the target at 1 m, 100 sets averaged. It shifts what is weak, up or down.".to_owned(),
        ],
    }
}

/// Figure 3.
pub fn figure_3() -> Figure {
    let points = spectrum(true).into_iter().zip(0u32..).skip(1).map(|(a, m)| (f64::from(m), a.log10()));
    Figure {
        number: 3,
        title: "Harmonics of the correlation waveform, from 64 frames",
        abscissa: "harmonic",
        ordinate: "log10 of the relative amplitude",
        plots: vec![Plot { stroke: Stroke::Bars, ..Plot::line("with noise", points.collect()) }],
        assumed: "Table I as the waveform; noise of the simulator's camera at 1 m, 100 sets averaged",
    }
}
