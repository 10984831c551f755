//! A raw frame as it comes into being, from the encoder's reading to the code.
//!
//! All charges are in DN above the pedestal: electrons over the gain. Arrays have one entry a pixel, row by row.

use super::correlation::{Correlation, Waveform};
use super::per_pixel::PerPixel;
use super::pixels::Pixels;
use crate::frames::Geometry;
use crate::units::phase_rad;
use crate::widest::widest;
use std::sync::Arc;

/// When and how one raw frame is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Set within the recording, from 0.
    pub set: usize,
    /// Frame within the set, from 0.
    pub frame: usize,
    /// Frames a set.
    pub frames: usize,
    /// Start of the frame, s, from the start of the recording.
    pub time_s: f64,
    /// Start of the frame, s, from the start of its set.
    pub in_set_s: f64,
    /// From the start of a frame to the start of the next within a set, s.
    pub frame_period_s: f64,
    /// The phase step that was commanded, without the set's offset, rad.
    pub step_rad: f64,
    /// The set's phase offset, rad.
    pub offset_rad: f64,
    /// The encoder's reading at the set's start, m.
    pub position_m: f64,
    /// The same without its noise, as far as that is known, m: the mean of the readings where the target stands still.
    pub place_m: f64,
    /// The carriage's commanded velocity, m/s, positive away from the camera.
    pub velocity_m_s: f64,
    /// Modulation frequency that was commanded, Hz.
    pub frequency_hz: f64,
    /// Whether the camera's own light is on.
    pub lit: bool,
    /// Share of all light that comes through what is before the lens: 1 where nothing is, 0 where it is covered.
    pub transmission: f64,
}

impl Moment {
    /// Where the target is at the frame's start by the encoder's reading and the commanded velocity, m.
    pub fn commanded_m(&self) -> f64 {
        self.position_m + self.velocity_m_s * self.in_set_s
    }

    /// The frame before frame number `index` of those that `moment` gives. Before a set's first one it is the one that a camera
    /// takes then which runs on evenly, that of a camera which takes the same steps set after set, and that of one which rests between sets:
    /// the set before's last one, wherever the target was then (of a recording's first set, its own last step).
    pub fn before(index: usize, moment: impl Fn(usize) -> Self) -> [Self; 3] {
        let first = moment(index);
        if first.frame > 0 {
            return [moment(index - 1); 3];
        }
        let (second, last) = (index + usize::from(first.frames > 1), index + first.frames.max(1) - 1);
        let evenly = Self { step_rad: 2.0 * first.step_rad - moment(second).step_rad, ..first };
        let [evenly, again] = [evenly, moment(last)].map(|frame| Self {
            in_set_s: first.in_set_s - first.frame_period_s,
            time_s: first.time_s - first.frame_period_s,
            ..frame
        });
        [evenly, again, index.checked_sub(1).map_or(again, moment)]
    }
}

/// What the baseline takes into account of a target that moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Included {
    /// The phase follows the recorded velocity from frame to frame.
    pub axial_motion: bool,
    /// The light falls off during a set as the target moves.
    pub inverse_square_falloff: bool,
}

/// What light brought to the pixels in the frame before, DN.
#[derive(Debug, Clone)]
pub struct Before {
    /// In a camera that runs on evenly from set to set.
    pub evenly_dn: PerPixel,
    /// In a camera that takes the same steps set after set.
    pub again_dn: PerPixel,
    /// In a camera that rests between sets.
    pub kept_dn: PerPixel,
    /// How long that one has rested since, s: 0 where the frames come one frame period after the other.
    pub rested_s: f64,
}

