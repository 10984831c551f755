//! A sweep's tables: the Pareto front, and one configuration octave by octave.

use super::super::table::aligned;
use super::columns::units;
use crate::sweep::{AreaSource, Coverage, Point, pareto_front, rounding_name, throughput_name};

/// Four significant digits, or none where there is nothing.
fn digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (3 - value.abs().log10().floor() as i32).clamp(0, 9) as usize;
    format!("{value:.decimals$}")
}

/// The configurations that no other beats in area and largest error, by rising area.
pub fn front_table(points: &[Point], frequency_hz: f64) -> String {
    let source = AreaSource::names(points.iter().map(|point| point.area.source));
    let area = format!("LUTs ({source})");
    let header = [
        &area,
        "word",
        "phase",
        "iterations",
        "guard x,y",
        "guard angle",
        "normaliser",
        "rounding",
        "clocks a pixel",
        "max LSB",
        "max mrad",
        "max mm",
        "RMS LSB",
        "mean LSB",
        "faithful",
        "worst vector",
    ];
    let row = |point: &Point| {
        let c = &point.configuration;
        let [(_, lsb), _, (_, mrad), (_, mm)] = units(c.phase_bits, frequency_hz);
        let mut cells = vec![
            format!("{:.0}", point.area.luts),
            format!("{} x {}", c.x_bits, c.y_bits),
            c.phase_bits.to_string(),
            c.iterations.to_string(),
            c.vector_guard_bits.to_string(),
            c.angle_guard_bits.to_string(),
            if c.normaliser { "yes" } else { "no" }.to_owned(),
            rounding_name(c.rounding).to_owned(),
            throughput_name(c.throughput),
        ];
        if let Some(figures) = point.overall() {
            let worst = figures.worst.map_or(String::new(), |worst| format!("{}, {}", worst.x, worst.y));
            cells.extend([
                digits(figures.max_turns * lsb),
                digits(figures.max_turns * mrad),
                digits(figures.max_turns * mm),
                digits(figures.rms_turns * lsb),
                digits(figures.mean_turns * lsb),
                if figures.all_faithful {
                    "all".to_owned()
                } else {
                    format!("{:.3} %", 100.0 * figures.faithful)
                },
                worst,
            ]);
        }
        cells
    };
    let rows = pareto_front(points).into_iter().map(|place| row(&points[place]));
    aligned(header.map(|text| text as &str), rows).to_string()
}

/// The errors of `point`, octave by octave.
pub fn octave_table(point: &Point, frequency_hz: f64) -> String {
    let units = units(point.configuration.phase_bits, frequency_hz);
    let header = [
        "amplitude",
        "vectors",
        "max LSB",
        "RMS LSB",
        "mean LSB",
        "octant mean LSB",
        "max mrad",
        "RMS mrad",
        "max mm",
        "RMS mm",
        "faithful",
        "correctly rounded",
        "worst vector",
    ];
    let [(_, lsb), _, (_, mrad), (_, mm)] = units;
    let rows = point.rows.iter().map(|row| {
        let figures = &row.figures;
        let amplitude = match row.octave {
            None => "all".to_owned(),
            Some(octave) => format!("{} to {}", 1u64 << octave, 1u64 << (octave + 1)),
        };
        let share = |share: f64| format!("{:.3} %", 100.0 * share);
        vec![
            amplitude,
            (figures.vectors + figures.corners).to_string(),
            digits(figures.max_turns * lsb),
            digits(figures.rms_turns * lsb),
            digits(figures.mean_turns * lsb),
            digits(figures.octant_mean_turns * lsb),
            digits(figures.max_turns * mrad),
            digits(figures.rms_turns * mrad),
            digits(figures.max_turns * mm),
            digits(figures.rms_turns * mm),
            if figures.all_faithful { "all".to_owned() } else { share(figures.faithful) },
            share(figures.correctly_rounded),
            figures.worst.map_or(String::new(), |worst| format!("{}, {}", worst.x, worst.y)),
        ]
    });
    let coverage = match point.coverage {
        Coverage::Exhaustive => "every vector".to_owned(),
        Coverage::Stratified { samples } => {
            format!(
                "weak vectors all, {samples} drawn in each octave above, and corners (only in maximum and \"all\")"
            )
        }
    };
    format!(
        "{}\n{coverage}; area {:.0} LUT4 + 2 CCU2C ({})\n\n{}",
        point.configuration,
        point.area.luts,
        point.area.source.name(),
        aligned(header, rows)
    )
}
