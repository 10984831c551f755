//! Unwrapping with two modulation frequencies: the model against all ambiguity numbers tried by hand, the derived margin
//! and error bound exhaustively for a small word, frames of light at known ranges, pairs of sets, and the Verilog.

mod support;

use std::f64::consts::TAU;
use support::{accepted, everything, small, two_at_a_time};
use vuris::artifact::Artifact;
use vuris::cosim::{Simulation, Simulator, Traffic, random_sets};
use vuris::frames::RawSets;
use vuris::hdl::{Golden, Scenario, Source};
use vuris::model::{Beat, PipelineModel, PixelRecord, StreamEvent, Unwrapped, beats_of_set, unwrap_phases};
use vuris::spec::{Pipeline, Specification, Unwrapper, Unwrapping};
use vuris::units::unambiguous_range_m;

/// Ratios of every kind: next to each other, far apart, either order, one of them 1, the largest.
const RATIOS: [[i64; 2]; 8] = [[5, 4], [4, 5], [6, 5], [7, 3], [2, 1], [1, 3], [16, 15], [11, 16]];

fn unwrapping(ratio: [i64; 2]) -> Unwrapping {
    Unwrapping { ratio, weights: ratio.map(|factor| factor * factor), residual_limit_turns: 0.25 }
}

fn pipeline(unwrapping: Unwrapping, change: impl FnOnce(&mut Specification)) -> Pipeline {
    small("vuris-four-frame", |specification| {
        specification.output.distance_unit_m = 1e-4;
        specification.unwrapping = Some(unwrapping);
        change(specification);
    })
}

/// With 8-bit phases: small enough to visit whole.
fn of_8_bits(unwrapping: Unwrapping) -> Pipeline {
    pipeline(unwrapping, |specification| {
        specification.output.phase_bits = 8;
        specification.cordic.iterations = 10;
        specification.output.distance_unit_m = 1e-2;
    })
}

fn unwrapper(pipeline: &Pipeline) -> &Unwrapper {
    pipeline.derived().unwrapper.as_ref().unwrap()
}

/// `difference` on the circle of `turn` codes.
fn circular(difference: f64, turn: f64) -> f64 {
    difference - turn * (difference / turn).round()
}

/// Every pair of phases: of all M N ways to unwrap both, the one whose ranges are nearest to each other, and their mean.
#[test]
fn every_pair_of_phases_is_unwrapped_to_the_nearest_pair_of_ranges() {
    two_at_a_time(&RATIOS, |&ratio| {
        for weights in [ratio.map(|factor| factor * factor), [1, 0], [0, 7], [3, 1]] {
            let pipeline = of_8_bits(Unwrapping { weights, ..unwrapping(ratio) });
            let unwrapper = unwrapper(&pipeline);
            let [m, n] = ratio;
            let turn = (m * n * 256) as f64;
            let share = weights[1] as f64 / (weights[0] + weights[1]) as f64;
            for (first, second) in (0..256).flat_map(|first| (0..256).map(move |second| (first, second))) {
                // Ranges in turns of f0 / (M N 256).
                let ranges = |phase: i64, own: i64, other: i64| {
                    (0..own).map(move |k| (other * (k * 256 + phase)) as f64)
                };
                let pairs =
                    ranges(first, m, n).flat_map(|one| ranges(second, n, m).map(move |two| (one, two)));
                let apart = |&(one, two): &(f64, f64)| circular(one - two, turn);
                let nearest = pairs.min_by(|a, b| apart(a).abs().total_cmp(&apart(b).abs())).unwrap();
                let Unwrapped { residual, code, .. } = unwrap_phases(unwrapper, first, second);
                // Half a turn either way is as near: no answer is right.
                if residual == -128 {
                    assert_eq!(apart(&nearest).abs(), 128.0);
                    continue;
                }
                assert_eq!(residual as f64, apart(&nearest), "{ratio:?}: {first}, {second}");
                let mean = nearest.0 - share * apart(&nearest);
                // Half a code of rounding, and the share's own rounding to 12 bits.
                let off = circular(code as f64 - mean, turn).abs();
                assert!(
                    off <= 0.5 + 128.0 / 8192.0 + 1e-9,
                    "{ratio:?}, {weights:?}: {first}, {second}: {code}, not {mean}"
                );
            }
        }
    });
}

