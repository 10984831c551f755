//! `vuris diagnose` on campaigns of one kind of recordings: what others would tell is not known then, and is not made up.

mod diagnosed;

use diagnosed::{names, simulated, verdict};
use serde_json::Value;

/// What is said of a small campaign, simulated with these `options`.
fn verdict_of(options: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let own = ["--size", "16x12", "--seed", "7"];
    verdict(&simulated(folder.path().join("campaign"), &[&own[..], options].concat()))
}

/// Half of the samples predict the other half, wherever the sets are: at many places, at one, at three with all sets of each in a row.
#[test]
fn a_clean_recording_of_any_kind_agrees_with_itself() {
    for kind in ["four-sweep", "four-rail", "wdft-rail", "four-motion", "harmonics"] {
        let verdict = verdict_of(&["--recordings", kind]);
        assert_eq!(verdict["verdict"], "clean", "{kind}: {verdict:#}");
        let [chi2, rms_dn] =
            ["chi2_per_dof_before", "rms_dn_before"].map(|key| verdict["held_out"][key].as_f64().unwrap());
        // The noise is that of 12 electrons a DN of some 450 DN, and 3 DN.
        assert!((chi2 - 1.0).abs() < 0.05 && rms_dn < 10.0, "{kind}: {chi2}, {rms_dn} DN");
    }
}

/// At one place nothing tells the constant part of the camera's own light from ambient light. What changes one of them is named nevertheless, however they share.
#[test]
fn at_one_place_what_changes_the_light_is_named() {
    for ratio in ["1.25", "2.2", "3"] {
        for effect in ["illumination_droop", "illumination_drift", "frame_gain"] {
            let verdict =
                verdict_of(&["--recordings", "four-sweep", "--constant-ratio", ratio, "--effect", effect]);
            assert_eq!(names(&verdict), [effect], "{ratio}: {verdict:#}");
        }
    }
}
