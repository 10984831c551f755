//! Where the encoder is read without its noise: sets of a target that stands still have one place.

use crate::physics::Moment;

/// Readings of one place are no further apart, m.
pub const APART_M: f64 = 1e-3;

/// Gives the frames of sets that stand at one place its mean reading.
///
/// An error that depends on the place would else depend on the reading's noise. Where all sets stand at the same phase of a periodic
/// error it would be proportional to that noise, which the frames do show, and so explain it.
pub fn with_places(mut moments: Vec<Moment>) -> Vec<Moment> {
    let mut still: Vec<usize> =
        (0..moments.len()).filter(|&frame| moments[frame].velocity_m_s == 0.0).collect();
    still.sort_by(|&a, &b| moments[a].position_m.total_cmp(&moments[b].position_m));
    let mut rest = &still[..];
    while let Some(&first) = rest.first() {
        let least_m = moments[first].position_m;
        let count = rest.iter().take_while(|&&frame| moments[frame].position_m <= least_m + APART_M).count();
        let (here, others) = rest.split_at(count.max(1));
        let place_m = here.iter().map(|&frame| moments[frame].position_m).sum::<f64>() / here.len() as f64;
        here.iter().for_each(|&frame| moments[frame].place_m = place_m);
        rest = others;
    }
    moments
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Plan;

    const SEED: u64 = 5;

    fn moments(name: &str) -> Vec<Moment> {
        let plan = Plan::usual(SEED);
        let mut course = plan.course(name).unwrap();
        course.sets = plan.as_read(&course, 0);
        with_places(course.moments())
    }

    #[test]
    fn sets_that_stand_together_have_one_place_and_others_keep_theirs() {
        // The rail's places are 50 mm apart, its readings some tenths of a millimetre off: the mean of the two at a place is closer.
        let rail = moments("four-rail");
        let off_m = |position_m: f64| (position_m / 0.05 - (position_m / 0.05).round()).abs() * 0.05;
        let mean = |of: &dyn Fn(&Moment) -> f64| {
            (rail.iter().map(|moment| off_m(of(moment)).powi(2)).sum::<f64>() / rail.len() as f64).sqrt()
        };
        let (read, place) = (mean(&|moment| moment.position_m), mean(&|moment| moment.place_m));
        assert!(read > 0.0 && place < 0.85 * read, "{place} m of {read} m");
        // The sweep's target stands at one place.
        let sweep = moments("four-sweep");
        assert!(sweep.iter().all(|moment| moment.place_m == sweep[0].place_m));
        assert!(sweep.iter().any(|moment| moment.position_m != sweep[0].position_m));
        let motion = moments("four-motion");
        assert!(motion.iter().all(|moment| moment.place_m == moment.position_m));
    }
}
