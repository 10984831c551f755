//! The atlas of effects: a picture each, and the page that lists them.

use super::colour_map::ColourMap;
use super::pixel_image::png_data_uri;
use super::scale::{error_limit, signed};
use super::svg::{MARGIN, Svg, WIDTH};
use crate::bench::{Line, Residuals};
use crate::frames::Geometry;
use crate::physics::{Effect, Parameter};

const COLOURS: [&str; 3] = ["#1f2328", "#bc4c00", "#0969da"];
const TOP: f64 = 132.0;
const PANEL: (f64, f64) = (170.0, 128.0);
const STEP: f64 = (WIDTH - 2.0 * MARGIN - PANEL.0 - AXIS) / 3.0;
/// Room for the numbers left of a panel.
const AXIS: f64 = 54.0;
/// Below a micrometre, or a thousandth of a code, a residual is none.
const LEAST: f64 = 1e-3;
const ROW: f64 = PANEL.1 + 88.0;

/// The parameters at the size that is shown, such as "share 0.01".
fn values(effect: &Effect) -> String {
    let example = effect.example();
    let shown = |(parameter, value): (&Parameter, &f64)| {
        let unit = if parameter.unit == "1" { String::new() } else { format!(" {}", parameter.unit) };
        format!("{} {value}{unit}", parameter.name)
    };
    let all: Vec<String> = effect.parameters.iter().zip(&example).map(shown).collect();
    all.join(", ")
}

/// An SVG of what `effect` at its usual size does to perfect data: a row a scheme, over phase, distance, frame and pixel.
pub fn effect_picture(effect: &Effect, residuals: &[Residuals], geometry: Geometry) -> String {
    let height = TOP + residuals.len() as f64 * ROW;
    let mut svg = Svg::begin(height, effect.name, effect.sentence);
    let all = values(effect);
    let short =
        if all.chars().count() > 140 { all.chars().take(139).collect::<String>() + "…" } else { all };
    svg.text(MARGIN, 86.0, "soft", &short);
    for (number, row) in residuals.iter().enumerate() {
        let y = TOP + number as f64 * ROW;
        let x = |panel: f64| MARGIN + AXIS + panel * STEP;
        svg.text(MARGIN, y - 16.0, "strong", &row.scheme);
        panel(&mut svg, (x(0.0), y), &row.over_phase, "phase, turns", "mm");
        panel(&mut svg, (x(1.0), y), &row.over_distance, "distance, m", "mm");
        panel(&mut svg, (x(2.0), y), &row.over_frame, "frame", "DN RMS");
        let limit = error_limit(row.over_pixels.iter()).max(LEAST);
        let uri = png_data_uri(geometry, &row.over_pixels, (-limit, limit), ColourMap::Diverging);
        svg.map([x(3.0), y], [PANEL.0, PANEL.1], "", &uri);
        let note = format!("pixel, \u{b1}{} mm, red farther", signed(limit).trim_start_matches('+'));
        svg.text(x(3.0) + PANEL.0 / 2.0, y + PANEL.1 + 34.0, "soft middle", &note);
    }
    svg.end()
}

/// The least and greatest value, with some room between and around.
fn ends(values: impl Iterator<Item = f64>, least_span: f64) -> (f64, f64) {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return (-least_span, least_span);
    }
    let room = (least_span - (high - low)).max(0.0) / 2.0;
    (low - room, high + room)
}

