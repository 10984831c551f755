//! One pass over the data: the normal equations of all columns, with the pixels' own numbers projected out.

use super::columns::{Frame, OWN, Tangents};
use super::data::Data;
use nalgebra::{DMatrix, DVector, Matrix4, Matrix4xX, Vector4};
use rayon::prelude::*;

/// Sums over all samples, weighted by the noise.
#[derive(Debug, Clone)]
pub struct Gram {
    /// Columns and, last, the residual: G' W G.
    full: DMatrix<f64>,
    /// A pixel's own numbers: J' W J.
    own: Vec<Matrix4<f64>>,
    /// Own numbers against columns and residual, `[pixel]`: 4 x (columns + 1).
    mixed: Vec<Matrix4xX<f64>>,
    /// A set's position against columns and residual, and against itself.
    position: Vec<(DVector<f64>, f64)>,
    /// A set's position against the pixels' own numbers.
    position_own: Vec<Vec<Vector4<f64>>>,
    /// Sum of squares of the whitened residual, and samples.
    pub chi2: f64,
    /// Samples that count.
    pub samples: usize,
}

/// Variance of the noise at a signal, DN².
#[derive(Debug, Clone, Copy)]
pub struct Noise {
    /// Read noise and quantisation, DN².
    pub floor: f64,
    /// Shot noise, DN² a DN.
    pub slope: f64,
}

impl Noise {
    /// One over the variance.
    pub fn weight(&self, signal_dn: f64) -> f64 {
        1.0 / (self.floor + self.slope * signal_dn.max(0.0))
    }
}

/// Residuals beyond so many standard deviations count as that many.
const WINSOR: f64 = 4.0;

impl Gram {
    fn empty(pixels: usize, columns: usize, sets: usize) -> Self {
        Self {
            full: DMatrix::zeros(columns + 1, columns + 1),
            own: vec![Matrix4::zeros(); pixels],
            mixed: vec![Matrix4xX::zeros(columns + 1); pixels],
            position: vec![(DVector::zeros(columns + 1), 0.0); sets],
            position_own: vec![Vec::new(); sets],
            chi2: 0.0,
            samples: 0,
        }
    }

    fn join(mut self, other: Self) -> Self {
        self.full += other.full;
        self.own.iter_mut().zip(other.own).for_each(|(a, b)| *a += b);
        self.mixed.iter_mut().zip(other.mixed).for_each(|(a, b)| *a += b);
        for (a, b) in self.position.iter_mut().zip(other.position) {
            a.0 += b.0;
            a.1 += b.1;
        }
        for (a, b) in self.position_own.iter_mut().zip(other.position_own) {
            if a.is_empty() {
                *a = b;
            }
        }
        self.chi2 += other.chi2;
        self.samples += other.samples;
        self
    }

    /// The pass over all sets of which `counts` (number of the set, over all recordings) is true.
    pub fn of(
        data: &Data,
        tangents: &Tangents,
        noise: Noise,
        counts: &(dyn Fn(usize) -> bool + Sync),
    ) -> Self {
        let mut sets = Vec::new();
        for (take, recording) in data.takes.iter().enumerate() {
            sets.extend((0..recording.moments.len() / recording.frames).map(|set| (take, set)));
        }
        let (pixels, columns, count) = (data.pixels(), tangents.count(), sets.len());
        let chunk = sets.len().div_ceil(2 * rayon::current_num_threads()).max(1);
        let indexed: Vec<(usize, (usize, usize))> =
            sets.into_iter().enumerate().filter(|&(n, _)| counts(n)).collect();
        indexed
            .par_chunks(chunk)
            .map(|chunk| {
                let mut sums = Self::empty(pixels, columns, count);
                for &(number, (take, set)) in chunk {
                    sums.position_own[number] = vec![Vector4::zeros(); pixels];
                    let frames = data.takes[take].frames;
                    for index in set * frames..(set + 1) * frames {
                        sums.add(data, take, index, number, &tangents.frame(take, index), noise);
                    }
                }
                sums
            })
            .reduce_with(Self::join)
            .unwrap_or_else(|| Self::empty(pixels, columns, count))
    }

