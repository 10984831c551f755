//! Tangents of the forward model: what each fitted number changes in every sample, by the model itself.

use super::acting::Acting;
use super::arrived::Arrived;
use super::patterns::{Patterns, difference};
use super::pieces::{Piece, active};
use crate::bench::chain;
use crate::diagnose::reading::data::Data;
use crate::frames::Geometry;
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

/// How a frame differs by one of the pixels' own numbers.
struct Own {
    /// With that number of all pixels a step further; or, where much of a pixel's signal may be its neighbours', of every second one, as on a chessboard, and of the others.
    chains: Vec<Chain>,
    step: f64,
    /// The last place before which it does not matter.
    place: Place,
}

/// The chains of one recording: the base, and one for each difference from it.
struct Chains {
    base: Chain,
    /// By the pixels' own numbers.
    own: [Own; OWN],
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
    /// So many times the pixel's own phase counts here: more than once where it is a delay, and the modulation frequency higher.
    pub times: f64,
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
/// The number of the base among chains that look back, and of the first that is a column's: before it are those of the pixels' own numbers.
const BASE: usize = 0;
const OF_COLUMNS: usize = BASE + 1 + 2 * OWN;
/// Steps of a pixel's own numbers, in their units.
const OWN_STEPS: [f64; OWN] = [0.1, 1e-4, 0.1, 0.1];

/// `pixels` with own `number` a step further, where they are on one of these `squares` of the chessboard.
fn own_pixels(pixels: &Pixels, number: usize, squares: &[usize]) -> Pixels {
    let (mut changed, step) = (pixels.clone(), OWN_STEPS[number]);
    let is_there = |pixel: usize| squares.contains(&square(pixels.geometry, pixel));
    let values = own_values_mut(&mut changed)[number].iter_mut().enumerate();
    values.filter(|(pixel, _)| is_there(*pixel)).for_each(|(_, value)| *value += step);
    changed
}

/// Whether a pixel is on a black or a white square of the chessboard: none of its neighbours in a row or column is on such a one.
fn square(geometry: Geometry, pixel: usize) -> usize {
    let (row, column) = geometry.row_column(pixel);
    (row + column) % 2
}

/// Effects by which a good part of a pixel's signal may be its neighbours' in row and column. What its own numbers change is then not what it changes by when all pixels'
/// numbers go a step further: a pixel at an edge would be said to follow its neighbour beyond it.
const OF_BESIDE: [&str; 1] = ["mixed_pixels"];

impl Frame {
    /// Tangents by the phase of the light, rad, a value a pixel.
    pub fn phase(&self) -> impl Iterator<Item = f64> {
        self.own[1].iter().map(|own| own / self.times)
    }
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
            let included = &data.takes[take].included;
            let is_of_beside = effects.iter().chain(included).any(|active| {
                OF_BESIDE.contains(&active.effect.name) && active.values != active.effect.off()
            });
            let squares: &[&[usize]] = if is_of_beside { &[&[0], &[1]] } else { &[&[0, 1]] };
            let own = [0, 1, 2, 3].map(|number| {
                let of =
                    |squares: &&[usize]| with(Arc::new(own_pixels(pixels, number, squares)), effects.clone());
                let place = if number == 1 { Place::Clock } else { Place::Path };
                Own { chains: squares.iter().map(of).collect(), step: OWN_STEPS[number], place }
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

    /// Frame number `index` of recording `take`; `arrived` is what light brought in frames that were made before it.
    pub fn frame(&self, take: usize, index: usize, arrived: &mut Arrived) -> Frame {
        let moments = &self.data.takes[take].moments;
        let moment = moments[index];
        let chains = &self.chains[take];
        let before = Moment::before(index, |index| moments[index]);
        let looks_back = chains.looks_back || chains.base.looks_back();
        arrived.turn_to(take, index, moment);
        let remembered = looks_back.then(|| arrived.before(BASE, &chains.base, before));
        let mut start = chains.base.begin(moment, Memory { before: remembered.clone(), ..Memory::default() });
        let mut stations = chains.base.stations(&start);
        let end = &stations[Place::Readout as usize];
        let base = end.signal_dn.clone();
        // Most of what is tried leaves the phases as they are.
        let memory = Memory { waveform: end.waveform.clone(), paths: end.paths.clone(), ..Memory::default() };
        for exposure in stations.iter_mut().chain([&mut start]) {
            (exposure.waveform, exposure.paths) = (memory.waveform.clone(), memory.paths.clone());
        }
        if looks_back {
            arrived.keep(BASE, stations[Place::Charge as usize].arrived_dn.clone());
        }
        let ambient = chains.base.pixels.ambient_dn.clone();
        let moved = Moment { position_m: moment.position_m + POSITION_STEP_M, ..moment };
        let at_moved = chains.base.expose(moved, Memory { before: remembered, ..memory.clone() });
        let position = difference(&at_moved.signal_dn, &base, POSITION_STEP_M);
        // What was in the frame before depends on a changed number, too.
        let mut looking_back = |number: usize, chain: &Chain| {
            let remembered = Some(arrived.before(number, chain, before));
            let exposure = chain.expose(moment, Memory { before: remembered, ..memory.clone() });
            arrived.keep(number, exposure.arrived_dn);
            exposure.signal_dn
        };
        let mut of_chain = |number: usize, chain: &Chain, step: f64, place: Place| {
            if chain.looks_back() {
                return difference(&looking_back(number, chain), &base, step);
            }
            let mut exposure = stations[place as usize].clone();
            exposure.pixels = Arc::clone(&chain.pixels);
            chain.resume(&mut exposure, place);
            difference(&exposure.signal_dn, &base, step)
        };
        let geometry = chains.base.pixels.geometry;
        let mut of_own = |number: usize, own: &Own| {
            let numbered = own.chains.iter().enumerate();
            let of = |(n, chain)| of_chain(BASE + 1 + 2 * number + n, chain, own.step, own.place);
            let mut changes: Vec<Vec<f64>> = numbered.map(of).collect();
            if let [black, white] = &mut changes[..] {
                let whites = black.iter_mut().zip(&*white).enumerate();
                whites
                    .filter(|(pixel, _)| square(geometry, *pixel) == 1)
                    .for_each(|(_, (black, white))| *black = *white);
            }
            changes.swap_remove(0)
        };
        let own = std::array::from_fn(|number| of_own(number, &chains.own[number]));
        let mut patterns = Patterns::new(&chains.base, &base, start, stations);
        for (number, change) in chains.columns.iter().enumerate() {
            match change {
                Some(Change::Chain { chain, step, .. }) if chain.looks_back() => {
                    let changed = looking_back(OF_COLUMNS + number, chain);
                    patterns.acting.column(number, difference(&changed, &base, *step));
                }
                Some(Change::Chain { chain, step, place }) => patterns.other(number, chain, *step, *place),
                Some(Change::More { effect, step, is_finite }) => {
                    patterns.more(number, effect, *step, *is_finite);
                }
                None => {}
            }
        }
        let columns = patterns.acting;
        let (times, _) = chains.base.pixels.own_phase_at(moment.frequency_hz);
        Frame { base, own, times, ambient, position, columns, count: self.count }
    }

    /// Number of columns.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Number of phases that all pixels have in common, at one modulation frequency each.
    pub fn common(&self) -> usize {
        self.chains.first().map_or(0, |chains| chains.base.pixels.at_frequencies.len())
    }

    /// The number of the phase that all pixels have in common in frame `index` of recording `take`, and the tangents by it: a value a pixel of the `frame`.
    pub fn of_common(&self, take: usize, index: usize, frame: &Frame) -> Option<(usize, Vec<f64>)> {
        let pixels = &self.chains[take].base.pixels;
        let number = pixels.at_frequency(self.data.takes[take].moments[index].frequency_hz)?;
        Some((number, frame.phase().collect()))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::diagnose::fitting::finished::unfitted;
    use crate::diagnose::stated_noise;
    use crate::physics::AtFrequency;

    /// What a pixel's own numbers change is what changes there when they alone do, however much of what it sees is its neighbour's.
    #[test]
    fn a_pixel_at_an_edge_follows_its_own_numbers_alone() {
        let size = Geometry { width: 8, height: 6 };
        let recordings = taken(size, 2, &[], &["four-motion"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let pixels = unfitted(&data, stated_noise(&data)).pixels;
        let mut mixed = Piece::off("mixed_pixels", &[0, 1], &[0]);
        mixed.values[..2].copy_from_slice(&[0.5, 0.2]);
        let pieces = [mixed];
        let of = |pixels: &Arc<Pixels>| Tangents::new(&data, pixels, &pieces, &[]).0;
        let (index, tangents) = (2, of(&pixels));
        let frame = tangents.frame(0, index, &mut Arrived::default());
        let mut looked_at = [0; 2];
        for &(pixel, beyond) in &pixels.edges {
            looked_at[usize::from(data.target[pixel])] += 1;
            for (number, (own, step)) in frame.own.iter().zip(OWN_STEPS).enumerate() {
                let mut changed = Pixels::clone(&pixels);
                own_values_mut(&mut changed)[number][pixel] += step;
                let changed = of(&Arc::new(changed)).base(0, index);
                let (alone, found) = ((changed[pixel] - frame.base[pixel]) / step, own[pixel]);
                assert!((found - alone).abs() < 1e-6 * (1.0 + alone.abs()), "{number}: {found}, {alone}");
                // The neighbour beyond the edge follows it, too.
                assert!(number == 3 || (changed[beyond] - frame.base[beyond]).abs() > 1e-6);
            }
        }
        assert!(looked_at.into_iter().all(|edges| edges > 4), "{looked_at:?}");
    }

    /// A phase that all pixels have at a frequency moves frames by that much, also where their own phases count more than once there.
    #[test]
    fn a_common_phase_is_one_of_the_light() {
        const STEP_RAD: f64 = 1e-4;
        let size = Geometry { width: 8, height: 6 };
        let recordings = taken(size, 2, &[], &["four-rail"]).unwrap();
        let data = Data::of(&recordings, Vec::new()).unwrap();
        let pixels = unfitted(&data, stated_noise(&data)).pixels;
        let of = |phase_rad: f64| {
            let at = AtFrequency { frequency_hz: recordings[0].frequency_hz, times: 1.5, phase_rad };
            let pixels = Pixels { at_frequencies: vec![at], ..Pixels::clone(&pixels) };
            Tangents::new(&data, &Arc::new(pixels), &[], &[]).0
        };
        let (tangents, index) = (of(0.3), 2);
        let frame = tangents.frame(0, index, &mut Arrived::default());
        let (number, common) = tangents.of_common(0, index, &frame).unwrap();
        assert_eq!((number, tangents.common()), (0, 1));
        let moved = difference(&of(0.3 + STEP_RAD).base(0, index), &frame.base, STEP_RAD);
        let largest = moved.iter().fold(0.0_f64, |largest, moved| largest.max(moved.abs()));
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-3 * largest;
        assert!(largest > 10.0 && common.iter().zip(&moved).all(is_near), "{common:?} {moved:?}");
        assert!(frame.own[1].iter().zip(&moved).any(|(own, moved)| (own - moved).abs() > 0.1 * largest));
    }
}
