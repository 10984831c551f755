//! Whatever is wrong with a specification, an argument, a place for the output or a recording: the program ends with exit
//! code 2 and one error that names file, field, value and what is allowed, and what stood there before is untouched.

use assert_cmd::cargo::cargo_bin_cmd;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const GOOD: &str = "format = \"vuris-pipeline/1\"\nname = \"bench\"\n\n[sensor]\nwidth = 8\nheight = 2\nadc_bits = 12\n\
                    saturation_dn = 4000\nline_blanking_clocks = 64\n\n[modulation]\nscheme = \"wdft\"\n\
                    frequency_hz = 30000000.0\nframes_per_step = 2\n\n[cordic]\niterations = 20\n\
                    vector_guard_bits = 4\nangle_guard_bits = 6\n\n[output]\nphase_bits = 18\n\
                    amplitude_fraction_bits = 4\noffset_fraction_bits = 4\ndistance_unit_m = 1e-5\n\
                    minimum_amplitude_dn = 0.0\n";
const CAMPAIGN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/practice-01");

/// What is done to a good file or folder. Paths are relative to the folder that the test says.
enum Change {
    /// The first text is replaced by the second, which must be there.
    Replace(&'static str, &'static str, &'static str),
    /// The file is written anew.
    Write(&'static str, &'static [u8]),
    /// An array is written anew: type, shape, and how many zero bytes follow.
    Array(&'static str, &'static str, &'static str, usize),
    /// The file is cut to so many bytes.
    Cut(&'static str, u64),
    /// The file or folder is removed.
    Remove(&'static str),
    /// What is there gives place to a folder.
    Folder(&'static str),
    /// The good specification's scheme becomes four frames as a row of its own, in which the first text is replaced by the
    /// second.
    Row(&'static str, &'static str),
    /// One after the other.
    All(&'static [Change]),
}
use Change::*;

impl Change {
    fn apply(&self, folder: &Path) {
        match *self {
            Replace(file, from, to) => {
                let text = fs::read_to_string(folder.join(file)).unwrap();
                assert!(text.contains(from), "{file} has no {from:?}:\n{text}");
                fs::write(folder.join(file), text.replacen(from, to, 1)).unwrap();
            }
            Write(file, bytes) => fs::write(folder.join(file), bytes).unwrap(),
            Array(file, descr, shape, bytes) => {
                let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
                let start = b"\x93NUMPY\x01\x00\x76\x00";
                fs::write(
                    folder.join(file),
                    [start, format!("{header:<117}\n").as_bytes(), &vec![0; bytes]].concat(),
                )
                .unwrap();
            }
            Cut(file, length) => {
                fs::OpenOptions::new().write(true).open(folder.join(file)).unwrap().set_len(length).unwrap();
            }
            Remove(path) => remove(&folder.join(path)),
            Folder(path) => {
                if folder.join(path).exists() {
                    remove(&folder.join(path));
                }
                fs::create_dir(folder.join(path)).unwrap();
            }
            Row(from, to) => {
                let text = fs::read_to_string(folder.join(SPEC)).unwrap();
                let row = "\n[modulation.scheme]\nname = \"own\"\nstep_turns = \"1/4\"\nin_phase = [1, 0, -1, 0]\n\
                           quadrature = [0, 1, 0, -1]\noffset = [1, 1, 1, 1]\nirrational = \"1\"\n\n[cordic]";
                assert!(row.contains(from), "the row has no {from:?}");
                let text = text.replacen("scheme = \"wdft\"\n", "", 1);
                fs::write(folder.join(SPEC), text.replacen("\n[cordic]", &row.replacen(from, to, 1), 1))
                    .unwrap();
            }
            All(changes) => changes.iter().for_each(|change| change.apply(folder)),
        }
    }
}

fn remove(path: &Path) {
    if path.is_dir() {
        fs::remove_dir_all(path).unwrap();
    } else {
        fs::remove_file(path).unwrap();
    }
}

/// Every file and folder below `folder`, with the files' bytes.
fn snapshot(folder: &Path) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(snapshot(&path));
            found.insert(path, None);
        } else {
            let bytes = fs::read(&path).unwrap();
            found.insert(path, Some(bytes));
        }
    }
    found
}

/// Runs the program in `home`, without simulators: whatever wants to build something fails in another way than expected.
fn run(home: &Path, arguments: &[&str]) -> std::process::Output {
    let mut command = cargo_bin_cmd!("vuris");
    command.current_dir(home).args(arguments).env("VURIS_VERILATOR", "/nonexistent/verilator");
    command.output().unwrap()
}

fn succeed(home: &Path, arguments: &[&str]) {
    let output = run(home, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
}

/// What is wrong with the way in which `arguments` are refused in `home`, if anything: one error with all of `parts`, exit
/// code 2, at most notes on standard output, and every file as before.
fn refusal_faults(home: &Path, arguments: &[&str], parts: &[&str]) -> Option<String> {
    let before = snapshot(home);
    let start = Instant::now();
    let output = run(home, arguments);
    let took = start.elapsed();
    let (stdout, stderr) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let mut faults = Vec::new();
    if output.status.code() != Some(2) {
        faults.push(format!("exit code {:?}", output.status.code()));
    }
    if stderr.matches("error:").count() != 1 || !stderr.starts_with("error:") {
        faults.push("not one error".to_owned());
    }
    if let Some(line) = stdout.lines().find(|line| !line.contains(" instead of ")) {
        faults.push(format!("standard output says {line:?}"));
    }
    for part in parts.iter().filter(|part| !stderr.contains(**part)) {
        faults.push(format!("does not say {part:?}"));
    }
    for panic in ["panicked", "RUST_BACKTRACE", "src/", ".rs:"] {
        if stderr.contains(panic) {
            faults.push(format!("says {panic:?}"));
        }
    }
    if took > Duration::from_secs(10) {
        faults.push(format!("took {took:?}"));
    }
    let after = snapshot(home);
    for path in before.keys().chain(after.keys()).filter(|path| before.get(*path) != after.get(*path)) {
        faults.push(format!("touched {}", path.display()));
    }
    faults.dedup();
    (!faults.is_empty()).then(|| format!("{arguments:?}: {}\n{stderr}", faults.join("; ")))
}

fn assert_none(faults: Vec<String>) {
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

// ---------------------------------------------------------------- specifications

const SPEC: &str = "pipeline.toml";
const TOP: &str = "one of format, name, sensor, modulation, cordic, output, registers";
const NAME: &str = "1 to 32 lower case letters, digits, `-` and `_`, a letter first";
const PRESETS: &str = "one of the presets vuris, vuris-fast, vuris-four-frame";

const fn replace(from: &'static str, to: &'static str) -> Change {
    Replace(SPEC, from, to)
}

/// The change, and what the refusal must say beside the file's name: field, value, what is allowed.
const SPECIFICATIONS: &[(&str, Change, &[&str])] = &[
    ("missing", Remove(SPEC), &["cannot read", "No such file", PRESETS, "vuris explain --spec vuris --toml"]),
    ("folder", Folder(SPEC), &["cannot read", "directory", PRESETS]),
    ("not text", Write(SPEC, b"\xff\xfe\x00"), &["cannot read", "UTF-8"]),
    ("empty", Write(SPEC, b""), &["format is missing", "\"vuris-pipeline/1\""]),
    ("not TOML", Write(SPEC, b"width: 160\n"), &["line 1", "a TOML file"]),
    ("cut short", Write(SPEC, b"format = \"vuris-pipe"), &["line 1", "a TOML file"]),
    ("Verilog", Write(SPEC, b"module vuris (\n  input wire clk_i\n);\n"), &["line 1", "a TOML file"]),
    ("twice", replace("width = 8", "width = 8\nwidth = 9"), &["line 6", "duplicate key", "a TOML file"]),
    (
        "format missing",
        replace("format = \"vuris-pipeline/1\"", ""),
        &["format is missing", "vuris-pipeline/1"],
    ),
    (
        "format of the future",
        replace("pipeline/1", "pipeline/2"),
        &["format = \"vuris-pipeline/2\"", "\"vuris-pipeline/1\""],
    ),
    (
        "format of a recording",
        replace("vuris-pipeline/1", "vuris-recording/1"),
        &["vuris-recording/1", "\"vuris-pipeline/1\""],
    ),
    ("format a number", replace("\"vuris-pipeline/1\"", "1"), &["format = 1", "\"vuris-pipeline/1\""]),
    ("section unknown", replace("[sensor]", "[optics]\nf = 1\n[sensor]"), &["optics is not a field", TOP]),
    ("section misspelt", replace("[cordic]", "[codric]"), &["codric is not a field", TOP, "spelling"]),
    (
        "section a number",
        replace("name = \"bench\"", "name = \"bench\"\nsensor = 3\n#"),
        &["line", "sensor", "a TOML file"],
    ),
    ("section a list", replace("[cordic]", "[[cordic]]"), &["cordic = [", "a table [cordic]"]),
    (
        "sensor missing",
        Write(SPEC, b"format = \"vuris-pipeline/1\"\nname = \"a\"\n"),
        &["sensor is missing", "a table [sensor]"],
    ),
    ("field at the top unknown", replace("name =", "title ="), &["title is not a field", TOP]),
    (
        "field of the sensor unknown",
        replace("width", "wdith"),
        &["sensor.wdith is not a field", "one of width, height"],
    ),
    (
        "field of the modulation unknown",
        replace("frequency_hz", "frequency_mhz"),
        &["modulation.frequency_mhz is not", "one of scheme, frequency_hz"],
    ),
    (
        "field of the CORDIC unknown",
        replace("angle_guard", "guard"),
        &["cordic.guard_bits is not", "one of iterations"],
    ),
    (
        "field of the output unknown",
        replace("phase_bits", "phase_bit"),
        &["output.phase_bit is not", "one of phase_bits"],
    ),
    ("name missing", replace("name = \"bench\"", ""), &["name is missing", NAME]),
    ("name a number", replace("\"bench\"", "7"), &["name = 7", NAME]),
    ("name in upper case", replace("\"bench\"", "\"Bench\""), &["name = \"Bench\"", NAME]),
    ("name empty", replace("\"bench\"", "\"\""), &["name = \"\"", NAME]),
    (
        "name too long",
        replace("\"bench\"", "\"a23456789-123456789-123456789-123\""),
        &["a23456789-123456789-123456789-123", NAME],
    ),
    ("name that starts with a digit", replace("\"bench\"", "\"3d\""), &["name = \"3d\"", NAME]),
    ("name with a path", replace("\"bench\"", "\"../bench\""), &["name = \"../bench\"", NAME]),
    ("name with an umlaut", replace("\"bench\"", "\"b\u{e4}nk\""), &["name = \"b\u{e4}nk\"", NAME]),
    (
        "width missing",
        replace("width = 8\n", ""),
        &["sensor.width is missing", "a whole number from 2 to 4096"],
    ),
    (
        "width below",
        replace("width = 8", "width = 1"),
        &["sensor.width = 1", "a whole number from 2 to 4096"],
    ),
    (
        "width above",
        replace("width = 8", "width = 4097"),
        &["sensor.width = 4097", "a whole number from 2 to 4096"],
    ),
    ("width negative", replace("width = 8", "width = -8"), &["sensor.width = -8", "2 to 4096"]),
    ("width broken", replace("width = 8", "width = 8.0"), &["sensor.width = 8.0", "a whole number"]),
    ("width quoted", replace("width = 8", "width = \"8\""), &["sensor.width = \"8\"", "a whole number"]),
    ("width true", replace("width = 8", "width = true"), &["sensor.width = true", "a whole number"]),
    (
        "width beyond 63 bits",
        replace("width = 8", "width = 9223372036854775808"),
        &["9223372036854775808", "line 5"],
    ),
    (
        "height below",
        replace("height = 2", "height = 0"),
        &["sensor.height = 0", "a whole number from 1 to 4096"],
    ),
    ("height above", replace("height = 2", "height = 5000"), &["sensor.height = 5000", "1 to 4096"]),
    (
        "too few pixels",
        replace("width = 8", "width = 3"),
        &["sensor.width * sensor.height = 6", "8 pixels or more"],
    ),
    (
        "too many pixels",
        replace("width = 8\nheight = 2", "width = 4096\nheight = 257"),
        &["sensor.width * sensor.height = 1052672", "2^20 pixels or fewer"],
    ),
    (
        "adc_bits below",
        replace("adc_bits = 12", "adc_bits = 7"),
        &["sensor.adc_bits = 7", "a whole number from 8 to 16"],
    ),
    (
        "adc_bits above",
        replace("adc_bits = 12", "adc_bits = 17"),
        &["sensor.adc_bits = 17", "a whole number from 8 to 16"],
    ),
    ("saturation of nothing", replace("= 4000", "= 0"), &["sensor.saturation_dn = 0", "1 to 4095"]),
    (
        "saturation beyond full scale",
        replace("= 4000", "= 4096"),
        &["sensor.saturation_dn = 4096", "1 to 4095"],
    ),
    (
        "saturation beyond a smaller scale",
        replace("adc_bits = 12", "adc_bits = 8"),
        &["sensor.saturation_dn = 4000", "1 to 255"],
    ),
    (
        "blanking below",
        replace("clocks = 64", "clocks = 15"),
        &["sensor.line_blanking_clocks = 15", "16 to 60000"],
    ),
    (
        "blanking above",
        replace("clocks = 64", "clocks = 60001"),
        &["sensor.line_blanking_clocks = 60001", "16 to 60000"],
    ),
    (
        "scheme missing",
        replace("scheme = \"wdft\"", ""),
        &["modulation.scheme is missing", "one of four_frame, wdft"],
    ),
    (
        "scheme unknown",
        replace("\"wdft\"", "\"six_frame\""),
        &["modulation.scheme = \"six_frame\"", "one of four_frame, wdft"],
    ),
    (
        "scheme in upper case",
        replace("\"wdft\"", "\"WDFT\""),
        &["modulation.scheme = \"WDFT\"", "one of four_frame, wdft"],
    ),
    ("scheme a number", replace("\"wdft\"", "5"), &["modulation.scheme = 5", "one of four_frame, wdft"]),
    (
        "DFT without frames",
        replace("\"wdft\"", "\"dft\"\ncoefficient_bits = 12"),
        &["modulation.frames is missing", "3 to 64"],
    ),
    (
        "DFT without bits",
        replace("\"wdft\"", "\"dft\"\nframes = 7"),
        &["modulation.coefficient_bits is missing", "4 to 18"],
    ),
    (
        "DFT of two frames",
        replace("\"wdft\"", "\"dft\"\nframes = 2\ncoefficient_bits = 12"),
        &["modulation.frames = 2", "3 to 64"],
    ),
    (
        "DFT of too many bits",
        replace("\"wdft\"", "\"dft\"\nframes = 7\ncoefficient_bits = 19"),
        &["modulation.coefficient_bits = 19", "4 to 18"],
    ),
    (
        "frames of a named scheme",
        replace("\"wdft\"", "\"wdft\"\nframes = 7"),
        &["modulation.frames = 7", "scheme = \"dft\""],
    ),
    ("row without a name", Row("name = \"own\"", ""), &["modulation.scheme.name is missing"]),
    (
        "row with a name that is taken",
        Row("\"own\"", "\"wdft\""),
        &["modulation.scheme.name = \"wdft\"", "built in"],
    ),
    (
        "row with a field of its own",
        Row("name = \"own\"", "name = \"own\"\ngain = 2"),
        &["modulation.scheme.gain is not", "in_phase"],
    ),
    (
        "row with a fraction",
        Row("[1, 0, -1, 0]", "[1, 0.5, -1, 0]"),
        &["modulation.scheme.in_phase = ", "whole numbers"],
    ),
    (
        "row of two",
        Row("[1, 0, -1, 0]", "[1, -1]"),
        &["modulation.scheme.in_phase = [1, -1]", "3 to 64 weights"],
    ),
    (
        "row of unequal lengths",
        Row("[0, 1, 0, -1]", "[0, 1, -1]"),
        &["modulation.scheme.quadrature = [0, 1, -1]", "4 of them"],
    ),
    (
        "row that sees constant light",
        Row("[1, 0, -1, 0]", "[1, 1, -1, 0]"),
        &["modulation.scheme.in_phase = [1, 1, -1, 0]", "add up to 0", "make 1"],
    ),
    (
        "row with a large weight",
        Row("[1, 0, -1, 0]", "[131072, 0, -131072, 0]"),
        &["modulation.scheme.in_phase", "-131071 to 131071"],
    ),
    (
        "row of the other sign",
        Row("[0, 1, 0, -1]", "[0, -1, 0, 1]"),
        &["modulation.scheme.quadrature = [0, -1, 0, 1]", "backwards", "negate the quadrature weights"],
    ),
    (
        "row of another frame",
        Row("step_turns = \"1/4\"", "step_turns = [\"1/4\", \"1/2\", \"3/4\", \"1\"]"),
        &["modulation.scheme.quadrature", "turned by -0.2500 turn", "step_turns"],
    ),
    (
        "row of two gains",
        Row("[0, 1, 0, -1]", "[0, 2, 0, -2]"),
        &["modulation.scheme.quadrature", "differ in gain", "irrational"],
    ),
    (
        "row of a wrong irrational",
        Row("irrational = \"1\"", "irrational = \"2\""),
        &["modulation.scheme.irrational = \"2\"", "sqrt(3)"],
    ),
    (
        "row with the irrational that it has not",
        Row("irrational = \"1\"", "irrational = \"sqrt(3)\""),
        &["modulation.scheme.quadrature", "differ in gain"],
    ),
    (
        "row without steps",
        Row("step_turns = \"1/4\"", ""),
        &["modulation.scheme.step_turns is missing", "fraction of a turn"],
    ),
    (
        "row of a decimal step",
        Row("\"1/4\"", "0.25"),
        &["modulation.scheme.step_turns = 0.25", "fraction of a turn"],
    ),
    (
        "row of a step by zero",
        Row("\"1/4\"", "\"1/0\""),
        &["modulation.scheme.step_turns = \"1/0\"", "fraction of a turn"],
    ),
    (
        "row of three angles",
        Row("\"1/4\"", "[\"0\", \"1/4\", \"1/2\"]"),
        &["modulation.scheme.step_turns = 3 angles", "4 of them"],
    ),
    (
        "row whose offset sees the light's phase",
        Row("offset = [1, 1, 1, 1]", "offset = [1, 1, 1, 0]"),
        &["modulation.scheme.offset = [1, 1, 1, 0]", "leak"],
    ),
    (
        "row with a negative offset weight",
        Row("offset = [1, 1, 1, 1]", "offset = [2, -1, 2, -1]"),
        &["modulation.scheme.offset = [2, -1, 2, -1]", "from 0"],
    ),
    (
        "row without any offset",
        All(&[
            Row("offset = [1, 1, 1, 1]\n", ""),
            Replace(SPEC, "[1, 0, -1, 0]", "[-29289, 100000, -70711]"),
            Replace(SPEC, "[0, 1, 0, -1]", "[-70711, 100000, -29289]"),
            Replace(SPEC, "\"1/4\"", "[\"0\", \"1/8\", \"1/4\"]"),
        ]),
        &["modulation.scheme.offset = none", "regular polygon", "give offset"],
    ),
    (
        "row that is too wide",
        All(&[
            Row("[1, 0, -1, 0]", "[131071, 0, -131071, 0]"),
            Replace(SPEC, "[0, 1, 0, -1]", "[0, 131071, 0, -131071]"),
            Replace(SPEC, "[1, 1, 1, 1]", "[131071, 131071, 131071, 131071]"),
            Replace(SPEC, "adc_bits = 12", "adc_bits = 16"),
            Replace(SPEC, "per_step = 2", "per_step = 256"),
            Replace(SPEC, "offset_fraction_bits = 4", "offset_fraction_bits = 8"),
        ]),
        &["modulation.scheme.offset", "63 bits", "smaller weights"],
    ),
    ("frequency NaN", replace("30000000.0", "nan"), &["modulation.frequency_hz = nan", "1e4 to 1e10 Hz"]),
    (
        "frequency infinite",
        replace("30000000.0", "inf"),
        &["modulation.frequency_hz = inf", "1e4 to 1e10 Hz"],
    ),
    (
        "frequency in MHz",
        replace("30000000.0", "30.0"),
        &["modulation.frequency_hz = 30.0", "1e4 to 1e10 Hz"],
    ),
    (
        "frequency above",
        replace("30000000.0", "1.1e10"),
        &["modulation.frequency_hz = 11000000000.0", "1e4 to 1e10 Hz"],
    ),
    (
        "frequency with its unit",
        replace("30000000.0", "\"30 MHz\""),
        &["modulation.frequency_hz = \"30 MHz\"", "Hz"],
    ),
    (
        "no frame a step",
        replace("per_step = 2", "per_step = 0"),
        &["modulation.frames_per_step = 0", "1 to 256"],
    ),
    (
        "too many frames a step",
        replace("per_step = 2", "per_step = 257"),
        &["modulation.frames_per_step = 257", "1 to 256"],
    ),
    (
        "order without a step",
        replace("per_step = 2", "per_step = 2\norder = [1, 0, 2, 3]"),
        &[
            "modulation.order = [1, 0, 2, 3]",
            "every step of wdft once: the numbers 0 to 4",
            "leave the line out",
        ],
    ),
    (
        "ascending order of another scheme",
        replace("per_step = 2", "per_step = 2\norder = [0, 1, 2, 3]"),
        &["modulation.order = [0, 1, 2, 3]", "every step of wdft once: the numbers 0 to 4"],
    ),
    (
        "order with a step twice",
        replace("per_step = 2", "per_step = 2\norder = [0, 1, 2, 3, 3]"),
        &["modulation.order = [0, 1, 2, 3, 3]", "the numbers 0 to 4"],
    ),
    (
        "order from 1",
        replace("per_step = 2", "per_step = 2\norder = [5, 4, 3, 2, 1]"),
        &["modulation.order = [5, 4, 3, 2, 1]", "the numbers 0 to 4"],
    ),
    (
        "order of nothing",
        replace("per_step = 2", "per_step = 2\norder = []"),
        &["modulation.order = []", "whole numbers from 0 on"],
    ),
    (
        "order of a negative",
        replace("per_step = 2", "per_step = 2\norder = [0, 1, 2, 3, -4]"),
        &["modulation.order = [0, 1, 2, 3, -4]", "whole numbers from 0 on"],
    ),
    (
        "order of a fraction",
        replace("per_step = 2", "per_step = 2\norder = [0, 1, 2, 3, 4.5]"),
        &["modulation.order = [", "whole numbers from 0 on"],
    ),
    (
        "order a word",
        replace("per_step = 2", "per_step = 2\norder = \"ascending\""),
        &["modulation.order = \"ascending\"", "whole numbers from 0 on"],
    ),
    (
        "phase step in 1 bit",
        replace("per_step = 2", "per_step = 2\nphase_step_bits = 1"),
        &["modulation.phase_step_bits = 1", "2 to 24"],
    ),
    (
        "phase step in 25 bits",
        replace("per_step = 2", "per_step = 2\nphase_step_bits = 25"),
        &["modulation.phase_step_bits = 25", "2 to 24"],
    ),
    (
        "field of the registers unknown",
        replace("[output]", "[registers]\naxi = true\n[output]"),
        &["registers.axi is not a field", "one of axi4_lite, frequency_factor"],
    ),
    (
        "AXI4-Lite a number",
        replace("[output]", "[registers]\naxi4_lite = 1\n[output]"),
        &["registers.axi4_lite = 1", "true or false"],
    ),
    (
        "frequency factor negative",
        replace("[output]", "[registers]\nfrequency_factor = -1\n[output]"),
        &["registers.frequency_factor = -1", "0 to 4294967295"],
    ),
    (
        "frequency factor of 33 bits",
        replace("[output]", "[registers]\nfrequency_factor = 4294967296\n[output]"),
        &["registers.frequency_factor = 4294967296", "0 to 4294967295"],
    ),
    ("iterations missing", replace("iterations = 20", ""), &["cordic.iterations is missing", "4 to 30"]),
    ("iterations below", replace("iterations = 20", "iterations = 3"), &["cordic.iterations = 3", "4 to 30"]),
    (
        "iterations above",
        replace("iterations = 20", "iterations = 31"),
        &["cordic.iterations = 31", "4 to 30"],
    ),
    (
        "more iterations than bits",
        replace("iterations = 20", "iterations = 23"),
        &["cordic.iterations = 23", "at most phase_bits + vector_guard_bits = 22"],
    ),
    (
        "vector guard below",
        replace("vector_guard_bits = 4", "vector_guard_bits = -1"),
        &["cordic.vector_guard_bits = -1", "0 to 8"],
    ),
    (
        "vector guard above",
        replace("vector_guard_bits = 4", "vector_guard_bits = 9"),
        &["cordic.vector_guard_bits = 9", "0 to 8"],
    ),
    (
        "angle guard below",
        replace("angle_guard_bits = 6", "angle_guard_bits = 0"),
        &["cordic.angle_guard_bits = 0", "1 to 8"],
    ),
    (
        "angle guard above",
        replace("angle_guard_bits = 6", "angle_guard_bits = 9"),
        &["cordic.angle_guard_bits = 9", "1 to 8"],
    ),
    ("phase below", replace("phase_bits = 18", "phase_bits = 7"), &["output.phase_bits = 7", "8 to 24"]),
    ("phase above", replace("phase_bits = 18", "phase_bits = 25"), &["output.phase_bits = 25", "8 to 24"]),
    (
        "phase narrower than the iterations",
        replace("phase_bits = 18", "phase_bits = 15"),
        &["cordic.iterations = 20", "phase_bits + vector_guard_bits = 19"],
    ),
    (
        "amplitude below",
        replace("amplitude_fraction_bits = 4", "amplitude_fraction_bits = -1"),
        &["output.amplitude_fraction_bits = -1", "0 to 8"],
    ),
    (
        "amplitude above",
        replace("amplitude_fraction_bits = 4", "amplitude_fraction_bits = 9"),
        &["output.amplitude_fraction_bits = 9", "0 to 8"],
    ),
    (
        "offset below",
        replace("offset_fraction_bits = 4", "offset_fraction_bits = -1"),
        &["output.offset_fraction_bits = -1", "0 to 8"],
    ),
    (
        "offset above",
        replace("offset_fraction_bits = 4", "offset_fraction_bits = 9"),
        &["output.offset_fraction_bits = 9", "0 to 8"],
    ),
    ("unit missing", replace("distance_unit_m = 1e-5", ""), &["output.distance_unit_m is missing", " m"]),
    ("unit zero", replace("1e-5", "0.0"), &["output.distance_unit_m = 0.0", "1e-7 to 1e0 m"]),
    ("unit NaN", replace("1e-5", "nan"), &["output.distance_unit_m = nan", "1e-7 to 1e0 m"]),
    ("unit absurdly small", replace("1e-5", "1e-12"), &["output.distance_unit_m", "1e-7 to 1e0 m"]),
    ("unit absurdly large", replace("1e-5", "1000.0"), &["output.distance_unit_m = 1000.0", "1e-7 to 1e0 m"]),
    (
        "unit too large for the range",
        replace("1e-5", "1.0"),
        &["output.distance_unit_m = 1", "4.9965 m", "it holds 5"],
    ),
    (
        "unit too small for the range",
        All(&[replace("30000000.0", "1e4"), replace("1e-5", "1e-7")]),
        &["output.distance_unit_m", "14989", "2^32"],
    ),
    (
        "minimum negative",
        replace("minimum_amplitude_dn = 0.0", "minimum_amplitude_dn = -1.0"),
        &["output.minimum_amplitude_dn = -1.0", "DN"],
    ),
    (
        "minimum infinite",
        replace("minimum_amplitude_dn = 0.0", "minimum_amplitude_dn = +inf"),
        &["output.minimum_amplitude_dn = inf", "DN"],
    ),
    (
        "minimum too large",
        replace("minimum_amplitude_dn = 0.0", "minimum_amplitude_dn = 5000"),
        &["output.minimum_amplitude_dn = 5000", "at most 4095.9375 DN"],
    ),
];

#[test]
fn every_bad_specification_is_refused_by_every_command_and_leaves_all_files_as_they_were() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let recording = format!("{CAMPAIGN}/wdft-rail");
    let commands: [&[&str]; 6] = [
        &["explain", "--spec", SPEC],
        &["explain", "--toml", "--spec", SPEC],
        &["generate", "--spec", SPEC, "--out", "out"],
        &["generate", "--spec", SPEC, "--out", "out", "--check"],
        &["verify", "--spec", SPEC, "--work", "work"],
        &["process", &recording, "--spec", SPEC, "--out", "results"],
    ];
    fs::write(home.join("good.toml"), GOOD.replace("frames_per_step = 2", "frames_per_step = 1")).unwrap();
    succeed(home, &["generate", "--spec", "good.toml", "--out", "out"]);
    succeed(home, &["process", &recording, "--spec", "good.toml", "--out", "results"]);
    let mut faults = Vec::new();
    for (name, change, parts) in SPECIFICATIONS {
        if home.join(SPEC).exists() {
            remove(&home.join(SPEC));
        }
        fs::write(home.join(SPEC), GOOD).unwrap();
        succeed(home, &commands[0][..3]);
        change.apply(home);
        let parts = [&[SPEC], *parts].concat();
        // The commands share the reading: a fault shows once.
        let fault = commands.iter().find_map(|arguments| refusal_faults(home, arguments, &parts));
        faults.extend(fault.map(|fault| format!("{name}: {fault}")));
    }
    assert_none(faults);
}

#[test]
fn the_limits_themselves_are_allowed() {
    let home = tempfile::tempdir().unwrap();
    let replacements: &[&[(&str, &str)]] = &[
        &[("width = 8\nheight = 2", "width = 2\nheight = 4")],
        &[("width = 8\nheight = 2", "width = 4096\nheight = 256")],
        &[("width = 8\nheight = 2", "width = 8\nheight = 1")],
        &[("adc_bits = 12\nsaturation_dn = 4000", "adc_bits = 8\nsaturation_dn = 255")],
        &[("adc_bits = 12\nsaturation_dn = 4000", "adc_bits = 16\nsaturation_dn = 1")],
        &[
            ("saturation_dn = 4000\nline_blanking_clocks = 64\n", ""),
            ("frames_per_step = 2\n", ""),
            ("minimum_amplitude_dn = 0.0\n", ""),
        ],
        &[
            ("clocks = 64", "clocks = 16"),
            ("per_step = 2", "per_step = 256"),
            ("adc_bits = 12", "adc_bits = 16"),
        ],
        &[("clocks = 64", "clocks = 60000"), ("iterations = 20", "iterations = 4")],
        &[
            ("phase_bits = 18", "phase_bits = 24"),
            ("iterations = 20", "iterations = 30"),
            ("vector_guard_bits = 4", "vector_guard_bits = 8"),
        ],
        &[
            ("phase_bits = 18", "phase_bits = 8"),
            ("iterations = 20", "iterations = 8"),
            ("vector_guard_bits = 4", "vector_guard_bits = 0"),
        ],
        &[
            ("angle_guard_bits = 6", "angle_guard_bits = 1"),
            ("amplitude_fraction_bits = 4", "amplitude_fraction_bits = 0"),
        ],
        &[
            ("angle_guard_bits = 6", "angle_guard_bits = 8"),
            ("amplitude_fraction_bits = 4", "amplitude_fraction_bits = 8"),
        ],
        &[("offset_fraction_bits = 4", "offset_fraction_bits = 0"), ("30000000.0", "30_000_000")],
        &[
            ("offset_fraction_bits = 4", "offset_fraction_bits = 8"),
            ("minimum_amplitude_dn = 0.0", "minimum_amplitude_dn = 4095"),
        ],
        &[("per_step = 2", "per_step = 2\norder = [4, 3, 2, 1, 0]\nphase_step_bits = 2")],
        &[("per_step = 2", "per_step = 2\norder = [0, 1, 2, 3, 4]\nphase_step_bits = 24")],
        &[("[output]", "[registers]\n[output]")],
        &[("[output]", "[registers]\naxi4_lite = false\nfrequency_factor = 4294967295\n[output]")],
        &[("30000000.0", "1e10"), ("1e-5", "1e-7")],
        &[("30000000.0", "1e4"), ("1e-5", "1.0")],
        &[("\"bench\"", "\"a\"")],
        &[("\"wdft\"", "\"dft\"\nframes = 3\ncoefficient_bits = 4")],
        &[
            ("\"wdft\"", "\"dft\"\nframes = 64\ncoefficient_bits = 18"),
            ("per_step = 2", "per_step = 256"),
            ("adc_bits = 12", "adc_bits = 16"),
        ],
        &[
            ("scheme = \"wdft\"\n", ""),
            (
                "\n[cordic]",
                "\n[modulation.scheme]\nname = \"own\"\nstep_turns = \"1/3\"\nin_phase = [2, -1, -1]\nquadrature = [0, 1, -1]\nirrational = \"sqrt(3)\"\n\n[cordic]",
            ),
        ],
        &[("\"bench\"", "\"a_34567890123456789012345678901-\"")],
    ];
    for replacement in replacements {
        let text = replacement.iter().fold(GOOD.to_owned(), |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        });
        fs::write(home.path().join(SPEC), text).unwrap();
        succeed(home.path(), &["explain", "--spec", SPEC]);
    }
}

// ---------------------------------------------------------------- arguments

const ARGUMENTS: &[(&[&str], &[&str])] = &[
    (&["synthesise"], &["synthesise", "unrecognized subcommand"]),
    (&["generate"], &["--spec <FILE|PRESET>", "required"]),
    (&["generate", "--spec"], &["--spec <FILE|PRESET>", "a value is required"]),
    (&["generate", "--spec", "vuris", "--out"], &["--out <DIR>", "a value is required"]),
    (&["generate", "--spec", "vuris", "--spec", "vuris"], &["--spec", "cannot be used multiple times"]),
    (&["generate", "--spec", "vuris", "elsewhere"], &["unexpected argument 'elsewhere'"]),
    (&["generate", "--spec", "Vuris"], &["Vuris", "cannot read", PRESETS]),
    (&["explain"], &["--spec <FILE|PRESET>", "required"]),
    (&["explain", "--spec", ""], &["cannot read", PRESETS]),
    (&["verify", "--spec", "vuris", "--simulator", "modelsim"], &["'modelsim'", "verilator, icarus, all"]),
    (&["verify", "--spec", "vuris", "--scheme", "auto"], &["--recording <DIR>", "required"]),
    (&["verify", "--spec", "vuris", "--sets", "2"], &["--recording <DIR>", "required"]),
    (&["verify", "--spec", "vuris", "--recording", "r", "--sets", "0"], &["'0'", "--sets <N>", "1.."]),
    (&["verify", "--spec", "vuris", "--recording", "r", "--scheme", "wdft"], &["'wdft'", "specified, auto"]),
    (&["verify", "--spec", "vuris", "--pause", "91"], &["91", "--pause <PERCENT>", "0..=90"]),
    (&["verify", "--spec", "vuris", "--stop", "-1"], &["-1"]),
    (
        &["verify", "--spec", "vuris", "--seed", "4294967296"],
        &["4294967296", "--seed <SEED>", "0..=4294967295"],
    ),
    (&["process", "--spec", "vuris", "--out", "results"], &["<RECORDING>", "required"]),
    (&["process", "r", "--spec", "vuris"], &["--out <DIR>", "required"]),
    (
        &["process", "r", "--spec", "vuris", "--out", "results"],
        &["r: cannot open", "recording.toml, frames.npy and sets.csv"],
    ),
    (&["scene"], &["--out <DIR>", "required"]),
    (&["scene", "--out", "out", "--seed", "noise"], &["'noise'", "--seed <SEED>"]),
];

#[test]
fn every_bad_argument_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let mut faults = Vec::new();
    for (arguments, parts) in ARGUMENTS {
        faults.extend(refusal_faults(home.path(), arguments, parts));
    }
    assert_none(faults);
}

// ---------------------------------------------------------------- places for the output

/// A name; what is done to a home with the file `note`, the output `out` of another specification and the results `results`;
/// the arguments; what the refusal says.
type Place = (&'static str, &'static [Change], &'static [&'static str], &'static [&'static str]);

