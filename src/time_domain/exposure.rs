//! From light to charge to codes, frame after frame.

use super::flaws::{Flaw, Hook, is_emptied};
use super::waveform::Waveform;
use super::world::{Known, Moment, Ray, World};
use crate::recording::Kind;
use crate::units::SPEED_OF_LIGHT_M_S;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Poisson, StandardNormal};
use std::f64::consts::TAU;

/// Frames of all recordings, one after the other: codes before the converter rounds them, DN, `[frame][pixel]`.
pub type Movie = Vec<Vec<f64>>;

/// All frames of `world` with `flaws`. With a `seed` there is noise, and codes are whole and within the converter; without, codes
/// are what they are on average.
pub fn movie(world: &World, known: Known, flaws: &[&Flaw], seed: Option<u64>) -> Movie {
    let waveform = flaws.iter().fold(world.waveform.clone(), |waveform, flaw| match flaw.mechanism.hook {
        Hook::Waveform(change) => change(flaw, &waveform),
        _ => waveform,
    });
    let camera = Exposure { world, known, flaws, waveform: &waveform };
    let mut frames = Vec::new();
    for (number, take) in world.takes.iter().enumerate() {
        let mut random = seed.map(|seed| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(number as u64);
            random
        });
        for set in 0..take.rows.len() {
            let mut before: Option<Vec<f64>> = None;
            for frame in 0..take.steps_rad.len() {
                frames.push(camera.frame(number, set, frame, &mut before, random.as_mut()));
            }
        }
    }
    frames
}

struct Exposure<'a> {
    world: &'a World,
    known: Known,
    flaws: &'a [&'a Flaw],
    waveform: &'a Waveform,
}

impl Exposure<'_> {
    /// One frame's codes; `before` is the charge of the frame before it, and becomes that of this one.
    fn frame(
        &self,
        take: usize,
        set: usize,
        frame: usize,
        before: &mut Option<Vec<f64>>,
        random: Option<&mut ChaCha8Rng>,
    ) -> Vec<f64> {
        let moment = self.moment(take, set, frame, frame as f64);
        let charge = self.charge(&moment);
        let mut image = charge.clone();
        for flaw in self.flaws {
            match flaw.mechanism.hook {
                Hook::Image(change) => change(flaw, &moment, &self.world.scene, &mut image),
                Hook::Lag(change) => {
                    let last = before.get_or_insert_with(|| match is_emptied(flaw) {
                        true => vec![0.0; image.len()],
                        false => self.before_first(take, set),
                    });
                    change(flaw, last, &mut image);
                }
                _ => {}
            }
        }
        *before = Some(charge);
        self.codes(&moment, image, random)
    }

    /// The charge of the frame before a set's first. The camera runs on: its sequencer was at the last step.
    fn before_first(&self, take: usize, set: usize) -> Vec<f64> {
        let last = self.world.takes[take].steps_rad.len() - 1;
        self.charge(&self.moment(take, set, last, -1.0))
    }

    /// Frame `frame` of a set, taken `periods` frame periods after the set's start.
    fn moment(&self, take: usize, set: usize, frame: usize, periods: f64) -> Moment {
        let plan = &self.world.takes[take];
        let row = &plan.rows[set];
        let within_s = periods * plan.period_s;
        let commanded_rad = plan.steps_rad[frame] + row.offset_rad;
        let mut moment = Moment {
            take,
            set,
            frame,
            frames: plan.steps_rad.len(),
            time_s: row.time_s + within_s,
            within_s,
            position_m: row.position_m,
            began_m: row.position_m,
            velocity_m_s: row.velocity_m_s,
            commanded_rad,
            gate_rad: commanded_rad,
            frequency_hz: self.world.frequency_hz,
            light: if plan.kind == Kind::Dark { 0.0 } else { 1.0 },
            ambient: 1.0,
            gain: 1.0,
        };
        for flaw in self.flaws {
            if let Hook::Clock(change) = flaw.mechanism.hook {
                change(flaw, plan, &mut moment);
            }
        }
        moment.position_m += moment.velocity_m_s * moment.within_s;
        moment
    }

    /// Charge of every pixel before anything of the sensor touches it, electrons.
    fn charge(&self, moment: &Moment) -> Vec<f64> {
        let scene = &self.world.scene;
        let way_rad = TAU * moment.frequency_hz * 2.0 / SPEED_OF_LIGHT_M_S;
        let charge = |(number, pixel): (usize, &super::scene::Pixel)| {
            let (row, column) = scene.geometry.row_column(number);
            let place = |position_m: f64| {
                pixel.obliquity * if pixel.sees_target { position_m } else { scene.background_m }
            };
            let range_m = place(if self.known.motion { moment.position_m } else { moment.began_m });
            let bright_m = place(if self.known.falloff { moment.position_m } else { moment.began_m });
            let falloff = 1.0 / (bright_m * bright_m);
            let mut ray = Ray {
                pixel: number,
                column,
                row,
                sees_target: pixel.sees_target,
                range_m,
                amplitude_e: pixel.amplitude_e * falloff,
                constant_e: pixel.constant_e * falloff,
                delay_rad: pixel.delay_rad,
                echo: None,
                extra_e: 0.0,
            };
            for flaw in self.flaws {
                if let Hook::Ray(change) = flaw.mechanism.hook {
                    change(flaw, moment, scene, &mut ray);
                }
            }
            let through = |amplitude_e: f64, range_m: f64| {
                let delay_rad = moment.gate_rad - way_rad * range_m - ray.delay_rad;
                amplitude_e * self.waveform.at(delay_rad)
            };
            let direct_e = through(ray.amplitude_e, ray.range_m) + ray.constant_e;
            let echo_e = ray.echo.map_or(0.0, |(amplitude_e, range_m)| through(amplitude_e, range_m));
            let all_e = moment.light * (direct_e + echo_e) + moment.ambient * pixel.ambient_e + ray.extra_e;
            moment.gain * all_e
        };
        scene.pixels.iter().enumerate().map(charge).collect()
    }

    /// Charge to codes. Photons arrive at random before the well takes them.
    fn codes(&self, moment: &Moment, image: Vec<f64>, mut random: Option<&mut ChaCha8Rng>) -> Vec<f64> {
        let sensor = &self.world.sensor;
        let code = |(pixel, charge_e): (usize, f64)| {
            let mut charge_e = match &mut random {
                Some(random) => poisson(charge_e, random),
                None => charge_e,
            };
            for flaw in self.flaws {
                if let Hook::Response(respond) = flaw.mechanism.hook {
                    charge_e = respond(flaw, self.world, pixel, charge_e);
                }
            }
            if let Some(random) = &mut random {
                let noise: f64 = StandardNormal.sample(*random);
                charge_e += sensor.read_noise_e * noise;
            }
            let mut code = sensor.pedestal_dn + charge_e / sensor.gain_e_per_dn;
            for flaw in self.flaws {
                if let Hook::Code(convert) = flaw.mechanism.hook {
                    code = convert(flaw, moment, self.world, pixel, code);
                }
            }
            if random.is_some() { code.round().clamp(0.0, sensor.full_scale_dn()) } else { code }
        };
        image.into_iter().enumerate().map(code).collect()
    }
}

/// Photons where `mean` are expected.
fn poisson(mean: f64, random: &mut ChaCha8Rng) -> f64 {
    Poisson::new(mean).map_or(mean.max(0.0), |photons| photons.sample(random))
}
