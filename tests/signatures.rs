//! First-order signatures: what the literature says of an effect's residual is what the simulator shows.
//!
//! The expected numbers are derived by hand from I_n = B + A Σ a_m cos(m (θ_n − φ)), not by the simulator. Each signature is shown to
//! fail on an effect that is absent, of another size, or turned around.

use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, SQRT_2, TAU};
use std::sync::Arc;
use vuris::bench::{Course, Simulation, practice_camera, sensor};
use vuris::frames::Geometry;
use vuris::physics::{Active, Chain, Correlation, Included, Memory, Moment, Pixels, Pulse, effects};
use vuris::recording::{Kind, SetRow};
use vuris::spec::scheme;
use vuris::units::{phase_rad, unambiguous_range_m, wrap_rad};

const A: f64 = 300.0;
const ACTIVE: f64 = 300.0;
const AMBIENT: f64 = 300.0;
const B: f64 = ACTIVE + AMBIENT;
const FULL_SCALE: f64 = 4000.0;
const PERIOD_S: f64 = 0.025;

/// A row of pixels that see a target at 1 m with these amplitudes, DN.
fn row(amplitude_dn: &[f64]) -> Pixels {
    let count = amplitude_dn.len();
    Pixels {
        geometry: Geometry { width: count, height: 1 },
        target: vec![true; count],
        obliquity: vec![1.0; count],
        background_m: vec![1.0; count],
        phase_rad: vec![0.0; count],
        at_frequencies: Vec::new(),
        amplitude_1m_dn: amplitude_dn.to_vec(),
        constant_1m_dn: amplitude_dn.iter().map(|a| a * ACTIVE / A).collect(),
        ambient_dn: vec![AMBIENT; count].into(),
        full_scale_dn: FULL_SCALE,
        pedestal_dn: 64.0,
        edges: Vec::new(),
        edge_counts: Vec::new(),
    }
}

/// Frame number `frame` of four of a still target at 1 m: a row of pixels with these amplitudes.
fn still_frame(amplitude_dn: &[f64], effects: Vec<Active>, frame: usize) -> Vec<f64> {
    frame_of(row(amplitude_dn), effects, frame)
}

/// The same of `pixels`.
fn frame_of(pixels: Pixels, effects: Vec<Active>, frame: usize) -> Vec<f64> {
    let included = Included { axial_motion: false, inverse_square_falloff: false };
    let chain = Chain::new(Arc::new(pixels), Correlation::sinusoidal(), included, effects);
    let moment = Moment {
        set: 0,
        frame,
        frames: 4,
        time_s: frame as f64 * PERIOD_S,
        in_set_s: frame as f64 * PERIOD_S,
        frame_period_s: PERIOD_S,
        step_rad: frame as f64 * FRAC_PI_2,
        offset_rad: 0.0,
        position_m: 1.0,
        place_m: 1.0,
        velocity_m_s: 0.0,
        frequency_hz: 30e6,
        lit: true,
        transmission: 1.0,
    };
    chain.expose(moment, Memory::default()).signal_dn.to_vec()
}

/// One experiment: the phase goes over a turn.
struct Experiment {
    amplitude_dn: f64,
    velocity_m_s: f64,
    frequency_hz: f64,
    correlation: Correlation,
    kind: Kind,
    /// Whether the phase is the target's, a pixel each, and not the offset of the sensor's modulation, with one pixel.
    by_target: bool,
    /// Phase steps and coefficients.
    steps_rad: Vec<f64>,
    coefficients: Vec<Complex64>,
}

const OFFSETS: usize = 96;

impl Experiment {
    fn of(name: &str) -> Self {
        let scheme = scheme(name).unwrap();
        Self {
            amplitude_dn: A,
            velocity_m_s: 0.0,
            frequency_hz: 30e6,
            correlation: Correlation::sinusoidal(),
            kind: Kind::Other,
            by_target: false,
            steps_rad: (0..scheme.steps()).map(|step| scheme.angle_rad(step)).collect(),
            coefficients: scheme.characteristic_polynomial(),
        }
    }

    fn four() -> Self {
        Self::of("four_frame")
    }

    fn wdft() -> Self {
        Self::of("wdft")
    }

