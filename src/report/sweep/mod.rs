//! A sweep's results: columns for CSV and Parquet, tables, and the picture of error against area.

mod columns;
mod files;
mod picture;
mod tables;

pub use columns::{Column, Values, sweep_columns};
pub use files::{sweep_csv, sweep_parquet};
pub use picture::sweep_picture;
pub use tables::{front_table, octave_table};
