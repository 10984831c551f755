//! The paper's experiments: its numbers beside measured ones, tables, and a picture a figure.

use super::scale::round_up;
use super::svg::{MARGIN, Svg, WIDTH};
use super::table::csv_text;
use crate::paper::{Figure, Plot, Quantity, Stroke, Table, mm};
use crate::problem::Result;

const COLOURS: [&str; 4] = ["#0969da", "#bc4c00", "#1a7f37", "#8250df"];
const HEIGHT: f64 = 520.0;
const LEFT: f64 = MARGIN + 76.0;
const RIGHT: f64 = WIDTH - MARGIN - 12.0;
const TOP: f64 = 120.0;
const BOTTOM: f64 = HEIGHT - 66.0;
/// About as many ticks an axis.
const TICKS: f64 = 8.0;

/// The paper's numbers as a table.
pub fn quantities_table(quantities: &[Quantity]) -> Table {
    let row = |quantity: &Quantity| {
        let measured = quantity.measured.map(|m| format!("{} \u{b1} {}", mm(m.value), mm(m.error)));
        let within = match quantity.is_within() {
            None => "",
            Some(true) => "yes",
            Some(false) => "no",
        };
        vec![
            quantity.what.clone(),
            mm(quantity.predicted_m),
            measured.unwrap_or_default(),
            within.to_owned(),
            quantity.assumed.to_owned(),
            quantity.why.clone(),
        ]
    };
    let head = ["what", "predicted, mm", "measured, mm", "within", "assumed", "remark"];
    Table {
        name: "numbers",
        title: "The paper's numbers: predicted here, measured there",
        head: head.map(str::to_owned).to_vec(),
        rows: quantities.iter().map(row).collect(),
        notes: Vec::new(),
    }
}

/// `table` in Markdown, without title and notes.
pub fn markdown_rows(table: &Table) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let rule = vec!["---".to_owned(); table.head.len()];
    [&table.head, &rule].into_iter().chain(&table.rows).map(|cells| line(cells)).collect()
}

/// `table` in Markdown, with its title and notes.
pub fn markdown_table(table: &Table) -> String {
    let notes: String = table.notes.iter().map(|note| format!("- {note}\n")).collect();
    let gap = if notes.is_empty() { "" } else { "\n" };
    format!("## {}\n\n{}{gap}{notes}", table.title, markdown_rows(table))
}

/// `table` as CSV.
///
/// # Errors
/// Rows that are not as long as the head.
pub fn table_csv(table: &Table) -> Result<String> {
    csv_text(std::iter::once(&table.head).chain(&table.rows).cloned())
}

/// All points of `figure` as CSV: curve, abscissa, ordinate.
///
/// # Errors
/// None that a figure can make.
pub fn figure_csv(figure: &Figure) -> Result<String> {
    let head = vec!["curve".to_owned(), figure.abscissa.to_owned(), figure.ordinate.to_owned()];
    let points = figure.plots.iter().flat_map(|plot| {
        plot.points.iter().map(|(x, y)| vec![plot.name.clone(), format!("{x:.6}"), format!("{y:.6}")])
    });
    csv_text(std::iter::once(head).chain(points))
}

/// An axis: its ends, and where its ticks are.
struct Axis {
    low: f64,
    high: f64,
    step: f64,
}

