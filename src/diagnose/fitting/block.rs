//! Columns that are solved together: their sums over whitened frames.

use super::gram::Whitened;
use super::products::products;
use super::set_errors::{self, Jitter};
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::acting::{Acting, Share};
use crate::diagnose::tangents::columns::OWN;
use crate::widest::widest;
use nalgebra::DMatrix;
use pulp::{Simd, WithSimd};

/// Columns that are solved together, and, last, the residual.
#[derive(Debug, Clone)]
pub struct Block {
    /// G' W G, its lower triangle.
    pub full: DMatrix<f64>,
    /// The pixels' own numbers against columns and residual: (4 x pixels) x (columns + 1), number after number.
    pub mixed: DMatrix<f64>,
    /// A set's errors against columns and residual.
    pub errors: Vec<DMatrix<f64>>,
    /// What is to be added to `mixed`: patterns times each of the pixels' own numbers, and which column has them.
    waiting: Waiting,
}

/// What waits for others: frames that have a column are added to its sums together.
#[derive(Debug, Clone, Default)]
struct Waiting {
    /// A value a pixel of each pattern, frame after frame; how many of these numbers there are, and room for more.
    values: Vec<f32>,
    used: usize,
    /// The pixels' own numbers in each frame.
    own: Vec<f32>,
    /// What columns have of the patterns, and in which frame these are.
    shares: Vec<(Share, usize)>,
}

/// One frame, whitened: a value a pixel each.
pub struct Rows<'a> {
    /// By the pixel's own numbers.
    pub own: [Vec<f64>; OWN],
    /// The same in single precision, number after number.
    pub own_single: Vec<f32>,
    /// By the errors that samples share: the set's position, and what the frame has for itself.
    pub errors: Vec<Vec<f64>>,
    /// Root of the weight.
    pub roots: &'a [f64],
    /// Residual.
    pub residual: &'a [f64],
}

impl<'a> Rows<'a> {
    /// Those of a frame, where frames are off by a `jitter`.
    pub fn of(data: &Data, whitened: &Whitened<'a>, jitter: Jitter) -> Self {
        let Whitened { frame, roots, residual, .. } = *whitened;
        let times = |values: &[f64]| {
            let mut products = vec![0.0; roots.len()];
            let all = &mut products[..];
            widest!((all: &'a mut [f64], roots: &'a [f64], values: &'a [f64]) {
                for ((product, root), value) in all.iter_mut().zip(roots).zip(values) {
                    *product = root * value;
                }
            });
            products
        };
        let mut own = frame.own.each_ref().map(|own| times(own));
        // A background never moves: as long as the light is on, its constant light is ambient light.
        for (pixel, constant) in own[2].iter_mut().enumerate() {
            if !data.tells_constant(pixel) {
                *constant = 0.0;
            }
        }
        let errors = set_errors::tangents(jitter, whitened, &own, times(&frame.position));
        Self { own_single: single(&own), own, errors, roots, residual }
    }
}

/// All of the pixels' `own` numbers, number after number.
fn single(own: &[Vec<f64>; OWN]) -> Vec<f32> {
    let mut all = Vec::with_capacity(own.iter().map(Vec::len).sum());
    own.iter().for_each(|own| all.extend(own.iter().map(|&own| own as f32)));
    all
}

/// So many numbers may wait for their columns.
const WAITING: usize = 1 << 17;

impl Block {
    /// Without any frame, for so many `columns` and `sets`.
    pub fn empty(pixels: usize, columns: usize, sets: usize) -> Self {
        Self {
            full: DMatrix::zeros(columns + 1, columns + 1),
            mixed: DMatrix::zeros(OWN * pixels, columns + 1),
            errors: vec![DMatrix::zeros(0, 0); sets],
            waiting: Waiting::default(),
        }
    }

    /// With the frames of another, of other sets; neither has any that wait.
    pub fn join(&mut self, other: Self) {
        self.full += other.full;
        self.mixed += other.mixed;
        for (a, b) in self.errors.iter_mut().zip(other.errors) {
            if a.is_empty() {
                *a = b;
            }
        }
    }

