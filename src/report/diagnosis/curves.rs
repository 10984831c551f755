//! A mean residual over a coordinate, with its noise band, before and after.

use crate::diagnose::{Point, Profile};
use std::fmt::Write;

const SIZE: (f64, f64) = (440.0, 190.0);
const PLOT: (f64, f64, f64, f64) = (56.0, 24.0, 430.0, 150.0);
const BEFORE: &str = "#bc4c00";
const AFTER: &str = "#0969da";

/// An SVG: `before` and `after` with the band of two standard deviations.
pub fn curve(before: &Profile, after: &Profile) -> String {
    let (left, top, right, bottom) = PLOT;
    let points = || before.points.iter().chain(&after.points);
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let (x_low, x_high) = ends(&mut points().map(|point| point.at));
    let reach = |point: &Point| point.residual_dn.abs().max(2.0 * point.sigma_dn);
    let most = points().map(reach).fold(1e-6, f64::max) * 1.05;
    let x = |at: f64| left + (at - x_low) / (x_high - x_low).max(1e-12) * (right - left);
    let y = |dn: f64| (top + bottom) / 2.0 - dn / most * (bottom - top) / 2.0;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" role=\"img\" aria-label=\"{}\">",
        SIZE.0, SIZE.1, SIZE.0, SIZE.1, before.name
    );
    let mut line = |text: std::fmt::Arguments| {
        // Writing to a string cannot fail.
        let _ = svg.write_fmt(text);
    };
    let band = |sign: f64| after.points.iter().map(move |point| (point.at, sign * 2.0 * point.sigma_dn));
    let edge: Vec<String> = band(1.0)
        .chain(band(-1.0).collect::<Vec<_>>().into_iter().rev())
        .map(|(at, dn)| format!("{:.1},{:.1}", x(at), y(dn)))
        .collect();
    line(format_args!("<polygon points=\"{}\" fill=\"#d0d7de\" opacity=\"0.6\"/>", edge.join(" ")));
    line(format_args!(
        "<path d=\"M{left} {top}V{bottom}H{right}M{left} {:.1}H{right}\" fill=\"none\" stroke=\"#8c959f\"/>",
        y(0.0)
    ));
    for (profile, colour) in [(before, BEFORE), (after, AFTER)] {
        let places: Vec<String> =
            profile.points.iter().map(|p| format!("{:.1},{:.1}", x(p.at), y(p.residual_dn))).collect();
        line(format_args!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\"/>",
            places.join(" ")
        ));
        for point in profile.points.iter().filter(|_| profile.points.len() <= 16) {
            line(format_args!(
                "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"2.5\" fill=\"{colour}\"/>",
                x(point.at),
                y(point.residual_dn)
            ));
        }
    }
    let mut text = |x: f64, y: f64, anchor: &str, text: &str| {
        line(format_args!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>"));
    };
    text(left - 4.0, top + 8.0, "end", &format!("{most:.2}"));
    text(left - 4.0, bottom, "end", &format!("\u{2212}{most:.2}"));
    text(left - 4.0, (top + bottom) / 2.0 + 4.0, "end", "DN");
    text(left, bottom + 16.0, "start", &format!("{x_low:.2}"));
    text(right, bottom + 16.0, "end", &format!("{x_high:.2}"));
    text((left + right) / 2.0, bottom + 30.0, "middle", before.name);
    svg.push_str("</svg>");
    svg
}