/// A frame in the making. Effects change what stands here when their place comes.
#[derive(Debug, Clone)]
pub struct Exposure {
    /// When and how it is taken; effects do not change this.
    pub moment: Moment,
    /// The pixels.
    pub pixels: Arc<Pixels>,
    /// What the baseline takes into account.
    pub included: Included,
    /// The target's true position at the set's start, m.
    pub position_m: f64,
    /// The target's velocity, m/s.
    pub velocity_m_s: f64,
    /// Start of the frame, s, from the start of its set, as it truly is.
    pub in_set_s: f64,
    /// From the start of the first row to that of the one after the last, s: 0 where all rows begin at once.
    pub over_rows_s: f64,
    /// Share of the way since the set's start that the phase has followed: 1 where axial motion is modelled.
    pub motion_share: f64,
    /// The same of the light's falloff.
    pub falloff_share: f64,
    /// Modulation frequency, Hz.
    pub frequency_hz: f64,
    /// Phase of the demodulation against the light: step and offset, rad.
    pub angle_rad: f64,
    /// Radial range, m.
    pub range_m: PerPixel,
    /// Phase, rad: of the range, and the pixel's own.
    pub phase_rad: PerPixel,
    /// Amplitude of the fundamental, DN.
    pub amplitude_dn: PerPixel,
    /// The constant part of the camera's own light, DN.
    pub constant_dn: PerPixel,
    /// Ambient light, DN.
    pub ambient_dn: PerPixel,
    /// The correlation waveform.
    pub correlation: Correlation,
    /// Charge above the pedestal, DN.
    pub signal_dn: PerPixel,
    /// What light brought to the pixels, DN, before charge went anywhere.
    pub arrived_dn: PerPixel,
    /// The same of the frame before; nothing where there was none.
    pub before: Option<Arc<Before>>,
    /// The waveform at the pixels' phases, as it was looked up last: it is looked up again only where something has changed.
    pub waveform: Option<Arc<Waveform>>,
    /// The same of light that came by other ways.
    pub paths: Arc<Vec<Arc<Waveform>>>,
    /// Draws from the standard normal distribution for this frame, one for each of the chain's effects.
    pub deviates: Vec<f64>,
    /// That of the effect that acts just now; 0 where there is none.
    pub deviate: f64,
    /// Whether noise comes after this, and codes are made of the sum.
    pub noisy: bool,
    /// Draws for its pixels, where an effect needs them.
    pub pixel_deviates: Vec<f64>,
}

impl Exposure {
    /// A frame of which only the moment is known.
    pub fn new(moment: Moment, pixels: &Arc<Pixels>, included: Included, correlation: &Correlation) -> Self {
        Self {
            moment,
            pixels: Arc::clone(pixels),
            included,
            position_m: moment.position_m,
            velocity_m_s: moment.velocity_m_s,
            in_set_s: moment.in_set_s,
            over_rows_s: 0.0,
            motion_share: f64::from(u8::from(included.axial_motion)),
            falloff_share: f64::from(u8::from(included.inverse_square_falloff)),
            frequency_hz: moment.frequency_hz,
            angle_rad: moment.offset_rad + moment.step_rad,
            range_m: PerPixel::default(),
            phase_rad: PerPixel::default(),
            amplitude_dn: PerPixel::default(),
            constant_dn: PerPixel::default(),
            ambient_dn: PerPixel::default(),
            correlation: correlation.clone(),
            signal_dn: PerPixel::default(),
            arrived_dn: PerPixel::default(),
            before: None,
            waveform: None,
            paths: Arc::default(),
            deviates: Vec::new(),
            deviate: 0.0,
            noisy: false,
            pixel_deviates: Vec::new(),
        }
    }

    /// Whether `other` stands where this one stands: what effects change is the same in both.
    pub fn stands_as(&self, other: &Self) -> bool {
        self.scalars() == other.scalars() && self.arrays_stand_as(other)
    }

    /// Numbers of a frame that effects change.
    pub const SCALARS: usize = 8;

    /// Those numbers.
    pub fn scalars(&self) -> [f64; Self::SCALARS] {
        [
            self.position_m,
            self.velocity_m_s,
            self.in_set_s,
            self.motion_share,
            self.falloff_share,
            self.frequency_hz,
            self.angle_rad,
            self.over_rows_s,
        ]
    }

    /// The same in the same order, to be changed.
    pub fn scalars_mut(&mut self) -> [&mut f64; Self::SCALARS] {
        [
            &mut self.position_m,
            &mut self.velocity_m_s,
            &mut self.in_set_s,
            &mut self.motion_share,
            &mut self.falloff_share,
            &mut self.frequency_hz,
            &mut self.angle_rad,
            &mut self.over_rows_s,
        ]
    }

