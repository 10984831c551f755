//! A picture of two range measurements of one scene: the true range, and both errors on one scale.

use super::colour_map::{ColourMap, INVALID, hex};
use super::pixel_image::png_data_uri;
use super::scale::{RangeScale, error_limit, finite, signed};
use super::svg::{MARGIN, Svg, WIDTH};
use crate::frames::Geometry;
use crate::problem::{Problem, Result};

/// One measurement's error.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorMap<'a> {
    /// Above the map.
    pub label: &'a str,
    /// Below the map, beside the RMS, at most about 22 characters; may be empty.
    pub note: &'a str,
    /// Measured minus true range in m, `[row, column]`; NaN where the pixel is invalid.
    pub error_m: &'a [f64],
}

/// What the picture shows. All texts are plain, one line each.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorMaps<'a> {
    /// The picture's title, at most about 70 characters.
    pub title: &'a str,
    /// Under the title: the conditions, at most about 115 characters.
    pub subtitle: &'a str,
    /// Columns and rows of all three maps.
    pub geometry: Geometry,
    /// True range in m, `[row, column]`; NaN where there is none. Measurements of different lengths have slightly different
    /// true ranges of what moves: either will do, as only the errors are compared.
    pub range_m: &'a [f64],
    /// Below the range map; may be empty.
    pub range_note: &'a str,
    /// The two measurements.
    pub errors: [ErrorMap<'a>; 2],
    /// What grey pixels are; printed where there are any.
    pub grey: &'a str,
}

/// Root mean square of the finite values; NaN where there are none.
pub fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values
        .into_iter()
        .filter(|value| value.is_finite())
        .fold((0.0, 0), |(sum, count), value| (sum + value * value, count + 1u32));
    (sum / f64::from(count)).sqrt()
}

// Layout, in the picture's own pixels.
const MAP_TOP: f64 = 112.0;
const GAP: f64 = 20.0;
const MAP_WIDTH: f64 = (WIDTH - 2.0 * MARGIN - 2.0 * GAP) / 3.0;
/// From the maps' lower edge to the colour bars, and to the picture's lower edge.
const BAR_BELOW: f64 = 42.0;
const FOOT_BELOW: f64 = 108.0;
/// What the grey pixels' line adds to the height.
const GREY_HEIGHT: f64 = 22.0;

impl ErrorMaps<'_> {
    /// The picture as an SVG file: no script, no external reference, its own background.
    pub fn to_svg(&self) -> Result<String> {
        let pixels = self.geometry.pixels();
        let lengths = [self.range_m, self.errors[0].error_m, self.errors[1].error_m].map(<[f64]>::len);
        if pixels == 0 || lengths != [pixels; 3] {
            return Err(Problem::at("error maps", format_args!("maps of {lengths:?} values"))
                .expected(format_args!("{pixels} values each, and at least one")));
        }
        let map_height = MAP_WIDTH * self.geometry.height as f64 / self.geometry.width as f64;
        let bottom = MAP_TOP + map_height;
        let left = [0.0, 1.0, 2.0].map(|map| MARGIN + map * (MAP_WIDTH + GAP));
        let invalid = self.errors.iter().any(|map| finite(map.error_m).count() < pixels);
        let height = bottom + FOOT_BELOW + if invalid { GREY_HEIGHT } else { 0.0 };
        let mut svg = Svg::begin(height, self.title, self.subtitle);

        let range = RangeScale::of(self.range_m);
        let ends = (range.low_m, range.high_m);
        let uri = png_data_uri(self.geometry, self.range_m, ends, ColourMap::Sequential);
        svg.map([left[0], MAP_TOP], [MAP_WIDTH, map_height], "True range", &uri);
        svg.bar(left[0], MAP_WIDTH, bottom + BAR_BELOW, ColourMap::Sequential, false);
        svg.ticks(left[0], MAP_WIDTH, bottom + BAR_BELOW, &range.ticks(), "radial range, m");
        svg.text(left[0], bottom + 24.0, "soft", self.range_note);

        let limit_m = error_limit(self.errors.iter().flat_map(|map| map.error_m));
        for (map, x) in self.errors.iter().zip(&left[1..]) {
            let uri = png_data_uri(self.geometry, map.error_m, (-limit_m, limit_m), ColourMap::Diverging);
            svg.map([*x, MAP_TOP], [MAP_WIDTH, map_height], map.label, &uri);
            let rms_mm = 1e3 * rms(map.error_m.iter().copied());
            let text =
                if rms_mm.is_nan() { "no valid pixel".to_owned() } else { format!("RMS {rms_mm:.1} mm") };
            svg.text(*x, bottom + 24.0, "strong", &text);
            svg.text(x + MAP_WIDTH, bottom + 24.0, "soft end", map.note);
        }
        let clipped = self.errors.iter().any(|map| finite(map.error_m).any(|error| error.abs() > limit_m));
        let bar_width = 2.0 * MAP_WIDTH + GAP;
        svg.bar(left[1], bar_width, bottom + BAR_BELOW, ColourMap::Diverging, clipped);
        let ticks =
            [-1.0, -0.5, 0.0, 0.5, 1.0].map(|part: f64| ((part + 1.0) / 2.0, signed(part * limit_m * 1e3)));
        svg.ticks(left[1], bar_width, bottom + BAR_BELOW, &ticks, "range error, mm");

        if invalid {
            let y = height - 16.0;
            svg.swatch(left[0], y - 10.5, &hex(INVALID));
            svg.text(left[0] + 19.0, y, "soft", self.grey);
        }
        Ok(svg.end())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GEOMETRY: Geometry = Geometry { width: 3, height: 2 };

    fn picture<'a>(range_m: &'a [f64], error_m: &'a [f64]) -> ErrorMaps<'a> {
        let map = |label| ErrorMap { label, note: "", error_m };
        ErrorMaps {
            title: "a < b & \"c\"",
            subtitle: "",
            geometry: GEOMETRY,
            range_m,
            range_note: "",
            errors: [map("left"), map("right")],
            grey: "grey because",
        }
    }

    #[test]
    fn the_picture_says_rms_scale_and_what_grey_is() {
        let range_m = [1.0, 1.5, 2.0, 2.5, 3.0, 3.5];
        let svg = picture(&range_m, &[0.03, -0.03, 0.03, -0.03, f64::NAN, 0.03]).to_svg().unwrap();
        for text in
            ["RMS 30.0 mm", "+30<", "\u{2212}30<", ">3.5<", "grey because", "a &lt; b &amp; &quot;c&quot;<"]
        {
            assert!(svg.contains(text), "{text} is missing in {svg}");
        }
        let without = picture(&range_m, &[0.03; 6]).to_svg().unwrap();
        assert!(!without.contains("grey because"));
    }

    #[test]
    fn maps_of_another_size_are_refused_and_empty_ones_drawn() {
        assert!(picture(&[1.0; 6], &[0.0; 5]).to_svg().is_err());
        assert!(
            ErrorMaps { geometry: Geometry { width: 0, height: 2 }, ..picture(&[], &[]) }.to_svg().is_err()
        );
        for value in [f64::NAN, f64::INFINITY, 0.0, 1e300, -1e-300] {
            assert!(picture(&[value; 6], &[value; 6]).to_svg().is_ok(), "{value}");
        }
    }
}
