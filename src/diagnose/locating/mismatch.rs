//! Where recordings and a model differ: the coordinates that stand out, and the errors that samples share at random.

use super::location::{Kind, LOCATED_NATS, Located, Location};
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::described::{coordinate, words};
use crate::diagnose::shared_errors::random::{self, ORDERED_SHARE, deflated, errors};

/// Where a mismatch lives.
#[derive(Debug, Clone)]
pub struct Place {
    /// Coordinate of the verdict.
    pub coordinate: &'static str,
    /// What stands out, in words.
    pub shape: String,
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// Chi squared that it explains, and by how many numbers.
    pub chi2: (f64, usize),
    /// Among how many it is the greatest.
    pub looked: f64,
    /// The recording that shows it most; of columns, the one with the greatest misfit.
    pub take: usize,
    /// Whether samples share it at random.
    pub is_random: bool,
}

impl Place {
    /// What it explains of chi squared, but for what that many numbers do by chance.
    pub fn excess(&self) -> f64 {
        self.chi2.0 - self.chi2.1 as f64
    }

    /// Puts it where its evidence belongs among `places`, of which random ones give way to what orders them.
    pub fn join(self, places: &mut Vec<Self>) {
        let share = |place: &Self| if place.is_random { ORDERED_SHARE } else { 1.0 };
        let at = places.iter().position(|place| share(place) * place.ln_bayes < self.ln_bayes);
        places.insert(at.unwrap_or(places.len()), self);
    }
}

/// Coordinates that stand out, most significant first.
pub fn places(data: &Data, location: &Location) -> Vec<Place> {
    // What noise shares makes more of columns than noise that nothing shares.
    let inflation = random::noise(data, location).map_or(1.0, |noise| noise.inflation);
    let stands_out = |located: &&Located| {
        // Waves are measured by what noise there is.
        let inflation = if located.kind == Kind::Wave { 1.0 } else { inflation };
        deflated(inflation, located.ln_bayes, located.chi2.0) > LOCATED_NATS
    };
    let columns = location.columns.iter().filter(stands_out);
    let mut places: Vec<Place> = columns
        .map(|located| Place {
            coordinate: located.coordinate,
            shape: located.shape.clone(),
            ln_bayes: located.ln_bayes,
            chi2: located.chi2,
            looked: located.looked,
            take: location.take,
            is_random: false,
        })
        .collect();
    let ordered = places.first().map_or(0.0, |place| place.ln_bayes);
    if let Some(cluster) = errors(data, location).first() {
        let place = Place {
            coordinate: coordinate(cluster),
            shape: words(cluster),
            ln_bayes: cluster.ln_bayes,
            chi2: (2.0 * cluster.ln_bayes, 1),
            looked: 1.0,
            take: cluster.take,
            is_random: true,
        };
        match ordered > ORDERED_SHARE * cluster.ln_bayes {
            true => places.push(place),
            false => places.insert(0, place),
        }
    }
    places
}
