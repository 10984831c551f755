//! The paper's experiments: golden numbers from outside, what the equations say, and that the checks can fail.
//!
//! The golden numbers are of an independent program of forty lines: closed forms of both algorithms' arctangents, cosines summed directly,
//! distances 1 cm apart. It shares no code with the crate.

use vuris::paper::camera::{Camera, Conditions, Method};
use vuris::paper::figure_05::means_m;
use vuris::paper::figure_07::with_falloff;
use vuris::paper::linearity::{by_moving, by_phase_stepping, errors};
use vuris::paper::motion::{VELOCITY_M_S, error_curve, places_m};
use vuris::paper::open_question::{MEASURED, chi_squared, fits, least_ratio, square_waves};
use vuris::paper::residual::{rms, span};
use vuris::paper::rivals::{
    CALIBRATIONS, REMEDIES, RUNS, at_once_rms_m, calibrated_rms_m, near_edges, ordered_rms_m, take,
    waveform_at,
};
use vuris::paper::table_1::{MEASURED as TABLE_1, spectrum};
use vuris::paper::{Quantity, figures, linearity_range_m, quantities};
use vuris::physics::{Correlation, Harmonic};

/// Both programs take the same places along the rail; those over a turn differ, and so do maxima of smooth curves between them: less than
/// a quarter of a millimetre of 50 mm, less than 0.02 mm of an RMS.
const RMS_M: f64 = 2e-5;
const SPAN_M: f64 = 2.5e-4;

fn linearity(method: &Method, conditions: Conditions) -> [f64; 2] {
    let errors_m = errors(&by_phase_stepping(&Camera::new(conditions), method));
    [rms(&errors_m), span(&errors_m)]
}

fn motion(method: &Method, conditions: Conditions) -> [f64; 2] {
    let errors_m = errors(&error_curve(&Camera::new(conditions), method, VELOCITY_M_S));
    [rms(&errors_m), span(&errors_m)]
}

fn assert_golden(what: &str, found: [f64; 2], golden: [f64; 2]) {
    let apart = [(found[0] - golden[0]).abs(), (found[1] - golden[1]).abs()];
    assert!(apart[0] < RMS_M && apart[1] < SPAN_M, "{what}: {found:?}, not {golden:?}");
}

#[test]
fn linearity_is_the_independent_programs() {
    let [four, wdft] = Method::both().unwrap();
    assert_golden("four frames", linearity(&four, Conditions::table_1()), [0.017588, 0.049764]);
    assert_golden("WDFT", linearity(&wdft, Conditions::table_1()), [0.004236, 0.012011]);
}

#[test]
fn motion_is_the_independent_programs() {
    let [four, wdft] = Method::both().unwrap();
    let golden = [
        ("four frames, no falloff", motion(&four, Conditions::table_1()), [0.022945, 0.062824]),
        ("WDFT, no falloff", motion(&wdft, Conditions::table_1()), [0.001823, 0.005340]),
        ("four frames, ratio 1", motion(&four, with_falloff(1.0)), [0.040747, 0.120994]),
        ("four frames, ratio 2", motion(&four, with_falloff(2.0)), [0.058212, 0.178242]),
        ("WDFT, ratio 1", motion(&wdft, with_falloff(1.0)), [0.002670, 0.007810]),
    ];
    for (what, found, golden) in golden {
        assert_golden(what, found, golden);
    }
}

/// A waveform that is not the paper's, and light that does not fall, are not taken for it.
#[test]
fn a_broken_input_is_caught() {
    let [four, wdft] = Method::both().unwrap();
    let weaker = Harmonic { number: 3, amplitude: 1.0 / 33.0, phase_rad: 0.0 };
    let broken = Conditions { correlation: Correlation::with_harmonics(&[weaker]), ..Conditions::table_1() };
    let caught =
        |method: &Method, found: fn(&Method, Conditions) -> [f64; 2], conditions, golden: [f64; 2]| {
            (found(method, conditions)[0] - golden[0]).abs() > RMS_M
        };
    assert!(caught(&four, linearity, broken.clone(), [0.017588, 0.0]));
    assert!(caught(&wdft, linearity, broken, [0.004236, 0.0]));
    assert!(caught(&four, motion, Conditions::table_1(), [0.040747, 0.0]));
    assert!(caught(&four, motion, with_falloff(1.02), [0.040747, 0.0]));
    // A row that is not the WDFT, with as many frames.
    let other = Method::of("Schmit and Creath", "schmit-creath").unwrap();
    assert!(caught(&other, motion, Conditions::table_1(), [0.001823, 0.0]));
}

