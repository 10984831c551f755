//! The sweep against what is known without it: an oracle of another library, tiny words enumerated by hand, units whose errors
//! are known, and itself in parts.

mod oracle;

use oracle::Oracle;
use rayon::ThreadPoolBuilder;
use std::f64::consts::TAU;
use vuris::spec::{Rounding, Throughput};
use vuris::sweep::{
    BOUND_UNITS, Configuration, Coverage, ExactAngle, Figures, PhaseOf, Plan, Shard, Tally, UNIT_BITS, Worst,
    evaluate,
};

fn word(bits: u32, phase_bits: u32) -> Configuration {
    Configuration {
        metric: 1,
        x_bits: bits,
        y_bits: bits,
        phase_bits,
        length_bits: 0,
        iterations: phase_bits,
        vector_guard_bits: 2,
        angle_guard_bits: 3,
        throughput: Throughput::CyclesPerPixel(1),
        pipeline_every: 1,
        normaliser: true,
        rounding: Rounding::Nearest,
    }
}

fn scheme(metric: i64) -> &'static str {
    if metric == 3 { "wdft" } else { "four_frame" }
}

/// The tally of `unit` on the words of `configuration`.
fn tally(unit: &impl PhaseOf, configuration: &Configuration, samples: u64) -> Tally {
    let plan = Plan::new(configuration, samples, false);
    evaluate(unit, &ExactAngle::new(configuration.metric), &plan, Shard::WHOLE, &|_| ())
}

/// A unit that is any function of the exact phase in codes, by the platform's arc tangent.
struct Exactly {
    bits: u32,
    round: fn(f64) -> f64,
}

impl PhaseOf for Exactly {
    fn phase(&self, x: i64, y: i64) -> i64 {
        let codes = (y as f64).atan2(x as f64) / TAU * f64::from(self.bits).exp2();
        (self.round)(codes) as i64 & ((1 << self.bits) - 1)
    }

    fn phase_bits(&self) -> u32 {
        self.bits
    }
}

// ---------------------------------------------------------------- the exact angle

/// The bound that is stated, against 128 bits of another library.
#[test]
fn the_exact_angle_is_within_its_bound() {
    let mut oracle = Oracle::new();
    let mut largest = 0.0_f64;
    for metric in [1, 3] {
        let exact = ExactAngle::new(metric);
        let mut state = 20_121_112_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state as i64
        };
        let random = (0..12_000).map(|n| (next() >> (34 + n % 29), next() >> (34 + n * 7 % 29)));
        let end = 1 << 29;
        // Where the table's cell changes, and the ends of the words.
        let edges = (0..=256).map(|k| (512 * 1_000_003, (2 * k + 1) * 1_000_003 - k % 2));
        let corners = [(-end, -end), (-end, 1), (1, -end), (end - 1, end - 2), (end - 2, end - 1), (7, 1)];
        for (x, y) in random.collect::<Vec<_>>().into_iter().chain(edges).chain(corners) {
            if (x, y) == (0, 0) {
                continue;
            }
            let angle = ExactAngle::unfold(x, y, exact.quadrant(x, y).0);
            assert!((0..1 << UNIT_BITS).contains(&angle));
            let off = oracle.phase_difference(scheme(metric), x, y, UNIT_BITS, angle);
            assert!(off.abs() <= BOUND_UNITS as f64, "metric {metric} ({x}, {y}): {off}");
            largest = largest.max(off.abs());
        }
    }
    println!("largest error of an exact angle: {largest:.2} of {BOUND_UNITS} units");
    assert!(largest > 0.5, "a bound that nothing comes near is no bound of this");
}

// ---------------------------------------------------------------- by hand

/// All fifteen vectors of 2-bit words, and a unit that always says 0: the errors are the angles themselves.
#[test]
fn a_tiny_word_by_hand() {
    struct Zero;
    impl PhaseOf for Zero {
        fn phase(&self, _: i64, _: i64) -> i64 {
            0
        }
        fn phase_bits(&self) -> u32 {
            4
        }
    }
    // atan(1/2) / 2 pi.
    let a = 0.073_791_808_825_216_63;
    // (1,0) (1,1) (0,1) (-1,1) (-1,0) (-1,-1) (0,-1) (1,-1) (-2,0) (0,-2) (-2,-2) (-2,1) (-2,-1) (-1,-2) (1,-2)
    let errors = [
        0.0,
        -0.125,
        -0.25,
        -0.375,
        -0.5,
        0.375,
        0.25,
        0.125,
        -0.5,
        0.25,
        0.375,
        a - 0.5,
        0.5 - a,
        0.25 + a,
        0.25 - a,
    ];
    let rows = Figures::rows(&tally(&Zero, &word(2, 4), 1));
    let all = rows[0].figures;
    assert_eq!((all.vectors, all.corners), (15, 0));
    let sum: f64 = errors.iter().sum();
    let squares: f64 = errors.iter().map(|error| error * error).sum();
    assert!((all.mean_turns - sum / 15.0).abs() < 1e-15);
    assert!((all.rms_turns - (squares / 15.0).sqrt()).abs() < 1e-13);
    assert_eq!(all.max_turns, 0.5);
    assert_eq!(all.worst, Some(Worst { error: -1 << (UNIT_BITS - 1), x: -1, y: 0 }));
    assert_eq!((all.faithful, all.correctly_rounded), (1.0 / 15.0, 1.0 / 15.0));
    // Octaves: length 1 to 2 has the eight around, 2 to 4 the other seven.
    let counts: Vec<_> = rows.iter().map(|row| (row.octave, row.figures.vectors)).collect();
    assert_eq!(counts, [(None, 15), (Some(0), 8), (Some(1), 7)]);
}

