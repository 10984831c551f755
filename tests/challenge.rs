//! Blind challenges: the second generator against the first, seals, and the way from making to a score.

use assert_cmd::Command;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use vuris::bench::{Course, Simulation, chain, injection, sensor};
use vuris::challenge::{
    Answer, Asserted, CaseKind, Estimate, HeldOut, Hidden, Label, LabelFile, Located, Outcome, Simpler,
    Truth, drawn, judge, judge_names, opened, scored, sealed, summary, table, truths,
};
use vuris::frames::Geometry;
use vuris::physics::{Active, Pixels, effects};
use vuris::recording::{Kind, SetRow};
use vuris::time_domain::{
    Flaw, Hook, Known, Movie, Programme, Pulse, Ruler, Scene, Sensor, Waveform, World, camera, flaws, movie,
    recordings,
};

// ---------------------------------------------------------------- two generators, one camera

/// A small world with every kind of recording, in which the encoder is exact.
fn world() -> World {
    let geometry = Geometry { width: 8, height: 7 };
    let sensor = Sensor {
        adc_bits: 12,
        pedestal_dn: 64.0,
        gain_e_per_dn: 12.0,
        read_noise_e: 30.0,
        focal_length_px: 11.0,
    };
    let pulse = Pulse { duty: 0.47, rise: 0.12, fall: 0.2, pole: 0.07, floor: 0.0 };
    let gate = Pulse { duty: 0.5, floor: 0.1, ..pulse };
    let programme = Programme {
        schemes: [true, true],
        offsets: 7,
        positions: 6,
        runs: 1,
        dark: 2,
        harmonics: 2,
        period_s: 0.025,
    };
    let mut takes = programme.takes(1);
    for row in takes.iter_mut().flat_map(|take| &mut take.rows) {
        row.reading_m = row.position_m;
    }
    World {
        scene: Scene::random(geometry, sensor.focal_length_px, 9000.0, 2400.0, 3),
        sensor,
        frequency_hz: 31e6,
        waveform: Waveform::of(&pulse.samples(), &gate.samples()),
        takes,
    }
}

/// The largest difference, in DN, between the frames of `world` and those of the harmonic-domain simulator, told what
/// `camera.toml` tells of `told`.
fn largest_difference_dn(world: &World, told: &World, known: Known) -> f64 {
    difference_dn(world, told, known, &[], Vec::new())
}

/// The same between frames with `flaws` and a simulator with `effects`.
fn difference_dn(world: &World, told: &World, known: Known, flaws: &[&Flaw], effects: Vec<Active>) -> f64 {
    let described = camera(told, known);
    let pixels = &world.scene.pixels;
    let light = |of: fn(&vuris::time_domain::Pixel) -> f64| -> Vec<f64> {
        pixels.iter().map(|pixel| of(pixel) / world.sensor.gain_e_per_dn).collect()
    };
    let amplitude_1m_dn = light(|pixel| pixel.amplitude_e);
    let target = world.scene.mask();
    let edges = Pixels::edges_of(world.scene.geometry, &target);
    let seen = Pixels {
        geometry: world.scene.geometry,
        obliquity: described.obliquities(),
        background_m: pixels.iter().map(|pixel| world.scene.background_m * pixel.obliquity).collect(),
        phase_rad: pixels.iter().map(|pixel| pixel.delay_rad - world.waveform.crest_rad()).collect(),
        at_frequencies: Vec::new(),
        constant_1m_dn: amplitude_1m_dn.iter().map(|amplitude| amplitude * world.waveform.mean()).collect(),
        amplitude_1m_dn,
        ambient_dn: light(|pixel| pixel.ambient_e).into(),
        full_scale_dn: sensor(&described).full_scale_dn(),
        pedestal_dn: described.pedestal_dn,
        edge_counts: Pixels::edge_counts_of(&edges),
        edges,
        target,
    };
    let chain = chain(&described, Arc::new(seen), effects);
    let sensor = sensor(&described);
    let simulation = Simulation { chain: &chain, sensor: &sensor, noise: false, seed: 1, recording: 0 };
    let mut frames = movie(world, Known::BOTH, flaws, None).into_iter();
    let mut largest: f64 = 0.0;
    for recording in recordings(world, known, &[], 1) {
        let course = Course::of(&recording).unwrap();
        for index in 0..course.count() {
            let expected = simulation.signal(&course, index);
            for (code, expected) in frames.next().unwrap().iter().zip(&expected) {
                largest = largest.max((code - world.sensor.pedestal_dn - expected).abs());
            }
        }
    }
    assert!(frames.next().is_none());
    largest
}

