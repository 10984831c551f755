//! A grid of configurations: every combination of the listed values that can be built.

use super::configuration::Configuration;
use crate::problem::{Problem, Result};
use crate::spec::{AngleUnit, Rounding, Throughput};
use rayon::prelude::*;

/// The listed values, one list a field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grid {
    /// What no list gives.
    pub base: Configuration,
    /// Bits of x and y, and the metric.
    pub words: Vec<(u32, u32, i64)>,
    /// Bits of the phase.
    pub phase_bits: Vec<u32>,
    /// CORDIC iterations; where none are listed, those that fit the phase.
    pub iterations: Vec<u32>,
    /// Bits of the vector below the phase's resolution.
    pub vector_guard_bits: Vec<u32>,
    /// Bits of the angle below the phase's resolution.
    pub angle_guard_bits: Vec<u32>,
    /// How often a vector can come.
    pub throughputs: Vec<Throughput>,
    /// With, without normaliser.
    pub normaliser: Vec<bool>,
    /// Roundings.
    pub rounding: Vec<Rounding>,
}

/// `configurations`, each once for every one of `values`.
fn times<T: Copy>(
    configurations: &[Configuration],
    values: &[T],
    set: impl Fn(&mut Configuration, T),
) -> Vec<Configuration> {
    let with = |configuration: &Configuration, value| {
        let mut configuration = *configuration;
        set(&mut configuration, value);
        configuration
    };
    configurations
        .iter()
        .flat_map(|c| values.iter().map(|&value| with(c, value)).collect::<Vec<_>>())
        .collect()
}

/// Fields that a unit may refuse, and the options that set them.
const OPTIONS: [(&str, &str); 6] = [
    ("x bits", "--word"),
    ("y bits", "--word"),
    ("output.phase_bits", "--phase-bits"),
    ("cordic.iterations", "--iterations"),
    ("cordic.vector_guard_bits", "--vector-guard-bits"),
    ("cordic.angle_guard_bits", "--angle-guard-bits"),
];

/// One iteration more than the phase has bits, so that the last angle is a sixth of a code, as far as the vector's guard bits
/// allow it.
fn fitting_iterations(configuration: &Configuration) -> u32 {
    let &Configuration { phase_bits, vector_guard_bits, .. } = configuration;
    (phase_bits + vector_guard_bits.min(1)).clamp(4, 30)
}

impl Grid {
    /// Reads a list of whole numbers and ranges, such as `8,10-14`, in rising order without repetition.
    pub fn numbers(option: &str, text: &str) -> Result<Vec<u32>> {
        let refuse = || {
            Problem::at(option, format_args!("\"{text}\""))
                .expected("whole numbers below 100 and ranges, such as 12 or 8,10-14")
        };
        let mut numbers = Vec::new();
        for part in text.split(',') {
            let (low, high) = part.split_once('-').unwrap_or((part, part));
            let (low, high): (u32, u32) =
                (low.parse().map_err(|_| refuse())?, high.parse().map_err(|_| refuse())?);
            if low > high || high >= 100 {
                return Err(refuse());
            }
            numbers.extend(low..=high);
        }
        numbers.sort_unstable();
        numbers.dedup();
        Ok(numbers)
    }

    /// All combinations that can be built, with their units, in the order of the fields; a refusal where there is none.
    pub fn configurations(&self) -> Result<Vec<(Configuration, AngleUnit)>> {
        let all = times(&[self.base], &self.words, |c, word| (c.x_bits, c.y_bits, c.metric) = word);
        let all = times(&all, &self.phase_bits, |c, bits| c.phase_bits = bits);
        let all = match &self.iterations[..] {
            [] => all,
            listed => times(&all, listed, |c, iterations| c.iterations = iterations),
        };
        let mut all = times(&all, &self.vector_guard_bits, |c, bits| c.vector_guard_bits = bits);
        if self.iterations.is_empty() {
            all.iter_mut().for_each(|c| c.iterations = fitting_iterations(c));
        }
        let all = times(&all, &self.angle_guard_bits, |c, bits| c.angle_guard_bits = bits);
        let all = times(&all, &self.throughputs, |c, throughput| c.throughput = throughput);
        let all = times(&all, &self.normaliser, |c, normaliser| c.normaliser = normaliser);
        let all = times(&all, &self.rounding, |c, rounding| c.rounding = rounding);
        // The tables of angles of a unit take a millisecond each.
        let units: Vec<Result<AngleUnit>> = all.par_iter().map(Configuration::unit).collect();
        let (mut found, mut refusal) = (Vec::new(), None);
        for (configuration, unit) in all.into_iter().zip(units) {
            match unit {
                Ok(unit) => found.push((configuration, unit)),
                Err(problem) => refusal = Some(problem),
            }
        }
        match (found.is_empty(), refusal) {
            (true, Some(problem)) => {
                let remedy =
                    OPTIONS.iter().find(|(field, _)| problem.found().starts_with(field)).map_or_else(
                        || "change what is named, by its option or in --spec".to_owned(),
                        |(_, option)| {
                            format!("give {option} a value that this allows: no combination can be built")
                        },
                    );
                Err(problem.remedy(remedy))
            }
            _ => Ok(found),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::configuration::tests::word;
    use super::*;

    #[test]
    fn lists_are_read_and_nonsense_is_refused() {
        assert_eq!(Grid::numbers("--word", "16").unwrap(), [16]);
        assert_eq!(Grid::numbers("--word", "12,8-10,9").unwrap(), [8, 9, 10, 12]);
        for text in ["", "a", "9-8", "8,", "-3", "1-100", "8-", "1e1"] {
            let problem = Grid::numbers("--word", text).unwrap_err().to_string();
            assert!(problem.starts_with("--word") && problem.contains("8,10-14"), "{problem}");
        }
    }

    #[test]
    fn combinations_that_cannot_be_built_are_left_out_and_none_at_all_is_refused() {
        let grid = Grid {
            base: word(8, 8),
            words: vec![(8, 8, 1), (9, 8, 3)],
            phase_bits: vec![8],
            iterations: vec![8, 9, 10],
            vector_guard_bits: vec![0, 1],
            angle_guard_bits: vec![1],
            throughputs: vec![Throughput::CyclesPerPixel(1)],
            normaliser: vec![true, false],
            rounding: vec![Rounding::Nearest],
        };
        // 8 iterations with either guard, 9 with one.
        assert_eq!(grid.configurations().unwrap().len(), 2 * 3 * 2);
        let none = Grid { iterations: vec![10], ..grid.clone() };
        let refusal = none.configurations().unwrap_err().to_string();
        assert!(refusal.contains("iterations = 10") && refusal.contains("give --iterations"), "{refusal}");
        let fitting = Grid { iterations: vec![], phase_bits: vec![8, 12], ..grid };
        let built = fitting.configurations().unwrap();
        // As far as the guard bits allow: 8 and 9 iterations for 8 bits, 12 and 13 for 12.
        let mut iterations: Vec<u32> =
            built.iter().map(|(configuration, _)| configuration.iterations).collect();
        iterations.sort_unstable();
        iterations.dedup();
        assert_eq!((built.len(), &iterations[..]), (2 * 2 * 2 * 2, &[8, 9, 12, 13][..]));
    }
}
