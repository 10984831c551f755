//! Everything about a campaign but its flaws.

use super::plan::Take;
use super::scene::Scene;
use super::waveform::Waveform;

/// The sensor's numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Bits of a code.
    pub adc_bits: u32,
    /// Code at no light, DN.
    pub pedestal_dn: f64,
    /// Electrons a code.
    pub gain_e_per_dn: f64,
    /// Standard deviation of the read noise, electrons.
    pub read_noise_e: f64,
    /// Focal length, pixels.
    pub focal_length_px: f64,
}

impl Sensor {
    /// The largest code.
    pub fn full_scale_dn(&self) -> f64 {
        f64::from((1u32 << self.adc_bits) - 1)
    }

    /// Charge at the largest code, electrons.
    pub fn full_scale_e(&self) -> f64 {
        (self.full_scale_dn() - self.pedestal_dn) * self.gain_e_per_dn
    }
}

/// Which of the two effects of motion the camera's simulation knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Known {
    /// The light falls off during a set.
    pub falloff: bool,
    /// The phase follows the velocity from frame to frame.
    pub motion: bool,
}

impl Known {
    /// As the world is.
    pub const BOTH: Self = Self { falloff: true, motion: true };

    /// All but what is in `names`, by the effects' names.
    pub fn without<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        names.into_iter().fold(Self::BOTH, |known, name| match name {
            "inverse_square_falloff" => Self { falloff: false, ..known },
            "axial_motion" => Self { motion: false, ..known },
            _ => known,
        })
    }
}

/// A campaign's world.
#[derive(Debug, Clone, PartialEq)]
pub struct World {
    /// Before the camera.
    pub scene: Scene,
    /// The camera.
    pub sensor: Sensor,
    /// Modulation frequency, Hz.
    pub frequency_hz: f64,
    /// Light and gate.
    pub waveform: Waveform,
    /// Recordings.
    pub takes: Vec<Take>,
}

/// When and how a frame is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Number of the recording.
    pub take: usize,
    /// Number of the set.
    pub set: usize,
    /// Number of the frame in its set.
    pub frame: usize,
    /// Number of frames of a set.
    pub frames: usize,
    /// From the start of the recording, s.
    pub time_s: f64,
    /// From the start of the set, s.
    pub within_s: f64,
    /// Where the target is, m.
    pub position_m: f64,
    /// Where it was when the set began, m.
    pub began_m: f64,
    /// Velocity, m/s.
    pub velocity_m_s: f64,
    /// The phase that is commanded, rad.
    pub commanded_rad: f64,
    /// The gate's phase, rad.
    pub gate_rad: f64,
    /// Modulation frequency, Hz.
    pub frequency_hz: f64,
    /// The laser's power, 1 as planned.
    pub light: f64,
    /// Ambient light, 1 as planned.
    pub ambient: f64,
    /// Gain of the charge, 1 as planned.
    pub gain: f64,
}

/// The light of one pixel in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Number of the pixel, its column and its row.
    pub pixel: usize,
    /// Column, 0 on the left.
    pub column: usize,
    /// Row, 0 at the top.
    pub row: usize,
    /// Whether it comes from the target.
    pub sees_target: bool,
    /// Radial distance, m.
    pub range_m: f64,
    /// Amplitude of the fundamental, electrons.
    pub amplitude_e: f64,
    /// Charge of the light that the gate does not divide, electrons.
    pub constant_e: f64,
    /// Delay beside the way's, rad.
    pub delay_rad: f64,
    /// Light that comes a second way: its amplitude in electrons, and its one-way range in m.
    pub echo: Option<(f64, f64)>,
    /// Charge beside all that, electrons.
    pub extra_e: f64,
}