const PLACES: &[Place] = &[
    ("a file", &[], &["generate", "--spec", SPEC, "--out", "note"], &["note", "cannot write", "writable"]),
    (
        "below a file",
        &[],
        &["generate", "--spec", SPEC, "--out", "note/out"],
        &["note", "cannot write", "writable"],
    ),
    (
        "not writable",
        &[],
        &["generate", "--spec", SPEC, "--out", "/proc/out"],
        &["/proc/out", "cannot write", "writable"],
    ),
    (
        "a file for the first folder",
        &[Remove("out/rtl"), Write("out/rtl", b"")],
        &["generate", "--spec", SPEC, "--out", "out"],
        &["out/rtl", "cannot write"],
    ),
    (
        "a file for the last folder",
        &[Remove("out/vectors"), Write("out/vectors", b"")],
        &["generate", "--spec", SPEC, "--out", "out"],
        &["out/vectors", "cannot write"],
    ),
    (
        "a folder for the last file",
        &[Folder("out/vectors/usable.hex")],
        &["generate", "--spec", SPEC, "--out", "out"],
        &["out/vectors/usable.hex", "was not generated by vuris"],
    ),
    (
        "checked below a file",
        &[],
        &["generate", "--spec", SPEC, "--check", "--out", "note/out"],
        &["note", "cannot read"],
    ),
    (
        "checked with a folder for a file",
        &[Folder("out/rtl/bench_pipeline.v")],
        &["generate", "--spec", SPEC, "--check", "--out", "out"],
        &["out/rtl/bench_pipeline.v", "cannot read"],
    ),
    (
        "work below a file",
        &[],
        &["verify", "--spec", SPEC, "--work", "note/work"],
        &["note/work", "cannot write"],
    ),
    (
        "work not writable",
        &[],
        &["verify", "--spec", SPEC, "--recording", "recording", "--work", "/proc/work"],
        &["/proc/work", "cannot write"],
    ),
    ("picture for a file", &[], &["scene", "--out", "note"], &["note", "cannot write", "writable"]),
    (
        "picture not writable",
        &[],
        &["scene", "--out", "/proc/out"],
        &["/proc/out", "cannot write", "writable"],
    ),
    (
        "picture's name taken",
        &[Folder("out/error-maps.svg")],
        &["scene", "--out", "out"],
        &["out/error-maps.svg", "was not generated by vuris"],
    ),
    (
        "demo below a file",
        &[],
        &["demo", "--out", "note/out", "--campaign", CAMPAIGN],
        &["note/out", "cannot write"],
    ),
    (
        "results for a file",
        &[],
        &["process", "recording", "--spec", SPEC, "--out", "note"],
        &["note", "is not a folder", "another folder"],
    ),
    (
        "results below a file",
        &[],
        &["process", "recording", "--spec", SPEC, "--out", "note/results"],
        &["note/results", "cannot write"],
    ),
    (
        "results not writable",
        &[],
        &["process", "recording", "--spec", SPEC, "--out", "/proc/results"],
        &["/proc/results", "cannot write"],
    ),
    (
        "results in a folder that is not ours",
        &[],
        &["process", "recording", "--spec", SPEC, "--out", "out"],
        &["out", "was not written by vuris", "vuris-process.toml"],
    ),
    (
        "results over the recording",
        &[],
        &["process", "recording", "--spec", SPEC, "--out", "recording"],
        &["recording", "was not written by vuris"],
    ),
    (
        "results with a note",
        &[Write("results/note.txt", b"mine")],
        &["process", "recording", "--spec", SPEC, "--out", "results"],
        &["results", "note.txt", "did not write"],
    ),
    (
        "results over the campaign",
        &[],
        &["process", ".", "--spec", SPEC, "--out", "."],
        &["recording", "was not written by vuris"],
    ),
    (
        "results of which the second cannot be written",
        &[Folder("both"), Folder("both/second"), Write("both/second/note.txt", b"mine")],
        &["process", ".", "--spec", SPEC, "--out", "both"],
        &["both/second", "was not written by vuris"],
    ),
    (
        "results without a name",
        &[],
        &["process", "recording", "--spec", SPEC, "--out", "/"],
        &["/: ", "was not written by vuris"],
    ),
];

