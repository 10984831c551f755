//! A map of numbers as an image of one colour a pixel, small enough to stand inside another file.

use super::colour_map::{ColourMap, INVALID};
use crate::frames::Geometry;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Colours of the scale; one more stands for invalid pixels.
const LEVELS: u8 = 255;

/// `values`, `[row, column]`, from `low` to `high` in `map`'s colours, as the data URI of a PNG with a palette.
///
/// Values beyond the ends have the ends' colours; one that is not finite is grey.
pub fn png_data_uri(geometry: Geometry, values: &[f64], (low, high): (f64, f64), map: ColourMap) -> String {
    let last = f64::from(LEVELS - 1);
    let index = |&value: &f64| match value.is_finite() {
        true => ((value - low) / (high - low) * last).round().clamp(0.0, last) as u8,
        false => LEVELS,
    };
    let palette: Vec<u8> =
        (0..LEVELS).flat_map(|level| map.at(f64::from(level) / last)).chain(INVALID).collect();
    let pixels: Vec<u8> = values.iter().map(index).collect();
    let png = encode(geometry, palette, &pixels).unwrap_or_default();
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

/// Fails only where `pixels` does not have the size that `geometry` says, or none.
fn encode(geometry: Geometry, palette: Vec<u8>, pixels: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, geometry.width as u32, geometry.height as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_holds_the_scales_colours_and_grey() {
        let geometry = Geometry { width: 5, height: 1 };
        let values = [-1.0, 0.0, 0.5, 9.0, f64::NAN];
        let uri = png_data_uri(geometry, &values, (-1.0, 1.0), ColourMap::Diverging);
        let file = STANDARD.decode(uri.strip_prefix("data:image/png;base64,").unwrap()).unwrap();
        let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        let colours: Vec<[u8; 3]> = pixels.as_chunks::<3>().0.to_vec();
        let map = ColourMap::Diverging;
        let quarter = map.at(191.0 / 254.0);
        assert_eq!(colours, [map.at(0.0), map.at(0.5), quarter, map.at(1.0), INVALID]);
    }
}
