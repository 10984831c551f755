//! The areas of what is swept: by the fitted model, or by synthesis of every configuration.

use super::super::progress;
use super::Candidate;
use crate::hdl::{AngleSource, angle_artifacts};
use crate::problem::Result;
use crate::spec::AngleUnit;
use crate::sweep::{Area, AreaModel, AreaSource};
use crate::synthesis::{Family, Flow, Verilog};
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
        let files = angle_artifacts(&source, "sweep").into_iter().filter(|file| file.path.ends_with(".v"));
        let verilog = Verilog::new("sweep_angle", "clk_i", files.collect())?;
        let luts = flow.area(&verilog, Family::Ecp5)?.luts as f64;
        bar.inc(1);
        Ok(Area { luts, source: AreaSource::Synthesised })
    };
    let areas = candidates.par_iter().map(area).collect();
    bar.finish_and_clear();
    areas
}