#[test]
fn every_bad_place_for_the_output_is_refused_and_left_as_it_was() {
    let mut faults = Vec::new();
    for (name, changes, arguments, parts) in PLACES {
        let home = tempfile::tempdir().unwrap();
        let home = home.path();
        fs::write(home.join("note"), "mine").unwrap();
        fs::write(home.join(SPEC), GOOD.replace("frames_per_step = 2", "frames_per_step = 1")).unwrap();
        succeed(home, &["generate", "--spec", SPEC, "--out", "out"]);
        copy_recording("wdft-rail", &home.join("recording"));
        copy_recording("wdft-rail", &home.join("second"));
        succeed(home, &["process", "recording", "--spec", SPEC, "--out", "results"]);
        // Another specification, so that every file would be written anew.
        Replace(SPEC, "iterations = 20", "iterations = 18").apply(home);
        changes.iter().for_each(|change| change.apply(home));
        let fault = refusal_faults(home, arguments, parts);
        faults.extend(fault.map(|fault| format!("{name}: {fault}")));
    }
    assert_none(faults);
}

// ---------------------------------------------------------------- recordings

/// Copies a recording of the practice campaign to `folder`, and its camera beside it.
fn copy_recording(name: &str, folder: &Path) {
    fs::create_dir_all(folder).unwrap();
    for file in ["recording.toml", "frames.npy", "sets.csv", "mask.npy"] {
        fs::copy(format!("{CAMPAIGN}/{name}/{file}"), folder.join(file)).unwrap();
    }
    fs::copy(format!("{CAMPAIGN}/camera.toml"), folder.with_file_name("camera.toml")).unwrap();
}

