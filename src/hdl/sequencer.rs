//! Template context of the sequencer.

use super::Source;
use super::control::Counters;
use super::text::{literal, table};
use askama::Template;

/// A case of a table: its label, and the value.
struct Row {
    label: String,
    value: String,
}

#[derive(Template)]
#[template(path = "sequencer.v", escape = "none")]
struct Sequencer {
    banner: String,
    prefix: String,
    scheme: String,
    step_bits: u32,
    phase_bits: u32,
    /// The comment's table.
    places: Vec<String>,
    ascending: bool,
    /// The step at each place.
    order: Vec<Row>,
    /// The phase of each step.
    phases: Vec<Row>,
    first_step: String,
    first_phase: String,
}

pub(super) fn sequencer(source: &Source, banner: String) -> askama::Result<String> {
    let modulation = &source.pipeline.modulation;
    let (step_bits, phase_bits) = (Counters::new(source).step_bits, modulation.phase_step_bits);
    let order = modulation.steps_in_order();
    let step = |number: usize| literal(step_bits, number as i64);
    let phase = |number: usize| literal(phase_bits, modulation.step_phase_code(number));
    let label = |number: usize| {
        if number + 1 == order.len() { "default".to_owned() } else { step(number) }
    };
    let places: Vec<Vec<String>> = order
        .iter()
        .enumerate()
        .map(|(place, &step)| {
            vec![format!("{place:<5}"), format!("{step:<4}"), modulation.step_phase_code(step).to_string()]
        })
        .collect();
    Sequencer {
        banner,
        prefix: source.pipeline.prefix(),
        scheme: modulation.scheme.name.to_string(),
        step_bits,
        phase_bits,
        places: table(&places),
        ascending: modulation.order.is_none(),
        order: order
            .iter()
            .enumerate()
            .map(|(place, &number)| Row { label: label(place), value: step(number) })
            .collect(),
        phases: (0..order.len()).map(|number| Row { label: label(number), value: phase(number) }).collect(),
        first_step: step(modulation.step_at(0)),
        first_phase: phase(modulation.step_at(0)),
    }
    .render()
}
