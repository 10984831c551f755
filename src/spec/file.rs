//! The specification's TOML file: reading, checking and writing.

use super::angle::{read_cordic, write_cordic};
use super::sequence::DEFAULT_PHASE_STEP_BITS;
use super::{
    ADC_BITS, Modulation, Multipliers, Output, RegisterBlock, Scheme, Sensor, Specification, Word,
    normalised_order, refused, scheme_file, sequence, unwrapping,
};
use crate::fields::{self, Fields};
use crate::problem::{Problem, Result};
use std::path::Path;

const FORMAT: &str = "vuris-pipeline/1";

/// The text of the file at `path`; `presets` are the names that would have done, too.
pub(super) fn read(path: &str, presets: &str) -> Result<String> {
    read_text(Path::new(path)).map_err(|error| {
        Problem::io(Path::new(path), "read the specification", &error)
            .expected(format_args!("a file, or one of the presets {presets}"))
            .remedy("`vuris explain --spec vuris --toml > my.toml` writes a file to start from")
    })
}

/// The text of the file at `path` with a scheme; `names` would have done, too.
pub(super) fn read_row(path: &str, names: &str) -> Result<String> {
    read_text(Path::new(path)).map_err(|error| {
        Problem::io(Path::new(path), "read the row", &error)
            .expected(format_args!("a TOML file, or one of {names}"))
            .remedy("`vuris algorithms show hariharan --toml > my.toml` writes a file to start from")
    })
}

/// The text of a regular file of a plausible size: a device would be read for ever.
fn read_text(path: &Path) -> std::io::Result<String> {
    let metadata = std::fs::metadata(path)?;
    let refuse = |what| Err(std::io::Error::new(std::io::ErrorKind::InvalidInput, what));
    if metadata.is_dir() {
        return refuse("it is a directory");
    }
    if !metadata.is_file() || metadata.len() > 1 << 20 {
        return refuse("it is not a file of at most a megabyte");
    }
    std::fs::read_to_string(path)
}

/// The scheme of the text of a file: of a specification, or of a file that has nothing but the table `modulation` with a
/// scheme in it.
pub(super) fn parse_scheme(source: &str, text: &str) -> Result<Scheme> {
    let table = fields::parse(source, text)?;
    let top = Fields::top(source, &table);
    if top.has("format") {
        return Ok(parse(source, text)?.modulation.scheme);
    }
    top.only(&["modulation"])?;
    let modulation = top.section("modulation")?;
    modulation.only(&["scheme", "frames", "coefficient_bits"])?;
    scheme_file::read(source, &modulation)
}