const FRAMES: &str = "rail/frames.npy";
const TOML: &str = "rail/recording.toml";
const SETS: &str = "rail/sets.csv";
const CONTENTS: &str = "a folder with recording.toml, frames.npy and sets.csv";
/// A set of the recording: 5 frames of 18 rows of 24 pixels of 2 bytes.
const SET_BYTES: usize = 5 * 18 * 24 * 2;

/// The change to the folder with the recording `rail`, and what the refusal must say.
const RECORDINGS: &[(&str, &[Change], &[&str])] = &[
    ("no folder", &[Remove("rail")], &["rail: cannot open", CONTENTS]),
    ("a file", &[Remove("rail"), Write("rail", b"")], &["rail: is not a folder", CONTENTS]),
    ("an empty folder", &[Folder("rail")], &["rail: recording.toml is missing", CONTENTS]),
    ("no frames", &[Remove(FRAMES)], &["rail: frames.npy is missing", CONTENTS]),
    ("frames a folder", &[Folder(FRAMES)], &[FRAMES, "is not a file"]),
    ("frames cut short", &[Cut(FRAMES, 128 + 1000)], &[FRAMES, "is truncated: 1000 bytes", "440640 bytes"]),
    ("frames cut in the header", &[Cut(FRAMES, 50)], &[FRAMES, "header is truncated"]),
    (
        "three dimensions",
        &[Array(FRAMES, "<u2", "(510, 18, 24)", 102 * SET_BYTES)],
        &[FRAMES, "its shape is (510, 18, 24)", "[set, frame, row, column]"],
    ),
    (
        "another number of frames",
        &[Array(FRAMES, "<u2", "(102, 4, 18, 24)", 102 * 4 * 18 * 24 * 2)],
        &[FRAMES, "4 frames a set", "5, as recording.toml"],
    ),
    (
        "another sensor",
        &[Array(FRAMES, "<u2", "(102, 5, 24, 18)", 102 * SET_BYTES)],
        &[FRAMES, "18 x 24 pixels", "sensor.width = 24, sensor.height = 18"],
    ),
    (
        "floating point",
        &[Array(FRAMES, "<f4", "(102, 5, 18, 24)", 102 * SET_BYTES * 2)],
        &[FRAMES, "type <f4", "<u2 or <u4"],
    ),
    (
        "code beyond the ADC",
        &[Replace("camera.toml", "adc_bits = 12", "adc_bits = 8")],
        &[FRAMES, "code", "0 to 255", "sensor.adc_bits = 8", "camera.toml"],
    ),
    ("no sets", &[Remove(SETS)], &["rail: sets.csv is missing", CONTENTS]),
    (
        "too few rows",
        &[Array(FRAMES, "<u2", "(103, 5, 18, 24)", 103 * SET_BYTES)],
        &[SETS, "102 rows", "103 rows", "frames.npy"],
    ),
    (
        "position NaN",
        &[
            Write(SETS, b"set,time_s,position_m,velocity_m_s,phase_offset_rad\n0,0,nan,0,0\n"),
            Array(FRAMES, "<u2", "(1, 5, 18, 24)", SET_BYTES),
        ],
        &[SETS, "line 2", "position_m = \"nan\"", "a number from"],
    ),
    (
        "frequency NaN",
        &[Replace(TOML, "30000000.0", "nan")],
        &[TOML, "modulation.frequency_hz = nan", "1e4 to 1e10 Hz"],
    ),
    (
        "format unknown",
        &[Replace(TOML, "recording/1", "recording/2")],
        &[TOML, "vuris-recording/2", "\"vuris-recording/1\""],
    ),
    (
        "kind unknown",
        &[Replace(TOML, "\"rail\"", "\"road\"")],
        &[TOML, "kind = \"road\"", "phase_sweep, rail, motion, dark"],
    ),
    (
        "mask of another size",
        &[Array("rail/mask.npy", "|u1", "(24, 18)", 432)],
        &["rail/mask.npy", "[24, 18]", "[18, 24]"],
    ),
    (
        "steps of no scheme",
        &[Replace(TOML, "2.094395102393", "1.0")],
        &[TOML, "no scheme has its phase steps", "1.000000", "four_frame", "wdft"],
    ),
    (
        "too few pixels",
        &[
            Remove("camera.toml"),
            Remove("rail/mask.npy"),
            Array(FRAMES, "<u2", "(1, 5, 2, 3)", 60),
            Write(SETS, b"set,time_s,position_m,velocity_m_s,phase_offset_rad\n0,0,1,0,0\n"),
        ],
        &["vuris adapted to rail", "sensor.width * sensor.height = 6", "8 pixels or more"],
    ),
];