/// Noise is about 3 to 10 DN a pixel. Over a campaign's 10^6 samples it averages to some thousandths of a DN.
#[test]
fn both_generators_agree_on_a_camera_without_flaws() {
    let world = world();
    let difference = largest_difference_dn(&world, &world, Known::BOTH);
    assert!(difference < 0.005, "{difference} DN");
}

/// … and the comparison sees what is not the same: a waveform a little off, a frequency, the falloff, the motion.
#[test]
fn a_camera_that_is_told_wrongly_does_not_agree() {
    let world = world();
    let other = World { waveform: world.waveform.with_wave(3.0, 1e-4, 0.5), ..world.clone() };
    let difference = largest_difference_dn(&world, &other, Known::BOTH);
    assert!(difference > 0.02, "{difference} DN");
    for known in [Known { falloff: false, motion: true }, Known { falloff: true, motion: false }] {
        let difference = largest_difference_dn(&world, &world, known);
        assert!(difference > 5.0, "{known:?}: {difference} DN");
    }
}

// ---------------------------------------------------------------- flaws and their strengths

fn largest(movie: &Movie) -> f64 {
    movie.iter().flatten().fold(0.0, |most, value| most.max(value.abs()))
}

/// Each mechanism changes something, the more the larger; with the size 0 it changes nothing.
#[test]
fn every_mechanism_is_off_at_no_size_and_acts_at_its_usual_one() {
    let world = world();
    let ruler = Ruler::of(&world);
    let (mut inside, mut outside) = (0, 0);
    for mechanism in flaws::all() {
        let count = if mechanism.is_outside() { &mut outside } else { &mut inside };
        *count += 1;
        if matches!(mechanism.hook, Hook::Unknown) {
            let known = Known {
                falloff: mechanism.name != "inverse_square_falloff",
                motion: mechanism.name != "axial_motion",
            };
            assert!(ruler.norm(&ruler.change(known, &[])) > 1.0, "{}", mechanism.name);
            continue;
        }
        let change = |flaw: &Flaw, share: f64| ruler.change(Known::BOTH, &[&flaw.sized(share * flaw.size)]);
        let off = largest(&change(&Flaw::drawn(mechanism, 5), 0.0));
        assert!(off < 1e-9, "{}: {off} DN at no size", mechanism.name);
        // Some shape of it shows in these few frames: a well that is large enough does not.
        let full = Flaw::drawn(mechanism, 5).sized(mechanism.most);
        let [some, more] = [0.5, 1.0].map(|share| ruler.norm(&change(&full, share)));
        assert!(some.is_finite() && more > some && more > 1.0, "{}: {some}, {more}", mechanism.name);
    }
    assert!(inside >= 20 && outside >= 6, "{inside} effects of the library, {outside} others");
}

