//! `vuris import`: other programs' pictures, arrays and dumps come out as recordings, code by code; what is wrong or not
//! known is refused, and then nothing is written.

mod recorded;

use assert_cmd::Command;
use image::{GrayImage, ImageBuffer, Luma, Rgb, RgbImage};
use recorded::at_hand;
use std::f64::consts::TAU;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use tiff::encoder::{TiffEncoder, colortype};
use vuris::recording::matching::{SchemeChoice, pipeline_for};
use vuris::recording::{Kind, Recording};
use vuris::reference::reference_images;
use vuris::spec::Pipeline;

const WIDTH: usize = 5;
const HEIGHT: usize = 3;
/// What every import needs, for sets of four frames.
const FOUR: &[&str] =
    &["--steps", "4", "--step-deg", "90", "--frequency-hz", "30e6", "--frame-period-s", "0.025"];

/// The code that stands at a place of the frames that are written here: no two frames, rows or columns are alike.
fn code(bits: u32, frame: usize, row: usize, column: usize) -> u32 {
    match bits {
        8 => (frame * 19 + row * 7 + column * 2 + 1) as u32,
        _ => (frame * 4801 + row * 259 + column * 17 + 300) as u32,
    }
}

fn codes_of(bits: u32, frames: impl IntoIterator<Item = usize>) -> Vec<u32> {
    let pixels =
        |frame| (0..HEIGHT * WIDTH).map(move |pixel| code(bits, frame, pixel / WIDTH, pixel % WIDTH));
    frames.into_iter().flat_map(pixels).collect()
}

fn picture8(frame: usize) -> GrayImage {
    ImageBuffer::from_fn(WIDTH as u32, HEIGHT as u32, |x, y| {
        Luma([code(8, frame, y as usize, x as usize) as u8])
    })
}

fn picture16(frame: usize) -> ImageBuffer<Luma<u16>, Vec<u16>> {
    ImageBuffer::from_fn(WIDTH as u32, HEIGHT as u32, |x, y| {
        Luma([code(16, frame, y as usize, x as usize) as u16])
    })
}

/// A TIFF with a page of 16 bits for each of `frames`.
fn pages(path: &Path, frames: &[usize]) {
    let mut encoder = TiffEncoder::new(File::create(path).unwrap()).unwrap();
    for &frame in frames {
        let codes: Vec<u16> = codes_of(16, [frame]).into_iter().map(|code| code as u16).collect();
        encoder.write_image::<colortype::Gray16>(WIDTH as u32, HEIGHT as u32, &codes).unwrap();
    }
}

/// An array as the format's description has it (numpy, NEP 1), written without any library.
fn npy(path: &Path, descr: &str, shape: &str, data: &[u8]) {
    let mut header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let length = (header.len() as u16).to_le_bytes();
    fs::write(path, [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat()).unwrap();
}

struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Standard output, or standard error where the command ends with 2.
    fn vuris(&self, arguments: &[&str]) -> Result<String, String> {
        let output =
            Command::cargo_bin("vuris").unwrap().current_dir(self.0.path()).args(arguments).output().unwrap();
        match output.status.code() {
            Some(0) => Ok(String::from_utf8(output.stdout).unwrap()),
            Some(2) => Err(String::from_utf8(output.stderr).unwrap()),
            other => panic!("{arguments:?} ends with {other:?}: {}", String::from_utf8_lossy(&output.stderr)),
        }
    }

    /// Imports, and reads the recording `out` back.
    fn import(&self, kind: &str, arguments: &[&str]) -> Recording {
        let all = [&["import", kind], arguments, &["--out", "out"], FOUR].concat();
        self.vuris(&all).unwrap_or_else(|error| panic!("{arguments:?}: {error}"));
        Recording::open(&self.path("out")).unwrap()
    }

    /// The refusal of an import, after which there is nothing that was not there before.
    fn refusal(&self, arguments: &[&str]) -> String {
        let listing = || {
            let names = fs::read_dir(self.0.path()).unwrap().map(|entry| entry.unwrap().file_name());
            let mut names: Vec<_> = names.collect();
            names.sort();
            names
        };
        let before = listing();
        let refusal = self.vuris(arguments).expect_err(&format!("{arguments:?} is taken"));
        assert_eq!(listing(), before, "{arguments:?}");
        refusal
    }

    fn refused(&self, kind: &str, arguments: &[&str], says: &[&str]) {
        let refusal = self.refusal(&[&["import", kind], arguments, &["--out", "out"], FOUR].concat());
        for part in says {
            assert!(refusal.contains(part), "{arguments:?}: no {part:?} in\n{refusal}");
        }
    }
}