/// Figure 5: the reference frame moves the mean by ∓1.5 v t_f and ∓0.5 v t_f (the paper), v t_f = 62.5 mm.
#[test]
fn the_reference_frame_moves_the_mean_only() {
    let [four, _] = Method::both().unwrap();
    for (found_m, factor) in means_m(&four).into_iter().zip([1.5, 0.5, -0.5, -1.5]) {
        // What the second order of motion moves: a half of (0.0393 rad)² of 0.8 m a radian.
        assert!((found_m - factor * 0.0625).abs() < 1e-3, "{factor}: {found_m}");
    }
}

/// Two cycles of amplitude v t_f / 2 (the paper): over whole cycles the range would be v t_f.
#[test]
fn a_sine_that_moves_errs_by_half_its_way() {
    let [four, _] = Method::both().unwrap();
    for (velocity_m_s, way_m) in [(0.5, 0.015_625), (1.0, 0.031_25), (2.0, 0.0625)] {
        let curve = error_curve(&Camera::new(Conditions::sinusoidal()), &four, velocity_m_s);
        let found_m = span(&errors(&curve));
        assert!((found_m / way_m - 1.0).abs() < 0.01, "{velocity_m_s}: {found_m}");
    }
    assert_eq!((places_m()[0], places_m().last().copied()), (1.0, Some(3.0)));
}

#[test]
fn sixty_four_frames_find_table_1() {
    let (exact, noisy) = (spectrum(false), spectrum(true));
    for (harmonic, inverse) in (1..).zip(TABLE_1) {
        assert!((exact[harmonic] * inverse - 1.0).abs() < 1e-9, "harmonic {harmonic}");
        // 64 frames of a noise of 5 DN at 1200 DN, 100 times: 1e-4 of the fundamental, four of them.
        assert!((noisy[harmonic] - exact[harmonic]).abs() < 4e-4, "harmonic {harmonic}: {}", noisy[harmonic]);
    }
}

/// Moved and stepped are the same experiment where nothing else acts: they differ by noise, and by the line that is fitted to 0.8 of a turn.
#[test]
fn both_ways_of_measuring_agree() {
    for (method, golden_m) in Method::both().unwrap().iter().zip([0.0176, 0.0042]) {
        let moved_m = rms(&errors(&by_moving(&Camera::new(Conditions::table_1()), method)));
        assert!((moved_m - golden_m).abs() < 0.001, "{}: {moved_m}", method.name);
    }
}

#[test]
fn the_paper_is_met_where_the_table_says_so() {
    let methods = Method::both().unwrap();
    let all = quantities(&methods);
    let of = |what: &str| -> &Quantity { all.iter().find(|quantity| quantity.what == what).unwrap() };
    let within = |what| of(what).is_within();
    assert_eq!(within("four frames, linearity, phase stepping, RMS"), Some(true));
    assert_eq!(within("four frames, motion, phase change and harmonics, RMS"), Some(false));
    assert_eq!(within("four frames, motion, phase change and harmonics, range"), Some(false));
    // Every quantity that misses says why.
    for quantity in all.iter().filter(|quantity| quantity.is_within() == Some(false)) {
        assert!(!quantity.why.is_empty(), "{}", quantity.what);
    }
    assert!(all.iter().all(|quantity| quantity.predicted_m.is_finite() && !quantity.assumed.is_empty()));
    // To first order the error of four frames is that of 1/31 with 1/1020 added or taken away, the WDFT's that of 1/105 with 1/500; what
    // is neglected is of the second order, at most a fiftieth of it. Random phases come close to both ends.
    let metres = 299_792_458.0 / (4.0 * std::f64::consts::PI * 30e6) / 2f64.sqrt();
    for (method, [one, other]) in methods.iter().zip([[31.0, 1020.0], [105.0, 500.0]]) {
        let (low_m, high_m) = linearity_range_m(method);
        let ends = [1.0 / one - 1.0 / other, 1.0 / one + 1.0 / other].map(|amplitude| amplitude * metres);
        assert!(
            (low_m / ends[0] - 1.0).abs() < 0.02 && (high_m / ends[1] - 1.0).abs() < 0.02,
            "{low_m} {high_m} {ends:?}"
        );
    }
}

