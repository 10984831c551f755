//! Which candidates the data ask for: Bayes factors from score and information, no refit needed.

use super::marginal::{White, ln_marginal};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use std::ops::Range;

/// A candidate's columns in some variant of its shape: their numbers.
#[derive(Debug, Clone)]
pub struct Block {
    /// The candidate.
    pub candidate: usize,
    /// Its variant.
    pub variant: usize,
    /// Variants that it has.
    pub variants: f64,
    /// Columns.
    pub columns: Vec<usize>,
}

/// Score and information of all blocks.
pub struct Evidence<'a> {
    /// Columns in all.
    size: usize,
    blocks: &'a [Block],
    white: Vec<Option<White>>,
    candidates: f64,
}

/// A model and its evidence against the baseline.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Numbers of blocks, of different candidates.
    pub blocks: Vec<usize>,
    /// Natural logarithm of the Bayes factor.
    pub ln_bayes: f64,
}

/// Of a column's information less than this is left by the pixels' own numbers: it cannot be seen.
pub const VISIBLE: f64 = 1e-6;
/// At its greatest value a column must change the frames by so many standard deviations of the whole campaign.
const LEAST_RHO: f64 = 1.0;
const LEAST_EIGENVALUE: f64 = 1e-4;
/// Of what columns together had before the projection this much is rounding (sums in single precision).
const ROUNDING: f64 = 1e-5;
/// By so much evidence (nats) each way is preferred to the next one.
const FIRST_NATS: f64 = 0.01;

/// Of two effects together each has at least this share of its information for itself.
const OWN: f64 = 0.04;

/// Coordinates among which waves are: each has to be believed against the others.
const LOOKED: f64 = 25.0;

/// Evidence for a common error of `variance` in one cluster whose score and information are these, nats.
pub fn of_variance(variance: f64, score: f64, information: f64) -> f64 {
    let share = variance * information;
    0.5 * variance * score * score / (1.0 + share) - 0.5 * share.ln_1p()
}

/// The greatest of so many that were looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Greatest {
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// Chi squared that it explains, and by how many numbers.
    pub chi2: (f64, usize),
    /// How many were looked at.
    pub looked: f64,
}

impl Greatest {
    /// A `chi2` of so many `numbers`: its evidence is what its chance is worth at most, p by Chernoff's bound, -1 / (e p ln p) (Sellke, Bayarri, Berger
    /// 2001).
    pub fn of(chi2: f64, numbers: usize, looked: f64) -> Self {
        let n = numbers as f64;
        let surprise = 0.5 * chi2 - 0.5 * n * (1.0 + (chi2 / n).max(1.0).ln()) - looked.ln();
        let ln_bayes = if surprise > 1.0 { surprise - 1.0 - surprise.ln() - LOOKED.ln() } else { 0.0 };
        Self { ln_bayes, chi2: (chi2, numbers), looked }
    }
}

/// Probability that chi squared of `degrees` is greater than `chi2` (Abramowitz and Stegun 1964, 26.4.4 and 26.4.5).
pub fn tail(chi2: f64, degrees: usize) -> f64 {
    if chi2 == f64::INFINITY {
        return 0.0;
    }
    let x = 0.5 * chi2.max(0.0);
    let n = degrees.max(1);
    let (first, half) = if n % 2 == 1 { (libm::erfc(x.sqrt()), 0.5) } else { ((-x).exp(), 1.0) };
    let term = |k: usize| {
        let a = half + k as f64;
        (a * x.ln() - x - libm::lgamma(a + 1.0)).exp()
    };
    ((0..(n - 1) / 2).map(term).sum::<f64>() + first).min(1.0)
}

/// Standard deviations by which 95 of 100 draws are above their mean less these.
pub const POWER_SIGMAS: f64 = 1.645;

/// Evidence for an effect alone, of so many `variants` and among so many `candidates`, with this `score` and unit information.
fn ln_bayes_alone(score: &DVector<f64>, variants: f64, candidates: usize) -> f64 {
    let numbers = score.len();
    let matrix = DMatrix::identity(numbers, numbers);
    let raw = DVector::from_element(numbers, 1.0);
    let blocks = [Block { candidate: 0, variant: 0, variants, columns: (0..numbers).collect() }];
    Evidence::new(&matrix, score, &raw, &|_| f64::INFINITY, &blocks, candidates).ln_bayes(&[0])
}