/// What a pixel's own numbers can take up is no strength; what they cannot, is. A thousandth of the amplitude is 0.7 DN here.
#[test]
fn strength_is_beyond_the_pixels_own_numbers_and_grows_with_size() {
    let world = world();
    let ruler = Ruler::of(&world);
    let mut other = world.clone();
    for (number, pixel) in other.scene.pixels.iter_mut().enumerate() {
        pixel.delay_rad += 1e-5 * number as f64;
        pixel.amplitude_e *= 1.001;
        pixel.ambient_e *= 1.01;
        pixel.constant_e += 3.0;
    }
    let mut change = movie(&other, Known::BOTH, &[], None);
    for (value, clean) in change.iter_mut().flatten().zip(ruler.clean().iter().flatten()) {
        *value -= clean;
    }
    assert!(largest(&change) > 0.5);
    assert!(ruler.norm(&change) < 0.01, "{}", ruler.norm(&change));

    let flaw = Flaw::drawn(flaws::named("phase_step_scale").unwrap(), 1);
    for rho in [4.0, 12.0, 40.0] {
        let sized = ruler.sized(&flaw, rho).unwrap();
        let found = ruler.norm(&ruler.change(Known::BOTH, &[&sized]));
        assert!((found / rho - 1.0).abs() < 0.03, "{found} for {rho}");
    }
    let change = |size: f64| ruler.change(Known::BOTH, &[&flaw.sized(size)]);
    let beside_itself = ruler.norm_beside(&change(1e-3), &[&change(2e-3), ruler.clean()]);
    assert!(beside_itself < 0.02 * ruler.norm(&change(1e-3)), "{beside_itself}");
}

/// The noise is what `camera.toml` says: repeats differ by photons and read noise.
#[test]
fn noise_has_the_variance_that_the_camera_tells() {
    let world = world();
    let clean = movie(&world, Known::BOTH, &[], None);
    let noisy = movie(&world, Known::BOTH, &[], Some(4));
    let read_dn = world.sensor.read_noise_e / world.sensor.gain_e_per_dn;
    let (mut sum, mut count) = (0.0, 0.0);
    for (noisy, clean) in noisy.iter().flatten().zip(clean.iter().flatten()) {
        let photons = (clean - world.sensor.pedestal_dn) / world.sensor.gain_e_per_dn;
        sum += (noisy - clean).powi(2) / (photons + read_dn * read_dn + 1.0 / 12.0);
        count += 1.0;
    }
    let chi2: f64 = sum / count;
    assert!((chi2 - 1.0).abs() < 5.0 * (2.0f64 / count).sqrt(), "{chi2} of {count}");
}

/// What a label says of an effect's parameters is what the registry means by them: with these values its frames are the generator's, for
/// several shapes of each flaw.
#[test]
fn told_parameters_give_the_generators_frames() {
    let world = world();
    let mut told = 0;
    for mechanism in flaws::all().filter(|mechanism| !mechanism.is_outside()) {
        for seed in 0..6 {
            let flaw = Flaw::drawn(mechanism, seed);
            let truths = truths(&flaw, &world);
            if truths.is_empty() {
                continue;
            }
            told += usize::from(seed == 0);
            let effect = effects::named(mechanism.name).unwrap();
            for truth in &truths {
                let parameter = effect.parameters.iter().find(|parameter| parameter.name == truth.name);
                assert_eq!(parameter.map(|parameter| parameter.unit), Some(truth.unit.as_str()), "{truth:?}");
            }
            let is_choice = |truth: &Truth| {
                effect.parameters.iter().any(|parameter| parameter.name == truth.name && parameter.is_choice)
            };
            let value = |truth: &Truth, factor: f64| {
                let factor = if is_choice(truth) { 1.0 } else { factor };
                format!("{}={:e}", truth.name, factor * truth.value)
            };
            let difference = |factor: f64| {
                let all: Vec<String> = truths.iter().map(|truth| value(truth, factor)).collect();
                let effect = injection(&format!("{}:{}", mechanism.name, all.join(","))).unwrap();
                let known = Known::without([mechanism.name]);
                difference_dn(&world, &world, known, &[&flaw], vec![effect])
            };
            let (right, larger) = (difference(1.0), difference(1.1));
            assert!(right < 0.006, "{} of seed {seed}: {right} DN", mechanism.name);
            assert!(larger > 0.05, "{} of seed {seed}: {larger} DN a tenth off", mechanism.name);
        }
    }
    assert!(told >= 10, "only {told} effects");
}

// ---------------------------------------------------------------- judging

