//! The candidates: effects that a campaign could need, in all ways in which they may be there.

use super::periods::{Found, LINES};
use super::sides::sides;
use crate::diagnose::forms::other_camera::{self, OTHER_CAMERA};
use crate::diagnose::forms::refined::is_seldom;
use crate::diagnose::forms::roundings::rounded;
use crate::diagnose::periodic::lines::Series;
use crate::diagnose::reading::data::Data;
use crate::diagnose::reading::frequencies::{Frequency, frequencies};
use crate::diagnose::reading::included::included_of;
use crate::diagnose::tangents::pieces::{OF_BOTH_FORMS, Piece, Variant};
use crate::physics::{EFFECTS, Effect};
use crate::recording::BASELINE;

/// An effect that is a candidate, in all variants of its shape.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The effect.
    pub effect: &'static Effect,
    /// At least one.
    pub variants: Vec<Variant>,
    /// Shapes that could have been found instead, for a shape that was looked for among many.
    pub looked: f64,
}

/// Whose values are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Grouping {
    /// Those of all recordings.
    All,
    /// Those of recordings with as many frames a set.
    Scheme,
    /// The same, but for recordings of many frames a set: numbers of each of these are many, and a weak effect shows in few of them.
    FewFrames,
    /// Those of recordings at one modulation frequency, where there are several.
    Frequency,
    /// Each recording has its own.
    Take,
}

/// Effects whose values need not be the same in all recordings: their parameters belong to frames of a set, their phase or their clock starts
/// anew, a synthesiser has another setting for each frequency, at which waveforms are others, too. Each is tried in all these ways.
const GROUPINGS: [(&str, &[Grouping]); 10] = [
    ("modulation_frequency_error", &[Grouping::All, Grouping::Frequency]),
    ("correlation_harmonics", &[Grouping::All, Grouping::Frequency]),
    ("ambient_flicker", &[Grouping::All, Grouping::Take]),
    ("phase_step_errors", &[Grouping::Scheme, Grouping::FewFrames]),
    ("frame_gain", &[Grouping::Scheme, Grouping::FewFrames]),
    ("illumination_droop", &[Grouping::All, Grouping::Scheme]),
    ("illumination_drift", &[Grouping::All, Grouping::Take]),
    ("ambient_drift", &[Grouping::All, Grouping::Take]),
    ("phase_drift", &[Grouping::All, Grouping::Take]),
    (OTHER_CAMERA, &[Grouping::Take]),
];
/// So many frames a set are many.
pub const MANY_FRAMES: usize = 16;
/// What starts with a corner: it is tried where it would show, at several values.
const FINITE: &str = "saturation";

/// A converter's error of which the recordings do not see a whole period is smooth: what they see of it is a response, too, and so many smooth
/// curves are the response's for one of a converter.
const SMOOTH: (&str, f64) = ("adc_nonlinearity", 10.0);

/// Before anything is seen: effects that are so many times less likely than others, where the camera is described. A bench is measured, once, and where its zero
/// is off by millimetres that is a mistake; light that comes another way, which amplitudes may take for that, every bench has.
const UNLIKELY: [(&str, f64); 1] = [("encoder_offset", 10.0)];

/// Choices that are looked at in one shape only: near it, all look alike.
const IN_ONE_SHAPE: [(&str, f64, f64); 2] = [("course", 1.0, 60.0), ("course", -1.0, 1e4)];

/// A choice that is looked at where no pixel tells its ambient light from the constant part of the camera's own alone.
const OF_UNTOLD_AMBIENT: (&str, f64) = ("is_even", 1.0);

/// Effects that differ from pixel to pixel, told from others only where the target is at one place: what changes with the distance differs too.
pub const OF_ONE_PLACE: [&str; 1] = ["response_decay"];

/// Effects that a pixel's neighbours make: they cannot be seen where those are not looked at.
pub const OF_NEIGHBOURS: [&str; 3] = ["mixed_pixels", "charge_crosstalk", "lateral_motion"];
/// Effects by which pixels disturb others.
pub const OF_OTHER_PIXELS: [&str; 3] = ["mixed_pixels", "charge_crosstalk", "lens_scatter"];

/// All candidates that `data` could need: those of the registry that its camera does not include wholly. What it includes with a value may have another one.
pub fn candidates(data: &Data, series: &Series) -> Vec<Candidate> {
    let included = |effect: &Effect| {
        let by_name = BASELINE.iter().find(|(name, _)| *name == effect.name);
        by_name.is_some_and(|(_, included)| data.camera.included_physics.iter().any(|name| name == included))
    };
    let of_no_lamp = series.line_of_no_lamp();
    EFFECTS
        .iter()
        .chain(&data.library)
        .copied()
        .filter(|effect| {
            let is_seen = (data.grid.every == 1 || !OF_NEIGHBOURS.contains(&effect.name))
                && (data.stands_still() || !OF_ONE_PLACE.contains(&effect.name));
            effect.is_predicted() && is_seen && !included(effect)
        })
        .map(|effect| {
            let line = of_effect(&LINES, effect).and_then(|line| line(series, of_no_lamp));
            let shapes = line.as_ref().map(|line| &line.shapes[..]);
            let mut variants = variants(effect, data, shapes);
            if let Some(line) = &line {
                if effect.name == OTHER_CAMERA {
                    other_camera::sort_out(&mut variants, line, series);
                }
                variants.iter_mut().for_each(|variant| variant.begin_at(&line.own));
            }
            // A line is one of many frequencies that were looked at, whichever of them are tried.
            let of_line = |line: Found| line.looked / line.shapes.len() as f64;
            // Both of two forms at once are no further place to look at.
            let ways = variants.iter().filter(|variant| !variant.is_of_both_forms()).count();
            let looked = ways as f64 * line.map_or(1.0, of_line);
            variants.extend(rounded(effect, data, series));
            Candidate { effect, looked, variants }
        })
        .collect()
}

