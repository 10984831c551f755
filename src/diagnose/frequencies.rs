//! The modulation frequencies of recordings.

use super::data::Take;
use std::collections::BTreeMap;

/// A modulation frequency: what differs by less than a millionth is one.
#[derive(Debug, Clone, Copy)]
pub struct Frequency {
    /// As it is, Hz.
    pub hz: f64,
    /// To a millionth.
    number: i64,
}

impl PartialEq for Frequency {
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number
    }
}

impl Frequency {
    /// A recording's; none without the camera's light.
    pub fn of(take: &Take) -> Option<Self> {
        let lit = take.moments.iter().find(|moment| moment.lit)?;
        let hz = lit.frequency_hz;
        Some(Self { hz, number: (1e6 * hz.ln()).round() as i64 })
    }
}

/// Those of several, each with its frames.
fn all(takes: &[Take]) -> Vec<(Frequency, usize)> {
    let mut frames = BTreeMap::<i64, (Frequency, usize)>::new();
    for take in takes {
        if let Some(frequency) = Frequency::of(take) {
            frames.entry(frequency.number).or_insert((frequency, 0)).1 += take.moments.len();
        }
    }
    frames.into_values().collect()
}

/// That of most frames, of several.
pub fn usual(takes: &[Take]) -> Option<Frequency> {
    let all = all(takes);
    all.iter().max_by_key(|(_, frames)| *frames).filter(|_| all.len() > 1).map(|(frequency, _)| *frequency)
}

/// All but that of most frames.
pub fn others(takes: &[Take]) -> Vec<Frequency> {
    let usual = usual(takes);
    let others = all(takes).into_iter().map(|(frequency, _)| frequency);
    others.filter(|frequency| usual.is_some_and(|usual| usual != *frequency)).collect()
}
