//! When what happens at the core's ports, in numbers and as timing diagrams.
//!
//! `tb/cocotb` drives the core as the diagrams show, gaps included, and compares every output in every clock that they draw.

use super::wave::{Diagram, Lane, Shown};
use crate::spec::Pipeline;

/// Clocks at the ports, without pauses and back-pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timing {
    /// From one result to the next.
    pub clocks_per_result: u64,
    /// From the clock in which a set's last sample is taken to the one in which its first result is offered, when the stream
    /// then stays silent: the sample's register 1, the longest pause and one clock beyond it, the set's end 1, the read of the sums
    /// 1, and the latency.
    pub silence_to_first_result: u64,
    /// From the clock in which the next frame's first sample is taken, where that follows sooner: the sample's register 1, the
    /// set's end 1, the read of the sums 1, and the latency.
    pub next_frame_to_first_result: u64,
}

impl Timing {
    /// Those of `pipeline`.
    pub fn new(pipeline: &Pipeline) -> Self {
        let latency = u64::from(pipeline.derived().latency_clocks);
        Self {
            clocks_per_result: 1,
            silence_to_first_result: 1 + u64::from(pipeline.sensor.line_blanking_clocks) + 1 + 2 + latency,
            next_frame_to_first_result: 1 + 2 + latency,
        }
    }
}

/// What the ports show in a clock.
#[derive(Debug, Clone, Copy, Default)]
struct Clock {
    /// Number, among those of its set, of the sample that is offered.
    sample: Option<usize>,
    /// The core takes it.
    waits: bool,
    /// Pixel whose result is offered.
    result: Option<usize>,
    /// The sink does not take it.
    stopped: bool,
}

/// A column of a diagram.
#[derive(Debug, Clone, Copy)]
enum Column {
    Drawn(Clock),
    /// So many clocks are left out: samples or results go on, one a clock, where they are offered before it, and else nothing happens.
    Gap(u64),
}

const IDLE: Column = Column::Drawn(Clock { sample: None, waits: false, result: None, stopped: false });

fn sample(number: usize) -> Column {
    Column::Drawn(Clock { sample: Some(number), ..Clock::default() })
}

fn waiting(number: usize) -> Column {
    Column::Drawn(Clock { sample: Some(number), waits: true, ..Clock::default() })
}

fn result(pixel: usize) -> Column {
    Column::Drawn(Clock { result: Some(pixel), ..Clock::default() })
}

fn stopped(pixel: usize) -> Column {
    Column::Drawn(Clock { result: Some(pixel), stopped: true, ..Clock::default() })
}

/// The diagrams of `pipeline`: a set and its results, and a set that the next one follows at once.
pub fn diagrams(pipeline: &Pipeline) -> Vec<Diagram> {
    vec![whole_set(pipeline), next_set(pipeline)]
}

fn whole_set(pipeline: &Pipeline) -> Diagram {
    let timing = Timing::new(pipeline);
    let pixels = pipeline.geometry().pixels();
    let samples = pixels * pipeline.derived().frames_per_set;
    let (last, first_result) = (7, 10);
    let columns = [
        IDLE,
        sample(0),
        sample(1),
        IDLE,
        sample(2),
        sample(3),
        Column::Gap((samples - 5) as u64),
        sample(samples - 1),
        IDLE,
        Column::Gap(timing.silence_to_first_result - 2),
        result(0),
        stopped(1),
        result(1),
        result(2),
        Column::Gap((pixels - 4) as u64),
        result(pixels - 1),
        IDLE,
    ];
    let clocks = format!("{} clocks", timing.silence_to_first_result);
    let title = format!(
        "A set of {} raw frames of {pixels} pixels; its results after a silence, with one stop by the sink",
        pipeline.derived().frames_per_set
    );
    diagram(pipeline, "timing-set", title, &columns, (last, first_result, clocks))
}