/// Strength, in standard deviations, at which one of so many `numbers` of an effect, of so many `variants` and among so many `candidates`, has evidence
/// beyond `threshold` (nats) in 95 of 100 campaigns; the others are as noise makes them.
pub fn powerful_rho(numbers: usize, variants: f64, candidates: usize, threshold: f64) -> f64 {
    let is_enough = |rho: f64| {
        let score = DVector::from_fn(numbers, |number, _| if number == 0 { rho } else { 1.0 });
        ln_bayes_alone(&score, variants, candidates) > threshold
    };
    let halved = |(low, high): (f64, f64), is_more: &dyn Fn(f64) -> bool| {
        let middle = 0.5 * (low + high);
        if is_more(middle) { (low, middle) } else { (middle, high) }
    };
    let found = |is_more: &dyn Fn(f64) -> bool| {
        (0..HALVINGS).fold((0.0, MOST_RHO), |ends, _| halved(ends, is_more)).1
    };
    let numbers = numbers as f64;
    let threshold = found(&is_enough).powi(2) + numbers - 1.0;
    // Chi squared of so many numbers, one of them of this strength: its mean, and how it scatters.
    let least = |rho: f64| rho * rho + numbers - POWER_SIGMAS * (4.0 * rho * rho + 2.0 * numbers).sqrt();
    found(&|rho| least(rho) > threshold)
}

/// No effect needs more.
const MOST_RHO: f64 = 100.0;
const HALVINGS: usize = 20;

/// Whether `information` that is left of `raw` shows a number that reaches up to `reach`.
pub fn is_seen(information: f64, raw: f64, reach: f64) -> bool {
    information > VISIBLE * raw && information.sqrt() * reach > LEAST_RHO
}

impl<'a> Evidence<'a> {
    /// Of `matrix` and `vector`, with `raw` the information before the projection, and `reach` the greatest value that a column's number
    /// may take.
    pub fn new(
        matrix: &'a DMatrix<f64>,
        vector: &'a DVector<f64>,
        raw: &DVector<f64>,
        reach: &dyn Fn(usize) -> f64,
        blocks: &'a [Block],
        candidates: usize,
    ) -> Self {
        let white = |block: &Block| {
            // Of several columns none may be rounding alone.
            let is_more = |&&column: &&usize| {
                block.columns.len() == 1 || matrix[(column, column)] > ROUNDING * raw[column]
            };
            let seen = |column: &&usize| {
                is_more(column) && is_seen(matrix[(**column, **column)], raw[**column], reach(**column))
            };
            let columns: Vec<usize> = block.columns.iter().filter(seen).copied().collect();
            if columns.is_empty() {
                return None;
            }
            let scale: Vec<f64> = columns.iter().map(|&c| matrix[(c, c)].sqrt().recip()).collect();
            let inner = DMatrix::from_fn(columns.len(), columns.len(), |r, c| {
                matrix[(columns[r], columns[c])] * scale[r] * scale[c]
            });
            let eigen = inner.symmetric_eigen();
            // At most what a direction had before the projection.
            let before = |n: usize| {
                let of = |(place, &column): (usize, &usize)| {
                    (eigen.eigenvectors[(place, n)] * scale[place]).abs() * raw[column].sqrt()
                };
                columns.iter().enumerate().map(of).sum::<f64>().powi(2)
            };
            let is_kept = |&n: &usize| {
                let rounding = if columns.len() > 1 { ROUNDING * before(n) } else { 0.0 };
                eigen.eigenvalues[n] > rounding.max(LEAST_EIGENVALUE)
            };
            let kept: Vec<usize> = (0..columns.len()).filter(is_kept).collect();
            if kept.is_empty() {
                return None;
            }
            let mut basis = DMatrix::zeros(matrix.nrows(), kept.len());
            for (number, &which) in kept.iter().enumerate() {
                let length = eigen.eigenvalues[which].sqrt().recip();
                for (place, &column) in columns.iter().enumerate() {
                    basis[(column, number)] = eigen.eigenvectors[(place, which)] * length * scale[place];
                }
            }
            Some(White::new(matrix, vector, basis).or_alike(reach))
        };
        let white = blocks.iter().map(white).collect();
        Self { size: matrix.nrows(), blocks, white, candidates: candidates as f64 }
    }