    /// The phasors of the second of two sets at every phase, one after the other without a pause.
    fn phasors(&self, active: Vec<Active>) -> Vec<Complex64> {
        let included = Included { axial_motion: false, inverse_square_falloff: false };
        let mut pixels = row(&vec![self.amplitude_dn; if self.by_target { OFFSETS } else { 1 }]);
        if self.by_target {
            pixels.phase_rad = (0..OFFSETS).map(|n| -(n as f64) * TAU / OFFSETS as f64).collect();
        }
        let pixels = Arc::new(pixels);
        let chain = Chain::new(pixels, self.correlation.clone(), included, active);
        let sensor = sensor(&practice_camera(Geometry { width: 1, height: 1 }));
        let set_s = self.steps_rad.len() as f64 * PERIOD_S;
        let set = |set: usize| SetRow {
            time_s: set as f64 * set_s,
            position_m: Some(1.0),
            velocity_m_s: self.velocity_m_s,
            phase_offset_rad: if self.by_target { 0.0 } else { (set / 2) as f64 * TAU / OFFSETS as f64 },
            extra: Vec::new(),
        };
        let course = Course {
            kind: self.kind,
            frequency_hz: self.frequency_hz,
            steps_rad: self.steps_rad.clone(),
            frame_period_s: PERIOD_S,
            sets: (0..2 * OFFSETS).map(set).collect(),
            frame_times_s: None,
        };
        let simulation = Simulation { chain: &chain, sensor: &sensor, noise: false, seed: 9, recording: 0 };
        let phasor = |offset: usize| {
            let first = (2 * offset + 1) * course.frames();
            let frames = self.coefficients.iter().enumerate();
            let pixel = if self.by_target { offset } else { 0 };
            frames.map(|(frame, c)| c * simulation.signal(&course, first + frame)[pixel]).sum()
        };
        (0..OFFSETS).map(phasor).collect()
    }

    /// Phase and its error, rad.
    fn errors(&self, active: Vec<Active>) -> Vec<(f64, f64)> {
        let phi = phase_rad(1.0, self.frequency_hz);
        let phasors = self.phasors(active).into_iter().enumerate();
        phasors
            .map(|(n, phasor)| {
                let truth = phi - n as f64 * TAU / OFFSETS as f64;
                (truth, wrap_rad(phasor.arg() - truth))
            })
            .collect()
    }

    fn cycles(&self, active: Vec<Active>) -> Cycles {
        Cycles(self.errors(active))
    }
}

/// A phase error over the phase, by its cycles a turn.
struct Cycles(Vec<(f64, f64)>);

impl Cycles {
    fn mean(&self) -> f64 {
        self.0.iter().map(|(_, e)| e).sum::<f64>() / self.0.len() as f64
    }

    fn part(&self, cycles: u32) -> Complex64 {
        let turned = |&(phi, e): &(f64, f64)| e * Complex64::from_polar(2.0, -f64::from(cycles) * phi);
        self.0.iter().map(turned).sum::<Complex64>() / self.0.len() as f64
    }

    fn cos(&self, cycles: u32) -> f64 {
        self.part(cycles).re
    }

    fn sin(&self, cycles: u32) -> f64 {
        -self.part(cycles).im
    }

    fn size(&self, cycles: u32) -> f64 {
        self.part(cycles).norm()
    }

    fn peak(&self) -> f64 {
        self.0.iter().map(|(_, e)| e.abs()).fold(0.0, f64::max)
    }

    /// Whatever is left when the mean and these cycles are taken away: root mean square.
    fn rest(&self, cycles: &[u32]) -> f64 {
        let (mean, parts) = (self.mean(), cycles.iter().map(|&k| (k, self.part(k))).collect::<Vec<_>>());
        let left = |&(phi, e): &(f64, f64)| {
            let known: f64 = parts
                .iter()
                .map(|(k, part)| (part * Complex64::from_polar(1.0, f64::from(*k) * phi)).re)
                .sum();
            (e - mean - known).powi(2)
        };
        (self.0.iter().map(left).sum::<f64>() / self.0.len() as f64).sqrt()
    }
}

/// What was found amiss.
#[derive(Default)]
struct Findings(Vec<String>);

impl Findings {
    /// `found` is `expected` to within `share` of it: a signature of first order.
    fn about(&mut self, what: &str, found: f64, expected: f64, share: f64) {
        let near = (found - expected).abs() <= share * expected.abs();
        if !near {
            self.0.push(format!("{what}: {found:.6}, not {expected:.6}"));
        }
    }

    fn below(&mut self, what: &str, found: f64, limit: f64) {
        let low = found.abs() <= limit;
        if !low {
            self.0.push(format!("{what}: {found:.3e}, more than {limit:.3e}"));
        }
    }
}

