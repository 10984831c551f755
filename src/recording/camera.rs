//! `camera.toml`: what the simulation of a camera knows, and which effects it takes into account.

use super::codes::MOST_BITS;
use crate::fields::{self, Fields};
use crate::frames::Geometry;
use crate::problem::{Problem, Result};
use std::path::{Path, PathBuf};

/// In [`Camera::included_physics`]: light falls off during a set as the target moves.
pub const INVERSE_SQUARE_FALLOFF: &str = "inverse_square_falloff";
/// In [`Camera::included_physics`]: the phase follows the recorded velocity from frame to frame.
pub const AXIAL_MOTION: &str = "axial_motion_of_recorded_velocity";

/// What can be included, by the effect that is the same with a value.
pub const BASELINE: [(&str, &str); 2] =
    [("axial_motion", AXIAL_MOTION), ("inverse_square_falloff", INVERSE_SQUARE_FALLOFF)];

/// The name of an effect with values, as [`Camera::effects`] has it.
pub fn effect_name(text: &str) -> &str {
    text.split([':', '@']).next().unwrap_or(text)
}

/// A camera as its simulation knows it.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// The sensor's pixels, each side 1 to 65536.
    pub geometry: Geometry,
    /// Bits of a raw code, 8 to 24.
    pub adc_bits: u32,
    /// Code at no light, DN, 0 to the greatest code.
    pub pedestal_dn: f64,
    /// Electrons a code, above 0.
    pub gain_e_per_dn: f64,
    /// Standard deviation of the read noise, electrons.
    pub read_noise_e: f64,
    /// Focal length in pixels: radial distance = position · √(1 + (x² + y²)/focal_length²).
    pub focal_length_px: f64,
    /// Relative amplitude of harmonic m = 1, 2, … of the correlation waveform; the first is 1.
    pub correlation_amplitude: Vec<f64>,
    /// Phase of the same harmonics, rad; the first is 0.
    pub correlation_phase_rad: Vec<f64>,
    /// Effects that the simulation includes beside the above.
    pub included_physics: Vec<String>,
    /// Effects with values that it includes, as `name:parameter=value,…`, with `@recording,…` where they act in some recordings only.
    pub effects: Vec<String>,
}

impl Camera {
    /// What is taken for a camera of which no more is known: no pedestal, rays that are parallel, a correlation without harmonics, and
    /// all of [`BASELINE`] included.
    pub fn assumed(geometry: Geometry, adc_bits: u32) -> Self {
        Self {
            geometry,
            adc_bits,
            pedestal_dn: 0.0,
            gain_e_per_dn: 1.0,
            read_noise_e: 1.0,
            focal_length_px: 1e9,
            correlation_amplitude: vec![1.0],
            correlation_phase_rad: vec![0.0],
            included_physics: BASELINE.map(|(_, included)| included.to_owned()).to_vec(),
            effects: Vec::new(),
        }
    }

