//! The table of the open question's hypotheses.

use super::camera::{Conditions, Method};
use super::figure::{Table, mm};
use super::linearity::random_phases;
use super::open_question::{Fit, MEASURED, fits, least_ratio, ratios, square_waves};

fn row(fit: &Fit) -> Vec<String> {
    let free =
        fit.free.map_or(String::new(), |[best, low, high]| format!("{best:.2} ({low:.2} to {high:.2})"));
    let random = fit.random_m.map_or(String::new(), mm);
    let numbers = fit.predicted_m.iter().map(|predicted_m| mm(*predicted_m));
    let chi = format!("{:.1} / {}", fit.chi_squared, fit.freedom);
    [fit.hypothesis.to_owned(), free, random].into_iter().chain(numbers).chain([chi]).collect()
}

/// Random phases of Table I's harmonics under which the ratio is fitted again.
const PHASES: usize = 20;

/// What the waveform's depth says of the ratios that were fitted.
fn bound(fits: &[Fit]) -> String {
    let least = least_ratio(&Conditions::table_1());
    let ends = fits.get(1).and_then(|fit| fit.free).unwrap_or([f64::NAN; 3]);
    format!(
        "Assumed besides: a single-ended output, one tap whose charge cannot be negative. With Table I at phases 0 the waveform goes down to \
         \u{2212}{least:.4} of the fundamental, so that a ratio below {least:.4} would be negative light at some phase: of the interval {:.2} to {:.2} \
         only what lies above can be. A differential output (one tap less the other) has no such bound; most of the constant part, and with it of \
         this explanation, would cancel there.",
        ends[1], ends[2]
    )
}

/// With and without falloff, and another hypothesis.
pub fn table(methods: &[Method; 2]) -> Table {
    let measured = MEASURED.iter().map(|m| format!("{} \u{b1} {}", mm(m.value), mm(m.error)));
    let first = ["measured (the paper)".to_owned(), String::new(), String::new()];
    let measured = first.into_iter().chain(measured).chain([String::new()]).collect();
    let ends = ratios(methods, &random_phases(PHASES)).unwrap_or((f64::NAN, f64::NAN));
    let phases = format!(
        "With {PHASES} random choices of the harmonics' phases instead of 0, the ratio of the second row is {:.2} to {:.2}.",
        ends.0, ends.1
    );
    let hypotheses = fits(methods);
    let bound = bound(&hypotheses);
    let mut rows: Vec<Vec<String>> = std::iter::once(measured).chain(hypotheses.iter().map(row)).collect();
    // Beside the other one without a free number.
    rows.insert(2, row(&square_waves(methods)));
    let head = [
        "hypothesis",
        "free number (68 %)",
        "random, mm",
        "four RMS, mm",
        "four range, mm",
        "WDFT RMS, mm",
        "WDFT range, mm",
        "\u{3c7}\u{b2} / freedom",
    ];
    Table {
        name: "open-question",
        title: "The open question: motion at 2 m/s in 125 ms, with and without the light's falloff within a set",
        head: head.map(str::to_owned).to_vec(),
        rows,
        notes: [
            "Fitted: every number in the column of free numbers, to the four measured ones, whose errors are taken for independent (RMS and \
             range of the same runs are not, so that intervals are too narrow). Assumed: Table I with phases 0, 30 MHz, 1/d\u{b2} from the \
             encoder's zero.",
            "It shows that falloff within a set is of the right size: with a ratio near 1 it makes up for the missing half of the four frames' RMS. \
             Together with a random error of some 10 mm, which the WDFT needs under every hypothesis here, \u{3c7}\u{b2} is about its freedom.",
            "It does not prove it. Falloff alone, without a random error, is not a good fit; two square waves would have a ratio of 1.23, just outside an interval that is too narrow, \
             and pixels of less contrast a larger one; frames that are farther apart fit no worse, though 125 ms a measurement speak against it. Four numbers \
             of one velocity cannot tell causes apart. What is the same when the target stands (droop, lag, non-linearity) is mostly gone with \
             the calibration, so that it cannot take the falloff's place.",
            "It can be decided: the mean of the raw frames gives the ratio; the error under falloff grows towards the camera, that of a longer frame period does not.",
        ]
        .map(str::to_owned)
        .into_iter()
        .chain([bound, phases])
        .collect(),
    }
}
