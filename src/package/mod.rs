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
use crate::spec::{AngleCore, AngleSpecification};
use lists::Packaged;

/// Everything that `vuris generate` writes around `files`, the Verilog, benches and vectors; `resources` is the table of
/// what synthesis has found for this very specification, empty where it has not been run.
pub fn package_artifacts(source: &Source, files: &[Artifact], resources: &[String]) -> Vec<Artifact> {
    let made_by = format!("vuris generate --spec {}", source.spec);
    let sensor = &source.pipeline.sensor;
    let of = Packaged {
        spec: source.spec,
        kind: "pipeline",
        top: source.pipeline.top(),
        description: format!(
            "Phase pipeline of a {} x {} time-of-flight camera, scheme {}",
            sensor.width, sensor.height, source.pipeline.modulation.scheme.name
        ),
        bench: "testbench",
        harness: true,
    };
    let mut artifacts = lists::artifacts(&of, files);
    artifacts.push(Artifact::new("doc/explanation.json", numbers(source.pipeline, &made_by)));
    for diagram in diagrams(source.pipeline) {
        artifacts.push(Artifact::new(format!("doc/{}.json", diagram.name), diagram.wave_json(&made_by)));
        artifacts.push(Artifact::new(format!("doc/{}.svg", diagram.name), diagram.svg(&made_by)));
    }
    artifacts.push(guide::artifact(&of, source.pipeline, resources));
    artifacts
}

/// Lists and constraints around `files`, the Verilog, bench and vectors of an angle unit by itself.
pub fn angle_package_artifacts(core: &AngleCore, spec: &str, files: &[Artifact]) -> Vec<Artifact> {
    let AngleSpecification { x_bits, y_bits, phase_bits, .. } = &*core.unit;
    let of = Packaged {
        spec,
        kind: "angle",
        top: format!("{}_angle", core.prefix()),
        description: format!("Angle of a vector of {x_bits} and {y_bits} bits, in turns / 2^{phase_bits}"),
        bench: "angle_bench",
        harness: false,
    };
    lists::artifacts(&of, files)
}
