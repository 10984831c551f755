//! One pass over the data: the normal equations of all columns, with the pixels' own numbers projected out.

use super::acting::Acting;
use super::block::{Block, Rows};
use super::columns::{Frame, OWN, Tangents};
use super::data::Data;
use super::encoder_noise::jitter;
use nalgebra::{DMatrix, DVector, Matrix4, Vector4};
use rayon::prelude::*;

/// Sums over all samples, weighted by the noise.
#[derive(Debug, Clone)]
pub struct Gram {
    /// The pixels' own numbers against each other, J' W J: a value a pixel of each pair of them.
    own: Vec<Vec<f64>>,
    /// A set's position against itself.
    square: Vec<f64>,
    /// A set's position against the pixels' own numbers, number after number.
    position_own: Vec<Vec<f32>>,
    /// Columns that are solved together, each block by itself.
    blocks: Vec<Block>,
    /// Sum of squares of the whitened residual, and samples.
    pub chi2: f64,
    /// Samples that count.
    pub samples: usize,
    /// Sum of the logarithms of the noise's variance at the model's signal, over that at the measured one.
    ln_variance: f64,
}

/// What blocks have in a frame: the columns that act.
pub type Filled = Vec<Acting>;

/// Pairs of a pixel's own numbers.
const PAIRS: [(usize, usize); OWN * (OWN + 1) / 2] =
    [(0, 0), (0, 1), (0, 2), (0, 3), (1, 1), (1, 2), (1, 3), (2, 2), (2, 3), (3, 3)];

/// One frame, whitened.
pub struct Whitened<'a> {
    /// Recording, set (over all recordings) and frame within the recording.
    pub take: usize,
    /// Number of the set, over all recordings.
    pub set: usize,
    /// Number of the frame within the recording.
    pub index: usize,
    /// The model's signal and tangents, not whitened.
    pub frame: &'a Frame,
    /// Root of the weight of each pixel; 0 where the sample does not count.
    pub roots: &'a [f64],
    /// Residual over the noise.
    pub residual: &'a [f64],
}

/// Variance of the noise at a signal, DN².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Read noise and quantisation, DN².
    pub floor: f64,
    /// Shot noise, DN² a DN.
    pub slope: f64,
    /// Noise in proportion to the signal, relative, squared.
    pub square: f64,
}

impl Noise {
    /// One over the variance.
    #[inline(always)]
    pub fn weight(&self, signal_dn: f64) -> f64 {
        1.0 / self.variance(signal_dn)
    }

    #[inline(always)]
    fn variance(&self, signal_dn: f64) -> f64 {
        let signal_dn = signal_dn.max(0.0);
        self.floor + signal_dn * (self.slope + signal_dn * self.square)
    }

    /// Sum of the logarithms of the variance at the model's signals, whose weights have these `roots`, over that at the measured `signals`. A model whose
    /// signals are too great has too great a variance, and chi squared alone would prefer it.
    pub fn ln_variance(&self, signals: &[f32], roots: &[f64]) -> f64 {
        let ratio = |(&measured, &root): (&f32, &f64)| match root > 0.0 {
            true => root * root * self.variance(f64::from(measured)),
            false => 1.0,
        };
        let of_some =
            |(signals, roots): (&[f32], &[f64])| signals.iter().zip(roots).map(ratio).product::<f64>().ln();
        -signals.chunks(LOGARITHM).zip(roots.chunks(LOGARITHM)).map(of_some).sum::<f64>()
    }
}

/// So many ratios are multiplied before the logarithm is taken.
const LOGARITHM: usize = 8;
/// Sets are summed in so many chunks, of so many sets at least and at most.
const CHUNKS: usize = 16;
const CHUNK: (usize, usize) = (8, 64);
/// So many sets' positions are freed of the pixels' own numbers at a time.
const TOGETHER: usize = 64;
/// Residuals beyond so many standard deviations count as that many.
const WINSOR: f64 = 4.0;