/// Makes an effect with these parameters; a mutant makes it with other values than it is asked for.
type Make = fn(&str, &[(&str, f64)]) -> Vec<Active>;

fn scaled(factor: f64, name: &str, settings: &[(&str, f64)]) -> Vec<Active> {
    let effect = effects::named(name).unwrap();
    let mut values = effect.off();
    for (parameter, value) in settings {
        let number = effect.parameters.iter().position(|known| known.name == *parameter).unwrap();
        let known = &effect.parameters[number];
        values[number] = if known.is_shape() { *value } else { known.off + factor * value };
    }
    vec![Active { effect, values }]
}

fn harmonics(make: Make, findings: &mut Findings) {
    let one = |parameter| make("correlation_harmonics", &[(parameter, 0.01)]);
    // (scheme, harmonic, cycles, sine's coefficient in 10 mrad): e = −a_{N−1} sin Nφ + a_{N+1} sin Nφ, and for 2N likewise.
    for (name, parameter, cycles, sign) in [
        ("four_frame", "cosine_3", 4, -1.0),
        ("four_frame", "cosine_5", 4, 1.0),
        ("wdft", "cosine_2", 3, -1.0),
        ("wdft", "cosine_4", 3, 1.0),
        ("wdft", "cosine_5", 6, -1.0),
        ("wdft", "cosine_7", 6, 1.0),
    ] {
        for amplitude_dn in [A, A / 10.0] {
            let e = Experiment { amplitude_dn, ..Experiment::of(name) }.cycles(one(parameter));
            findings.about(&format!("{name} {parameter}"), e.sin(cycles), sign * 0.01, 0.01);
            findings.below(&format!("{name} {parameter}, the rest"), e.rest(&[cycles]), 1e-4);
        }
    }
    for (name, parameter) in
        [("four_frame", "cosine_2"), ("four_frame", "cosine_4"), ("wdft", "cosine_3"), ("wdft", "cosine_6")]
    {
        findings.below(parameter, Experiment::of(name).cycles(one(parameter)).peak(), 1e-12);
    }
}

fn phase_step_scale(make: Make, findings: &mut Findings) {
    let effect = || make("phase_step_scale", &[("relative", 0.01)]);
    let four = Experiment::four().cycles(effect());
    findings.about("-0.785 eps cos 2 phi", four.cos(2), -0.00785, 0.02);
    findings.below("the rest", four.rest(&[2]), 1e-4);
    let wdft = Experiment::wdft().cycles(effect());
    findings.below("WDFT about its mean", wdft.rest(&[]), 1.5e-4);
}

fn phase_step_errors(make: Make, findings: &mut Findings) {
    let four = Experiment::four().cycles(make("phase_step_errors", &[("setting_1_rad", 0.01)]));
    findings.about("mean", four.mean(), -0.0025, 0.02);
    findings.about("two cycles", four.cos(2), -0.0025, 0.02);
    findings.below("the rest", four.rest(&[2]), 5e-5);
}

fn axial_motion(make: Make, findings: &mut Findings) {
    for (velocity_m_s, frequency_hz) in [(0.4, 30e6), (-0.4, 30e6), (0.4, 20e6)] {
        let effect = || make("axial_motion", &[("share", 1.0)]);
        let metres = unambiguous_range_m(frequency_hz) / TAU;
        let way_m = velocity_m_s * PERIOD_S;
        let four = Experiment { velocity_m_s, frequency_hz, ..Experiment::four() }.cycles(effect());
        findings.about("v T_f / 2 cos 2 phi, m", four.cos(2) * metres, way_m / 2.0, 0.02);
        findings.about("the mean at mid-time, m", four.mean() * metres, 1.5 * way_m, 0.02);
        let wdft = Experiment { velocity_m_s, frequency_hz, ..Experiment::wdft() }.cycles(effect());
        findings.below("WDFT: second order", wdft.rest(&[]), (way_m / metres).powi(2));
    }
}

fn inverse_square_falloff(make: Make, findings: &mut Findings) {
    for velocity_m_s in [0.1, -0.1] {
        let effect = || make("inverse_square_falloff", &[("share", 1.0)]);
        let beta = -2.0 * velocity_m_s * PERIOD_S;
        let four = Experiment { velocity_m_s, ..Experiment::four() }.cycles(effect());
        findings.about("beta / 2 sin 2 phi", four.sin(2), beta / 2.0, 0.03);
        findings.about(
            "one cycle of the light's constant",
            four.size(1),
            SQRT_2 * beta.abs() * ACTIVE / A,
            0.03,
        );
        let wdft = Experiment { velocity_m_s, ..Experiment::wdft() }.cycles(effect());
        findings.below("WDFT: second order", wdft.peak(), 8.0 * beta * beta);
    }
}

