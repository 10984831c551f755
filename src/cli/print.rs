//! Printing: a reader that has gone away is no error, anything else on standard output is one.

use crate::problem::{Problem, Result};
use std::fmt::Arguments;
use std::io::{ErrorKind, Write};

/// Writes a line to standard output. Where its reader has closed the pipe (`vuris explain | head`), the program ends quietly.
pub(super) fn line(text: Arguments) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_fmt(text).and_then(|()| out.write_all(b"\n")).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => std::process::exit(0),
        Err(error) => Err(Problem::at("standard output", format_args!("cannot be written: {error}"))
            .remedy("make room, or direct the output elsewhere")),
        Ok(()) => Ok(()),
    }
}

/// `println!`, but a failure is a [`Problem`].
macro_rules! say {
    () => { $crate::cli::print::line(format_args!(""))? };
    ($($argument:tt)*) => { $crate::cli::print::line(format_args!($($argument)*))? };
}
pub(super) use say;

/// `1 set`, `2 sets`.
pub(super) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// A remark on standard error, for whoever watches; where it cannot be written, nobody does.
pub(super) fn remark(text: Arguments) {
    let _ = std::io::stderr().lock().write_fmt(format_args!("{text}\n"));
}
