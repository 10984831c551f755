//! What the forms of effects that the description of a camera includes may leave.

use crate::diagnose::fitting::fit::{Fit, fit};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::locating::location::locate;
use crate::diagnose::locating::mismatch::{Place, places};
use crate::diagnose::naming::pass::DISBELIEF;
use crate::diagnose::naming::tolerated::tolerance;
use crate::diagnose::reading::data::Data;
use std::collections::{BTreeMap, BTreeSet};

/// What the effects that a camera includes explain, beside each other: their forms may leave a part of it, and that is no mismatch, as it is none where such an effect is
/// found.
#[derive(Debug, Clone, Default)]
pub struct Forms {
    /// Chi squared that they may leave in all.
    pub tolerated: f64,
    /// The same of each coordinate in which one stands out that is not included.
    of_coordinates: BTreeMap<&'static str, f64>,
}

impl Forms {
    /// Of the effects that the camera of `data` includes, whose simulation is the fit `baseline`.
    pub fn of(data: &Data, baseline: &Fit, noise: Noise) -> Self {
        let mut forms = Self::default();
        let included: BTreeSet<&str> =
            data.takes.iter().flat_map(|take| &take.included).map(|active| active.effect.name).collect();
        for name in included {
            let data = data.without_included(name);
            let without = fit(&data, Some(baseline), Vec::new(), noise, &|_| true);
            let explained = (without.counted() - baseline.counted()).max(0.0);
            forms.tolerated += tolerance(name) * explained;
            let mut most = BTreeMap::<&str, f64>::new();
            for place in places(&data, &locate(&data, &without, noise)) {
                let of_coordinate = most.entry(place.coordinate).or_default();
                *of_coordinate = of_coordinate.max(place.excess().min(explained));
            }
            for (coordinate, excess) in most {
                *forms.of_coordinates.entry(coordinate).or_default() += tolerance(name) * excess;
            }
        }
        forms
    }

    /// Whether what stands out at `place` is no more than they may leave there.
    pub fn may_leave(&self, place: &Place) -> bool {
        let tolerated = self.of_coordinates.get(place.coordinate).copied().unwrap_or(0.0);
        !place.is_random && place.excess() < DISBELIEF * tolerated
    }
}
