//! Laws over the registry of effects. A law says what it found amiss, so that it can be shown to fail, on broken effects.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use vuris::bench::{practice_camera, sensor};
use vuris::frames::Geometry;
use vuris::physics::{
    Act, Active, Before, Chain, Chance, Correlation, Draws, EFFECTS, Effect, Exposure, Fidelity, Formula,
    Included, Memory, Moment, Parameter, PerPixel, Place, Stage, Target,
};

const SMALL: Geometry = Geometry { width: 8, height: 6 };

fn chain_of(effects: Vec<Active>) -> Chain {
    let sensor = sensor(&practice_camera(SMALL));
    let pixels = Arc::new(Stage::bench().pixels(&sensor, 5));
    let included = Included { axial_motion: true, inverse_square_falloff: true };
    Chain::new(pixels, Correlation::measured(), included, effects)
}

fn moment(frame: usize, position_m: f64, velocity_m_s: f64, offset_rad: f64, lit: bool) -> Moment {
    Moment {
        set: 2,
        frame,
        frames: 4,
        time_s: 3.1 + frame as f64 * 0.025,
        in_set_s: frame as f64 * 0.025,
        frame_period_s: 0.025,
        step_rad: frame as f64 * FRAC_PI_2,
        offset_rad,
        position_m,
        place_m: position_m,
        velocity_m_s,
        frequency_hz: 30e6,
        lit,
        transmission: 1.0,
    }
}

fn moments() -> Vec<Moment> {
    vec![
        moment(0, 1.0, 0.0, 0.0, true),
        moment(1, 3.7, 2.0, 1.0, true),
        moment(2, 2.1, -2.0, 4.4, true),
        moment(3, 0.6, 0.5, 6.2, true),
        moment(1, 2.0, 0.0, 0.3, false),
    ]
}

fn memory(chain: &Chain, deviate: f64) -> Memory {
    let pixels = chain.pixels.count();
    let before_dn: PerPixel = Draws::of(1, 1).normal(pixels).iter().map(|d| 300.0 + 50.0 * d).collect();
    Memory {
        noisy: false,
        before: Some(Arc::new(Before {
            evenly_dn: before_dn.clone(),
            again_dn: before_dn.clone(),
            kept_dn: before_dn,
            rested_s: 0.0,
        })),
        deviates: vec![deviate; chain.effects().len()],
        pixel_deviates: Draws::of(2, 1).normal(pixels).iter().map(|d| deviate * d).collect(),
        ..Memory::default()
    }
}

fn signal(effect: &'static Effect, values: &[f64], moment: Moment, deviate: f64) -> Vec<f64> {
    let chain = chain_of(vec![Active { effect, values: values.to_vec() }]);
    let memory = memory(&chain, deviate);
    chain.expose(moment, memory).signal_dn.to_vec()
}