/// What a table has for an effect, if it has it.
fn of_effect<T: Copy>(table: &[(&str, T)], effect: &Effect) -> Option<T> {
    table.iter().find(|(name, _)| *name == effect.name).map(|(_, of)| *of)
}

fn variants(effect: &'static Effect, data: &Data, found: Option<&[f64]>) -> Vec<Variant> {
    let full_scale_dn = f64::from(data.camera.full_scale()) - data.camera.pedestal_dn;
    if effect.name == FINITE {
        let (least, most) = effect.parameters[0].bounds;
        let missing = |full_dn: f64| (1.0 - full_dn / full_scale_dn).clamp(least, most);
        let piece = |value: f64| Piece {
            effect,
            values: [&[value], &effect.off()[1..]].concat(),
            free: vec![0],
            takes: (0..data.takes.len()).collect(),
            finite: true,
            included: Vec::new(),
        };
        let values = data.full_wells_dn().into_iter().map(missing);
        return values.map(|value| Variant { pieces: vec![piece(value)], rarity: 1.0 }).collect();
    }
    let shape = effect.parameters.iter().position(|parameter| parameter.is_shape() && !parameter.is_choice);
    let choice = effect.parameters.iter().position(|parameter| parameter.is_choice);
    let values_of =
        |number: Option<usize>| number.map_or(&[0.0][..], |number| effect.parameters[number].shapes);
    let (shapes, mut choices) = (found.unwrap_or(values_of(shape)), values_of(choice));
    let mut groupings = of_effect(&GROUPINGS, effect).map_or(&[Grouping::All][..], |groupings| groupings);
    // Without a line, what one would do is looked at in its usual way.
    let is_without_line = found.is_none() && of_effect(&LINES, effect).is_some();
    if is_without_line {
        (groupings, choices) = (&[Grouping::All], &choices[..1]);
    }
    let strengths = |instead: bool| -> Vec<usize> {
        let all = effect.parameters.iter().enumerate();
        all.filter(|(_, p)| p.is_usual_strength(instead) && !(instead && is_without_line))
            .map(|(number, _)| number)
            .collect()
    };
    let (strengths, instead) = (strengths(false), strengths(true));
    let is_of_all = |&number: &usize| effect.parameters[number].frame.is_none();
    let of_all: Vec<usize> = instead.iter().copied().filter(is_of_all).collect();
    let mut variants = Vec::new();
    let of_many = data.schemes().into_iter().filter(|&frames| frames >= MANY_FRAMES).count();
    let has_both = of_many > 0 && of_many < data.schemes().len();
    let has_several = frequencies(&data.takes).len() > 1;
    let tells = |by: &Grouping| match by {
        Grouping::FewFrames => has_both,
        Grouping::Frequency => has_several,
        _ => true,
    };
    let groupings: Vec<Grouping> = groupings.iter().copied().filter(tells).collect();
    let usual = of_effect(&UNLIKELY, effect).filter(|_| !data.assumed.camera).unwrap_or(1.0);
    let seen_dn = if effect.name == SMOOTH.0 { data.span_dn() } else { f64::INFINITY };
    let within = shape.map(|shape| effect.parameters[shape].bounds_within(full_scale_dn));
    let is_within = |value: &&f64| within.is_none_or(|(low, high)| (low..=high).contains(*value));
    let name_of_choice = choice.map_or("", |choice| effect.parameters[choice].name);
    let usual_choices = choices.iter().filter(|&&chosen| !is_seldom(effect.name, name_of_choice, chosen));
    let tells_ambient = (0..data.pixels()).any(|pixel| data.tells_constant(pixel));
    let is_looked_at = |(chosen, value): &(f64, f64)| {
        let is_of_untold = (name_of_choice, *chosen) == OF_UNTOLD_AMBIENT;
        !(is_of_untold && tells_ambient)
            && IN_ONE_SHAPE
                .iter()
                .all(|(name, of, one)| *name != name_of_choice || of != chosen || one == value)
    };
    let ways = usual_choices
        .flat_map(|&chosen| shapes.iter().filter(is_within).map(move |&value| (chosen, value)))
        .filter(is_looked_at);
    for (chosen, value) in ways {
        let mut values = effect.off();
        shape.into_iter().for_each(|shape| values[shape] = value);
        choice.into_iter().for_each(|choice| values[choice] = chosen);
        // A phase shifter that has so many settings of its own has the same in all recordings.
        let is_shared = chosen > 1.0;
        let groupings = if is_shared { &[Grouping::All][..] } else { &groupings[..] };
        let strengths =
            if is_shared { strengths.get(..chosen as usize).unwrap_or(&strengths) } else { &strengths[..] };
        let both = if OF_BOTH_FORMS.contains(&effect.name) {
            [strengths, &instead[..]].concat()
        } else {
            Vec::new()
        };
        // What all frames have may be without what single ones have.
        let forms = [strengths, &instead[..], &both[..], if of_all == instead { &[] } else { &of_all[..] }];
        let forms = forms.into_iter().filter(|form| !form.is_empty());
        for strengths in forms {
            let rarity = if value > seen_dn { SMOOTH.1 } else { usual };
            for values in sides(effect, &values, strengths) {
                let of =
                    |&by: &Grouping| Variant { pieces: pieces(effect, &values, strengths, by, data), rarity };
                variants.extend(groupings.iter().map(of));
            }
        }
    }
    variants
}