/// The fit finds a ratio that was put in, and its χ² is that of the numbers that it shows.
#[test]
fn the_fit_is_the_least_of_all() {
    let methods = Method::both().unwrap();
    let all = fits(&methods);
    assert_eq!(all.len(), 6);
    let [best, low, high] = all[1].free.unwrap();
    assert!(low < best && best < high && high < 3.0, "{best} {low} {high}");
    let at = |ratio| {
        let [a, b] = motion(&methods[0], with_falloff(ratio));
        let [c, d] = motion(&methods[1], with_falloff(ratio));
        chi_squared(&[a, b, c, d])
    };
    assert!((at(best) - all[1].chi_squared).abs() < 1e-6);
    assert!(at(best - 0.02) > at(best) && at(best + 0.02) > at(best));
    // One above the least at the interval's ends, to the grid's step.
    assert!(at(low) <= at(best) + 1.0 && at(low - 0.01) > at(best) + 1.0);
    assert!(at(high) <= at(best) + 1.0 && at(high + 0.01) > at(best) + 1.0);
    assert!(all[1..].iter().all(|fit| fit.chi_squared <= all[0].chi_squared));
    // What the table's notes say. Beyond 7.81, χ² of three degrees of freedom is in one case of twenty.
    assert!(all[1].chi_squared > 7.81 && all[3].chi_squared < 3.0);
    assert!(all[3].free.unwrap()[2] < std::f64::consts::PI.powi(2) / 8.0);
    assert!(all[4].chi_squared < all[1].chi_squared && all[5].chi_squared < all[3].chi_squared + 0.5);
    assert!(
        (all[3].random_m.unwrap() - 0.010).abs() < 0.002 && (all[5].random_m.unwrap() - 0.010).abs() < 0.002
    );
    assert_eq!(chi_squared(&MEASURED.map(|measured| measured.value)), 0.0);
}

/// Half a turn from its crest every odd harmonic of the waveform is negative and every even one positive, by the paper's own Table I; the
/// square waves' ratio is predicted as a whole simulation has it.
#[test]
fn the_fitted_ratios_bound_is_the_waveforms_depth() {
    let depth = 1.0 - 1.0 / 105.0 + 1.0 / 31.0 - 1.0 / 500.0 + 1.0 / 1020.0 - 1.0 / 926.0 + 1.0 / 1449.0;
    assert!((least_ratio(&Conditions::table_1()) - depth).abs() < 1e-9 && (depth - 1.0213).abs() < 5e-5);
    assert!((least_ratio(&Conditions::sinusoidal()) - 1.0).abs() < 1e-12);
    let methods = Method::both().unwrap();
    let [.., low, high] = fits(&methods)[1].free.unwrap();
    assert!(low < depth && depth < high, "the table's note says that the bound lies within {low} to {high}");
    let ratio = std::f64::consts::PI.powi(2) / 8.0;
    let whole = methods.each_ref().map(|method| motion(method, with_falloff(ratio))).concat();
    for (predicted, whole) in square_waves(&methods).predicted_m.into_iter().zip(whole) {
        assert!((predicted - whole).abs() < 1e-9, "{predicted}, not {whole}");
    }
}

/// What a remark says of noise is what the rows with noise have.
#[test]
fn remarks_on_noise_are_those_of_the_rows_with_noise() {
    let all = quantities(&Method::both().unwrap());
    let (mut told, mut enough) = (0, 0);
    for quantity in all.iter().filter(|quantity| quantity.why.starts_with("no noise: with noise, below")) {
        let what = quantity.what.replace("and falloff", "falloff and noise, a run");
        let noisy = all.iter().find(|other| other.what == what).unwrap();
        let number = format!("below, {:.1} mm", 1e3 * noisy.predicted_m);
        assert!(quantity.why.contains(&number), "{}: {}", quantity.what, quantity.why);
        assert_eq!(quantity.why.contains("not enough"), noisy.is_within() == Some(false), "{}", quantity.why);
        told += 1;
        enough += usize::from(noisy.is_within() == Some(true));
    }
    assert_eq!((told, enough), (3, 1));
}

/// What a calibration leaves of the error at its own frequency is a smaller share than at another, where the waveform is another, too. (In
/// metres the error itself shrinks at 40 MHz, with the third harmonic and with the unambiguous range.)
#[test]
fn calibrations_hold_for_their_own_waveform_only() {
    let [four, wdft] = Method::both().unwrap();
    let left = |calibration, hz| {
        let rms_m = |calibration| calibrated_rms_m(&four, calibration, waveform_at(hz), hz);
        rms_m(Some(calibration)) / rms_m(None)
    };
    for calibration in &CALIBRATIONS {
        let (here, there) = (left(calibration, 30e6), left(calibration, 40e6));
        assert!(here < 1.0 && there > here, "{}: {here}, {there}", calibration.name);
    }
    // Seven coefficients do not follow four cycles.
    assert!(left(&CALIBRATIONS[1], 30e6) > 0.5);
    assert!(calibrated_rms_m(&wdft, None, waveform_at(40e6), 40e6) < 0.005);
}