fn bits(signal: &[f64]) -> Vec<u64> {
    signal.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn a_filter_takes_its_share_of_all_light() {
    let signal = |moment| chain_of(Vec::new()).expose(moment, Memory::default()).signal_dn.to_vec();
    for moment in moments() {
        let whole = signal(moment);
        for transmission in [0.25, 0.0] {
            let through = signal(Moment { transmission, ..moment });
            for (through, whole) in through.iter().zip(&whole) {
                assert!((through - transmission * whole).abs() <= 1e-12 * whole.abs(), "{through} {whole}");
            }
        }
    }
}

/// Points of the parameters' box: corners, and points drawn within.
fn points(effect: &Effect) -> Vec<Vec<f64>> {
    let mut draws = Draws::of(17, 0);
    let parameters = effect.parameters;
    let corners = if parameters.len() <= 4 { 1 << parameters.len() } else { 64_usize };
    let corner = |corner: usize, draws: &mut Draws| -> Vec<f64> {
        let high = |place: usize, draws: &mut Draws| {
            if parameters.len() <= 4 { corner >> place & 1 == 1 } else { draws.even() < 0.5 }
        };
        parameters
            .iter()
            .enumerate()
            .map(|(n, p)| if high(n, draws) { p.bounds.1 } else { p.bounds.0 })
            .collect()
    };
    let mut points: Vec<Vec<f64>> = (0..corners).map(|n| corner(n, &mut draws)).collect();
    for _ in 0..30 {
        points
            .push(parameters.iter().map(|p| p.bounds.0 + (p.bounds.1 - p.bounds.0) * draws.even()).collect());
    }
    points
}

/// With all strengths off, whatever the shapes are, every bit is as without the effect.
fn off_is_the_identity(effect: &'static Effect) -> Vec<String> {
    let mut wrong = Vec::new();
    for (number, moment) in moments().into_iter().enumerate() {
        let chain = chain_of(Vec::new());
        let without = bits(&chain.expose(moment, memory(&chain, 1.3)).signal_dn);
        let shapes = |point: Vec<f64>| -> Vec<f64> {
            let value = |(p, value): (&Parameter, f64)| if p.is_shape() { value } else { p.off };
            effect.parameters.iter().zip(point).map(value).collect()
        };
        for values in points(effect).into_iter().map(shapes).chain([effect.off()]) {
            if bits(&signal(effect, &values, moment, 1.3)) != without {
                wrong.push(format!("{}: off at {values:?} changes moment {number}", effect.name));
            }
        }
    }
    wrong
}

fn finite_within_bounds(effect: &'static Effect) -> Vec<String> {
    let mut wrong = Vec::new();
    for values in points(effect) {
        for moment in moments() {
            if signal(effect, &values, moment, 3.0)
                .iter()
                .any(|value| !value.is_finite() || value.abs() > 1e7)
            {
                wrong.push(format!("{}: {values:?} is not finite", effect.name));
            }
        }
    }
    wrong
}

/// The same draws give the same bits, and what is said of draws and of the frame before is so.
fn deterministic(effect: &'static Effect) -> Vec<String> {
    let values = effect.example();
    let mut wrong = Vec::new();
    let (mut draws, mut looks_back) = (false, false);
    for moment in moments() {
        let once = bits(&signal(effect, &values, moment, 0.7));
        if once != bits(&signal(effect, &values, moment, 0.7)) {
            wrong.push(format!("{}: twice is not the same", effect.name));
        }
        draws |= once != bits(&signal(effect, &values, moment, -1.1));
        let chain = chain_of(vec![Active { effect, values: values.clone() }]);
        let alone = Memory { before: None, ..memory(&chain, 0.7) };
        looks_back |= once != bits(&chain.expose(moment, alone).signal_dn);
    }
    if draws != (effect.chance != Chance::None) || looks_back != effect.looks_back {
        wrong.push(format!("{}: draws {draws}, looks back {looks_back}", effect.name));
    }
    wrong
}

/// Off and typical values lie within the bounds, names are words, strengths come first, and the example does something.
fn well_described(effect: &'static Effect) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut check = |holds: bool, what: &str| {
        if !holds {
            wrong.push(format!("{}: {what}", effect.name));
        }
    };
    let word = |name: &str| {
        name.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_')
    };
    check(word(effect.name), "name");
    check(effect.sentence.ends_with('.') && effect.sentence.len() > 30, "sentence");
    check(!effect.reference.is_empty(), "reference");
    let names: BTreeSet<&str> = effect.parameters.iter().map(|p| p.name).collect();
    check(
        !names.is_empty() && names.len() == effect.parameters.len() && names.iter().all(|n| word(n)),
        "parameters",
    );
    for parameter in effect.parameters {
        let (low, high) = parameter.bounds;
        check(low < high && (low..=high).contains(&parameter.off), "bounds");
        check(parameter.shapes.iter().all(|shape| (low..=high).contains(shape)), "shapes");
        check(parameter.typical > 0.0 && !parameter.unit.is_empty(), "typical");
    }
    let shapes: Vec<bool> = effect.parameters.iter().map(Parameter::is_shape).collect();
    check(shapes.is_sorted() && !shapes[0], "order of the parameters");
    let (off, example) = (effect.off(), effect.example());
    let near = |values: &[f64]| {
        let at = moments().into_iter().chain([moment(1, 0.8, -1.0, 2.0, true)]);
        at.map(|moment| bits(&signal(effect, values, moment, 0.7))).collect::<Vec<_>>()
    };
    check(near(&off) != near(&example), "the example changes nothing");
    wrong
}

