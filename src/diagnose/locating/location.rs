//! Where a residual lives: every coordinate's evidence, by columns and by errors that samples share.

use super::codes::Codes;
use super::coordinates::{COORDINATES, Coordinate, View};
use super::lines_at_signals::LinesAtSignals;
use super::mismatch::Place;
use super::parts::parts;
use super::patches::Patches;
use super::profiles::{Profile, Profiles};
use super::ranges::Ranges;
use super::read_anew::explained;
use super::velocities::is_of_place;
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::fitting::gram::{Gram, Whitened};
use crate::diagnose::fitting::noise::Noise;
use crate::diagnose::fitting::projected::Projected;
use crate::diagnose::periodic::images::alike;
use crate::diagnose::reading::data::Data;
use crate::diagnose::shared_errors::clusters::{Cluster, Clusters};
use crate::diagnose::shared_errors::jitters::Jitters;
use crate::diagnose::shared_errors::levels::Level;
use crate::diagnose::shared_errors::ripples::Ripple;
use crate::diagnose::shared_errors::swings::{Comes, Swing};
use crate::diagnose::shared_errors::tones::Tone;
use crate::diagnose::statistics::evidence::{Block, Evidence, Greatest};
use crate::diagnose::tangents::columns::Tangents;
use rayon::prelude::*;

/// Evidence (nats) from which on a coordinate counts as located.
pub const LOCATED_NATS: f64 = 4.0;

/// A coordinate that explains something.
#[derive(Debug, Clone)]
pub struct Located {
    /// Its name.
    pub coordinate: &'static str,
    /// What of it stands out, in words.
    pub shape: String,
    /// Evidence, nats: that of all its columns, or of a part of them that says more.
    pub ln_bayes: f64,
    /// Chi squared that those explain that say most, and how many they are.
    pub chi2: (f64, usize),
    /// Of waves, how many were looked at, and these over what the recordings themselves show of the noise; 1 of columns.
    pub looked: f64,
    /// What it is.
    pub kind: Kind,
}

/// What stands out in a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Columns.
    Columns,
    /// One column, of a target that is not where it is said to be.
    Place,
    /// A line or a wave, over what noise there is.
    Wave,
    /// A patch of pixels, or a few lines.
    Patch,
}

/// What the coordinates say of a fit.
#[derive(Debug, Clone)]
pub struct Location {
    /// Coordinates with columns, best first.
    pub columns: Vec<Located>,
    /// Random errors, best first.
    pub clusters: Vec<Cluster>,
    /// The strongest tone, where frames are off.
    pub tone: Option<Tone>,
    /// What frames say of errors of phase and time together.
    pub jitters: Jitters,
    /// The recording with the greatest misfit.
    pub take: usize,
    /// Period of the strongest wave over the codes, DN.
    pub period_dn: Option<f64>,
    /// Mean residuals over coordinates.
    pub curves: Vec<Profile>,
    /// Root of each pixel's chi squared a sample.
    pub map: Vec<f64>,
}

/// Coordinates of lines.
const LINES: [&str; 2] = ["row", "column"];

impl Location {
    /// Whether a place is a few rows or columns at signals of some height.
    pub fn is_of_lines_at_signals(&self, place: &Place) -> bool {
        let is_it = |of: &&Located| of.kind == Kind::Patch && of.shape == place.shape;
        self.columns.iter().find(is_it).is_some_and(|of| LINES.contains(&of.coordinate))
    }
}

/// What is seen frame by frame.
type Seen = (Clusters, Profiles, Codes, Patches, LinesAtSignals);

impl Located {
    /// A wave, the strongest of those that were looked at.
    fn wave(coordinate: &'static str, shape: String, Greatest { ln_bayes, chi2, looked }: Greatest) -> Self {
        Self { coordinate, shape, ln_bayes, chi2, looked, kind: Kind::Wave }
    }

    /// Whether it is what comes again after a number of sets.
    pub fn comes_by_sets(&self) -> bool {
        self.kind == Kind::Wave && self.coordinate == "set"
    }
}

