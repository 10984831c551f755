//! Fits of several effects of which one is to be chosen: what a part of the sets speaks against clearly is not fitted to all.

use super::pass::DISBELIEF;
use super::tolerated::tolerance;
use crate::diagnose::fitting::fit::{End, Fit, Led, WHOLE, fit, fit_led, fit_until};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::fitting::watchdog::ENOUGH;
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::pieces::Piece;
use rayon::prelude::*;

/// One set in so many of each recording is looked at first: no multiple of how often positions are repeated, as a rule.
const PART: usize = 7;
/// So many samples at least: fewer are fitted in no time.
const LEAST_SAMPLES: usize = 50_000;
/// What the best one explains of the part, but for what its form may leave, must be more by this chi squared: a part does not say
/// exactly what all sets say.
const CLEARLY_LESS: f64 = 100.0;
/// What a further step would take away of what is left of a part is known without taking it, where it is less than this.
const PART_ENOUGH: f64 = 0.1 * CLEARLY_LESS;
/// Of what a fit explains, so much says nothing of whether it is the best one: a step that takes away less is not taken at first.
const ROUGH: f64 = 1e-3;
/// A rough fit that explains less than the best one by so many times that may still turn out to be that.
const NEAR: f64 = 20.0;
/// A way of an effect that explains more of the part by this chi squared, by no more numbers, is the better one of the same form.
const ANOTHER_WAY: f64 = 10.0;
/// Ways that are at the same place but for this, with the pixels' own numbers settled, count as one that comes to the same end.
const SAME_END: f64 = 0.5;
/// What numbers explain by chance, in standard deviations, at most.
const BY_CHANCE: f64 = 3.0;

/// One of several: what it is known by, its effect, and all pieces of a fit with it.
pub struct Entrant {
    /// Number of its block.
    pub block: usize,
    /// Its effect's name.
    pub name: &'static str,
    /// Pieces of the fit.
    pub pieces: Vec<Piece>,
    /// Where a part of the sets led it.
    pub led: Option<Led>,
}

/// Those of the `entrants` that may explain about as much of what `current` leaves as the best one, as they fit the part: most of the way has been gone
/// there. The first, the best by its tangents, stays.
pub fn hopeful(data: &Data, current: &Fit, entrants: Vec<Entrant>, noise: Noise) -> Vec<Entrant> {
    if entrants.len() < 2 || current.samples / PART < LEAST_SAMPLES {
        return entrants;
    }
    let sets = data.sets();
    let of_part = |pieces: &[Piece], share_of: (f64, f64)| {
        let is_in = |set: usize| sets[set].1.is_multiple_of(PART);
        let end = End { enough: PART_ENOUGH, share_of, ..WHOLE };
        fit_until(data, current, pieces.to_vec(), noise, &is_in, end)
    };
    let before = of_part(&current.pieces, WHOLE.share_of);
    let of_entrant = |entrant: &Entrant| of_part(&entrant.pieces, (ROUGH, before.left()));
    let fits: Vec<Fit> = entrants.par_iter().map(of_entrant).collect();
    let explained = |left: &dyn Fn(&Fit) -> f64, (entrant, fit): (&Entrant, &Fit)| {
        let numbers = fit.columns.len().saturating_sub(before.columns.len()) as f64;
        let all = left(&before) - left(fit);
        let no_chance = all - numbers - BY_CHANCE * (2.0 * numbers).sqrt();
        Explained {
            name: entrant.name,
            numbers: fit.columns.len(),
            all,
            unreached: fit.unreached,
            no_chance,
            form: tolerance(entrant.name),
        }
    };
    let stay = |left: &dyn Fn(&Fit) -> f64| {
        staying(&entrants.iter().zip(&fits).map(|both| explained(left, both)).collect::<Vec<_>>())
    };
    let mut stays = stay(&|fit| fit.counted() + fit.unreached);
    if before.is_far() {
        // What takes residuals from many standard deviations to a few explains next to nothing of what counts.
        stays.iter_mut().zip(stay(&Fit::left)).for_each(|(stays, by_all)| *stays |= by_all);
    }
    let end = |(entrant, fit): (Entrant, Fit)| Entrant { led: Some((fit.pixels, fit.pieces)), ..entrant };
    entrants.into_iter().zip(fits).zip(stays).filter(|(_, stays)| *stays).map(|(both, _)| end(both)).collect()
}

