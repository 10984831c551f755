//! What light brought in the frame before, where chains that look back have just made that one: it is not made again.

use crate::physics::{Before, Chain, Moment, PerPixel};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What came in, DN, by the numbers of chains: in the frame that is made just now, and in the one before it in the same set, if that was made last.
#[derive(Debug, Default)]
pub struct Arrived {
    /// The recording, and the frame's number in it.
    frame: Option<(usize, usize)>,
    now: BTreeMap<usize, PerPixel>,
    before: BTreeMap<usize, PerPixel>,
}

impl Arrived {
    /// Goes on to frame `index` of recording `take`, which is taken at `moment`.
    pub fn turn_to(&mut self, take: usize, index: usize, moment: Moment) {
        let follows =
            moment.frame > 0 && self.frame.is_some_and(|(of, last)| (of, last + 1) == (take, index));
        let last = std::mem::take(&mut self.now);
        self.before = if follows { last } else { BTreeMap::new() };
        self.frame = Some((take, index));
    }

    /// What came in before, by the `chain` of this `number`: in one of the frames at `moments`, which are one within a set.
    pub fn before(&self, number: usize, chain: &Chain, moments: [Moment; 3]) -> Arc<Before> {
        let Some(dn) = self.before.get(&number) else { return chain.remember(moments, &[]) };
        let [evenly_dn, again_dn, kept_dn] = [(); 3].map(|()| dn.clone());
        Arc::new(Before { evenly_dn, again_dn, kept_dn, rested_s: 0.0 })
    }

    /// Keeps what came in just now by the chain of this `number`.
    pub fn keep(&mut self, number: usize, dn: PerPixel) {
        self.now.insert(number, dn);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::Data;
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::diagnose::tangents::acting::Acting;
    use crate::diagnose::tangents::columns::Tangents;
    use crate::diagnose::tangents::pieces::Piece;
    use crate::frames::Geometry;

    /// What a column is in a frame.
    fn of_column(acting: &Acting, number: usize) -> Vec<f64> {
        let share = acting.shares.iter().find(|share| share.column == number).unwrap();
        acting.patterns[share.pattern].iter().map(|value| share.factor * value).collect()
    }

    /// A frame after those before it is what it is alone, at the beginning of a set and within, whatever was made in between.
    #[test]
    fn what_came_in_before_is_what_would_have_come() {
        let recordings =
            taken(Geometry { width: 6, height: 4 }, 2, &[], &["four-motion", "wdft-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let pixels = unfitted(&data, stated_noise(&data)).pixels;
        let [mut lag, mut drift] = ["image_lag", "phase_drift"].map(|name| Piece::off(name, &[0], &[0, 1]));
        (lag.values[0], drift.values[0]) = (0.05, 0.02);
        let (tangents, _) = Tangents::new(&data, &pixels, &[lag, drift], &[]);
        let mut arrived = Arrived::default();
        let (mut looked_at, mut held) = (0, 0);
        for (take, index) in [(0, 3), (0, 4), (0, 5), (1, 5), (1, 6), (1, 7), (1, 8), (0, 9), (0, 11)] {
            let after = tangents.frame(take, index, &mut arrived);
            held += usize::from(!arrived.before.is_empty());
            let alone = tangents.frame(take, index, &mut Arrived::default());
            let columns = |number: usize| [&after, &alone].map(|frame| of_column(&frame.columns, number));
            let all = (0..4).map(|number| [after.own[number].clone(), alone.own[number].clone()]);
            for [after, alone] in
                all.chain((0..2).map(columns)).chain([[after.position.clone(), alone.position.clone()]])
            {
                let most = alone.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6 * most;
                assert!(most > 0.0 && after.iter().zip(&alone).all(is_near), "{take} {index}");
                looked_at += 1;
            }
            assert!(after.base.iter().zip(&*alone.base).all(|(a, b)| (a - b).abs() < 1e-9));
        }
        // Of nine frames four follow one that was made just before, in the same set.
        assert_eq!((looked_at, held), (63, 4));
    }
}
