//! What two simpler methods name, from the very score and information of the search's first pass: the least that a diagnosis has to beat.

use super::evidence::{Block, Evidence};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;
use std::ops::Range;

/// Share of the identity that is added to the information of sparse regression: that of `alpha` in PySINDy, whose columns have unit norm too.
const RIDGE: f64 = 0.05;
/// The same for least squares, so that columns which are multiples of each other can be solved for.
const SOLVABLE: f64 = 1e-9;
/// Thresholds of sparse regression, in standard deviations: from one on, each so many times the one before.
const STEP: f64 = 1.2;
const STEPS: i32 = 60;

/// The names that simpler methods assert.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Simpler {
    /// The single effect with the best BIC (Schwarz 1978), where that is better than none's: what plain least squares takes from chi squared,
    /// less k ln N for k numbers and N samples. A shape is taken from the candidate's list, and is not counted.
    pub best_single: Vec<&'static str>,
    /// The effects that sequentially thresholded least squares keep (Brunton, Proctor, Kutz 2016).
    ///
    /// Each effect has the shape with which its own BIC is best. All are solved for at once with a ridge of 0.05; effects whose numbers, in
    /// coordinates in which they are independent and have unit norm, are shorter than the threshold are left out, and the others solved for
    /// again, until no more are left out. What is kept is thresholded by effects, not by single numbers (Rudy, Alla, Brunton, Kutz
    /// 2019), and of 60 thresholds from 1 to 47 000 standard deviations the one is taken whose effects have the best BIC (Mangan, Kutz, Brunton,
    /// Proctor 2017).
    pub sparse_regression: Vec<&'static str>,
}

impl Simpler {
    /// From the `evidence` of `blocks`, of which `name` gives the effect's name, in so many `samples`.
    pub fn of(
        evidence: &Evidence,
        blocks: &[Block],
        samples: usize,
        name: &dyn Fn(&Block) -> &'static str,
    ) -> Self {
        let price = (samples.max(1) as f64).ln();
        let mut best: BTreeMap<usize, (f64, usize)> = BTreeMap::new();
        for (number, block) in blocks.iter().enumerate() {
            let Some((chi2, numbers)) = evidence.score(number) else { continue };
            let gain = chi2 - price * numbers as f64;
            let known = best.entry(block.candidate).or_insert((gain, number));
            if gain > known.0 {
                *known = (gain, number);
            }
        }
        let single = best.values().filter(|best| best.0 > 0.0).max_by(|a, b| a.0.total_cmp(&b.0));
        let shapes: Vec<usize> = best.values().map(|best| best.1).collect();
        let (information, score, groups) = evidence.joint(&shapes);
        let kept = sparse(&information, &score, &groups, price);
        Self {
            best_single: single.iter().map(|best| name(&blocks[best.1])).collect(),
            sparse_regression: kept.into_iter().map(|group| name(&blocks[shapes[group]])).collect(),
        }
    }
}