/// Fits of the `entrants` to all sets, each with the number of its block: roughly, and those to their ends that may turn out to be the best one or as good, but for
/// what forms may leave.
pub fn fitted(data: &Data, current: &Fit, entrants: Vec<Entrant>, noise: Noise) -> Vec<(usize, Fit)> {
    let rough = End { share_of: (ROUGH, current.left()), ..WHOLE };
    let of_entrant = |Entrant { block, pieces, led, .. }: Entrant| {
        (block, fit_led(data, current, pieces, led, noise, rough))
    };
    let fits: Vec<(usize, Fit)> = entrants.into_par_iter().map(of_entrant).collect();
    let least = fits.iter().map(|(_, fit)| fit.left()).fold(f64::INFINITY, f64::min);
    let may_be_best = |fit: &Fit| fit.left() < least + NEAR * ROUGH * (current.left() - least);
    let to_its_end = |(block, rough): (usize, Fit)| match rough.unreached > ENOUGH && may_be_best(&rough) {
        true => (block, fit(data, Some(&rough), rough.pieces.clone(), noise, &|_| true)),
        false => (block, rough),
    };
    fits.into_par_iter().map(to_its_end).collect()
}

/// What an entrant explains of a part of the sets, chi squared, and by how many numbers.
struct Explained {
    name: &'static str,
    numbers: usize,
    all: f64,
    /// Of that, what is no chance.
    no_chance: f64,
    /// What a further step promises, and counts against it there.
    unreached: f64,
    /// The share that its form may leave.
    form: f64,
}

