//! Colour maps in which equal steps look equal, by a few anchors with straight lines between them.

/// A colour as red, green and blue, 8 bits each in sRGB.
pub type Colour = [u8; 3];

/// What is not a number: a grey that neither map contains.
pub const INVALID: Colour = [0x8c, 0x8c, 0x8c];

/// A map from 0 … 1 to colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// Viridis (van der Walt and Smith 2015), for quantities that grow: dark blue to yellow, lightness rising evenly.
    Sequential,
    /// ColorBrewer's RdBu reversed (Brewer 2003), for signed quantities: blue, near white at 0.5, red.
    Diverging,
}

impl ColourMap {
    /// The colours at even distances from 0 to 1.
    pub fn anchors(self) -> &'static [Colour] {
        const VIRIDIS: &[Colour] = &[
            [0x44, 0x01, 0x54],
            [0x48, 0x28, 0x78],
            [0x3e, 0x49, 0x89],
            [0x31, 0x68, 0x8e],
            [0x26, 0x82, 0x8e],
            [0x1f, 0x9e, 0x89],
            [0x35, 0xb7, 0x79],
            [0x6e, 0xce, 0x58],
            [0xb5, 0xde, 0x2b],
            [0xfd, 0xe7, 0x25],
        ];
        const BLUE_TO_RED: &[Colour] = &[
            [0x05, 0x30, 0x61],
            [0x21, 0x66, 0xac],
            [0x43, 0x93, 0xc3],
            [0x92, 0xc5, 0xde],
            [0xd1, 0xe5, 0xf0],
            [0xf7, 0xf7, 0xf7],
            [0xfd, 0xdb, 0xc7],
            [0xf4, 0xa5, 0x82],
            [0xd6, 0x60, 0x4d],
            [0xb2, 0x18, 0x2b],
            [0x67, 0x00, 0x1f],
        ];
        match self {
            Self::Sequential => VIRIDIS,
            Self::Diverging => BLUE_TO_RED,
        }
    }

    /// The colour at `position`, 0 to 1; beyond, that of the nearer end.
    pub fn at(self, position: f64) -> Colour {
        let anchors = self.anchors();
        let place = position.clamp(0.0, 1.0) * (anchors.len() - 1) as f64;
        // A position that is not a number becomes 0 here.
        let low = (place as usize).min(anchors.len() - 2);
        let fraction = place - low as f64;
        std::array::from_fn(|channel| {
            let [a, b] = [anchors[low][channel], anchors[low + 1][channel]].map(f64::from);
            (a + fraction * (b - a)).round() as u8
        })
    }
}

/// A colour as SVG writes it.
pub fn hex([red, green, blue]: Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE 1976 lightness L* of an sRGB colour.
    fn lightness(colour: Colour) -> f64 {
        let linear = colour.map(|channel| {
            let value = f64::from(channel) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        });
        116.0 * (0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]).cbrt() - 16.0
    }

    #[test]
    fn lightness_rises_evenly_in_the_one_and_falls_from_the_middle_in_the_other() {
        let sequence: Vec<f64> =
            (0..=20).map(|n| lightness(ColourMap::Sequential.at(f64::from(n) / 20.0))).collect();
        assert!(sequence.windows(2).all(|pair| (2.0..6.0).contains(&(pair[1] - pair[0]))), "{sequence:?}");
        for n in 1..=10 {
            let away = |n: i32| lightness(ColourMap::Diverging.at(0.5 + 0.05 * f64::from(n)));
            assert!(away(n) < away(n - 1) && away(-n) < away(1 - n));
            assert!((away(n) - away(-n)).abs() < 12.0, "both signs look as strong at {n}");
        }
    }

    #[test]
    fn ends_hold_beyond_the_ends_and_nothing_panics() {
        for map in [ColourMap::Sequential, ColourMap::Diverging] {
            assert_eq!(map.at(-3.0), map.anchors()[0]);
            assert_eq!(map.at(f64::INFINITY), *map.anchors().last().unwrap());
            map.at(f64::NAN);
        }
    }
}
