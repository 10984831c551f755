//! What surrounds the Verilog, for whoever builds it in: FuseSoC package, file lists, constraints, derived numbers for
//! programs, timing diagrams, and the integration guide.
//!
//! One template a file, in `package-templates/`. Ports are read from the top module's own text, and every number comes from
//! the specification or what is derived from it.

mod guide;
mod lists;
mod numbers;
mod ports;
mod timing;
mod wave;

pub use numbers::numbers;
pub use ports::{Direction, Port, ports};
pub use timing::{Timing, diagrams};
pub use wave::{Diagram, Lane, Shown};

use crate::artifact::Artifact;
use crate::hdl::Source;

/// Everything that `vuris generate` writes around `files`, the Verilog, benches and vectors; `resources` is the table of
/// what synthesis has found for this very specification, empty where it has not been run.
pub fn package_artifacts(source: &Source, files: &[Artifact], resources: &[String]) -> Vec<Artifact> {
    let made_by = format!("vuris generate --spec {}", source.spec);
    let mut artifacts = lists::artifacts(source, files);
    artifacts.push(Artifact::new("doc/explanation.json", numbers(source.pipeline, &made_by)));
    for diagram in diagrams(source.pipeline) {
        artifacts.push(Artifact::new(format!("doc/{}.json", diagram.name), diagram.wave_json(&made_by)));
        artifacts.push(Artifact::new(format!("doc/{}.svg", diagram.name), diagram.svg(&made_by)));
    }
    artifacts.push(guide::artifact(source, resources));
    artifacts
}
