//! Template context of the phase.

use super::AngleSource;
use crate::hdl::text::{bit, literal, range, slice, zero_extended};
use crate::spec::Word;
use askama::Template;

struct Group {
    number: usize,
    title: String,
    range: String,
    high: u32,
    low: u32,
    rows: Vec<String>,
}

struct Clock {
    number: u32,
    before: u32,
}

struct Waiting {
    number: usize,
    range: String,
}

struct Sum {
    number: usize,
    before: usize,
    added: usize,
    range: String,
    row: String,
    sum: String,
    waiting: Vec<Waiting>,
}

#[derive(Template)]
#[template(path = "phase.v", escape = "none")]
struct Phase<'a> {
    banner: String,
    prefix: &'a str,
    quarters: bool,
    sector_bits: u32,
    angle_bits: u32,
    angle_range: String,
    guard_bits: u32,
    directions: u32,
    phase_bits: u32,
    meta_bits: u32,
    clocks: u32,
    valid_range: String,
    later_clocks: Vec<Clock>,
    groups: Vec<Group>,
    sums: Vec<Sum>,
    base: String,
}

pub(super) fn phase(source: &AngleSource, banner: String) -> askama::Result<String> {
    let unit = source.unit;
    let groups = &unit.groups;
    let clocks = unit.sum_clocks();
    let last = groups.len() - 1;
    // Bits of the sum of group `from` and all smaller ones.
    let bits_from = |from: usize| {
        let largest = groups[from..].iter().map(|group| group.rows.iter().max().copied().unwrap_or(0)).sum();
        Word::holding(0, largest).bits
    };
    // sum_0 is the smallest group's row; sum_n has n groups more.
    let sum_bits = |number: usize| if number == 0 { groups[last].bits } else { bits_from(last - number) };
    let sum_name =
        |number: usize| if number == 0 { format!("row_{last}_0") } else { format!("sum_{number}") };
    let sums = (1..last)
        .map(|number| {
            let (bits, group) = (sum_bits(number), last - number);
            Sum {
                number,
                before: number - 1,
                added: number + 1,
                range: range(bits),
                row: zero_extended(&format!("row_{group}_{}", number - 1), groups[group].bits, bits),
                sum: zero_extended(&sum_name(number - 1), sum_bits(number - 1), bits),
                waiting: (0..group)
                    .map(|number| Waiting { number, range: range(groups[number].bits) })
                    .collect(),
            }
        })
        .collect();
    let room = unit.angle_bits - unit.sector_bits;
    Phase {
        banner,
        prefix: source.prefix,
        quarters: unit.sector_bits == 2,
        sector_bits: unit.sector_bits,
        angle_bits: unit.angle_bits,
        angle_range: range(unit.angle_bits),
        guard_bits: unit.cordic.angle_guard_bits,
        directions: unit.iterations + 1,
        phase_bits: unit.phase_bits,
        meta_bits: source.meta_bits,
        clocks,
        valid_range: range(clocks),
        later_clocks: (1..clocks).map(|number| Clock { number, before: number - 1 }).collect(),
        groups: groups
            .iter()
            .enumerate()
            .map(|(number, group)| {
                let (first, past) = (group.first, group.first + group.count);
                Group {
                    number,
                    title: format!(
                        "{first} to {} | {}",
                        past - 1,
                        group.rows.iter().max().copied().unwrap_or(0)
                    ),
                    range: range(group.bits),
                    high: unit.iterations - first,
                    low: unit.iterations + 1 - past,
                    rows: group
                        .rows
                        .iter()
                        .enumerate()
                        .map(|(row, &value)| {
                            let choice = if row + 1 == group.rows.len() {
                                "default".to_owned()
                            } else {
                                literal(group.count, row as i64)
                            };
                            format!("{choice}: row_{number}_0 <= {};", literal(group.bits, value))
                        })
                        .collect(),
                }
            })
            .collect(),
        sums,
        base: match last {
            0 => literal(room, 0),
            _ => zero_extended(&sum_name(last - 1), sum_bits(last - 1), room),
        },
    }
    .render()
}