/// Roots of the weights of a frame's pixels, 0 where a sample does not count, and the residual times them.
pub fn whiten(data: &Data, take: usize, index: usize, base: &[f64], noise: Noise) -> (Vec<f64>, Vec<f64>) {
    let pixels = data.pixels();
    let signal = &data.takes[take].signal_dn[index * pixels..(index + 1) * pixels];
    pulp::Arch::new().dispatch(|| {
        let root = |(measured, &base): (&f32, &f64)| {
            if measured.is_nan() { 0.0 } else { noise.weight(base).sqrt() }
        };
        let roots: Vec<f64> = signal.iter().zip(base).map(root).collect();
        let residual = |((&measured, base), root): ((&f32, &f64), &f64)| match *root == 0.0 {
            true => 0.0,
            // What is no number stays none.
            false => (root * (f64::from(measured) - base)).clamp(-WINSOR, WINSOR),
        };
        let residuals = signal.iter().zip(base).zip(&roots).map(residual).collect();
        (roots, residuals)
    })
}

impl Gram {
    fn empty(pixels: usize, columns: &[usize], sets: usize) -> Self {
        Self {
            own: vec![vec![0.0; pixels]; PAIRS.len()],
            square: vec![0.0; sets],
            position_own: vec![Vec::new(); sets],
            blocks: columns.iter().map(|&columns| Block::empty(pixels, columns, sets)).collect(),
            chi2: 0.0,
            samples: 0,
            ln_variance: 0.0,
        }
    }

    fn join(mut self, other: Self) -> Self {
        self.own.iter_mut().flatten().zip(other.own.iter().flatten()).for_each(|(a, b)| *a += b);
        self.square.iter_mut().zip(other.square).for_each(|(a, b)| *a += b);
        for (a, b) in self.position_own.iter_mut().zip(other.position_own) {
            if a.is_empty() {
                *a = b;
            }
        }
        self.blocks.iter_mut().zip(other.blocks).for_each(|(block, other)| block.join(other));
        self.chi2 += other.chi2;
        self.samples += other.samples;
        self.ln_variance += other.ln_variance;
        self
    }

    /// The pass over all sets of which `counts` (number of the set, over all recordings) is true, for the columns of `tangents` alone.
    pub fn of(
        data: &Data,
        tangents: &Tangents,
        noise: Noise,
        counts: &(dyn Fn(usize) -> bool + Sync),
    ) -> Self {
        Self::visited(data, tangents, noise, counts, &|(), _| (), &|(), ()| ()).0
    }

    /// The same; `visit` sees every whitened frame besides.
    pub fn visited<T: Default + Send>(
        data: &Data,
        tangents: &Tangents,
        noise: Noise,
        counts: &(dyn Fn(usize) -> bool + Sync),
        visit: &(dyn Fn(T, &Whitened) -> T + Sync),
        merge: &(dyn Fn(T, T) -> T + Sync),
    ) -> (Self, T) {
        let fill = |_: usize, _: usize, _: &Frame| vec![Acting::default()];
        Self::with_blocks(data, tangents, noise, counts, &[0], &fill, visit, merge)
    }

    /// The same for blocks of columns that each have the columns of `tangents` before their own, of which `fill` gives those that act in
    /// a frame (recording, frame); `visit` sees every whitened frame besides.
    #[allow(clippy::too_many_arguments)]
    pub fn with_blocks<T: Default + Send>(
        data: &Data,
        tangents: &Tangents,
        noise: Noise,
        counts: &(dyn Fn(usize) -> bool + Sync),
        columns: &[usize],
        fill: &(dyn Fn(usize, usize, &Frame) -> Filled + Sync),
        visit: &(dyn Fn(T, &Whitened) -> T + Sync),
        merge: &(dyn Fn(T, T) -> T + Sync),
    ) -> (Self, T) {
        let sets = data.sets();
        let columns: Vec<usize> = columns.iter().map(|columns| columns + tangents.count()).collect();
        let (pixels, count) = (data.pixels(), sets.len());
        // The same on every machine: what looks from set to set does not look from one chunk to the next.
        let chunk = sets.len().div_ceil(CHUNKS).clamp(CHUNK.0, CHUNK.1);
        let indexed: Vec<(usize, (usize, usize))> =
            sets.into_iter().enumerate().filter(|&(n, _)| counts(n)).collect();
        indexed
            .par_chunks(chunk)
            .map(|chunk| {
                let mut sums = Self::empty(pixels, &columns, count);
                let mut visited = T::default();
                for &(number, (take, set)) in chunk {
                    sums.position_own[number] = vec![0.0; OWN * pixels];
                    for (block, columns) in sums.blocks.iter_mut().zip(&columns) {
                        block.position[number] = DVector::zeros(columns + 1);
                    }
                    let frames = data.takes[take].frames;
                    for index in set * frames..(set + 1) * frames {
                        let frame = tangents.frame(take, index);
                        let (roots, residual) = whiten(data, take, index, &frame.base, noise);
                        let (roots, residual) = (&roots[..], &residual[..]);
                        let whitened = Whitened { take, set: number, index, frame: &frame, roots, residual };
                        visited = visit(visited, &whitened);
                        let measured = &data.takes[take].signal_dn[index * pixels..(index + 1) * pixels];
                        sums.ln_variance += noise.ln_variance(measured, roots);
                        sums.add(data, &whitened, &fill(take, index, &frame));
                    }
                }
                sums.blocks.iter_mut().for_each(Block::settle);
                (sums, visited)
            })
            .reduce_with(|(a, x), (b, y)| (a.join(b), merge(x, y)))
            .unwrap_or_else(|| (Self::empty(pixels, &columns, count), T::default()))
    }

