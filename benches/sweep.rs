//! `cargo bench --bench sweep`: what a vector costs, and the exhaustive sweep of two 12-bit words (2^24 vectors) on all cores.

use criterion::{Criterion, Throughput as Rate, criterion_group, criterion_main};
use std::hint::black_box;
use vuris::spec::{Rounding, Throughput};
use vuris::sweep::{Configuration, ExactAngle, PhaseOf, Plan, Shard, evaluate};

fn twelve_bits() -> Configuration {
    Configuration {
        metric: 1,
        x_bits: 12,
        y_bits: 12,
        phase_bits: 16,
        length_bits: 0,
        iterations: 16,
        vector_guard_bits: 4,
        angle_guard_bits: 3,
        throughput: Throughput::CyclesPerPixel(1),
        pipeline_every: 1,
        normaliser: true,
        rounding: Rounding::Nearest,
    }
}

fn sweep(criterion: &mut Criterion) {
    let configuration = twelve_bits();
    let unit = configuration.unit().expect("a configuration that can be built");
    let exact = ExactAngle::new(configuration.metric);

    let mut vector = criterion.benchmark_group("vector");
    vector.throughput(Rate::Elements(2047));
    vector.bench_function("unit's phase", |bencher| {
        bencher.iter(|| (1..2048).map(|y| unit.phase(black_box(1234), y)).sum::<i64>());
    });
    vector.bench_function("exact angle", |bencher| {
        bencher.iter(|| (1..2048).map(|y| exact.quadrant(black_box(1234), y).0).sum::<i64>());
    });
    vector.finish();

    let mut whole = criterion.benchmark_group("exhaustive");
    whole.sample_size(10).throughput(Rate::Elements((1 << 24) - 1));
    let plan = Plan::new(&configuration, 0, true);
    whole.bench_function("12 x 12 bits", |bencher| {
        bencher.iter(|| evaluate(&unit, &exact, &plan, Shard::WHOLE, &|_| ()));
    });
    whole.finish();
}

criterion_group!(benches, sweep);
criterion_main!(benches);
