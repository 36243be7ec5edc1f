//! Cost of factorising and solving with the matrices of the interactive sheet.
//!
//! The band is the engine's own affair, so its source is taken in by path, and
//! what its tests need with it.

#![allow(dead_code, unused_imports, reason = "the bench calls a part of each")]

use band::Band;
use criterion::{Criterion, criterion_main};
use real::Real;
use std::hint::black_box;

#[path = "../../../engine/src/band/mod.rs"]
mod band;
#[path = "../../../engine/src/lanes.rs"]
mod lanes;
#[path = "../../../engine/src/random.rs"]
mod random;
#[path = "../../../engine/src/real.rs"]
mod real;

/// A matrix that its diagonal dominates.
fn definite<T: Real>(order: usize, half_bandwidth: usize) -> Band<T> {
    let mut band = Band::new(order, half_bandwidth);
    for row in 0..order {
        for column in row.saturating_sub(half_bandwidth)..row {
            let value = ((row * 31 + column * 17) % 64) as f64 / 64.0 - 0.5;
            band.add(row, column, T::of(value));
        }
        band.add(row, row, T::of(half_bandwidth as f64 + 1.0));
    }
    band
}

fn size<T: Real>(c: &mut Criterion, name: &str, order: usize, half_bandwidth: usize) {
    let matrix = definite::<T>(order, half_bandwidth);
    let mut work = matrix.clone();
    let of = format!("{order} x {half_bandwidth}, {name}");
    c.bench_function(&format!("band copy {of}"), |b| {
        b.iter(|| black_box(&mut work).copy_from(black_box(&matrix)));
    });
    c.bench_function(&format!("band copy + factorise {of}"), |b| {
        b.iter(|| {
            work.copy_from(black_box(&matrix));
            black_box(&mut work).factorise()
        });
    });
    let right_side = vec![T::ONE; order];
    let mut x = right_side.clone();
    c.bench_function(&format!("band solve {of}"), |b| {
        b.iter(|| {
            x.copy_from_slice(black_box(&right_side));
            work.solve(black_box(&mut x));
        });
    });
}

fn sheet(c: &mut Criterion) {
    size::<f32>(c, "f32", 528, 68);
    size::<f32>(c, "f32", 378, 56);
    size::<f64>(c, "f64", 528, 68);
}

#[allow(missing_docs, reason = "made by the macro")]
mod group {
    use super::sheet;
    criterion::criterion_group!(benches, sheet);
}
criterion_main!(group::benches);