fn frame_gain(make: Make, findings: &mut Findings) {
    let four = Experiment::four().cycles(make("frame_gain", &[("frame_0", 0.01)]));
    findings.about("one cycle g B / 2 A", four.size(1), 0.01 * B / (2.0 * A), 0.02);
    findings.about("two cycles g / 4", four.size(2), 0.01 / 4.0, 0.03);
}

fn ambient_drift(make: Make, findings: &mut Findings) {
    let effect = || make("ambient_drift", &[("relative_a_second", 0.02)]);
    let a_frame_dn = 0.02 * AMBIENT * PERIOD_S;
    for amplitude_dn in [A, A / 2.0] {
        let four = Experiment { amplitude_dn, ..Experiment::four() }.cycles(effect());
        findings.about("one cycle sqrt 2 b / A", four.size(1), SQRT_2 * a_frame_dn / amplitude_dn, 0.02);
        findings.below("the rest", four.rest(&[1]), 1e-5);
    }
    findings.below("WDFT", Experiment::wdft().cycles(effect()).peak(), 1e-9);
}

fn saturation(make: Make, findings: &mut Findings) {
    let at = |full_dn: f64| make("saturation", &[("missing", 1.0 - full_dn / FULL_SCALE)]);
    findings.below("not where nothing is clipped", Experiment::four().cycles(at(B + A + 1.0)).peak(), 1e-12);
    let clipped = Experiment::four().cycles(at(B + 0.8 * A));
    findings.below("only 4, 8, 16 … cycles", clipped.rest(&[4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44]), 1e-3);
    // By hand: only the frame at φ is above; e(φ) for A cos φ > 0.8 A is −(cos φ − 0.8) sin φ / 2 / (cos φ − (cos φ − 0.8) / 2 cos φ …),
    // exactly arg of the phasor below.
    let by_hand = |phi: f64| {
        let frame = |theta: f64| (phi - theta).cos().min(0.8);
        let z =
            Complex64::new(frame(0.0) - frame(2.0 * FRAC_PI_2), frame(FRAC_PI_2) - frame(3.0 * FRAC_PI_2));
        wrap_rad(z.arg() - phi)
    };
    let differences = clipped.0.iter().map(|&(phi, e)| (e - by_hand(phi)).abs());
    findings.below("by hand", differences.fold(0.0, f64::max), 1e-9);
}

fn quadratic(make: Make, findings: &mut Findings) {
    let effect = || make("intensity_nonlinearity", &[("quadratic", 0.2)]);
    let alpha = 0.2 / FULL_SCALE;
    findings.below("four frames", Experiment::four().cycles(effect()).peak(), 1e-9);
    for amplitude_dn in [A, A / 3.0] {
        let wdft = Experiment { amplitude_dn, ..Experiment::wdft() }.cycles(effect());
        let b = AMBIENT + ACTIVE * amplitude_dn / A;
        let expected = alpha * amplitude_dn / 2.0 / (1.0 + 2.0 * alpha * b);
        findings.about("three cycles, as the amplitude", wdft.size(3), expected, 0.02);
    }
}

fn cubic(make: Make, findings: &mut Findings) {
    let beta = 0.5 / FULL_SCALE / FULL_SCALE;
    for amplitude_dn in [A, A / 2.0] {
        let four = Experiment { amplitude_dn, ..Experiment::four() }
            .cycles(make("intensity_nonlinearity", &[("cubic", 0.5)]));
        let b = AMBIENT + ACTIVE * amplitude_dn / A;
        let linear = 1.0 + beta * (3.0 * b * b + 0.75 * amplitude_dn * amplitude_dn);
        let expected = beta * amplitude_dn * amplitude_dn / 4.0 / linear;
        findings.about("four cycles, as the square", four.sin(4), -expected, 0.02);
    }
}

