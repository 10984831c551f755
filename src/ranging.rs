//! Errors of measured ranges against the encoder of a recording.
//!
//! A frame is I_n = A cos(n δ + offset − φ) + B, so that the measured phase is φ − offset, and the error of a pixel in
//! a set is e = range + offset · c/(4π f) − (radial distance by the encoder), wrapped into the unambiguous range. A
//! pixel's own constant phase (its delay in the sensor) is unknown, so the pixel's circular mean over the sets is
//! removed. In motion the range changes during a set while the encoder is read at its start, which adds a constant for
//! each velocity: there the mean is removed for each pixel and commanded velocity.

use crate::problem::{Problem, Result};
use crate::recording::{Kind, Recording};
use crate::reference::{DifferenceStatistics, wrap};
use crate::units::unambiguous_range_m;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Errors of a recording's ranges, in m.
#[derive(Debug, Clone, PartialEq)]
pub struct RangeErrors {
    /// Error of each set and pixel, C order `[set, row, column]`; `None` outside the mask, where the measurement is
    /// invalid, and where there is no encoder or no second set to compare with.
    pub error_m: Vec<Option<f64>>,
    /// Mean over the pixels of each set, as the paper averages; `None` where no pixel has an error.
    pub set_mean_m: Vec<Option<f64>>,
    /// Statistics of `error_m`: noise and fixed patterns included.
    pub pixels: DifferenceStatistics,
    /// Statistics of `set_mean_m`.
    pub set_means: DifferenceStatistics,
}

/// The errors of `range_m` (`[set, row, column]`, as measured from `recording`, without its phase offsets); pixels that
/// are not `valid` are left out.
///
/// # Errors
/// A recording without light, camera or positions, lists of another length, or nothing left to compare.
pub fn range_errors(recording: &Recording, range_m: &[f64], valid: &[bool]) -> Result<RangeErrors> {
    let refuse = |found: &str| {
        Problem::in_file(&recording.folder, found).expected("the encoder's positions and the camera's lens")
    };
    let (geometry, sets) = (recording.geometry(), recording.sets.len());
    let pixels = geometry.pixels();
    if range_m.len() != sets * pixels || valid.len() != sets * pixels {
        return Err(refuse("the measured ranges are not those of this recording"));
    }
    if recording.kind == Kind::Dark {
        return Err(refuse("is a recording without light, which has no ranges"));
    }
    let Some(camera) = &recording.camera else {
        return Err(refuse("has no camera.toml: the distance of a pixel needs sensor.focal_length_px"));
    };
    let unambiguous_m = unambiguous_range_m(recording.frequency_hz);
    let obliquity = camera.obliquities();
    let mut error_m = vec![None; sets * pixels];
    for (set, row) in recording.sets.iter().enumerate() {
        let Some(position_m) = row.position_m else { continue };
        let offset_m = crate::units::range_m(row.phase_offset_rad, recording.frequency_hz);
        for pixel in (0..pixels).filter(|&pixel| recording.sees_target(pixel)) {
            let at = set * pixels + pixel;
            // A measurement that is not a number is none.
            if valid[at] && range_m[at].is_finite() {
                let error = range_m[at] + offset_m - position_m * obliquity[pixel];
                error_m[at] = Some(wrap(error, unambiguous_m));
            }
        }
    }
    for group in groups(recording).values() {
        for pixel in 0..pixels {
            remove_circular_mean(&mut error_m, group.iter().map(|set| set * pixels + pixel), unambiguous_m);
        }
    }
    let mean = |errors: &[Option<f64>]| {
        DifferenceStatistics::of(errors.iter().flatten().copied()).map(|statistics| statistics.mean)
    };
    let set_mean_m: Vec<Option<f64>> = error_m.chunks(pixels).map(mean).collect();
    let statistics = |errors: &[Option<f64>]| {
        DifferenceStatistics::of(errors.iter().flatten().copied())
            .ok_or_else(|| refuse("has no two sets with a position and a valid pixel of the mask to compare"))
    };
    Ok(RangeErrors {
        pixels: statistics(&error_m)?,
        set_means: statistics(&set_mean_m)?,
        error_m,
        set_mean_m,
    })
}

/// The sets whose errors share a constant: all, but in motion those of one commanded velocity.
fn groups(recording: &Recording) -> BTreeMap<u64, Vec<usize>> {
    let mut groups: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for (set, row) in recording.sets.iter().enumerate() {
        let key = match recording.kind {
            Kind::Motion => row.velocity_m_s.to_bits(),
            _ => 0,
        };
        groups.entry(key).or_default().push(set);
    }
    groups
}

