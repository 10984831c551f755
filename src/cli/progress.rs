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

/// A bar of `total` steps with the time that is left; like everything here, silent where standard error is no terminal.
pub(super) fn bar(total: u64) -> ProgressBar {
    let bar = ProgressBar::new(total);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {percent}%  {elapsed}, {eta} left  {msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}

/// A bar of `total` steps while `work` runs and tells every step that is done.
pub(super) fn steps<T>(total: usize, work: impl FnOnce(&(dyn Fn(&str) + Sync)) -> T) -> T {
    let bar = bar(total as u64);
    let result = work(&|done| {
        bar.set_message(done.to_owned());
        bar.inc(1);
    });
    bar.finish_and_clear();
    result
}

/// A bar while `work` runs and tells how many of how many are done.
pub(super) fn counted<T>(what: &'static str, work: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T) -> T {
    let bar = bar(0);
    bar.set_message(what);
    let result = work(&|done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    result
}
