//! Phase pipelines for indirect time-of-flight cameras: a bit-accurate model, the Verilog generated from the same
//! specification, and the proof that both agree.
//!
//! # The picture
//! ```text
//!            spec ─────────────┬───────────────────────────┐
//!             │                │                           │
//!             ▼                ▼                           ▼
//! physics ─► frames ◄─ recording        hdl ─► generated/{rtl, tb, vectors}
//!             │                          ▲ golden values         │
//!             ▼                          │                       ▼
//!           model (integers) ────────────┘              cosim: Verilator, Icarus
//!             │
//!             ▼
//!     sums ─► phase ─► distance
//! ```
//! A [`spec::Pipeline`] says everything that the hardware is; every other number is derived from it once, in
//! [`spec::Derived`], with the proof in its docs. [`model`], [`hdl`], the benches and the tables all read that.
//!
//! # Map
//! | module | what it holds |
//! | --- | --- |
//! | [`spec`] | the pipeline specification, phase schemes, words, exact constants, derived widths, error budget |
//! | [`frames`], [`units`] | the vocabulary that travels, and conversions |
//! | [`model`] | the hardware in integers, one file a module |
//! | [`hdl`] | Verilog, benches and golden vectors from templates |
//! | [`cosim`] | building and running the simulators, comparing stage by stage |
//! | [`package`] | what surrounds the Verilog: FuseSoC package, lists, constraints, numbers for programs, diagrams, guide |
//! | [`synthesis`] | area and clock frequency by real synthesis, and the gate on them |
//! | [`proof`] | what the checks are worth: mutants of the RTL, coverage, formal proofs |
//! | [`recording`] | the recording format, read and written |
//! | [`import`] | other instruments' pictures, arrays and flat dumps as recordings |
//! | [`reference`](mod@reference), [`ranging`] | the same computation in floating point; ranges against the encoder |
//! | [`algorithms`] | phase algorithms: characteristic polynomials, verdicts, sensitivities, the design of rows |
//! | [`physics`] | the forward simulator of raw frames, and its effects, one file each |
//! | [`time_domain`] | a second, independent generator of raw frames: pulses, light paths, charge |
//! | [`bench`](mod@bench) | recordings and the simulator together: campaigns, what each effect does to perfect data |
//! | [`paper`] | the camera's paper computed again: each figure and table, the open question, the rivals |
//! | [`diagnose`] | where recordings and simulation disagree, and which physics was left out |
//! | [`study`] | how often the diagnosis is right, on simulated campaigns |
//! | [`challenge`] | blind campaigns from the second generator: made, sealed, scored |
//! | [`sweep`] | precision sweeps: errors of the phase over all vectors, against area |
//! | [`report`] | tables and pictures |
//! | [`artifact`], [`fields`], [`problem`] | generated files, TOML fields, refusals |
//! | [`widest`] | loops over pixels with the widest registers that the machine has |
//! | [`cli`] | one file a command |
//!
//! # What is absent on purpose
//! - **No floating point in [`model`]**, no I/O, nothing that can fail. Constants come from [`spec::exact`].
//! - **[`model`] and [`physics`] never see each other**: they meet in frames. [`hdl`] never sees [`physics`].
//! - **[`time_domain`] and the code that it examines never see each other**: [`physics`], [`bench`](mod@bench), [`diagnose`] and [`study`].
//! - **Only [`cli`], [`recording`], [`import`], [`artifact`], [`cosim`], [`proof`], [`synthesis`] and the reading of a
//!   specification touch files or processes**; only [`cli`] knows clap, only [`hdl`], [`package`] and [`report`] may know askama.
//!
//! `tests/architecture.rs` asserts each of these sentences.

pub mod algorithms;
pub mod artifact;
pub mod bench;
pub mod challenge;
pub mod cli;
pub mod cosim;
pub mod diagnose;
pub mod fields;
pub mod frames;
pub mod hdl;
pub mod import;
pub mod model;
pub mod package;
pub mod paper;
pub mod physics;
pub mod problem;
pub mod proof;
pub mod ranging;
pub mod recording;
pub mod reference;
pub mod report;
pub mod spec;
pub mod study;
pub mod sweep;
pub mod synthesis;
pub mod time_domain;
pub mod units;
pub mod widest;