fn fixed_point(make: Make, findings: &mut Findings) {
    let effect = || make("fixed_point", &[("bits_cut", 4.0)]);
    for frame in 0..4 {
        let codes = still_frame(&[A, A / 3.0, A / 7.0, 2.0 * A], effect(), frame);
        let off = codes.iter().map(|dn| ((dn + 64.0) / 16.0).fract().abs()).fold(0.0, f64::max);
        findings.below("codes are multiples of 16", off, 1e-12);
    }
    let rms =
        |amplitude_dn: f64| Experiment { amplitude_dn, ..Experiment::four() }.cycles(effect()).rest(&[]);
    // Pedestal and offset together are half a unit above a multiple of 16 at these amplitudes, so what is cut off I0 and I2 adds up to
    // a unit, and their difference is off by twice the one: a phase error of (16 / √12) / A, the quadrature alike.
    for amplitude_dn in [76.0, 300.0] {
        let expected = 16.0 / 12f64.sqrt() / amplitude_dn;
        findings.about("a staircase as 1 / A", rms(amplitude_dn), expected, 0.25);
    }
}

fn image_lag(make: Make, findings: &mut Findings) {
    let effect = || make("image_lag", &[("share", 0.02)]);
    let again = || make("image_lag", &[("share", 0.02), ("last_step_before_first", 1.0)]);
    let four = Experiment::four().cycles(effect());
    // Three steps of a quarter turn forward are one back.
    findings.about("the last step of four", Experiment::four().cycles(again()).mean(), four.mean(), 1e-9);
    // Of five of a third of a turn it is one forward: of 4.5 A the first frame's 2 l A sin δ sin φ turn the phase by its part sin φ.
    let wdft = |effect| Experiment::of("wdft").cycles(effect);
    findings.below("evenly, five frames know no cycle", wdft(effect()).size(2), 1e-9);
    findings.about("again, they know two", wdft(again()).size(2), 0.02 * 3f64.sqrt() / 9.0 / 0.97, 1e-3);
    let emptied = || make("image_lag", &[("share", 0.02), ("last_step_before_first", -1.0)]);
    for (frame, share) in [(0, 0.98), (1, 1.0)] {
        // A frame by itself has none before it.
        let [with, without] = [emptied(), Vec::new()].map(|effects| still_frame(&[A], effects, frame)[0]);
        findings.about("an emptied pixel adds nothing", with, share * without, 1e-12);
    }
    // A camera that waits at the first step has no lag there: of l less l/4 (1 − cos 2φ + sin 2φ).
    let waited =
        Experiment::four().cycles(make("image_lag", &[("share", 0.02), ("last_step_before_first", -3.0)]));
    findings.about("three of four frames lag", waited.mean(), 0.75 * 0.02, 0.03);
    findings.about("and know two cycles", waited.size(2), 0.02 * 2f64.sqrt() / 4.0, 0.03);
    // l sin δ / (1 − l + l cos δ)
    findings.about("+ l sin delta", four.mean(), 0.02 / 0.98, 0.01);
    findings.below("no dependence on phase", four.rest(&[]), 1e-9);
    let mut backwards = Experiment::four();
    backwards.steps_rad = (0..4).map(|n| -f64::from(n) * FRAC_PI_2).collect();
    backwards.coefficients = backwards.coefficients.iter().map(Complex64::conj).collect();
    findings.about("backwards", backwards.cycles(effect()).mean(), -0.02 / 0.98, 0.01);
}

fn electrical_crosstalk(make: Make, findings: &mut Findings) {
    let effect = || make("electrical_crosstalk", &[("cosine_dn", 4.0), ("sine_dn", 3.0)]);
    for name in ["four_frame", "wdft"] {
        for amplitude_dn in [A, A / 2.0] {
            let over_target = Experiment { amplitude_dn, by_target: true, ..Experiment::of(name) };
            findings.about("one cycle C / A", over_target.cycles(effect()).size(1), 5.0 / amplitude_dn, 0.01);
            // It has the modulation's phase, so a sweep of that carries it along with the target's.
            let over_offset = Experiment { amplitude_dn, ..Experiment::of(name) };
            findings.below("not over the offset", over_offset.cycles(effect()).rest(&[]), 1e-9);
        }
        let covered = Experiment { kind: Kind::Dark, ..Experiment::of(name) }.phasors(effect());
        let gain = scheme(name).unwrap().gain;
        findings.about("without light", covered[7].norm() / gain, 5.0, 1e-9);
    }
}

