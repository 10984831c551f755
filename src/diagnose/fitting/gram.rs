//! One pass over the data: the normal equations of all columns, with the pixels' own numbers projected out.

use super::block::{Block, Rows};
use super::common_phase::CommonPhase;
use super::coupled::{Coupled, Stack, taken};
use super::encoder_noise::jitter;
use super::in_order::joined;
use super::inverse::inverse;
use super::noise::Noise;
use super::panels::lower_product;
use super::projected::{Common, Projected, own_of};
use super::set_errors::{self, Jitter, SetErrors, of_reading};
use super::whiten::{tails, whiten};
use crate::diagnose::reading::data::Data;
use crate::diagnose::tangents::acting::Acting;
use crate::diagnose::tangents::arrived::Arrived;
use crate::diagnose::tangents::columns::{Frame, OWN, Tangents};
use crate::widest::widest;
use nalgebra::{DMatrix, DVector, Matrix4, Vector4};
use rayon::prelude::*;

/// Sums over all samples, weighted by the noise.
#[derive(Debug, Clone)]
pub struct Gram {
    /// The pixels' own numbers against each other, J' W J: a value a pixel of each pair of them.
    own: Vec<Vec<f64>>,
    /// Errors that samples of a set share, set by set.
    errors: Vec<SetErrors>,
    /// What frames are off by at random.
    jitter: Jitter,
    /// Columns that are solved together, each block by itself; last those of the phases that all pixels have at a frequency.
    blocks: Vec<Block>,
    /// How many the latter are.
    common: usize,
    /// Sum of squares of the whitened residual, and samples.
    pub chi2: f64,
    /// Samples that count.
    pub samples: usize,
    /// Sum of the logarithms of the noise's variance at the model's signal, over that at the measured one.
    ln_variance: f64,
    /// What residuals have beyond what they count as.
    pub beyond: f64,
}

/// What blocks have in a frame: the columns that act.
pub type Filled = Vec<Acting>;

/// A set's errors against columns, themselves, and what the pixels' own numbers leave of them.
type OfSet<'a, 'b> = ((&'a DMatrix<f64>, &'a SetErrors), &'b DMatrix<f64>);

/// A frame of a set: its number in the recording, model and tangents, roots of weights and whitened residual, and what blocks have in it.
type Made = (usize, Frame, (Vec<f64>, Vec<f64>), Filled);

/// Pairs of a pixel's own numbers.
const PAIRS: [(usize, usize); OWN * (OWN + 1) / 2] =
    [(0, 0), (0, 1), (0, 2), (0, 3), (1, 1), (1, 2), (1, 3), (2, 2), (2, 3), (3, 3)];
/// Those of each number with the phase.
const PHASES: [usize; OWN] = [1, 4, 5, 6];

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
    /// The target's velocity, m/s.
    pub velocity_m_s: f64,
}

/// Sets are summed in so many chunks, of so many sets at least and at most.
const CHUNKS: usize = 16;
const CHUNK: (usize, usize) = (8, 64);
/// Of fewer sets, frames are made side by side, so many at a time.
const FEW: usize = 16;
const FRAMES: usize = 4;
/// So many errors of sets, or those of one set, are freed of the pixels' own numbers at a time.
const TOGETHER: usize = 64;

impl Gram {
    fn empty(pixels: usize, columns: &[usize], sets: usize, jitter: Jitter, common: usize) -> Self {
        Self {
            own: vec![vec![0.0; pixels]; PAIRS.len()],
            errors: vec![SetErrors::default(); sets],
            jitter,
            blocks: columns.iter().map(|&columns| Block::empty(pixels, columns, sets)).collect(),
            common,
            chi2: 0.0,
            samples: 0,
            ln_variance: 0.0,
            beyond: 0.0,
        }
    }

