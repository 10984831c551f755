//! Draws the error maps of two phase schemes, with phases in floating point: `error_maps FILE.svg`.

use num_complex::Complex64;
use std::f64::consts::TAU;
use vuris::frames::RawSets;
use vuris::physics::{Acquisition, Correlation, Scene, Sensor, simulate};
use vuris::report::{ErrorMap, ErrorMaps, rms};
use vuris::spec::{Scheme, scheme};
use vuris::units::{unambiguous_range_m, wrap_rad};

const FREQUENCY_HZ: f64 = 30e6;
const SEED: u64 = 2012;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: error_maps FILE.svg")?;
    let (scene, sensor) = (Scene::room(), Sensor::vuris());
    let view = scene.view(sensor.geometry, sensor.focal_length_px, 0.0);
    let moves: Vec<bool> =
        view.iter().flatten().map(|surface| scene.objects[surface.object].velocity_m_s != 0.0).collect();

    let measure = |name| -> Result<_, Box<dyn std::error::Error>> {
        let acquisition = Acquisition {
            scheme: scheme(name).ok_or(name)?,
            frames_per_step: 1,
            frequency_hz: FREQUENCY_HZ,
            frame_period_s: 0.025,
            sets: 1,
        };
        let (frames, true_range_m) =
            simulate(&scene, &Correlation::measured(), &sensor, &acquisition, Some(SEED))?;
        let error_m = errors_m(&frames, acquisition.scheme, &true_range_m);
        let part = |moving| {
            let errors = error_m.iter().zip(&moves).filter(|(_, moves)| **moves == moving);
            1e3 * rms(errors.map(|(error, _)| *error))
        };
        let whole = 1e3 * rms(error_m.iter().copied());
        println!("{name}: RMS {whole:.2} mm; moving {:.2} mm, still {:.2} mm", part(true), part(false));
        let note = format!("moving box {:.1} mm", part(true));
        Ok((true_range_m, error_m, note))
    };
    let (range_m, four_m, four_note) = measure("four_frame")?;
    let (_, wdft_m, wdft_note) = measure("wdft")?;
    let picture = ErrorMaps {
        title: "Range error of two phase schemes on the same scene",
        subtitle: "Simulated at 30 MHz and 25 ms a frame, with Table I’s waveform harmonics, shot and read noise",
        geometry: sensor.geometry,
        range_m: &range_m,
        range_note: "the box in front approaches at 1 m/s",
        errors: [
            ErrorMap { label: "Error, four frames", note: &four_note, error_m: &four_m },
            ErrorMap { label: "Error, WDFT (five frames)", note: &wdft_note, error_m: &wdft_m },
        ],
        grey: "an edge crosses the pixel during the measurement: left out of the RMS",
    };
    std::fs::write(path, picture.to_svg()?)?;
    Ok(())
}

/// Measured minus true range, with φ = arg Σ c_n I_n.
fn errors_m(frames: &RawSets, scheme: &Scheme, true_range_m: &[f64]) -> Vec<f64> {
    let coefficients = scheme.characteristic_polynomial();
    let metres_a_rad = unambiguous_range_m(FREQUENCY_HZ) / TAU;
    let phase_rad = |pixel: usize| {
        let terms = coefficients.iter().enumerate().map(|(n, c)| c * f64::from(frames.frame(0, n)[pixel]));
        terms.sum::<Complex64>().arg()
    };
    let error = |(pixel, true_m)| wrap_rad(phase_rad(pixel) - true_m / metres_a_rad) * metres_a_rad;
    true_range_m.iter().copied().enumerate().map(error).collect()
}