// ---------------------------------------------------------------- what is read

#[test]
fn pictures_of_8_and_16_bits_come_out_code_by_code_in_natural_order() {
    for (extension, bits) in [("bmp", 8), ("png", 8), ("png", 16), ("tif", 16)] {
        let home = Home::new();
        // f1 … f12, so that f10 stands before f2 in a plain listing.
        let mut files: Vec<String> = (1..=12).map(|number| format!("f{number}.{extension}")).collect();
        for (frame, file) in files.iter().enumerate() {
            match (extension, bits) {
                ("tif", _) => pages(&home.path(file), &[frame]),
                (_, 8) => picture8(frame).save(home.path(file)).unwrap(),
                _ => picture16(frame).save(home.path(file)).unwrap(),
            }
        }
        files.sort();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        let recording = home.import("stack", &files);
        assert_eq!((recording.geometry().width, recording.geometry().height), (WIDTH, HEIGHT));
        assert_eq!((recording.raw.sets(), recording.raw.frames_per_set()), (3, 4));
        assert_eq!(recording.raw.codes(), codes_of(bits, 0..12), "{extension} {bits}");

        // The same files in the listing's order are another recording: the comparison above can fail.
        fs::rename(home.path("out"), home.path("natural")).unwrap();
        let as_given = home.import("stack", &[&files[..], &["--as-given"]].concat());
        assert_eq!(as_given.raw.codes(), codes_of(bits, [0, 9, 10, 11, 1, 2, 3, 4, 5, 6, 7, 8]));
        assert_ne!(as_given.raw.codes(), recording.raw.codes());
    }
}

#[test]
fn a_tiff_of_many_pages_and_arrays_are_stacks_too_and_may_be_mixed() {
    let home = Home::new();
    pages(&home.path("a1.tif"), &[0, 1, 2, 3, 4]);
    let bytes = codes_of(16, 5..7).iter().flat_map(|&code| (code as u16).to_le_bytes()).collect::<Vec<u8>>();
    npy(&home.path("a2.npy"), "<u2", "(2, 3, 5)", &bytes);
    picture16(7).save(home.path("a10.png")).unwrap();
    let recording = home.import("stack", &["a10.png", "a2.npy", "a1.tif"]);
    assert_eq!(recording.raw.codes(), codes_of(16, 0..8));

    let home = Home::new();
    let bytes: Vec<u8> = codes_of(8, 0..4).iter().map(|&code| code as u8).collect();
    npy(&home.path("frames.npy"), "|u1", "(4, 3, 5)", &bytes);
    assert_eq!(home.import("stack", &["frames.npy"]).raw.codes(), codes_of(8, 0..4));
    npy(&home.path("flat.npy"), "|u1", "(60,)", &bytes);
    fs::remove_dir_all(home.path("out")).unwrap();
    home.refused("stack", &["flat.npy"], &["flat.npy: its shape is (60)", "[frame, row, column]", "reshape"]);
}

/// A code's bytes, the most significant first.
type Bytes = fn(u32) -> Vec<u8>;

#[test]
fn dumps_of_every_type_come_out_code_by_code() {
    let codes = codes_of(16, 0..4);
    // Big-endian by hand, and the other order by reversing each number.
    let bytes = |of: Bytes, little: bool| -> Vec<u8> {
        let number = |&code: &u32| if little { of(code).into_iter().rev().collect() } else { of(code) };
        codes.iter().flat_map(number).collect()
    };
    let types: [(&str, Bytes); 4] = [
        ("u16", |code| vec![(code >> 8) as u8, code as u8]),
        ("i16", |code| vec![(code >> 8) as u8, code as u8]),
        ("u32", |code| vec![0, 0, (code >> 8) as u8, code as u8]),
        ("f32", |code| (code as f32).to_bits().to_be_bytes().to_vec()),
    ];
    for (name, of) in types {
        for order in ["little", "big"] {
            let home = Home::new();
            let file = [b"header!".to_vec(), bytes(of, order == "little")].concat();
            fs::write(home.path("run.bin"), file).unwrap();
            let arguments =
                ["run.bin", "--shape", "4,3,5", "--type", name, "--byte-order", order, "--offset", "7"];
            assert_eq!(home.import("raw", &arguments).raw.codes(), codes, "{name} {order}");
        }
    }
    let home = Home::new();
    fs::write(home.path("run.bin"), bytes(types[0].1, false)).unwrap();
    // The wrong order, and rows for columns, are other recordings: the comparison above can fail.
    let swapped =
        home.import("raw", &["run.bin", "--shape", "4,3,5", "--type", "u16", "--byte-order", "little"]);
    assert_eq!(swapped.raw.codes()[0], 300_u32.swap_bytes() >> 16);
    assert_ne!(swapped.raw.codes(), codes);
    fs::remove_dir_all(home.path("out")).unwrap();
    let turned = home.import("raw", &["run.bin", "--shape", "4,5,3", "--type", "u16", "--byte-order", "big"]);
    assert_ne!(turned.raw.frame(0, 0)[5..], codes[10..15]);
    assert_eq!((turned.geometry().width, turned.geometry().height), (3, 5));
}

