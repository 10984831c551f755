//! A diagnosis as a person reads it.

mod curves;
mod left_out;
mod page;
mod paragraph;
mod proposed;
mod remarks;
mod text;

pub use page::diagnosis_page;
pub use text::diagnosis_text;