fn hidden(name: &str) -> Hidden {
    Hidden {
        name: name.to_owned(),
        size: 0.01,
        unit: "1".to_owned(),
        rho: 20.0,
        rho_beside: 10.0,
        parameters: Vec::new(),
    }
}

fn label(effects: &[&str]) -> Label {
    let kind = [CaseKind::Clean, CaseKind::Single, CaseKind::Pair][effects.len()];
    Label {
        case: "001".to_owned(),
        kind,
        effects: effects.iter().map(|name| hidden(name)).collect(),
        or: Vec::new(),
        near: Vec::new(),
        limit: effects.iter().take(1).map(|name| (*name).to_owned()).collect(),
        outside: None,
        lives: Vec::new(),
        rho: 20.0,
    }
}

fn outside(lives: &[&str]) -> Label {
    let lives = lives.iter().map(|&name| name.to_owned()).collect();
    Label { kind: CaseKind::Outside, outside: Some(hidden("row_banding")), lives, ..label(&[]) }
}

/// An answer that names `effects`, each with what it cannot be told from after a bar.
fn answer(verdict: &str, effects: &[&str], place: &str) -> Answer {
    let asserted = |text: &&str| {
        let mut names = text.split('|').map(str::to_owned);
        Asserted {
            name: names.next().unwrap(),
            probability: 0.9,
            also_possible: names.collect(),
            parameters: Vec::new(),
        }
    };
    Answer {
        format: "vuris-verdict/1".to_owned(),
        verdict: verdict.to_owned(),
        probability_of_mismatch: if verdict == "clean" { 0.1 } else { 0.97 },
        located: vec![Located { coordinate: place.to_owned() }],
        effects: effects.iter().map(asserted).collect(),
        held_out: HeldOut { chi2_per_dof_before: 1.2, chi2_per_dof_after: 1.1 },
    }
}

#[test]
fn answers_are_worth_what_the_rules_say() {
    let with_or = Label { or: vec![vec!["b".to_owned()]], near: vec![vec!["n".to_owned()]], ..label(&["a"]) };
    for (label, answer, outcome) in [
        (label(&[]), answer("clean", &[], ""), Outcome::Right),
        (label(&[]), answer("unexplained", &[], "row"), Outcome::Wrong),
        (label(&[]), answer("explained", &["a"], "row"), Outcome::Wrong),
        (label(&["a"]), answer("explained", &["a"], "row"), Outcome::Right),
        (label(&["a"]), answer("explained", &["b|c|a"], "row"), Outcome::Possible),
        (label(&["a"]), answer("explained", &["b|c"], "row"), Outcome::Wrong),
        (label(&["a"]), answer("explained", &["a", "b"], "row"), Outcome::Wrong),
        (label(&["a"]), answer("unexplained", &[], "row"), Outcome::Silent),
        (label(&["a"]), answer("clean", &[], ""), Outcome::Silent),
        (label(&["a", "b"]), answer("explained", &["b", "a"], "row"), Outcome::Right),
        (label(&["a", "b"]), answer("explained", &["b"], "row"), Outcome::Partly),
        (label(&["a", "b"]), answer("explained", &["b", "c|a"], "row"), Outcome::Possible),
        (label(&["a", "b"]), answer("explained", &["c|a", "d|a"], "row"), Outcome::Wrong),
        (label(&["a", "b"]), answer("explained", &["b", "c"], "row"), Outcome::Wrong),
        (label(&["a", "b"]), answer("explained", &["c|a"], "row"), Outcome::Partly),
        (label(&["a", "b"]), answer("explained", &["c|d"], "row"), Outcome::Wrong),
        (with_or.clone(), answer("explained", &["b"], "row"), Outcome::Right),
        (with_or, answer("explained", &["n"], "row"), Outcome::Possible),
        (outside(&["row", "set"]), answer("unexplained", &[], "set"), Outcome::Right),
        (outside(&["row"]), answer("unexplained", &[], "column"), Outcome::Partly),
        (outside(&["row"]), answer("clean", &[], ""), Outcome::Silent),
        (outside(&["row"]), answer("explained", &["a"], "row"), Outcome::Wrong),
        (outside(&["row"]), answer("partly_explained", &["a"], "row"), Outcome::Wrong),
    ] {
        assert_eq!(judge(&label, &answer), outcome, "{label:?} {answer:?}");
    }
}