fn multipath(make: Make, findings: &mut Findings) {
    let longer_by_m = unambiguous_range_m(30e6) / 6.0;
    // Out 1 m, back by the mirror image of a wall.
    let back_m = 1.0 + 2.0 * longer_by_m;
    let wall_m = (back_m * back_m - 1.0).sqrt() / 2.0;
    let settings = [("relative_amplitude", 0.1 * back_m), ("wall_distance_m", wall_m)];
    for name in ["four_frame", "wdft"] {
        let e = Experiment::of(name).cycles(make("multipath_interference", &settings));
        // 10 % at 60°: arg(1 + 0.1 exp(iπ/3)).
        findings.about("82 mrad", e.mean(), 0.082_291, 0.001);
        findings.below("no dependence on phase", e.rest(&[]), 1e-9);
    }
    // Light that comes by the wall goes to the target: a pixel that sees the background beside it gets none.
    let frame = |effects: Vec<Active>| {
        let pixels = Pixels { target: vec![true, false], ..row(&[A; 2]) };
        frame_of(pixels, effects, 0)
    };
    let (with, without) = (frame(make("multipath_interference", &settings)), frame(Vec::new()));
    findings.below("nothing beside the target", (with[1] - without[1]).abs(), 1e-12);
}

fn illumination_baseline(make: Make, findings: &mut Findings) {
    for name in ["four_frame", "wdft"] {
        let e = Experiment::of(name).cycles(make("illumination_baseline", &[("squared_baseline_m2", 0.01)]));
        // 1 m away, out from 10 cm beside the lens: 2 pi 30 MHz (sqrt(1.01) - 1) m / c.
        findings.about("3 mrad", e.mean(), 0.003_135_947, 1e-4);
        findings.below("no dependence on phase", e.rest(&[]), 1e-9);
        let with_light = make("illumination_baseline", &[("squared_baseline_of_light_m2", 0.01)]);
        findings.about("the same way", Experiment::of(name).cycles(with_light).mean(), e.mean(), 1e-9);
    }
    // The way out is the root of 1.01 m: of the constant part, which two frames half a turn apart have twice, a hundred and first is gone.
    let sum = |effects: &dyn Fn() -> Vec<Active>| -> f64 {
        [0, 2].iter().map(|&frame| still_frame(&[A], effects(), frame)[0]).sum()
    };
    let of = |name: &'static str| move || make("illumination_baseline", &[(name, 0.01)]);
    let lost = |name| sum(&Vec::new) - sum(&of(name));
    findings.about("light falls", lost("squared_baseline_of_light_m2"), 2.0 * ACTIVE / 101.0, 1e-9);
    findings.below("the phase alone", lost("squared_baseline_m2").abs(), 1e-9);
    // Two pixels that look 45 degrees to either side see 1.414 m away what is lit from 10 cm to the right, from 1.81 and 2.21 m^2 away instead of 2.
    let light = |of_phase_alone: f64| {
        let values = [("middle_along_columns_m", 0.1), ("of_phase_alone", of_phase_alone)];
        let frame = |frame: usize| {
            let pixels = Pixels { obliquity: vec![SQRT_2; 2], ..row(&[A; 2]) };
            frame_of(pixels, make("illumination_baseline", &values), frame)
        };
        let [first, third] = [0, 2].map(frame);
        [0, 1].map(|pixel| first[pixel] + third[pixel] - 2.0 * AMBIENT)
    };
    let [left, right] = light(0.0);
    findings.about("the left side", left, ACTIVE * 2.0 / 2.21, 1e-9);
    findings.about("the right side", right, ACTIVE * 2.0 / 1.81, 1e-9);
    light(1.0).into_iter().for_each(|light| findings.about("calibrated light", light, ACTIVE, 1e-9));
}

fn lateral_motion(make: Make, findings: &mut Findings) {
    let amplitudes = [A, A, A, A / 2.0, A / 2.0, A / 2.0];
    for (columns_a_second, edge) in [(2.0, 3), (-2.0, 2)] {
        let effect = || make("lateral_motion", &[("columns_a_second", columns_a_second)]);
        let frames: Vec<Vec<f64>> = (0..4).map(|frame| still_frame(&amplitudes, effect(), frame)).collect();
        let consistency = |pixel: usize| {
            let at = |frame: usize| frames[frame][pixel];
            at(0) + at(2) - at(1) - at(3)
        };
        for (pixel, consistency) in (0..amplitudes.len()).map(consistency).enumerate() {
            if pixel == edge {
                // The edge is behind by (t0 + t2 − t1 − t3) v = −2 v T columns of a step that is half of I: B and A cos.
                let phi = phase_rad(1.0, 30e6);
                let step = |n: f64| ACTIVE / 2.0 + A / 2.0 * (n * FRAC_PI_2 - phi).cos();
                let expected: f64 = [0.0, -1.0, 2.0, -3.0]
                    .iter()
                    .map(|t: &f64| columns_a_second.abs() * t * PERIOD_S * step(t.abs()))
                    .sum::<f64>()
                    * if columns_a_second > 0.0 { 1.0 } else { -1.0 };
                findings.about("at the edge that comes in", consistency, expected, 1e-6);
            } else {
                findings.below("not elsewhere", consistency, 1e-9);
            }
        }
    }
}

