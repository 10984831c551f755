//! Phase algorithms as a person, a program and a picture show them.

mod curves;
mod explanation;
mod json;
mod picture;
mod tables;
mod words;

pub use curves::{Bench, curves_csv};
pub use explanation::algorithm_explanation;
pub use json::{algorithms_json, designs_json};
pub use picture::algorithms_picture;
pub use tables::{algorithms_table, design_table};