#[test]
fn colour_is_refused_unless_it_is_grey_or_a_channel_is_chosen() {
    let home = Home::new();
    for frame in 0..4 {
        let grey = |x: u32, y: u32| code(8, frame, y as usize, x as usize) as u8;
        let alike = RgbImage::from_fn(5, 3, |x, y| Rgb([grey(x, y); 3]));
        alike.save(home.path(&format!("grey{frame}.bmp"))).unwrap();
        let colour = RgbImage::from_fn(5, 3, |x, y| Rgb([200, grey(x, y), 7]));
        colour.save(home.path(&format!("colour{frame}.png"))).unwrap();
    }
    let files = |name: &str, extension: &str| -> Vec<String> {
        (0..4).map(|frame| format!("{name}{frame}.{extension}")).collect()
    };
    let (grey, colour) = (files("grey", "bmp"), files("colour", "png"));
    let [grey, colour] = [&grey, &colour].map(|files| files.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(home.import("stack", &grey).raw.codes(), codes_of(8, 0..4));
    fs::remove_dir_all(home.path("out")).unwrap();
    home.refused(
        "stack",
        &colour,
        &["colour0.png: is in colour: [200, 1, 7] at row 0, column 0", "--channel"],
    );
    let green = home.import("stack", &[&colour[..], &["--channel", "green"]].concat());
    assert_eq!(green.raw.codes(), codes_of(8, 0..4));
    fs::remove_dir_all(home.path("out")).unwrap();
    let red = home.import("stack", &[&colour[..], &["--channel", "red"]].concat());
    assert!(red.raw.codes().iter().all(|&code| code == 200));
}

// ---------------------------------------------------------------- what is written

#[test]
fn sets_times_and_positions_are_what_was_said() {
    let home = Home::new();
    pages(&home.path("stack.tif"), &[0, 1, 2, 3, 4, 5, 6, 7]);
    let recording = home.import("stack", &["stack.tif"]);
    assert_eq!(
        (recording.kind, recording.frequency_hz, recording.frame_period_s),
        (Kind::Other, 30e6, 0.025)
    );
    for (n, step_rad) in recording.steps_rad.iter().enumerate() {
        assert!((step_rad - n as f64 * TAU / 4.0).abs() < 1e-15);
    }
    for (set, time_s) in [(0, 0.0), (1, 0.1)] {
        let row = &recording.sets[set];
        assert_eq!((row.time_s, row.position_m), (time_s, None));
        assert_eq!((row.velocity_m_s, row.phase_offset_rad), (0.0, 0.0));
    }
    assert_eq!((&recording.mask, &recording.frame_times_s, &recording.camera), (&None, &None, &None));

    fs::remove_dir_all(home.path("out")).unwrap();
    fs::write(home.path("times.txt"), "10\n10.5\n11\n12\n20\n20.25\n20.5\n\n20.75\n").unwrap();
    let options =
        "--frame-times times.txt --position-m 1.5,2.5 --velocity-m-s -0.25 --offset-deg 0,90 --kind rail";
    let arguments = [vec!["stack.tif"], options.split(' ').collect()].concat();
    let recording = home.import("stack", &arguments);
    assert_eq!(recording.frame_times_s.as_deref(), Some(&[0.0, 0.5, 1.0, 2.0, 10.0, 10.25, 10.5, 10.75][..]));
    let rows = &recording.sets;
    assert_eq!([rows[0].time_s, rows[1].time_s], [0.0, 10.0]);
    assert_eq!([rows[0].position_m, rows[1].position_m], [Some(1.5), Some(2.5)]);
    assert_eq!([rows[0].velocity_m_s, rows[1].velocity_m_s], [-0.25; 2]);
    assert_eq!([rows[0].phase_offset_rad, rows[1].phase_offset_rad], [0.0, TAU / 4.0]);
    assert_eq!(recording.kind, Kind::Rail);
    fs::remove_dir_all(home.path("out")).unwrap();
    home.refused("stack", &["stack.tif", "--frame-times", "stack.tif"], &["stack.tif: cannot read"]);
}

/// The period that is not said is the mean of what was recorded within sets, not of the pauses between them.
#[test]
fn steps_may_differ_and_the_period_may_come_from_the_times() {
    let home = Home::new();
    pages(&home.path("stack.tif"), &[0, 1, 2, 3, 4, 5]);
    fs::write(home.path("times.txt"), "0\n1\n3\n100\n101\n102\n").unwrap();
    let options = "import stack stack.tif --steps 3 --step-deg 0,100,-360/3 --frequency-hz 80e6 \
                   --frame-times times.txt --out out";
    home.vuris(&options.split_whitespace().collect::<Vec<_>>()).unwrap();
    let recording = Recording::open(&home.path("out")).unwrap();
    assert_eq!(recording.frame_period_s, 5.0 / 4.0);
    let expected = [0.0, TAU * 100.0 / 360.0, -TAU / 3.0];
    assert!(recording.steps_rad.iter().zip(expected).all(|(step, expected)| (step - expected).abs() < 1e-15));
}

#[test]
fn several_recordings_are_a_campaign_with_one_camera() {
    let home = Home::new();
    pages(&home.path("stack.tif"), &[0, 1, 2, 3, 4, 5, 6, 7]);
    let camera = "--adc-bits 16 --pedestal-dn 64 --gain-e-per-dn 1.5 --read-noise-e 20 --focal-length-px 40";
    let options = format!(
        "import stack stack.tif --steps 4 --step-deg 90 --frequency-hz 30e6,40e6 --frame-period-s 0.01 \
         --recordings near,far {camera} --position-m 1,2 --out campaign"
    );
    home.vuris(&options.split_whitespace().collect::<Vec<_>>()).unwrap();
    for (name, frames, frequency_hz, position_m) in [("near", 0..4, 30e6, 1.0), ("far", 4..8, 40e6, 2.0)] {
        let recording = Recording::open(&home.path("campaign").join(name)).unwrap();
        assert_eq!(recording.raw.codes(), codes_of(16, frames));
        assert_eq!((recording.name.as_str(), recording.frequency_hz), (name, frequency_hz));
        assert_eq!((recording.sets[0].time_s, recording.sets[0].position_m), (0.0, Some(position_m)));
        let camera = recording.camera.unwrap();
        assert_eq!((camera.geometry.width, camera.geometry.height), (WIDTH, HEIGHT));
        assert_eq!((camera.adc_bits, camera.pedestal_dn, camera.gain_e_per_dn), (16, 64.0, 1.5));
        assert_eq!((camera.read_noise_e, camera.focal_length_px), (20.0, 40.0));
        assert_eq!(camera.correlation_amplitude, [1.0]);
    }
    // One recording has its camera in its own folder, a campaign is named by numbers where names are not given, and
    // another program's description of the camera is copied.
    let file = home.path("campaign/camera.toml");
    let single = home.import("stack", &["stack.tif", "--camera", file.to_str().unwrap()]);
    assert_eq!(single.camera.unwrap().to_toml(), fs::read_to_string(&file).unwrap());
    assert!(home.path("out/camera.toml").exists());
    let two = [&["import", "stack", "stack.tif", "--recordings", "2", "--out", "two"], FOUR].concat();
    home.vuris(&two).unwrap();
    let mut names: Vec<_> =
        fs::read_dir(home.path("two")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["recording-1", "recording-2"]);
    // A recording that is added to a campaign has to fit its camera.
    let wide = [&["import", "raw", "--shape", "4,2,2", "--type", "u8", "--byte-order", "big"], FOUR].concat();
    fs::write(home.path("small.bin"), [1; 16]).unwrap();
    let refusal = home.refusal(&[&wide[..], &["small.bin", "--out", "campaign/third"]].concat());
    assert!(refusal.contains("its frames are 2 x 2 pixels"), "{refusal}");
}

#[test]
fn levels_are_scaled_lifted_and_clipped_only_as_said() {
    let home = Home::new();
    let dump = |name: &str, numbers: [i16; 4]| {
        fs::write(home.path(name), numbers.map(i16::to_be_bytes).concat()).unwrap();
    };
    let import = |options: &str| {
        let _ = fs::remove_dir_all(home.path("out"));
        let layout = "--shape 4,1,1 --type i16 --byte-order big";
        let all = format!("run.bin {layout} {options}");
        home.import("raw", &all.split_whitespace().collect::<Vec<_>>()).raw.codes().to_vec()
    };
    dump("run.bin", [16, 32, 25_600, 25_616]);
    assert_eq!(import(""), [16, 32, 25_600, 25_616]);
    assert_eq!(import("--scale 0.0625 --adc-bits 12"), [1, 2, 1600, 1601]);
    assert_eq!(import("--scale 0.0625 --adc-bits 12 --saturation-code 1600"), [1, 2, 4095, 4095]);
    assert_eq!(import("--scale 0.1"), [2, 3, 2560, 2562]);
    dump("run.bin", [-5, 0, 5, 10]);
    assert_eq!(import("--add 5"), [0, 5, 10, 15]);
}

/// The convention of the format: frame n is B + A cos(n·δ − φ), with φ = 4π f d / c (Drayton 2012).
#[test]
fn an_imported_stack_gives_the_distance_that_it_was_made_of() {
    let home = Home::new();
    let range_m = |pixel: usize| 0.4 + 0.25 * pixel as f64;
    let mut bytes = Vec::new();
    for frame in 0..4 {
        for pixel in 0..HEIGHT * WIDTH {
            let phase_rad = 2.0 * TAU * 30e6 * range_m(pixel) / 299_792_458.0;
            let number = 30_000.0 + 25_000.0 * (TAU / 4.0 * f64::from(frame) - phase_rad).cos();
            bytes.extend((number.round() as u16).to_le_bytes());
        }
    }
    npy(&home.path("frames.npy"), "<u2", "(4, 3, 5)", &bytes);
    let ranges_m = |recording: &Recording| {
        let base = Pipeline::named("vuris").unwrap();
        let (pipeline, _) = pipeline_for(recording, &base, SchemeChoice::Auto).unwrap();
        reference_images(&pipeline, &recording.raw).unwrap().range_m
    };
    let worst_m = |recording: &Recording| {
        let errors = ranges_m(recording).into_iter().enumerate().map(|(pixel, m)| (m - range_m(pixel)).abs());
        errors.fold(0.0, f64::max)
    };
    assert!(worst_m(&home.import("stack", &["frames.npy"])) < 1e-4);
    // Steps the other way round are not that.
    let backwards =
        "import stack frames.npy --steps 4 --step-deg -90 --frequency-hz 30e6 --frame-period-s 1 --out back";
    home.vuris(&backwards.split(' ').collect::<Vec<_>>()).unwrap();
    let back = Recording::open(&home.path("back")).unwrap();
    assert_eq!(back.steps_rad[1], -TAU / 4.0);
    assert!(worst_m(&back) > 0.1);
}

// ---------------------------------------------------------------- what is refused

#[test]
fn files_that_do_not_fit_are_refused_by_name() {
    let home = Home::new();
    for frame in 0..4 {
        picture8(frame).save(home.path(&format!("f{frame}.png"))).unwrap();
        picture8(frame).save(home.path(&format!("f{frame}.bmp"))).unwrap();
        pages(&home.path(&format!("f{frame}.tif")), &[frame]);
    }
    GrayImage::new(4, 3).save(home.path("odd.png")).unwrap();
    let four = ["f0.png", "f1.png", "f2.png", "f3.png"];
    let with = |other: &'static str| [&four[..3], &[other]].concat();
    home.refused("stack", &with("odd.png"), &["odd.png: has 4 x 3 pixels", "5 x 3 pixels, as f0.png has"]);
    home.refused("stack", &with("none.png"), &["none.png: cannot read"]);
    home.refused(
        "stack",
        &four[..3],
        &["3 frames in 3 files, from f0.png to f2.png", "--steps 4", "1 missing"],
    );
    let five = [&four[..], &["f0.bmp"]].concat();
    home.refused("stack", &five, &["5 frames in 5 files, from f0.bmp to f3.png", "leave out 1", "add 3"]);
    home.refused("stack", &[&four[..], &["f2.png"]].concat(), &["f2.png: is named twice"]);
    for other in ["./f2.png", home.path("f2.png").to_str().unwrap()] {
        home.refused("stack", &[&four[..], &[other]].concat(), &["f2.png: is named twice"]);
        home.refused("stack", &[&four[..], &[other, "--as-given"]].concat(), &["f2.png: is named twice"]);
    }
    home.refused("stack", &["."], &[".: is a folder", "name the files"]);
    fs::write(home.path("times"), "1\n1\n1\n1\n").unwrap();
    let times = "--steps 4 --step-deg 90 --frequency-hz 30e6 --frame-times times --out out";
    let equal = [&["import", "stack"], &four[..], &times.split(' ').collect::<Vec<_>>()].concat();
    assert!(home.refusal(&equal).contains("times: tells no time from a frame of a set to the next"));
    home.refused("stack", &[&four[..], &["--recordings", "3"]].concat(), &["--recordings: 3 of 1 sets"]);

    fs::write(home.path("text.png"), "no picture").unwrap();
    fs::write(home.path("empty.png"), "").unwrap();
    for file in ["text.png", "empty.png"] {
        home.refused("stack", &with(file), &[file, "neither BMP, PNG, TIFF nor .npy"]);
    }
    for (whole, cut) in [("f3.png", "cut.png"), ("f3.bmp", "cut.bmp"), ("f3.tif", "cut.tif")] {
        let bytes = fs::read(home.path(whole)).unwrap();
        for kept in [bytes.len() - 20, bytes.len() / 2, 12] {
            fs::write(home.path(cut), &bytes[..kept]).unwrap();
            home.refused("stack", &with(cut), &[cut, "cannot be decoded"]);
        }
    }
    // Four bits would be stretched to eight without a word.
    let mut encoder = png::Encoder::new(File::create(home.path("four.png")).unwrap(), 5, 3);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Four);
    encoder.write_header().unwrap().write_image_data(&[0x12; 9]).unwrap();
    home.refused("stack", &with("four.png"), &["four.png: has 4 bits a sample"]);
    let bytes = fs::read(home.path("f3.bmp")).unwrap();
    fs::write(home.path("narrow.bmp"), [&bytes[..28], &[16], &bytes[29..]].concat()).unwrap();
    home.refused(
        "stack",
        &with("narrow.bmp"),
        &["narrow.bmp: has 16 bits a pixel", "expected: 8 bits a sample"],
    );
    // A decoder would turn white at 0 round, and numbers with a sign are no codes.
    let mut encoder = TiffEncoder::new(File::create(home.path("signed.tif")).unwrap()).unwrap();
    encoder.write_image::<colortype::GrayI16>(5, 3, &[1; 15]).unwrap();
    home.refused("stack", &with("signed.tif"), &["signed.tif: page 0 has signed numbers (SampleFormat 2)"]);
    let mut bytes = fs::read(home.path("f3.tif")).unwrap();
    // The entry of tag 262 (PhotometricInterpretation): a short, one of it.
    let entry = bytes.windows(8).position(|part| part == [6, 1, 3, 0, 1, 0, 0, 0]).unwrap();
    assert_eq!(bytes[entry + 8], 1);
    bytes[entry + 8] = 0;
    fs::write(home.path("white.tif"), bytes).unwrap();
    home.refused("stack", &with("white.tif"), &["white.tif: page 0 has white at 0", "expected: black at 0"]);
    // Broken bytes anywhere: read or refused, never a panic (which would end with 101).
    for file in ["f3.png", "f3.bmp", "f3.tif"] {
        let bytes = fs::read(home.path(file)).unwrap();
        for at in (0..bytes.len()).step_by(7) {
            let mut broken = bytes.clone();
            broken[at] ^= 0xff;
            fs::write(home.path("broken"), broken).unwrap();
            let _ = fs::remove_dir_all(home.path("out"));
            let all = [&["import", "stack"], &with("broken")[..], &["--out", "out"], FOUR].concat();
            let _ = home.vuris(&all);
        }
    }
}