    fn add(&mut self, data: &Data, take: usize, index: usize, set: usize, frame: &Frame, noise: Noise) {
        let (pixels, count) = (data.pixels(), frame.columns.len());
        let signal = &data.takes[take].signal_dn[index * pixels..(index + 1) * pixels];
        // Rows of one frame, times the root of the weight.
        let mut rows = DMatrix::<f64>::zeros(pixels, count + 1);
        let mut roots = vec![0.0; pixels];
        for pixel in 0..pixels {
            let measured = f64::from(signal[pixel]);
            if measured.is_nan() {
                continue;
            }
            let root = noise.weight(frame.base[pixel]).sqrt();
            roots[pixel] = root;
            let residual = (root * (measured - frame.base[pixel])).clamp(-WINSOR, WINSOR);
            rows[(pixel, count)] = residual;
            self.chi2 += residual * residual;
            self.samples += 1;
        }
        for (column, values) in frame.columns.iter().enumerate().filter(|(_, values)| !values.is_empty()) {
            for pixel in 0..pixels {
                rows[(pixel, column)] = roots[pixel] * values[pixel];
            }
        }
        self.full.gemm(1.0, &rows.transpose(), &rows, 1.0);
        for pixel in 0..pixels {
            let root = roots[pixel];
            if root == 0.0 {
                continue;
            }
            // A background never moves: its constant light is ambient light.
            let constant = if data.target[pixel] { frame.own[2][pixel] } else { 0.0 };
            let own =
                root * Vector4::new(frame.own[0][pixel], frame.own[1][pixel], constant, frame.own[3][pixel]);
            self.own[pixel] += own * own.transpose();
            let mixed = &mut self.mixed[pixel];
            for column in 0..=count {
                let value = rows[(pixel, column)];
                if value != 0.0 {
                    let mut sums = mixed.fixed_view_mut::<OWN, 1>(0, column);
                    sums += own * value;
                }
            }
            let position = root * frame.position[pixel];
            if position != 0.0 {
                self.position_own[set][pixel] += own * position;
                self.position[set].1 += position * position;
            }
        }
        let position = DVector::from_fn(pixels, |pixel, _| roots[pixel] * frame.position[pixel]);
        self.position[set].0.gemv_tr(1.0, &rows, &position, 1.0);
    }

    /// Solves everything that the columns do not decide: [`Projected`]. `jitter_m2`: variance of the encoder's reading, set by set; where
    /// it is not given it is estimated.
    pub fn project(&self, jitter_m2: Option<f64>) -> Projected {
        let size = self.full.nrows();
        let inverses: Vec<Matrix4<f64>> = self.own.iter().map(inverse).collect();
        let solved: Vec<Matrix4xX<f64>> =
            self.mixed.iter().zip(&inverses).map(|(mixed, inverse)| inverse * mixed).collect();
        let mut full = self.full.clone();
        for (mixed, solved) in self.mixed.iter().zip(&solved) {
            full.gemm_tr(-1.0, mixed, solved, 1.0);
        }
        let mut sets = Vec::new();
        for ((sums, square), own) in self.position.iter().zip(&self.position_own) {
            let (mut sums, mut square) = (sums.clone(), *square);
            for (pixel, own) in own.iter().enumerate().filter(|(_, own)| own.norm_squared() > 0.0) {
                sums.gemv_tr(-1.0, &solved[pixel], own, 1.0);
                square -= own.dot(&(inverses[pixel] * own));
            }
            if square > 0.0 {
                sets.push((sums, square));
            }
        }
        let residual = size - 1;
        let jitter_m2 = jitter_m2.unwrap_or_else(|| {
            jitter(&sets.iter().map(|(sums, square)| (sums[residual], *square)).collect::<Vec<_>>())
        });
        for (sums, square) in &sets {
            let share = jitter_m2 / (1.0 + jitter_m2 * square);
            full.ger(-share, sums, sums, 1.0);
        }
        let matrix = full.view((0, 0), (residual, residual)).into_owned();
        let vector = full.view((0, residual), (residual, 1)).column(0).into_owned();
        let raw = DVector::from_fn(residual, |column, _| self.full[(column, column)]);
        Projected { matrix, vector, raw, jitter_m2, chi2: full[(residual, residual)], solved }
    }
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

/// The variance of the encoder's reading that explains the sets' common position errors best, m²: `(sum, square)` a set.
fn jitter(sets: &[(f64, f64)]) -> f64 {
    let evidence = |variance: f64| -> f64 {
        let term = |&(sum, square): &(f64, f64)| {
            0.5 * variance * sum * sum / (1.0 + variance * square) - 0.5 * (variance * square).ln_1p()
        };
        sets.iter().map(term).sum()
    };
    // From a micrometre to half a millimetre: more is no encoder's noise, but something that must be named.
    let variances = (0..=60).map(|step| (1e-6 * 500f64.powf(f64::from(step) / 60.0)).powi(2));
    variances.fold((0.0, 0.0), |best, v| if evidence(v) > best.1 { (v, evidence(v)) } else { best }).0
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
    /// Chi squared after the projection.
    pub chi2: f64,
    /// Change of the pixels' own numbers a unit of each column, and, last, by the residual.
    solved: Vec<Matrix4xX<f64>>,
}

impl Projected {
    /// How the pixels' own numbers move with a step `theta` of the columns.
    pub fn own(&self, theta: &DVector<f64>) -> Vec<Vector4<f64>> {
        let last = theta.len();
        let step = |solved: &Matrix4xX<f64>| {
            let mut own = Vector4::from_iterator(solved.column(last).iter().copied());
            for (column, value) in theta.iter().enumerate() {
                own -= *value * Vector4::from_iterator(solved.column(column).iter().copied());
            }
            own
        };
        self.solved.iter().map(step).collect()
    }
}