    /// Whether everything else that effects change is the same in both.
    pub fn arrays_stand_as(&self, other: &Self) -> bool {
        self.is_lit_as(other) && self.stands_as_but_for_light(other)
    }

    /// The same of everything but light, and those numbers.
    pub fn stands_as_but_for_light(&self, other: &Self) -> bool {
        self.looks_as(other) && self.signal_dn == other.signal_dn
    }

    /// The same of everything but charge.
    pub fn stands_as_but_for_charge(&self, other: &Self) -> bool {
        self.scalars() == other.scalars() && self.is_lit_as(other) && self.looks_as(other)
    }

    fn is_lit_as(&self, other: &Self) -> bool {
        self.amplitude_dn == other.amplitude_dn
            && self.constant_dn == other.constant_dn
            && self.ambient_dn == other.ambient_dn
    }

    fn looks_as(&self, other: &Self) -> bool {
        self.range_m == other.range_m
            && self.phase_rad == other.phase_rad
            && self.correlation == other.correlation
    }

    /// The target's way since the set's start, m.
    pub fn way_m(&self) -> f64 {
        self.velocity_m_s * self.in_set_s
    }

    /// When the frame is really taken, s: an error of the frames' times moves it from when the camera says.
    pub fn taken_s(&self) -> f64 {
        self.moment.time_s - self.moment.in_set_s + self.in_set_s
    }

    /// By how much the target has moved farther, m, when the last row begins than when the first one does, if all of the way since the set's start
    /// counts.
    fn way_over_rows_m(&self) -> f64 {
        self.velocity_m_s * self.over_rows_s
    }

    /// Ranges and phases from position and motion.
    pub fn look(&mut self) {
        let position_m = self.position_m + self.motion_share * self.way_m();
        let over_rows_m = self.motion_share * self.way_over_rows_m();
        let (pixels, frequency_hz) = (&*self.pixels, self.frequency_hz);
        let (mut ranges, mut phases) = (vec![0.0; pixels.count()], vec![0.0; pixels.count()]);
        // What was commanded says which frequency it is, however far that is off.
        let (times, all_rad) = pixels.own_phase_at(self.moment.frequency_hz);
        let (ranges_m, phases_rad) = (&mut ranges[..], &mut phases[..]);
        widest!((pixels: &'a Pixels, position_m: f64, over_rows_m: f64, frequency_hz: f64,
                 times: f64, all_rad: f64, ranges_m: &'a mut [f64], phases_rad: &'a mut [f64]) {
            fill_ranges_m(pixels, position_m, over_rows_m, ranges_m);
            for ((phase, range_m), own_rad) in phases_rad.iter_mut().zip(ranges_m).zip(&pixels.phase_rad) {
                *phase = phase_rad(*range_m, frequency_hz) + (times * own_rad + all_rad);
            }
        });
        (self.range_m, self.phase_rad) = (ranges.into(), phases.into());
    }

    /// Light from ranges: the camera's own falls with the square of the range, ambient light does not.
    pub fn light(&mut self) {
        let position_m = self.position_m + self.falloff_share * self.way_m();
        let over_rows_m = self.falloff_share * self.way_over_rows_m();
        let Moment { lit, transmission, .. } = self.moment;
        let (pixels, lit) = (&*self.pixels, transmission * f64::from(u8::from(lit)));
        let (mut amplitudes, mut constants) = (vec![0.0; pixels.count()], vec![0.0; pixels.count()]);
        let (amplitude_dn, constant_dn) = (&mut amplitudes[..], &mut constants[..]);
        widest!((pixels: &'a Pixels, position_m: f64, over_rows_m: f64, lit: f64,
                 amplitude_dn: &'a mut [f64], constant_dn: &'a mut [f64]) {
            // Ranges stand first where amplitudes will.
            fill_ranges_m(pixels, position_m, over_rows_m, amplitude_dn);
            let own = pixels.amplitude_1m_dn.iter().zip(&pixels.constant_1m_dn);
            let light = amplitude_dn.iter_mut().zip(constant_dn);
            for ((amplitude, constant), (amplitude_1m, constant_1m)) in light.zip(own) {
                let range_m = *amplitude;
                let share = lit / (range_m * range_m);
                *amplitude = amplitude_1m * share;
                *constant = constant_1m * share;
            }
        });
        (self.amplitude_dn, self.constant_dn) = (amplitudes.into(), constants.into());
        self.ambient_dn = pixels.ambient_dn.clone();
        if transmission != 1.0 {
            self.ambient_dn.iter_mut().for_each(|light| *light *= transmission);
        }
    }