    fn join(mut self, other: Self) -> Self {
        self.own.iter_mut().flatten().zip(other.own.iter().flatten()).for_each(|(a, b)| *a += b);
        for (a, b) in self.errors.iter_mut().zip(other.errors) {
            if a.is_empty() {
                *a = b;
            }
        }
        self.blocks.iter_mut().zip(other.blocks).for_each(|(block, other)| block.join(other));
        self.chi2 += other.chi2;
        self.samples += other.samples;
        self.ln_variance += other.ln_variance;
        self.beyond += other.beyond;
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
        let (common, own) = (tangents.common(), columns);
        let columns: Vec<usize> = own.iter().map(|own| tangents.count() + own + common).collect();
        let (pixels, count) = (data.pixels(), sets.len());
        // The same on every machine: what looks from set to set does not look from one chunk to the next.
        let chunk = sets.len().div_ceil(CHUNKS).clamp(CHUNK.0, CHUNK.1);
        let indexed: Vec<(usize, (usize, usize))> =
            sets.into_iter().enumerate().filter(|&(n, _)| counts(n)).collect();
        let is_few = indexed.len() < FEW;
        let of_chunk = |sets: &[(usize, (usize, usize))]| {
            let mut sums = Self::empty(pixels, &columns, count, noise.jitter, common);
            let mut visited = T::default();
            for &(number, (take, set)) in sets {
                let frames = data.takes[take].frames;
                let errors = set_errors::count(noise.jitter, frames);
                sums.errors[number] = SetErrors::empty(errors, pixels);
                for (block, columns) in sums.blocks.iter_mut().zip(&columns) {
                    block.errors[number] = DMatrix::zeros(errors, columns + 1);
                }
                let made = |index: usize, arrived: &mut Arrived| -> Made {
                    let frame = tangents.frame(take, index, arrived);
                    let whitened = whiten(data, take, index, &frame.base, noise);
                    let mut filled = fill(take, index, &frame);
                    if let Some((number, values)) = tangents.of_common(take, index, &frame) {
                        for (filled, own) in filled.iter_mut().zip(own) {
                            filled.column(own + number, values.clone());
                        }
                    }
                    (index, frame, whitened, filled)
                };
                let mut add = |(index, frame, (roots, residual), filled): Made| {
                    let (frame, roots, residual) = (&frame, &roots[..], &residual[..]);
                    let velocity_m_s = data.takes[take].moments[index].velocity_m_s;
                    let whitened =
                        Whitened { take, set: number, index, frame, roots, residual, velocity_m_s };
                    visited = visit(std::mem::take(&mut visited), &whitened);
                    let measured = &data.takes[take].signal_dn[index * pixels..(index + 1) * pixels];
                    sums.ln_variance += noise.ln_variance(measured, roots);
                    sums.beyond += tails(measured, &frame.base, roots, residual).sum::<f64>();
                    sums.add(data, &whitened, &filled, is_few);
                };
                let indices = set * frames..(set + 1) * frames;
                if is_few {
                    for some in indices.collect::<Vec<_>>().chunks(FRAMES) {
                        let alone = |&index: &usize| made(index, &mut Arrived::default());
                        some.par_iter().map(alone).collect::<Vec<_>>().into_iter().for_each(&mut add);
                    }
                } else {
                    let mut arrived = Arrived::default();
                    indices.map(|index| made(index, &mut arrived)).for_each(add);
                }
            }
            sums.blocks.iter_mut().for_each(Block::settle);
            (sums, visited)
        };
        joined(&indexed, chunk, of_chunk, |(a, x), (b, y)| (a.join(b), merge(x, y)))
            .unwrap_or_else(|| (Self::empty(pixels, &columns, count, noise.jitter, common), T::default()))
    }

