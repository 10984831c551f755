//! A finished configuration of one shard as a line of text that is checked when it is read again.

use super::configuration::Configuration;
use super::phase_of::PhaseOf;
use super::plan::Coverage;
use super::shard::Shard;
use super::tally::{OctaveTally, Tally, Worst};
use std::fmt::Write;

/// The sums of one configuration over one shard.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Record {
    /// What was evaluated.
    pub configuration: Configuration,
    /// Which vectors.
    pub coverage: Coverage,
    /// Which part of them.
    pub shard: Shard,
    /// Digest of the unit's phases of fixed vectors: another unit's sums must not be added to these.
    pub fingerprint: u64,
    /// The sums.
    pub tally: Tally,
}

const PROBES: u64 = 2048;

/// FNV-1a, 64 bits (Fowler, Noll, Vo).
fn digest(bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes.into_iter().fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}

impl Record {
    /// Digest of `unit`'s phases of vectors of every strength of `configuration`'s words.
    pub fn fingerprint_of(unit: &impl PhaseOf, configuration: &Configuration) -> u64 {
        let coordinate = |probe: u64, factor: u64, bits: u32| {
            let random = (probe + 1).wrapping_mul(factor);
            ((random as i64) >> (64 - bits)) >> (probe % u64::from(bits))
        };
        digest((0..PROBES).flat_map(|probe| {
            let x = coordinate(probe, 0x9E37_79B9_7F4A_7C15, configuration.x_bits);
            let y = coordinate(probe, 0xD1B5_4A32_D192_ED03, configuration.y_bits);
            let phase = if (x, y) == (0, 0) { 0 } else { unit.phase(x, y) };
            phase.to_le_bytes()
        }))
    }

    /// The line, without its end.
    pub fn line(&self) -> String {
        let mut line = format!(
            "{}\t{}\t{}\t{:016x}",
            self.configuration,
            self.coverage.text(),
            self.shard,
            self.fingerprint
        );
        for (kind, octaves) in [("e", &self.tally.even), ("c", &self.tally.corners)] {
            for (number, octave) in octaves.iter().enumerate() {
                let worst = octave
                    .worst
                    .map_or("-".to_owned(), |worst| format!("{},{},{}", worst.error, worst.x, worst.y));
                // Writing to a string cannot fail.
                let _ = write!(
                    line,
                    "\t{kind}{number} {} {} {} {} {} {} {worst}",
                    octave.vectors,
                    octave.faithful,
                    octave.correctly_rounded,
                    octave.sum,
                    octave.octant_sum,
                    octave.squares,
                );
            }
        }
        let check = digest(line.bytes());
        format!("{line}\t{check:016x}")
    }

    /// Reads a line; `None` where it is cut off or was changed.
    pub fn parse(line: &str) -> Option<Self> {
        let (body, check) = line.rsplit_once('\t')?;
        if check.len() != 16 || u64::from_str_radix(check, 16).ok()? != digest(body.bytes()) {
            return None;
        }
        let mut fields = body.split('\t');
        let configuration = Configuration::parse(fields.next()?)?;
        let coverage = Coverage::parse(fields.next()?)?;
        let shard = Shard::parse(fields.next()?).ok()?;
        let fingerprint = u64::from_str_radix(fields.next()?, 16).ok()?;
        let mut tally = Tally::default();
        for field in fields {
            let octaves = if field.starts_with('e') { &mut tally.even } else { &mut tally.corners };
            octaves.push(octave(field)?);
        }
        Some(Self { configuration, coverage, shard, fingerprint, tally })
    }
}

fn octave(field: &str) -> Option<OctaveTally> {
    let parts: Vec<&str> = field.split(' ').collect();
    let [_, vectors, faithful, correctly_rounded, sum, octant_sum, squares, worst] = parts[..] else {
        return None;
    };
    let worst = if worst == "-" {
        None
    } else {
        let numbers: Vec<i64> = worst.split(',').map(str::parse).collect::<Result<_, _>>().ok()?;
        let [error, x, y] = numbers[..] else { return None };
        Some(Worst { error, x, y })
    };
    Some(OctaveTally {
        vectors: vectors.parse().ok()?,
        faithful: faithful.parse().ok()?,
        correctly_rounded: correctly_rounded.parse().ok()?,
        sum: sum.parse().ok()?,
        octant_sum: octant_sum.parse().ok()?,
        squares: squares.parse().ok()?,
        worst,
    })
}

#[cfg(test)]
mod tests {
    use super::super::configuration::tests::word;
    use super::super::{ExactAngle, Plan, evaluate};
    use super::*;

    #[test]
    fn a_line_is_read_as_it_was_written_and_a_damaged_one_not_at_all() {
        let configuration = word(6, 6);
        let unit = configuration.unit().unwrap();
        let plan = Plan::new(&configuration, 10, false);
        let tally = evaluate(&unit, &ExactAngle::new(1), &plan, Shard { index: 1, count: 2 }, &|_| ());
        let fingerprint = Record::fingerprint_of(&unit, &configuration);
        let shard = Shard { index: 1, count: 2 };
        let record = Record { configuration, coverage: plan.coverage(), shard, fingerprint, tally };
        let line = record.line();
        assert_eq!(Record::parse(&line), Some(record));
        for end in 0..line.len() {
            assert_eq!(Record::parse(&line[..end]), None, "cut at {end}");
        }
        let place = line.find("e2 ").unwrap() + 3;
        let changed = format!("{}9{}", &line[..place], &line[place + 1..]);
        assert!(changed == line || Record::parse(&changed).is_none());
    }

    #[test]
    fn units_that_differ_have_different_fingerprints() {
        let print = |configuration: Configuration| {
            Record::fingerprint_of(&configuration.unit().unwrap(), &configuration)
        };
        assert_eq!(print(word(16, 16)), print(word(16, 16)));
        let other = Configuration { angle_guard_bits: 4, ..word(16, 16) };
        assert_ne!(print(word(16, 16)), print(other));
    }
}
