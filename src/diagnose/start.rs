//! Where a fit starts: the pixels' own numbers by linear least squares.

use super::columns::OWN;
use super::data::Data;
use super::in_order::summed;
use super::split::{BACKGROUND_M, split_light};
use crate::bench::chain;
use crate::physics::{Chain, Memory, Pixels};
use nalgebra::{Matrix4, Vector4};
use std::sync::Arc;

fn pixels(data: &Data, numbers: [Vec<f64>; OWN]) -> Pixels {
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
    let count = data.pixels();
    let unit = |amplitude: f64, phase_rad: f64, constant: f64, ambient: f64| {
        let numbers = [amplitude, phase_rad, constant, ambient].map(|value| vec![value; count]);
        chain(&data.camera, Arc::new(pixels(data, numbers)), Vec::new())
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let basis: [Chain; OWN] = [
        unit(1.0, 0.0, 0.0, 0.0),
        unit(1.0, quarter, 0.0, 0.0),
        unit(0.0, 0.0, 1.0, 0.0),
        unit(0.0, 0.0, 0.0, 1.0),
    ];
    let none = vec![(Matrix4::<f64>::zeros(), Vector4::<f64>::zeros()); count];
    let add = |mut normal: Vec<(Matrix4<f64>, Vector4<f64>)>, take: usize, index: usize| {
        let take = &data.takes[take];
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
    split_light(data, &mut numbers);
    Arc::new(pixels(data, numbers))
}
