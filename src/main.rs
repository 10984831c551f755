//! The `vuris` program.
fn main() {}
