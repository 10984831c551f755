//! Blind challenges: campaigns with concealed effects from the generator in the [`time_domain`](mod@crate::time_domain), their labels
//! sealed, and answers judged by the labels.

mod case;
mod draw;
mod judge;
mod label;
mod limit;
mod score;
mod seal;
mod table;

pub use case::{Case, CaseKind, drawn};
pub use judge::{Answer, Asserted, HeldOut, Located, Outcome, judge};
pub use label::{Hidden, Label};
pub use score::{Calibration, Judged, PROBABILITIES, STRENGTHS, Scored, Tally, scored};
pub use seal::{LabelFile, Seal, SealFile, SealedLabel, entropy, opened, sealed};
pub use table::{summary, table};
