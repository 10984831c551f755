//! Specifications that are in the binary.

/// A specification with a name, and the text of its TOML file.
#[derive(Debug)]
pub struct Preset {
    /// What `--spec` calls it.
    pub name: &'static str,
    /// The file's text.
    pub text: &'static str,
}

/// All presets.
pub const PRESETS: &[Preset] = &[
    Preset { name: "vuris", text: include_str!("presets/vuris.toml") },
    Preset { name: "vuris-fast", text: include_str!("presets/vuris-fast.toml") },
    Preset { name: "vuris-four-frame", text: include_str!("presets/vuris-four-frame.toml") },
];

/// Presets of the angle unit by itself.
pub const ANGLE_PRESETS: &[Preset] = &[
    Preset { name: "angle-16", text: include_str!("presets/angle-16.toml") },
    Preset { name: "angle-16-folded", text: include_str!("presets/angle-16-folded.toml") },
    Preset { name: "angle-16-iterative", text: include_str!("presets/angle-16-iterative.toml") },
    Preset { name: "angle-16-poly", text: include_str!("presets/angle-16-poly.toml") },
    Preset { name: "angle-16-poly-memory", text: include_str!("presets/angle-16-poly-memory.toml") },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{AngleCore, Pipeline};

    #[test]
    fn every_preset_works_and_survives_writing_and_reading() {
        for preset in PRESETS {
            let pipeline = Pipeline::named(preset.name).unwrap();
            assert_eq!(pipeline.name, preset.name);
            assert_eq!(Pipeline::parse("again", &pipeline.to_toml()).unwrap(), pipeline);
        }
    }

    #[test]
    fn every_angle_preset_works_is_faithful_and_survives_writing_and_reading() {
        for preset in ANGLE_PRESETS {
            let core = AngleCore::parse(preset.name, preset.text).unwrap();
            assert_eq!(core.name, preset.name);
            assert_eq!(AngleCore::parse("again", &core.to_toml()).unwrap(), core);
            assert!(core.unit.budget().phase_codes() < 1.0, "{}", preset.name);
        }
    }
}