    /// Charge from light: amplitude times waveform, and what is constant.
    pub fn correlate(&mut self) {
        let (correlation, phase_rad, angle_rad) = (&self.correlation, &self.phase_rad, self.angle_rad);
        let waveform = match self.waveform.take() {
            Some(known) if known.is_of(correlation, phase_rad, angle_rad) => known,
            known => {
                let further = known.and_then(|known| known.with_more(correlation, phase_rad, angle_rad));
                Arc::new(further.unwrap_or_else(|| Waveform::of(correlation, phase_rad, angle_rad)))
            }
        };
        let mut signals = vec![0.0; self.amplitude_dn.len()];
        {
            let (signals, relative) = (&mut signals[..], waveform.relative());
            let (own, ambient, amplitude) = (&*self.constant_dn, &*self.ambient_dn, &*self.amplitude_dn);
            widest!((signals: &'a mut [f64], own: &'a [f64], ambient: &'a [f64],
                     amplitude: &'a [f64], relative: &'a [f64]) {
                let parts = own.iter().zip(ambient).zip(amplitude.iter().zip(relative));
                for (signal, ((own, ambient), (dn, relative))) in signals.iter_mut().zip(parts) {
                    *signal = own + ambient + dn * relative;
                }
            });
        }
        self.signal_dn = signals.into();
        self.waveform = Some(waveform);
    }

    /// The camera's own light times `factor`.
    pub fn scale_light(&mut self, factor: f64) {
        let own = self.amplitude_dn.iter_mut().chain(&mut self.constant_dn);
        own.for_each(|light| *light *= factor);
    }

    /// Adds light that comes by another way: `amplitude_dn` and `phase_rad` a pixel, with the same waveform.
    pub fn add_path(&mut self, amplitude_dn: &[f64], phase_rad: &PerPixel) {
        let is_it = |known: &&Arc<Waveform>| known.is_of(&self.correlation, phase_rad, self.angle_rad);
        let known = self.paths.iter().find(is_it).cloned();
        let path = known.unwrap_or_else(|| {
            let path = Arc::new(Waveform::of(&self.correlation, phase_rad, self.angle_rad));
            Arc::make_mut(&mut self.paths).push(Arc::clone(&path));
            path
        });
        for ((sum, amplitude), relative) in self.signal_dn.iter_mut().zip(amplitude_dn).zip(path.relative()) {
            *sum += amplitude * relative;
        }
    }
}

/// Radial ranges where the target is at `position_m`, m, when the first row begins, and `over_rows_m` farther after the last one.
#[inline(always)]
fn fill_ranges_m(pixels: &Pixels, position_m: f64, over_rows_m: f64, ranges_m: &mut [f64]) {
    let places = pixels.target.iter().zip(&pixels.obliquity).zip(&pixels.background_m);
    for (range_m, ((&target, obliquity), &background_m)) in ranges_m.iter_mut().zip(places) {
        *range_m = if target { position_m * obliquity } else { background_m };
    }
    if over_rows_m != 0.0 {
        let Geometry { width, height } = pixels.geometry;
        let targets = pixels.target.chunks(width).zip(pixels.obliquity.chunks(width));
        for (row, (ranges_m, (target, obliquity))) in ranges_m.chunks_mut(width).zip(targets).enumerate() {
            let way_m = over_rows_m * row as f64 / height as f64;
            for (range_m, (&target, obliquity)) in ranges_m.iter_mut().zip(target.iter().zip(obliquity)) {
                *range_m += if target { way_m * obliquity } else { 0.0 };
            }
        }
    }
}