/// Beside a motion that is known, frames that follow each other more slowly see the target later: by 1.5 periods' share on average. One that is late turns its own
/// phase, of four, by the way that the target has gone.
fn frame_timing_error(make: Make, findings: &mut Findings) {
    for velocity_m_s in [0.4, -0.4] {
        let metres = unambiguous_range_m(30e6) / TAU;
        let mean_m = |more: Vec<Active>| {
            let moving = [scaled(1.0, "axial_motion", &[("share", 1.0)]), more].concat();
            Experiment { velocity_m_s, ..Experiment::four() }.cycles(moving).mean() * metres
        };
        let longer_m = mean_m(make("frame_timing_error", &[("relative", 0.2)])) - mean_m(Vec::new());
        findings.about("another period, m", longer_m, 1.5 * 0.2 * velocity_m_s * PERIOD_S, 0.02);
        let late_m = mean_m(make("frame_timing_error", &[("frame_2_s", 0.004)])) - mean_m(Vec::new());
        findings.about("a late frame, m", late_m, 0.25 * 0.004 * velocity_m_s, 0.02);
    }
}

/// A pixel that looks 1.1 times as far as the axis says that it is 0.03 m more, where the bowl is 30 % deeper.
fn radial_axial_distance(make: Make, findings: &mut Findings) {
    let phase = |effects: &dyn Fn() -> Vec<Active>| {
        let frame = |number: usize| {
            let pixels = Pixels { obliquity: vec![1.1], ..row(&[A]) };
            frame_of(pixels, effects(), number)[0]
        };
        (frame(1) - frame(3)).atan2(frame(0) - frame(2))
    };
    let more = phase(&|| make("radial_axial_distance", &[("relative", 0.3)])) - phase(&Vec::new);
    findings.about("phase", more, phase_rad(0.03, 30e6), 1e-9);
}

/// What is seen of the other camera turns with the phase steps, unless the light takes these, and the other way round with the beat; of this camera's own light it falls with the square of the
/// distance.
fn multi_camera_interference(make: Make, findings: &mut Findings) {
    // Two pixels with other light, seen aslant.
    const OBLIQUITY: f64 = 1.1;
    let pixels = || Pixels {
        obliquity: vec![OBLIQUITY; 2],
        ambient_dn: vec![AMBIENT, 2.0 * AMBIENT].into(),
        ..row(&[A, 3.0 * A])
    };
    let forms =
        [("cosine_dn", "sine_dn", FRAC_PI_2), ("without_steps_cosine_dn", "without_steps_sine_dn", 0.0)];
    // Over the root of the mean square.
    let [ambient, own] = [2.5_f64.sqrt(), 5.0_f64.sqrt()];
    let far = OBLIQUITY.powi(-2);
    let ways = [
        (0.0, [1.0, 1.0]),
        (1.0, [1.0 / ambient, 2.0 / ambient]),
        (-0.5, [1.0 / own, 3.0 / own]),
        (-1.0, [far / own, 3.0 * far / own]),
    ];
    for ((cosine, sine, step_rad), (goes_with, shares)) in
        forms.into_iter().flat_map(|form| ways.map(|way| (form, way)))
    {
        for frame in 0..4 {
            let settings = [(cosine, 2.0), (sine, 0.5), ("beat_hz", 3.0), ("goes_with_ambient", goes_with)];
            let with = frame_of(pixels(), make("multi_camera_interference", &settings), frame);
            let without = frame_of(pixels(), Vec::new(), frame);
            let angle = frame as f64 * (step_rad - TAU * 3.0 * PERIOD_S);
            let dn = 2.0 * angle.cos() + 0.5 * angle.sin();
            for ((with, without), share) in with.iter().zip(without).zip(shares) {
                findings.about("a frame, DN", with - without, share * dn, 1e-9);
            }
        }
    }
    // A quarter of the image from its middle, along a row of two, of which the right one has most: a factor of e^0.2 there.
    let settings = [
        ("cosine_dn", 2.0),
        ("beat_hz", 3.0),
        ("rise_along_columns", 1.6),
        ("fall_squared_along_columns", 3.2),
    ];
    let row = still_frame(&[A, A], make("multi_camera_interference", &settings), 0);
    let without = still_frame(&[A, A], Vec::new(), 0);
    for (pixel, side) in [(0, -0.25), (1, 0.25)] {
        let share = f64::exp(1.6 * side - 3.2 * side * side - 0.2);
        findings.about("a spot, DN", row[pixel] - without[pixel], 2.0 * share, 1e-9);
    }
}