/// Names alone are judged like an answer that says nothing else: with `near`, without rivals or a place.
#[test]
fn names_alone_are_judged_by_the_same_rules() {
    let near = Label { near: vec![vec!["n".to_owned()]], ..label(&["a"]) };
    for (label, named, outcome) in [
        (label(&[]), &[][..], Outcome::Right),
        (label(&[]), &["a"], Outcome::Wrong),
        (label(&["a"]), &[], Outcome::Silent),
        (label(&["a"]), &["a"], Outcome::Right),
        (near, &["n"], Outcome::Possible),
        (label(&["a", "b"]), &["b"], Outcome::Partly),
        (label(&["a", "b"]), &["b", "a"], Outcome::Right),
        (label(&["a"]), &["a", "b"], Outcome::Wrong),
        (outside(&["row"]), &["a"], Outcome::Wrong),
        (outside(&["row"]), &[], Outcome::Silent),
    ] {
        assert_eq!(judge_names(&label, &names(named)), outcome, "{label:?} {named:?}");
    }
}

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

fn simpler(single: &[&str], sparse: &[&str]) -> Simpler {
    Simpler {
        format: "vuris-simpler/1".to_owned(),
        best_single: names(single),
        sparse_regression: names(sparse),
    }
}

#[test]
fn a_score_adds_up() {
    let mut cases = vec![
        (label(&[]), answer("clean", &[], ""), simpler(&["a"], &[])),
        (label(&[]), answer("unexplained", &[], "row"), simpler(&[], &[])),
        (label(&["a"]), answer("explained", &["a"], "row"), simpler(&["a"], &["b"])),
        (label(&["a"]), answer("explained", &["b|a"], "row"), simpler(&["a"], &["a"])),
        (label(&["a", "b"]), answer("explained", &["a"], "row"), simpler(&["a"], &["a", "b"])),
        (outside(&["row"]), answer("clean", &[], ""), simpler(&["a"], &[])),
    ];
    // The middle of 1.2, 1.2 and 9 is 1.2; this one is no better with its name.
    cases[2].1.held_out = HeldOut { chi2_per_dof_before: 9.0, chi2_per_dof_after: 9.5 };
    let scored = scored(cases);
    let answers = &scored.answers;
    assert_eq!(Outcome::ALL.map(|row| answers.all.of(row.0)), [2, 1, 1, 1, 1]);
    assert_eq!(answers.all.score(), Some((2.0 + 0.5 - 0.25 - 1.0) / 6.0));
    assert_eq!((answers.clean(), &scored.held_out[..]), ((2, 1), &[(9.0, 9.5), (1.2, 1.1), (1.2, 1.1)][..]));
    assert_eq!(answers.kinds[&CaseKind::Clean].score(), Some(0.0));
    // Strengths 10 beside the other: all four with an effect are in the range from 8 to 15.
    assert_eq!(answers.strengths.each_ref().map(|tally| tally.cases()), [0, 4, 0, 0, 0]);
    // The limit has the first effect only: it is right but for the pair. The answer is right of one clean and one with an effect.
    assert_eq!((&scored.limit[..3], &answers.right[..3]), (&[(2, 2), (0, 0), (3, 2)][..], &[1, 0, 1][..]));
    // One name at most: right of a clean one and of two effects, partly of the pair, wrong of the other clean one and outside.
    let [single, sparse] = &scored.simpler;
    assert_eq!(single.all.score(), Some((3.0 - 0.25 - 2.0) / 6.0));
    assert_eq!((single.clean(), &single.right[..3]), ((2, 1), &[1, 0, 2][..]));
    assert_eq!(sparse.all.score(), Some((4.0 - 1.0) / 6.0));
    assert_eq!((sparse.clean(), &sparse.right[..3]), ((2, 0), &[2, 0, 2][..]));
    let json = summary(&scored);
    assert_eq!(json["simpler"]["sparse_regression"]["strengths"][1]["outcomes"]["right"], 2);
    assert_eq!(json["cases"][2]["simpler"]["best_single"][0], "a");
    // Three names with probability 0.9, of which b is false; four mismatches stated, one of them of a clean campaign.
    assert_eq!((scored.names[2].stated, scored.names[2].true_ones), (3, 2));
    assert_eq!((scored.mismatch[3].stated, scored.mismatch[3].true_ones), (4, 3));
    let text = table(&scored);
    for line in [
        "false alarms: 1 of 2 clean campaigns (95 % interval 9.5 to 90.5 %); one by BIC: 1; sparse: 0",
        "answered: explained b (or a), in row",
        "all                        6        2        1        1        1        1   +0.208      +0.125      +0.500",
        "clean                      2        2        1           1           2",
        "better in 2 of 3 campaigns with a name; median chi2 a degree of freedom 1.200 before, 1.100 after",
        "of 1 effects in answers that are right, the generator tells the parameters of 0 exactly",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
}

/// Errors count where the answer is right, the truth is told in the same unit, and the parameter was fitted.
#[test]
fn errors_of_parameters_are_in_their_stated_deviations() {
    let truth = |name: &str, value: f64| Truth { name: name.to_owned(), value, unit: "rad".to_owned() };
    let estimate = |name: &str, value: f64, sigma: f64, unit: &str| Estimate {
        name: name.to_owned(),
        value,
        sigma,
        unit: unit.to_owned(),
    };
    let case = |verdict: &str, named: &[&str]| {
        let mut label = label(&["a"]);
        label.effects[0].parameters = vec![truth("x", 1.0), truth("y", 5.0)];
        let mut answer = answer(verdict, named, "row");
        answer.effects[0].parameters = vec![
            estimate("x (four-rail)", 1.3, 0.1, "rad"),
            estimate("x (four-motion)", 0.9, 0.1, "rad"),
            estimate("y", 5.5, 0.0, "rad"),
            estimate("y", 5.5, 0.1, "DN"),
            estimate("z", 1.0, 0.1, "rad"),
        ];
        (label, answer, simpler(&[], &[]))
    };
    let scored = scored(vec![case("explained", &["a"]), case("explained", &["a", "b"])]);
    let errors = &scored.errors["a"];
    assert_eq!((scored.named, errors.len(), scored.errors.len()), ((1, 1), 2, 1));
    assert!((errors[0] - 3.0).abs() < 1e-9 && (errors[1] + 1.0).abs() < 1e-9, "{errors:?}");
    // The root of (9 + 1) / 2, and one of them within 1.96.
    let text = table(&scored);
    assert!(text.contains("a                                  2     2.24        1\n"), "{text}");
    assert!(
        text.contains("of 1 effects in answers that are right, the generator tells the parameters of 1"),
        "{text}"
    );
}

// ---------------------------------------------------------------- seals

#[test]
fn a_seal_refuses_a_label_that_was_changed() {
    let mut second = label(&["image_lag"]);
    second.case = "002".to_owned();
    let labels = [label(&[]), second];
    let cases = labels.clone().map(|label| (label, String::new()));
    let (file, seals) = sealed(&cases, 7).unwrap();
    assert_eq!(opened("labels.json", &file, &seals).unwrap(), labels);
    // Also from the files' text, and other seeds seal otherwise.
    let text = serde_json::to_string_pretty(&file).unwrap();
    assert_eq!(opened("labels.json", &serde_json::from_str(&text).unwrap(), &seals).unwrap(), labels);
    assert_ne!(sealed(&cases, 8).unwrap().1.cases[0].sha256, seals.cases[0].sha256);
    for (from, to) in [("image_lag", "frame_gain"), ("\"rho\": 20.0", "\"rho\": 21.0")] {
        let changed = text.replace(from, to);
        assert_ne!(changed, text);
        let refusal = opened("labels.json", &serde_json::from_str(&changed).unwrap(), &seals).unwrap_err();
        assert!(refusal.to_string().contains("does not fit its seal"), "{refusal}");
    }
    let mut salted = file.clone();
    salted.cases[1].salt = file.cases[0].salt.clone();
    let mut fewer = file.clone();
    fewer.cases.pop();
    let of_another_seed = LabelFile { seed: 8, ..file.clone() };
    let mut swapped = file;
    swapped.cases.swap(0, 1);
    for (file, what) in [
        (salted, "case 002: the label does not fit"),
        (fewer, "1 labels for 2 seals"),
        (swapped, "case 001"),
        (of_another_seed, "case 001: the salt is not that of seed = 8"),
    ] {
        let refusal = opened("labels.json", &file, &seals).unwrap_err().to_string();
        assert!(refusal.contains(what), "{refusal}");
    }
}

// ---------------------------------------------------------------- the commands

fn vuris(arguments: &[&str], at: &Path) -> assert_cmd::assert::Assert {
    Command::cargo_bin("vuris").unwrap().arg("challenge").args(arguments).current_dir(at).assert()
}

/// Every file below `folder`, by its path.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push((path.display().to_string(), fs::read(&path).unwrap()));
        }
    }
    found.sort();
    found
}

