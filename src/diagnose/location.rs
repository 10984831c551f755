//! Where a residual lives: every coordinate's evidence, by columns and by errors that samples share.

use super::clusters::{Cluster, Clusters};
use super::columns::Tangents;
use super::coordinates::{COORDINATES, View};
use super::data::Data;
use super::evidence::{Block, Evidence};
use super::fit::Fit;
use super::gram::{Gram, Noise, Projected, Whitened};
use super::profiles::{Profile, Profiles};
use super::ranges::Ranges;

/// A coordinate that explains something.
#[derive(Debug, Clone)]
pub struct Located {
    /// Its name.
    pub coordinate: &'static str,
    /// What of it stands out, in words.
    pub shape: String,
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// Chi squared that it explains, and by how many columns.
    pub chi2: (f64, usize),
}

/// What the coordinates say of a fit.
#[derive(Debug, Clone)]
pub struct Location {
    /// Coordinates with columns, best first.
    pub columns: Vec<Located>,
    /// Random errors, best first.
    pub clusters: Vec<Cluster>,
    /// The recording with the greatest misfit.
    pub take: usize,
    /// Mean residuals over coordinates.
    pub curves: Vec<Profile>,
    /// Root of each pixel's chi squared a sample.
    pub map: Vec<f64>,
}

/// Looks in all coordinates at what `base` leaves.
pub fn locate(data: &Data, base: &Fit, noise: Noise) -> Location {
    let ranges = Ranges::of(data, &base.pixels);
    let (tangents, _) = Tangents::new(data, &base.pixels, &base.pieces, &[]);
    let sizes: Vec<usize> = COORDINATES.iter().map(|coordinate| (coordinate.columns)(&ranges)).collect();
    let fill = |take: usize, index: usize, frame: &super::columns::Frame| {
        let moment = &data.takes[take].moments[index];
        let view = View { moment, take, frame, pixels: &base.pixels, ranges: &ranges };
        COORDINATES.iter().map(|coordinate| (coordinate.fill)(&view)).collect()
    };
    let visit = |(clusters, profiles): (Clusters, Profiles), whitened: &Whitened| {
        (clusters.with(data, whitened), profiles.with(data, &ranges, base, whitened))
    };
    let merge = |a: (Clusters, Profiles), b: (Clusters, Profiles)| (a.0.and(b.0), a.1.and(b.1));
    let (gram, (clusters, profiles)) =
        Gram::with_blocks(data, &tangents, noise, &|_| true, &sizes, &fill, &visit, &merge);
    let projected = gram.project_all(base.jitter_m2);
    let mut columns: Vec<Located> = COORDINATES
        .iter()
        .zip(projected)
        .zip(&sizes)
        .map(|((coordinate, projected), &size)| {
            let (ln_bayes, chi2, best) = evidence(projected, base.columns.len(), size);
            let shape = (coordinate.shape)(&ranges, best);
            Located { coordinate: coordinate.name, shape, ln_bayes, chi2 }
        })
        .collect();
    columns.sort_by(|a, b| b.ln_bayes.total_cmp(&a.ln_bayes));
    Location {
        columns,
        clusters: clusters.ranked(),
        take: base.series.worst_take(),
        curves: profiles.curves(&ranges),
        map: profiles.map(),
    }
}

/// Evidence and explained chi squared of a coordinate's columns together, and which of them alone says most.
fn evidence(mut projected: Projected, fitted: usize, size: usize) -> (f64, (f64, usize), usize) {
    projected.give_way(fitted);
    let block = Block { candidate: 0, variant: 0, variants: 1.0, columns: (fitted..fitted + size).collect() };
    let blocks = [block];
    let evidence = Evidence::new(
        &projected.matrix,
        &projected.vector,
        &projected.raw,
        &|_| f64::INFINITY,
        &blocks,
        COORDINATES.len(),
    );
    let alone = |column: usize| {
        let information = projected.matrix[(column, column)];
        let seen = information > super::evidence::VISIBLE * projected.raw[column] && information > 0.0;
        if seen { projected.vector[column].powi(2) / information } else { 0.0 }
    };
    let best = (fitted..fitted + size).max_by(|&a, &b| alone(a).total_cmp(&alone(b))).unwrap_or(fitted);
    (evidence.ln_bayes(&[0]), evidence.score(0).unwrap_or((0.0, 0)), best - fitted)
}
