//! The flow: Yosys counts a design's cells, nextpnr places and routes it inside its wrapper; everything only once.

use super::area::Area;
use super::cache::Cache;
use super::family::Family;
use super::routing::{Routed, Routing, does_not_fit};
use super::tools::{Program, above, complaint};
use super::verilog::Verilog;
use super::wrapper::{Port, WRAPPER, ports, wrapper};
use crate::artifact::{self, Artifact};
use crate::problem::{Problem, Result};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tempfile::TempDir;

/// Clock frequency that place and route aims at: more than any part reaches, so that no seed stops early, MHz.
pub const FREQUENCY_MHZ: u32 = 400;

/// The tools and the cache.
#[derive(Debug)]
pub struct Flow {
    yosys: Program,
    nextpnr: [OnceLock<Result<Program>>; Family::ALL.len()],
    cache: Cache,
}

/// A design that is ready to be placed with any seed.
#[derive(Debug)]
pub struct Placement<'a> {
    flow: &'a Flow,
    family: Family,
    /// What the result depends on, beside the seed.
    inputs: String,
    /// The folder of the mapped netlist, unless no seed needs it.
    netlist: Option<TempDir>,
}

const NETLIST: &str = "netlist.json";

impl Flow {
    /// The tools of this machine (see [`Program`]); results are kept beside `.tools/hdl`, and without that in the user's cache.
    pub fn find() -> Result<Self> {
        Ok(Self::new(Program::yosys()?, Cache::new(cache_folder()?)))
    }

    /// `yosys`, the machine's nextpnr, and `cache`.
    pub fn new(yosys: Program, cache: Cache) -> Self {
        Self { yosys, nextpnr: Default::default(), cache }
    }

    /// Where results are kept.
    pub fn cache(&self) -> &Cache {
        &self.cache
    }

    /// Yosys.
    pub fn yosys(&self) -> &Program {
        &self.yosys
    }

    /// Place and route for `family`.
    pub fn nextpnr(&self, family: Family) -> Result<&Program> {
        let program = self.nextpnr[family as usize].get_or_init(|| Program::nextpnr(family));
        program.as_ref().map_err(Clone::clone)
    }

    /// What `design` takes of `family`: the bare design, without a wrapper, as Yosys maps it by default.
    pub fn area(&self, verilog: &Verilog, family: Family) -> Result<Area> {
        let command = format!("{} -top {}", family.synthesis_command(), verilog.top());
        let inputs = ["area 1", self.yosys.version(), &command, &verilog.digest()];
        self.cache.recall_or(&inputs, || {
            let folder = folder_with(verilog.files())?;
            let script = format!("{}{command}; tee -q -o cells.json stat -json", verilog.reading());
            Area::parse(&self.synthesise(&script, verilog, folder.path(), "cells.json")?, family)
        })
    }

    /// The ports of `design`, its parameters at their defaults.
    pub fn ports(&self, verilog: &Verilog) -> Result<Vec<Port>> {
        let inputs = ["ports 1", self.yosys.version(), &verilog.digest()];
        self.cache.recall_or(&inputs, || {
            let folder = folder_with(verilog.files())?;
            let top = verilog.top();
            let script = format!("{}hierarchy -top {top}; proc; write_json ports.json", verilog.reading());
            ports(&self.synthesise(&script, verilog, folder.path(), "ports.json")?, top)
        })
    }

    /// Prepares to place `design` with any of `seeds`, inside its wrapper.
    pub fn placement(&self, verilog: &Verilog, family: Family, seeds: &[u32]) -> Result<Placement<'_>> {
        let wrapper = wrapper(verilog, &self.ports(verilog)?)?;
        let mut inputs = vec!["routing 1".to_owned(), self.yosys.version().to_owned()];
        inputs.push(self.nextpnr(family)?.version().to_owned());
        inputs.extend([verilog.digest(), wrapper.clone(), options(family, 0).join(" ")]);
        inputs.extend([family.synthesis_command(), family.before_placement()].map(str::to_owned));
        let inputs = inputs.join("\n");
        let mut placement = Placement { flow: self, family, inputs, netlist: None };
        if seeds.iter().any(|&seed| placement.recalled(seed).is_none()) {
            let mut files = verilog.files().to_vec();
            let name = format!("{WRAPPER}.v");
            files.push(Artifact::new(&name, wrapper));
            let folder = folder_with(&files)?;
            let script = format!(
                "{}read_verilog {name}; {} -top {WRAPPER}; {}write_json {NETLIST}",
                verilog.reading(),
                family.synthesis_command(),
                family.before_placement()
            );
            self.synthesise(&script, verilog, folder.path(), NETLIST)?;
            placement.netlist = Some(folder);
        }
        Ok(placement)
    }

    /// Runs `script` in `folder`; the text of the file `result` that it writes.
    fn synthesise(&self, script: &str, verilog: &Verilog, folder: &Path, result: &str) -> Result<String> {
        let arguments = ["-q", "-p", script].map(str::to_owned);
        let (success, said) = self.yosys.run(folder, &arguments)?;
        if !success {
            return Err(Problem::at(
                verilog.top(),
                format_args!("{} fails:\n{}", self.yosys.version(), complaint(&said)),
            )
            .expected("Verilog that Yosys reads, and the files of all its modules"));
        }
        let path = folder.join(result);
        std::fs::read_to_string(&path).map_err(|error| Problem::io(&path, "read", &error))
    }
}

