//! Tangents of the forward model: what each fitted number changes in every sample, by the model itself.

use super::acting::Acting;
use super::data::Data;
use super::patterns::{Patterns, difference};
use super::pieces::{Piece, active};
use crate::bench::chain;
use crate::physics::{Active, Chain, Exposure, Memory, Moment, PerPixel, Pixels, Place};
use std::sync::Arc;

/// The numbers of a pixel that are fitted beside everything else: amplitude at 1 m, phase, constant light at 1 m, ambient light.
pub const OWN: usize = 4;

/// These numbers of all pixels.
pub fn own_values(pixels: &Pixels) -> [&[f64]; OWN] {
    [&pixels.amplitude_1m_dn, &pixels.phase_rad, &pixels.constant_1m_dn, &pixels.ambient_dn]
}

/// The same, to be changed.
pub fn own_values_mut(pixels: &mut Pixels) -> [&mut [f64]; OWN] {
    [&mut pixels.amplitude_1m_dn, &mut pixels.phase_rad, &mut pixels.constant_1m_dn, &mut pixels.ambient_dn]
}

/// A column: one fitted number.
#[derive(Debug, Clone)]
pub struct Column {
    /// The piece, among those that were given.
    pub piece: usize,
    /// Its parameter.
    pub parameter: usize,
}

/// How a column differs from the base, and over what the difference is divided.
enum Change {
    /// Another chain, which differs from a place on.
    Chain { chain: Box<Chain>, step: f64, place: Place },
    /// One more effect, by a small step or a finite one.
    More { effect: Active, step: f64, is_finite: bool },
}

/// The chains of one recording: the base, and one for each difference from it.
struct Chains {
    base: Chain,
    /// By the pixels' own numbers, with the step, and the last place before which none of them matters.
    own: [(Chain, f64, Place); OWN],
    /// By what each column differs; nothing where it does not act.
    columns: Vec<Option<Change>>,
    /// Whether a column needs the frame before.
    looks_back: bool,
}

/// The forward model around a base, with its tangents.
pub struct Tangents<'a> {
    data: &'a Data,
    chains: Vec<Chains>,
    count: usize,
}

/// What one frame gives.
pub struct Frame {
    /// The base's signal, DN.
    pub base: PerPixel,
    /// Tangents by the pixel's own numbers, `[number][pixel]`.
    pub own: [Vec<f64>; OWN],
    /// Ambient light, DN.
    pub ambient: PerPixel,
    /// By the target's position, DN a metre.
    pub position: Vec<f64>,
    /// Tangents of the columns that act in this frame.
    pub columns: Acting,
    /// Number of columns, those that do not act here among them.
    pub count: usize,
}

/// Step of the numerical tangents, relative to a number's usual size.
const STEP: f64 = 1e-3;
/// The same for shapes, which may be less than is usual: a frequency may be multiplied by a long time.
const SHAPE_STEP: f64 = 1e-6;
const POSITION_STEP_M: f64 = 1e-6;
/// Steps of a pixel's own numbers, in their units.
const OWN_STEPS: [f64; OWN] = [0.1, 1e-4, 0.1, 0.1];

fn own_pixels(pixels: &Pixels, number: usize) -> (Pixels, f64) {
    let (mut changed, step) = (pixels.clone(), OWN_STEPS[number]);
    own_values_mut(&mut changed)[number].iter_mut().for_each(|value| *value += step);
    (changed, step)
}

impl<'a> Tangents<'a> {
    /// The model of `data` with `pixels` and the effects `fitted`; columns for every free number of `fitted` and of `tried`, in this
    /// order.
    pub fn new(
        data: &'a Data,
        pixels: &Arc<Pixels>,
        fitted: &[Piece],
        tried: &[Piece],
    ) -> (Self, Vec<Column>) {
        let mut columns = Vec::new();
        for (number, piece) in fitted.iter().chain(tried).enumerate() {
            columns.extend(piece.free.iter().map(|&parameter| Column { piece: number, parameter }));
        }
        let chains = (0..data.takes.len()).map(|take| {
            let effects = active(fitted, take);
            let with = |pixels: Arc<Pixels>, mut effects: Vec<Active>| {
                effects.extend(data.takes[take].included.iter().cloned());
                chain(&data.camera, pixels, effects)
            };
            let own = [0, 1, 2, 3].map(|number| {
                let (changed, step) = own_pixels(pixels, number);
                let place = if number == 1 { Place::Clock } else { Place::Path };
                (with(Arc::new(changed), effects.clone()), step, place)
            });
            let of = |column: &Column| {
                let piece = fitted.iter().chain(tried).nth(column.piece)?;
                if !piece.takes.contains(&take) {
                    return None;
                }
                let is_fitted = column.piece < fitted.len();
                let mut changed = effects.clone();
                let parameter = &piece.effect.parameters[column.parameter];
                let (values, step) = if piece.finite && !is_fitted {
                    (piece.values.clone(), piece.values[column.parameter] - parameter.off)
                } else {
                    let mut values = piece.values.clone();
                    // Away from a bound, and from off.
                    let (low, high) = piece.bounds_within(column.parameter, f64::INFINITY);
                    let (value, step) = (values[column.parameter], STEP * parameter.typical);
                    let is_beyond = !parameter.is_shape() && value < parameter.off && value - step >= low;
                    let towards = if value >= high || is_beyond { -1.0 } else { 1.0 };
                    let step = towards
                        * match parameter.is_shape() {
                            true => SHAPE_STEP * parameter.typical.min(values[column.parameter].abs()),
                            false => step,
                        };
                    values[column.parameter] += step;
                    (values, step)
                };
                if is_fitted {
                    let place =
                        fitted[..column.piece].iter().filter(|piece| piece.takes.contains(&take)).count();
                    changed[place].values = values;
                    let chain = Box::new(with(Arc::clone(pixels), changed));
                    Some(Change::Chain { chain, step, place: piece.effect.place })
                } else {
                    let effect = Active { effect: piece.effect, values };
                    Some(Change::More { effect, step, is_finite: piece.finite })
                }
            };
            let columns: Vec<Option<Change>> = columns.iter().map(of).collect();
            let looks_back = columns.iter().any(
                |change| matches!(change, Some(Change::More { effect, .. }) if effect.effect.looks_back),
            );
            Chains { base: with(Arc::clone(pixels), effects.clone()), own, columns, looks_back }
        });
        let chains = chains.collect();
        (Self { data, chains, count: columns.len() }, columns)
    }

