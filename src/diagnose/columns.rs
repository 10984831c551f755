//! Tangents of the forward model: what each fitted number changes in every sample, by the model itself.

use super::data::Data;
use super::pieces::{Piece, active};
use crate::bench::chain;
use crate::physics::{Active, Chain, Exposure, Memory, Moment, PerPixel, Pixels, Waveform};
use std::sync::Arc;

/// The numbers of a pixel that are fitted beside everything else: amplitude at 1 m, phase, constant light at 1 m, ambient light.
pub const OWN: usize = 4;

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
    /// Another chain.
    Chain(Box<Chain>, f64),
    /// One more effect.
    More(Active, f64),
}

/// The chains of one recording: the base, and one for each difference from it.
struct Chains {
    base: Chain,
    own: [(Chain, f64); OWN],
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
    /// Tangents of the columns; empty where a column does not act in this recording.
    pub columns: Vec<Vec<f64>>,
}

/// Step of the numerical tangents, relative to a number's usual size.
const STEP: f64 = 1e-3;
/// The same for shapes, which may be less than is usual: a frequency may be multiplied by a long time.
const SHAPE_STEP: f64 = 1e-6;
const POSITION_STEP_M: f64 = 1e-6;

fn own_pixels(pixels: &Pixels, number: usize) -> (Pixels, f64) {
    let mut changed = pixels.clone();
    let (values, step): (&mut [f64], f64) = match number {
        0 => (&mut changed.amplitude_1m_dn, 0.1),
        1 => (&mut changed.phase_rad, 1e-4),
        2 => (&mut changed.constant_1m_dn, 0.1),
        _ => (&mut changed.ambient_dn, 0.1),
    };
    values.iter_mut().for_each(|value| *value += step);
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
                (with(Arc::new(changed), effects.clone()), step)
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
                    // Away from a bound.
                    let towards = if values[column.parameter] >= parameter.bounds.1 { -1.0 } else { 1.0 };
                    let step = towards
                        * match parameter.is_shape() {
                            true => SHAPE_STEP * parameter.typical.min(values[column.parameter].abs()),
                            false => STEP * parameter.typical,
                        };
                    values[column.parameter] += step;
                    (values, step)
                };
                if is_fitted {
                    let place =
                        fitted[..column.piece].iter().filter(|piece| piece.takes.contains(&take)).count();
                    changed[place].values = values;
                    Some(Change::Chain(Box::new(with(Arc::clone(pixels), changed)), step))
                } else {
                    Some(Change::More(Active { effect: piece.effect, values }, step))
                }
            };
            let columns: Vec<Option<Change>> = columns.iter().map(of).collect();
            let looks_back = columns
                .iter()
                .any(|change| matches!(change, Some(Change::More(more, _)) if more.effect.looks_back));
            Chains { base: with(Arc::clone(pixels), effects.clone()), own, columns, looks_back }
        });
        let chains = chains.collect();
        (Self { data, chains, count: columns.len() }, columns)
    }

    /// The base's signal alone, DN.
    pub fn base(&self, take: usize, index: usize) -> PerPixel {
        let moments = &self.data.takes[take].moments;
        expose(&self.chains[take].base, moments[index], Moment::before(index, |index| moments[index]), None)
            .signal_dn
    }

    /// Frame number `index` of recording `take`.
    pub fn frame(&self, take: usize, index: usize) -> Frame {
        let moments = &self.data.takes[take].moments;
        let moment = moments[index];
        let chains = &self.chains[take];
        let before = Moment::before(index, |index| moments[index]);
        let Exposure { signal_dn: base, waveform, .. } = expose(&chains.base, moment, before, None);
        // Most of what is tried leaves the phases as they are.
        let expose = |chain, moment| expose(chain, moment, before, waveform.clone()).signal_dn;
        let ambient = chains.base.pixels.ambient_dn.clone();
        let difference = |signal: PerPixel, step: f64| -> Vec<f64> {
            signal.iter().zip(&base).map(|(changed, base)| (changed - base) / step).collect()
        };
        let moved = Moment { position_m: moment.position_m + POSITION_STEP_M, ..moment };
        let position = difference(expose(&chains.base, moved), POSITION_STEP_M);
        let own = chains.own.each_ref().map(|(chain, step)| difference(expose(chain, moment), *step));
        let stations = if chains.columns.iter().any(|change| matches!(change, Some(Change::More(..)))) {
            let looks_back = chains.looks_back || chains.base.looks_back();
            let before = looks_back.then(|| chains.base.remember(before, &[]));
            chains.base.stations(moment, Memory { before, waveform: waveform.clone(), ..Memory::default() })
        } else {
            Vec::new()
        };
        let columns = chains.columns.iter().map(|change| match change {
            Some(Change::Chain(chain, step)) => difference(expose(chain, moment), *step),
            Some(Change::More(more, step)) => {
                let station = &stations[more.effect.place as usize];
                let mut exposure = station.clone();
                more.effect.act_on(&more.values, &mut exposure);
                if exposure.stands_as(station) {
                    return Vec::new();
                }
                chains.base.resume(&mut exposure, more.effect.place);
                difference(exposure.signal_dn, *step)
            }
            None => Vec::new(),
        });
        let columns = columns.collect();
        Frame { base, own, ambient, position, columns }
    }

    /// Number of columns.
    pub fn count(&self) -> usize {
        self.count
    }
}

/// The frame of `chain` at `moment`, after one of the frames `before`, with the `waveform` where it is at hand.
fn expose(chain: &Chain, moment: Moment, before: [Moment; 2], waveform: Option<Arc<Waveform>>) -> Exposure {
    let before = chain.looks_back().then(|| chain.remember(before, &[]));
    chain.expose(moment, Memory { before, waveform, ..Memory::default() })
}