#[test]
fn frames_at_once_do_not_move() {
    let [four, _] = Method::both().unwrap();
    let usual = ordered_rms_m(&four, Conditions::table_1(), &[0, 1, 2, 3]);
    assert!(at_once_rms_m(&four, with_falloff(1.0)) < 1e-9);
    // Amplitude v t_f / 2 in two cycles, and what the harmonics' fourth adds.
    assert!((usual / (0.03125 / 2f64.sqrt()) - 1.0).abs() < 0.1, "{usual}");
}

#[test]
fn every_figure_of_the_paper_is_there_once_with_finite_points() {
    let figures = figures().unwrap();
    let numbers: Vec<u32> = figures.iter().map(|figure| figure.number).collect();
    assert_eq!(numbers, (1..=12).collect::<Vec<_>>());
    for figure in figures {
        assert!(!figure.assumed.is_empty());
        for plot in &figure.plots {
            assert!(plot.points.len() > 20, "figure {}, {}", figure.number, plot.name);
            assert!(
                plot.points.iter().all(|(x, y)| x.is_finite() && y.is_finite()),
                "figure {}",
                figure.number
            );
        }
    }
}

/// The golden numbers are of another independent program, in numpy, without noise: rays by similar triangles, closed forms of both
/// arctangents, cosines summed directly. All 7168 pixels within eight columns of an edge, of eight runs.
#[test]
fn a_moving_edge_errs_as_in_an_independent_program() {
    let [four, wdft] = Method::both().unwrap();
    let rms_m = |method: &Method, correlation: &Correlation, velocity_m_s: f64| {
        let errors_m: Vec<f64> = (0..RUNS)
            .map(|run| take(method, correlation, velocity_m_s, run, false))
            .flat_map(|take| {
                let all = (REMEDIES[0].errors_m)(method, &take).into_iter().zip(take.near.clone());
                all.filter(|(_, near)| *near).filter_map(|(error_m, _)| error_m).collect::<Vec<_>>()
            })
            .collect();
        assert_eq!(errors_m.len(), 7168);
        rms(&errors_m)
    };
    let golden = [
        (&four, 0.0, 0.093_871_005_69),
        (&wdft, 0.0, 0.092_859_456_47),
        (&four, 1.0, 0.333_803_075_87),
        (&wdft, 1.0, 0.381_959_630_79),
        (&four, 2.0, 0.493_933_495_34),
        (&wdft, 2.0, 0.522_065_111_56),
    ];
    for (method, velocity_m_s, golden_m) in golden {
        let found_m = rms_m(method, &Correlation::measured(), velocity_m_s);
        assert!((found_m - golden_m).abs() < 1e-9, "{} at {velocity_m_s}: {found_m}", method.name);
    }
    // A waveform or a velocity that is another is seen.
    assert!((rms_m(&four, &Correlation::sinusoidal(), 1.0) - 0.333_803_075_87).abs() > 1e-4);
    assert!((rms_m(&four, &Correlation::measured(), 1.01) - 0.333_803_075_87).abs() > 1e-4);
}

/// What the table's notes say of the remedies.
#[test]
fn remedies_against_lateral_motion_do_what_the_table_says() {
    let [four, _] = Method::both().unwrap();
    let (still, moving) = (near_edges(&four, 0.0), near_edges(&four, 1.0));
    let [plain, flow, true_motion, carried, left_out, replaced] = moving[..] else { panic!("{moving:?}") };
    // Where nothing moves, nothing is changed but by noise: of 100 mm, a few.
    assert!(still.iter().all(|near| (near.rms_m / still[0].rms_m - 1.0).abs() < 0.05), "{still:?}");
    assert_eq!((still[2], still[3]), (still[0], still[0]));
    assert!(flow.rms_m < true_motion.rms_m && true_motion.rms_m < plain.rms_m, "{moving:?}");
    assert!(carried.rms_m < true_motion.rms_m, "{moving:?}");
    assert!(left_out.rms_m < plain.rms_m && left_out.without > 0.2 && replaced.without == 0.0, "{moving:?}");
}
