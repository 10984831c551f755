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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::Pipeline;

    #[test]
    fn every_preset_works_and_survives_writing_and_reading() {
        for preset in PRESETS {
            let pipeline = Pipeline::named(preset.name).unwrap();
            assert_eq!(pipeline.name, preset.name);
            assert_eq!(Pipeline::parse("again", &pipeline.to_toml()).unwrap(), pipeline);
        }
    }
}