/// Every range of a small word, with every pair of errors below the margin: the ambiguity number is right and the unwrapped
/// phase within its bound. At the margin and with opposite signs it is not always.
#[test]
fn errors_below_the_margin_leave_the_ambiguity_number_right_and_those_at_it_do_not() {
    two_at_a_time(&RATIOS, |&ratio| {
        let pipeline = of_8_bits(unwrapping(ratio));
        let unwrapper = unwrapper(&pipeline);
        let [m, n] = ratio;
        let turn = m * n * 256;
        let margin = unwrapper.margin_codes();
        let phase = |range: i64, other: i64, error: i64| -> (i64, f64) {
            // Rounded to a code, and `error` codes off: the whole error is known.
            let exact = range as f64 / other as f64;
            let code = exact.round() as i64 + error;
            (code.rem_euclid(256), code as f64 - exact)
        };
        let (mut worst, mut wrong_at_margin) = (0_f64, false);
        let most = margin.ceil() as i64;
        for range in 0..turn {
            for (e1, e2) in
                (-most..=most).flat_map(|e1| [(e1, -e1), (e1, e1), (e1, 0), (0, e1), (e1, most - e1.abs())])
            {
                let ((first, off_1), (second, off_2)) = (phase(range, n, e1), phase(range, m, e2));
                let unwrapped = unwrap_phases(unwrapper, first, second);
                let off = circular((unwrapped.code - range) as f64, turn as f64).abs();
                let bound = unwrapper.error_codes(off_1.abs().max(off_2.abs()));
                if off_1.abs().max(off_2.abs()) < margin {
                    assert!(
                        off <= bound,
                        "{ratio:?}: range {range}, errors {off_1}, {off_2}: off by {off}, bound {bound}"
                    );
                    worst = worst.max(off / bound);
                } else {
                    wrong_at_margin |= off > bound;
                }
            }
        }
        println!("{ratio:?}: margin {margin:.2} codes, worst {:.0} % of the bound", 100.0 * worst);
        assert!(worst > 0.9, "{ratio:?}: the bound is far from the worst case");
        assert!(wrong_at_margin, "{ratio:?}: the margin is wider than it says");
    });
}

/// Four frames of light at `range_m`, at the first and the second frequency in turn, from pixel to pixel `step_m` further.
fn light(pipeline: &Pipeline, range_m: f64, step_m: f64, second: bool) -> RawSets {
    let [m, n] = unwrapper(pipeline).ratio;
    let frequency_hz = pipeline.modulation.frequency_hz * if second { n as f64 / m as f64 } else { 1.0 };
    let scheme = &pipeline.modulation.scheme;
    let pixels = pipeline.geometry().pixels();
    let code = |frame: usize, pixel: usize| {
        let phase_rad = TAU * (range_m + step_m * pixel as f64) / unambiguous_range_m(frequency_hz);
        (1900.0 * (scheme.angle_rad(frame) - phase_rad).cos() + 2000.0).round() as u32
    };
    let codes = (0..scheme.steps()).flat_map(|frame| (0..pixels).map(move |pixel| code(frame, pixel)));
    RawSets::new(pipeline.geometry(), scheme.steps(), codes.collect()).unwrap()
}

fn events(raw: &RawSets, second_frequency: bool) -> Vec<StreamEvent> {
    beats_of_set(raw, 0).map(|beat| StreamEvent::Beat(Beat { second_frequency, ..beat })).collect()
}

/// The result frames of `events`.
fn results(pipeline: &Pipeline, events: impl IntoIterator<Item = StreamEvent>) -> Vec<Vec<PixelRecord>> {
    let mut model = PipelineModel::new(pipeline);
    events.into_iter().chain([StreamEvent::Rest]).filter_map(|event| model.advance(event)).collect()
}

