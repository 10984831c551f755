//! Whether a coordinate is a simpler answer than the effects that were named.

use crate::diagnose::locating::location::{Kind, LOCATED_NATS, Located};
use crate::diagnose::naming::candidates::OF_OTHER_PIXELS;
use crate::diagnose::naming::found::{Found, Named};
use crate::diagnose::naming::pass::RIVAL_NATS;
use crate::diagnose::naming::tolerated::tolerated;
use crate::diagnose::periodic::lamps::FLICKER;
use crate::diagnose::statistics::evidence::tail;
use crate::diagnose::tangents::pieces::Piece;

/// What an effect's freedom costs, nats, where its evidence is taken from its fit.
pub const OCCAM_NATS: f64 = 10.0;
/// What is less probable than this is no question of noise.
const OF_NOISE: f64 = 1e-100;
/// Noise brings what a coordinate shows clearly more rarely where its probability is less by this factor: a nat.
const RARER: f64 = 0.37;
/// So much of chi squared is seen at the end, if it is left: columns of a strong effect promise more than there is, and at the baseline readings seem to scatter more.
const SEEN: f64 = 100.0;
/// Of it, so much.
const LEFT: f64 = 0.5;

/// What the effects that were named say together.
#[derive(Debug, Clone, Copy)]
pub struct Names {
    /// How many they are.
    count: usize,
    /// Evidence, nats.
    ln_bayes: f64,
    /// How many numbers they have, but for shapes.
    numbers: usize,
    /// Chi squared that they would explain if their forms were exact, and by how many numbers, shapes among them.
    at_most: (f64, usize),
    /// Whether one of them is a flicker.
    flickers: bool,
    /// Whether the first one is what other pixels do.
    is_of_other_pixels: bool,
    /// Columns that are those of the only name: a coordinate, and the way of being off.
    own: Option<(&'static str, &'static str)>,
}

/// Effects with a number for each frame of a set, of which each is what some columns are: these say nothing else. Coordinate, and way of being off.
pub const COLUMNS: [(&str, (&str, &str)); 2] =
    [("phase_step_errors", ("frame", "phase")), ("frame_gain", ("frame", "gain"))];

/// What so many numbers explain besides chance.
fn excess((chi2, numbers): (f64, usize)) -> f64 {
    chi2 - numbers as f64
}

impl Names {
    /// Of the effects `named`, of those that were `found`, which explain so much of chi squared, and so `many` times what their forms may leave counts as theirs;
    /// nothing where none is named.
    pub fn of(found: &Found, named: &[Named], explained: f64, many: f64) -> Option<Self> {
        let first = named.first()?;
        let mut evidences: Vec<f64> = named.iter().map(|named| named.ln_bayes).collect();
        // Of two that were found together it is that of both.
        evidences.dedup();
        // Columns are tangents: what one name promises by its own counts as much as what its fit keeps.
        let alone = if let [single] = named { found.alone(single.name) } else { None };
        // A fit may keep more than tangents promise. What the freedom of one name costs is known.
        let cost = alone.map_or(0.0, |alone| 0.5 * alone.chi2 - alone.ln_bayes);
        let kept = 0.5 * explained - cost.max(OCCAM_NATS * named.len() as f64);
        let (promised, promised_chi2) = alone.map_or((0.0, 0.0), |alone| (alone.ln_bayes, alone.chi2));
        let is_named = |piece: &&Piece| named.iter().any(|named| named.name == piece.effect.name);
        let shapes: usize = found.fit.pieces.iter().filter(is_named).map(Piece::shapes).sum();
        let numbers = named.iter().map(|named| named.score.1).sum();
        Some(Self {
            count: named.len(),
            ln_bayes: evidences.iter().sum::<f64>().max(kept).max(promised),
            numbers,
            at_most: (explained.max(promised_chi2) + many * tolerated(named), numbers + shapes),
            flickers: named.iter().any(|named| named.name == FLICKER),
            is_of_other_pixels: OF_OTHER_PIXELS.contains(&first.name),
            own: alone.and_then(|alone| {
                COLUMNS.iter().find(|(name, _)| *name == alone.name).map(|(_, columns)| *columns)
            }),
        })
    }

