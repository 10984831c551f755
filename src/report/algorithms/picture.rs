//! The picture of sensitivity curves: a panel for each disturbance, a line for each algorithm.

use super::super::svg::{MARGIN, Svg, WIDTH};
use super::curves::Bench;
use crate::algorithms::{Algorithm, Curve, PhaseError};

/// Lines' colours, in the algorithms' order; more algorithms than colours begin anew.
const COLOURS: [&str; 8] =
    ["#1f2328", "#0969da", "#bc4c00", "#1a7f37", "#8250df", "#cf222e", "#9a6700", "#57606a"];

const TOP: f64 = 128.0;
const GAP: f64 = 74.0;
const PANEL_WIDTH: f64 = (WIDTH - 2.0 * MARGIN - GAP - 56.0) / 2.0;
const PANEL_HEIGHT: f64 = 240.0;
const ROW_HEIGHT: f64 = PANEL_HEIGHT + 84.0;
/// The axis of errors, mrad: logarithmic, what is below lies on its lower end.
const DECADES: (i32, i32) = (-3, 3);

/// A panel's place.
struct Panel {
    left: f64,
    top: f64,
    low: f64,
    high: f64,
}

impl Panel {
    fn x(&self, value: f64) -> f64 {
        self.left + (value - self.low) / (self.high - self.low) * PANEL_WIDTH
    }

    fn y(&self, rms_rad: f64) -> f64 {
        let (low, high) = (f64::from(DECADES.0), f64::from(DECADES.1));
        let decade = (1e3 * rms_rad).max(1e-300).log10().clamp(low, high);
        self.top + (high - decade) / (high - low) * PANEL_HEIGHT
    }

    fn frame(&self, svg: &mut Svg, curve: Curve) {
        let bottom = self.top + PANEL_HEIGHT;
        for decade in DECADES.0..=DECADES.1 {
            let y = self.y(1e-3 * 10f64.powi(decade));
            svg.stroke(&[(self.left, y), (self.left + PANEL_WIDTH, y)], "#eaeef2", 1.0);
            svg.text(self.left - 8.0, y + 4.0, "soft end", &format!("{}", 10f64.powi(decade)));
        }
        for tick in ticks(self.low, self.high) {
            svg.stroke(&[(self.x(tick), bottom), (self.x(tick), bottom + 4.0)], "#57606a", 1.0);
            svg.text(self.x(tick), bottom + 20.0, "soft middle", &format!("{tick}"));
        }
        let (name, unit) = curve.axis();
        svg.text(self.left, self.top - 12.0, "strong", name);
        svg.text(self.left + PANEL_WIDTH, self.top - 12.0, "soft end", "mrad RMS");
        svg.text(self.left + PANEL_WIDTH / 2.0, bottom + 40.0, "middle", unit);
    }
}

/// Whole numbers that cut the range into at most about ten parts.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|step| (high - low) / step <= 10.0).unwrap_or(20.0);
    let first = (low / step).ceil() as i32;
    (first..=(high / step).floor() as i32).map(|tick| f64::from(tick) * step).collect()
}

/// An SVG of the RMS swing of the phase of `algorithms` under every disturbance, on `bench`.
pub fn algorithms_picture(algorithms: &[Algorithm], bench: &Bench) -> String {
    let rows = Curve::ALL.len().div_ceil(2);
    let height = TOP + rows as f64 * ROW_HEIGHT;
    let subtitle = format!("RMS swing of the phase over a turn, by simulation; {bench}");
    let mut svg = Svg::begin(height, "What disturbs which phase algorithm", &subtitle);
    for (number, curve) in Curve::ALL.into_iter().enumerate() {
        let curves: Vec<Vec<(f64, PhaseError)>> =
            algorithms.iter().map(|algorithm| bench.curve(curve, algorithm)).collect();
        let values = || curves.iter().flatten().map(|point| point.0);
        let margin = if curve == Curve::Harmonic { 0.5 } else { 0.0 };
        let panel = Panel {
            left: MARGIN + 50.0 + (number % 2) as f64 * (PANEL_WIDTH + GAP),
            top: TOP + (number / 2) as f64 * ROW_HEIGHT,
            low: values().fold(f64::INFINITY, f64::min) - margin,
            high: values().fold(f64::NEG_INFINITY, f64::max) + margin,
        };
        panel.frame(&mut svg, curve);
        for (number, (points, colour)) in curves.iter().zip(COLOURS.into_iter().cycle()).enumerate() {
            let at = |(value, error): &(f64, PhaseError)| (panel.x(*value), panel.y(error.rms_rad));
            if curve == Curve::Harmonic {
                // Between whole numbers there is no harmonic: dots, and no line; beside each other, to be seen all.
                let aside = 3.5 * (number as f64 - (curves.len() - 1) as f64 / 2.0);
                for point in points {
                    let (x, y) = at(point);
                    svg.dot((x + aside, y), 3.0, colour, &format!("harmonic {}", point.0));
                }
            } else {
                // What lies under others is wider, to be seen.
                let width = 1.5 + 0.7 * (curves.len() - 1 - number) as f64;
                svg.stroke(&points.iter().map(at).collect::<Vec<_>>(), colour, width.min(8.0));
            }
        }
    }
    let (x, y) = (MARGIN + 50.0 + PANEL_WIDTH + GAP, TOP + (rows - 1) as f64 * ROW_HEIGHT);
    for (number, (algorithm, colour)) in algorithms.iter().zip(COLOURS.into_iter().cycle()).enumerate() {
        let (column, row) = (number / 12, number % 12);
        let (x, y) = (x + column as f64 * 200.0, y + row as f64 * 20.0);
        svg.swatch(x, y, colour);
        svg.text(x + 19.0, y + 10.5, "soft", &algorithm.name);
    }
    svg.end()
}