#[test]
fn light_at_every_range_of_the_longer_unambiguous_range_comes_back_at_it() {
    for ratio in RATIOS {
        let pipeline = pipeline(unwrapping(ratio), |_| {});
        let unit_m = pipeline.output.distance_unit_m;
        let range_m = unambiguous_range_m(pipeline.modulation.frequency_hz / ratio[0] as f64);
        let step_m = range_m / pipeline.geometry().pixels() as f64;
        let sets = [false, true, false].map(|second| events(&light(&pipeline, 0.01, step_m, second), second));
        let results = results(&pipeline, sets.concat());
        assert!(results[0].iter().all(|record| record.valid && !record.unambiguous && record.distance == 0));
        for result in &results[1..] {
            for (pixel, record) in result.iter().enumerate() {
                assert!(record.unambiguous, "{ratio:?}, pixel {pixel}: {record:?}");
                // Half a code of 1900 in four frames turns either phase by less than 1/(1900 sqrt 2) rad.
                let allowed_m = range_m / TAU / 1900.0 / ratio[0].min(ratio[1]) as f64 + unit_m;
                let off_m =
                    circular(record.distance as f64 * unit_m - 0.01 - step_m * pixel as f64, range_m).abs();
                assert!(
                    off_m <= allowed_m,
                    "{ratio:?}, pixel {pixel}: off by {off_m} m, allowed {allowed_m}"
                );
            }
        }
    }
}

#[test]
fn only_a_set_right_after_one_of_the_other_frequency_is_unwrapped() {
    let pipeline = pipeline(unwrapping([5, 4]), |_| {});
    let set = |second| events(&light(&pipeline, 1.0, 0.01, second), second);
    let cut = |second| set(second)[..30].to_vec();
    let reset = || vec![StreamEvent::Reset];
    for (name, parts, expected) in [
        ("in turn", vec![set(false), set(true), set(false), set(true)], &[false, true, true, true][..]),
        ("beginning with the second", vec![set(true), set(false)], &[false, true]),
        ("twice the same", vec![set(false), set(true), set(true), set(false)], &[false, true, false, true]),
        ("one lost between", vec![set(false), cut(false), set(true), set(false)], &[false, false, true]),
        (
            "reset between",
            vec![set(false), vec![StreamEvent::Rest], reset(), set(true), set(false)],
            &[false, false, true],
        ),
    ] {
        let results = results(&pipeline, parts.concat());
        let unwrapped: Vec<bool> = results.iter().map(|result| result[7].unambiguous).collect();
        assert_eq!(unwrapped, expected, "{name}");
    }
}

#[test]
fn a_pixel_that_is_not_usable_or_whose_phases_disagree_has_no_unwrapped_phase() {
    let dark = RawSets::new(small("vuris-four-frame", |_| {}).geometry(), 4, vec![500; 4 * 108]).unwrap();
    let limit = Unwrapping { residual_limit_turns: 0.1, ..unwrapping([5, 4]) };
    let pipeline = pipeline(limit, |_| {});
    let bright = |second| events(&light(&pipeline, 1.0, 0.01, second), second);
    for parts in [[bright(false), events(&dark, true)], [events(&dark, false), bright(true)]] {
        let last = results(&pipeline, parts.concat()).pop().unwrap();
        assert!(
            last.iter()
                .all(|record| (record.unambiguous, record.unwrapped, record.distance) == (false, 0, 0))
        );
    }
    // Two ranges disagree by so much that the residual, N e1 - M e2, is in turn below and above the limit of a tenth.
    let off_by = |turns: f64| {
        let shift_m = turns * 1.25 * unambiguous_range_m(pipeline.modulation.frequency_hz);
        results(
            &pipeline,
            [bright(false), events(&light(&pipeline, 1.0 + shift_m, 0.01, true), true)].concat(),
        )
        .pop()
        .unwrap()[7]
            .unambiguous
    };
    // A shift of the second range by x turns of its own is a residual of 5 x.
    assert_eq!([0.0, 0.015, 0.025, -0.015, -0.025].map(off_by), [true, true, false, true, false]);
}