/// Looks in all coordinates at what `base` leaves.
pub fn locate(data: &Data, base: &Fit, noise: Noise) -> Location {
    let ranges = Ranges::of(data, &base.pixels);
    let (tangents, _) = Tangents::new(data, &base.pixels, &base.pieces, &[]);
    let columns = |coordinate: &Coordinate| (coordinate.columns)(&ranges);
    let coordinates: Vec<&Coordinate> = COORDINATES.iter().filter(|c| columns(c) > 0).collect();
    let sizes: Vec<usize> = coordinates.iter().map(|coordinate| columns(coordinate)).collect();
    let fill = |take: usize, index: usize, frame: &crate::diagnose::tangents::columns::Frame| {
        let moment = &data.takes[take].moments[index];
        let view = View { moment, take, frame, pixels: &base.pixels, ranges: &ranges };
        coordinates.iter().map(|coordinate| (coordinate.fill)(&view)).collect()
    };
    let visit = |(clusters, profiles, codes, patches, lines): Seen, whitened: &Whitened| {
        (
            clusters.with(data, whitened),
            profiles.with(data, &ranges, base, whitened),
            codes.with(whitened, base.pixels.pedestal_dn),
            patches.with(data, whitened),
            lines.with(&ranges, whitened),
        )
    };
    let merge = |a: Seen, b: Seen| (a.0.and(b.0), a.1.and(b.1), a.2.and(b.2), a.3.and(b.3), a.4.and(b.4));
    let (gram, (clusters, profiles, codes, patches, lines)) =
        Gram::with_blocks(data, &tangents, noise, &|_| true, &sizes, &fill, &visit, &merge);
    let project = gram.projections();
    let projected: Vec<Projected> =
        (0..sizes.len()).into_par_iter().map(|block| project(block, base.jitter_m2)).collect();
    let mut columns: Vec<Located> = coordinates
        .iter()
        .zip(projected)
        .zip(&sizes)
        .enumerate()
        .map(|(number, ((coordinate, projected), &size))| {
            let all: Vec<usize> = (0..size).collect();
            let blocks = [vec![all], parts(coordinate.name, &ranges, size)].concat();
            let fitted = base.columns.len();
            let read_anew = |column: usize| {
                let at = |jitter_m2: f64| project(number, jitter_m2);
                explained(&at, base.jitter_m2, fitted, fitted + column)
            };
            let is_place = |column: usize| is_of_place(coordinate.name, column);
            let Said { ln_bayes, chi2, best, kind } =
                evidence(projected, fitted, &blocks, &is_place, &read_anew);
            let shape = (coordinate.shape)(&ranges, best);
            Located { coordinate: coordinate.name, shape, ln_bayes, chi2, looked: 1.0, kind }
        })
        .collect();
    let every = data.grid.every as f64;
    columns.extend(clusters.waves().into_iter().map(|(level, wave)| {
        let name = level.name();
        // Rounded to nothing it has no sign.
        let hz = if wave.hz.abs() < 5e-4 { 0.0 } else { wave.hz };
        let shape = format!("a wave of {:.1} {name}s, {hz:+.3} Hz", wave.lines * every);
        Located::wave(name, shape, wave.found)
    }));
    columns.extend(clusters.swings().into_iter().map(|Swing { mode, comes, found }| match comes {
        Comes::EverySets(2) => Located::wave("set", format!("{mode}, every other set"), found),
        Comes::EverySets(sets) => Located::wave("set", format!("{mode}, the same every {sets} sets"), found),
        Comes::Hz(hz) => Located::wave("time_s", format!("{mode}, a swing of {hz:.3} Hz"), found),
    }));
    columns.extend(clusters.ripples.strongest().into_iter().map(|Ripple { mode, period_m, found }| {
        Located::wave("position_m", format!("{mode}, a wave of {period_m:.3} m"), found)
    }));
    let mut ranked = clusters.ranked();
    // Frames that are not off have no tone.
    let are_off = |cluster: &Cluster| cluster.level == Level::Frame && cluster.ln_bayes > LOCATED_NATS;
    let tone = ranked.iter().any(are_off).then(|| clusters.tone()).flatten();
    let period_s =
        data.takes.first().and_then(|take| take.moments.first()).map_or(0.0, |of| of.frame_period_s);
    columns.extend(tone.map(|Tone { way, hz, found }| {
        Located::wave("time_s", format!("{way}, a tone of {}", alike(hz, period_s)), found)
    }));
    columns.extend(base.series.line_of_no_lamp().map(|line| {
        let shape = format!("offset, a line of {}", alike(line.frequency, period_s));
        Located::wave("time_s", shape, base.series.seen_beside_the_rest(&line))
    }));
    let wave_over_codes = codes.strongest();
    let period_dn = wave_over_codes.as_ref().map(|wave| wave.period_dn);
    columns.extend(wave_over_codes.map(|wave| {
        let shape = format!("with a period of {:.1} DN", wave.period_dn);
        Located::wave("code", shape, wave.found)
    }));
    let inverses = gram.inverses();
    let patch =
        |coordinate, shape, found| Located { kind: Kind::Patch, ..Located::wave(coordinate, shape, found) };
    let of_patch = patches.strongest(data, &inverses);
    columns.extend(of_patch.map(|of| patch("time_s", of.shape(data, &ranges), of.found)));
    let of_lines = lines.strongest(data, &inverses);
    columns.extend(of_lines.map(|of| patch(of.coordinate(), of.shape(data, &ranges), of.found)));
    columns.sort_by(|a, b| b.ln_bayes.total_cmp(&a.ln_bayes));
    // Beside errors that the noise has, columns are no more than they seem.
    if noise.jitter != [0.0; 2] {
        // What rows, columns and neighbours share is its shadow there.
        ranked.iter_mut().for_each(|cluster| (cluster.inflation, cluster.inflation_there) = (1.0, 1.0));
    }
    Location {
        columns,
        clusters: ranked,
        tone,
        jitters: clusters.jitters,
        take: base.series.worst_take(),
        period_dn,
        curves: profiles.curves(&ranges),
        map: profiles.map(),
    }
}

