//! Cost of the sheet: a frame at 60 Hz is two steps, the drawn surface and its
//! normals, of a leaf in mid-turn that a hand holds by the corner.
//!
//! Each bench is named by its grid and the error of a hanging page at Gamma 10
//! on that grid, so that no cost stands without its accuracy.

use criterion::{Criterion, criterion_main};
use std::hint::black_box;
use turnleaf_engine::{GRAVITY, Sheet, SheetSettings, Stock, Surface, TurnModel};

const WIDTH: f64 = 0.148;

fn settings(columns: usize, rows: usize) -> SheetSettings {
    SheetSettings {
        columns,
        rows,
        ..SheetSettings::leaf(WIDTH, 0.210, Stock::BOOK)
    }
}

/// A leaf whose corner a hand has drawn to the middle of its way over.
fn mid_turn(columns: usize, rows: usize) -> Sheet {
    let mut sheet = Sheet::new(settings(columns, rows)).expect("the settings make a sheet");
    sheet.draw_samples(&samples(49), &samples(25));
    sheet.grab(0, 1.0, 0.0);
    for step in 0..60 {
        let angle = 1.8 * step as f32 / 60.0;
        sheet.pull(0, [0.14 * angle.cos(), 0.02, 0.14 * angle.sin()]);
        sheet.step();
    }
    sheet
}

fn samples(count: usize) -> Vec<f32> {
    (0..count).map(|i| i as f32 / (count - 1) as f32).collect()
}

/// Per cent of the width by which a page with Gamma 10 hangs wrong.
fn error(columns: usize, rows: usize) -> f64 {
    let d = Stock::BOOK.grammage * GRAVITY * WIDTH * WIDTH * WIDTH / 10.0;
    let stock = Stock {
        stiffness_along: d,
        stiffness_across: d,
        poisson: 0.0,
        ..Stock::BOOK
    };
    let mut settings = settings(columns, rows);
    settings.stock = stock;
    let mut sheet = Sheet::new(settings).expect("the settings make a sheet");
    for _ in 0..120 * 20 {
        sheet.step();
        let positions = sheet.positions().to_vec();
        let slower: Vec<f32> = sheet.velocities().iter().map(|v| 0.97 * v).collect();
        sheet.write_nodes(&positions, &slower);
    }
    let tip = &sheet.positions()[3 * (rows / 2 * columns + columns - 1)..];
    let (reach, drop) = (f64::from(tip[0]) / WIDTH, -f64::from(tip[2]) / WIDTH);
    100.0 * (reach - 0.6563538).hypot(drop - 0.7001997)
}

fn frames(c: &mut Criterion) {
    for (columns, rows) in [(8, 12), (10, 14), (12, 16), (16, 24)] {
        let start = mid_turn(columns, rows);
        let name = format!(
            "sheet frame {columns} x {rows} ({:.2} %)",
            error(columns, rows)
        );
        let mut surface = Surface::new(2, 2);
        c.bench_function(&name, |b| {
            let mut sheet = start.clone();
            b.iter(|| {
                black_box(&mut sheet).step();
                sheet.step();
                sheet.write_surface(&mut surface);
                surface.update_normals();
            });
        });
    }
}

fn benches() {
    let mut c = Criterion::default().configure_from_args();
    frames(&mut c);
}

criterion_main!(benches);