#[test]
fn a_small_challenge_is_made_answered_and_scored() {
    let home = tempfile::tempdir().unwrap();
    let make = |out: &str| {
        vuris(&["make", "--tiny", "--cases", "4", "--seed", "3", "--out", out], home.path()).success()
    };
    make("one/c");
    make("two/c");
    let relative = |folder: &str| {
        let root = home.path().join(folder);
        let strip = |(path, bytes): (String, Vec<u8>)| {
            (path.strip_prefix(&root.display().to_string()).unwrap().to_owned(), bytes)
        };
        files(&root).into_iter().map(strip).collect::<Vec<_>>()
    };
    assert!(relative("one") == relative("two"), "a seed makes one challenge");
    assert!(!relative("one").is_empty());

    // The names of what is concealed are nowhere in the folder that is answered.
    let labels = fs::read_to_string(home.path().join("one/c-labels.json")).unwrap();
    for (path, bytes) in relative("one/c") {
        let text = String::from_utf8_lossy(&bytes);
        for mechanism in flaws::all() {
            // What the camera's simulation includes is said by name.
            let told = path.ends_with("camera.toml")
                && text.contains("included")
                && matches!(mechanism.hook, Hook::Unknown);
            assert!(
                told || !text.contains(mechanism.name) && !path.contains(mechanism.name),
                "{path}: {}",
                mechanism.name
            );
        }
        assert!(!path.contains("label"), "{path}");
    }

    vuris(&["score", "one/c", "--labels", "one/c-labels.json"], home.path()).failure();
    vuris(&["answer", "one/c"], home.path()).success().stderr("");
    let again = vuris(&["answer", "one/c"], home.path()).success();
    assert!(String::from_utf8_lossy(&again.get_output().stdout).contains("0 of them now"));
    let score =
        vuris(&["score", "one/c", "--labels", "one/c-labels.json", "--json", "score.json"], home.path());
    let text = String::from_utf8_lossy(&score.success().get_output().stdout).into_owned();
    assert!(text.contains("false alarms"), "{text}");
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(home.path().join("score.json")).unwrap()).unwrap();
    assert_eq!(json["all"]["cases"], 4);
    // Simpler methods have answered beside, and are judged by the same labels.
    for method in ["best_single", "sparse_regression"] {
        assert_eq!(json["simpler"][method]["all"]["cases"], 4);
    }
    fs::remove_file(home.path().join("one/c/answers/001.simpler.json")).unwrap();
    vuris(&["score", "one/c", "--labels", "one/c-labels.json"], home.path()).failure();
    let one = vuris(&["answer", "one/c"], home.path()).success();
    assert!(String::from_utf8_lossy(&one.get_output().stdout).contains("1 of them now"));

    fs::write(home.path().join("forged.json"), labels.replacen("\"rho\": ", "\"rho\": 1", 1)).unwrap();
    let refused = vuris(&["score", "one/c", "--labels", "forged.json"], home.path()).failure();
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("does not fit its seal"));
    let says = |arguments: &[&str], what: &str| {
        let refused = vuris(arguments, home.path()).failure();
        let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(text.contains(what) && text.contains("expected: ") && text.contains("way out: "), "{text}");
    };
    let absolute = home.path().join("new/l.json");
    for (out, labels) in [
        ("new", "new/l.json"),
        ("./new", "new/l.json"),
        ("new", "./new/l.json"),
        ("new", "one/../new/l.json"),
        ("new", absolute.to_str().unwrap()),
    ] {
        let make = ["make", "--tiny", "--cases", "1", "--seed", "1", "--out", out, "--labels", labels];
        says(&make, "own folder");
    }
    // Neither labels nor campaigns are lost to a score, nor is one taken for another.
    let score = |json: &str, what: &str| {
        says(&["score", "one/c", "--labels", "one/c-labels.json", "--json", json], what);
    };
    score("./one/c-labels.json", "is the file of labels");
    score("one/c/score.json", "own folder");
    assert_eq!(fs::read_to_string(home.path().join("one/c-labels.json")).unwrap(), labels);
    says(&["score", "one", "--labels", "one/c-labels.json"], "seals.json");
    says(&["score", "one/c", "--labels", "one/c/seals.json"], "seals.json");
    // Seals of the format before, which knew no campaigns.
    let file = home.path().join("one/c/seals.json");
    let seals = fs::read_to_string(&file).unwrap();
    let before = seals.replace("seals/2", "seals/1").replace("campaign_sha256", "other");
    fs::write(&file, before).unwrap();
    says(&["answer", "one/c"], "seals.json: format = \"vuris-challenge-seals/1\"");
    fs::write(&file, seals).unwrap();
    fs::write(home.path().join("one/c/campaigns/.DS_Store"), "").unwrap();
    vuris(&["answer", "one/c"], home.path()).success();
    let campaign = |name: &str| home.path().join("one/c/campaigns").join(name);
    fs::rename(campaign("001"), campaign("other")).unwrap();
    score("score.json", "001: the campaign is not there");
    fs::rename(campaign("002"), campaign("001")).unwrap();
    fs::rename(campaign("other"), campaign("002")).unwrap();
    score("score.json", "the campaign does not fit its seal");
    fs::remove_dir_all(home.path().join("one/c/answers")).unwrap();
    says(&["answer", "one/c"], "the campaign does not fit its seal");
}

