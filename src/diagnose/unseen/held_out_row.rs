//! What was held out, as other programs read it.

use super::held_out::HeldOut;
use super::seen::Agreement;
use serde::Serialize;
use serde_json::{Value, json};

/// Sets that were predicted by a fit which has not seen them: by the simulation that the camera describes, and with the effects that are asserted.
#[derive(Debug, Clone, Serialize)]
pub struct HeldOutRow {
    /// Chi squared a sample, before.
    pub chi2_per_dof_before: f64,
    /// The same, after.
    pub chi2_per_dof_after: f64,
    /// Residual of the raw frames, root of the mean square, DN, before.
    pub rms_dn_before: f64,
    /// The same, after.
    pub rms_dn_after: f64,
    /// Residual of the frames' means, root of the mean square, DN, before.
    pub frame_mean_rms_dn_before: f64,
    /// The same, after.
    pub frame_mean_rms_dn_after: f64,
    /// Error of a set's distance against the encoder, root of the mean square, m, before; null where no pixel sees a target at a known distance.
    pub distance_rms_m_before: f64,
    /// The same, after.
    pub distance_rms_m_after: f64,
    /// The improvement of the likelihood over its scatter from set to set.
    pub z: f64,
    /// Sets that were predicted.
    pub sets: usize,
    /// The same for sets of so many frames each, where there are several kinds.
    pub by_frames: Vec<Value>,
}

impl HeldOutRow {
    /// The row of what is `held_out`. What is not known, as distances where no pixel sees a target at one, is null there.
    pub fn of(held_out: &HeldOut) -> Self {
        let HeldOut { before, after, by_frames, z, sets } = held_out;
        let of_frames = |(frames, before, after): &(usize, Agreement, Agreement)| {
            json!({
                "frames": frames,
                "chi2_per_dof_before": before.chi2_per_dof, "chi2_per_dof_after": after.chi2_per_dof,
                "rms_dn_before": before.rms_dn, "rms_dn_after": after.rms_dn,
                "distance_rms_m_before": before.distance_rms_m, "distance_rms_m_after": after.distance_rms_m,
            })
        };
        Self {
            chi2_per_dof_before: before.chi2_per_dof,
            chi2_per_dof_after: after.chi2_per_dof,
            rms_dn_before: before.rms_dn,
            rms_dn_after: after.rms_dn,
            frame_mean_rms_dn_before: before.frame_mean_rms_dn,
            frame_mean_rms_dn_after: after.frame_mean_rms_dn,
            distance_rms_m_before: before.distance_rms_m,
            distance_rms_m_after: after.distance_rms_m,
            z: *z,
            sets: *sets,
            by_frames: by_frames.iter().map(of_frames).collect(),
        }
    }
}