fn next_set(pipeline: &Pipeline) -> Diagram {
    let timing = Timing::new(pipeline);
    let samples = pipeline.geometry().pixels() * pipeline.derived().frames_per_set;
    let (next, first_result) = (3, 11);
    let columns = [
        sample(samples - 3),
        sample(samples - 2),
        sample(samples - 1),
        // The next set: its first two samples fill the input's registers while the last set is closed.
        sample(0),
        sample(1),
        waiting(2),
        waiting(2),
        sample(2),
        sample(3),
        IDLE,
        Column::Gap(timing.next_frame_to_first_result - 7),
        result(0),
        result(1),
        result(2),
    ];
    let clocks = format!("{} clocks", timing.next_frame_to_first_result);
    let title =
        "The next set follows at once: its first samples wait until the last set's drain is ahead".to_owned();
    diagram(pipeline, "timing-next-set", title, &columns, (next, first_result, clocks))
}

fn diagram(
    pipeline: &Pipeline,
    name: &'static str,
    title: String,
    columns: &[Column],
    (from, to, clocks): (usize, usize, String),
) -> Diagram {
    let (width, pixels) = (pipeline.sensor.width, pipeline.geometry().pixels());
    let gaps: Vec<bool> = columns.iter().map(|column| matches!(column, Column::Gap(_))).collect();
    // A signal from what it shows in a clock that is drawn; nothing: no meaning.
    let signal = |name: &str, one_bit: bool, value: &dyn Fn(Clock) -> Option<Shown>| {
        let shown = columns.iter().map(|column| match column {
            Column::Gap(_) => Shown::Gap,
            Column::Drawn(clock) => value(*clock).unwrap_or(Shown::Nothing),
        });
        Lane::signal(name, one_bit, &shown.collect::<Vec<_>>())
    };
    let bit = |set: bool| Some(Shown::Value(set.into()));
    let ends_line = |number: usize| bit(number % width == width - 1);
    let starts = |number: usize| {
        Some(Shown::Value(u32::from(number == 0) << 1 | u32::from(number.is_multiple_of(pixels))))
    };
    let lanes = vec![
        Lane::clock("clk_i", &gaps),
        signal("s_axis_tvalid", true, &|clock| bit(clock.sample.is_some())),
        signal("s_axis_tready", true, &|clock| bit(!clock.waits)),
        signal("s_axis_tdata", false, &|clock| Some(Shown::Label(format!("s{}", clock.sample?)))),
        signal("s_axis_tlast", true, &|clock| ends_line(clock.sample?)),
        signal("s_axis_tuser", false, &|clock| starts(clock.sample?)),
        Lane::arrows(columns.len(), &[('a', from), ('b', to)]),
        signal("m_axis_tvalid", true, &|clock| bit(clock.result.is_some())),
        signal("m_axis_tready", true, &|clock| bit(!clock.stopped)),
        signal("m_axis_tdata", false, &|clock| Some(Shown::Label(format!("r{}", clock.result?)))),
        signal("m_axis_tlast", true, &|clock| ends_line(clock.result?)),
        signal("m_axis_tuser", true, &|clock| bit(clock.result? == 0)),
    ];
    let gap_clocks = columns.iter().filter_map(|column| match column {
        Column::Gap(clocks) => Some(*clocks),
        Column::Drawn(_) => None,
    });
    Diagram { name, title, lanes, arrows: vec![('a', 'b', clocks)], gap_clocks: gap_clocks.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::PRESETS;

    /// Every arrow spans as many clocks as it says.
    #[test]
    fn arrows_span_the_clocks_that_they_name() {
        for preset in PRESETS {
            for diagram in diagrams(&Pipeline::named(preset.name).unwrap()) {
                let nodes = &diagram.lanes.iter().find(|lane| !lane.nodes.is_empty()).unwrap().nodes;
                for (from, to, text) in &diagram.arrows {
                    let (from, to) = (nodes.find(*from).unwrap(), nodes.find(*to).unwrap());
                    let mut gaps = diagram.gap_clocks.iter();
                    let clocks: u64 = diagram.lanes[0]
                        .wave
                        .chars()
                        .enumerate()
                        .map(|(column, letter)| {
                            (column, if letter == '|' { *gaps.next().unwrap() } else { 1 })
                        })
                        .filter(|(column, _)| (from..to).contains(column))
                        .map(|(_, clocks)| clocks)
                        .sum();
                    assert_eq!(format!("{clocks} clocks"), *text, "{}", diagram.name);
                }
            }
        }
    }
}