    /// The base's signal alone, DN.
    pub fn base(&self, take: usize, index: usize) -> PerPixel {
        let moments = &self.data.takes[take].moments;
        let before = Moment::before(index, |index| moments[index]);
        expose(&self.chains[take].base, moments[index], before, Memory::default()).signal_dn
    }

    /// The charge that is read out, DN, and what the read-out makes of one more DN of it; nothing where it leaves charge as it is.
    pub fn read_out(&self, take: usize, index: usize) -> Option<(PerPixel, Vec<f64>)> {
        let chain = &self.chains[take].base;
        if chain.effects().iter().all(|active| active.effect.place != Place::Readout) {
            return None;
        }
        let moments = &self.data.takes[take].moments;
        let before = Moment::before(index, |index| moments[index]);
        let stations = chain.stations(&begun(chain, moments[index], before, Memory::default()));
        let charge = &stations[Place::Charge as usize];
        let mut more = charge.clone();
        more.signal_dn.iter_mut().for_each(|charge| *charge += 1.0);
        chain.resume(&mut more, Place::Charge);
        let end = &stations[Place::Readout as usize].signal_dn;
        Some((charge.signal_dn.clone(), difference(&more.signal_dn, end, 1.0)))
    }

    /// Frame number `index` of recording `take`.
    pub fn frame(&self, take: usize, index: usize) -> Frame {
        let moments = &self.data.takes[take].moments;
        let moment = moments[index];
        let chains = &self.chains[take];
        let before = Moment::before(index, |index| moments[index]);
        let looks_back = chains.looks_back || chains.base.looks_back();
        let remembered = looks_back.then(|| chains.base.remember(before, &[]));
        let mut start = chains.base.begin(moment, Memory { before: remembered, ..Memory::default() });
        let mut stations = chains.base.stations(&start);
        let end = &stations[Place::Readout as usize];
        let base = end.signal_dn.clone();
        // Most of what is tried leaves the phases as they are.
        let memory = Memory { waveform: end.waveform.clone(), paths: end.paths.clone(), ..Memory::default() };
        for exposure in stations.iter_mut().chain([&mut start]) {
            (exposure.waveform, exposure.paths) = (memory.waveform.clone(), memory.paths.clone());
        }
        let expose = |chain: &Chain, moment| expose(chain, moment, before, memory.clone()).signal_dn;
        let ambient = chains.base.pixels.ambient_dn.clone();
        let moved = Moment { position_m: moment.position_m + POSITION_STEP_M, ..moment };
        let position = difference(&expose(&chains.base, moved), &base, POSITION_STEP_M);
        let of_own = |(chain, step, place): &(Chain, f64, Place)| {
            // What was in the frame before depends on these numbers, too.
            if chain.looks_back() {
                return difference(&expose(chain, moment), &base, *step);
            }
            let mut exposure = stations[*place as usize].clone();
            exposure.pixels = Arc::clone(&chain.pixels);
            chain.resume(&mut exposure, *place);
            difference(&exposure.signal_dn, &base, *step)
        };
        let own = chains.own.each_ref().map(of_own);
        let mut patterns = Patterns::new(&chains.base, &base, start, stations);
        for (number, change) in chains.columns.iter().enumerate() {
            match change {
                // What was in the frame before may depend on this number, too.
                Some(Change::Chain { chain, step, .. }) if chain.looks_back() => {
                    patterns.acting.column(number, difference(&expose(chain, moment), &base, *step));
                }
                Some(Change::Chain { chain, step, place }) => patterns.other(number, chain, *step, *place),
                Some(Change::More { effect, step, is_finite }) => {
                    patterns.more(number, effect, *step, *is_finite);
                }
                None => {}
            }
        }
        let columns = patterns.acting;
        Frame { base, own, ambient, position, columns, count: self.count }
    }

    /// Number of columns.
    pub fn count(&self) -> usize {
        self.count
    }
}

/// The frame of `chain` at `moment`, after one of the frames `before`, with what is at hand in `memory`.
fn expose(chain: &Chain, moment: Moment, before: [Moment; 3], memory: Memory) -> Exposure {
    let mut exposure = begun(chain, moment, before, memory);
    chain.run(&mut exposure, Place::Encoder);
    exposure
}

/// The same before it has come to any place.
fn begun(chain: &Chain, moment: Moment, before: [Moment; 3], memory: Memory) -> Exposure {
    let before = chain.looks_back().then(|| chain.remember(before, &[]));
    chain.begin(moment, Memory { before, ..memory })
}
