//! `fixed_point:pipeline=SPEC`: the bits of a camera's codes that a pipeline's input has no place for.
//!
//! A recording holds raw codes, so that of a pipeline's arithmetic only its input can be in one: low bits of the converter that the
//! specification's `sensor.adc_bits` leaves out. What the pipeline rounds later, from sums to distances, is what the integer model computes.

use super::injection::{injection, injection_among};
use crate::physics::{Active, Effect, effects};
use crate::problem::Result;
use crate::spec::Pipeline;

const PARAMETER: &str = "pipeline";

/// The effect, of the registry or a `library`, that `text` names, as [`injection_among`] reads it; beside that, `fixed_point:pipeline=SPEC`, SPEC a preset or a TOML file, for a
/// camera whose codes have `adc_bits` bits: bits_cut is what these have more than `sensor.adc_bits`, and 0 where they have no more.
///
/// # Errors
/// As [`injection_among`]; a specification that cannot be read.
pub fn injection_for(text: &str, adc_bits: u32, library: &[&'static Effect]) -> Result<Active> {
    let Some(specification) = specification_of(text) else { return injection_among(text, library) };
    let taken = Pipeline::named(specification)?.sensor.adc_bits;
    let bits = adc_bits.saturating_sub(taken);
    // A camera has 24 bits at most, and a specification takes 8 at least.
    injection(&format!("{}:bits_cut={bits}", effects::FIXED_POINT))
}

/// The specification that `text` names, where it does.
pub fn specification_of(text: &str) -> Option<&str> {
    text.strip_prefix(effects::FIXED_POINT)?.strip_prefix(':')?.strip_prefix(PARAMETER)?.strip_prefix('=')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pipeline_cuts_what_it_has_no_place_for() {
        // The preset takes 12 bits.
        for (adc_bits, cut) in [(10, 0.0), (12, 0.0), (13, 1.0), (16, 4.0), (24, 12.0)] {
            let active = injection_for("fixed_point:pipeline=vuris", adc_bits, &[]).unwrap();
            assert_eq!((active.effect.name, active.values), ("fixed_point", vec![cut]), "{adc_bits}");
        }
        assert_eq!(injection_for("fixed_point:bits_cut=3", 16, &[]).unwrap().values, [3.0]);
        assert_eq!(
            injection_for("image_lag", 16, &[]).unwrap().values,
            injection("image_lag").unwrap().values
        );
    }

    #[test]
    fn what_cannot_be_cut_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let narrow = folder.path().join("narrow.toml");
        let text =
            Pipeline::named("vuris").unwrap().adapted("narrow", |s| s.sensor.adc_bits = 8).unwrap().to_toml();
        std::fs::write(&narrow, text).unwrap();
        let text = format!("fixed_point:pipeline={}", narrow.display());
        assert_eq!(injection_for(&text, 16, &[]).unwrap().values, [8.0]);
        for (text, adc_bits, words) in [
            ("fixed_point:pipeline=none.toml", 12, "none.toml"),
            ("fixed_point:pipeline=none.toml", 12, "one of the presets vuris"),
            ("fixed_point:bits_cut=1,pipeline=vuris", 12, "fixed_point has no parameter pipeline"),
            ("image_lag:pipeline=vuris", 12, "image_lag has no parameter pipeline"),
        ] {
            let refusal = injection_for(text, adc_bits, &[]).unwrap_err().to_string();
            assert!(refusal.contains(words), "{refusal}");
        }
    }
}