/// What a coordinate's columns say.
struct Said {
    ln_bayes: f64,
    chi2: (f64, usize),
    /// Which column alone says most.
    best: usize,
    /// What says most.
    kind: Kind,
}

/// What columns say that come after the `fitted` ones: those `blocks` of them, of which the first one is the whole, that say most. A block of one column by
/// which the place is off says what it does when readings are `read_anew` beside it.
fn evidence(
    mut projected: Projected,
    fitted: usize,
    blocks: &[Vec<usize>],
    is_place: &dyn Fn(usize) -> bool,
    read_anew: &dyn Fn(usize) -> f64,
) -> Said {
    projected.give_way(0..fitted);
    let block = |columns: &Vec<usize>| Block {
        candidate: 0,
        variant: 0,
        variants: blocks.len() as f64,
        columns: columns.iter().map(|column| fitted + column).collect(),
    };
    let of: Vec<Block> = blocks.iter().map(block).collect();
    let evidence = Evidence::new(
        &projected.matrix,
        &projected.vector,
        &projected.raw,
        &|_| f64::INFINITY,
        &of,
        COORDINATES.len(),
    );
    let mut ln_bayes: Vec<f64> = (0..of.len()).map(|block| evidence.ln_bayes(&[block])).collect();
    let mut scores: Vec<_> = (0..of.len()).map(|block| evidence.score(block).unwrap_or((0.0, 0))).collect();
    for (block, columns) in blocks.iter().enumerate() {
        if let [column] = columns[..]
            && is_place(column)
            && ln_bayes[block] > LOCATED_NATS
        {
            let more = (read_anew(column) - scores[block].0).max(0.0);
            ln_bayes[block] += 0.5 * more;
            scores[block].0 += more;
        }
    }
    let strongest = (0..of.len()).max_by(|&a, &b| ln_bayes[a].total_cmp(&ln_bayes[b])).unwrap_or(0);
    let alone = |column: usize| {
        let information = projected.matrix[(column, column)];
        let seen = information > crate::diagnose::statistics::evidence::VISIBLE * projected.raw[column]
            && information > 0.0;
        if seen { projected.vector[column].powi(2) / information } else { 0.0 }
    };
    let best = of[strongest].columns.iter().copied().max_by(|&a, &b| alone(a).total_cmp(&alone(b)));
    Said {
        ln_bayes: ln_bayes[strongest],
        chi2: scores[strongest],
        best: best.unwrap_or(fitted) - fitted,
        kind: match blocks[strongest][..] {
            [column] if is_place(column) => Kind::Place,
            _ => Kind::Columns,
        },
    }
}