/// Every figure of small words, recomputed with the oracle in place of the exact angle.
#[test]
fn small_words_are_as_the_oracle_says() {
    let mut oracle = Oracle::new();
    for (metric, bits, phase_bits, throughput) in [
        (1, 5, 6, Throughput::CyclesPerPixel(1)),
        (3, 5, 7, Throughput::CyclesPerPixel(1)),
        (1, 4, 5, Throughput::OneIterationAClock),
        (3, 4, 8, Throughput::OneIterationAClock),
    ] {
        let configuration = Configuration { metric, throughput, ..word(bits, phase_bits) };
        let unit = configuration.unit().unwrap();
        let codes = f64::from(phase_bits).exp2();
        let range = -(1_i64 << (bits - 1))..1 << (bits - 1);
        let (mut count, mut sum, mut squares, mut max, mut faithful, mut rounded) =
            (0, 0.0, 0.0, 0.0_f64, 0, 0);
        for x in range.clone() {
            for y in range.clone().filter(|&y| (x, y) != (0, 0)) {
                let code = unit.phase(x, y);
                let off = oracle.phase_difference(scheme(metric), x, y, phase_bits, code);
                let off = off - codes * (off / codes).round();
                (count, sum, squares) = (count + 1, sum + off, squares + off * off);
                max = max.max(off.abs());
                faithful += u64::from(off.abs() < 1.0);
                rounded += u64::from(off.abs() <= 0.5);
            }
        }
        let all = Figures::rows(&tally(&unit, &configuration, 1))[0].figures;
        let n = f64::from(count);
        assert_eq!(all.vectors, count as u64);
        assert!((all.max_turns * codes - max).abs() < 1e-12, "{configuration}");
        assert!((all.mean_turns * codes - sum / n).abs() < 1e-12, "{configuration}");
        assert!((all.rms_turns * codes - (squares / n).sqrt()).abs() < 1e-10, "{configuration}");
        assert_eq!((all.faithful, all.correctly_rounded), (faithful as f64 / n, rounded as f64 / n));
        let worst = all.worst.unwrap();
        let off = oracle.phase_difference(
            scheme(metric),
            worst.x,
            worst.y,
            phase_bits,
            unit.phase(worst.x, worst.y),
        );
        let off = (off - codes * (off / codes).round()).abs();
        assert!((off - max).abs() < 1e-12, "{configuration}: ({}, {}) is {off}, not {max}", worst.x, worst.y);
    }
}

// ---------------------------------------------------------------- units whose errors are known

/// What is cut off is half a code in the mean, in every octave, and never a whole one; what is rounded has no mean.
#[test]
fn a_truncating_unit_shows_its_bias_and_a_rounding_one_none() {
    for (bits, samples) in [(10, 1), (20, 20_000)] {
        let configuration = word(bits, 16);
        let lsb = 65_536.0;
        for row in Figures::rows(&tally(&Exactly { bits: 16, round: f64::floor }, &configuration, samples)) {
            let figures = row.figures;
            assert!(figures.all_faithful && figures.max_turns * lsb < 1.0, "{row:?}");
            // Weak octaves are few angles, and many of those on axes and diagonals, where there is nothing to cut off.
            if row.octave.is_none_or(|octave| octave >= 5) {
                assert!((figures.mean_turns * lsb + 0.5).abs() < 0.025, "{row:?}");
                assert!(figures.octant_mean_turns.abs() * lsb < 0.025, "{row:?}");
            }
        }
        for row in Figures::rows(&tally(&Exactly { bits: 16, round: f64::round }, &configuration, samples)) {
            let figures = row.figures;
            assert!((figures.mean_turns * lsb).abs() < 0.02 && figures.max_turns * lsb <= 0.5, "{row:?}");
            assert_eq!((figures.faithful, figures.correctly_rounded), (1.0, 1.0));
        }
    }
}

/// A unit that is a code off everywhere is faithful nowhere but where the exact phase is between: decisions at the very limit.
#[test]
fn exactly_one_code_is_not_faithful() {
    let one_more = Exactly { bits: 12, round: |codes| codes.round() + 1.0 };
    let rows = Figures::rows(&tally(&one_more, &word(2, 12), 1));
    // Of the 15 vectors 11 lie on axes and diagonals: exactly one code. The others are at 0.0737918 turn and its mirror images,
    // 302.25 codes: rounded to 302, one more is 0.75 too many; the mirror images one and a quarter.
    assert_eq!(rows[0].figures.faithful, 2.0 / 15.0);
    assert_eq!(rows[0].figures.correctly_rounded, 0.0);
}

