//! `vuris sweep --recommend`: the cheapest unit that is exact enough, as a specification.

use super::super::print::say;
use super::super::progress;
use super::{Candidate, Sweep, areas, specification};
use crate::physics::{Light, Sensor};
use crate::problem::{Problem, Result};
use crate::spec::{AngleUnit, Design};
use crate::sweep::{
    Coverage, ExactAngle, Figures, Grid, Plan, Requirement, Row, SensorNoise, Shard, evaluate,
};
use crate::units::unambiguous_range_m;
use clap::Args;
use std::f64::consts::TAU;
use std::process::ExitCode;

const MOST_PHASE_BITS: u32 = 24;
/// Vectors an octave with which most of what fails is seen to fail.
const PROBE_SAMPLES: u64 = 64;

#[derive(Debug, Args)]
pub(super) struct Recommend {
    /// Print the specification of the least area that meets --error or --add-noise, from --spec; the lists above limit the search
    #[arg(long, conflicts_with_all = ["word", "out", "shard", "merge"])]
    recommend: bool,
    /// Largest error of the phase, such as 0.1mrad, 0.01deg or 0.5mm
    #[arg(long, value_name = "ERROR", requires = "recommend", conflicts_with = "add_noise")]
    error: Option<String>,
    /// For --error: the largest error among the vectors that are evaluated is enough; without it, the worst case that is proved for
    /// every vector must hold
    #[arg(long, requires = "error")]
    sampled: bool,
    /// Share of the sensor's own phase noise that the arithmetic may add, such as 1%
    #[arg(long, value_name = "SHARE", requires = "recommend")]
    add_noise: Option<String>,
    /// For --add-noise: amplitude of a pixel in a raw frame, DN
    #[arg(long, value_name = "DN", default_value_t = 300.0)]
    amplitude_dn: f64,
    /// For --add-noise: mean of a pixel in a raw frame without the pedestal, DN [default: 1.25 times the amplitude, and 100]
    #[arg(long, value_name = "DN")]
    offset_dn: Option<f64>,
    /// For --add-noise: electrons a DN
    #[arg(long, value_name = "E", default_value_t = 100.0)]
    gain_e_per_dn: f64,
    /// For --add-noise: standard deviation of the read noise, electrons
    #[arg(long, value_name = "E", default_value_t = 100.0)]
    read_noise_e: f64,
}

impl Recommend {
    pub(super) fn is_asked_for(&self) -> bool {
        self.recommend
    }

    /// What is asked, and the same in words.
    fn requirement(&self, design: &Design, frequency_hz: f64) -> Result<(Requirement, String)> {
        if let Some(text) = &self.error {
            let requirement = Requirement::error(text, frequency_hz)?;
            let words = match self.sampled {
                false => {
                    format!("no vector more than {text} off, by the bound that is proved for every vector")
                }
                true => format!(
                    "none of the evaluated vectors more than {text} off, which is not proved of others"
                ),
            };
            return Ok((requirement, words));
        }
        let Some(text) = &self.add_noise else {
            return Err(Problem::at("--recommend", "nothing is asked of the unit")
                .expected("--error or --add-noise")
                .remedy("add --error 0.1mrad, or --add-noise 1%"));
        };
        let pipeline = specification::camera_of(design)?;
        let share = Requirement::share(text)?;
        for (option, value) in
            [("--gain-e-per-dn", self.gain_e_per_dn), ("--read-noise-e", self.read_noise_e)]
        {
            if !(value.is_finite() && value >= 0.0 && (value > 0.0 || option == "--read-noise-e")) {
                return Err(Problem::at(option, value).expected("a positive number"));
            }
        }
        let sensor =
            Sensor { gain_e_per_dn: self.gain_e_per_dn, read_noise_e: self.read_noise_e, ..Sensor::vuris() };
        let ambient_dn = sensor.ambient_e / Sensor::vuris().gain_e_per_dn;
        let offset_dn = self.offset_dn.unwrap_or(sensor.constant_ratio * self.amplitude_dn + ambient_dn);
        let light = Light {
            amplitude_e: self.amplitude_dn * sensor.gain_e_per_dn,
            offset_e: offset_dn * sensor.gain_e_per_dn,
        };
        let noise = SensorNoise::of(pipeline, &sensor, light)?;
        let words = format!(
            "at most {text} added to the sensor's phase noise of {:.4} mrad (amplitude {} DN, offset {offset_dn} DN, \
             {} e/DN, read noise {} e, scheme {})",
            1e3 * TAU * noise.turns,
            self.amplitude_dn,
            self.gain_e_per_dn,
            self.read_noise_e,
            pipeline.modulation.scheme.name
        );
        Ok((Requirement::AddedNoise { share, noise }, words))
    }
}