    /// With a frame, and what each block has there beside the columns that all share.
    fn add(&mut self, data: &Data, whitened: &Whitened, filled: &Filled) {
        let rows = Rows::of(data, whitened);
        let set = whitened.set;
        pulp::Arch::new().dispatch(|| {
            for (sums, (a, b)) in self.own.iter_mut().zip(PAIRS) {
                for ((sum, a), b) in sums.iter_mut().zip(&rows.own[a]).zip(&rows.own[b]) {
                    *sum += a * b;
                }
            }
            let pixels = rows.roots.len();
            for (sums, own) in self.position_own[set].chunks_exact_mut(pixels).zip(&rows.own) {
                for ((sum, own), position) in sums.iter_mut().zip(own).zip(&rows.position) {
                    *sum += (own * position) as f32;
                }
            }
        });
        self.square[set] += rows.position.iter().map(|position| position * position).sum::<f64>();
        self.chi2 += rows.residual.iter().map(|residual| residual * residual).sum::<f64>();
        self.samples += rows.roots.iter().filter(|root| **root > 0.0).count();
        let shared = &whitened.frame.columns;
        for (block, filled) in self.blocks.iter_mut().zip(filled) {
            block.add(set, &rows, shared, filled, whitened.frame.count);
        }
    }

    /// The normal equations of each pixel's own numbers, solved.
    fn inverses(&self) -> Vec<Matrix4<f64>> {
        let of = |pixel: usize| {
            let mut own = Matrix4::zeros();
            for (sums, (a, b)) in self.own.iter().zip(PAIRS) {
                own[(a, b)] = sums[pixel];
                own[(b, a)] = sums[pixel];
            }
            inverse(&own)
        };
        (0..self.own[0].len()).map(of).collect()
    }

    /// Solves everything that the columns of the first block do not decide: [`Projected`]. `jitter_m2`: variance of the encoder's
    /// reading, set by set; where it is not given it is estimated.
    pub fn project(&self, jitter_m2: Option<f64>) -> Projected {
        let inverses = self.inverses();
        self.project_block(&self.blocks[0], &inverses, jitter_m2)
    }

    /// The same for every block.
    pub fn project_all(&self, jitter_m2: f64) -> Vec<Projected> {
        let inverses = self.inverses();
        self.blocks.par_iter().map(|block| self.project_block(block, &inverses, Some(jitter_m2))).collect()
    }

