//! The effects, one file each, and their registry.

pub mod adc_nonlinearity;
mod ambient_drift;
pub mod ambient_flicker;
mod axial_motion;
mod charge_crosstalk;
mod clock_jitter;
mod correlation_harmonics;
mod demodulation_skew;
mod electrical_crosstalk;
mod encoder_cyclic;
mod encoder_offset;
mod encoder_scale;
mod excess_noise;
mod fixed_point;
mod frame_gain;
mod frame_timing_error;
mod illumination_baseline;
mod illumination_drift;
mod illumination_droop;
mod image_lag;
mod intensity_nonlinearity;
mod intensity_related_phase;
mod inverse_square_falloff;
mod lateral_motion;
mod lens_scatter;
mod mixed_pixels;
mod modulation_frequency_error;
pub mod multi_camera_interference;
pub mod multipath_interference;
mod phase_drift;
pub mod phase_step_errors;
mod phase_step_scale;
mod radial_axial_distance;
mod response_decay;
pub mod saturation;
mod tap_mismatch;
mod timing_jitter_of_frames;

use super::effect::Effect;

/// The camera's own arithmetic, which acts on codes: after the noise, where there is any.
pub const FIXED_POINT: &str = fixed_point::EFFECT.name;

/// All effects.
pub static EFFECTS: &[&Effect] = &[
    &correlation_harmonics::EFFECT,
    &inverse_square_falloff::EFFECT,
    &axial_motion::EFFECT,
    &multipath_interference::EFFECT,
    &lens_scatter::EFFECT,
    &mixed_pixels::EFFECT,
    &ambient_drift::EFFECT,
    &ambient_flicker::EFFECT,
    &illumination_droop::EFFECT,
    &illumination_drift::EFFECT,
    &phase_step_scale::EFFECT,
    &phase_step_errors::EFFECT,
    &phase_drift::EFFECT,
    &clock_jitter::EFFECT,
    &demodulation_skew::EFFECT,
    &modulation_frequency_error::EFFECT,
    &intensity_nonlinearity::EFFECT,
    &saturation::EFFECT,
    &image_lag::EFFECT,
    &charge_crosstalk::EFFECT,
    &tap_mismatch::EFFECT,
    &adc_nonlinearity::EFFECT,
    &intensity_related_phase::EFFECT,
    &electrical_crosstalk::EFFECT,
    &encoder_scale::EFFECT,
    &encoder_cyclic::EFFECT,
    &frame_gain::EFFECT,
    &timing_jitter_of_frames::EFFECT,
    &lateral_motion::EFFECT,
    &excess_noise::EFFECT,
    &fixed_point::EFFECT,
    // New ones come last: what chance draws follows the order (`bench/simulation.rs` says how far).
    &response_decay::EFFECT,
    &encoder_offset::EFFECT,
    &illumination_baseline::EFFECT,
    &frame_timing_error::EFFECT,
    &radial_axial_distance::EFFECT,
    &multi_camera_interference::EFFECT,
];

/// The effect called `name`.
pub fn named(name: &str) -> Option<&'static Effect> {
    named_among(name, &[])
}

/// The effect called `name`, of the registry or of a `library`.
pub fn named_among(name: &str, library: &[&'static Effect]) -> Option<&'static Effect> {
    EFFECTS.iter().chain(library).copied().find(|effect| effect.name == name)
}
