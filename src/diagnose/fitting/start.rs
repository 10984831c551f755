//! Where a fit starts: the pixels' own numbers by linear least squares.

use super::in_order::summed;
use super::own_phases::OwnPhases;
use super::split::{BACKGROUND_M, split_light};
use crate::bench::chain;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::columns::OWN;
use crate::physics::{AtFrequency, Chain, Memory, Pixels};
use nalgebra::{Matrix4, Vector4};
use std::sync::Arc;

fn pixels(data: &Data, numbers: [Vec<f64>; OWN], at_frequencies: Vec<AtFrequency>) -> Pixels {
    let geometry = data.geometry();
    let camera = &data.camera;
    let edges = Pixels::edges_of(geometry, &data.target);
    let edge_counts = Pixels::edge_counts_of(&edges);
    let [amplitude_1m_dn, phase_rad, constant_1m_dn, ambient_dn] = numbers;
    Pixels {
        geometry,
        target: data.target.clone(),
        obliquity: data.obliquities(),
        background_m: vec![BACKGROUND_M; geometry.pixels()],
        phase_rad,
        at_frequencies,
        amplitude_1m_dn,
        constant_1m_dn,
        ambient_dn: ambient_dn.into(),
        full_scale_dn: f64::from(camera.full_scale()) - camera.pedestal_dn,
        pedestal_dn: camera.pedestal_dn,
        edges,
        edge_counts,
    }
}

/// The pixels with their own numbers from a linear fit of the fundamental to the sets of which `counts` is true, without any effect.
pub fn linear(data: &Data, counts: &(dyn Fn(usize) -> bool + Sync)) -> Arc<Pixels> {
    let own_phases = OwnPhases::of(data, counts);
    let mut numbers = numbers(data, counts, &own_phases);
    fill(data, &mut numbers);
    numbers[1].iter_mut().for_each(|phase_rad| *phase_rad = own_phases.beside_others(*phase_rad));
    split_light(data, &mut numbers);
    Arc::new(pixels(data, numbers, own_phases.at_frequencies()))
}

/// Gives a pixel that has no samples the mean light of those beside it that see the same, target or background: what falls there others get a part of, by whatever way.
fn fill(data: &Data, [amplitude_dn, phase_rad, constant_dn, ambient_dn]: &mut [Vec<f64>; OWN]) {
    let geometry = data.geometry();
    let samples = data.samples_of_pixels();
    for pixel in (0..data.pixels()).filter(|&pixel| samples[pixel] == 0) {
        let is_alike = |&other: &usize| samples[other] > 0 && data.target[other] == data.target[pixel];
        let beside: Vec<usize> = geometry.beside(pixel).into_iter().flatten().filter(is_alike).collect();
        if beside.is_empty() {
            continue;
        }
        let mean = |of: &dyn Fn(usize) -> f64| {
            beside.iter().map(|&other| of(other)).sum::<f64>() / beside.len() as f64
        };
        let cosine = mean(&|other| amplitude_dn[other] * phase_rad[other].cos());
        let sine = mean(&|other| amplitude_dn[other] * phase_rad[other].sin());
        let [constant, ambient] = [&*constant_dn, &*ambient_dn].map(|all| mean(&|other| all[other]));
        (amplitude_dn[pixel], phase_rad[pixel]) = (cosine.hypot(sine), sine.atan2(cosine));
        (constant_dn[pixel], ambient_dn[pixel]) = (constant, ambient);
    }
}

/// The pixels' own numbers by that fit, where pixels have these `own_phases` at other modulation frequencies than the usual one.
pub fn numbers(
    data: &Data,
    counts: &(dyn Fn(usize) -> bool + Sync),
    own_phases: &OwnPhases,
) -> [Vec<f64>; OWN] {
    let count = data.pixels();
    let unit = |amplitude: f64, phase_rad: Vec<f64>, constant: f64, ambient: f64| {
        let [amplitude, constant, ambient] = [amplitude, constant, ambient].map(|value| vec![value; count]);
        let pixels = pixels(data, [amplitude, phase_rad, constant, ambient], Vec::new());
        chain(&data.camera, Arc::new(pixels), Vec::new())
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    // What pixels have at each frequency besides is known here.
    let bases: Vec<[Chain; OWN]> = own_phases
        .besides_rad(count)
        .into_iter()
        .map(|besides_rad| {
            let turned = besides_rad.iter().map(|besides_rad| besides_rad + quarter).collect();
            [
                unit(1.0, besides_rad.clone(), 0.0, 0.0),
                unit(1.0, turned, 0.0, 0.0),
                unit(0.0, besides_rad.clone(), 1.0, 0.0),
                unit(0.0, besides_rad, 0.0, 1.0),
            ]
        })
        .collect();
    let none = vec![(Matrix4::<f64>::zeros(), Vector4::<f64>::zeros()); count];
    let add = |mut normal: Vec<(Matrix4<f64>, Vector4<f64>)>, take: usize, index: usize| {
        let take = &data.takes[take];
        let basis = &bases[own_phases.number(take)];
        let expose = |chain: &Chain| chain.expose(take.moments[index], Memory::default()).signal_dn;
        let signals = basis.each_ref().map(expose);
        let measured = &take.signal_dn[index * count..(index + 1) * count];
        for (pixel, &measured) in measured.iter().enumerate().filter(|(_, measured)| !measured.is_nan()) {
            let constant = if data.tells_constant(pixel) { signals[2][pixel] } else { 0.0 };
            let own = Vector4::new(signals[0][pixel], signals[1][pixel], constant, signals[3][pixel]);
            normal[pixel].0 += own * own.transpose();
            normal[pixel].1 += own * f64::from(measured);
        }
        normal
    };
    let join = |mut normal: Vec<(Matrix4<f64>, Vector4<f64>)>, others: Vec<_>| {
        normal.iter_mut().zip(others).for_each(|(sum, other): (_, (Matrix4<f64>, Vector4<f64>))| {
            sum.0 += other.0;
            sum.1 += other.1;
        });
        normal
    };
    let normal = summed(data, counts, &none, add, join);
    let mut numbers = [(); OWN].map(|()| vec![0.0; count]);
    for (pixel, (matrix, vector)) in normal.iter().enumerate() {
        let solution = matrix.svd(true, true).solve(vector, 1e-9 * matrix.norm()).unwrap_or_default();
        numbers[0][pixel] = solution[0].hypot(solution[1]);
        numbers[1][pixel] = solution[1].atan2(solution[0]);
        numbers[2][pixel] = solution[2];
        numbers[3][pixel] = solution[3];
    }
    numbers
}
