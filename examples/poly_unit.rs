//! Writes a bare unit of the angle by tables and multipliers: `poly_unit X_BITS Y_BITS PHASE_BITS logic|memory FOLDER`.

use vuris::spec::{Poly, PolySpecification, Tables};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [x, y, phase, tables, folder] = &arguments[..] else { return Err("five arguments".into()) };
    let tables = if tables == "memory" { Tables::Memory } else { Tables::Logic };
    let specification =
        PolySpecification { x_bits: x.parse()?, y_bits: y.parse()?, phase_bits: phase.parse()?, tables };
    let unit = Poly::new("arguments", specification)?;
    println!("bound {:.4} codes, latency {} clocks", unit.phase_codes(), unit.latency_clocks);
    let artifacts = vuris::hdl::poly_artifacts(&unit, "vuris", "example");
    for artifact in artifacts {
        let path = std::path::Path::new(folder).join(&artifact.path);
        std::fs::create_dir_all(path.parent().ok_or("no folder")?)?;
        std::fs::write(path, &artifact.text)?;
    }
    Ok(())
}
