//! Signs of life: on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// A line that says what is going on, while `work` runs.
pub(super) fn during<T>(what: impl Into<String>, work: impl FnOnce() -> T) -> T {
    // indicatif draws on standard error, and nothing where that is not a terminal.
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
        bar.set_style(style);
    }
    bar.set_message(what.into());
    bar.enable_steady_tick(Duration::from_millis(100));
    let result = work();
    bar.finish_and_clear();
    result
}

/// A bar with the time left, while `work` runs; it is told how many of how many are done.
pub(super) fn counted<T>(what: &'static str, work: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T) -> T {
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}, {eta} left") {
        bar.set_style(style);
    }
    bar.set_message(what);
    let result = work(&|done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    result
}
