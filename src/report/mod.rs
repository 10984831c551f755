//! Results as a person reads them: tables, and pictures of plain numbers.

mod algorithms;
mod angle_explanation;
mod atlas;
mod colour_map;
mod diagnosis;
mod error_maps;
mod explanation;
mod paper;
mod pixel_image;
mod resources;
mod scale;
mod svg;
mod sweep;
mod synthesis;
mod table;

pub use algorithms::{
    Bench, algorithm_explanation, algorithms_json, algorithms_picture, algorithms_table, curves_csv,
    design_table, designs_json,
};
pub use atlas::{atlas_index, effect_picture};
pub use colour_map::ColourMap;
pub use diagnosis::{diagnosis_page, diagnosis_text};
pub use error_maps::{ErrorMap, ErrorMaps, rms};
pub use explanation::{Section, explanation, sections};
pub use paper::{figure_csv, figure_picture, markdown_rows, markdown_table, quantities_table, table_csv};
pub use resources::resources;
pub use svg::escaped;
pub use sweep::{
    Column, Values, front_table, octave_table, sweep_columns, sweep_csv, sweep_parquet, sweep_picture,
};
pub use synthesis::{comparison_table, measured_table, synthesis};