impl Sweep {
    /// Prints the specification of the least area that meets the requirement.
    pub(super) fn recommended(&self, design: &Design) -> Result<ExitCode> {
        let frequency_hz = self.frequency_hz(design)?;
        let (requirement, words) = self.recommend.requirement(design, frequency_hz)?;
        let area = areas::fitted;
        let mut candidates = self.candidates(design, &requirement)?;
        let Some(&(first, _)) = candidates.first() else { return Err(unmet(0, &words)) };
        let probe = Plan::new(&first, PROBE_SAMPLES, false);
        let plan = Plan::new(&first, self.samples, self.exhaustive);
        candidates.sort_by(|(_, a), (_, b)| area(a).luts.total_cmp(&area(b).luts));
        let bar = progress::bar(candidates.len() as u64);
        let mut tried = 0;
        for (configuration, unit) in &candidates {
            bar.inc(1);
            tried += 1;
            let Some(rows) = self.tested(unit, &requirement, [&probe, &plan]) else { continue };
            bar.finish_and_clear();
            let text = specification::text_with(design, configuration)?;
            let area = area(unit);
            say!("# By `vuris sweep --recommend`: {words}.");
            say!(
                "# Tried {tried} of {} candidates by rising area; this is the first that holds.",
                candidates.len()
            );
            say!("# Area of its angle unit: {:.0} LUT4 + 2 CCU2C ({}).", area.luts, area.source.name());
            say!("# {}", errors(frequency_hz, unit, (plan.coverage(), &rows), &requirement));
            say!("{}", text.trim_end());
            return Ok(ExitCode::SUCCESS);
        }
        bar.finish_and_clear();
        Err(unmet(candidates.len(), &words))
    }

    /// What is tried: the lists of the options, or all that could make sense.
    fn candidates(&self, design: &Design, requirement: &Requirement) -> Result<Vec<Candidate>> {
        // A specification's phase has 8 to 24 bits.
        let least = requirement.least_phase_bits().max(8);
        if least > MOST_PHASE_BITS {
            return Ok(Vec::new());
        }
        // Iterations far from the phase bits cost, or cannot do.
        let iterations = least.saturating_sub(3).max(4)..=(least + 7).min(30);
        let listed = self.grid(specification::unit_of(design))?;
        let or = |option: &Option<String>, list: Vec<u32>, otherwise: Vec<u32>| {
            if option.is_some() { list } else { otherwise }
        };
        let grid = Grid {
            phase_bits: or(
                &self.phase_bits,
                listed.phase_bits,
                (least..=MOST_PHASE_BITS.min(least + 3)).collect(),
            ),
            iterations: or(&self.iterations, listed.iterations, iterations.collect()),
            vector_guard_bits: or(&self.vector_guard_bits, listed.vector_guard_bits, (0..=5).collect()),
            angle_guard_bits: or(&self.angle_guard_bits, listed.angle_guard_bits, (1..=6).collect()),
            ..listed
        };
        let mut candidates = grid.configurations()?;
        candidates.retain(|(configuration, unit)| {
            let proved = match *requirement {
                Requirement::Error { turns } if !self.recommend.sampled => {
                    unit.budget().phase_rad() / TAU <= turns
                }
                _ => true,
            };
            configuration.phase_bits >= least && proved
        });
        Ok(candidates)
    }

    /// The errors of `unit` over the second of `plans` if they meet `requirement`.
    fn tested(&self, unit: &AngleUnit, requirement: &Requirement, plans: [&Plan; 2]) -> Option<Vec<Row>> {
        let exact = ExactAngle::new(unit.metric);
        let rows = |plan: &Plan| Figures::rows(&evaluate(unit, &exact, plan, Shard::WHOLE, &|_| ()));
        // A few vectors first: a largest error only grows with more.
        let [probe, plan] = plans;
        if matches!(requirement, Requirement::Error { .. }) && !requirement.is_met(&rows(probe)) {
            return None;
        }
        let rows = rows(plan);
        requirement.is_met(&rows).then_some(rows)
    }
}

fn unmet(candidates: usize, words: &str) -> Problem {
    Problem::at("--recommend", format_args!("none of {candidates} candidates holds: {words}"))
        .expected("a requirement that 24 bits of phase and 6 of guard can meet")
        .remedy(
            "ask for less, give --sampled with --error, or give other --phase-bits, --iterations, --vector-guard-bits, --angle-guard-bits",
        )
}

/// A line of what was measured and what is proved.
fn errors(
    frequency_hz: f64,
    unit: &AngleUnit,
    (coverage, rows): (Coverage, &[Row]),
    requirement: &Requirement,
) -> String {
    let max_turns = rows.first().map_or(f64::NAN, |row| row.figures.max_turns);
    let codes = f64::from(unit.phase_bits).exp2();
    let proved_turns = unit.budget().phase_codes() / codes;
    let turn_mm = 1e3 * unambiguous_range_m(frequency_hz);
    let size = |turns: f64| {
        format!("{:.4} mrad = {:.4} mm = {:.3} LSB", 1e3 * TAU * turns, turns * turn_mm, turns * codes)
    };
    let vectors = match coverage {
        Coverage::Exhaustive => "all vectors".to_owned(),
        Coverage::Stratified { samples } => {
            format!("weak vectors, corners and {samples} drawn in each octave")
        }
    };
    let mut text = format!(
        "Largest error of {vectors}: {}; proved for every vector: {}.",
        size(max_turns),
        size(proved_turns)
    );
    if let Requirement::AddedNoise { noise, .. } = *requirement {
        let added = Requirement::added_noise(rows, noise).unwrap_or(f64::NAN);
        text += &format!(" Added noise {:.3} % (RMS of the same vectors).", 100.0 * added);
    }
    text
}
