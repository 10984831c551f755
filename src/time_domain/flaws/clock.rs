//! Flaws of time, position and phase.

use super::{Flaw, Hook, Mechanism};
use crate::time_domain::plan::Take;
use crate::time_domain::world::Moment;
use std::f64::consts::TAU;

pub const MECHANISMS: &[Mechanism] = &[
    Mechanism::known("axial_motion", "", 1.0, 1.0, Hook::Unknown, 'b'),
    Mechanism::known("inverse_square_falloff", "", 1.0, 1.0, Hook::Unknown, 'b'),
    Mechanism::known("phase_step_scale", "1", 0.01, 0.3, Hook::Clock(phase_step_scale), 'b'),
    Mechanism::known("phase_step_errors", "rad", 0.01, 0.4, Hook::Clock(phase_step_errors), 'b'),
    Mechanism::known("phase_drift", "rad", 0.01, 1.0, Hook::Clock(phase_drift), 't'),
    Mechanism::known("clock_jitter", "rad", 0.005, 0.3, Hook::Clock(clock_jitter), 'j'),
    Mechanism::known("timing_jitter_of_frames", "s", 5e-4, 5e-3, Hook::Clock(timing_jitter), 'j'),
    Mechanism::known("modulation_frequency_error", "1", 1e-3, 0.05, Hook::Clock(frequency_error), 'e'),
    Mechanism::known("encoder_scale", "1", 1e-3, 0.05, Hook::Clock(encoder_scale), 'e'),
    Mechanism::known("encoder_offset", "m", 5e-3, 0.1, Hook::Clock(encoder_offset), 'e'),
    Mechanism::known("encoder_cyclic", "m", 1e-3, 0.02, Hook::Clock(encoder_cyclic), 'e'),
    Mechanism::known("frame_gain", "1", 0.005, 0.3, Hook::Clock(frame_gain), 'a'),
    Mechanism::known("illumination_droop", "1", 0.01, 0.5, Hook::Clock(illumination_droop), 'a'),
    Mechanism::known("illumination_drift", "1", 0.01, 0.5, Hook::Clock(illumination_drift), 't'),
    Mechanism::known("ambient_drift", "1", 0.05, 3.0, Hook::Clock(ambient_drift), 'a'),
    Mechanism::known("ambient_flicker", "1", 0.02, 0.3, Hook::Clock(ambient_flicker), 'a'),
];

/// The phase shifter's steps are longer than commanded; the offset is another register's.
fn phase_step_scale(flaw: &Flaw, plan: &Take, moment: &mut Moment) {
    moment.gate_rad += flaw.sign(0) * flaw.size * plan.steps_rad[moment.frame];
}

/// Each step of a sequence has an error of its own.
fn phase_step_errors(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    moment.gate_rad += flaw.size * flaw.normal(0, moment.frames, moment.frame);
}

/// Time constant of a phase drift, s.
pub fn phase_warm_up_s(flaw: &Flaw) -> f64 {
    flaw.draw(1, 5.0, 40.0)
}

/// The laser driver warms up after the start of each recording.
fn phase_drift(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let time_constant_s = phase_warm_up_s(flaw);
    moment.gate_rad += flaw.sign(0) * flaw.size * (1.0 - (-moment.time_s / time_constant_s).exp());
}

/// The clock's phase, from frame to frame.
fn clock_jitter(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    moment.gate_rad += flaw.size * flaw.normal(moment.take, moment.set, moment.frame);
}

/// Frames do not begin when they should.
fn timing_jitter(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    moment.within_s += flaw.size * flaw.normal(moment.take, moment.set, moment.frame);
}

fn frequency_error(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    moment.frequency_hz *= 1.0 + flaw.sign(0) * flaw.size;
}

/// The reading is too large or too small by a factor: the target is elsewhere.
fn encoder_scale(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let factor = 1.0 + flaw.sign(0) * flaw.size;
    moment.position_m /= factor;
    moment.began_m /= factor;
    moment.velocity_m_s /= factor;
}

/// The reading's zero is not the camera: the target is nearer or farther by a constant.
fn encoder_offset(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let offset_m = flaw.sign(0) * flaw.size;
    moment.position_m += offset_m;
    moment.began_m += offset_m;
}

/// The reading is off by a wave over the position, as from an eccentric wheel.
fn encoder_cyclic(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let pitch_m = flaw.draw(0, 0.15, 0.6);
    let wave = |position_m: f64| flaw.size * (TAU * (position_m / pitch_m + flaw.draws[1])).sin();
    let velocity = 1.0 - flaw.size * TAU / pitch_m * (TAU * (moment.began_m / pitch_m + flaw.draws[1])).cos();
    moment.position_m -= wave(moment.position_m);
    moment.began_m = moment.position_m;
    moment.velocity_m_s *= velocity;
}

/// Each frame of a sequence has a gain of its own, of all that it sees; or of the laser alone, whose driver knows the step.
fn frame_gain(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let factor = 1.0 + flaw.size * flaw.normal(0, moment.frames, moment.frame);
    let of = if flaw.draws[7] < 0.7 { &mut moment.gain } else { &mut moment.light };
    *of *= factor;
}

/// The laser's power sags after the start of each set, as its capacitor is drained.
fn illumination_droop(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let time_constant_s = flaw.draw(0, 0.05, 0.3);
    moment.light *= 1.0 - flaw.size * (1.0 - (-moment.within_s.max(0.0) / time_constant_s).exp());
}

/// Time constant of an illumination drift, s; none where it goes on evenly.
pub fn light_warm_up_s(flaw: &Flaw) -> Option<f64> {
    (flaw.draws[7] < 0.5).then(|| flaw.draw(0, 8.0, 60.0))
}

/// The laser's power falls as it warms up after the start of each recording, or evenly, a share in each minute.
fn illumination_drift(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let share = match light_warm_up_s(flaw) {
        Some(time_constant_s) => 1.0 - (-moment.time_s / time_constant_s).exp(),
        None => moment.time_s / 60.0,
    };
    moment.light *= (1.0 - flaw.size * share).max(0.0);
}

/// Whether a change of the ambient light begins anew with every set.
pub fn begins_anew(flaw: &Flaw) -> bool {
    flaw.draws[7] >= 0.7
}

/// Ambient light changes by its size in so long a time, s.
pub fn ambient_drift_s(flaw: &Flaw) -> f64 {
    if begins_anew(flaw) { 1.5 } else { 60.0 }
}

/// Daylight changes steadily, by its size in a minute; or what is taken for it in every set anew.
fn ambient_drift(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let passed_s = if begins_anew(flaw) { moment.within_s.max(0.0) } else { moment.time_s };
    moment.ambient *= (1.0 + flaw.sign(0) * flaw.size * passed_s / ambient_drift_s(flaw)).max(0.0);
}

/// Frequency of a flicker, Hz, and its phase at the start of a recording, rad.
pub fn flicker(flaw: &Flaw) -> (f64, f64) {
    let mains_hz = if flaw.draws[0] < 0.6 { 50.0 } else { 60.0 } + flaw.draw(1, -0.05, 0.05);
    (2.0 * mains_hz, TAU * flaw.draws[2])
}

/// A lamp on a mains of 50 or 60 Hz that is not quite at its frequency.
fn ambient_flicker(flaw: &Flaw, _: &Take, moment: &mut Moment) {
    let (frequency_hz, phase_rad) = flicker(flaw);
    moment.ambient *= 1.0 + flaw.size * (TAU * frequency_hz * moment.time_s + phase_rad).cos();
}
