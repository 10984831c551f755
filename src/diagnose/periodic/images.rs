//! Other frequencies that frames see as the same line: frames that are taken every T see f and k / T ± f alike (Shannon 1949), and no fit tells which it is.

use super::lamps::{FLICKER, FLICKER_HZ, is_mains};
use crate::diagnose::fitting::fit::Fit;
use crate::diagnose::reading::data::Data;
use crate::physics::cos_sin;
use crate::physics::effects::ambient_flicker::FREQUENCY;
use nalgebra::{Matrix3, Vector2};
use std::f64::consts::TAU;

/// An image of a line is stated where its odds beside the line are greater.
const LIKELY_ODDS: f64 = 0.05;
/// So many are stated at most.
const STATED: usize = 3;

/// Numbers of a line: those of its cosine and its sine, and its frequency, Hz.
type Line = [f64; 3];

/// Which numbers of the effect these are.
const NUMBERS: [usize; 3] = [0, 1, FREQUENCY];

/// What a line may be instead.
#[derive(Debug, Clone)]
pub struct Image {
    /// How likely it is beside the line that was fitted.
    pub odds: f64,
    /// Its numbers, for each piece of the fit that is a line.
    lines: Vec<(usize, Line)>,
}

impl Image {
    /// Its frequency, Hz, in the first recordings that have the line.
    pub fn frequency_hz(&self) -> f64 {
        self.lines.first().map_or(f64::NAN, |line| line.1[2])
    }
}

/// The images of the flicker that was fitted, those that the frames of all recordings see as the line but for their noise.
pub fn images(data: &Data, fit: &Fit) -> Vec<Image> {
    let lines: Vec<Seen> = (0..fit.pieces.len()).filter_map(|piece| Seen::of(data, fit, piece)).collect();
    images_of(&lines)
}

/// The same of what recordings show of a line.
fn images_of(lines: &[Seen]) -> Vec<Image> {
    let Some(first) = lines.first() else { return Vec::new() };
    let image = |(frequency_hz, sign): (f64, f64)| {
        let of = |seen: &Seen| {
            // Recordings' own frequencies are apart by what noise makes of them; an image may be a mirror's.
            let apart = sign * (seen.line[2] - first.line[2]);
            let (line, unlike) = seen_at(&seen.times_s, seen.line, frequency_hz + apart);
            (seen.piece, line, unlike * seen.chi2)
        };
        let of: Vec<_> = lines.iter().map(of).collect();
        let chi2: f64 = of.iter().map(|of| of.2).sum();
        Image {
            odds: (-0.5 * chi2).exp(),
            lines: of.into_iter().map(|(piece, line, _)| (piece, line)).collect(),
        }
    };
    let all = frequencies(first.line[2], first.period_s).into_iter();
    all.filter(|(other, _)| (other - first.line[2]).abs() > first.sigma_hz).map(image).collect()
}

/// What a sentence about a line says of its `images` that are likely, too.
pub fn also_seen(images: &[Image]) -> String {
    let mut likely: Vec<&Image> = images.iter().filter(|image| image.odds > LIKELY_ODDS).collect();
    likely.sort_by(|a, b| b.odds.total_cmp(&a.odds));
    let mut all: Vec<String> =
        likely.iter().take(STATED).map(|image| format!("{:.2} Hz", image.frequency_hz())).collect();
    if likely.len() > STATED {
        all.push(format!("one of {} other frequencies", likely.len() - STATED));
    }
    match all.len() {
        0 => String::new(),
        _ => format!(" At the times of these frames {} would look nearly the same.", all.join(" or ")),
    }
}

/// Frequencies that differ by less are told as the same, Hz.
const SAME_HZ: f64 = 0.01;

/// The frequency of a line, Hz, in words, with others that frames which are taken every so many seconds see alike.
pub fn alike(frequency_hz: f64, period_s: f64) -> String {
    let others = frequencies(frequency_hz, period_s).into_iter().map(|other| other.0);
    let mut others: Vec<f64> = others.filter(|hz| (hz - frequency_hz).abs() > SAME_HZ).collect();
    others.sort_by(|a, b| (a - frequency_hz).abs().total_cmp(&(b - frequency_hz).abs()));
    let words: Vec<String> = others.iter().take(STATED).map(|hz| format!("{hz:.2} Hz")).collect();
    match words.is_empty() {
        true => format!("{frequency_hz:.2} Hz"),
        false => format!("{frequency_hz:.2} Hz (frames see {} nearly alike)", words.join(" or ")),
    }
}

/// By how much a number of a piece, beside what its fit says, is not known because it may be that of one of the `images`: a standard deviation.
pub fn spread(images: &[Image], fit: &Fit, piece: usize, parameter: usize) -> f64 {
    let all: f64 = 1.0 + images.iter().map(|image| image.odds).sum::<f64>();
    let square = |image: &Image| {
        let line = image.lines.iter().find(|line| line.0 == piece)?.1;
        let place = NUMBERS.iter().position(|number| *number == parameter)?;
        Some(image.odds * (line[place] - fit.pieces[piece].values[parameter]).powi(2))
    };
    (images.iter().filter_map(square).sum::<f64>() / all).sqrt()
}

/// A line as frames see it.
struct Seen {
    piece: usize,
    line: Line,
    sigma_hz: f64,
    /// Chi squared that it explains.
    chi2: f64,
    times_s: Vec<f64>,
    period_s: f64,
}

