//! Every way in which a recording can be wrong is refused, with the file, the value, and what is allowed.

use std::fs;
use std::panic::catch_unwind;
use std::path::Path;
use vuris::frames::{Geometry, RawSets};
use vuris::recording::{Camera, Kind, Recording, SetRow, write_camera, write_recording};

const CAMERA: &str = "[sensor]\nwidth = 3\nheight = 2\nadc_bits = 12\npedestal_dn = 64.0\ngain_e_per_dn = 12.0\n\
                      read_noise_e = 36.0\nfocal_length_px = 4.0\n[correlation]\namplitude = [1.0, 0.5]\n\
                      phase_rad = [0.0, 0.25]\n[physics]\nincluded = []\n";

/// Writes a campaign with one good recording of 2 sets, 4 frames, 2 rows and 3 columns; gives the recording's folder.
fn good(campaign: &Path) -> std::path::PathBuf {
    let folder = campaign.join("bench");
    let geometry = Geometry { width: 3, height: 2 };
    let set =
        |time_s| SetRow { time_s, position_m: Some(1.5), extra: vec!["20.5".into()], ..SetRow::default() };
    let recording = Recording {
        folder: folder.clone(),
        name: "bench".into(),
        kind: Kind::Rail,
        frequency_hz: 30e6,
        steps_rad: (0..4).map(|n| f64::from(n) * 1.25).collect(),
        frame_period_s: 0.025,
        raw: RawSets::new(geometry, 4, (0..48).collect()).unwrap(),
        sets: vec![set(0.0), set(0.1)],
        extra_columns: vec!["temperature_c".into()],
        mask: Some(vec![true; 6]),
        frame_times_s: Some((0..8).map(|n| f64::from(n) * 0.025).collect()),
        camera: None,
    };
    write_camera(&Camera::parse("camera.toml", CAMERA).unwrap(), campaign).unwrap();
    write_recording(&recording, &folder).unwrap();
    folder
}

