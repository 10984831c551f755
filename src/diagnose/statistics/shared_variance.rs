//! The evidence for errors of a common variance, of many clusters at once.

use super::periodogram::Sum;
use crate::physics::ln;
use crate::widest::widest;

/// Clusters that are done side by side.
const LANES: usize = 8;
/// Of each lane, clusters whose determinants are multiplied before their logarithm is taken: each of them is no more than some 10^15, and far from 10^38.
const TOGETHER: usize = 8;

/// Scores and information of so many clusters.
type Row = [[f64; LANES]; 2];

/// Scores and information of clusters, in units of one over a common error and of its inverse square, side by side; beyond the last one stand zeros, which
/// say nothing.
pub struct SharedVariance(Vec<Row>);

impl SharedVariance {
    /// Of those of the `clusters` that say anything.
    pub fn of(clusters: &[Sum]) -> Self {
        let heard: Vec<Sum> = clusters.iter().filter(|sum| sum.1 > 0.0).copied().collect();
        let row = |some: &[Sum]| {
            let mut row: Row = [[0.0; LANES]; 2];
            for (n, &(score, information)) in some.iter().enumerate() {
                (row[0][n], row[1][n]) = (score, information);
            }
            row
        };
        Self(heard.chunks(LANES).map(row).collect())
    }

    /// [`of_variance`](super::evidence::of_variance), summed over all of them.
    pub fn evidence(&self, variance: f64) -> f64 {
        let (mut squares, mut logarithms) = ([0.0; LANES], [0.0; LANES]);
        {
            let (squares, logarithms, rows) = (&mut squares, &mut logarithms, &self.0[..]);
            widest!((squares: &'a mut [f64; LANES], logarithms: &'a mut [f64; LANES],
                     rows: &'a [Row], variance: f64) {
                for rows in rows.chunks(TOGETHER) {
                    let mut determinants = [1.0; LANES];
                    for [scores, information] in rows {
                        for n in 0..LANES {
                            let share = 1.0 + variance * information[n];
                            squares[n] += scores[n] * scores[n] / share;
                            determinants[n] *= share;
                        }
                    }
                    for n in 0..LANES {
                        debug_assert!(!determinants[n].is_infinite(), "the logarithm knows finite numbers only");
                        logarithms[n] += ln(determinants[n]);
                    }
                }
            });
        }
        0.5 * (variance * squares.iter().sum::<f64>() - logarithms.iter().sum::<f64>())
    }
}

#[cfg(test)]
mod tests {
    use super::super::evidence::of_variance;
    use super::*;

    /// As many as fill no lane, and as have several logarithms; one that says nothing among them.
    #[test]
    fn clusters_together_are_clusters_one_by_one() {
        for many in [1, 7, 3 * LANES * TOGETHER + 5] {
            let of = |n: usize| (f64::from(n as u32) - 2.5, 10f64.powi(3 * (n % 8) as i32 - 8));
            let mut clusters: Vec<Sum> = (0..many).map(of).collect();
            clusters.push((3.0, 0.0));
            let together = SharedVariance::of(&clusters);
            for variance in [1e-9, 0.3, 1e4] {
                let one_by_one: f64 =
                    clusters[..many].iter().map(|&(s, i)| of_variance(variance, s, i)).sum();
                let together = together.evidence(variance);
                assert!(
                    (together - one_by_one).abs() < 1e-12 * one_by_one.abs().max(1.0),
                    "{many}: {together}, {one_by_one}"
                );
            }
        }
    }
}