    /// With `rows` of a frame of number `set`, whose errors stand at `places` among those of the set, in which the columns `shared` act, and `own` ones that
    /// are counted from `first` on.
    ///
    /// Shares come column after column. Products are made in single precision, of a frame with itself, and of a few frames with the pixels' own numbers, and
    /// then summed in double: what each of them rounds off is another.
    pub fn add(
        &mut self,
        set: usize,
        places: &[usize],
        rows: &Rows,
        shared: &Acting,
        own: &Acting,
        first: usize,
    ) {
        let (pixels, last) = (rows.roots.len(), self.full.nrows() - 1);
        // The patterns, the residual, and the errors.
        let before = shared.patterns.len();
        let residual = before + own.patterns.len();
        let (errors, end) = (residual + 1, residual + 1 + places.len());
        let waits = self.waiting.used;
        if self.waiting.values.len() < waits + pixels * end {
            self.waiting.values.resize(WAITING + pixels * end, 0.0);
        }
        let values = &mut self.waiting.values[waits..waits + pixels * end];
        let patterns = shared.patterns.iter().chain(&own.patterns);
        let mut sizes = vec![1.0; end];
        for ((values, size), pattern) in values.chunks_exact_mut(pixels).zip(&mut sizes).zip(patterns) {
            debug_assert_eq!(pattern.len(), pixels);
            *size = times(rows.roots, pattern, values);
        }
        let of_errors = rows.errors.iter().map(|error| &error[..]);
        let last_rows = values[pixels * residual..].chunks_exact_mut(pixels);
        for (values, of) in last_rows.zip(std::iter::once(rows.residual).chain(of_errors)) {
            values.iter_mut().zip(of).for_each(|(value, &of)| *value = of as f32);
        }
        let product = products(values, pixels);
        let own = own.shares.iter().map(|share| share.after(first, before));
        let of_residual = Share { column: last, pattern: residual, factor: 1.0 };
        let shares = shared.shares.iter().copied().chain(own).chain([of_residual]);
        let sized = |share: Share| Share { factor: share.factor * sizes[share.pattern], ..share };
        let shares: Vec<Share> = shares.map(sized).collect();
        debug_assert!(shares.is_sorted_by_key(|share| share.column));
        let columns: Vec<&[Share]> = shares.chunk_by(|a, b| a.column == b.column).collect();
        let mut with = vec![0.0; end];
        for (place, of) in columns.iter().enumerate() {
            let column = of[0].column;
            with.fill(0.0);
            for share in *of {
                let products = product.row(share.pattern);
                let products = products.to_slice().expect("a row is a slice");
                let (with, factor) = (&mut with[..], share.factor);
                widest!((with: &'a mut [f64], products: &'a [f32], factor: f64) {
                    for (sum, &value) in with.iter_mut().zip(products) {
                        *sum += factor * f64::from(value);
                    }
                });
            }
            for (&place, with) in places.iter().zip(&with[errors..]) {
                self.errors[set][(place, column)] += with;
            }
            let mut sums = self.full.column_mut(column);
            let sums = sums.as_mut_slice();
            for share in columns[place..].iter().copied().flatten() {
                sums[share.column] += share.factor * with[share.pattern];
            }
        }
        // The errors do not wait.
        self.wait(rows, errors, &shares);
    }

    /// What a frame adds to `mixed` waits for that of others: its `shares` of so many `patterns`, whose values stand behind those that wait.
    fn wait(&mut self, rows: &Rows, patterns: usize, shares: &[Share]) {
        let Waiting { used, own, shares: with, .. } = &mut self.waiting;
        let pixels = rows.roots.len();
        let (frame, before) = (own.len() / rows.own_single.len(), *used / pixels);
        *used += pixels * patterns;
        own.extend_from_slice(&rows.own_single);
        with.extend(shares.iter().map(|share| (share.after(0, before), frame)));
        if *used > WAITING {
            self.settle();
        }
    }

    /// Adds what waits: no frame is to come, or there is too much.
    pub fn settle(&mut self) {
        let Waiting { values, used, own, shares } = &mut self.waiting;
        shares.sort_by_key(|(share, _)| share.column);
        let mut sum = vec![0.0_f32; self.mixed.nrows()];
        for of in shares.chunk_by(|(a, _), (b, _)| a.column == b.column) {
            let mut sums = self.mixed.column_mut(of[0].0.column);
            pulp::Arch::new().dispatch(Add { of, values, own, sum: &mut sum, sums: sums.as_mut_slice() });
        }
        *used = 0;
        own.clear();
        shares.clear();
    }
}

