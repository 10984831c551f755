//! From a `camera.toml` to the simulator: what it says, and what it leaves to be assumed.

use crate::frames::Geometry;
use crate::physics::{Active, Chain, Correlation, Harmonic, Included, Pixels, Sensor};
use crate::recording::{AXIAL_MOTION, Camera, INVERSE_SQUARE_FALLOFF};
use std::sync::Arc;

// What no camera.toml says, as shares of the converter's full scale: a target of reflectivity 1 at 1 m fills a good half
// of it, so that nothing saturates on the rail.
const AMPLITUDE_1M: f64 = 0.154;
const AMBIENT: f64 = 0.05;
/// The constant part of the camera's own light over its amplitude: two square waves make 1.23, and light that the sensor does not
/// demodulate adds to it.
const CONSTANT_RATIO: f64 = 2.2;

/// A small camera with 12 bits, the lens of a campaign on the rail, and the odd harmonics of a triangle with rounded corners.
pub fn practice_camera(geometry: Geometry) -> Camera {
    Camera {
        pedestal_dn: 64.0,
        gain_e_per_dn: 12.0,
        read_noise_e: 36.0,
        focal_length_px: 33.0 * geometry.width as f64 / 24.0,
        correlation_amplitude: vec![1.0, 0.0, 0.024_129, 0.0, 0.003_372, 0.0, 0.000_892],
        correlation_phase_rad: vec![0.0, 0.0, -0.2421, 0.0, -0.4719, 0.0, -0.69],
        ..Camera::assumed(geometry, 12)
    }
}

/// The sensor that `camera` describes, with an assumed light: amplitude, constant part and ambient light by the converter's full
/// scale.
pub fn sensor(camera: &Camera) -> Sensor {
    let dark = Sensor {
        geometry: camera.geometry,
        focal_length_px: camera.focal_length_px,
        amplitude_1m_e: 0.0,
        constant_ratio: CONSTANT_RATIO,
        ambient_e: 0.0,
        pedestal_dn: camera.pedestal_dn,
        gain_e_per_dn: camera.gain_e_per_dn,
        read_noise_e: camera.read_noise_e,
        adc_bits: camera.adc_bits,
    };
    let full_scale_e = dark.full_scale_dn() * camera.gain_e_per_dn;
    Sensor { amplitude_1m_e: AMPLITUDE_1M * full_scale_e, ambient_e: AMBIENT * full_scale_e, ..dark }
}

/// The chain that simulates `camera` with these pixels, and `effects` besides.
pub fn chain(camera: &Camera, pixels: Arc<Pixels>, effects: Vec<Active>) -> Chain {
    let parts = camera.correlation_amplitude.iter().zip(&camera.correlation_phase_rad);
    let harmonics: Vec<Harmonic> = (1..)
        .zip(parts)
        // The fundamental is the unit, and always there.
        .skip(1)
        .map(|(number, (&amplitude, &phase_rad))| Harmonic { number, amplitude, phase_rad })
        .collect();
    // Not `Camera::includes`: an effect with a value acts with the others, and is not in the baseline besides.
    let included = |name: &str| camera.included_physics.iter().any(|included| included == name);
    let included = Included {
        axial_motion: included(AXIAL_MOTION),
        inverse_square_falloff: included(INVERSE_SQUARE_FALLOFF),
    };
    Chain::new(pixels, Correlation::with_harmonics(&harmonics), included, effects)
}
