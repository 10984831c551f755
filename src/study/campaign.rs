//! Which campaign an effect is studied in: not every one shows every effect.

use crate::bench::{Plan, practice_camera, taken_by};
use crate::frames::Geometry;
use crate::physics::{Active, FREQUENCY_HZ};
use crate::problem::Result;
use crate::recording::Recording;

/// What is recorded, and what the camera's description says.
#[derive(Debug, PartialEq)]
pub struct Campaign {
    /// What is particular about it, after "in campaigns"; nothing of the usual one.
    pub what: &'static str,
    /// The effects that are studied in it; all others in the usual one.
    pub shows: &'static [&'static str],
    /// Recordings.
    recordings: &'static [&'static str],
    /// Modulation frequencies, Hz: all recordings are taken at each.
    frequencies_hz: &'static [f64],
    /// Whether the camera's simulation includes what a moving target does.
    includes_motion: bool,
}

const RECORDINGS: &[&str] =
    &["four-sweep", "four-rail", "four-motion", "wdft-sweep", "wdft-rail", "wdft-motion"];

/// The usual campaign, of everything that none of the [others](OTHERS) is for.
pub static USUAL: Campaign = Campaign {
    what: "",
    shows: &[],
    recordings: RECORDINGS,
    frequencies_hz: &[FREQUENCY_HZ],
    includes_motion: true,
};

/// Campaigns that show what the usual one cannot: what the camera's simulation includes there, what one modulation frequency leaves to
/// the pixels' own phases, and what is asked of one place alone.
pub static OTHERS: [Campaign; 3] = [
    Campaign {
        what: "whose camera says nothing of motion",
        shows: &["axial_motion", "inverse_square_falloff"],
        includes_motion: false,
        ..USUAL
    },
    Campaign {
        what: "of two modulation frequencies",
        shows: &["demodulation_skew"],
        recordings: &["four-sweep", "four-rail", "wdft-rail"],
        frequencies_hz: &[FREQUENCY_HZ, 0.6 * FREQUENCY_HZ],
        ..USUAL
    },
    Campaign {
        what: "of a target at one place (two sweeps)",
        shows: &["response_decay"],
        recordings: &["four-sweep", "wdft-sweep"],
        ..USUAL
    },
];

impl Campaign {
    /// The one that shows the effect called `name`.
    pub fn of(name: &str) -> &'static Self {
        OTHERS.iter().find(|campaign| campaign.shows.contains(&name)).unwrap_or(&USUAL)
    }

    /// Its recordings with `effects`, of so many pixels; scene, noise and encoder drawn by `seed`.
    ///
    /// # Errors
    /// A campaign that cannot be made.
    pub fn taken(&self, size: Geometry, seed: u64, effects: &[Active]) -> Result<Vec<Recording>> {
        let mut camera = practice_camera(size);
        if !self.includes_motion {
            camera.included_physics.clear();
        }
        let plan = |&frequency_hz: &f64| Plan { frequency_hz, ..Plan::usual(seed) };
        let plans: Vec<Plan> = self.frequencies_hz.iter().map(plan).collect();
        taken_by(&camera, &plans, effects, self.recordings)
    }
}