/// Sizes of patterns that are squared and summed in single precision as they are.
const SIZES: std::ops::Range<f64> = 1e-9..1e9;

/// Products of the roots with a pattern, in single precision, over the size that is given back: 1 where single precision knows such numbers well.
fn times(roots: &[f64], pattern: &[f64], product: &mut [f32]) -> f64 {
    let mut greatest = [0.0; LANES];
    {
        let greatest = &mut greatest;
        widest!((greatest: &'a mut [f64; LANES], pattern: &'a [f64]) {
            for values in pattern.chunks(LANES) {
                for (greatest, value) in greatest.iter_mut().zip(values) {
                    *greatest = if value.abs() > *greatest { value.abs() } else { *greatest };
                }
            }
        });
    }
    let greatest = greatest.into_iter().fold(0.0, f64::max);
    let size = if greatest == 0.0 || SIZES.contains(&greatest) { 1.0 } else { greatest };
    let per = size.recip();
    widest!((product: &'a mut [f32], roots: &'a [f64], pattern: &'a [f64], per: f64) {
        for ((product, root), value) in product.iter_mut().zip(roots).zip(pattern) {
            *product = (root * value * per) as f32;
        }
    });
    size
}

/// Maxima that are looked for side by side.
const LANES: usize = 16;

/// Adds what a column has of patterns, times the pixels' own numbers, to its sums. Fused where the machine can, but for what does not fill a register.
struct Add<'a> {
    of: &'a [(Share, usize)],
    values: &'a [f32],
    own: &'a [f32],
    sum: &'a mut [f32],
    sums: &'a mut [f64],
}

