//! When what happens at the core's ports, in numbers and as timing diagrams.
//!
//! `tb/cocotb` drives the core as the diagrams show, gaps included, and compares every output in every clock that they draw.

use super::wave::{Diagram, Lane, Shown};
use crate::spec::{Architecture, Pipeline};

/// Clocks at the ports, without pauses and back-pressure, of vectors that the angle unit need not shift; weaker ones take up to
/// `most_shifts` clocks more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timing {
    /// Results that come one a clock before the next pause: the places of a folded unit's ring, else 1.
    pub results_a_burst: u64,
    /// From one burst's start to the next one's.
    pub clocks_a_burst: u64,
    /// From one result to the next, on average, where all vectors are as weak as can be.
    pub most_clocks_a_result: u64,
    /// What a set's first result can come later, where its vector is as weak as can be.
    pub most_shifts: u64,
    /// From the clock in which a set's last sample is taken to the one in which its first result is offered, when the stream
    /// then stays silent: the sample's register 1, the longest pause and one clock beyond it, the set's end 1, the read of the sums
    /// 1, their forming 1, and the latency.
    pub silence_to_first_result: u64,
    /// From the clock in which the next frame's first sample is taken, where that follows sooner: the sample's register 1, the
    /// set's end 1, the read of the sums 1, their forming 1, and the latency.
    pub next_frame_to_first_result: u64,
}

impl Timing {
    /// Those of `pipeline`.
    pub fn new(pipeline: &Pipeline) -> Self {
        let angle = &pipeline.derived().angle;
        let latency = u64::from(pipeline.derived().latency_clocks);
        let most_shifts = match angle.architecture {
            Architecture::Iterative if angle.cordic.normalise => angle.magnitude_bits,
            _ => 0,
        };
        let (results_a_burst, rounds) = match angle.architecture {
            Architecture::Folded { stages, rounds } => (stages, rounds),
            Architecture::Unrolled | Architecture::Iterative | Architecture::Tables => {
                (1, angle.clocks_a_vector(0))
            }
        };
        Self {
            results_a_burst: results_a_burst.into(),
            clocks_a_burst: u64::from(results_a_burst) * u64::from(rounds),
            most_clocks_a_result: angle.clocks_a_vector(most_shifts).into(),
            most_shifts: most_shifts.into(),
            silence_to_first_result: 1 + u64::from(pipeline.sensor.line_blanking_clocks) + 1 + 3 + latency,
            next_frame_to_first_result: 1 + 3 + latency,
        }
    }

    /// Clocks from the first result to that of `pixel`.
    fn result_at(&self, pixel: usize) -> u64 {
        let pixel = pixel as u64;
        pixel / self.results_a_burst * self.clocks_a_burst + pixel % self.results_a_burst
    }
}

/// What the ports show in a clock.
#[derive(Debug, Clone, Copy, Default)]
struct Clock {
    /// Number, among those of its set, of the sample that is offered.
    sample: Option<usize>,
    /// The core does not take it.
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
    /// So many clocks are left out: samples go on, one a clock, where one is offered before it.
    Gap(u64),
}

const IDLE: Clock = Clock { sample: None, waits: false, result: None, stopped: false };

fn sample(number: usize) -> Column {
    Column::Drawn(Clock { sample: Some(number), ..IDLE })
}

fn waiting(number: usize) -> Column {
    Column::Drawn(Clock { sample: Some(number), waits: true, ..IDLE })
}

/// The results of the first three of `pixels` pixels and, where it is wanted, the last one's, which the sink stops for a clock.
fn results(timing: &Timing, pixels: usize, last: bool) -> Vec<Column> {
    let mut columns = Vec::new();
    let mut at = 0;
    for pixel in [0, 1, 2].into_iter().chain(last.then_some(pixels - 1)) {
        let clocks = timing.result_at(pixel) - at;
        // A pause is drawn as one where it begins.
        let pause = columns.is_empty() || timing.result_at(pixel.min(3)) > at;
        match clocks {
            0 => {}
            1 if pause => columns.push(Column::Drawn(IDLE)),
            _ if pause => columns.extend([Column::Drawn(IDLE), Column::Gap(clocks - 1)]),
            _ => columns.push(Column::Gap(clocks)),
        }
        if pixel > 2 {
            columns.push(Column::Drawn(Clock { result: Some(pixel), stopped: true, ..IDLE }));
        }
        columns.push(Column::Drawn(Clock { result: Some(pixel), ..IDLE }));
        at = timing.result_at(pixel) + 1;
    }
    columns
}

/// The diagrams of `pipeline`: a set and its results, and a set that the next one follows at once.
pub fn diagrams(pipeline: &Pipeline) -> Vec<Diagram> {
    vec![whole_set(pipeline), next_set(pipeline)]
}

fn whole_set(pipeline: &Pipeline) -> Diagram {
    let timing = Timing::new(pipeline);
    let pixels = pipeline.geometry().pixels();
    let samples = pixels * pipeline.derived().frames_per_set;
    let mut columns = vec![
        Column::Drawn(IDLE),
        sample(0),
        sample(1),
        Column::Drawn(IDLE),
        sample(2),
        sample(3),
        Column::Gap((samples - 5) as u64),
        sample(samples - 1),
        Column::Drawn(IDLE),
        Column::Gap(timing.silence_to_first_result - 2),
    ];
    let (last_sample, first_result) = (7, columns.len());
    columns.extend(results(&timing, pixels, true));
    columns.push(Column::Drawn(IDLE));
    let clocks = format!("{} clocks", timing.silence_to_first_result);
    let frames = pipeline.derived().frames_per_set;
    let title = format!(
        "A set of {frames} raw frames of {pixels} pixels; its results after a silence, the last one stopped"
    );
    diagram(pipeline, "timing-set", title, &columns, (last_sample, first_result, clocks))
}

fn next_set(pipeline: &Pipeline) -> Diagram {
    let timing = Timing::new(pipeline);
    let pixels = pipeline.geometry().pixels();
    let samples = pixels * pipeline.derived().frames_per_set;
    let mut columns = vec![
        sample(samples - 3),
        sample(samples - 2),
        sample(samples - 1),
        // The next set: its first two samples fill the input's registers while the last set is closed.
        sample(0),
        sample(1),
        waiting(2),
        waiting(2),
        sample(2),
        Column::Drawn(IDLE),
        Column::Gap(timing.next_frame_to_first_result - 6),
    ];
    let (next, first_result) = (3, columns.len());
    columns.extend(results(&timing, pixels, false));
    let clocks = format!("{} clocks", timing.next_frame_to_first_result);
    let title = "The next set follows at once: it waits until the last one's drain is ahead of it".to_owned();
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
