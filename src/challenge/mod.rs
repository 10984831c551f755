//! Blind challenges: campaigns with concealed effects from the generator in the [`time_domain`](mod@crate::time_domain), their labels
//! sealed, and answers judged by the labels.

mod case;
mod draw;
mod judge;
mod label;
mod limit;
mod score;
mod seal;
mod simpler;
mod summary;
mod table;
mod tally;
mod truth;
mod words;

pub use case::{Case, CaseKind, drawn};
pub use judge::{Answer, Asserted, Estimate, HeldOut, Located, Outcome, judge, judge_names};
pub use label::{Hidden, Label};
pub use score::{Calibration, Judged, PROBABILITIES, Scored, scored};
pub use seal::{LabelFile, Seal, SealFile, SealedLabel, entropy, hexadecimal, opened, sealed};
pub use simpler::{METHODS, Simpler};
pub use summary::summary;
pub use table::table;
pub use tally::{STRENGTHS, Tallies, Tally};
pub use truth::{Truth, truths};