#[test]
fn dumps_that_do_not_fit_are_refused() {
    let home = Home::new();
    fs::write(home.path("run.bin"), [0; 130]).unwrap();
    let with = |options: &'static str| options.split(' ').collect::<Vec<_>>();
    let good = "run.bin --type u16 --byte-order big";
    home.refused(
        "raw",
        &[with(good), with("--shape 4,3,5")].concat(),
        &["130 bytes", "120: --shape 4,3,5, 2 a number", "--offset 10"],
    );
    home.refused("raw", &[with(good), with("--shape 5,3,5")].concat(), &["130 bytes", "150"]);
    home.refused("raw", &[with(good), with("--shape 0,3,5")].concat(), &["--shape", "each at least 1"]);
    home.refused("raw", &[with(good), with("--shape 4294967295,65536,65536")].concat(), &["--shape"]);
    home.refused(
        "raw",
        &with("none.bin --type u8 --byte-order big --shape 4,1,1"),
        &["none.bin: cannot read"],
    );
    fs::write(home.path("minus.bin"), [0, 1, 0, 2, 0xff, 0xff, 0, 3]).unwrap();
    home.refused(
        "raw",
        &with("minus.bin --type i16 --byte-order big --shape 4,1,1"),
        &["the number -1 at frame 2, row 0, column 0", "--add"],
    );
    fs::write(home.path("share.bin"), [0.5_f32, 1.0, 0.0, f32::NAN].map(f32::to_le_bytes).concat()).unwrap();
    let share = with("share.bin --type f32 --byte-order little --shape 4,1,1");
    home.refused("raw", &share, &["the number 0.5 at frame 0", "--scale"]);
    home.refused("raw", &[share, with("--scale 100")].concat(), &["the number NaN at frame 3"]);
    fs::write(home.path("high.bin"), [0x0f, 0xff, 0x10, 0x00, 0, 0, 0, 0]).unwrap();
    let high = with("high.bin --type u16 --byte-order big --shape 4,1,1 --adc-bits 12");
    home.refused("raw", &high, &["the number 4096 at frame 1", "codes from 0 to 4095 (--adc-bits 12)"]);
}

