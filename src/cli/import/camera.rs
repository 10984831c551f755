//! What is known of the camera: a `camera.toml`, or its fields one by one, all of them or none.

use super::super::option::in_range;
use crate::frames::Geometry;
use crate::problem::{Problem, Result};
use crate::recording::{Camera, MOST_BITS};
use clap::Args;
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// The camera's options.
#[derive(Debug, Args)]
pub(super) struct CameraArguments {
    /// What is known of the camera, copied to the recordings
    #[arg(long, value_name = "camera.toml",
        conflicts_with_all = ["adc_bits", "pedestal_dn", "gain_e_per_dn", "read_noise_e", "focal_length_px"])]
    camera: Option<PathBuf>,
    /// Bits of the ADC, 8 to 24; a code beyond them is refused. They are kept in camera.toml only, for which the next four
    /// options are needed, too
    #[arg(long, value_name = "BITS")]
    adc_bits: Option<u32>,
    /// Black level: the code at no light
    #[arg(long, value_name = "DN")]
    pedestal_dn: Option<f64>,
    /// Electrons a code
    #[arg(long, value_name = "E")]
    gain_e_per_dn: Option<f64>,
    /// Standard deviation of the read noise, electrons
    #[arg(long, value_name = "E")]
    read_noise_e: Option<f64>,
    /// Focal length, pixels
    #[arg(long, value_name = "PIXELS")]
    focal_length_px: Option<f64>,
}

/// What the options say.
pub(super) enum Known {
    /// Nothing, or no more than the bits of the ADC.
    Bits(Option<u32>),
    /// A file.
    File(Box<Camera>),
    /// All fields; the geometry is the frames'.
    Fields(Box<Camera>),
}

impl Known {
    /// Bits of the ADC.
    pub fn adc_bits(&self) -> Option<u32> {
        match self {
            Self::Bits(bits) => *bits,
            Self::File(camera) | Self::Fields(camera) => Some(camera.adc_bits),
        }
    }

    /// The camera, where enough is known for a `camera.toml`.
    pub fn camera(self, geometry: Geometry) -> Option<Camera> {
        match self {
            Self::Bits(_) => None,
            Self::File(camera) => Some(*camera),
            Self::Fields(camera) => Some(Camera { geometry, ..*camera }),
        }
    }
}

impl CameraArguments {
    /// What the options say.
    pub fn read(&self) -> Result<Known> {
        if let Some(file) = &self.camera {
            return Ok(Known::File(Box::new(Camera::read(file)?)));
        }
        if let Some(bits) = self.adc_bits.filter(|bits| !(8..=MOST_BITS).contains(bits)) {
            return Err(Problem::at("--adc-bits", bits)
                .expected(format_args!("a whole number from 8 to {MOST_BITS}")));
        }
        // Ranges are those of the format.
        let fields: [(&str, Option<f64>, RangeInclusive<f64>); 5] = [
            ("--adc-bits", self.adc_bits.map(f64::from), 8.0..=f64::from(MOST_BITS)),
            ("--pedestal-dn", self.pedestal_dn, 0.0..=f64::from((1_u32 << MOST_BITS) - 1)),
            ("--gain-e-per-dn", self.gain_e_per_dn, 1e-9..=1e9),
            ("--read-noise-e", self.read_noise_e, 0.0..=1e9),
            ("--focal-length-px", self.focal_length_px, 1e-3..=1e9),
        ];
        for (option, value, allowed) in &fields {
            if let Some(value) = value {
                in_range(option, *value, allowed)?;
            }
        }
        let named = |given: bool| -> Vec<&str> {
            fields
                .iter()
                .filter(|(_, value, _)| value.is_some() == given)
                .map(|(option, ..)| *option)
                .collect()
        };
        if let (
            Some(adc_bits),
            Some(pedestal_dn),
            Some(gain_e_per_dn),
            Some(read_noise_e),
            Some(focal_length_px),
        ) = (self.adc_bits, self.pedestal_dn, self.gain_e_per_dn, self.read_noise_e, self.focal_length_px)
        {
            let camera = Camera {
                pedestal_dn,
                gain_e_per_dn,
                read_noise_e,
                focal_length_px,
                ..Camera::assumed(Geometry { width: 1, height: 1 }, adc_bits)
            };
            if pedestal_dn >= f64::from(camera.full_scale()) {
                return Err(Problem::at("--pedestal-dn", pedestal_dn)
                    .expected(format_args!("below the greatest code of {adc_bits} bits"))
                    .remedy("give the code at no light in codes of this converter, or correct --adc-bits"));
            }
            return Ok(Known::Fields(Box::new(camera)));
        }
        match &named(true)[..] {
            [] | ["--adc-bits"] => Ok(Known::Bits(self.adc_bits)),
            given => {
                let missing = named(false).join(", ");
                Err(Problem::at(given.join(", "), format_args!("given without {missing}"))
                    .expected("all five: a camera.toml has each of them, and none is made up")
                    .remedy(format_args!("give {missing}, too, or leave these out; or --camera camera.toml")))
            }
        }
    }
}
