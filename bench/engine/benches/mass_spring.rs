//! Cost of the paper's step and surface, in mid-turn and on one core.
//!
//! `step + synchronise` includes the gesture that moves the control column.

use criterion::{BatchSize, Criterion, criterion_main};
use std::hint::black_box;
use turnleaf_engine::{MassSpring, Settings, Surface, TurnModel};

/// Steps before measuring: a third of the way through the turn.
const MID_TURN: usize = 228;

fn mid_turn(settings: Settings, seconds: f32) -> MassSpring {
    let mut leaf = MassSpring::new(settings).expect("a preset is valid");
    let gesture = leaf.settings().column_gesture(seconds);
    leaf.play(gesture);
    let steps = (MID_TURN as f32 * seconds / 11.4) as usize;
    for _ in 0..steps {
        leaf.step();
    }
    leaf
}

/// A hundred steps from mid-turn on, with or without a surface after each.
fn hundred(leaf: &mut MassSpring, surface: Option<&mut Surface>) {
    match surface {
        None => (0..100).for_each(|_| black_box(&mut *leaf).step()),
        Some(surface) => (0..100).for_each(|_| {
            black_box(&mut *leaf).step();
            leaf.write_surface(black_box(&mut *surface));
        }),
    }
}

fn paper(c: &mut Criterion) {
    let start = mid_turn(Settings::paper_2014(), 11.4);
    let mut surface = Surface::new(26, 26);
    c.bench_function("100 x paper step + synchronise", |b| {
        b.iter_batched_ref(
            || start.clone(),
            |leaf| hundred(leaf, None),
            BatchSize::SmallInput,
        );
    });
    let mut leaf = start.clone();
    c.bench_function("surface 26x26 (positions)", |b| {
        b.iter(|| black_box(&mut leaf).write_surface(black_box(&mut surface)));
    });
    c.bench_function("100 x paper step + synchronise + surface", |b| {
        b.iter_batched_ref(
            || start.clone(),
            |leaf| hundred(leaf, Some(&mut surface)),
            BatchSize::SmallInput,
        );
    });
    c.bench_function("normals 26x26", |b| {
        b.iter(|| black_box(&mut surface).update_normals())
    });
}

fn book(c: &mut Criterion) {
    let start = mid_turn(Settings::book(0.140, 0.210, 0.070), 0.8);
    c.bench_function("book step, 4 substeps", |b| {
        b.iter_batched_ref(|| start.clone(), |leaf| leaf.step(), BatchSize::SmallInput);
    });
}

#[allow(missing_docs, reason = "made by the macro")]
mod group {
    use super::{book, paper};
    criterion::criterion_group!(benches, paper, book);
}
criterion_main!(group::benches);
