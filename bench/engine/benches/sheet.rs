//! Cost of the sheet: a frame at 60 Hz is two steps, the drawn surface and its
//! normals, of a leaf in mid-turn that a hand holds by the corner; and a frame
//! of ten leaves in flight in a book, with all their contacts.
//!
//! Each grid is named with the error of a hanging page at Gamma 10 on it, so
//! that no cost stands without its accuracy.

use criterion::{Criterion, criterion_main};
use std::hint::black_box;
use turnleaf_engine::trials::{Riffle, creased, frame, hanging, mid_turn, settle, tip};
use turnleaf_engine::{Stock, Surface};

/// Per cent of the width by which the tip of a page with Gamma 10 hangs wrong.
/// The exact reach and drop are those of the heavy elastica.
fn error(columns: usize, rows: usize) -> f64 {
    let mut sheet = hanging(columns, rows, 10.0);
    settle(&mut sheet);
    let [reach, drop] = tip(&sheet);
    100.0 * (reach - 0.656_353_761_2).hypot(drop - 0.700_199_715_5)
}

fn leaf(c: &mut Criterion) {
    for (columns, rows) in [(8, 12), (10, 14), (12, 16), (16, 24)] {
        let mut sheet = mid_turn(columns, rows);
        let error = error(columns, rows);
        let mut surface = Surface::new(2, 2);
        c.bench_function(
            &format!("sheet frame {columns} x {rows}, off by {error:.2} %"),
            |b| {
                b.iter(|| frame(black_box(&mut sheet), &mut surface));
            },
        );
    }
}

fn creases(c: &mut Criterion) {
    for creases in 0..=3 {
        let mut sheet = creased(creases);
        let mut surface = Surface::new(2, 2);
        c.bench_function(&format!("book leaf frame, {creases} creases"), |b| {
            b.iter(|| frame(black_box(&mut sheet), &mut surface));
        });
    }
}

fn riffle(c: &mut Criterion) {
    for leaves in [1, 10] {
        let mut riffle = Riffle::new(Stock::BOOK, leaves);
        c.bench_function(&format!("book frame, {leaves} in flight"), |b| {
            b.iter(|| black_box(&mut riffle).frame());
        });
    }
}

#[allow(missing_docs, reason = "made by the macro")]
mod group {
    use super::{creases, leaf, riffle};
    criterion::criterion_group!(benches, leaf, creases, riffle);
}
criterion_main!(group::benches);
