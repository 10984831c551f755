//! The modulation frequencies of recordings.

use super::data::Take;
use crate::physics::is_same_frequency;

/// A modulation frequency: what hardly differs is one.
#[derive(Debug, Clone, Copy)]
pub struct Frequency {
    /// As it is, Hz.
    pub hz: f64,
}

impl PartialEq for Frequency {
    fn eq(&self, other: &Self) -> bool {
        is_same_frequency(self.hz, other.hz)
    }
}

impl Frequency {
    /// A recording's; none without the camera's light.
    pub fn of(take: &Take) -> Option<Self> {
        let lit = take.moments.iter().find(|moment| moment.lit)?;
        Some(Self { hz: lit.frequency_hz })
    }
}

/// Those of several, each with its frames, the lowest first.
fn all(takes: &[Take]) -> Vec<(Frequency, usize)> {
    let mut all: Vec<(Frequency, usize)> = Vec::new();
    for take in takes {
        let frames = take.moments.len();
        match Frequency::of(take)
            .map(|frequency| (frequency, all.iter_mut().find(|(of, _)| *of == frequency)))
        {
            Some((_, Some((_, all)))) => *all += frames,
            Some((frequency, None)) => all.push((frequency, frames)),
            None => {}
        }
    }
    all.sort_by(|(a, _), (b, _)| a.hz.total_cmp(&b.hz));
    all
}

/// All that there are, the lowest first.
pub fn frequencies(takes: &[Take]) -> Vec<Frequency> {
    all(takes).into_iter().map(|(frequency, _)| frequency).collect()
}

/// That of most frames, of several.
pub fn usual(takes: &[Take]) -> Option<Frequency> {
    let all = all(takes);
    all.iter().max_by_key(|(_, frames)| *frames).filter(|_| all.len() > 1).map(|(frequency, _)| *frequency)
}

/// All but that of most frames.
pub fn others(takes: &[Take]) -> Vec<Frequency> {
    let usual = usual(takes);
    frequencies(takes)
        .into_iter()
        .filter(|frequency| usual.is_some_and(|usual| usual != *frequency))
        .collect()
}