/// The `groups` of numbers, each of unit information, that are kept; a number costs `price` of chi squared.
fn sparse(
    information: &DMatrix<f64>,
    score: &DVector<f64>,
    groups: &[Range<usize>],
    price: f64,
) -> Vec<usize> {
    let solved = |kept: &[usize], ridge: f64| {
        let numbers: Vec<usize> = kept.iter().flat_map(|&group| groups[group].clone()).collect();
        let mut matrix = information.select_rows(&numbers).select_columns(&numbers);
        for number in 0..numbers.len() {
            matrix[(number, number)] += ridge;
        }
        let score = score.select_rows(&numbers);
        let theta = matrix.cholesky()?.solve(&score);
        Some((theta, score))
    };
    let thresholded = |threshold: f64| {
        let mut kept: Vec<usize> = (0..groups.len()).collect();
        while !kept.is_empty() {
            let (theta, _) = solved(&kept, RIDGE)?;
            let mut first = 0;
            let mut longer = kept.clone();
            longer.retain(|&group| {
                let width = groups[group].len();
                first += width;
                theta.rows(first - width, width).norm() >= threshold
            });
            if longer.len() == kept.len() {
                break;
            }
            kept = longer;
        }
        Some(kept)
    };
    let mut best = (0.0, Vec::new());
    for kept in (0..STEPS).filter_map(|step| thresholded(STEP.powi(step))) {
        let Some((theta, score)) = solved(&kept, SOLVABLE) else { continue };
        let gain = theta.dot(&score) - price * score.len() as f64;
        if gain > best.0 {
            best = (gain, kept);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    const SAMPLES: usize = 1000;

    /// Names by effect, each of which has blocks of these columns.
    fn named(
        matrix: &DMatrix<f64>,
        vector: &DVector<f64>,
        effects: &[&[&[usize]]],
    ) -> [Vec<&'static str>; 2] {
        let block = |candidate: usize, variant: usize, columns: &[usize]| Block {
            candidate,
            variant,
            variants: 1.0,
            columns: columns.to_vec(),
        };
        let variants = effects.iter().enumerate().flat_map(|(candidate, variants)| {
            variants.iter().enumerate().map(move |(variant, columns)| block(candidate, variant, columns))
        });
        let blocks: Vec<Block> = variants.collect();
        let raw = matrix.diagonal();
        let evidence = Evidence::new(matrix, vector, &raw, &|_| 1e9, &blocks, effects.len());
        let simpler = Simpler::of(&evidence, &blocks, SAMPLES, &|block| ["a", "b", "c"][block.candidate]);
        [simpler.best_single, simpler.sparse_regression]
    }

    /// Independent columns of other lengths than 1: chi squared falls by score² / information, 36 by a, 1 by b, 9 + 16 by the two numbers of
    /// c. A number costs ln 1000 = 6.9.
    #[test]
    fn independent_effects_are_named_for_what_they_explain() {
        let matrix = DMatrix::from_diagonal(&dvector![4.0, 1.0, 9.0, 0.25]);
        let vector = dvector![12.0, 1.0, 9.0, 2.0];
        let effects: &[&[&[usize]]] = &[&[&[0]], &[&[1]], &[&[2, 3]]];
        assert_eq!(named(&matrix, &vector, effects), [vec!["a"], vec!["a", "c"]]);
        // 9 of chi squared by a, and 6.25 by c: only a is worth its price.
        assert_eq!(named(&matrix, &(0.5 * &vector), effects), [vec!["a"], vec!["a"]]);
        // 4 at most: nothing is.
        assert_eq!(named(&matrix, &(vector / 3.0), effects), [vec![""; 0], vec![]]);
    }

    /// An effect's shapes are alternatives: the one that explains more stands for it.
    #[test]
    fn the_best_shape_of_an_effect_is_tried() {
        let matrix = dmatrix![1.0, 0.9, 0.0; 0.9, 1.0, 0.0; 0.0, 0.0, 1.0];
        let vector = dvector![9.0, 10.0, 9.5];
        assert_eq!(named(&matrix, &vector, &[&[&[0], &[1]], &[&[2]]]), [vec!["a"], vec!["a", "b"]]);
        assert_eq!(named(&matrix, &vector, &[&[&[0]], &[&[2]]]), [vec!["b"], vec!["a", "b"]]);
    }

    /// Two columns with a cosine of 0.99. Of a alone, (10, 0), the score is (10, 9.9); with the ridge its solution is (5.7, 4.0): the threshold
    /// between keeps a. Of both, (8, 8), neither alone explains all.
    #[test]
    fn of_alike_columns_those_are_kept_that_the_data_need() {
        let matrix = dmatrix![1.0, 0.99; 0.99, 1.0];
        let effects: &[&[&[usize]]] = &[&[&[0]], &[&[1]]];
        assert_eq!(named(&matrix, &(&matrix * dvector![10.0, 0.0]), effects), [vec!["a"], vec!["a"]]);
        // Either alone explains 15.92² = 253.4, both 2 · 8 · 15.92 = 254.7: that is not worth a number more.
        let both = &matrix * dvector![8.0, 8.0];
        assert_eq!(named(&matrix, &both, effects)[1].len(), 2, "nothing tells which one to leave out");
        // a and -b nearly cancel: alone, either would explain 1.96.
        let opposite = &matrix * dvector![140.0, -140.0];
        assert_eq!(named(&matrix, &opposite, effects), [vec![""; 0], vec!["a", "b"]]);
    }

    /// Nothing that can be seen, nothing that is named.
    #[test]
    fn without_columns_nothing_is_named() {
        assert_eq!(named(&DMatrix::zeros(1, 1), &dvector![0.0], &[&[&[0]]]), [vec![""; 0], vec![]]);
    }
}