// ---------------------------------------------------------------- parts and wholes

fn cases() -> Vec<Configuration> {
    vec![
        word(9, 10),
        Configuration { metric: 3, x_bits: 16, y_bits: 14, ..word(16, 12) },
        Configuration { normaliser: false, rounding: Rounding::Truncate, ..word(18, 16) },
    ]
}

#[test]
fn shards_and_threads_do_not_change_a_bit() {
    for configuration in cases() {
        let unit = configuration.unit().unwrap();
        let exact = ExactAngle::new(configuration.metric);
        let plan = Plan::new(&configuration, 3000, false);
        let part = |shard| evaluate(&unit, &exact, &plan, shard, &|_| ());
        let whole = part(Shard::WHOLE);
        for count in [2, 3, 7, 1000] {
            let mut parts: Vec<Tally> = (1..=count).map(|index| part(Shard { index, count })).collect();
            assert!(
                count > 3 || parts.iter().all(|part| *part != whole && *part != Tally::new(plan.octaves()))
            );
            for _ in 0..3 {
                let first = parts.remove(0);
                parts.push(first);
                let merged = parts.iter().fold(Tally::default(), |sum, part| sum.merged(part));
                assert_eq!(merged, whole, "{configuration} in {count}");
            }
        }
        for threads in [1, 2, 5] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert_eq!(pool.install(|| part(Shard::WHOLE)), whole, "{threads} threads");
        }
    }
}

/// A decision that the fast angle leaves to wide arithmetic is the one that the fast angle made.
#[test]
fn wide_decisions_are_the_fast_ones() {
    for configuration in [word(6, 6), Configuration { metric: 3, ..word(5, 9) }] {
        let unit = configuration.unit().unwrap();
        let plan = Plan::new(&configuration, 1, false);
        let of = |exact: &ExactAngle| evaluate(&unit, exact, &plan, Shard::WHOLE, &|_| ());
        let exact = ExactAngle::new(configuration.metric);
        assert_eq!(of(&exact), of(&exact.clone().deciding_within(1 << (UNIT_BITS - 1))));
    }
}

#[test]
fn what_is_drawn_speaks_for_all() {
    let configuration = Configuration { x_bits: 13, ..word(12, 12) };
    let unit = configuration.unit().unwrap();
    let exact = ExactAngle::new(1);
    let rows = |plan: &Plan| Figures::rows(&evaluate(&unit, &exact, plan, Shard::WHOLE, &|_| ()));
    let drawn = Plan::new(&configuration, 50_000, false);
    assert_eq!(drawn.coverage(), Coverage::Stratified { samples: 50_000 });
    let all = Plan::new(&configuration, 50_000, true);
    assert_eq!(all.coverage(), Coverage::Exhaustive);
    let (drawn, all) = (rows(&drawn), rows(&all));
    assert_eq!(all[0].figures.vectors, (1 << 25) - 1);
    let lsb = 4096.0;
    for (drawn, all) in drawn.iter().zip(&all) {
        assert_eq!(drawn.octave, all.octave);
        let (drawn, all) = (drawn.figures, all.figures);
        assert!(
            drawn.max_turns <= all.max_turns && drawn.max_turns >= 0.85 * all.max_turns,
            "{drawn:?} {all:?}"
        );
        assert!((drawn.rms_turns - all.rms_turns).abs() <= 0.02 * all.rms_turns, "{drawn:?} {all:?}");
        assert!((drawn.mean_turns - all.mean_turns).abs() * lsb < 0.01, "{drawn:?} {all:?}");
    }
    // Weak octaves are visited whole.
    for octave in 0..6 {
        assert_eq!(drawn[octave + 1].figures.rms_turns, all[octave + 1].figures.rms_turns);
        assert_eq!(drawn[octave + 1].figures.vectors, all[octave + 1].figures.vectors);
    }
}

/// The proved worst case holds for every vector of every kind of unit that fits an exhaustive visit here.
#[test]
fn no_unit_is_further_off_than_its_budget() {
    for metric in [1, 3] {
        for throughput in
            [Throughput::CyclesPerPixel(1), Throughput::CyclesPerPixel(3), Throughput::OneIterationAClock]
        {
            for rounding in [Rounding::Nearest, Rounding::Truncate] {
                let configuration = Configuration { metric, throughput, rounding, ..word(9, 11) };
                let unit = configuration.unit().unwrap();
                let max_turns = Figures::rows(&tally(&unit, &configuration, 1))[0].figures.max_turns;
                let codes = max_turns * 2048.0;
                assert!(codes <= unit.budget().phase_codes(), "{configuration}: {codes}");
            }
        }
    }
}