    /// Whether one coordinate at the baseline, or one of its ways of being off, says about as much as the names together: it is the simpler answer, whatever
    /// makes it.
    ///
    /// A name must say more than that by a nat, and each further one by as much as it must by than a rival; and noise must not bring what the coordinate
    /// shows clearly more rarely than what the names explain, and their forms may leave. Columns that explain no more, and are no fewer numbers, are only
    /// another form of the names. Nor do columns that promise clearly more than the names explain, of which less than half is left at the `end`, where that is known.
    pub fn are_outvoted(&self, baseline: &[Located], end: Option<&[Located]>) -> bool {
        let more = |coordinate: &Located| excess(coordinate.chi2) - excess((self.at_most.0, self.numbers));
        let is_there = |coordinate: &Located| {
            let Some(end) = end else { return true };
            let same = end.iter().filter(|other| other.coordinate == coordinate.coordinate);
            let left = same.map(|other| excess(other.chi2)).fold(0.0, f64::max);
            more(coordinate) < SEEN || left > LEFT * more(coordinate)
        };
        baseline.iter().any(|coordinate| self.are_outvoted_by(coordinate) && is_there(coordinate))
    }

    fn are_outvoted_by(&self, coordinate: &Located) -> bool {
        let is_own =
            |(of, way): (&str, &str)| coordinate.coordinate == of && coordinate.shape.starts_with(way);
        // As long as the name says as much as they do, but for what rivals may differ by: other ways of being off may be among them.
        if self.own.is_some_and(is_own) && coordinate.chi2.0 <= self.at_most.0 + 2.0 * RIVAL_NATS {
            return false;
        }
        // What is said of neighbours is what those effects do, roughly.
        if coordinate.coordinate == "neighbours" && self.is_of_other_pixels {
            return false;
        }
        let ((chi2, columns), numbers) = (coordinate.chi2, self.numbers);
        // Tangents of a strong effect promise more than there is, and its form may leave something.
        // That the target is not where it is said to be is no other form of anything: a reading that comes late is as likely as what is named. Nor is another way in which the same frame is off.
        let is_other = columns < numbers
            || coordinate.kind == Kind::Place && columns <= numbers
            || self.own.is_some_and(|own| own.0 == coordinate.coordinate) && columns <= numbers
            || excess((chi2, columns)) > excess((self.at_most.0, numbers)) + 2.0 * RIVAL_NATS;
        // A flicker swings.
        let is_swing = coordinate.kind == Kind::Wave && matches!(coordinate.coordinate, "time_s" | "set");
        let says_more = match self.flickers && is_swing {
            true => coordinate.ln_bayes > self.ln_bayes + RIVAL_NATS,
            false => {
                let least = self.ln_bayes - 1.0 - RIVAL_NATS * (self.count as f64 - 1.0);
                // What their freedom costs aside. Of either about as many were looked at.
                let by_names = tail(self.at_most.0, self.at_most.1);
                let is_rarer =
                    by_names > OF_NOISE && coordinate.looked * tail(chi2, columns) < RARER * by_names;
                is_rarer || coordinate.ln_bayes > least
            }
        };
        is_other && says_more && coordinate.ln_bayes > LOCATED_NATS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn located(coordinate: &'static str, ln_bayes: f64, chi2: (f64, usize), looked: f64) -> Located {
        let kind = if looked > 1.0 { Kind::Wave } else { Kind::Columns };
        Located { coordinate, shape: String::new(), ln_bayes, chi2, looked, kind }
    }

    const NAMES: Names = Names {
        count: 1,
        ln_bayes: 20.0,
        numbers: 6,
        at_most: (57.0, 6),
        flickers: false,
        is_of_other_pixels: false,
        own: None,
    };

    fn outvotes(names: Names, coordinate: &'static str, ln_bayes: f64, chi2: (f64, usize)) -> bool {
        names.are_outvoted_by(&located(coordinate, ln_bayes, chi2, 1.0))
    }

    #[test]
    fn columns_that_say_as_much_by_fewer_numbers_outvote_a_name() {
        assert!(outvotes(NAMES, "phase", 19.5, (50.0, 5)));
        assert!(!outvotes(NAMES, "phase", 18.5, (50.0, 5)));
        // By no fewer numbers they are another form of it, but if they explain more.
        assert!(!outvotes(NAMES, "phase", 19.5, (57.0, 6)));
        assert!(outvotes(NAMES, "phase", 19.5, (70.0, 6)));
        // Or as much as its form may leave.
        assert!(!outvotes(Names { at_most: (65.0, 6), ..NAMES }, "phase", 19.5, (70.0, 6)));
        // Of two names each must be needed.
        assert!(outvotes(Names { count: 2, ..NAMES }, "phase", 17.0, (45.0, 5)));
    }

    /// Chi squared of 57 by 6 numbers has the probability 1.8e-10, of 46 by 2 1.0e-10, and of 47 by 1 and by 2 7e-12 and 6e-11 (tables of the distribution).
    #[test]
    fn columns_that_noise_brings_more_rarely_outvote_a_name() {
        assert!(outvotes(NAMES, "phase", 8.0, (47.0, 1)));
        assert!(outvotes(NAMES, "phase", 8.0, (47.0, 2)));
        // About as rarely.
        assert!(!outvotes(NAMES, "phase", 8.0, (46.0, 2)));
        // That is among many, or not clear.
        assert!(!NAMES.are_outvoted_by(&located("code", 8.0, (47.0, 1), 100.0)));
        assert!(!outvotes(NAMES, "phase", 3.0, (47.0, 1)));
        // The name's tangents promise more than its fit keeps, or its form may leave as much.
        assert!(!outvotes(Names { at_most: (60.0, 6), ..NAMES }, "phase", 8.0, (47.0, 2)));
        // A shape more, and it is a nat less.
        assert!(outvotes(Names { at_most: (57.0, 7), ..NAMES }, "phase", 8.0, (46.0, 2)));
        // What is far from noise is no question of it.
        let strong = Names { ln_bayes: 4000.0, at_most: (8e3, 6), ..NAMES };
        assert!(!outvotes(strong, "phase", 3000.0, (8e3 + 7.0, 2)));
    }

    /// By as many numbers it is another form of nothing.
    #[test]
    fn a_place_that_is_off_outvotes_what_says_no_more() {
        let single = Names { numbers: 1, at_most: (57.0, 1), ..NAMES };
        let of = |kind: Kind, ln_bayes: f64, columns: usize| {
            let coordinate = located("velocity_m_s", ln_bayes, (56.0, columns), 1.0);
            single.are_outvoted_by(&Located { kind, ..coordinate })
        };
        assert!(of(Kind::Place, 19.5, 1) && !of(Kind::Columns, 19.5, 1));
        assert!(!of(Kind::Place, 18.5, 1) && !of(Kind::Place, 19.5, 2));
    }

    #[test]
    fn an_effect_is_not_outvoted_by_its_own_columns() {
        let named = |shape: &str, own| {
            let coordinate = Located { shape: shape.to_owned(), ..located("frame", 30.0, (57.0, 1), 1.0) };
            Names { own, ..NAMES }.are_outvoted_by(&coordinate)
        };
        let of_phase = Some(("frame", "phase"));
        assert!(named("phase, frame 3 of 4", None));
        assert!(!named("phase, frame 3 of 4", of_phase));
        assert!(named("gain, frame 3 of 4", of_phase));
        // What the columns' own variance of the readings makes of it is no more.
        let hardly_more =
            Located { shape: "phase, frame 3 of 4".to_owned(), ..located("frame", 30.0, (58.0, 1), 1.0) };
        assert!(!Names { own: of_phase, ..NAMES }.are_outvoted_by(&hardly_more));
        // They explain more than it does: not by its phases alone.
        let all =
            Located { shape: "phase, frame 3 of 4".to_owned(), ..located("frame", 40.0, (90.0, 5), 1.0) };
        assert!(Names { own: of_phase, ..NAMES }.are_outvoted_by(&all));
        assert!(outvotes(Names { own: of_phase, ..NAMES }, "time_s", 30.0, (60.0, 1)));
    }

    /// Of an axial motion that takes 97 172 of chi squared the velocity's columns promised 1200 more, and the fit left nothing.
    #[test]
    fn what_columns_promise_beyond_the_names_must_be_left() {
        let names = Names { ln_bayes: 48_000.0, numbers: 1, at_most: (97_200.0, 1), ..NAMES };
        let outvoted = |chi2: f64, left: f64| {
            let of = |coordinate, chi2| located(coordinate, 0.5 * chi2, (chi2, 12), 1.0);
            let end = [of("row", 2000.0), of("velocity_m_s", left)];
            names.are_outvoted(&[of("velocity_m_s", chi2)], Some(&end))
        };
        assert!(outvoted(98_400.0, 700.0) && !outvoted(98_400.0, 500.0) && !outvoted(98_400.0, 5.0));
        assert!(names.are_outvoted(&[located("velocity_m_s", 49_000.0, (98_400.0, 12), 1.0)], None));
        // So little may hide.
        assert!(outvoted(97_290.0, 5.0));
    }

    #[test]
    fn neighbours_and_swings_say_what_effects_do() {
        let of_neighbours = Names { is_of_other_pixels: true, ..NAMES };
        assert!(outvotes(NAMES, "neighbours", 30.0, (60.0, 1)));
        assert!(!outvotes(of_neighbours, "neighbours", 30.0, (60.0, 1)));
        let flicker = Names { flickers: true, ..NAMES };
        let swings = |ln_bayes: f64| flicker.are_outvoted_by(&located("time_s", ln_bayes, (90.0, 2), 50.0));
        assert!(!swings(22.0) && swings(24.0));
    }
}