/// Which stay, of which the first one does in any case.
fn staying(explained: &[Explained]) -> Vec<bool> {
    let numbers = explained.iter().filter(|explained| explained.no_chance.is_finite());
    let best = numbers.max_by(|a, b| a.no_chance.total_cmp(&b.no_chance));
    let (most, form_of_best) = best.map_or((0.0, 0.0), |best| (best.no_chance, best.form));
    let is_hopeful = |explained: &Explained| {
        let form = DISBELIEF * explained.form.max(form_of_best);
        explained.all > (1.0 - form) * most - CLEARLY_LESS
    };
    // Another way of the same effect has the same form, and may come to the same end.
    let is_another = |number: usize, this: &Explained, other: usize, way: &Explained| {
        let more = way.all - this.all;
        let ends = (way.all + way.unreached) - (this.all + this.unreached);
        // Ways that are still under way need not be as near.
        let known_to = (0.1 * this.unreached.max(way.unreached)).clamp(SAME_END, ANOTHER_WAY);
        let is_same = ends.abs() <= known_to && other < number;
        let is_ahead = is_same || more - this.unreached > ANOTHER_WAY;
        other != number && way.name == this.name && way.numbers <= this.numbers && is_ahead
    };
    let stays = |(number, this): (usize, &Explained)| {
        let mut ways = explained.iter().enumerate();
        number == 0 || is_hopeful(this) && !ways.any(|(other, way)| is_another(number, this, other, way))
    };
    explained.iter().enumerate().map(stays).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{injection, taken};
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::reading::data::Data;
    use crate::diagnose::stated_noise;
    use crate::frames::Geometry;
    use crate::physics::effects::multipath_interference::{SHARE, WALL};

    /// Light by way of a wall, far above the noise: of what comes from afar to where it explains all, the last steps count; of what never will, they do not.
    #[test]
    fn what_may_be_the_best_one_is_fitted_to_its_end() {
        is_fitted_to_its_end(&["0.2", "0.7"]);
    }

    #[test]
    #[ignore = "minutes: make slow"]
    fn so_is_it_between_these() {
        is_fitted_to_its_end(&["0.35", "0.5"]);
    }

    fn is_fitted_to_its_end(shares: &[&str]) {
        for share in shares {
            let size = Geometry { width: 16, height: 12 };
            let truth = format!("multipath_interference:relative_amplitude={share},wall_distance_m=0.7");
            let recordings = taken(size, 2, &[injection(&truth).unwrap()], &["four-rail"]).unwrap();
            let data = Data::of(&recordings, Vec::new()).unwrap();
            let noise = stated_noise(&data);
            let baseline = unfitted(&data, noise);
            let entrant = |block, name, free: &[usize]| Entrant {
                block,
                name,
                pieces: vec![Piece::off(name, free, &[0])],
                led: None,
            };
            let entrants = || {
                let mut wall = entrant(3, "multipath_interference", &[SHARE, WALL]);
                wall.pieces[0].values[WALL] = 0.2;
                vec![wall, entrant(5, "image_lag", &[0]), entrant(8, "phase_step_scale", &[0])]
            };
            let fits = fitted(&data, &baseline, entrants(), noise);
            assert_eq!(fits.iter().map(|(block, _)| *block).collect::<Vec<_>>(), [3, 5, 8]);
            let explained = baseline.left() - fits[0].1.left();
            let unreached = fits[0].1.unreached;
            assert!(explained > 5e3 && unreached < ENOUGH, "{share}: {explained}, {unreached}");
            for (entrant, (_, found)) in entrants().into_iter().zip(&fits) {
                let whole = fit(&data, Some(&baseline), entrant.pieces, noise, &|_| true);
                // From afar one way may end short of where a second one leads.
                let more = found.left() - whole.left();
                assert!(more < 2.0 * ROUGH * explained, "{}: {more}", entrant.name);
            }
        }
    }

    #[test]
    fn what_a_part_speaks_against_clearly_goes_but_for_the_first() {
        let of = |all: f64, no_chance: f64, form: f64| {
            // Another effect each.
            let name = String::leak(format!("{all} {form}"));
            Explained { name, numbers: 5, all, unreached: 0.0, no_chance, form }
        };
        let exact = |all: f64| of(all, all - 5.0, 0.01);
        assert_eq!(staying(&[]), [false; 0]);
        // The best one has its 5 by chance; of 2000 a form of one per cent may leave three times that, and a part says chi squared to 100.
        assert_eq!(
            staying(&[exact(1.0), exact(2005.0), exact(1841.0), exact(1839.0)]),
            [true, true, true, false]
        );
        // A looser form may leave more, be it the best one's or its own.
        assert_eq!(staying(&[exact(2005.0), of(1700.0, 1695.0, 0.08)]), [true, true]);
        assert_eq!(staying(&[of(2005.0, 2000.0, 0.08), exact(1700.0)]), [true, true]);
        assert_eq!(staying(&[exact(2005.0), exact(1700.0)]), [true, false]);
        // A fit that is no number is not the best one, nor hopeful.
        assert_eq!(staying(&[exact(1.0), of(f64::NAN, f64::NAN, 0.01), exact(1e3)]), [true, false, true]);
    }

    #[test]
    fn of_an_effect_the_best_way_stays() {
        let way = |name, numbers, all: f64, unreached| Explained {
            name,
            numbers,
            all,
            unreached,
            no_chance: all,
            form: 0.08,
        };
        // Another effect, the best way, one that comes to where that is, one that explains less by fewer numbers.
        let mut ways = vec![
            way("b", 3, 1900.0, 0.0),
            way("a", 3, 2005.4, 0.0),
            way("a", 3, 2005.2, 0.0),
            way("a", 2, 1990.0, 0.0),
        ];
        assert_eq!(staying(&ways), [true, true, false, true]);
        // The first one stays in any case; what explains a little less may explain more of all.
        ways.swap(0, 3);
        ways[2].all = 1996.0;
        assert_eq!(staying(&ways), [true, true, true, true]);
        ways[2].all = 1995.0;
        assert_eq!(staying(&ways), [true, true, false, true]);
        // One that is still on its way may end above, at the same, or below.
        for (unreached, stays) in [(14.0, true), (11.0, false), (9.0, true), (1.0, false)] {
            ways[2] = way("a", 3, 1994.0, unreached);
            assert_eq!(staying(&ways), [true, true, stays, true], "{unreached}");
        }
    }
}