/// Removes from the errors at `places` their circular mean; a single one says nothing, and is dropped.
fn remove_circular_mean(
    error_m: &mut [Option<f64>],
    places: impl Iterator<Item = usize> + Clone,
    unambiguous_m: f64,
) {
    let (mut count, mut sine, mut cosine) = (0, 0.0, 0.0);
    for error in places.clone().filter_map(|at| error_m[at]) {
        let (s, c) = (error / unambiguous_m * TAU).sin_cos();
        (count, sine, cosine) = (count + 1, sine + s, cosine + c);
    }
    let mean_m = f64::atan2(sine, cosine) / TAU * unambiguous_m;
    for at in places {
        error_m[at] = error_m[at].filter(|_| count > 1).map(|error| wrap(error - mean_m, unambiguous_m));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::{Geometry, RawSets};
    use crate::recording::{Camera, SetRow};
    use std::path::PathBuf;

    const SETS: usize = 40;
    const GEOMETRY: Geometry = Geometry { width: 4, height: 2 };

    /// Sets with a position, velocity and offset that run over several wraps.
    fn recording(kind: Kind) -> Recording {
        let sensor = "[sensor]\nwidth = 4\nheight = 2\nadc_bits = 12\npedestal_dn = 0\ngain_e_per_dn = 1\n\
                      read_noise_e = 0\nfocal_length_px = 5";
        let set = |set: usize| SetRow {
            position_m: (set != 3).then_some(0.7 + 0.31 * set as f64),
            velocity_m_s: if set.is_multiple_of(2) { 0.5 } else { -0.5 },
            phase_offset_rad: 0.4 * set as f64,
            ..SetRow::default()
        };
        Recording {
            folder: PathBuf::from("bench"),
            name: "bench".to_owned(),
            kind,
            frequency_hz: 30e6,
            steps_rad: vec![0.0; 4],
            frame_period_s: 0.025,
            raw: RawSets::new(GEOMETRY, 4, vec![0; SETS * 4 * 8]).unwrap(),
            sets: (0..SETS).map(set).collect(),
            extra_columns: vec![],
            mask: Some((0..8).map(|pixel| pixel != 6).collect()),
            frame_times_s: None,
            camera: Some(Camera::parse("camera.toml", sensor).unwrap()),
        }
    }

    /// What a camera with a delay in each pixel measures, plus `error_m` (of the set).
    fn measured_m(recording: &Recording, error_m: impl Fn(usize) -> f64) -> Vec<f64> {
        let unambiguous_m = unambiguous_range_m(30e6);
        let range_m = |at: usize| {
            let (set, pixel) = (at / 8, at % 8);
            let (row, column) = GEOMETRY.row_column(pixel);
            let true_m = recording.range_m(set, row, column).unwrap_or(1.0);
            let offset_m = recording.sets[set].phase_offset_rad / TAU * unambiguous_m;
            (true_m - offset_m + 0.9 * pixel as f64 + error_m(set)).rem_euclid(unambiguous_m)
        };
        (0..SETS * 8).map(range_m).collect()
    }

    #[test]
    fn a_perfect_camera_with_pixel_delays_has_no_error() {
        let recording = recording(Kind::Rail);
        let errors = range_errors(&recording, &measured_m(&recording, |_| 0.0), &[true; SETS * 8]).unwrap();
        assert_eq!(
            errors.pixels.count,
            (SETS - 1) * 7,
            "without the set of unknown position and the masked pixel"
        );
        assert_eq!((errors.error_m[3 * 8], errors.set_mean_m[3], errors.error_m[6]), (None, None, None));
        assert!(errors.pixels.max_abs < 1e-12 && errors.set_means.max_abs < 1e-12);
    }

    #[test]
    fn a_constant_of_each_velocity_is_removed_in_motion_only() {
        for (kind, expected_m) in [(Kind::Rail, 0.02), (Kind::Motion, 0.0)] {
            let recording = recording(kind);
            let by_velocity = |set: usize| 0.04 * recording.sets[set].velocity_m_s;
            let errors =
                range_errors(&recording, &measured_m(&recording, by_velocity), &[true; SETS * 8]).unwrap();
            assert!((errors.set_means.rms - expected_m).abs() < 1e-4, "{kind}: {:?}", errors.set_means);
        }
    }

    #[test]
    fn invalid_pixels_do_not_count() {
        let recording = recording(Kind::Rail);
        let mut range_m = measured_m(&recording, |_| 0.0);
        range_m[16] = 1e3;
        range_m[17] = f64::NAN;
        let mut valid = vec![true; SETS * 8];
        valid[16] = false;
        let errors = range_errors(&recording, &range_m, &valid).unwrap();
        assert_eq!((errors.error_m[16], errors.error_m[17]), (None, None));
        assert!(errors.pixels.max_abs < 1e-12);
        assert!(range_errors(&recording, &range_m, &[false; SETS * 8]).is_err());
    }

    #[test]
    fn what_has_no_range_is_refused_with_the_reason() {
        let range_m = vec![0.0; SETS * 8];
        let valid = vec![true; SETS * 8];
        let dark = recording(Kind::Dark);
        assert!(range_errors(&dark, &range_m, &valid).unwrap_err().to_string().contains("without light"));
        let blind = Recording { camera: None, ..recording(Kind::Rail) };
        assert!(range_errors(&blind, &range_m, &valid).unwrap_err().to_string().contains("camera.toml"));
        assert!(range_errors(&blind, &range_m[1..], &valid).unwrap_err().to_string().contains("not those"));
        let mut lost = recording(Kind::Rail);
        lost.sets.iter_mut().for_each(|row| row.position_m = None);
        assert!(range_errors(&lost, &range_m, &valid).unwrap_err().to_string().contains("position"));
    }
}
