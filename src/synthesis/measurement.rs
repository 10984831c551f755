//! A measurement: targets, families, seeds, all cores of the machine.

use super::accuracy::Accuracy;
use super::area::Area;
use super::family::Family;
use super::flow::{Flow, Placement};
use super::routing::{Routed, Routing, median_and_range};
use super::target::{Kind, Target};
use crate::problem::{Problem, Result};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// What was measured of a target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The target's name.
    pub name: String,
    /// What it is.
    pub purpose: String,
    /// What it is compared with.
    pub kind: Kind,
    /// Digest of its design.
    pub digest: String,
    /// Clocks from an input to its result, from the specification.
    pub latency_clocks: Option<u32>,
    /// Clocks from one input to the next, from the specification.
    pub clocks_per_sample: Option<u32>,
    /// How exact it is, where that has been measured.
    pub accuracy: Option<Accuracy>,
    /// One for each family.
    pub results: Vec<Mapped>,
}

/// A target on a family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Mapped {
    /// The family.
    pub family: Family,
    /// What the bare design takes.
    pub area: Area,
    /// The area with which `area` is compared: that of the last change that was accepted.
    pub accepted: Area,
    /// How fast it is inside the register wrapper.
    pub speed: Speed,
}

/// Clock frequencies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Speed {
    /// One for each seed.
    Routed(Vec<Routed>),
    /// The part is too small: why.
    DoesNotFit(String),
}

impl Speed {
    fn of(routings: Vec<Routing>) -> Self {
        let mut routed = Vec::with_capacity(routings.len());
        for routing in routings {
            match routing {
                Routing::Routed(one) => routed.push(one),
                Routing::DoesNotFit(why) => return Self::DoesNotFit(why),
            }
        }
        Self::Routed(routed)
    }

    /// Median, least and largest frequency over the seeds, MHz.
    pub fn frequencies_mhz(&self) -> Option<(f64, f64, f64)> {
        match self {
            Self::Routed(routed) => {
                median_and_range(&routed.iter().map(|routed| routed.fmax_mhz).collect::<Vec<_>>())
            }
            Self::DoesNotFit(_) => None,
        }
    }
}

/// What to measure, and with how much effort.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Effort {
    /// On which families.
    pub families: Vec<Family>,
    /// With which seeds.
    pub seeds: Vec<u32>,
    /// At the same time.
    pub jobs: usize,
}

impl Effort {
    /// How often `measure` reports a step for `targets` targets.
    pub fn steps(&self, targets: usize) -> usize {
        targets * self.families.len() * (1 + self.seeds.len())
    }
}

/// Measures `targets`, in their order; `step` hears what has been done, from any thread.
pub fn measure(
    flow: &Flow,
    targets: &[Target],
    effort: &Effort,
    step: &(dyn Fn(&str) + Sync),
) -> Result<Vec<Measured>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(effort.jobs).build().map_err(|error| {
        Problem::at("--jobs", format_args!("{} threads: {error}", effort.jobs)).remedy("use fewer")
    })?;
    // The tools are started once before they run side by side: those of PyPI are compiled by their first call.
    for &family in &effort.families {
        flow.nextpnr(family)?;
    }
    let pairs: Vec<(&Target, Family)> = targets
        .iter()
        .flat_map(|target| effort.families.iter().map(move |&family| (target, family)))
        .collect();
    let results = pool.install(|| {
        let prepared: Result<Vec<Prepared>> = pairs
            .par_iter()
            .map(|&(target, family)| Prepared::new(flow, target, family, effort, step))
            .collect();
        let prepared = prepared?;
        let routes: Vec<(&Prepared, u32)> =
            prepared.iter().flat_map(|pair| effort.seeds.iter().map(move |&seed| (pair, seed))).collect();
        let routings: Result<Vec<Routing>> =
            routes.par_iter().map(|(pair, seed)| pair.route(*seed, step)).collect();
        let mut routings = routings?.into_iter();
        let mapped = prepared.iter().map(|pair| Mapped {
            family: pair.family,
            area: pair.area,
            accepted: pair.area,
            speed: Speed::of(routings.by_ref().take(effort.seeds.len()).collect()),
        });
        Ok(mapped.collect::<Vec<_>>())
    });
    let mut results = results?.into_iter();
    let measured = targets.iter().map(|target| Measured {
        name: target.name.clone(),
        purpose: target.purpose.clone(),
        kind: target.kind,
        digest: target.verilog.digest(),
        latency_clocks: target.latency_clocks,
        clocks_per_sample: target.clocks_per_sample,
        accuracy: target.accuracy.clone(),
        results: results.by_ref().take(effort.families.len()).collect(),
    });
    Ok(measured.collect())
}

/// A target that is mapped to a family, and ready to be placed where it can fit.
struct Prepared<'a> {
    name: String,
    family: Family,
    area: Area,
    placement: std::result::Result<Placement<'a>, String>,
}

impl<'a> Prepared<'a> {
    fn new(
        flow: &'a Flow,
        target: &Target,
        family: Family,
        effort: &Effort,
        step: &(dyn Fn(&str) + Sync),
    ) -> Result<Self> {
        let area = flow.area(&target.verilog, family)?;
        let placement = match area.excess(family) {
            Some(excess) => Err(format!("{excess} of {}", family.part())),
            None => Ok(flow.placement(&target.verilog, family, &effort.seeds)?),
        };
        let name = format!("{} on {}", target.name, family.name());
        step(&format!("{name}: synthesised"));
        Ok(Self { name, family, area, placement })
    }

    fn route(&self, seed: u32, step: &(dyn Fn(&str) + Sync)) -> Result<Routing> {
        let routing = match &self.placement {
            Ok(placement) => placement.route(seed),
            Err(why) => Ok(Routing::DoesNotFit(why.clone())),
        };
        step(&format!("{}: seed {seed} routed", self.name));
        routing
    }
}
