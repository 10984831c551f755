//! Error statistics in integers: they merge exactly, in any order.

use super::exact_angle::UNIT_BITS;

/// Errors are squared in units of 2^−48 turn (rounded), so that 2³³ vectors, each half a turn wrong, fit 128 bits.
pub(super) const SQUARE_UNIT_BITS: u32 = 48;
const SQUARE_DROP_BITS: u32 = UNIT_BITS - SQUARE_UNIT_BITS;

/// The vector with the largest error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Worst {
    /// Its error in units of 2^−56 turn.
    pub error: i64,
    /// Its coordinates.
    pub x: i64,
    /// Its coordinates.
    pub y: i64,
}

impl Worst {
    /// A total order, so that merging knows no order: the larger error, then the shorter vector, then the larger x, then y.
    fn rank(&self) -> (u64, i64, i64, i64) {
        (self.error.unsigned_abs(), -(self.x.abs().max(self.y.abs())), self.x, self.y)
    }
}

/// Errors of vectors of one octave of the amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct OctaveTally {
    /// Vectors.
    pub vectors: u64,
    /// Of these, less than one phase code off.
    pub faithful: u64,
    /// Of these, at most half a phase code off.
    pub correctly_rounded: u64,
    /// Sum of the errors in units of 2^−56 turn.
    pub sum: i128,
    /// The same with the sign in which the octant counts: towards its diagonal is positive. What a fold hides from the mean.
    pub octant_sum: i128,
    /// Sum of the squared errors in units of 2^−96 turn².
    pub squares: u128,
    /// The worst vector.
    pub worst: Option<Worst>,
}

impl OctaveTally {
    /// Adds one vector.
    #[inline]
    pub(super) fn add(&mut self, (x, y): (i64, i64), error: i64, backwards: bool, below: [bool; 2]) {
        self.vectors += 1;
        self.faithful += u64::from(below[0]);
        self.correctly_rounded += u64::from(below[1]);
        self.sum += i128::from(error);
        self.octant_sum += i128::from(if backwards { -error } else { error });
        let coarse = (error + (1 << (SQUARE_DROP_BITS - 1))) >> SQUARE_DROP_BITS;
        self.squares += (i128::from(coarse) * i128::from(coarse)) as u128;
        if self.worst.is_none_or(|worst| error.unsigned_abs() >= worst.error.unsigned_abs()) {
            self.take_worst(Worst { error, x, y });
        }
    }

    fn take_worst(&mut self, other: Worst) {
        if self.worst.is_none_or(|worst| other.rank() > worst.rank()) {
            self.worst = Some(other);
        }
    }

    /// Adds what another part found.
    pub fn merge(&mut self, other: &Self) {
        self.vectors += other.vectors;
        self.faithful += other.faithful;
        self.correctly_rounded += other.correctly_rounded;
        self.sum += other.sum;
        self.octant_sum += other.octant_sum;
        self.squares += other.squares;
        if let Some(worst) = other.worst {
            self.take_worst(worst);
        }
    }
}

/// Errors by octave: octave k holds the vectors of length 2^k up to (excluding) 2^(k+1).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tally {
    /// Vectors of which none is preferred: all, or drawn evenly. Mean, RMS and shares are theirs.
    pub even: Vec<OctaveTally>,
    /// Vectors chosen because they are awkward; only maximum and faithfulness count them.
    pub corners: Vec<OctaveTally>,
}

impl Tally {
    /// Room for octaves 0 to `octaves` − 1.
    pub fn new(octaves: usize) -> Self {
        let empty = vec![OctaveTally::default(); octaves];
        Self { even: empty.clone(), corners: empty }
    }

    /// Adds what another part found (of the same number of octaves; surplus ones are appended).
    #[must_use]
    pub fn merged(mut self, other: &Self) -> Self {
        for (own, others) in [(&mut self.even, &other.even), (&mut self.corners, &other.corners)] {
            own.resize(own.len().max(others.len()), OctaveTally::default());
            for (octave, other) in own.iter_mut().zip(others) {
                octave.merge(other);
            }
        }
        self
    }

    /// Everything in one.
    pub fn overall(&self) -> (OctaveTally, OctaveTally) {
        let total = |octaves: &[OctaveTally]| {
            octaves.iter().fold(OctaveTally::default(), |mut total, octave| {
                total.merge(octave);
                total
            })
        };
        (total(&self.even), total(&self.corners))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tally(errors: &[(i64, i64, i64)]) -> OctaveTally {
        let mut tally = OctaveTally::default();
        for &(x, y, error) in errors {
            tally.add((x, y), error, x * y < 0, [error.abs() < 1000, error.abs() < 500]);
        }
        tally
    }

    #[test]
    fn sums_by_hand() {
        let tally = tally(&[(1, 2, 256), (3, -4, -512), (5, 6, 700)]);
        assert_eq!((tally.vectors, tally.faithful, tally.correctly_rounded), (3, 3, 1));
        assert_eq!((tally.sum, tally.octant_sum), (444, 256 + 512 + 700));
        // 1, −2 and round(2.73) = 3 units of 2^-48 turn.
        assert_eq!(tally.squares, 1 + 4 + 9);
        assert_eq!(tally.worst, Some(Worst { error: 700, x: 5, y: 6 }));
    }

    #[test]
    fn merging_knows_no_order_and_equal_errors_have_one_worst() {
        let all = [(1, 2, 9), (-3, 1, -9), (3, 1, 9), (2, 2, 8), (3, -1, 9)];
        let whole = tally(&all);
        assert_eq!(whole.worst, Some(Worst { error: 9, x: 1, y: 2 }));
        for cut in 0..=all.len() {
            let (one, other) = (tally(&all[..cut]), tally(&all[cut..]));
            let (mut forwards, mut backwards) = (one, other);
            forwards.merge(&other);
            backwards.merge(&one);
            assert_eq!((forwards, backwards), (whole, whole));
        }
    }
}