#[test]
fn what_is_not_known_is_asked_for_and_never_made_up() {
    let home = Home::new();
    pages(&home.path("s.tif"), &[0, 1, 2, 3]);
    let refused = |options: &str, says: &[&str]| {
        let all = format!("import stack s.tif --steps 4 --step-deg 90 --out out {options}");
        let refusal = home.refusal(&all.split_whitespace().collect::<Vec<_>>());
        says.iter().for_each(|part| assert!(refusal.contains(part), "{options}: no {part:?} in\n{refusal}"));
    };
    refused("--frame-period-s 0.025", &["--frequency-hz: is missing"]);
    refused("--frequency-hz 30e6", &["--frame-period-s: is missing", "--frame-times"]);
    let good = "--frequency-hz 30e6 --frame-period-s 0.025";
    let with = |options: &str, says: &[&str]| refused(&format!("{good} {options}"), says);
    with(
        "--pedestal-dn 64",
        &["given without --adc-bits, --gain-e-per-dn, --read-noise-e, --focal-length-px"],
    );
    with("--adc-bits 25", &["--adc-bits: 25"]);
    with(
        "--adc-bits 12 --pedestal-dn 4095 --gain-e-per-dn 1 --read-noise-e 1 --focal-length-px 40",
        &["--pedestal-dn: 4095", "below the greatest code of 12 bits", "way out: "],
    );
    with("--saturation-code 4000", &["without --adc-bits"]);
    with("--adc-bits 16 --saturation-code 70000", &["from 1 to 65535"]);
    with("--kind sweep", &["--kind: sweep", "phase_sweep"]);
    with("--position-m 1,2", &["--position-m: 2 values", "one for all, or 1"]);
    with("--position-m -1", &["--position-m"]);
    with("--recordings a/b", &["--recordings: a/b"]);
    with("--scale 0", &["--scale"]);
    with("--camera none.toml", &["none.toml: cannot read"]);
    refused("--frequency-hz NaN --frame-period-s 1", &["--frequency-hz: NaN"]);
    refused("--frequency-hz 30e6 --frame-period-s 0", &["--frame-period-s: 0"]);
    for (text, says) in
        [("0\n1\n2\n", "3 times"), ("0\n2\n1\n3\n", "1 s at frame 2"), ("0\nx\n2\n3\n", "line 2")]
    {
        fs::write(home.path("times.txt"), text).unwrap();
        with("--frame-times times.txt", &[says]);
    }
    for (option, says) in
        [("--step-deg 90,180", "2 values"), ("--step-deg 400", "400"), ("--steps 0", "--steps: 0")]
    {
        let all = format!("import stack s.tif {good} --out out --steps 4 --step-deg 90");
        let (name, value) = option.split_once(' ').unwrap();
        let mut all: Vec<&str> = all.split(' ').collect();
        let at = all.iter().position(|argument| *argument == name).unwrap();
        all[at + 1] = value;
        let refusal = home.refusal(&all);
        assert!(refusal.contains(says), "{option}: {refusal}");
    }
}

