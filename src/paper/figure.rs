//! A figure or a table as plain numbers, to be drawn and written elsewhere.

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// A line through the points.
    Line,
    /// A dot at each.
    Dots,
    /// A bar from zero to each.
    Bars,
}

/// One of a figure's curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Its name in the legend.
    pub name: String,
    /// Points in the units of the figure's axes.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub stroke: Stroke,
}

impl Plot {
    /// A line through `points`.
    pub fn line(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points, stroke: Stroke::Line }
    }

    /// A dot at each of `points`.
    pub fn dots(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { stroke: Stroke::Dots, ..Self::line(name, points) }
    }
}

/// A figure of the paper, computed again.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Its number in the paper.
    pub number: u32,
    /// What it shows.
    pub title: &'static str,
    /// The horizontal axis, with its unit.
    pub abscissa: &'static str,
    /// The vertical axis, with its unit.
    pub ordinate: &'static str,
    /// The curves.
    pub plots: Vec<Plot>,
    /// What was assumed.
    pub assumed: &'static str,
}

/// A table of texts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// The name of its file, without an ending.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// The columns' heads.
    pub head: Vec<String>,
    /// Its rows, each as long as the head.
    pub rows: Vec<Vec<String>>,
    /// What is to be known: assumptions, and what it shows and does not show. One a line.
    pub notes: Vec<String>,
}

/// A length in mm, with one digit behind the point.
pub fn mm(length_m: f64) -> String {
    format!("{:.1}", 1e3 * length_m)
}
