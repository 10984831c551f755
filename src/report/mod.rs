//! Results as a person reads them: pictures of plain numbers, without knowledge of where these come from.

mod colour_map;
mod error_maps;
mod pixel_image;
mod scale;
mod svg;

pub use colour_map::ColourMap;
pub use error_maps::{ErrorMap, ErrorMaps, rms};
