//! Mutants of the generated core: does the bench see a fault of any kind, anywhere?
//!
//! Yosys reads the generated Verilog, flattens it and lists every fault of one bit of one cell's port. Some are drawn for
//! each module, evenly over the places of its source, and all of them are put into one netlist, which a plusarg switches between.
//! The bench of `vuris verify` runs each, under every mixture of pauses and stops, until it sees a difference. What survives
//! is run again with counters that start shortly before their wrap, then either proved equivalent, or counts against the bench.

mod bench;
mod equivalence;
mod explained;
mod mutant;
mod netlist;
mod outputs;
mod report;

pub use equivalence::DEPTH;
pub use explained::{EXPLAINED, Explanation};
pub use mutant::Mutant;
pub use report::{Tally, report};

use super::small;
use crate::hdl::{Golden, Scenario, Source};
use crate::problem::{Problem, Result};
use crate::spec::Pipeline;
use bench::Bench;
use netlist::Netlist;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What became of a mutant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The bench saw it.
    Killed,
    /// The bench did not end: seen as well, but by a clock on the wall.
    TimedOut,
    /// The bench did not see it, and it is no fault: proved.
    Equivalent,
    /// The bench did not see it.
    Survived,
}

/// What a campaign tries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Campaign {
    /// Mutants drawn for each module.
    pub per_module: usize,
    /// Seed of the drawing.
    pub seed: u64,
    /// Whether survivors may be proved equivalent; if not, they all count as survivors.
    pub prove: bool,
}

/// A mutant that was tried.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// The mutant.
    pub mutant: Mutant,
    /// The Verilog that its cell comes from.
    pub source: String,
    /// What became of it.
    pub verdict: Verdict,
}

/// Runs the campaign on `pipeline` with a small sensor, driven with what `stimulus` makes for that; `progress` is told how many
/// of how many are done.
pub fn run(
    pipeline: &Pipeline,
    campaign: Campaign,
    stimulus: &dyn Fn(&Pipeline) -> Scenario,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Trial>> {
    let pipeline = small(pipeline)?;
    let source = Source { pipeline: &pipeline, spec: "small" };
    let temporary = || {
        tempfile::Builder::new()
            .prefix("vuris-mutate-")
            .tempdir()
            .map_err(|error| Problem::io(&std::env::temp_dir(), "write", &error))
    };
    let (netlist_folder, bench_folder) = (temporary()?, temporary()?);
    let (late_netlist_folder, late_bench_folder) = (temporary()?, temporary()?);
    let netlist = Netlist::new(&source, netlist_folder.path(), false)?;
    let late_netlist = Netlist::new(&source, late_netlist_folder.path(), true)?;
    let mutants = netlist.draw(campaign.per_module, campaign.seed)?;
    let golden = Golden::new(&pipeline, &stimulus(&pipeline));
    let bench = Bench::build(source, &golden, &netlist, &mutants, bench_folder.path(), false)?;
    let late = Bench::build(source, &golden, &late_netlist, &mutants, late_bench_folder.path(), true)?;
    let done = AtomicUsize::new(0);
    let verdicts = in_parallel(&mutants, |number, mutant| {
        let mut verdict = bench.run(number + 1)?;
        if verdict == Verdict::Survived {
            verdict = late.run(number + 1)?;
        }
        if verdict == Verdict::Survived && campaign.prove && equivalence::proved(&netlist, mutant)? {
            verdict = Verdict::Equivalent;
        }
        progress(done.fetch_add(1, Ordering::Relaxed) + 1, mutants.len());
        Ok(verdict)
    })?;
    let trials = mutants.iter().zip(verdicts).map(|(mutant, verdict)| Trial {
        source: mutant.source(netlist.text(&mutant.noun)).to_owned(),
        mutant: mutant.clone(),
        verdict,
    });
    Ok(trials.collect())
}

/// Does `work` for every item on all cores; the results in the items' order, or the first problem.
fn in_parallel<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(usize, &T) -> Result<R> + Sync,
) -> Result<Vec<R>> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::with_capacity(items.len()));
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(number) else { break };
                    let result = work(number, item);
                    // A thread that panics takes the others with it; the lock itself holds nothing that could be half done.
                    let mut results = results.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                    results.push((number, result));
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|&(number, _)| number);
    results.into_iter().map(|(_, result)| result).collect()
}
