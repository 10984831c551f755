//! Verilator's counts: one line a point, `C '…' count`, fields separated by the bytes 1 and 2.

use std::collections::BTreeMap;

/// What a point is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A statement, or a branch of one.
    Line,
    /// A bit that goes up or down.
    Toggle,
}

/// A point that is counted, the same in all instances of its module.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Point {
    /// The module's Verilog file, without folder and extension.
    pub module: String,
    /// Statement or bit.
    pub kind: Kind,
    /// Its line.
    pub line: u32,
    /// What it is: `if`, `else`, `block`; or `data_q[3]:0->1`.
    pub what: String,
}

impl Point {
    /// The signal of a bit, without its index and direction.
    pub fn signal(&self) -> &str {
        self.what.split([':', '[']).next().unwrap_or("")
    }

    /// The bit's index; 0 where the signal is one bit.
    pub fn bit(&self) -> usize {
        let index = self.what.split_once('[').and_then(|(_, rest)| rest.split(']').next());
        index.and_then(|index| index.parse().ok()).unwrap_or(0)
    }
}

/// Adds the counts of `text` to `points`, in the order of points.
pub(super) fn add(points: &mut Vec<(Point, u64)>, text: &str) {
    let mut all: BTreeMap<Point, u64> = std::mem::take(points).into_iter().collect();
    for (point, count) in text.lines().filter_map(read) {
        *all.entry(point).or_default() += count;
    }
    points.extend(all);
}

/// A line's point, where it lies in the core.
fn read(line: &str) -> Option<(Point, u64)> {
    let (fields, count) = line.strip_prefix("C '")?.rsplit_once("' ")?;
    let fields: BTreeMap<&str, &str> =
        fields.split('\u{1}').filter_map(|field| field.split_once('\u{2}')).collect();
    let module = fields.get("f")?.strip_prefix("rtl/")?.strip_suffix(".v")?.to_owned();
    let kind = if fields.get("page")?.starts_with("v_toggle") { Kind::Toggle } else { Kind::Line };
    let (line, what) = (fields.get("l")?.parse().ok()?, (*fields.get("o")?).to_owned());
    // Two branches of one line are told apart by their columns.
    let what = match kind {
        Kind::Toggle => what,
        Kind::Line => format!("{what} at column {}", fields.get("n")?),
    };
    Some((Point { module, kind, line, what }, count.trim().parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_instances_add_up_and_the_bench_does_not_count() {
        let line = |file: &str, instance: &str, count: u32| {
            format!(
                "C '\u{1}f\u{2}{file}\u{1}l\u{2}7\u{1}n\u{2}3\u{1}page\u{2}v_toggle/m\u{1}o\u{2}a_q[12]:0->1\u{1}h\u{2}{instance}' {count}\n"
            )
        };
        let mut points = Vec::new();
        let text =
            line("rtl/m.v", "top.a", 2) + &line("rtl/m.v", "top.b", 3) + &line("tb/bench_taps.v", "top", 9);
        add(&mut points, &text);
        add(&mut points, &line("rtl/m.v", "top.a", 1));
        let point =
            Point { module: "m".to_owned(), kind: Kind::Toggle, line: 7, what: "a_q[12]:0->1".to_owned() };
        assert_eq!((point.signal(), point.bit()), ("a_q", 12));
        assert_eq!(points, [(point, 6)]);
    }
}