fn panel(svg: &mut Svg, (left, top): (f64, f64), lines: &[Line], abscissa: &str, unit: &str) {
    let points = || lines.iter().flat_map(|line| &line.points);
    let (x_low, x_high) = ends(points().map(|point| point.0), 1e-9);
    let (y_low, y_high) = ends(points().map(|point| point.1).chain([0.0]), LEAST);
    let place = |&(x, y): &(f64, f64)| {
        let across = (x - x_low) / (x_high - x_low);
        let up = (y - y_low) / (y_high - y_low);
        (left + across * PANEL.0, top + PANEL.1 - up * PANEL.1)
    };
    let bottom = top + PANEL.1;
    svg.stroke(&[(left, top), (left, bottom), (left + PANEL.0, bottom)], "#d0d7de", 1.0);
    svg.stroke(&[place(&(x_low, 0.0)), place(&(x_high, 0.0))], "#d0d7de", 1.0);
    for (number, line) in lines.iter().enumerate().rev() {
        let colour = COLOURS[number % COLOURS.len()];
        let placed: Vec<(f64, f64)> = line.points.iter().map(place).collect();
        svg.stroke(&placed, colour, 1.5);
        if line.points.len() <= 8 {
            placed.iter().for_each(|at| svg.dot(*at, 3.0, colour, line.label));
        }
        if lines.len() > 1 {
            let x = left - 10.0 + number as f64 * 68.0;
            svg.swatch(x, bottom + 42.0, colour);
            svg.text(x + 16.0, bottom + 52.0, "soft", line.label);
        }
    }
    let plain = |value: f64| format!("{}", (value * 1e3).round() / 1e3);
    let short = |value: f64| format!("{}", (value * 1e2).round() / 1e2);
    svg.text(left - 6.0, top + 10.0, "soft end", &plain(y_high));
    svg.text(left - 6.0, bottom, "soft end", &plain(y_low));
    svg.text(left - 6.0, top + PANEL.1 / 2.0 + 4.0, "soft end", unit);
    svg.text(left, bottom + 17.0, "soft", &short(x_low));
    svg.text(left + PANEL.0, bottom + 17.0, "soft end", &short(x_high));
    svg.text(left + PANEL.0 / 2.0, bottom + 34.0, "soft middle", abscissa);
}

/// The atlas's page in Markdown: each effect with its sentence, parameters, reference and picture, and the largest errors that its
/// usual size makes with each scheme.
pub fn atlas_index(effects: &[(&Effect, Vec<Residuals>)]) -> String {
    let mut page = String::from(
        "# Atlas of effects\n\nEach effect alone, at its usual size, on perfect data: a sinusoidal correlation, no noise.\nA residual is the result with the effect less the result without it; errors are means over the target's pixels, but for the map.\n\n\
         Largest mean, and largest root mean square over those pixels, which a slope over the image does not cancel:\n\n\
         | effect | place | four frames, mean | RMS | WDFT, mean | RMS |\n| --- | --- | --- | --- | --- | --- |\n",
    );
    for (effect, residuals) in effects {
        let name = effect.name;
        page += &format!("| [{name}](#{name}) | {:?} |", effect.place);
        for row in residuals {
            page += &format!(" {:.1} mm | {:.1} mm |", row.largest_mm(), row.largest_rms_mm);
        }
        page.push('\n');
    }
    for (effect, _) in effects {
        let name = effect.name;
        page += &format!("\n## {name}\n\n{}\n\n", effect.sentence);
        page += "| parameter | unit | off | from | to | typical |\n| --- | --- | --- | --- | --- | --- |\n";
        for (parameter, typical) in effect.parameters.iter().zip(effect.typical()) {
            let Parameter { name, unit, off, bounds: (low, high), .. } = parameter;
            page += &format!("| {name} | {unit} | {off} | {low} | {high} | {typical} |\n");
        }
        page += &format!("\nReference: {}\n\n![{name}](effects/{name}.svg)\n", effect.reference);
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Atlas;
    use crate::physics::effects;

    #[test]
    fn every_effect_of_the_page_has_its_picture() {
        let atlas = Atlas::default();
        let effect = effects::named("image_lag").unwrap();
        let residuals = atlas.residuals(effect);
        let svg = effect_picture(effect, &residuals, atlas.geometry());
        assert_eq!(svg.matches("<image").count(), 2);
        assert!(svg.contains("four_frame") && svg.contains("wdft") && !svg.contains("NaN"));
        let page = atlas_index(&[(effect, residuals)]);
        assert!(
            page.contains("(effects/image_lag.svg)") && page.contains("| share | 1 | 0 | 0 | 0.5 | 0.01 |"),
            "{page}"
        );
    }
}