/// Reads the text of a file; the limits of each value are checked here, their interplay by [`check`].
pub(super) fn parse(source: &str, text: &str) -> Result<Specification> {
    let table = fields::parse(source, text)?;
    let top = Fields::top(source, &table);
    top.only(&["format", "name", "sensor", "modulation", "cordic", "output", "registers", "unwrapping"])?;
    let expected_format = format!("\"{FORMAT}\"");
    if top.text("format", &expected_format)? != FORMAT {
        return Err(top.refuse("format", &expected_format));
    }
    let name = top.text("name", NAME_RULE)?.to_owned();

    let sensor = top.section("sensor")?;
    sensor.only(&["width", "height", "adc_bits", "saturation_dn", "line_blanking_clocks"])?;
    let adc_bits = sensor.integer("adc_bits", ADC_BITS)? as u32;
    let full_scale_dn = Word::unsigned(adc_bits).max();
    let sensor = Sensor {
        width: sensor.integer("width", 2..=4096)? as usize,
        height: sensor.integer("height", 1..=4096)? as usize,
        adc_bits,
        saturation_dn: sensor.integer_or("saturation_dn", 1..=full_scale_dn, full_scale_dn)?,
        line_blanking_clocks: sensor.integer_or("line_blanking_clocks", 16..=60_000, 64)? as u32,
    };

    let modulation = top.section("modulation")?;
    modulation.only(&[
        "scheme",
        "frequency_hz",
        "frames_per_step",
        "frames",
        "coefficient_bits",
        "order",
        "phase_step_bits",
    ])?;
    let scheme = scheme_file::read(source, &modulation)?;
    let modulation = Modulation {
        frequency_hz: modulation.number("frequency_hz", 1e4..=1e10, "Hz")?,
        frames_per_step: modulation.integer_or("frames_per_step", 1..=256, 1)? as usize,
        order: order(&modulation, &scheme)?,
        scheme,
        phase_step_bits: modulation.integer_or("phase_step_bits", 2..=24, DEFAULT_PHASE_STEP_BITS.into())?
            as u32,
    };

    let cordic = top.section("cordic")?;
    let cordic = read_cordic(&cordic)?;

    let output = top.section("output")?;
    output.only(&[
        "phase_bits",
        "amplitude",
        "amplitude_fraction_bits",
        "offset_fraction_bits",
        "distance_unit_m",
        "minimum_amplitude_dn",
        "multipliers",
    ])?;
    let kinds = MULTIPLIERS.map(|row| format!("\"{}\"", row.0)).join(" or ");
    let multipliers = match output.has("multipliers") {
        false => Multipliers::Dsp,
        true => {
            let name = output.text("multipliers", &kinds)?;
            let known = MULTIPLIERS.iter().find(|row| row.0 == name);
            known.ok_or_else(|| output.refuse("multipliers", &kinds))?.1
        }
    };
    let output = Output {
        phase_bits: output.integer("phase_bits", 8..=24)? as u32,
        amplitude: output.flag_or("amplitude", true)?,
        amplitude_fraction_bits: output.integer("amplitude_fraction_bits", 0..=8)? as u32,
        offset_fraction_bits: output.integer("offset_fraction_bits", 0..=8)? as u32,
        distance_unit_m: output.number("distance_unit_m", 1e-7..=1.0, "m")?,
        minimum_amplitude_dn: output.number_or("minimum_amplitude_dn", 0.0..=65_535.0, "DN", 0.0)?,
        multipliers,
    };
    let (registers, unwrapping) = (registers(&top)?, unwrapping::read(&top)?);
    Ok(Specification { name, sensor, modulation, cordic, output, registers, unwrapping })
}

/// The order of the phase steps, where there is one; [`check`] sees whether it is the scheme's.
fn order(modulation: &Fields, scheme: &Scheme) -> Result<Option<Vec<usize>>> {
    if !modulation.has("order") {
        return Ok(None);
    }
    let expected = "a list of the scheme's phase steps, whole numbers from 0 on, such as [0, 3, 1, 4, 2]";
    let numbers = modulation.numbers("order", expected)?;
    let whole = numbers.iter().all(|number| number.fract() == 0.0 && (0.0..65_536.0).contains(number));
    if !whole || numbers.is_empty() {
        return Err(modulation.refuse("order", expected));
    }
    Ok(normalised_order(scheme, numbers.into_iter().map(|number| number as usize).collect()))
}

/// The register block: none where the section is absent.
fn registers(top: &Fields) -> Result<RegisterBlock> {
    let Some(registers) = top.optional_section("registers")? else {
        return Ok(RegisterBlock::default());
    };
    registers.only(&["axi4_lite", "frequency_factor"])?;
    Ok(RegisterBlock {
        axi4_lite: registers.flag_or("axi4_lite", true)?,
        frequency_factor: registers.integer_or("frequency_factor", 0..=u32::MAX.into(), 0)? as u32,
    })
}

const MULTIPLIERS: [(&str, Multipliers); 2] =
    [("dsp", Multipliers::Dsp), ("shift_add", Multipliers::ShiftAdd)];

pub(super) const NAME_RULE: &str = "1 to 32 lower case letters, digits, `-` and `_`, a letter first (it begins the names of Verilog modules)";