    /// Score statistic of a block: chi squared, and its degrees of freedom. Nothing where it cannot be seen.
    pub fn score(&self, block: usize) -> Option<(f64, usize)> {
        self.white[block].as_ref().map(|white| (white.score.norm_squared(), white.score.len()))
    }

    /// Information, score, and the place of each block among them, of the `chosen` blocks together, in coordinates in which each block's own
    /// information is the identity. A block that cannot be seen has no place among them: an empty one.
    pub fn joint(&self, chosen: &[usize]) -> (DMatrix<f64>, DVector<f64>, Vec<Range<usize>>) {
        let size = self.size;
        let none = White::new(&DMatrix::zeros(size, size), &DVector::zeros(size), DMatrix::zeros(size, 0));
        self.together(
            &chosen.iter().map(|&block| self.white[block].as_ref().unwrap_or(&none)).collect::<Vec<_>>(),
        )
    }

    fn together(&self, parts: &[&White]) -> (DMatrix<f64>, DVector<f64>, Vec<Range<usize>>) {
        let size: usize = parts.iter().map(|part| part.score.len()).sum();
        let mut inner = DMatrix::identity(size, size);
        let mut score = DVector::zeros(size);
        let mut of = Vec::new();
        let mut row = 0;
        for (number, part) in parts.iter().enumerate() {
            let width = part.score.len();
            score.rows_mut(row, width).copy_from(&part.score);
            let mut column = 0;
            for other in &parts[..number] {
                let cross = part.shared_with(other);
                inner.view_mut((row, column), (width, other.score.len())).copy_from(&cross);
                inner.view_mut((column, row), (other.score.len(), width)).copy_from(&cross.transpose());
                column += other.score.len();
            }
            of.push(row..row + width);
            row += width;
        }
        (inner, score, of)
    }

    /// The evidence for the blocks together.
    pub fn ln_bayes(&self, chosen: &[usize]) -> f64 {
        let parts: Option<Vec<&White>> = chosen.iter().map(|&block| self.white[block].as_ref()).collect();
        let Some(parts) = parts else { return f64::NEG_INFINITY };
        let (inner, score, of) = self.together(&parts);
        let ln_bayes = ln_marginal(&inner, &score, &of, &parts);
        let choices: f64 = parts.iter().map(|part| part.choice).sum();
        let variants: f64 = chosen.iter().map(|&block| self.blocks[block].variants.max(1.0).ln()).sum();
        let effects = chosen.len() as f64;
        // Of ways that say the same the first one is it.
        let later: f64 = chosen.iter().map(|&block| FIRST_NATS * self.blocks[block].variant as f64).sum();
        ln_bayes - choices - effects - effects * (2.0 * self.candidates).ln() - variants - later
    }

    /// Whether all that one of two blocks changes, but for next to nothing, the other one can change, too: both at once are no answer, because
    /// what one of them makes the other takes away.
    fn contains(&self, one: usize, other: usize) -> bool {
        let (Some(one), Some(other)) = (&self.white[one], &self.white[other]) else { return false };
        let (few, many) = if one.score.len() <= other.score.len() { (one, other) } else { (other, one) };
        let cross = few.shared_with(many);
        let shared = (&cross * cross.transpose()).symmetric_eigenvalues();
        shared.iter().all(|&share| share > 1.0 - OWN)
    }

