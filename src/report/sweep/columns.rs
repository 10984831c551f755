//! The columns of a sweep's table, each once: CSV and Parquet are written from them.

use crate::sweep::{Coverage, Figures, Point, Row, rounding_name, throughput_name};
use crate::units::unambiguous_range_m;
use std::f64::consts::TAU;

/// A column's values, one a row.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Whole numbers.
    Integers(Vec<i64>),
    /// Real numbers.
    Reals(Vec<f64>),
    /// Words.
    Texts(Vec<String>),
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name, with the unit.
    pub name: String,
    /// Its values.
    pub values: Values,
}

/// A kind of error: its name, and its value in turns.
type Kind = (&'static str, fn(&Figures) -> f64);

/// The units in which an error is given: suffix of the column, and how many of it are a turn.
pub(super) fn units(phase_bits: u32, frequency_hz: f64) -> [(&'static str, f64); 4] {
    [
        ("lsb", f64::from(phase_bits).exp2()),
        ("lsb16", 65_536.0),
        ("mrad", 1e3 * TAU),
        ("mm", 1e3 * unambiguous_range_m(frequency_hz)),
    ]
}

/// All columns of `points`: a row for all octaves together (`octave` = "all") and one for each octave, of each point.
///
/// Errors are in LSB of the phase word, in 2^-16 turn, in mrad, and in mm of range at `frequency_hz`.
pub fn sweep_columns(points: &[Point], frequency_hz: f64) -> Vec<Column> {
    let rows: Vec<(&Point, &Row)> =
        points.iter().flat_map(|point| point.rows.iter().map(move |row| (point, row))).collect();
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    let integers = |name: &str, of: &dyn Fn(&Point, &Row) -> i64| {
        column(name, Values::Integers(rows.iter().map(|(point, row)| of(point, row)).collect()))
    };
    let reals = |name: &str, of: &dyn Fn(&Point, &Row) -> f64| {
        column(name, Values::Reals(rows.iter().map(|(point, row)| of(point, row)).collect()))
    };
    let texts = |name: &str, of: &dyn Fn(&Point, &Row) -> String| {
        column(name, Values::Texts(rows.iter().map(|(point, row)| of(point, row)).collect()))
    };
    let yes_no = |yes: bool| if yes { "yes" } else { "no" }.to_owned();

    let mut columns = vec![
        integers("metric", &|p, _| p.configuration.metric),
        integers("x_bits", &|p, _| p.configuration.x_bits.into()),
        integers("y_bits", &|p, _| p.configuration.y_bits.into()),
        integers("phase_bits", &|p, _| p.configuration.phase_bits.into()),
        integers("iterations", &|p, _| p.configuration.iterations.into()),
        integers("vector_guard_bits", &|p, _| p.configuration.vector_guard_bits.into()),
        integers("angle_guard_bits", &|p, _| p.configuration.angle_guard_bits.into()),
        integers("length_bits", &|p, _| p.configuration.length_bits.into()),
        texts("cycles_per_pixel", &|p, _| throughput_name(p.configuration.throughput)),
        integers("pipeline_every", &|p, _| p.configuration.pipeline_every.into()),
        texts("normaliser", &|p, _| yes_no(p.configuration.normaliser)),
        texts("rounding", &|p, _| rounding_name(p.configuration.rounding).to_owned()),
        reals("area_luts", &|p, _| p.area.luts),
        texts("area_source", &|p, _| p.area.source.name().to_owned()),
        texts("coverage", &|p, _| match p.coverage {
            Coverage::Exhaustive => "exhaustive".to_owned(),
            Coverage::Stratified { samples } => format!("{samples} an octave"),
        }),
        texts("octave", &|_, row| row.octave.map_or("all".to_owned(), |octave| octave.to_string())),
        integers("vectors", &|_, row| row.figures.vectors as i64),
        integers("corners", &|_, row| row.figures.corners as i64),
    ];
    let kinds: [Kind; 4] = [
        ("max", |figures| figures.max_turns),
        ("rms", |figures| figures.rms_turns),
        ("mean", |figures| figures.mean_turns),
        ("octant_mean", |figures| figures.octant_mean_turns),
    ];
    for (kind, turns) in kinds {
        for (place, (unit, _)) in units(16, frequency_hz).into_iter().enumerate() {
            columns.push(reals(&format!("{kind}_{unit}"), &|point, row| {
                turns(&row.figures) * units(point.configuration.phase_bits, frequency_hz)[place].1
            }));
        }
    }
    columns.extend([
        integers("worst_x", &|_, row| row.figures.worst.map_or(0, |worst| worst.x)),
        integers("worst_y", &|_, row| row.figures.worst.map_or(0, |worst| worst.y)),
        reals("faithful_percent", &|_, row| 100.0 * row.figures.faithful),
        reals("correctly_rounded_percent", &|_, row| 100.0 * row.figures.correctly_rounded),
        texts("all_faithful", &|_, row| yes_no(row.figures.all_faithful)),
    ]);
    columns
}