/// Refuses a name that cannot begin the names of Verilog modules.
pub(super) fn check_name(source: &str, name: &str) -> Result<()> {
    let letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    let begins_well = name.starts_with(|c: char| c.is_ascii_lowercase());
    if begins_well && name.chars().all(letter) && name.len() <= 32 {
        Ok(())
    } else {
        Err(refused(source, "name", format_args!("\"{name}\"")).expected(NAME_RULE))
    }
}

/// What only shows between fields, and what a specification made in code could get wrong.
pub(super) fn check(source: &str, specification: &Specification) -> Result<()> {
    let Specification { name, sensor, .. } = specification;
    check_name(source, name)?;
    for (field, value, allowed) in
        [("sensor.width", sensor.width, 2..=4096), ("sensor.height", sensor.height, 1..=4096)]
    {
        if !allowed.contains(&value) {
            return Err(refused(source, field, value).expected(format_args!(
                "a whole number from {} to {}",
                allowed.start(),
                allowed.end()
            )));
        }
    }
    if !ADC_BITS.contains(&i64::from(sensor.adc_bits)) {
        let expected = format_args!("{} to {} bits", ADC_BITS.start(), ADC_BITS.end());
        return Err(refused(source, "sensor.adc_bits", sensor.adc_bits).expected(expected));
    }
    let full_scale_dn = Word::unsigned(sensor.adc_bits).max();
    if !(1..=full_scale_dn).contains(&sensor.saturation_dn) {
        return Err(refused(source, "sensor.saturation_dn", sensor.saturation_dn)
            .expected(format_args!("1 to {full_scale_dn}, the full scale of {} bits", sensor.adc_bits)));
    }
    if sensor.width * sensor.height < 8 {
        return Err(refused(source, "sensor.width * sensor.height", sensor.width * sensor.height)
            .expected("8 pixels or more: a sum is back in its memory before its pixel's next frame"));
    }
    if sensor.width * sensor.height > 1 << 20 {
        return Err(refused(source, "sensor.width * sensor.height", sensor.width * sensor.height)
            .expected("2^20 pixels or fewer: the sums must fit block RAM"));
    }
    if !(1..=256).contains(&specification.modulation.frames_per_step) {
        return Err(refused(source, "modulation.frames_per_step", specification.modulation.frames_per_step)
            .expected("1 to 256"));
    }
    sequence::check(source, specification)
}

/// The text of a file that reads as `specification`.
pub(super) fn write(specification: &Specification) -> String {
    let Specification { name, sensor, modulation, cordic, output, registers, unwrapping } = specification;
    format!(
        "format = \"{FORMAT}\"\n\
         name = \"{name}\"\n\
         \n[sensor]\n\
         width = {}\nheight = {}\nadc_bits = {}\nsaturation_dn = {}\nline_blanking_clocks = {}\n\
         \n[modulation]\n\
         {}frequency_hz = {:?}\nframes_per_step = {}\n\
         order = {:?}\nphase_step_bits = {}\n{}\
         \n{}\n[output]\n\
         phase_bits = {}\namplitude = {}\namplitude_fraction_bits = {}\noffset_fraction_bits = {}\n\
         distance_unit_m = {:?}\nminimum_amplitude_dn = {:?}\nmultipliers = \"{}\"\n\
         \n[registers]\n\
         axi4_lite = {}\nfrequency_factor = {}\n{}",
        sensor.width,
        sensor.height,
        sensor.adc_bits,
        sensor.saturation_dn,
        sensor.line_blanking_clocks,
        scheme_file::fields(&modulation.scheme),
        modulation.frequency_hz,
        modulation.frames_per_step,
        modulation.steps_in_order(),
        modulation.phase_step_bits,
        scheme_file::table(&modulation.scheme),
        write_cordic(cordic),
        output.phase_bits,
        output.amplitude,
        output.amplitude_fraction_bits,
        output.offset_fraction_bits,
        output.distance_unit_m,
        output.minimum_amplitude_dn,
        MULTIPLIERS.iter().find(|row| row.1 == output.multipliers).map_or("", |row| row.0),
        registers.axi4_lite,
        registers.frequency_factor,
        unwrapping.as_ref().map(unwrapping::write).unwrap_or_default(),
    )
}