/// What is done to the good recording. Paths are relative to its folder.
enum Change {
    /// The file is removed.
    Remove(&'static str),
    /// The first text is replaced by the second, which must be there.
    Replace(&'static str, &'static str, &'static str),
    /// The file is written anew.
    Write(&'static str, &'static [u8]),
    /// An array is written anew: type, Fortran order, shape, and how many zero bytes follow.
    Array(&'static str, &'static str, bool, &'static str, usize),
    /// The byte at an offset behind the 128 of an array's header is set.
    Byte(&'static str, usize, u8),
    /// The file is cut to so many bytes.
    Cut(&'static str, u64),
    /// The file gives place to a folder.
    Folder(&'static str),
}
use Change::*;

impl Change {
    fn apply(&self, folder: &Path) {
        match *self {
            Remove(file) => fs::remove_file(folder.join(file)).unwrap(),
            Replace(file, from, to) => {
                let text = fs::read_to_string(folder.join(file)).unwrap();
                assert!(text.contains(from), "{file} has no {from:?}:\n{text}");
                fs::write(folder.join(file), text.replacen(from, to, 1)).unwrap();
            }
            Write(file, bytes) => fs::write(folder.join(file), bytes).unwrap(),
            Array(file, descr, fortran, shape, bytes) => {
                let order = if fortran { "True" } else { "False" };
                let header = format!("{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}");
                let header = format!("{header:<117}\n");
                let start = [b"\x93NUMPY\x01\x00", &(header.len() as u16).to_le_bytes()[..]].concat();
                fs::write(folder.join(file), [&start, header.as_bytes(), &vec![0; bytes]].concat()).unwrap();
            }
            Byte(file, offset, byte) => {
                let mut bytes = fs::read(folder.join(file)).unwrap();
                let data = bytes.iter().position(|&byte| byte == b'\n').unwrap() + 1;
                bytes[data + offset] = byte;
                fs::write(folder.join(file), bytes).unwrap();
            }
            Cut(file, length) => {
                fs::OpenOptions::new().write(true).open(folder.join(file)).unwrap().set_len(length).unwrap();
            }
            Folder(file) => {
                fs::remove_file(folder.join(file)).unwrap();
                fs::create_dir(folder.join(file)).unwrap();
            }
        }
    }
}

const TOML: &str = "recording.toml";
const FRAMES: &str = "frames.npy";
const SETS: &str = "sets.csv";
const MASK: &str = "mask.npy";
const TIMES: &str = "frames.csv";
const CONTENTS: &str = "a folder with recording.toml, frames.npy and sets.csv";
const OF_CAMPAIGN: &str = "../camera.toml";

/// The change, and what the refusal must say: file, field or value, what is allowed.
const CASES: &[(Change, &[&str])] = &[
    // recording.toml
    (Remove(TOML), &["bench", "recording.toml is missing", CONTENTS]),
    (Folder(TOML), &[TOML, "cannot read"]),
    (Write(TOML, b"format = "), &[TOML, "line 1", "a TOML file"]),
    (Write(TOML, b"\xff\xfe"), &[TOML, "cannot read", "UTF-8"]),
    (
        Replace(TOML, "vuris-recording/1", "vuris-recording/9"),
        &[TOML, "vuris-recording/9", "\"vuris-recording/1\""],
    ),
    (Replace(TOML, "format = \"vuris-recording/1\"", ""), &[TOML, "format is missing", "vuris-recording/1"]),
    (Replace(TOML, "\"rail\"", "\"tramway\""), &[TOML, "kind", "tramway", "phase_sweep, rail, motion, dark"]),
    (Replace(TOML, "kind = \"rail\"", "kind = 3"), &[TOML, "kind = 3", "phase_sweep, rail, motion, dark"]),
    (Replace(TOML, "[modulation]", "[demodulation]"), &[TOML, "modulation is missing", "[modulation]"]),
    (
        Replace(TOML, "30000000.0", "\"30 MHz\""),
        &[TOML, "modulation.frequency_hz", "30 MHz", "1e4 to 1e10 Hz"],
    ),
    (Replace(TOML, "30000000.0", "nan"), &[TOML, "modulation.frequency_hz = nan", "1e4 to 1e10 Hz"]),
    (Replace(TOML, "30000000.0", "30.0"), &[TOML, "modulation.frequency_hz = 30.0", "1e4 to 1e10 Hz"]),
    (Replace(TOML, "frames = 4", "frames = 0"), &[TOML, "modulation.frames = 0", "1 to 65536"]),
    (Replace(TOML, "frames = 4", "frames = 4.5"), &[TOML, "modulation.frames = 4.5", "a whole number"]),
    (Replace(TOML, "= 1.25", "= inf"), &[TOML, "modulation.phase_step_rad = inf", "rad"]),
    (Replace(TOML, "phase_step_rad", "phase_step"), &[TOML, "phase_step_rad", "both missing", "one of them"]),
    (
        Replace(TOML, "frames = 4", "frames = 4\nphase_steps_rad = [0.0, 1.0, 2.0, 3.0]"),
        &[TOML, "both given", "one of them"],
    ),
    (
        Replace(TOML, "phase_step_rad = 1.25", "phase_steps_rad = [0.0, 1.0, 2.0]"),
        &[TOML, "phase_steps_rad has 3", "4 finite numbers"],
    ),
    (
        Replace(TOML, "phase_step_rad = 1.25", "phase_steps_rad = [0.0, nan, 2.0, 3.0]"),
        &[TOML, "modulation.phase_steps_rad", "nan", "4 finite numbers"],
    ),
    (Replace(TOML, "frame_period_s = 0.025", ""), &[TOML, "timing.frame_period_s is missing", " s"]),
    (Replace(TOML, "= 0.025", "= -0.025"), &[TOML, "timing.frame_period_s = -0.025", "1e-9 to 1e6 s"]),
    // frames.npy
    (Remove(FRAMES), &["bench", "frames.npy is missing", CONTENTS]),
    (Folder(FRAMES), &[FRAMES, "is not a file", ".npy"]),
    (Write(FRAMES, b""), &[FRAMES, "is not an .npy file", "numpy.save"]),
    (
        Write(FRAMES, b"PK\x03\x04 a zip file, as numpy.savez writes"),
        &[FRAMES, "is not an .npy file", "numpy.save"],
    ),
    (Write(FRAMES, b"\x93NUMPY\x01\x00\xff\xff{"), &[FRAMES, "header is truncated"]),
    (Write(FRAMES, b"\x93NUMPY\x02\x00\xff\xff\xff\xff{"), &[FRAMES, "header is truncated or too long"]),
    (Write(FRAMES, b"\x93NUMPY\x07\x00\x01\x00{"), &[FRAMES, "unknown version", "1 to 3"]),
    (Write(FRAMES, b"\x93NUMPY\x01\x00\x04\x00True"), &[FRAMES, "header cannot be read", ".npy"]),
    (
        Array(FRAMES, "'<u2'", false, "(2, 4, 2)", 32),
        &[FRAMES, "its shape is (2, 4, 2)", "[set, frame, row, column]"],
    ),
    (
        Array(FRAMES, "'<u2'", false, "(0, 4, 2, 3)", 0),
        &[FRAMES, "its shape is (0, 4, 2, 3)", "at least 1 of each"],
    ),
    (Array(FRAMES, "'<u2'", true, "(2, 4, 2, 3)", 96), &[FRAMES, "Fortran order", "C order"]),
    (Array(FRAMES, "'<f4'", false, "(2, 4, 2, 3)", 192), &[FRAMES, "type <f4", "<u2 or <u4"]),
    (Array(FRAMES, "'>u2'", false, "(2, 4, 2, 3)", 96), &[FRAMES, "type >u2", "<u2 or <u4", "astype('<u2')"]),
    (Array(FRAMES, "'<i2'", false, "(2, 4, 2, 3)", 96), &[FRAMES, "type <i2", "<u2 or <u4"]),
    (
        Array(FRAMES, "[('a', '<u2'), ('b', '<u2')]", false, "(2, 4, 2, 3)", 192),
        &[FRAMES, "type [('a'", "<u2 or <u4"],
    ),
    (Array(FRAMES, "'|O'", false, "(2, 4, 2, 3)", 96), &[FRAMES, "type |O", "<u2 or <u4"]),
    (Array(FRAMES, "'<u2'", false, "(2, 5, 2, 3)", 120), &[FRAMES, "5 frames a set", "4, as recording.toml"]),
    (
        Array(FRAMES, "'<u2'", false, "(2, 4, 3, 2)", 96),
        &[FRAMES, "2 x 3 pixels", "sensor.width = 3, sensor.height = 2", "camera.toml"],
    ),
    (
        Array(FRAMES, "'<u2'", false, "(999999999, 4, 2, 3)", 96),
        &[FRAMES, "is truncated: 96 bytes", "47999999952 bytes"],
    ),
    (Array(FRAMES, "'<u2'", false, "(2, 4, 2, 3)", 95), &[FRAMES, "is truncated: 95 bytes", "96 bytes"]),
    (Array(FRAMES, "'<u2'", false, "(2, 4, 2, 3)", 98), &[FRAMES, "has trailing data: 98 bytes", "96 bytes"]),
    (Cut(FRAMES, 60), &[FRAMES, "header is truncated"]),
    (
        Byte(FRAMES, 2 * (24 + 12 + 5) + 1, 0x10),
        &[
            FRAMES,
            "code 4137 at set 1, frame 2, row 1, column 2",
            "0 to 4095",
            "sensor.adc_bits = 12",
            "camera.toml",
        ],
    ),
    // sets.csv
    (Remove(SETS), &["bench", "sets.csv is missing", CONTENTS]),
    (Write(SETS, b""), &[SETS, "line 1", "column set is missing", "position_m"]),
    (Write(SETS, b"set;time_s;position_m\n0;1;2\n"), &[SETS, "set;time_s;position_m", "separated by commas"]),
    (Write(SETS, b"set,\xff\n"), &[SETS, "line 1", "UTF-8"]),
    (Replace(SETS, "velocity_m_s", "speed"), &[SETS, "line 1", "column velocity_m_s is missing", "speed"]),
    (Replace(SETS, "temperature_c", "time_s"), &[SETS, "line 1", "\"time_s\" occurs twice"]),
    (Replace(SETS, "1,0.1,1.5,0,0,20.5\n", ""), &[SETS, "1 rows", "2 rows", "frames.npy"]),
    (Replace(SETS, "20.5\n", "20.5\n1,0.1,1.5,0,0,20.5\n"), &[SETS, "3 rows", "2 rows", "frames.npy"]),
    (
        Replace(SETS, "1,0.1,1.5,0,0,20.5", "1,0.1,1.5,0,0"),
        &[SETS, "line 3", "5 cells", "6, one for each column"],
    ),
    (Replace(SETS, "0.1,1.5", "soon,1.5"), &[SETS, "line 3", "time_s = \"soon\"", "a number from"]),
    (Replace(SETS, "0.1,1.5", ",1.5"), &[SETS, "line 3", "time_s = \"\"", "a number from"]),
    (
        Replace(SETS, "0.1,1.5", "0.1,NaN"),
        &[SETS, "line 3", "position_m = \"NaN\"", "a number from", "or nothing"],
    ),
    (Replace(SETS, "0.1,1.5", "0.1,-1.5"), &[SETS, "line 3", "position_m = \"-1.5\"", "from 0e0 to 1e6 m"]),
    (Replace(SETS, "1.5,0,0", "1.5,inf,0"), &[SETS, "line 2", "velocity_m_s = \"inf\"", "m/s"]),
    (Replace(SETS, "1.5,0,0", "1.5,0,\"0,1\""), &[SETS, "line 2", "phase_offset_rad = \"0,1\"", "rad"]),
    (Replace(SETS, "\n1,", "\n2,"), &[SETS, "line 3", "set = \"2\"", "1: rows stand in the order"]),
    // mask.npy
    (Array(MASK, "'|b1'", false, "(2, 3)", 6), &[MASK, "type |b1", "type |u1", "astype('|u1')"]),
    (Array(MASK, "'|u1'", false, "(3, 2)", 6), &[MASK, "its shape is [3, 2]", "[2, 3]"]),
    (Array(MASK, "'|u1'", false, "(6,)", 6), &[MASK, "its shape is (6)", "[row, column]"]),
    (Byte(MASK, 4, 255), &[MASK, "value 255 at row 1, column 1", "0 or 1"]),
    (Cut(MASK, 130), &[MASK, "is truncated", "6 bytes"]),
    // frames.csv
    (Replace(TIMES, "0,1,0.025\n", ""), &[TIMES, "7 rows", "8 rows"]),
    (
        Replace(TIMES, "0,1,0.025\n0,2,0.05\n", "0,2,0.05\n0,1,0.025\n"),
        &[TIMES, "line 3", "frame = \"2\"", "1: rows stand"],
    ),
    (
        Replace(TIMES, "0,2,0.05", "0,2,0.01"),
        &[TIMES, "line 4", "time_s = \"0.01\"", "not before the previous frame"],
    ),
    // camera.toml
    (Folder(OF_CAMPAIGN), &["camera.toml", "cannot read"]),
    (Write("camera.toml", b"width = 3"), &["bench", "camera.toml", "sensor is missing", "[sensor]"]),
    (Replace(OF_CAMPAIGN, "width = 3", "width = -3"), &["camera.toml", "sensor.width = -3", "1 to 65536"]),
    (
        Replace(OF_CAMPAIGN, "adc_bits = 12", "adc_bits = 25"),
        &["camera.toml", "sensor.adc_bits = 25", "8 to 24"],
    ),
    (
        Replace(OF_CAMPAIGN, "= 4.0", "= 0.0"),
        &["camera.toml", "sensor.focal_length_px = 0.0", "1e-3 to 1e9 pixels"],
    ),
    (Replace(OF_CAMPAIGN, "[1.0, 0.5]", "[1.0]"), &["camera.toml", "amplitude has 1", "one of each"]),
    (
        Replace(OF_CAMPAIGN, "[1.0, 0.5]", "[0.5, 1.0]"),
        &["camera.toml", "correlation.amplitude", "1.0 as the first"],
    ),
    (
        Replace(OF_CAMPAIGN, "[0.0, 0.25]", "[0.1, 0.25]"),
        &["camera.toml", "correlation.phase_rad", "0.0 as the first"],
    ),
    (
        Replace(OF_CAMPAIGN, "[0.0, 0.25]", "\"none\""),
        &["camera.toml", "correlation.phase_rad", "finite numbers"],
    ),
    (
        Replace(OF_CAMPAIGN, "included = []", "included = [1]"),
        &["camera.toml", "physics.included = [1]", "strings"],
    ),
    (Replace(OF_CAMPAIGN, "included = []", ""), &["camera.toml", "physics.included is missing", "strings"]),
];

#[test]
fn every_bad_recording_is_refused_with_file_value_and_what_is_allowed() {
    let mut failures = Vec::new();
    for (number, (change, parts)) in CASES.iter().enumerate() {
        let campaign = tempfile::tempdir().unwrap();
        let folder = good(campaign.path());
        Recording::open(&folder).unwrap();
        change.apply(&folder);
        match catch_unwind(|| Recording::open(&folder)) {
            Err(_) => failures.push(format!("case {number} {parts:?}: panics")),
            Ok(Ok(_)) => failures.push(format!("case {number} {parts:?}: is accepted")),
            Ok(Err(problem)) => {
                let text = problem.to_string();
                let missing: Vec<_> = parts.iter().filter(|part| !text.contains(**part)).collect();
                if !missing.is_empty() {
                    failures.push(format!("case {number}: without {missing:?}:\n{text}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{} of {}:\n{}", failures.len(), CASES.len(), failures.join("\n"));
}

#[test]
fn without_a_camera_codes_beyond_twenty_four_bits_are_refused() {
    let campaign = tempfile::tempdir().unwrap();
    let folder = good(campaign.path());
    Remove(OF_CAMPAIGN).apply(&folder);
    assert_eq!(Recording::open(&folder).unwrap().adc_bits(), 8);
    Byte(FRAMES, 1, 0x02).apply(&folder);
    assert_eq!(Recording::open(&folder).unwrap().adc_bits(), 10);
    Array(FRAMES, "'<u4'", false, "(2, 4, 2, 3)", 192).apply(&folder);
    assert_eq!(Recording::open(&folder).unwrap().adc_bits(), 8);
    Byte(FRAMES, 4 * 7 + 2, 1).apply(&folder);
    assert_eq!(Recording::open(&folder).unwrap().adc_bits(), 17);
    Byte(FRAMES, 4 * 7 + 3, 1).apply(&folder);
    let problem = Recording::open(&folder).unwrap_err().to_string();
    for part in [FRAMES, "code 16842752 at set 0, frame 1, row 0, column 1", "0 to 16777215"] {
        assert!(problem.contains(part), "{problem}");
    }
}

#[test]
fn what_other_programs_write_is_tolerated() {
    let campaign = tempfile::tempdir().unwrap();
    let folder = good(campaign.path());
    Replace(TOML, "[modulation]", "operator = \"A. Person\"\n[modulation]\nlaser = 3").apply(&folder);
    Replace(OF_CAMPAIGN, "[sensor]", "[sensor]\nname = \"PMD19K-2\"").apply(&folder);
    Replace(TOML, "30000000.0", "30_000_000").apply(&folder);
    // A byte order mark, spaces, Windows' line ends, and columns in another order, as spreadsheets write.
    let sets = "\u{feff}set, position_m, time_s, note, velocity_m_s, phase_offset_rad\r\n\
                0, , 0,\"warm, dry\", 0, 0\r\n1, 1.5, 1e-1, , 0, 0.5\r\n";
    fs::write(folder.join(SETS), sets).unwrap();
    let recording = Recording::open(&folder).unwrap();
    assert_eq!(recording.frequency_hz, 30e6);
    assert_eq!(recording.extra_columns, ["note"]);
    assert_eq!((recording.sets[0].position_m, recording.sets[0].extra[0].as_str()), (None, "warm, dry"));
    assert_eq!((recording.sets[1].time_s, recording.sets[1].phase_offset_rad), (0.1, 0.5));
    assert_eq!(recording.range_m(0, 0, 0), None);
}

#[test]
fn a_folder_that_is_no_recording_says_what_is_one() {
    let campaign = tempfile::tempdir().unwrap();
    good(campaign.path());
    let refusal = |folder: &Path| Recording::open(folder).unwrap_err().to_string();
    assert!(refusal(campaign.path()).contains("name one of its recordings: bench"));
    assert!(refusal(&campaign.path().join("absent")).contains("cannot open"));
    assert!(refusal(&campaign.path().join("camera.toml")).contains("is not a folder"));
}