#[test]
fn specifications_that_cannot_unwrap_are_refused_with_the_reason() {
    let good = pipeline(unwrapping([5, 4]), |_| {}).to_toml();
    assert_eq!(Pipeline::parse("again", &good).unwrap(), pipeline(unwrapping([5, 4]), |_| {}));
    for (from, to, parts) in [
        ("ratio = [5, 4]", "ratio = [6, 4]", &["unwrapping.ratio = [6, 4]", "without a common divisor"][..]),
        ("ratio = [5, 4]", "ratio = [5, 5]", &["unwrapping.ratio = [5, 5]", "different"]),
        ("ratio = [5, 4]", "ratio = [17, 4]", &["unwrapping.ratio = [17, 4]", "1 to 16"]),
        ("ratio = [5, 4]", "ratio = [5, 0]", &["unwrapping.ratio = [5, 0]", "1 to 16"]),
        ("ratio = [5, 4]", "ratio = [5]", &["unwrapping.ratio = [5]", "two whole numbers"]),
        ("ratio = [5, 4]", "ratio = 1.25", &["unwrapping.ratio = 1.25", "two whole numbers"]),
        ("ratio = [5, 4]\n", "", &["unwrapping.ratio is missing", "two whole numbers"]),
        ("weights = [25, 16]", "weights = [0, 0]", &["unwrapping.weights = [0, 0]", "not both 0"]),
        ("weights = [25, 16]", "weights = [-1, 4096]", &["unwrapping.weights = [-1, 4096]", "0 to 4095"]),
        ("turns = 0.25", "turns = 0.0", &["unwrapping.residual_limit_turns = 0", "above 0"]),
        ("turns = 0.25", "turns = 0.6", &["unwrapping.residual_limit_turns = 0.6", "5e-1"]),
        (
            "residual_limit_turns",
            "residual_limit",
            &["unwrapping.residual_limit is not a field", "residual_limit_turns"],
        ),
        ("distance_unit_m = 0.0001", "distance_unit_m = 1e-9", &["output.distance_unit_m = "]),
    ] {
        assert!(good.contains(from), "{from}: {good}");
        let refusal = Pipeline::parse("own.toml", &good.replacen(from, to, 1)).unwrap_err().to_string();
        for part in ["own.toml"].iter().chain(parts) {
            assert!(refusal.contains(part), "{to}: {refusal}");
        }
    }
    let defaults = good.replace("weights = [25, 16]\nresidual_limit_turns = 0.25\n", "");
    assert_eq!(Pipeline::parse("again", &defaults).unwrap(), Pipeline::parse("again", &good).unwrap());
}

/// Specifications of every kind, and some chosen ones.
fn cosimulated() -> Vec<(String, Pipeline)> {
    let mut all = vec![
        ("5:4, one iteration a clock".to_owned(), pipeline(unwrapping([5, 4]), |_| {})),
        (
            "16:15 of 24 bits".to_owned(),
            pipeline(
                Unwrapping { weights: [0, 1], residual_limit_turns: 0.5, ..unwrapping([16, 15]) },
                |s| {
                    (s.output.phase_bits, s.output.distance_unit_m) = (24, 1e-2);
                },
            ),
        ),
        (
            "2:1 of 8 bits, phase only".to_owned(),
            pipeline(Unwrapping { weights: [1, 0], residual_limit_turns: 0.01, ..unwrapping([2, 1]) }, |s| {
                (s.output.phase_bits, s.output.amplitude, s.output.distance_unit_m) = (8, false, 0.1);
                s.cordic.iterations = 8;
            }),
        ),
    ];
    for (number, base) in accepted(10).into_iter().enumerate() {
        let ratio = RATIOS[number % RATIOS.len()];
        let changed = base.adapted("unwrapping", |specification| {
            specification.unwrapping = Some(unwrapping(ratio));
            specification.output.distance_unit_m *= ratio[0] as f64 * 4.0;
            specification.output.minimum_amplitude_dn = 0.0;
        });
        all.extend(
            changed.ok().map(|pipeline| (format!("any, {ratio:?}"), pipeline)).filter(|_| all.len() < 6),
        );
    }
    all
}