/// Kinds have their shares in an order of chance; everything follows from the seed.
#[test]
fn cases_of_every_kind_are_drawn_and_are_whole() {
    let cases = drawn(100, 3, true);
    let count = |kind| cases.iter().filter(|case| case.kind() == kind).count();
    assert_eq!((count(CaseKind::Clean), count(CaseKind::Single), count(CaseKind::Outside)), (20, 34, 15));
    assert_eq!([CaseKind::Under, CaseKind::FarUnder].map(count), [5, 6]);
    assert!(cases.windows(2).filter(|two| two[0].kind() != two[1].kind()).count() > 50);
    assert_eq!(drawn(100, 3, true), cases);
    assert_ne!(drawn(100, 4, true), cases);
    let far = cases.iter().find(|case| case.kind() == CaseKind::FarUnder).unwrap().made().unwrap().0;
    assert!(far.effects[0].rho > 20.0 * far.effects[1].rho, "{far:?}");
    let (label, recordings) = cases[0].made().unwrap();
    assert_eq!((label.case.as_str(), cases[0].name().as_str()), ("001", "001"));
    for recording in recordings {
        let sets: &[SetRow] = &recording.sets;
        assert!(!sets.is_empty() && recording.raw.sets() == sets.len(), "{}", recording.name);
        assert_ne!(recording.kind, Kind::Other);
    }
}
