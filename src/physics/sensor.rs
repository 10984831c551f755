//! From light to codes: falloff, ambient light, charge, noise, converter.

use super::scene::Surface;
use crate::frames::Geometry;

/// The camera's light, pixels and converter. Charges are for one pixel and one raw frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Columns and rows.
    pub geometry: Geometry,
    /// Distance of the pinhole from the sensor in pixels, > 0.
    pub focal_length_px: f64,
    /// Amplitude of the fundamental in electrons, from a surface of reflectivity 1 that faces the camera at 1 m.
    pub amplitude_1m_e: f64,
    /// The constant part of the camera's own light over the amplitude. Two square waves correlate to a triangle
    /// of 1.23 (π²/8); below about 1 a pixel would have to collect less than no charge.
    pub constant_ratio: f64,
    /// Ambient light in electrons, the same for every pixel.
    pub ambient_e: f64,
    /// Code at no light, DN.
    pub pedestal_dn: f64,
    /// Electrons a code, > 0.
    pub gain_e_per_dn: f64,
    /// Standard deviation of the read noise in electrons.
    pub read_noise_e: f64,
    /// Bits of a code, 1 to 32.
    pub adc_bits: u32,
}

/// What a pixel collects in a frame, in electrons: amplitude · waveform + offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Amplitude A of the fundamental, e.
    pub amplitude_e: f64,
    /// Offset B: the constant part of the camera's own light, and ambient light, e.
    pub offset_e: f64,
}

impl Sensor {
    /// The size, the converter and the full well of a camera like the paper's: 160 × 120 pixels, 12 bits, and a lens of 60° × 46°.
    ///
    /// The paper gives the size; everything else is an assumption. The light makes amplitudes of about
    /// 300 and 600 DN on the far wall's checks in [`super::Scene::room`], a phase noise of about 5 and 3 mrad.
    pub fn vuris() -> Self {
        Self {
            geometry: Geometry { width: 160, height: 120 },
            focal_length_px: 140.0,
            amplitude_1m_e: 1_000_000.0,
            constant_ratio: 1.25,
            ambient_e: 10_000.0,
            pedestal_dn: 64.0,
            gain_e_per_dn: 100.0,
            read_noise_e: 100.0,
            adc_bits: 12,
        }
    }

    /// The same camera with another number of pixels behind the same lens: the field of view's width stays.
    #[must_use]
    pub fn with_geometry(self, geometry: Geometry) -> Self {
        let scale = geometry.width as f64 / self.geometry.width as f64;
        Self { geometry, focal_length_px: self.focal_length_px * scale, ..self }
    }

    /// The charge from `surface`: the camera's own light falls with the square of the range, ambient light does not.
    pub fn light(&self, surface: Option<Surface>) -> Light {
        let amplitude_e =
            surface.map_or(0.0, |s| self.amplitude_1m_e * s.reflectivity / (s.range_m * s.range_m));
        Light { amplitude_e, offset_e: self.constant_ratio * amplitude_e + self.ambient_e }
    }

    /// Code of full scale above the pedestal, DN.
    pub fn full_scale_dn(&self) -> f64 {
        (u64::MAX >> (64 - self.adc_bits.clamp(1, 32))) as f64 - self.pedestal_dn
    }

    /// The codes of signals above the pedestal, DN, one a pixel; with `deviates` (one a pixel) shot and read noise.
    pub fn read_out(&self, signal_dn: &[f64], deviates: Option<&[f64]>, codes: &mut [u32]) {
        let charges_e = signal_dn.iter().map(|signal| signal * self.gain_e_per_dn);
        match deviates {
            None => codes.iter_mut().zip(charges_e).for_each(|(code, charge_e)| *code = self.code(charge_e)),
            Some(deviates) => codes
                .iter_mut()
                .zip(charges_e.zip(deviates))
                .for_each(|(code, (charge_e, deviate))| *code = self.noisy_code(charge_e, *deviate)),
        }
    }

    /// The code of a collected charge, without noise.
    pub fn code(&self, charge_e: f64) -> u32 {
        let code_dn = self.pedestal_dn + charge_e / self.gain_e_per_dn;
        let full_scale = u64::MAX >> (64 - self.adc_bits.clamp(1, 32));
        // A conversion to an integer saturates, and makes 0 of what is not a number.
        (code_dn.round() as u64).min(full_scale) as u32
    }

    /// The code of a collected charge with shot and read noise; `deviate` is a draw from the standard normal distribution.
    ///
    /// Shot noise is Poisson's, taken as normal with its variance: good from some tens of electrons on, which the ambient light
    /// and the camera's own constant light exceed by far.
    pub fn noisy_code(&self, charge_e: f64, deviate: f64) -> u32 {
        let variance_e2 = charge_e.max(0.0) + self.read_noise_e * self.read_noise_e;
        self.code(charge_e + variance_e2.sqrt() * deviate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_falls_with_the_square_of_the_range_and_ambient_does_not() {
        let sensor = Sensor::vuris();
        let light = |range_m| sensor.light(Some(Surface { object: 0, range_m, reflectivity: 0.5 }));
        assert_eq!(light(1.0).amplitude_e, 4.0 * light(2.0).amplitude_e);
        assert_eq!(light(1e9).offset_e, sensor.light(None).offset_e);
        assert_eq!(sensor.light(None), Light { amplitude_e: 0.0, offset_e: sensor.ambient_e });
    }

    #[test]
    fn the_converter_rounds_and_clips() {
        let sensor = Sensor { pedestal_dn: 10.0, gain_e_per_dn: 100.0, ..Sensor::vuris() };
        let codes = [-1e9, -1000.0, 0.0, 49.0, 51.0, 408_500.0, 408_600.0, 1e30, f64::NAN];
        assert_eq!(codes.map(|charge_e| sensor.code(charge_e)), [0, 0, 10, 10, 11, 4095, 4095, 4095, 0]);
        let narrowest = Sensor { adc_bits: 1, ..sensor.clone() };
        let widest = Sensor { adc_bits: 32, ..sensor };
        assert_eq!((narrowest.code(1e30), widest.code(1e30)), (1, u32::MAX));
    }

    /// Photon transfer: the variance in electrons is the charge plus the read noise's.
    #[test]
    fn noise_has_the_variance_of_charge_and_readout() {
        let sensor = Sensor { gain_e_per_dn: 1.0, adc_bits: 32, pedestal_dn: 1e6, ..Sensor::vuris() };
        let spread = f64::from(sensor.noisy_code(30_000.0, 1.0)) - f64::from(sensor.code(30_000.0));
        assert_eq!(spread, 200.0);
    }
}