#[test]
fn unwrapping_agrees_in_both_simulators() {
    let all = cosimulated();
    assert!(all.len() == 6, "most random specifications must be accepted");
    let runs: Vec<_> = all.iter().flat_map(|row| Simulator::ALL.map(|simulator| (row, simulator))).collect();
    let values = two_at_a_time(&runs, |&((name, pipeline), simulator)| {
        let mut scenario = everything(pipeline, 11);
        scenario.segments.extend(
            Scenario {
                segments: vec![vuris::hdl::Segment::of_sets("many sets", &random_sets(pipeline, 12, 12))],
            }
            .in_turn()
            .segments,
        );
        let golden = Golden::new(pipeline, &scenario);
        let unambiguous = golden.records.iter().filter(|record| record.unambiguous).count();
        assert!((1..golden.records.len()).contains(&unambiguous), "{name}: {unambiguous} unwrapped");
        let folder = tempfile::tempdir().unwrap();
        let source = Source { pipeline, spec: "test" };
        let simulation = Simulation::build(source, &golden, simulator, folder.path(), &|_| {}).unwrap();
        let [mixed, straight, ..] = Traffic::profiles(3);
        [mixed, straight]
            .map(|traffic| {
                let outcome = simulation.run(traffic).unwrap();
                let findings: Vec<String> = outcome.findings.iter().map(ToString::to_string).collect();
                assert_eq!(outcome.mismatches, 0, "{name}, {}: {findings:#?}", simulator.name());
                outcome.values
            })
            .iter()
            .sum::<u64>()
    });
    println!("{} values compared in {} runs", values.iter().sum::<u64>(), runs.len());
}

/// A sensor of 4 x 2 pixels: the harness' stops of 256 clocks outlast its sets of 32 samples, so that a set's last pixel still
/// waits for the sink when the next set, of another frequency or without a partner, begins to drain.
fn few_pixels() -> Pipeline {
    pipeline(unwrapping([5, 4]), |specification| {
        specification.sensor.width = 4;
        specification.sensor.height = 2;
        specification.sensor.line_blanking_clocks = 16;
        specification.modulation.frames_per_step = 1;
        // A pixel is over soon, so that there are many sets, and many last pixels.
        (specification.output.phase_bits, specification.output.distance_unit_m) = (8, 1e-2);
        specification.cordic.iterations = 8;
    })
}

/// Values that differ in each mixture of pauses and stops, with what `change` does to the Verilog.
fn mismatches(pipeline: &Pipeline, simulator: Simulator, change: &dyn Fn(&mut Vec<Artifact>)) -> [u64; 4] {
    let mut scenario = everything(pipeline, 21);
    scenario.segments.push(vuris::hdl::Segment::of_sets("many sets", &random_sets(pipeline, 22, 400)));
    let golden = Golden::new(pipeline, &scenario.in_turn());
    let folder = tempfile::tempdir().unwrap();
    let source = Source { pipeline, spec: "test" };
    let simulation = Simulation::build(source, &golden, simulator, folder.path(), change).unwrap();
    Traffic::profiles(5).map(|traffic| {
        let outcome = simulation.run(traffic).unwrap();
        for finding in outcome.findings.iter().take(3) {
            println!("{}, {traffic:?}: {finding}", simulator.name());
        }
        outcome.mismatches
    })
}

#[test]
fn a_sets_last_pixel_keeps_its_frequency_while_it_waits_for_longer_than_the_next_set_takes() {
    let pipeline = few_pixels();
    for simulator in Simulator::ALL {
        assert_eq!(mismatches(&pipeline, simulator, &|_| {}), [0; 4], "{}", simulator.name());
    }
    // Marks that are the draining set's and not the pixel's: right as long as nothing waits.
    let of_the_set = |artifacts: &mut Vec<Artifact>| {
        let top = format!("rtl/{}.v", pipeline.top());
        let file = artifacts.iter_mut().find(|file| file.path == top).unwrap();
        let marks = "{sums_second_q, sums_partner_q, ";
        assert_eq!(file.text.matches(marks).count(), 1);
        file.text = file.text.replace(marks, "{drain_second_q, drain_partner_q, ");
    };
    for simulator in Simulator::ALL {
        let found = mismatches(&pipeline, simulator, &of_the_set);
        assert!(found[1] == 0 && found[2] > 0, "{}: {found:?}", simulator.name());
    }
}