    fn project_block(&self, block: &Block, inverses: &[Matrix4<f64>], jitter_m2: Option<f64>) -> Projected {
        let (size, pixels) = (block.full.nrows(), inverses.len());
        let mut solved = block.mixed.clone();
        for mut column in solved.column_iter_mut() {
            let column = column.as_mut_slice();
            for (pixel, inverse) in inverses.iter().enumerate() {
                let values = inverse * own_of(column, pixel);
                (0..OWN).for_each(|number| column[number * pixels + pixel] = values[number]);
            }
        }
        let own = block.mixed.transpose() * &solved;
        let settled = own[(size - 1, size - 1)];
        let mut full = &block.full - own;
        full.fill_upper_triangle_with_lower_triangle();
        let mut sets = Vec::new();
        let turned = solved.transpose();
        let of_sets = block.position.iter().zip(&self.square).zip(&self.position_own);
        let seen: Vec<_> = of_sets.filter(|((sums, _), own)| !sums.is_empty() && !own.is_empty()).collect();
        for seen in seen.chunks(TOGETHER) {
            let own = seen.iter().flat_map(|(_, own)| own.iter().map(|&own| f64::from(own)));
            let own = DMatrix::from_iterator(solved.nrows(), seen.len(), own);
            let taken = &turned * &own;
            for (number, &((sums, square), _)) in seen.iter().enumerate() {
                let own = own.column(number);
                let own = (0..pixels).map(|pixel| own_of(own.as_slice(), pixel));
                let absorbed: f64 = own.zip(inverses).map(|(own, inverse)| own.dot(&(inverse * own))).sum();
                if square - absorbed > 0.0 {
                    sets.push((sums - taken.column(number), square - absorbed));
                }
            }
        }
        let residual = size - 1;
        let jitter_m2 = jitter_m2.unwrap_or_else(|| {
            jitter(&sets.iter().map(|(sums, square)| (sums[residual], *square)).collect::<Vec<_>>())
        });
        let mut freedom = 0.0;
        for (sums, square) in &sets {
            let share = jitter_m2 / (1.0 + jitter_m2 * square);
            full.ger(-share, sums, sums, 1.0);
            freedom += (jitter_m2 * square).ln_1p();
        }
        let matrix = full.view((0, 0), (residual, residual)).into_owned();
        let vector = full.view((0, residual), (residual, 1)).column(0).into_owned();
        let raw = DVector::from_fn(residual, |column, _| block.full[(column, column)]);
        let chi2 = full[(residual, residual)] + freedom + self.ln_variance;
        Projected { matrix, vector, raw, jitter_m2, chi2, settled, solved }
    }
}

/// A pixel's own numbers among those of all, number after number.
fn own_of(all: &[f64], pixel: usize) -> Vector4<f64> {
    let pixels = all.len() / OWN;
    Vector4::from_fn(|number, _| all[number * pixels + pixel])
}

/// Pseudo-inverse: what a pixel's own numbers are not told apart by stays where it is.
fn inverse(own: &Matrix4<f64>) -> Matrix4<f64> {
    let scale =
        Vector4::from_fn(|row, _| if own[(row, row)] > 0.0 { own[(row, row)].sqrt().recip() } else { 0.0 });
    let scaled = Matrix4::from_fn(|row, column| own[(row, column)] * scale[row] * scale[column]);
    let eigen = scaled.symmetric_eigen();
    let kept = eigen.eigenvalues.map(|value| if value > 1e-9 { value.recip() } else { 0.0 });
    let inverse = eigen.eigenvectors * Matrix4::from_diagonal(&kept) * eigen.eigenvectors.transpose();
    Matrix4::from_fn(|row, column| inverse[(row, column)] * scale[row] * scale[column])
}

impl Projected {
    /// Takes the first `count` columns as fitted: what they share with the others is theirs.
    pub fn give_way(&mut self, count: usize) {
        for fitted in 0..count {
            let pivot = self.matrix[(fitted, fitted)];
            if pivot > 1e-9 * self.raw[fitted] {
                let row = self.matrix.column(fitted).into_owned();
                let step = self.vector[fitted] / pivot;
                self.vector.axpy(-step, &row, 1.0);
                self.matrix.ger(-pivot.recip(), &row, &row, 1.0);
            }
        }
    }
}

/// The normal equations of the columns alone.
#[derive(Debug, Clone)]
pub struct Projected {
    /// Fisher information.
    pub matrix: DMatrix<f64>,
    /// Score.
    pub vector: DVector<f64>,
    /// Diagonal of the information before anything was projected out.
    pub raw: DVector<f64>,
    /// Variance of the encoder's reading, m².
    pub jitter_m2: f64,
    /// Chi squared after the projection, what the freedom of the sets' errors costs, and the logarithms of the noise's variances: minus twice the
    /// logarithm of the likelihood, but for a constant.
    pub chi2: f64,
    /// Chi squared that the pixels' own numbers take away by a step.
    pub settled: f64,
    /// Change of the pixels' own numbers a unit of each column, and, last, by the residual: (4 x pixels) x (columns + 1), number after number.
    solved: DMatrix<f64>,
}

impl Projected {
    /// How the pixels' own numbers move with a step `theta` of the columns.
    pub fn own(&self, theta: &DVector<f64>) -> Vec<Vector4<f64>> {
        let last = theta.len();
        let own = self.solved.column(last) - self.solved.columns(0, last) * theta;
        (0..own.len() / OWN).map(|pixel| own_of(own.as_slice(), pixel)).collect()
    }
}