impl Placement<'_> {
    fn recalled(&self, seed: u32) -> Option<Routing> {
        self.flow.cache.recall(&[&self.inputs, &seed.to_string()])
    }

    /// Places and routes with `seed`.
    pub fn route(&self, seed: u32) -> Result<Routing> {
        let compute = || {
            let netlist = self.netlist.as_ref().ok_or_else(|| {
                Problem::at("seed", seed).expected("one of those that the placement was prepared for")
            })?;
            let nextpnr = self.flow.nextpnr(self.family)?;
            let (success, said) = nextpnr.run(netlist.path(), &options(self.family, seed))?;
            if success {
                let path = netlist.path().join(report(seed));
                let text =
                    std::fs::read_to_string(&path).map_err(|error| Problem::io(&path, "read", &error))?;
                return Routed::parse(&text, seed).map(Routing::Routed);
            }
            does_not_fit(&said).map(Routing::DoesNotFit).ok_or_else(|| {
                Problem::at(nextpnr.version(), format_args!("fails with seed {seed}:\n{}", complaint(&said)))
                    .expected("a netlist that it can place and route")
            })
        };
        self.flow.cache.recall_or(&[&self.inputs, &seed.to_string()], compute)
    }
}

fn report(seed: u32) -> String {
    format!("report-{seed}.json")
}

/// What nextpnr is told.
fn options(family: Family, seed: u32) -> Vec<String> {
    let (frequency, seed_text, report) = (FREQUENCY_MHZ.to_string(), seed.to_string(), report(seed));
    let common = ["--json", NETLIST, "--freq", &frequency, "--seed", &seed_text, "--report", &report];
    let quietly = ["--timing-allow-fail", "--quiet"];
    family.part_options().iter().chain(&common).chain(&quietly).map(|&option| option.to_owned()).collect()
}

/// How the tools are called for `family`, as a person would type it.
pub fn command_lines(family: Family) -> [String; 3] {
    let command = family.synthesis_command();
    [
        format!("read_verilog ...; {command} -top TOP; stat"),
        format!(
            "read_verilog ... {WRAPPER}.v; {command} -top {WRAPPER}; {}write_json {NETLIST}",
            family.before_placement()
        ),
        options(family, 1).join(" ").replace("--seed 1", "--seed SEED").replace(&report(1), "REPORT"),
    ]
}

/// A temporary folder with `files`.
fn folder_with(files: &[Artifact]) -> Result<TempDir> {
    let folder = tempfile::Builder::new()
        .prefix("vuris-synth-")
        .tempdir()
        .map_err(|error| Problem::io(&std::env::temp_dir(), "write", &error))?;
    artifact::write(folder.path(), files)?;
    Ok(folder)
}

/// Beside the tools where they are in `.tools`, else the user's cache.
fn cache_folder() -> Result<PathBuf> {
    if let Some(tools) = above(".tools/hdl") {
        return Ok(tools.with_file_name("synthesis-cache"));
    }
    let folder =
        |variable: &str| std::env::var_os(variable).map(PathBuf::from).filter(|path| path.is_absolute());
    folder("XDG_CACHE_HOME")
        .or_else(|| Some(folder("HOME")?.join(".cache")))
        .map(|cache| cache.join("vuris/synthesis"))
        .ok_or_else(|| {
            Problem::at("XDG_CACHE_HOME", "is not set, and HOME neither")
                .expected("a folder for results that are used again")
                .remedy("set one of them")
        })
}
