//! The scheme in a specification's TOML file: a name, a DFT, or a row of its own.

use super::row::Row;
use super::scheme::{Irrational, Scheme, SchemeOrigin, scheme, scheme_names};
use super::step_angle::StepAngle;
use super::{COEFFICIENT_BITS, DFT_FRAMES};
use crate::fields::Fields;
use crate::problem::Result;

/// Reads `scheme` of the table `modulation`; `source` is the name that a refusal gives.
///
/// ```toml
/// scheme = "wdft"              # a name
///
/// scheme = "dft"               # or a DFT
/// frames = 7                   # phase steps of 1/7 turn
/// coefficient_bits = 16        # of each cosine and sine, sign included
///
/// [modulation.scheme]          # or a row
/// name = "hariharan"
/// step_turns = "1/4"           # one step, or a list of angles: ["0", "1/4", "1/2", "3/4", "1"]
/// in_phase = [1, 0, -2, 0, 1]
/// quadrature = [0, 2, 0, -2, 0]
/// offset = [1, 2, 2, 2, 1]     # optional
/// irrational = "1"             # what the quadrature sum is still to be multiplied by: "1" (default) or "sqrt(3)"
/// reference = "Hariharan, Oreb, Eiju 1987" # optional
/// ```
pub(super) fn read(source: &str, modulation: &Fields) -> Result<Scheme> {
    let one_of = format!("one of {}", scheme_names());
    let dft = !modulation.is_table("scheme") && modulation.text("scheme", &one_of)? == "dft";
    if !dft
        && let Some(field) = ["frames", "coefficient_bits"].into_iter().find(|field| modulation.has(field))
    {
        return Err(modulation.refuse(field, "no such field, but with scheme = \"dft\""));
    }
    if modulation.is_table("scheme") {
        return Scheme::of_row(source, row(&modulation.section("scheme")?)?);
    }
    if dft {
        let range = |least: usize, most: usize| least as i64..=most as i64;
        let frames = modulation.integer("frames", range(*DFT_FRAMES.start(), *DFT_FRAMES.end()))?;
        let bits = range(*COEFFICIENT_BITS.start() as usize, *COEFFICIENT_BITS.end() as usize);
        let coefficient_bits = modulation.integer("coefficient_bits", bits)?;
        return Scheme::dft(frames as usize, coefficient_bits as u32)
            .ok_or_else(|| modulation.refuse("frames", "a DFT that works"));
    }
    let named = scheme(modulation.text("scheme", &one_of)?);
    named.cloned().ok_or_else(|| modulation.refuse("scheme", &one_of))
}

fn row(fields: &Fields) -> Result<Row> {
    fields.only(&["name", "step_turns", "in_phase", "quadrature", "offset", "irrational", "reference"])?;
    let weights = "a list of whole numbers, a weight for each phase step";
    let in_phase = fields.integers("in_phase", weights)?;
    let irrational = match fields.has("irrational") {
        true => Irrational::parse(fields.text("irrational", IRRATIONALS)?)
            .ok_or_else(|| fields.refuse("irrational", IRRATIONALS))?,
        false => Irrational::One,
    };
    Ok(Row {
        name: fields.text("name", "a name for the scheme")?.to_owned(),
        angles: angles(fields, in_phase.len())?,
        quadrature: fields.integers("quadrature", weights)?,
        offset: fields.has("offset").then(|| fields.integers("offset", weights)).transpose()?,
        irrational,
        reference: match fields.has("reference") {
            true => fields.text("reference", "a line of text")?.to_owned(),
            false => "a row of the specification".to_owned(),
        },
        in_phase,
    })
}

const IRRATIONALS: &str = "\"1\" or \"sqrt(3)\"";

/// One step for all, or an angle for each.
fn angles(fields: &Fields, steps: usize) -> Result<Vec<StepAngle>> {
    let expected = "a fraction of a turn such as \"1/3\", or a list of them, an angle for each phase step; numerator and \
                    denominator up to 1000";
    let read = |text: &str| StepAngle::parse(text).ok_or_else(|| fields.refuse("step_turns", expected));
    if let Ok(text) = fields.text("step_turns", expected) {
        let step = read(text)?;
        return Ok((0..steps as i64).map(|n| step.times(n)).collect());
    }
    let texts = fields.texts("step_turns").map_err(|_| fields.refuse("step_turns", expected))?;
    if texts.is_empty() {
        return Err(fields.refuse("step_turns", expected));
    }
    texts.into_iter().map(read).collect()
}

/// The lines of the table `modulation` that read as `scheme`; none where it is a table of its own.
pub(super) fn fields(scheme: &Scheme) -> String {
    match scheme.origin {
        SchemeOrigin::Named => format!("scheme = \"{}\"\n", scheme.name),
        SchemeOrigin::Dft { coefficient_bits } => {
            format!("scheme = \"dft\"\nframes = {}\ncoefficient_bits = {coefficient_bits}\n", scheme.steps())
        }
        SchemeOrigin::Row => String::new(),
    }
}

/// The table that reads as `scheme`, to follow the table `modulation`; empty where [`fields`] says all.
pub(super) fn table(scheme: &Scheme) -> String {
    if scheme.origin != SchemeOrigin::Row {
        return String::new();
    }
    let step_turns = match scheme.equal_step() {
        Some(step) => format!("\"{step}\""),
        None => {
            let angles: Vec<String> = scheme.angles.iter().map(|angle| format!("\"{angle}\"")).collect();
            format!("[{}]", angles.join(", "))
        }
    };
    format!(
        "\n[modulation.scheme]\n\
         name = \"{}\"\nstep_turns = {step_turns}\nin_phase = {:?}\nquadrature = {:?}\noffset = {:?}\n\
         irrational = \"{}\"\nreference = \"{}\"\n",
        scheme.name, scheme.in_phase, scheme.quadrature, scheme.offset, scheme.irrational, scheme.reference,
    )
}