    /// All single blocks and all pairs of different candidates, best first, but for pairs of which one contains the other.
    pub fn models(&self) -> Vec<Model> {
        let seen: Vec<usize> = (0..self.blocks.len()).filter(|&block| self.white[block].is_some()).collect();
        let candidate = |block: usize| self.blocks[block].candidate;
        let may_be =
            |one: usize, other: usize| candidate(other) != candidate(one) && !self.contains(one, other);
        let beside = |(place, &one): (usize, &usize)| {
            let others = seen[place + 1..].iter().filter(|&&other| may_be(one, other));
            others.map(|&other| vec![one, other]).collect::<Vec<_>>()
        };
        let alone = seen.iter().map(|&block| vec![block]);
        let all: Vec<Vec<usize>> = alone.chain(seen.iter().enumerate().flat_map(beside)).collect();
        let model = |blocks: Vec<usize>| Model { ln_bayes: self.ln_bayes(&blocks), blocks };
        let mut models: Vec<Model> = all.into_par_iter().map(model).collect();
        models.sort_by(|a, b| b.ln_bayes.total_cmp(&a.ln_bayes));
        models
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    /// Critical values as tables have them; and tails in arbitrary precision: erfc(sqrt(23.5)), exp(-23.5), exp(-28.5) (1 + 28.5 + 28.5^2 / 2).
    #[test]
    fn the_tail_of_chi_squared_is_that_of_tables() {
        for (degrees, critical) in [(1, 3.841_459), (2, 5.991_465), (5, 11.070_498), (10, 18.307_038)] {
            assert!((tail(critical, degrees) - 0.05).abs() < 1e-7, "{degrees}");
        }
        assert!((tail(149.449_253, 100) - 0.001).abs() < 1e-8);
        for (chi2, degrees, exact) in
            [(47.0, 1, 7.098_670_445e-12), (47.0, 2, 6.224_144_623e-11), (57.0, 6, 1.826_922_234e-10)]
        {
            assert!((tail(chi2, degrees) / exact - 1.0).abs() < 1e-8, "{chi2} {degrees}");
        }
        assert_eq!([tail(0.0, 3), tail(-1.0, 3), tail(-1.0, 4), tail(0.0, 1)], [1.0; 4]);
        assert_eq!([tail(1e5, 7), tail(f64::INFINITY, 7)], [0.0; 2]);
    }

    /// Chi squared of a hundred columns of unit information, of whose common direction a projection has left the share `left`, and
    /// whose score is 1 along it.
    fn of_direction(left: f64) -> f64 {
        const COUNT: usize = 100;
        let common = DVector::from_element(COUNT, (COUNT as f64).sqrt().recip());
        let matrix = DMatrix::identity(COUNT, COUNT) + (left - 1.0) * &common * common.transpose();
        let raw = DVector::from_element(COUNT, 1.0);
        let blocks = [Block { candidate: 0, variant: 0, variants: 1.0, columns: (0..COUNT).collect() }];
        let evidence = Evidence::new(&matrix, &common, &raw, &|_| f64::INFINITY, &blocks, 1);
        evidence.score(0).unwrap().0
    }

    #[test]
    fn ninety_five_of_a_hundred_are_seen() {
        const DRAWS: usize = 400;
        for (numbers, variants) in [(1, 1.0), (1, 20_000.0), (7, 2.0), (68, 1.0)] {
            let rho = powerful_rho(numbers, variants, 30, 1.0);
            let is_seen = |draw: &usize| {
                let mut score = DVector::from_vec(Draws::of(5, *draw as u64).normal(numbers));
                score[0] += rho;
                ln_bayes_alone(&score, variants, 30) > 1.0
            };
            let seen = (0..DRAWS).filter(is_seen).count();
            // 380, and three standard deviations of a binomial number.
            assert!((367..=393).contains(&seen), "{numbers} {variants}: {seen} of {DRAWS}, rho {rho}");
        }
    }

    /// Two columns of unit information, of which the second has this share for itself, and a score that only their difference explains.
    fn pairs(own: f64) -> usize {
        let cosine = (1.0_f64 - own).sqrt();
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, cosine, cosine, 1.0]);
        let score = &matrix * DVector::from_vec(vec![200.0, -200.0]);
        let raw = DVector::from_element(2, 1.0);
        let block = |candidate| Block { candidate, variant: 0, variants: 1.0, columns: vec![candidate] };
        let blocks = [block(0), block(1)];
        let evidence = Evidence::new(&matrix, &score, &raw, &|_| f64::INFINITY, &blocks, 2);
        evidence.models().iter().filter(|model| model.blocks.len() == 2).count()
    }

    #[test]
    fn of_two_that_do_the_same_both_are_no_answer() {
        assert_eq!([0.3, 0.06, 0.03, 1e-5].map(pairs), [1, 1, 0, 0]);
    }

    #[test]
    fn what_rounding_leaves_of_a_direction_says_nothing() {
        assert!((of_direction(0.01) - 100.0).abs() < 2.0, "{}", of_direction(0.01));
        // 5e-4 of 100 columns' common direction is what sums in single precision are off by.
        assert!(of_direction(5e-4) < 1e-6, "{}", of_direction(5e-4));
    }
}