type Signature = fn(Make, &mut Findings);
const SIGNATURES: [(&str, Signature); 19] = [
    ("correlation_harmonics", harmonics),
    ("phase_step_scale", phase_step_scale),
    ("phase_step_errors", phase_step_errors),
    ("axial_motion", axial_motion),
    ("inverse_square_falloff", inverse_square_falloff),
    ("lateral_motion", lateral_motion),
    ("frame_gain", frame_gain),
    ("ambient_drift", ambient_drift),
    ("saturation", saturation),
    ("intensity_nonlinearity, quadratic", quadratic),
    ("intensity_nonlinearity, cubic", cubic),
    ("fixed_point", fixed_point),
    ("image_lag", image_lag),
    ("electrical_crosstalk", electrical_crosstalk),
    ("multipath_interference", multipath),
    ("illumination_baseline", illumination_baseline),
    ("frame_timing_error", frame_timing_error),
    ("radial_axial_distance", radial_axial_distance),
    ("multi_camera_interference", multi_camera_interference),
];

fn findings(signature: Signature, make: Make) -> Vec<String> {
    let mut findings = Findings::default();
    signature(make, &mut findings);
    findings.0
}

#[test]
fn effects_show_their_signatures() {
    for (name, signature) in SIGNATURES {
        let found = findings(signature, |name, settings| scaled(1.0, name, settings));
        assert!(found.is_empty(), "{name}: {found:#?}");
    }
}

/// No signature is shown by an effect that does nothing, or that is a third too strong.
#[test]
fn signatures_of_another_size_are_caught() {
    for (name, signature) in SIGNATURES {
        let makes: [Make; 2] =
            [|name, settings| scaled(0.0, name, settings), |name, settings| scaled(1.33, name, settings)];
        for (size, make) in ["none", "a third more"].into_iter().zip(makes) {
            assert!(!findings(signature, make).is_empty(), "{name}, {size}: not caught");
        }
    }
}

/// And those that have a sign show the other one when it is turned.
#[test]
fn signatures_of_the_wrong_sign_are_caught() {
    for (name, signature) in SIGNATURES {
        // Its size alone is known here: both signs are alike.
        if !["saturation", "frame_gain", "ambient_drift", "fixed_point", "electrical_crosstalk"]
            .contains(&name)
            && name != "intensity_nonlinearity, quadratic"
        {
            let found = findings(signature, |name, settings| scaled(-1.0, name, settings));
            assert!(!found.is_empty(), "{name}: not caught");
        }
    }
}

/// An ideal camera of square waves: 72 mrad with four frames, 19.7 mrad with three or the WDFT's five.
#[test]
fn square_waves_make_the_known_error() {
    let triangle = |light: Pulse| Correlation::of_pulses(&light, &Pulse::SQUARE, 30e6, 99).unwrap().0;
    for (name, peak_rad) in [("four_frame", 0.072), ("wdft", 0.0197)] {
        let experiment = Experiment { correlation: triangle(Pulse::SQUARE), ..Experiment::of(name) };
        let peak = experiment.cycles(Vec::new()).peak();
        assert!((peak - peak_rad).abs() < 0.02 * peak_rad, "{name}: {peak}");
    }
    // A duty cycle that is not a half adds even harmonics: three cycles to the WDFT, none to four frames. Edges of 0.24 of a period
    // keep the fourth from cancelling the second.
    let pulse = Pulse { duty: 0.45, ..Pulse::SQUARE };
    let light = Pulse { edge_s: 0.24 / 30e6, ..pulse };
    let both = Correlation::of_pulses(&light, &pulse, 30e6, 99).unwrap().0;
    let of = |name| Experiment { correlation: both.clone(), ..Experiment::of(name) }.cycles(Vec::new());
    let sine = |turns: f64| (TAU / 2.0 * turns).sin();
    let relative = |m: f64| (sine(0.45 * m) / m / sine(0.45)).powi(2) * (sine(0.24 * m) / m / sine(0.24));
    let expected = relative(4.0) - relative(2.0);
    assert!((of("wdft").sin(3) / expected - 1.0).abs() < 0.05, "{} {expected}", of("wdft").sin(3));
    assert!(of("four_frame").size(3) < 1e-9);
}