/// Runs `process` and `verify` on the recording `rail` in `home`, which both must refuse.
fn recording_faults(home: &Path, extra: &[&str], parts: &[&str]) -> Vec<String> {
    let process = [&["process", "rail", "--spec", "vuris", "--out", "results"], extra].concat();
    let mut verify =
        vec![[&["verify", "--recording", "rail", "--spec", "vuris", "--work", "work"], extra].concat()];
    verify.push([&verify[0][..], &["--simulator", "all", "--sets", "1"]].concat());
    [process].iter().chain(&verify).filter_map(|arguments| refusal_faults(home, arguments, parts)).collect()
}

#[test]
fn every_bad_recording_is_refused_before_anything_is_built_or_written() {
    let good = tempfile::tempdir().unwrap();
    succeed(
        good.path(),
        &["process", &format!("{CAMPAIGN}/wdft-rail"), "--spec", "vuris", "--out", "results"],
    );
    let mut faults = Vec::new();
    for (name, changes, parts) in RECORDINGS {
        let home = tempfile::tempdir_in(good.path()).unwrap();
        copy_recording("wdft-rail", &home.path().join("rail"));
        changes.iter().for_each(|change| change.apply(home.path()));
        fs::create_dir(home.path().join("results")).unwrap();
        for entry in fs::read_dir(good.path().join("results")).unwrap() {
            let entry = entry.unwrap();
            fs::copy(entry.path(), home.path().join("results").join(entry.file_name())).unwrap();
        }
        for scheme in ["specified", "auto"] {
            let found = recording_faults(home.path(), &["--scheme", scheme], parts);
            faults.extend(found.into_iter().map(|fault| format!("{name}: {fault}")));
        }
    }
    assert_none(faults);
}

#[test]
fn a_campaign_with_one_bad_recording_is_refused_as_a_whole() {
    let home = tempfile::tempdir().unwrap();
    copy_recording("wdft-rail", &home.path().join("a/rail"));
    copy_recording("wdft-rail", &home.path().join("a/second"));
    Cut("a/second/frames.npy", 500).apply(home.path());
    for command in [["process", "a", "--out", "results"], ["verify", "--recording", "a", "--work=work"]] {
        let arguments = [&command[..], &["--spec", "vuris"]].concat();
        assert_none(Vec::from_iter(refusal_faults(
            home.path(),
            &arguments,
            &["a/second/frames.npy", "is truncated"],
        )));
    }
}

#[test]
fn a_recording_of_another_scheme_is_refused_with_both_names_and_the_way_out() {
    let home = tempfile::tempdir().unwrap();
    copy_recording("four-rail", &home.path().join("rail"));
    let parts =
        [TOML, "four_frame", "the specified scheme wdft", "2.094395", "`--scheme auto` picks four_frame"];
    assert_none(recording_faults(home.path(), &[], &parts));
}
