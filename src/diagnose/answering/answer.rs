//! The answer as other programs read it, `vuris-verdict/1`: its fields, in the order of its file.

use crate::diagnose::unseen::held_out_row::HeldOutRow;
use serde::Serialize;
use serde_json::Value;

/// The answer. Probabilities are between 0 and 1; strengths that are not finite are written as null.
#[derive(Debug, Clone, Serialize)]
pub struct Answer {
    /// `vuris-verdict/1`.
    pub format: &'static str,
    /// `clean`, `explained`, `partly_explained` or `unexplained`.
    pub verdict: &'static str,
    /// How likely recordings and simulation differ by more than noise.
    pub probability_of_mismatch: f64,
    /// Where they differ, most significant first; empty where the verdict is `clean`.
    pub located: Vec<LocatedRow>,
    /// The effects that are asserted, most significant first.
    pub effects: Vec<EffectRow>,
    /// The other effects that these recordings could show, and what speaks against each; what comes nearest first.
    pub ruled_out: Vec<RuledOut>,
    /// The fit on sets that it has not seen.
    pub held_out: HeldOutRow,
    /// What the asserted effects leave.
    pub remainder: Remainder,
    /// Recordings that would tell apart what these cannot.
    pub next_recording: Vec<NextRecording>,
    /// Effects that these recordings cannot show at all.
    pub invisible: Vec<Invisible>,
    /// Of every effect that they can show, the strength that they would have shown.
    pub smallest_detectable: Vec<Smallest>,
    /// What the answer was made from: recordings, samples, noise, the search.
    pub provenance: Value,
}

/// A coordinate over which recordings and simulation differ.
#[derive(Debug, Clone, Serialize)]
pub struct LocatedRow {
    /// `phase`, `position_m`, `velocity_m_s`, `frame`, `time_s`, `row`, `column`, `code`, `amplitude`, `set`, `encoder` or `neighbours`.
    pub coordinate: &'static str,
    /// The recording in which it shows most.
    pub recording: String,
    /// Cycles, slope, step, period, or where.
    pub shape: String,
    /// How likely noise shows as much in any shape that was looked for; 0 where that is less than 1e-308.
    pub p: f64,
    /// Its part of the residual, root of the mean square over all samples, DN.
    pub rms_dn: f64,
}

/// An effect that is asserted.
#[derive(Debug, Clone, Serialize)]
pub struct EffectRow {
    /// Its name in the registry, or in the user's library.
    pub name: &'static str,
    /// What it is, in a sentence.
    pub sentence: String,
    /// How likely it is this effect.
    pub probability: f64,
    /// How likely it is something that nobody has written down, which looks like it; a part of what `probability` leaves.
    pub alias_risk: f64,
    /// Effects from which these recordings cannot tell it.
    pub also_possible: Vec<String>,
    /// Its fitted numbers.
    pub parameters: Vec<ParameterRow>,
    /// What speaks for it.
    pub evidence: EvidenceRow,
}

/// A fitted number of an effect.
#[derive(Debug, Clone, Serialize)]
pub struct ParameterRow {
    /// Its name, and in brackets its recordings, where recordings have numbers of their own.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// Its standard deviation; 0 where it is a choice, or was not fitted.
    pub sigma: f64,
    /// The unit of both; `1` where they have none.
    pub unit: &'static str,
    /// Whether the value came to the end of what it may be.
    pub at_bound: bool,
}

/// What speaks for an effect.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct EvidenceRow {
    /// By how much chi squared falls with it, beside the effects that were found before it.
    pub delta_chi2: f64,
    /// By so many numbers.
    pub degrees_of_freedom: usize,
    /// Logarithm of the Bayes factor for it, nats.
    pub ln_bayes_factor: f64,
    /// Root of what chi squared falls by beyond its degrees of freedom: its strength, in standard deviations of all recordings.
    pub detectability_rho: f64,
}

/// An effect that is not asserted.
#[derive(Debug, Clone, Serialize)]
pub struct RuledOut {
    /// Its name.
    pub name: &'static str,
    /// What speaks against it.
    pub by: String,
    /// What it would explain alone, as a share of all that is explained or stands out; 0 where it has no trace.
    pub share: f64,
    /// Whether the search had found it, and it is not believed.
    #[serde(skip)]
    pub is_refused: bool,
}

/// What the asserted effects leave.
#[derive(Debug, Clone, Serialize)]
pub struct Remainder {
    /// As a share of the mismatch.
    pub share: f64,
    /// The coordinate over which most of it is; nothing where nothing stands out.
    pub coordinate: Option<&'static str>,
}

/// A recording that would tell effects apart.
#[derive(Debug, Clone, Serialize)]
pub struct NextRecording {
    /// The names of both.
    pub to_separate: Vec<String>,
    /// What to record.
    pub what: String,
    /// By how many standard deviations it would tell them apart.
    pub expected_rho: f64,
}

/// An effect that these recordings cannot show.
#[derive(Debug, Clone, Serialize)]
pub struct Invisible {
    /// Its name.
    pub name: &'static str,
    /// Why.
    pub why: String,
}

/// The strength of an effect that 95 of 100 recordings like these would have shown.
#[derive(Debug, Clone, Serialize)]
pub struct Smallest {
    /// The effect's name.
    pub name: &'static str,
    /// The name of its number.
    pub parameter: &'static str,
    /// The number's distance from where the effect is off.
    pub value: f64,
    /// Its unit; `1` where it has none.
    pub unit: &'static str,
}

/// To as many digits as are worth reading.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
