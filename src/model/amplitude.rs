//! Amplitude: the angle unit's length freed from its gain, the scheme's gain and the normaliser's shift.

use crate::spec::Pipeline;

/// The amplitude in 2^−fraction DN, rounded to nearest; 0 where there is no vector (`zero`), or where none is asked for.
pub fn amplitude(pipeline: &Pipeline, length: i64, shift: u32, zero: bool) -> i64 {
    let derived = pipeline.derived();
    let amplitude =
        if zero || !pipeline.output.amplitude { 0 } else { derived.amplitude_factor.apply(length, shift) };
    debug_assert!(
        derived.amplitude.contains(amplitude),
        "amplitude {amplitude} leaves {}",
        derived.amplitude
    );
    amplitude
}