fn pieces(
    effect: &'static Effect,
    values: &[f64],
    strengths: &[usize],
    by: Grouping,
    data: &Data,
) -> Vec<Piece> {
    let all: Vec<usize> = (0..data.takes.len()).collect();
    let groups: Vec<Vec<usize>> = match by {
        Grouping::All => vec![all],
        Grouping::Take => all.iter().map(|&take| vec![take]).collect(),
        Grouping::Scheme | Grouping::FewFrames => {
            let of = |frames: usize| {
                all.iter().copied().filter(|&take| data.takes[take].frames == frames).collect()
            };
            let is_looked_at = |frames: &usize| by == Grouping::Scheme || *frames < MANY_FRAMES;
            data.schemes().into_iter().filter(is_looked_at).map(of).collect()
        }
        Grouping::Frequency => {
            let is_at = |take: usize, frequency| Frequency::of(&data.takes[take]) == Some(frequency);
            let of = |frequency| all.iter().copied().filter(|&take| is_at(take, frequency)).collect();
            frequencies(&data.takes).into_iter().map(of).collect()
        }
    };
    groups
        .into_iter()
        .map(|takes| {
            let frames = takes.iter().map(|&take| data.takes[take].frames).max().unwrap_or(0);
            // A parameter of a frame that there is not, and one that each recording has for itself.
            let there = |&number: &usize| match by {
                Grouping::Scheme | Grouping::FewFrames => number < frames,
                Grouping::All | Grouping::Frequency => !effect.parameters[number].is_of_recording,
                Grouping::Take => true,
            };
            let is_taken =
                |&number: &usize| effect.parameters[number].frame.is_none_or(|frame| frame < frames);
            let free = strengths.iter().copied().filter(there).filter(is_taken).collect();
            let included = included_of(data, effect, &takes);
            Piece { effect, values: values.to_vec(), free, takes, finite: false, included }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::taken;
    use crate::frames::Geometry;

    #[test]
    fn frames_that_no_recording_has_have_no_numbers() {
        let size = Geometry { width: 4, height: 3 };
        let most = |recordings: &[&str]| {
            let data = Data::of(&taken(size, 2, &[], recordings).unwrap(), Vec::new()).unwrap();
            let all = candidates(&data, &Series::default());
            let timing = all.iter().find(|candidate| candidate.effect.name == "frame_timing_error").unwrap();
            let free = timing.variants.iter().flat_map(|variant| &variant.pieces[0].free);
            free.filter_map(|&number| timing.effect.parameters[number].frame).max()
        };
        assert_eq!(most(&["four-motion"]), Some(3));
        assert_eq!(most(&["four-motion", "wdft-rail"]), Some(4));
    }
    /// A synthesiser may be off at one of the frequencies alone: where there are several, each is tried with a number of its own.
    #[test]
    fn each_frequency_may_have_its_own() {
        let size = Geometry { width: 4, height: 3 };
        let groups = |hz: [f64; 3]| {
            let recordings = taken(size, 2, &[], &["four-rail", "wdft-rail", "four-motion"]).unwrap();
            let mut data = Data::of(&recordings, Vec::new()).unwrap();
            for (take, hz) in data.takes.iter_mut().zip(hz) {
                take.moments.iter_mut().for_each(|moment| moment.frequency_hz = hz);
            }
            let all = candidates(&data, &Series::default());
            let is_it = |candidate: &&Candidate| candidate.effect.name == "modulation_frequency_error";
            let variants = &all.iter().find(is_it).unwrap().variants;
            let takes = |variant: &Variant| {
                variant.pieces.iter().map(|piece| piece.takes.clone()).collect::<Vec<_>>()
            };
            variants.iter().map(takes).collect::<Vec<_>>()
        };
        let all = vec![vec![0, 1, 2]];
        assert_eq!(groups([30e6; 3]), vec![all.clone()]);
        assert_eq!(groups([40e6, 20e6, 40e6]), [all, vec![vec![1], vec![0, 2]]]);
    }
}