impl Seen {
    /// Of a piece of the fit, if that is a line.
    fn of(data: &Data, fit: &Fit, number: usize) -> Option<Self> {
        let piece = fit.pieces.get(number).filter(|piece| piece.effect.name == FLICKER)?;
        let line = NUMBERS.map(|number| piece.values[number]);
        let column = |parameter: usize| fit.column_of(number, parameter);
        // Of a line that is held somewhere nothing is known.
        let columns = [column(NUMBERS[0])?, column(NUMBERS[1])?, column(NUMBERS[2])?];
        let covariance = Matrix3::from_fn(|a, b| fit.covariance[(columns[a], columns[b])]);
        let information = covariance.try_inverse()?;
        // With the frequency as it is.
        let strength = Vector2::new(line[0], line[1]);
        let chi2 = strength.dot(&(information.fixed_view::<2, 2>(0, 0) * strength));
        let moments = || piece.takes.iter().flat_map(|&take| &data.takes[take].moments);
        Some(Self {
            piece: number,
            line,
            sigma_hz: covariance[(2, 2)].sqrt(),
            chi2,
            times_s: moments().map(|moment| moment.time_s).collect(),
            period_s: moments().next()?.frame_period_s,
        })
    }
}

/// Frequencies of lamps, Hz, that frames which are taken every so many seconds see as `frequency_hz`, and with which sign they go with it; twice the mains'
/// only, if it is that.
fn frequencies(frequency_hz: f64, period_s: f64) -> Vec<(f64, f64)> {
    if period_s.is_nan() || period_s <= 0.0 {
        return Vec::new();
    }
    let (low, high) = FLICKER_HZ;
    let most = ((high + frequency_hz) * period_s).ceil() as i32;
    let folded = |k: i32| [1.0, -1.0].map(|sign| (f64::from(k) / period_s + sign * frequency_hz, (k, sign)));
    let all = (-most..=most).flat_map(folded).filter(|&(hz, way)| {
        (low..=high).contains(&hz) && way != (0, 1.0) && (!is_mains(frequency_hz) || is_mains(hz))
    });
    all.map(|(hz, (_, sign))| (hz, sign)).collect()
}

/// The line of frequency `hz` that is nearest to `line` at these times, and the share of it that it is unlike.
fn seen_at(times_s: &[f64], line: Line, hz: f64) -> (Line, f64) {
    let angle = |time_s: f64, hz: f64| cos_sin(TAU * (time_s * hz).fract());
    let (mut c, mut s, mut cc, mut ss, mut cs, mut all) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for &time_s in times_s {
        let own = angle(time_s, line[2]);
        let value = line[0] * own.0 + line[1] * own.1;
        let (cosine, sine) = angle(time_s, hz);
        c += value * cosine;
        s += value * sine;
        cc += cosine * cosine;
        ss += sine * sine;
        cs += cosine * sine;
        all += value * value;
    }
    let determinant = cc * ss - cs * cs;
    if determinant <= 1e-9 * (cc + ss).powi(2) || all <= 0.0 {
        return ([line[0], line[1], hz], 1.0);
    }
    let (a, b) = ((c * ss - s * cs) / determinant, (s * cc - c * cs) / determinant);
    ([a, b, hz], (1.0 - (a * c + b * s) / all).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn every(period_s: f64) -> Vec<f64> {
        (0..400).map(|n| 0.3 + period_s * f64::from(n)).collect()
    }

    #[test]
    fn frames_every_25_ms_see_lines_on_both_sides_of_a_hundred_hertz_alike() {
        let found = frequencies(100.02, 0.025);
        assert!(found.len() == 1 && (found[0].0 - 99.98).abs() < 1e-9, "{found:?}");
        // A mirror's: what is above one is below the other.
        assert_eq!(found[0].1, -1.0);
        let above = frequencies(100.05, 0.025)[0].0;
        assert!((above - found[0].0 + 0.03).abs() < 1e-9, "{above}");
        let (line, unlike) = seen_at(&every(0.025), [0.3, 0.4, 100.02], 99.98);
        assert!(unlike < 1e-9 && (line[0].hypot(line[1]) - 0.5).abs() < 1e-9, "{line:?} {unlike}");
        // At every frame both are the same light.
        let light = |line: Line, time_s: f64| {
            line[0] * (TAU * line[2] * time_s).cos() + line[1] * (TAU * line[2] * time_s).sin()
        };
        let differs = |&time_s: &f64| (light(line, time_s) - light([0.3, 0.4, 100.02], time_s)).abs() > 1e-9;
        assert!(!every(0.025).iter().any(differs));
    }

    /// Recordings whose frequencies are apart by what noise makes of them have the image in common.
    #[test]
    fn recordings_that_are_apart_share_the_image() {
        let seen = |piece: usize, hz: f64| Seen {
            piece,
            line: [0.3, 0.4, hz],
            sigma_hz: 5e-3,
            chi2: 400.0,
            times_s: every(0.025),
            period_s: 0.025,
        };
        let images = images_of(&[seen(0, 100.02), seen(1, 100.03)]);
        let [image] = &images[..] else { panic!("{images:?}") };
        assert!(image.odds > 0.9 && (image.frequency_hz() - 99.98).abs() < 1e-9, "{image:?}");
        assert!((image.lines[1].1[2] - 99.97).abs() < 1e-9, "{image:?}");
    }

    #[test]
    fn frames_at_other_times_tell_them_apart() {
        let mut times_s = every(0.025);
        // Both lines and twice the mains are images at multiples of 5 ms; 23 ms is none.
        times_s.extend(every(0.023).iter().map(|time_s| time_s + 20.0));
        let (_, unlike) = seen_at(&times_s, [0.3, 0.4, 100.02], 99.98);
        assert!(unlike > 0.1, "{unlike}");
        // A lamp that is not on the mains may have any of the frequencies.
        assert_eq!(frequencies(104.0, 0.05).len(), 4);
    }
}
