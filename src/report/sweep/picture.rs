//! The picture of a sweep: largest error against area, with the front of those that no other beats.

use super::super::svg::{MARGIN, Svg, WIDTH};
use super::columns::units;
use crate::spec::Throughput;
use crate::sweep::{AreaSource, Point, pareto_front};

const TOP: f64 = 100.0;
const HEIGHT: f64 = 460.0;
const LEFT: f64 = MARGIN + 66.0;
const RIGHT: f64 = WIDTH - MARGIN - 66.0;
const FRONT: &str = "#1f2328";
/// By architecture: what a dot's colour means.
const KINDS: [(&str, &str); 3] =
    [("#54aeff", "unrolled"), ("#8250df", "folded"), ("#d4a72c", "one iteration a clock")];

/// The place of a point's architecture in [`KINDS`].
fn kind(point: &Point) -> usize {
    match point.configuration.throughput {
        Throughput::CyclesPerPixel(1) => 0,
        Throughput::CyclesPerPixel(_) => 1,
        Throughput::OneIterationAClock => 2,
    }
}

/// A logarithmic axis over whole decades, or parts of one.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Around `values` (> 0), drawn from `from` to `to`.
    fn of(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let (low, high) = values
            .filter(|value| value.is_finite() && *value > 0.0)
            .fold((f64::INFINITY, 0.0f64), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = if low > high { (1.0, 10.0) } else { (low * 0.8, high * 1.25) };
        Self { low: low.log10(), high: high.log10(), from, to }
    }

    fn at(&self, value: f64) -> f64 {
        let place = (value.max(1e-300).log10() - self.low) / (self.high - self.low);
        self.from + place.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// Round numbers: over many decades powers of ten only.
    fn ticks(&self) -> Vec<f64> {
        let mantissas: &[f64] = match self.high - self.low {
            decades if decades > 3.0 => &[1.0],
            decades if decades > 1.0 => &[1.0, 2.0, 5.0],
            _ => &[1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0],
        };
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        decades
            .flat_map(|decade| mantissas.iter().map(move |mantissa| mantissa * 10f64.powi(decade)))
            .filter(|tick| (self.low..=self.high).contains(&tick.log10()))
            .collect()
    }
}

fn plain(value: f64) -> String {
    if (1e-3..1e6).contains(&value) {
        format!("{}", (value * 1e4).round() / 1e4)
    } else {
        format!("{value:.0e}")
    }
}

/// An SVG of `points`; `subtitle` says the conditions, in at most about 115 characters.
pub fn sweep_picture(points: &[Point], frequency_hz: f64, subtitle: &str) -> String {
    let [_, _, (_, mrad), (_, mm)] = units(16, frequency_hz);
    let bottom = TOP + HEIGHT;
    let mut svg = Svg::begin(bottom + 96.0, "Largest phase error against area", subtitle);
    let area = Axis::of(points.iter().map(|point| point.area.luts), LEFT, RIGHT);
    let error = Axis::of(points.iter().map(|point| point.max_turns() * mrad), bottom, TOP);
    let range =
        Axis { low: error.low + (mm / mrad).log10(), high: error.high + (mm / mrad).log10(), ..error };
    for tick in area.ticks() {
        svg.stroke(&[(area.at(tick), TOP), (area.at(tick), bottom)], "#eaeef2", 1.0);
        svg.text(area.at(tick), bottom + 20.0, "soft middle", &plain(tick));
    }
    for tick in error.ticks() {
        svg.stroke(&[(LEFT, error.at(tick)), (RIGHT, error.at(tick))], "#eaeef2", 1.0);
        svg.text(LEFT - 8.0, error.at(tick) + 4.0, "soft end", &plain(tick));
    }
    for tick in range.ticks() {
        svg.stroke(&[(RIGHT, range.at(tick)), (RIGHT + 4.0, range.at(tick))], "#57606a", 1.0);
        svg.text(RIGHT + 8.0, range.at(tick) + 4.0, "soft", &plain(tick));
    }
    svg.text(LEFT, TOP - 10.0, "soft", "mrad");
    svg.text(RIGHT, TOP - 10.0, "soft end", &format!("mm at {} MHz", frequency_hz / 1e6));
    let source = AreaSource::names(points.iter().map(|point| point.area.source));
    svg.text(
        (LEFT + RIGHT) / 2.0,
        bottom + 44.0,
        "middle",
        &format!("area, LUT4 + 2 CCU2C of an ECP5 ({source})"),
    );

    let at = |point: &Point| (area.at(point.area.luts), error.at(point.max_turns() * mrad));
    for point in points {
        svg.dot(at(point), 3.0, KINDS[kind(point)].0, &point.configuration.to_string());
    }
    let front: Vec<&Point> = pareto_front(points).into_iter().map(|place| &points[place]).collect();
    svg.stroke(&front.iter().map(|point| at(point)).collect::<Vec<_>>(), FRONT, 1.5);
    for point in &front {
        svg.dot(at(point), 4.5, KINDS[kind(point)].0, &point.configuration.to_string());
    }
    let y = bottom + 76.5;
    svg.stroke(&[(LEFT, y - 4.5), (LEFT + 24.0, y - 4.5)], FRONT, 1.5);
    svg.text(LEFT + 31.0, y, "soft", "no other is smaller and as exact");
    for ((colour, text), x) in KINDS.into_iter().zip([270.0, 380.0, 480.0]) {
        svg.swatch(LEFT + x, y - 10.5, colour);
        svg.text(LEFT + x + 19.0, y, "soft", text);
    }
    svg.end()
}
