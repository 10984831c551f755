//! The SVG elements of a picture: texts, images, colour bars, lines, dots.

use super::colour_map::{ColourMap, hex};
use std::fmt::Write;

/// Width of the picture.
pub const WIDTH: f64 = 1000.0;
/// Empty space at its left and right.
pub const MARGIN: f64 = 24.0;
const BAR_HEIGHT: f64 = 12.0;

/// A growing SVG file.
pub struct Svg(String);

impl Svg {
    /// A picture [`WIDTH`] wide with its title lines and gradients. Names and styles are its own, so that it can stand in a page.
    pub fn begin(height: f64, title: &str, subtitle: &str) -> Self {
        let heading = escaped(title);
        let mut svg = Self(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.0}\" width=\"{WIDTH}\" \
             height=\"{height:.0}\" class=\"maps\" role=\"img\" aria-label=\"{heading}\">\n<title>{heading}</title>\n<style>\n\
             .maps text {{ font-family: system-ui, -apple-system, 'Segoe UI', Helvetica, Arial, sans-serif; \
             font-size: 14px; fill: #1f2328 }}\n.maps .title {{ font-size: 21px; font-weight: 600 }}\n\
             .maps .strong {{ font-size: 15px; font-weight: 600 }}\n.maps .soft {{ font-size: 13px; fill: #57606a }}\n\
             .maps .middle {{ text-anchor: middle }}\n.maps .end {{ text-anchor: end }}\n</style>\n\
             <rect x=\"0.5\" y=\"0.5\" width=\"{:.1}\" height=\"{:.1}\" rx=\"8\" fill=\"#ffffff\" stroke=\"#d0d7de\"/>\n",
            WIDTH - 1.0,
            height.round() - 1.0,
        ));
        for (name, map) in [("sequential", ColourMap::Sequential), ("diverging", ColourMap::Diverging)] {
            svg.gradient(name, map);
        }
        svg.text(MARGIN, 42.0, "title", title);
        svg.text(MARGIN, 66.0, "soft", subtitle);
        svg
    }

    /// The finished file.
    pub fn end(mut self) -> String {
        self.0.push_str("</svg>\n");
        self.0
    }

    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{line}");
    }

    /// A line of text; `class`: `title`, `strong`, `soft`, and `middle` or `end` for where `x` is in it.
    pub fn text(&mut self, x: f64, y: f64, class: &str, text: &str) {
        self.line(format_args!("<text x=\"{x:.1}\" y=\"{y:.1}\" class=\"{class}\">{}</text>", escaped(text)));
    }

    fn gradient(&mut self, name: &str, map: ColourMap) {
        let anchors = map.anchors();
        let stop = |(place, &colour): (usize, _)| {
            let percent = 100.0 * place as f64 / (anchors.len() - 1) as f64;
            format!("<stop offset=\"{percent:.1}%\" stop-color=\"{}\"/>", hex(colour))
        };
        let stops: String = anchors.iter().enumerate().map(stop).collect();
        self.line(format_args!("<linearGradient id=\"maps-{name}\">{stops}</linearGradient>"));
    }

    /// An image with its label above.
    pub fn map(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], label: &str, uri: &str) {
        self.text(x, y - 12.0, "strong", label);
        // Nearest neighbour: the style for browsers, the attribute (SVG 1.1) for viewers without style sheets.
        self.line(format_args!(
            "<image x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" \
             preserveAspectRatio=\"none\" image-rendering=\"optimizeSpeed\" style=\"image-rendering: pixelated\" href=\"{uri}\"/>"
        ));
    }

    /// A colour bar; with arrows where values lie beyond its ends.
    pub fn bar(&mut self, x: f64, width: f64, y: f64, map: ColourMap, arrows: bool) {
        let name = if map == ColourMap::Sequential { "sequential" } else { "diverging" };
        self.line(format_args!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{BAR_HEIGHT}\" fill=\"url(#maps-{name})\"/>"
        ));
        let (middle, low) = (y + BAR_HEIGHT / 2.0, y + BAR_HEIGHT);
        for (edge, tip, colour) in [(x, x - 9.0, map.at(0.0)), (x + width, x + width + 9.0, map.at(1.0))] {
            if arrows {
                let points = format!("{edge:.1},{y:.1} {tip:.1},{middle:.1} {edge:.1},{low:.1}");
                self.line(format_args!("<polygon points=\"{points}\" fill=\"{}\"/>", hex(colour)));
            }
        }
    }

    /// Ticks (place from 0 to 1, label) and the quantity below a colour bar at `y`.
    pub fn ticks(&mut self, x: f64, width: f64, y: f64, ticks: &[(f64, String)], quantity: &str) {
        let low = y + BAR_HEIGHT;
        for (place, label) in ticks {
            let at = x + place * width;
            self.line(format_args!("<path d=\"M{at:.1} {low:.1}v4\" stroke=\"#57606a\"/>"));
            let class = match place {
                0.0 => "soft",
                1.0 => "soft end",
                _ => "soft middle",
            };
            self.text(at, low + 18.0, class, label);
        }
        self.text(x + width / 2.0, low + 38.0, "middle", quantity);
    }

    /// A line through `points`; nothing where there are fewer than two.
    pub fn stroke(&mut self, points: &[(f64, f64)], colour: &str, width: f64) {
        if points.len() < 2 {
            return;
        }
        let points = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ");
        self.line(format_args!(
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"/>"
        ));
    }

    /// A dot of `colour`, with a text that viewers show when it is pointed at.
    pub fn dot(&mut self, (x, y): (f64, f64), radius: f64, colour: &str, text: &str) {
        self.line(format_args!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\"><title>{}</title></circle>",
            escaped(text)
        ));
    }

    /// A small square of `colour`.
    pub fn swatch(&mut self, x: f64, y: f64, colour: &str) {
        self.line(format_args!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"12\" height=\"12\" fill=\"{colour}\"/>"
        ));
    }
}

/// `text` with nothing in it that XML would read.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
