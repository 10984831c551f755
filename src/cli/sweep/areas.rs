//! The areas of what is swept: by the fitted model, or by synthesis of every configuration.

use super::super::progress;
use super::Candidate;
use crate::hdl::{AngleSource, angle_artifacts};
use crate::problem::Result;
use crate::spec::AngleUnit;
use crate::sweep::{Area, AreaModel, AreaSource};
use crate::synthesis::{Design, Family, Flow};
use rayon::prelude::*;

/// By the fitted model.
pub(super) fn fitted(unit: &AngleUnit) -> Area {
    AreaModel::of(unit.architecture).area(unit)
}

/// By Yosys for an ECP5, each unit once: the flow keeps areas by the content of the Verilog.
pub(super) fn synthesised(candidates: &[Candidate]) -> Result<Vec<Area>> {
    let flow = Flow::find()?;
    let bar = progress::bar(candidates.len() as u64);
    bar.set_message("synthesising");
    let area = |(_, unit): &Candidate| {
        let source = AngleSource { prefix: "sweep", unit, meta_bits: 1 };
        let design = Design::new("sweep_angle", "clk_i", angle_artifacts(&source, "sweep"))?;
        let luts = flow.area(&design, Family::Ecp5)?.luts as f64;
        bar.inc(1);
        Ok(Area { luts, source: AreaSource::Synthesised })
    };
    let areas = candidates.par_iter().map(area).collect();
    bar.finish_and_clear();
    areas
}