type Law = fn(&'static Effect) -> Vec<String>;
const LAWS: [(&str, Law); 4] = [
    ("off is the identity", off_is_the_identity),
    ("finite within bounds", finite_within_bounds),
    ("deterministic", deterministic),
    ("well described", well_described),
];

#[test]
fn every_effect_obeys_every_law() {
    for (name, law) in LAWS {
        for effect in EFFECTS {
            let wrong = law(effect);
            assert!(wrong.is_empty(), "{name}: {wrong:#?}");
        }
    }
}

#[test]
fn the_registry_holds_each_effect_once() {
    let names = "correlation_harmonics inverse_square_falloff axial_motion multipath_interference lens_scatter mixed_pixels \
                 ambient_drift ambient_flicker illumination_droop illumination_drift phase_step_scale \
                 phase_step_errors phase_drift clock_jitter demodulation_skew modulation_frequency_error intensity_nonlinearity saturation \
                 image_lag charge_crosstalk tap_mismatch adc_nonlinearity intensity_related_phase electrical_crosstalk \
                 encoder_scale encoder_cyclic frame_gain timing_jitter_of_frames lateral_motion excess_noise fixed_point \
                 response_decay encoder_offset illumination_baseline frame_timing_error radial_axial_distance multi_camera_interference";
    let registry: Vec<&str> = EFFECTS.iter().map(|effect| effect.name).collect();
    assert_eq!(registry, names.split_whitespace().collect::<Vec<_>>());
}

/// Each law catches an effect that breaks it, and only those laws that it breaks.
#[test]
fn broken_effects_are_caught() {
    static CALLS: AtomicU64 = AtomicU64::new(0);
    fn broken(act: fn(&[f64], &mut Exposure)) -> &'static Effect {
        static SHARE: [Parameter; 1] = [Parameter::strength("share", "1", 0.0, (0.0, 1.0), 0.1)];
        Box::leak(Box::new(Effect {
            name: "broken",
            sentence: "An effect that breaks a law, to see it caught.",
            reference: "none",
            parameters: &SHARE,
            place: Place::Readout,
            chance: Chance::None,
            looks_back: false,
            fidelity: Fidelity::Exact,
            act: Act::Code(act),
        }))
    }
    fn add(exposure: &mut Exposure, dn: f64) {
        exposure.signal_dn.iter_mut().for_each(|signal| *signal += dn);
    }
    type Code = fn(&[f64], &mut Exposure);
    let mutants: [(&str, Code); 6] = [
        ("off is the identity", |values, exposure| add(exposure, 1e-9 + values[0])),
        ("finite within bounds", |values, exposure| add(exposure, values[0] / (1.0 - values[0]))),
        ("deterministic", |values, exposure| {
            add(exposure, values[0] * CALLS.fetch_add(1, Ordering::Relaxed) as f64);
        }),
        // Draws, and looks back, without saying so.
        ("deterministic", |values, exposure| add(exposure, values[0] * exposure.deviate)),
        ("deterministic", |values, exposure| {
            let before = exposure.before.as_ref().map_or(0.0, |before| before.evenly_dn[0]);
            add(exposure, values[0] * (1.0 + before));
        }),
        ("well described", |_, _| ()),
    ];
    for (breaks, act) in mutants {
        let effect = broken(act);
        for (name, law) in LAWS {
            // One that does nothing draws nothing: that is no lie.
            assert_eq!(law(effect).is_empty(), name != breaks, "{name} on what breaks: {breaks}");
        }
    }
}

/// A user's formula acts after the registry's effects of its place, whichever the chain has first.
#[test]
fn formulas_act_after_the_registrys_effects() {
    let formula = Formula::new(Target::Signal, "a * signal", &["a"]).unwrap();
    static PARAMETERS: [Parameter; 1] = [Parameter::strength("a", "1", 0.0, (-1.0, 1.0), 1.0)];
    let twice: &'static Effect = Box::leak(Box::new(Effect {
        name: "twice",
        sentence: "",
        reference: "",
        parameters: &PARAMETERS,
        place: Place::Charge,
        chance: Chance::None,
        looks_back: false,
        fidelity: Fidelity::Exact,
        act: Act::Formula(Box::new(formula)),
    }));
    let crosstalk = EFFECTS.iter().find(|effect| effect.name == "electrical_crosstalk").unwrap();
    let signal = |effects: &[&'static Effect]| {
        let active = effects.iter().map(|effect| Active { effect, values: effect.example() });
        let chain = chain_of(active.collect());
        chain.expose(moments()[1], Memory::default()).signal_dn.to_vec()
    };
    let doubled: Vec<f64> = signal(&[crosstalk]).into_iter().map(|signal| signal + signal).collect();
    assert_eq!(signal(&[crosstalk, twice]), doubled);
    assert_eq!(signal(&[twice, crosstalk]), doubled);
    // The order would be seen.
    assert_ne!(signal(&[twice]), signal(&[crosstalk]));
    assert_ne!(doubled, signal(&[]).into_iter().map(|signal| signal + signal).collect::<Vec<_>>());
}

/// Charge that wanders to neighbours is neither lost nor made, at the sensor's border neither.
#[test]
fn charge_that_wanders_is_all_there() {
    let crosstalk = EFFECTS.iter().find(|effect| effect.name == "charge_crosstalk").unwrap();
    let of = |values: &[f64]| signal(crosstalk, values, moment(1, 1.4, 0.0, 0.7, true), 0.0);
    let still = of(&crosstalk.off());
    for name in ["share", "from_beside", "from_above_and_below", "from_diagonal"] {
        let mut values = crosstalk.off();
        values[crosstalk.parameters.iter().position(|parameter| parameter.name == name).unwrap()] = 0.1;
        let moved = of(&values);
        assert!(moved.iter().zip(&still).any(|(a, b)| (a - b).abs() > 1.0), "{name}");
        let (before, after): (f64, f64) = (still.iter().sum(), moved.iter().sum());
        assert!((after - before).abs() < 1e-9 * before, "{name}: {before} DN, then {after} DN");
    }
}