    /// The camera of the recording in `folder` and the file that describes it: the folder's own, else its campaign's.
    pub(super) fn of_recording(folder: &Path) -> Result<Option<(Self, PathBuf)>> {
        // `..` and `.` have no parent by name.
        let campaign = match folder.file_name() {
            Some(_) => folder.parent().map(Path::to_owned).unwrap_or_default(),
            None => folder.join(".."),
        };
        let candidates = [folder.join("camera.toml"), campaign.join("camera.toml")];
        match candidates.into_iter().find(|path| path.exists()) {
            Some(path) => Ok(Some((Self::read(&path)?, path))),
            None => Ok(None),
        }
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    /// A file that cannot be read, and a field that is missing, of another type, or out of its range.
    pub fn read(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path).map_err(|error| Problem::io(path, "read", &error))?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// Reads the text of the file called `file`.
    ///
    /// # Errors
    /// As [`Camera::read`].
    pub fn parse(file: &str, text: &str) -> Result<Self> {
        let table = fields::parse(file, text)?;
        let top = Fields::top(file, &table);
        let sensor = top.section("sensor")?;
        let correlation = top.optional_section("correlation")?;
        let correlation = correlation.map(|correlation| waveform(file, &correlation)).transpose()?;
        let effects = match top.optional_section("physics")? {
            Some(physics) if physics.has("effects") => physics.texts("effects")?,
            _ => Vec::new(),
        };
        let included = match top.optional_section("physics")? {
            None => None,
            Some(physics) if physics.has("included") => Some(physics.texts("included")?),
            Some(physics) => return Err(physics.refuse("included", "a list of strings, [] for no effect")),
        };
        // Without the section there are no effects either.
        check_physics(file, included.as_deref().unwrap_or_default(), &effects)?;
        let adc_bits = sensor.integer("adc_bits", 8..=i64::from(MOST_BITS))? as u32;
        let full_scale = full_scale(adc_bits);
        let pedestal_dn = sensor.number("pedestal_dn", 0.0..=f64::from(full_scale), "DN")?;
        if pedestal_dn >= f64::from(full_scale) {
            return Err(sensor
                .refuse(
                    "pedestal_dn",
                    format_args!("below {full_scale}, the greatest code of {adc_bits} bits"),
                )
                .remedy("give the code at no light in codes of this converter, or correct sensor.adc_bits"));
        }
        let geometry = Geometry {
            width: sensor.integer("width", 1..=65_536)? as usize,
            height: sensor.integer("height", 1..=65_536)? as usize,
        };
        let mut camera = Self {
            pedestal_dn,
            gain_e_per_dn: sensor.number("gain_e_per_dn", 1e-9..=1e9, "electrons a code")?,
            read_noise_e: sensor.number("read_noise_e", 0.0..=1e9, "electrons")?,
            focal_length_px: sensor.number("focal_length_px", 1e-3..=1e9, "pixels")?,
            effects: effects.into_iter().map(str::to_owned).collect(),
            ..Self::assumed(geometry, adc_bits)
        };
        if let Some((amplitude, phase_rad)) = correlation {
            (camera.correlation_amplitude, camera.correlation_phase_rad) = (amplitude, phase_rad);
        }
        if let Some(included) = included {
            camera.included_physics = included.into_iter().map(str::to_owned).collect();
        }
        Ok(camera)
    }

    /// Radial over axial distance, √(1 + (x² + y²)/focal_length²), x and y in pixels from the sensor's centre.
    pub fn obliquity(&self, row: usize, column: usize) -> f64 {
        let from_centre = |index: usize, size: usize| index as f64 - (size as f64 - 1.0) / 2.0;
        let x = from_centre(column, self.geometry.width) / self.focal_length_px;
        let y = from_centre(row, self.geometry.height) / self.focal_length_px;
        (1.0 + x * x + y * y).sqrt()
    }

    /// That of every pixel, row by row.
    pub fn obliquities(&self) -> Vec<f64> {
        let places = (0..self.geometry.pixels()).map(|pixel| self.geometry.row_column(pixel));
        places.map(|(row, column)| self.obliquity(row, column)).collect()
    }

    /// The same camera with `geometry` for its pixels, behind the same lens: the field of view from left to right stays.
    #[must_use]
    pub fn resized(self, geometry: Geometry) -> Self {
        let focal_length_px = self.focal_length_px * (geometry.width as f64 / self.geometry.width as f64);
        Self { geometry, focal_length_px, ..self }
    }

    /// The converter's greatest code.
    pub fn full_scale(&self) -> u32 {
        full_scale(self.adc_bits)
    }

    /// What another program has written into `included`, and what is misspelt there: it is not simulated.
    pub fn unknown_physics(&self) -> impl Iterator<Item = &str> {
        let is_known = |name: &str| BASELINE.into_iter().any(|(_, included)| included == name);
        self.included_physics.iter().map(String::as_str).filter(move |name| !is_known(name))
    }

    /// The text of a file that reads as this camera.
    pub fn to_toml(&self) -> String {
        // Files of before had no effects, and stay as they were.
        let effects = match self.effects.is_empty() {
            true => String::new(),
            false => format!("effects = {}\n", toml::Value::from(self.effects.clone())),
        };
        format!(
            "[sensor]\nwidth = {}\nheight = {}\nadc_bits = {}\npedestal_dn = {:?}\ngain_e_per_dn = {:?}\n\
             read_noise_e = {:?}\nfocal_length_px = {:?}\n\
             \n[correlation]\namplitude = {:?}\nphase_rad = {:?}\n\n[physics]\nincluded = {}\n{effects}",
            self.geometry.width,
            self.geometry.height,
            self.adc_bits,
            self.pedestal_dn,
            self.gain_e_per_dn,
            self.read_noise_e,
            self.focal_length_px,
            self.correlation_amplitude,
            self.correlation_phase_rad,
            toml::Value::from(self.included_physics.clone()),
        )
    }
}

/// The greatest code of a converter of `adc_bits` bits.
fn full_scale(adc_bits: u32) -> u32 {
    (1 << adc_bits) - 1
}

/// That nothing is there both by name and with a value. Effects are the simulator's to know.
fn check_physics(file: &str, included_physics: &[&str], effects: &[&str]) -> Result<()> {
    let is_twice = |text: &&&str| {
        let twice = |(name, included): &(&str, &str)| {
            effect_name(text) == *name && included_physics.contains(included)
        };
        BASELINE.iter().any(twice)
    };
    match effects.iter().find(is_twice) {
        None => Ok(()),
        Some(text) => {
            let found =
                format!("physics.effects has {text}, which physics.included has too: it would act twice");
            Err(Problem::at(file, found)
                .expected("each in one of the two")
                .remedy("remove it from physics.included, to keep its value; or from physics.effects"))
        }
    }
}

/// Amplitude and phase of the correlation's harmonics, the fundamental being the unit of both.
fn waveform(file: &str, correlation: &Fields) -> Result<(Vec<f64>, Vec<f64>)> {
    let amplitude =
        correlation.numbers("amplitude", "finite numbers, one for each harmonic from the first on")?;
    let phase_rad =
        correlation.numbers("phase_rad", "finite numbers in rad, one for each harmonic from the first on")?;
    if amplitude.len() != phase_rad.len() {
        return Err(Problem::at(
            file,
            format_args!(
                "correlation.amplitude has {} numbers, correlation.phase_rad {}",
                amplitude.len(),
                phase_rad.len()
            ),
        )
        .expected("one of each for every harmonic"));
    }
    if amplitude.first() != Some(&1.0) {
        return Err(
            correlation.refuse("amplitude", "1.0 as the first: amplitudes relative to the fundamental")
        );
    }
    if amplitude.iter().any(|amplitude| amplitude.abs() > 1.0) {
        return Err(correlation
            .refuse("amplitude", "numbers from -1 to 1: amplitudes relative to the fundamental")
            .remedy("divide all by the fundamental's amplitude, not by a harmonic's"));
    }
    if phase_rad.first() != Some(&0.0) {
        return Err(correlation.refuse("phase_rad", "0.0 as the first: phases relative to the fundamental"));
    }
    Ok((amplitude, phase_rad))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MINIMAL: &str = "[sensor]\nwidth = 3\nheight = 5\nadc_bits = 12\npedestal_dn = 64\n\
                           gain_e_per_dn = 12.0\nread_noise_e = 36.0\nfocal_length_px = 2.0\n";

    #[test]
    fn absent_sections_are_a_sinusoid_and_both_effects() {
        let camera = Camera::parse("camera.toml", MINIMAL).unwrap();
        assert_eq!(camera.correlation_amplitude, [1.0]);
        assert_eq!(camera.included_physics, [AXIAL_MOTION, INVERSE_SQUARE_FALLOFF]);
        let none = Camera::parse("camera.toml", &format!("{MINIMAL}[physics]\nincluded = []")).unwrap();
        assert!(none.included_physics.is_empty());
        assert_eq!(Camera::parse("again", &none.to_toml()).unwrap(), none);
        let with_value = "[physics]\nincluded = []\neffects = [\"inverse_square_falloff:share=0.5@a\"]";
        let with_value = Camera::parse("camera.toml", &format!("{MINIMAL}{with_value}")).unwrap();
        assert_eq!(with_value.effects, ["inverse_square_falloff:share=0.5@a"]);
    }

    #[test]
    fn nonsense_is_refused_with_what_would_be_right() {
        let of = |from: &str, to: &str| Camera::parse("camera.toml", &MINIMAL.replace(from, to));
        assert!(of("= 64", "= 4094.5").is_ok());
        let end = "focal_length_px = 2.0\n";
        for (from, to, words) in [
            (
                "= 64",
                "= 4095",
                "sensor.pedestal_dn = 4095\n  expected: below 4095, the greatest code of 12 bits",
            ),
            (
                "= 12\npedestal_dn = 64",
                "= 8\npedestal_dn = 255",
                "expected: below 255, the greatest code of 8 bits",
            ),
            (
                end,
                "focal_length_px = 2\n[correlation]\namplitude = [1.0, 1.5]\nphase_rad = [0.0, 0.0]",
                "correlation.amplitude = [1.0, 1.5]\n  expected: numbers from -1 to 1",
            ),
        ] {
            let refusal = of(from, to).unwrap_err().to_string();
            assert!(refusal.starts_with("camera.toml: ") && refusal.contains(words), "{refusal}");
            assert!(refusal.contains("way out: "), "{refusal}");
        }
    }

    #[test]
    fn what_another_program_includes_is_kept_and_told() {
        let text = format!("{MINIMAL}[physics]\nincluded = [\"inverse_square_falloff\", \"gravity\"]");
        let camera = Camera::parse("camera.toml", &text).unwrap();
        assert_eq!(camera.unknown_physics().collect::<Vec<_>>(), ["gravity"]);
        assert_eq!(Camera::parse("again", &camera.to_toml()).unwrap(), camera);
    }

    #[test]
    fn obliquity_is_one_at_the_centre_and_pythagoras_elsewhere() {
        let camera = Camera::parse("camera.toml", MINIMAL).unwrap();
        assert_eq!(camera.obliquity(2, 1), 1.0);
        assert_eq!(camera.obliquity(0, 1), 2f64.sqrt());
        assert!((camera.obliquity(4, 2) - (1.0f64 + 1.0 + 0.25).sqrt()).abs() < 1e-15);
    }
}