impl<'a> WithSimd for Add<'a> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { of, values, own, sum, sums } = self;
        let pixels = sum.len() / OWN;
        let mut parts = Vec::with_capacity(of.len());
        let count = pixels / S::F32_LANES;
        for (share, frame) in of {
            let value = &values[pixels * share.pattern..pixels * (share.pattern + 1)];
            let numbers = &own[pixels * OWN * frame..pixels * OWN * (frame + 1)];
            let mut wide = [&S::as_simd_f32s(value).0[..count]; OWN];
            for (wide, row) in wide.iter_mut().zip(numbers.chunks_exact(pixels)) {
                *wide = &S::as_simd_f32s(row).0[..count];
            }
            let factor = simd.splat_f32s(share.factor as f32);
            parts.push((factor, &S::as_simd_f32s(value).0[..count], wide));
        }
        for at in 0..count {
            let mut all = [simd.splat_f32s(0.0); OWN];
            for (factor, value, own) in &parts {
                let value = simd.mul_f32s(*factor, value[at]);
                for number in 0..OWN {
                    all[number] = simd.mul_add_e_f32s(value, own[number][at], all[number]);
                }
            }
            for (sum, all) in sum.chunks_exact_mut(pixels).zip(all) {
                S::as_mut_simd_f32s(sum).0[at] = all;
            }
        }
        // What does not fill a register.
        for pixel in count * S::F32_LANES..pixels {
            for (number, sum) in sum.chunks_exact_mut(pixels).enumerate() {
                sum[pixel] = 0.0;
                for (share, frame) in of {
                    let value = share.factor as f32 * values[pixels * share.pattern + pixel];
                    sum[pixel] += value * own[pixels * (OWN * frame + number) + pixel];
                }
            }
        }
        for (sums, sum) in sums.iter_mut().zip(&*sum) {
            *sums += f64::from(*sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const PIXELS: usize = 37;

    fn draws(seed: u64) -> Vec<f64> {
        Draws::of(seed, 3).normal(PIXELS)
    }

    /// Columns that share two patterns, and `many` others that have their own, in frames of two sets: the sums are those of the columns written out, but for
    /// rounding. One of the patterns is `large`.
    fn is_written_out(many: usize, large: f64) {
        let (first, count) = (2, 4 + many);
        let mut block = Block::empty(PIXELS, count, 2);
        let (mut full, mut mixed) =
            (DMatrix::<f64>::zeros(count + 1, count + 1), DMatrix::<f64>::zeros(OWN * PIXELS, count + 1));
        let mut position = vec![DMatrix::<f64>::zeros(1, count + 1); 2];
        for frame in 0..FRAMES {
            let seed = |n: usize| draws(1000 * frame as u64 + n as u64);
            let (roots, residual) = (seed(1).iter().map(|v| v.abs()).collect::<Vec<_>>(), seed(2));
            let own_rows = [seed(3), seed(4), seed(5), seed(6)];
            let rows = Rows {
                own_single: single(&own_rows),
                own: own_rows,
                errors: vec![seed(7)],
                roots: &roots,
                residual: &residual,
            };
            let (mut shared, mut own) = (Acting::default(), Acting::default());
            let [a, b, c] = [8, 9, 10].map(seed);
            let c: Vec<f64> = c.iter().map(|c| large * c).collect();
            let others: Vec<Vec<f64>> = (0..many).map(|n| seed(11 + n)).collect();
            shared.column(1, a.clone());
            let (of_b, of_c) = (own.pattern(b.clone()), own.pattern(c.clone()));
            own.share(0, of_b, 2.0);
            own.share(0, of_c, -0.5 / large);
            own.share(1, of_b, frame as f64);
            for (number, other) in others.iter().enumerate() {
                own.column(2 + number, other.clone());
            }
            let set = frame % 2;
            block.errors[set].resize_mut(1, count + 1, 0.0);
            block.add(set, &[0], &rows, &shared, &own, first);
            let sum =
                |of: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..PIXELS).map(|p| roots[p] * of(p)).collect() };
            let mut columns = vec![
                (1, sum(&|p| a[p])),
                (2, sum(&|p| 2.0 * b[p] - 0.5 / large * c[p])),
                (3, sum(&|p| frame as f64 * b[p])),
                (count, residual.clone()),
            ];
            columns.extend(others.iter().enumerate().map(|(n, other)| (4 + n, sum(&|p| other[p]))));
            for (number, column) in &columns {
                for (other, with) in &columns {
                    full[(*number, *other)] += column.iter().zip(with).map(|(x, y)| x * y).sum::<f64>();
                }
                position[set][(0, *number)] +=
                    column.iter().zip(&rows.errors[0]).map(|(x, y)| x * y).sum::<f64>();
                for (place, own) in rows.own.iter().flatten().enumerate() {
                    mixed[(place, *number)] += own * column[place % PIXELS];
                }
            }
        }
        block.settle();
        let Waiting { used, own, shares, .. } = &block.waiting;
        assert!(*used == 0 && own.is_empty() && shares.is_empty());
        assert!((&block.full - full.lower_triangle()).amax() < ROUNDING * full.amax(), "{many}");
        assert!((&block.mixed - &mixed).amax() < ROUNDING * mixed.amax(), "{many}");
        let is_same = |(a, b): (&DMatrix<f64>, &DMatrix<f64>)| (a - b).amax() < ROUNDING * b.amax();
        assert!(block.errors.iter().zip(&position).all(is_same), "{many}");
        assert!(full.amax() > 1.0 && block.full.column(0).amax() == 0.0);
    }

    const FRAMES: usize = 40;
    const ROUNDING: f64 = 2e-6;

    /// Few rows, some, and more than a panel has; and more frames than wait for each other.
    #[test]
    fn shares_of_patterns_are_columns_written_out() {
        for many in [1, 15, 150] {
            is_written_out(many, 1.0);
        }
        const { assert!(FRAMES * 150 * PIXELS > WAITING) }
    }

    #[test]
    fn a_parameter_may_have_any_unit() {
        for large in [1e-30, 1e25] {
            is_written_out(1, large);
        }
        // Whichever pixel shows it.
        for place in [0, 17, PIXELS - 1] {
            let (mut pattern, mut product) = (vec![0.0; PIXELS], vec![f32::NAN; PIXELS]);
            pattern[place] = -1e25;
            let size = times(&[2.0; PIXELS], &pattern, &mut product);
            assert_eq!((size, product[place]), (1e25, -2.0));
            assert!(product.iter().enumerate().all(|(pixel, value)| pixel == place || *value == 0.0));
        }
    }
}