    /// With a frame, and what each block has there beside the columns that all share; the blocks side by side, where these are.
    fn add(&mut self, data: &Data, whitened: &Whitened, filled: &Filled, are_side_by_side: bool) {
        let rows = Rows::of(data, whitened, self.jitter);
        let (set, moment) = (whitened.set, &data.takes[whitened.take].moments[whitened.index]);
        let places: Vec<usize> = set_errors::places(self.jitter, moment.frame).collect();
        for (sums, (a, b)) in self.own.iter_mut().zip(PAIRS) {
            let (sums, a, b) = (&mut sums[..], &rows.own[a][..], &rows.own[b][..]);
            widest!((sums: &'a mut [f64], a: &'a [f64], b: &'a [f64]) {
                for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
                    *sum += a * b;
                }
            });
        }
        self.errors[set].add(&places, &rows.errors, &rows.own);
        self.chi2 += rows.residual.iter().map(|residual| residual * residual).sum::<f64>();
        self.samples += rows.roots.iter().filter(|root| **root > 0.0).count();
        let shared = &whitened.frame.columns;
        let add = |(block, filled): (&mut Block, &Acting)| {
            block.add(set, &places, &rows, shared, filled, whitened.frame.count);
        };
        match are_side_by_side {
            true => self.blocks.par_iter_mut().zip(filled).for_each(add),
            false => self.blocks.iter_mut().zip(filled).for_each(add),
        }
    }

    /// The normal equations of each pixel's own numbers, solved.
    pub fn inverses(&self) -> Vec<Matrix4<f64>> {
        let of = |pixel: usize| {
            let mut own = Matrix4::zeros();
            for (sums, (a, b)) in self.own.iter().zip(PAIRS) {
                own[(a, b)] = sums[pixel];
                own[(b, a)] = sums[pixel];
            }
            inverse(&own)
        };
        (0..self.own[0].len()).into_par_iter().map(of).collect()
    }

    /// The same, and what these leave of the sets' errors.
    fn solved(&self) -> Solved {
        let inverses = self.inverses();
        let pixels = inverses.len();
        let phases = |pixel: usize| Vector4::from(PHASES.map(|pair| self.own[pair][pixel]));
        let common = || CommonPhase::of(&(0..pixels).map(phases).collect::<Vec<_>>(), &inverses);
        let common = (self.jitter != [0.0; 2]).then(common).flatten();
        let left: Vec<_> =
            self.errors.par_iter().map(|errors| errors.left(&inverses, common.as_ref())).collect();
        let coupled = || Coupled::of(&self.errors, &inverses, &left);
        let coupled = (self.jitter == [0.0; 2]).then(coupled).flatten();
        Solved { inverses, common, left, coupled }
    }

    /// Solves everything that the columns of the first block do not decide: [`Projected`]. `jitter_m2`: variance of the encoder's
    /// reading, set by set; where it is not given it is estimated.
    pub fn project(&self, jitter_m2: Option<f64>) -> Projected {
        self.project_block(&self.blocks[0], &self.solved(), jitter_m2)
    }

    /// The same for any block, by its number, at any variance of the readings: what no columns decide is solved once.
    pub fn projections(&self) -> impl Fn(usize, f64) -> Projected + Sync {
        let solved = self.solved();
        move |block, jitter_m2| self.project_block(&self.blocks[block], &solved, Some(jitter_m2))
    }

    fn project_block<'a>(
        &self,
        block: &Block,
        Solved { inverses, common, left, coupled }: &'a Solved,
        jitter_m2: Option<f64>,
    ) -> Projected {
        let (size, pixels) = (block.full.nrows(), inverses.len());
        let mut solved = block.mixed.clone();
        for mut column in solved.column_iter_mut() {
            let column = column.as_mut_slice();
            for (pixel, inverse) in inverses.iter().enumerate() {
                let values = inverse * own_of(column, pixel);
                (0..OWN).for_each(|number| column[number * pixels + pixel] = values[number]);
            }
        }
        let with_common = common.as_ref().map(|common| (common, common.freed(&block.mixed, &mut solved)));
        let own = lower_product(&block.mixed, &solved);
        let mut settled = own[(size - 1, size - 1)];
        let mut full = &block.full - own;
        full.fill_upper_triangle_with_lower_triangle();
        if let Some((common, with)) = &with_common {
            full = common.append(full, with);
        }
        let of_sets = block.errors.iter().zip(&self.errors).zip(left);
        let seen: Vec<_> = of_sets.filter_map(|(of, left)| Some((of, left.as_ref()?))).collect();
        let errors = seen.iter().map(|(_, left)| left.nrows()).max().unwrap_or(1);
        let stack = |seen: &[OfSet<'_, 'a>]| {
            let own: Vec<f64> = seen.iter().flat_map(|((_, errors), _)| errors.own()).collect();
            let own = DMatrix::from_vec(solved.nrows(), own.len() / solved.nrows(), own);
            let mut of = own.transpose() * &solved;
            of.neg_mut();
            of.resize_mut(of.nrows(), full.ncols(), 0.0);
            let mut first = 0;
            let mut lefts = Vec::new();
            for &((sums, errors), left) in seen {
                let mut rows = of.rows_mut(first, left.nrows());
                let mut columns = rows.columns_mut(0, size);
                columns += sums;
                if let Some(common) = common {
                    rows.column_mut(size).copy_from(&errors.with_common_phase(common));
                }
                lefts.push((first, left));
                first += left.nrows();
            }
            (of, lefts)
        };
        let mut sums: Vec<Stack> = seen.par_chunks((TOGETHER / errors).max(1)).map(stack).collect();
        let residual = size - 1;
        let jitter_m2 = jitter_m2.unwrap_or_else(|| {
            let of = |(sums, lefts): &Stack| -> Vec<(f64, f64)> {
                let of_set = |&(first, left): &(usize, &DMatrix<f64>)| {
                    let column = |number: usize| sums.column(number).rows(first, left.nrows()).into_owned();
                    let (mut left, mut scores) = (left.clone(), column(residual));
                    if let Some((common, with)) = &with_common {
                        // Where the phase of all pixels begins says nothing of the reading.
                        let shared = column(size);
                        scores.axpy(-common.per_unit(with[residual]), &shared, 1.0);
                        common.take(&mut left, &shared);
                    }
                    of_reading(&scores, &left, self.jitter)
                };
                lefts.iter().map(of_set).collect()
            };
            jitter(&sums.iter().flat_map(of).filter(|(_, square)| *square > 0.0).collect::<Vec<_>>())
        });
        let mut freedom = taken(&mut full, &mut sums, coupled.as_ref(), self.jitter, jitter_m2);
        if let Some(common) = common {
            let taken = common.fitted(&mut full, &mut solved);
            settled += taken.chi2;
            freedom += taken.ln_variance;
        }
        let common = Common::fitted(self.common, &block.full, &mut full, &mut solved);
        settled += common.settled;
        let residual = residual - self.common;
        let matrix = full.view((0, 0), (residual, residual)).into_owned();
        let vector = full.view((0, residual), (residual, 1)).column(0).into_owned();
        let raw = DVector::from_fn(residual, |column, _| block.full[(column, column)]);
        let chi2 = full[(residual, residual)] + freedom + self.ln_variance + self.beyond;
        Projected { matrix, vector, raw, jitter_m2, chi2, settled, solved, common }
    }
}

/// Numbers that the columns do not decide, solved.
struct Solved {
    /// Of the normal equations of each pixel's own numbers.
    inverses: Vec<Matrix4<f64>>,
    /// What is not among these where frames have errors.
    common: Option<CommonPhase>,
    /// What these leave of each set's errors, against each other; nothing where that is nothing.
    left: Vec<Option<DMatrix<f64>>>,
    /// What they leave of the readings' errors of all sets, where these are few.
    coupled: Option<Coupled>,
}