#[test]
fn nothing_that_is_there_is_overwritten() {
    let home = Home::new();
    pages(&home.path("s.tif"), &[0, 1, 2, 3]);
    for out in ["file", "folder", "s.tif"] {
        match out {
            "file" => fs::write(home.path(out), "mine").unwrap(),
            "folder" => fs::create_dir(home.path(out)).unwrap(),
            _ => {}
        }
        let refusal = home.refusal(&[&["import", "stack", "s.tif", "--out", out], FOUR].concat());
        assert!(refusal.contains("is there already"), "{refusal}");
    }
    assert_eq!(fs::read(home.path("file")).unwrap(), b"mine");
    assert_eq!(fs::read_dir(home.path("folder")).unwrap().count(), 0);
}

#[test]
fn the_help_shows_an_example_and_the_example_works() {
    let home = Home::new();
    for (kind, option) in [("stack", "--channel"), ("raw", "--byte-order")] {
        let help = home.vuris(&["import", kind, "--help"]).unwrap();
        assert!(help.contains(option) && help.contains("Example:"), "{help}");
        let example = help.split("Example:").nth(1).unwrap();
        let example = example.split(&format!("vuris import {kind} ")).nth(1).unwrap();
        let mut arguments = vec!["import", kind];
        arguments.extend(example.split_whitespace().filter(|word| *word != "\\"));
        // What the shell would make of the star.
        let mut files = Vec::new();
        if kind == "stack" {
            fs::create_dir(home.path("scene")).unwrap();
            files.extend((0..24).map(|frame| format!("scene/f{frame}.bmp")));
            files.iter().enumerate().for_each(|(at, file)| picture8(at % 12).save(home.path(file)).unwrap());
        }
        fs::write(home.path("run.bin"), vec![1; 512 + 8 * 240 * 320 * 2]).unwrap();
        let at = arguments.iter().position(|argument| *argument == "scene/*.bmp");
        at.into_iter().for_each(|at| drop(arguments.splice(at..=at, files.iter().map(String::as_str))));
        home.vuris(&arguments).unwrap_or_else(|error| panic!("{arguments:?}: {error}"));
    }
    assert!(home.path("scene-01/frames.npy").exists() && home.path("run/frames.npy").exists());
}