impl Axis {
    /// Around finite `values`, its ends at ticks of 1, 2 or 5 times a power of ten.
    fn around(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values
            .filter(|value| value.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = if low < high { (low, high) } else { (-1.0, 1.0) };
        let step = round_up((high - low) / TICKS, &[1.0, 2.0, 5.0]);
        Self { low: (low / step + 1e-9).floor() * step, high: (high / step - 1e-9).ceil() * step, step }
    }

    fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    fn ticks(&self) -> Vec<(f64, String)> {
        let decimals = (-self.step.log10().floor()).max(0.0) as usize;
        let count = ((self.high - self.low) / self.step).round() as u32;
        let tick = |n| {
            let value = self.low + f64::from(n) * self.step;
            // No negative zero.
            let value = if value.abs() < self.step / 2.0 { 0.0 } else { value };
            (value, format!("{value:.decimals$}"))
        };
        (0..=count).map(tick).collect()
    }
}

/// An SVG of `figure` in the paper's axes.
pub fn figure_picture(figure: &Figure) -> String {
    let points = || figure.plots.iter().flat_map(|plot| &plot.points);
    let across = Axis::around(points().map(|point| point.0));
    let up = Axis::around(points().map(|point| point.1));
    let x = |value: f64| LEFT + across.share(value) * (RIGHT - LEFT);
    let y = |value: f64| BOTTOM - up.share(value) * (BOTTOM - TOP);
    let title = format!("Figure {}. {}", figure.number, figure.title);
    let mut svg = Svg::begin(HEIGHT, &title, &format!("Assumed: {}", figure.assumed));
    for (value, label) in across.ticks() {
        svg.stroke(&[(x(value), TOP), (x(value), BOTTOM)], "#eaeef2", 1.0);
        svg.text(x(value), BOTTOM + 20.0, "soft middle", &label);
    }
    for (value, label) in up.ticks() {
        svg.stroke(&[(LEFT, y(value)), (RIGHT, y(value))], "#eaeef2", 1.0);
        svg.text(LEFT - 8.0, y(value) + 4.0, "soft end", &label);
    }
    svg.stroke(&[(LEFT, TOP), (LEFT, BOTTOM), (RIGHT, BOTTOM)], "#57606a", 1.0);
    svg.text((LEFT + RIGHT) / 2.0, BOTTOM + 46.0, "middle", figure.abscissa);
    svg.text(MARGIN, TOP - 10.0, "soft", figure.ordinate);
    let mut legend = RIGHT;
    for (number, plot) in figure.plots.iter().enumerate().rev() {
        let colour = COLOURS[number % COLOURS.len()];
        draw(&mut svg, plot, colour, (&x, &y));
        legend -= 24.0 + 7.2 * plot.name.chars().count() as f64;
        svg.swatch(legend, TOP - 21.0, colour);
        svg.text(legend + 17.0, TOP - 10.0, "soft", &plot.name);
    }
    svg.end()
}

type Places<'a> = (&'a dyn Fn(f64) -> f64, &'a dyn Fn(f64) -> f64);

fn draw(svg: &mut Svg, plot: &Plot, colour: &str, (x, y): Places) {
    let placed = plot.points.iter().map(|point| (x(point.0), y(point.1)));
    match plot.stroke {
        Stroke::Line => svg.stroke(&placed.collect::<Vec<_>>(), colour, 1.8),
        Stroke::Dots => placed.for_each(|at| svg.dot(at, 2.4, colour, &plot.name)),
        // Logarithms are below zero: a bar stands on the axis.
        Stroke::Bars => {
            placed.for_each(|at| svg.stroke(&[(at.0, BOTTOM), at], colour, 9.0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_end_at_round_numbers() {
        let axis = Axis::around([1.0, 3.0].into_iter());
        assert_eq!((axis.low, axis.high, axis.step), (1.0, 3.0, 0.5));
        let labels: Vec<String> =
            Axis::around([-0.031, 0.03].into_iter()).ticks().into_iter().map(|t| t.1).collect();
        assert_eq!(labels, ["-0.04", "-0.03", "-0.02", "-0.01", "0.00", "0.01", "0.02", "0.03"]);
        assert!(Axis::around([f64::NAN, 2.0].into_iter()).low < 0.0);
    }

    #[test]
    fn a_table_is_markdown_and_csv() {
        let table = Table {
            name: "t",
            title: "T",
            head: vec!["a".to_owned(), "b, c".to_owned()],
            rows: vec![vec!["1".to_owned(), "2".to_owned()]],
            notes: vec!["n".to_owned()],
        };
        assert_eq!(markdown_table(&table), "## T\n\n| a | b, c |\n| --- | --- |\n| 1 | 2 |\n\n- n\n");
        assert_eq!(table_csv(&table).unwrap(), "a,\"b, c\"\n1,2\n");
    }
}
