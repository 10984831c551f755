//! A diagnosis as a person reads it.

mod text;

pub use text::diagnosis_text;