// ---------------------------------------------------------------- another laboratory's pictures

/// Real pictures, where they are at hand: `VURIS_REAL`, or beside the repository. The bytes are compared with what the
/// format's description says of them, without a library: 8 bits behind a table of colours, the last row first.
#[test]
fn real_pictures_of_twelve_steps_are_three_recordings() {
    let Some(real) = at_hand("VURIS_REAL", "real", "cfpe") else { return };
    let file = |step: usize| real.join(format!("01{step:02}h.bmp")).to_str().unwrap().to_owned();
    let pixels = |step: usize| -> Vec<u32> {
        let bytes = fs::read(file(step)).unwrap();
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let (data, width, height) = (number(10), number(18), number(22));
        assert_eq!((width, height, bytes[28], data), (640, 480, 8, 54 + 4 * 256));
        // The table of colours: blue, green, red, 0.
        let grey = |index: u8| {
            let [blue, green, red] = [0, 1, 2].map(|channel| bytes[54 + 4 * usize::from(index) + channel]);
            assert!(blue == green && green == red);
            u32::from(blue)
        };
        let row = |row: usize| bytes[data + (height - 1 - row) * width..][..width].iter().map(|&i| grey(i));
        (0..height).flat_map(row).collect()
    };
    let home = Home::new();
    let files: Vec<String> = (0..36).map(file).collect();
    let mut arguments: Vec<&str> = vec!["import", "stack"];
    arguments.extend(files.iter().map(String::as_str));
    let options =
        "--steps 12 --step-deg 30 --frequency-hz 1e6 --frame-period-s 1 --recordings 3 --out campaign";
    arguments.extend(options.split(' '));
    home.vuris(&arguments).unwrap();
    for period in 0..3 {
        let folder = home.path(&format!("campaign/recording-{}", period + 1));
        let recording = Recording::open(&folder).unwrap();
        assert_eq!((recording.raw.sets(), recording.steps_rad.len()), (1, 12));
        for step in 0..12 {
            let expected = pixels(period * 12 + step);
            assert!(recording.raw.frame(0, step) == expected, "period {period}, step {step}");
            let other = pixels(period * 12 + (step + 1) % 12);
            assert!(recording.raw.frame(0, step) != other, "the comparison cannot fail");
        }
    }
    // The white picture is no thirteenth step.
    let white = file(36);
    arguments.insert(2, &white);
    let refusal = home.refusal(&arguments);
    assert!(refusal.contains("is there already"), "{refusal}");
    fs::rename(home.path("campaign"), home.path("taken")).unwrap();
    let refusal = home.refusal(&arguments);
    assert!(refusal.contains("37 frames in 37 files") && refusal.contains("white picture"), "{refusal}");
}
