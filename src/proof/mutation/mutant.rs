//! Mutants: one bit of one cell of the netlist, forced, inverted or tied to another bit. Yosys lists all; a seed draws some.

use crate::hdl::module_nouns;
use crate::problem::{Problem, Result};
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;

/// A single fault of the netlist.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mutant {
    /// The module's noun in which the cell lies.
    pub noun: String,
    /// Where the cell comes from: `file:line.column-line.column`, or `file` alone for a memory.
    pub place: String,
    /// The cell in the flat netlist, its instances before it.
    pub cell: String,
    /// What happens to the bit: `inv`, `const0`, `const1`, `cnot0`, `cnot1` (inverted where another bit is 0, or 1).
    pub mode: String,
    /// The cell's port, `A`.
    pub port: String,
    /// The port's bit.
    pub bit: u32,
    /// The other bit, of `cnot0` and `cnot1`.
    pub control: Option<u32>,
}

impl Mutant {
    /// Reads a line of `mutate -list`; nothing where it is no fault of logic (a clock, or a port without effect).
    fn parse(line: &str, prefix: &str) -> Option<Self> {
        let mut words = line.split_whitespace();
        let mut fields = BTreeMap::new();
        let mut source = "";
        while let Some(word) = words.next() {
            match word {
                "-src" => source = words.next()?,
                key if key.starts_with('-') => drop(fields.insert(key, words.next()?)),
                _ => {}
            }
        }
        let (cell, port) = (*fields.get("-cell")?, *fields.get("-port")?);
        if port.contains("CLK") || ["RD_ARST", "RD_SRST"].contains(&port) {
            return None;
        }
        // `rename -src` has put the place into the cell's name; a memory has kept its own, and its place is the last source.
        let place = match cell.find("rtl/") {
            Some(at) => cell[at..].split('$').next()?,
            None => source.split(':').next()?,
        };
        let file = place.split(':').next()?.strip_prefix("rtl/")?.strip_suffix(".v")?;
        Some(Self {
            noun: file.strip_prefix(prefix)?.strip_prefix('_')?.to_owned(),
            place: place.strip_prefix("rtl/")?.to_owned(),
            cell: cell.to_owned(),
            mode: (*fields.get("-mode")?).to_owned(),
            port: port.to_owned(),
            bit: fields.get("-portbit")?.parse().ok()?,
            control: fields.get("-ctrlbit").and_then(|bit| bit.parse().ok()),
        })
    }

    /// The command that applies it to the cell of `module`; `option` may make it switchable.
    pub(super) fn command(&self, module: &str, option: &str) -> String {
        let Self { mode, cell, port, bit, control, .. } = self;
        let control = control.map(|bit| format!(" -ctrlbit {bit}")).unwrap_or_default();
        format!(
            "mutate{option} -mode {mode} -module {module} -cell {cell} -port {port} -portbit {bit}{control}\n"
        )
    }

    /// The instances around the cell, with the dot that ends them.
    pub(super) fn instance(&self) -> &str {
        match self.cell.find("rtl/") {
            Some(at) => &self.cell[..at],
            None => self.cell.rfind('.').map_or("", |dot| &self.cell[..=dot]),
        }
    }

    /// The Verilog that the cell comes from, in `text`, its file; where it spans lines, the first.
    pub fn source<'a>(&self, text: &'a str) -> &'a str {
        let Some((from, to)) = self.place.split_once(':').and_then(|(_, span)| span.split_once('-')) else {
            return "memory";
        };
        let position = |at: &str| {
            at.split_once('.').and_then(|(line, column)| Some((line.parse().ok()?, column.parse().ok()?)))
        };
        let (Some((line, first)), Some((last_line, end))) = (position(from), position(to)) else { return "" };
        let (line, first, last_line, end): (usize, usize, usize, usize) = (line, first, last_line, end);
        let row = text.lines().nth(line.saturating_sub(1)).unwrap_or("");
        let end = if last_line == line { end.saturating_sub(1) } else { row.len() };
        row.get(first.saturating_sub(1)..end).unwrap_or(row).trim()
    }
}

impl std::fmt::Display for Mutant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { place, mode, port, bit, control, .. } = self;
        write!(f, "{place} {}{port}[{bit}] {mode}", self.instance())?;
        control.map_or(Ok(()), |control| write!(f, " bit {control}"))
    }
}

/// Draws `per_module` mutants of each module from Yosys' `list`, as evenly as can be over the places of its source.
pub(super) fn draw(
    list: &str,
    prefix: &str,
    per_module: usize,
    random: &mut ChaCha8Rng,
) -> Result<Vec<Mutant>> {
    let mut places: BTreeMap<String, BTreeMap<String, Vec<Mutant>>> = BTreeMap::new();
    for mutant in list.lines().filter_map(|line| Mutant::parse(line, prefix)) {
        let module = places.entry(mutant.noun.clone()).or_default();
        module.entry(mutant.place.clone()).or_default().push(mutant);
    }
    if places.is_empty() {
        return Err(Problem::at("yosys", "lists no mutants").expected("lines `mutate -mode … -cell …`"));
    }
    let order = |noun: &str| module_nouns().position(|known| known == noun);
    let mut modules: Vec<_> = places.into_iter().collect();
    modules.sort_by_key(|(noun, _)| order(noun).unwrap_or(usize::MAX));
    let mut drawn = Vec::new();
    for (_, places) in modules {
        let mut places: Vec<Vec<Mutant>> = places.into_values().collect();
        places.shuffle(random);
        drawn.extend(round_robin(&places, per_module, random));
    }
    Ok(drawn)
}

/// Up to `count` different mutants, round after round over `places`; fewer where there are no more.
fn round_robin(places: &[Vec<Mutant>], count: usize, random: &mut ChaCha8Rng) -> Vec<Mutant> {
    let mut left: Vec<Vec<&Mutant>> = places.iter().map(|place| place.iter().collect()).collect();
    for place in &mut left {
        place.shuffle(random);
    }
    let mut drawn = Vec::new();
    while drawn.len() < count && left.iter().any(|place| !place.is_empty()) {
        drawn.extend(left.iter_mut().filter_map(Vec::pop).cloned());
    }
    drawn.truncate(count);
    drawn
}
