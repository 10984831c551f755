//! A measurement of area and speed as tables in Markdown: a function of the baseline and of the peers' table alone.

use super::table::aligned;
use crate::synthesis::{Accuracy, Baseline, Family, Kind, LIMIT_PERCENT, Mapped, Measured, Peer, Speed};
use crate::synthesis::{command_lines, peers};
use comfy_table::CellAlignment;
use std::fmt::Write;

/// Columns of the table of what was measured.
const MEASURED: [&str; 12] = [
    "target",
    "family",
    "LUTs",
    "LUT4",
    "carry cells",
    "FF",
    "block RAM",
    "DSP",
    "Fmax, MHz",
    "range, MHz",
    "latency, clocks",
    "clocks a sample",
];

/// Columns of the table of peers.
const COMPARED: [&str; 14] = [
    "core",
    "form",
    "input, phase bits",
    "amplitude",
    "clocks a sample",
    "latency",
    "LUT4 + 2 CCU2C",
    "FF",
    "RAM, DSP",
    "Fmax ECP5, MHz",
    "iCE40 LUT4",
    "Fmax HX8K, MHz",
    "max error: all / strong / weak",
    "RMS",
];

/// Rows under a header, numbers to the right.
fn table<const COLUMNS: usize>(header: [&str; COLUMNS], rows: &[[String; COLUMNS]]) -> String {
    let mut table = aligned(header, rows);
    let is_number =
        |cell: &String| cell.is_empty() || cell.starts_with(|c: char| c.is_ascii_digit() || c == '-');
    for (number, column) in table.column_iter_mut().enumerate() {
        if rows.iter().all(|row| is_number(&row[number])) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    let text = table.to_string();
    text.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}

fn optional(number: Option<u32>) -> String {
    number.map_or_else(|| "-".to_owned(), |number| number.to_string())
}

/// An error in 2^-16 turn.
fn error(turn: Option<f64>) -> String {
    turn.map_or_else(
        || "-".to_owned(),
        |turn| if turn < 100.0 { format!("{turn:.3}") } else { format!("{turn:.0}") },
    )
}

/// The rows of `targets`, one for each family.
pub fn measured_table(targets: &[Measured]) -> String {
    let rows: Vec<[String; MEASURED.len()]> = targets
        .iter()
        .flat_map(|target| target.results.iter().map(move |result| measured_row(target, result)))
        .collect();
    table(MEASURED, &rows)
}

fn measured_row(target: &Measured, result: &Mapped) -> [String; MEASURED.len()] {
    let area = &result.area;
    let [fmax, range] = match (&result.speed, result.speed.frequencies_mhz()) {
        (Speed::Routed(_), Some((median, least, largest))) => {
            [format!("{median:.1}"), format!("{least:.1} to {largest:.1}")]
        }
        (Speed::Routed(_), None) => ["-".to_owned(), "no seed".to_owned()],
        (Speed::DoesNotFit(why), _) => ["-".to_owned(), format!("does not fit: {why}")],
    };
    [
        target.name.clone(),
        result.family.name().to_owned(),
        area.luts.to_string(),
        area.lut4.to_string(),
        area.carries.to_string(),
        area.registers.to_string(),
        area.block_rams.to_string(),
        area.multipliers.to_string(),
        fmax,
        range,
        optional(target.latency_clocks),
        optional(target.clocks_per_sample),
    ]
}

/// Our bare angle cores, then the public ones.
pub fn comparison_table(targets: &[Measured]) -> String {
    let rows: Vec<[String; COMPARED.len()]> =
        targets.iter().filter_map(own_row).chain(peers().iter().map(peer_row)).collect();
    table(COMPARED, &rows)
}

fn own_row(target: &Measured) -> Option<[String; COMPARED.len()]> {
    let Kind::AngleCore { input_bits, phase_bits, amplitude } = target.kind else { return None };
    let on = |family: Family| target.results.iter().find(|result| result.family == family);
    let number =
        |family: Family, of: &dyn Fn(&Mapped) -> String| on(family).map_or_else(|| "-".to_owned(), of);
    let luts = |result: &Mapped| result.area.luts.to_string();
    let fmax = |result: &Mapped| {
        result.speed.frequencies_mhz().map_or_else(|| "-".to_owned(), |(median, ..)| format!("{median:.1}"))
    };
    let accuracy = target.accuracy.as_ref();
    let of = |error: fn(&Accuracy) -> f64| accuracy.map(error);
    Some([
        format!("**{}**", target.name),
        target.purpose.clone(),
        format!("{input_bits}, {phase_bits}"),
        if amplitude { "yes" } else { "no" }.to_owned(),
        optional(target.clocks_per_sample),
        optional(target.latency_clocks),
        number(Family::Ecp5, &luts),
        number(Family::Ecp5, &|result| result.area.registers.to_string()),
        number(Family::Ecp5, &|result| format!("{}, {}", result.area.block_rams, result.area.multipliers)),
        number(Family::Ecp5, &fmax),
        number(Family::Ice40, &luts),
        number(Family::Ice40, &fmax),
        errors([of(|a| a.largest), of(|a| a.largest_strong), of(|a| a.largest_weak)]),
        error(of(|a| a.rms)),
    ])
}

fn peer_row(peer: &Peer) -> [String; COMPARED.len()] {
    [
        format!("{}: {}", peer.project, peer.configuration),
        peer.form.clone(),
        format!("{}, {}", peer.input_bits, peer.phase_bits),
        peer.amplitude.clone(),
        optional(peer.clocks_per_sample),
        optional(peer.latency_clocks),
        peer.luts().to_string(),
        peer.registers.to_string(),
        format!("{}, {}", peer.block_rams, peer.multipliers),
        format!("{:.1}", peer.fmax_mhz),
        peer.ice40_luts.to_string(),
        format!("{:.1}", peer.ice40_fmax_mhz),
        errors([peer.largest, peer.largest_strong, peer.largest_weak]),
        error(peer.rms),
    ]
}

fn errors(errors: [Option<f64>; 3]) -> String {
    if errors == [None; 3] { "-".to_owned() } else { errors.map(error).join(" / ") }
}

/// Where the peers are from, and what one has to know of them: a line a project.
fn peer_notes() -> String {
    let mut notes: Vec<(String, Vec<String>)> = Vec::new();
    for peer in peers() {
        let head = format!("{}: {}; licence: {}", peer.project, peer.source, peer.licence);
        let position = notes.iter().position(|(other, _)| *other == head).unwrap_or_else(|| {
            notes.push((head, Vec::new()));
            notes.len() - 1
        });
        let remarks = &mut notes[position].1;
        for remark in peer.remark.split("; ").filter(|remark| !remark.is_empty()) {
            if !remarks.iter().any(|other| other == remark) {
                remarks.push(remark.to_owned());
            }
        }
    }
    let line = |(head, remarks): (String, Vec<String>)| {
        std::iter::once(head).chain(remarks).collect::<Vec<_>>().join("; ")
    };
    notes.into_iter().map(|note| format!("- {}.\n", line(note))).collect()
}

/// Codes from which the mean error is summed up.
const BIAS_FROM_CODES: u32 = 16;

/// Mean errors by octave of the length, where they were measured: what is largest for each core, then all.
fn bias(targets: &[Measured]) -> String {
    let (mut summary, mut rows) = (String::new(), Vec::new());
    for target in targets {
        let Some(accuracy) = &target.accuracy else { continue };
        if let Some(largest) = accuracy.largest_mean_from(BIAS_FROM_CODES) {
            let _ = writeln!(
                summary,
                "- {}: at most {largest:.4} in every octave from {BIAS_FROM_CODES} codes up ({} vectors)",
                target.name, accuracy.vectors
            );
        }
        for mean in &accuracy.means {
            let from = 1_u64 << mean.octave.min(63);
            let codes = format!("{from} to {}", 2 * u128::from(from));
            rows.push([target.name.clone(), codes, format!("{:+.4}", mean.mean)]);
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    format!("{summary}\n{}", table(["core", "length, codes", "mean error, 2^-16 turn"], &rows))
}

/// The whole of `synthesis.md`.
pub fn synthesis(baseline: &Baseline) -> String {
    let mut text = String::new();
    let seeds: Vec<String> = baseline.seeds.iter().map(u32::to_string).collect();
    let tools: String = baseline.tools.iter().map(|(job, version)| format!("- {job}: {version}\n")).collect();
    let parts: String =
        Family::ALL.iter().map(|family| format!("- {}: {}\n", family.name(), family.part())).collect();
    // Writing into a string cannot fail.
    let _ = write!(
        text,
        "# Area and speed\n\nGenerated by `vuris synth` (`make synth`): measured, do not edit. How to read it: `docs/synthesis.md`.\n\n\
         {tools}{parts}- seeds of the placement: {}\n- frequency that place and route aims at: {} MHz\n\n\
         LUTs: on ECP5 LUT4 + 2 CCU2C + 4 TRELLIS_DPR16X4, on iCE40 SB_LUT4, of the bare design; Fmax: median and range over the\n\
         seeds, from register to register, inside a wrapper with a register at every port bit. Latency: clocks from an input to its\n\
         result, from the specification. A change of more than {LIMIT_PERCENT} % against the accepted area fails `make synth`.\n\n{}\n",
        seeds.join(", "),
        baseline.target_mhz,
        measured_table(&baseline.targets),
    );
    for target in &baseline.targets {
        let _ = writeln!(text, "- {}: {}.{}", target.name, target.purpose, longest_paths(target));
    }
    let bias = bias(&baseline.targets);
    if !bias.is_empty() {
        let _ = write!(text, "\n## Mean error\n\n{bias}");
    }
    let _ = write!(
        text,
        "\n## Beside public cores\n\nOur bare angle cores in bold. The others were measured once, with the same tool versions by the same method (measured, not\n\
         re-run here). Errors of the phase against exact arithmetic, in 2^-16 turn: of all vectors, of the four highest octaves of\n\
         the length (strong), and of all vectors shorter than 16 codes (weak). Fmax is the median.\n\n{}\n{}",
        comparison_table(&baseline.targets),
        peer_notes(),
    );
    text += "\n## Command lines\n\n```\n";
    for family in Family::ALL {
        let [area, netlist, routing] = command_lines(family);
        let _ = write!(
            text,
            "yosys -q -p \"{area}\"\nyosys -q -p \"{netlist}\"\nnextpnr-{} {routing}\n",
            family.name()
        );
    }
    text + "```\n"
}

/// The longest path of the seed with the median frequency, for each family.
fn longest_paths(target: &Measured) -> String {
    let mut text = String::new();
    for result in &target.results {
        if let (Speed::Routed(routed), Some((median, ..))) = (&result.speed, result.speed.frequencies_mhz())
            && let Some(routed) = routed.iter().find(|routed| routed.fmax_mhz == median)
        {
            let _ = write!(text, " Longest path on {}: {}.", result.family.name(), routed.path);
        }
    }
    text
}
