use super::*;
use crate::stock::{GRAVITY, Stock};

/// The interactive sheet whose weight over stiffness is `gamma`, as a plane strip.
fn strip(gamma: f64) -> Sheet {
    let width = 0.148;
    let weight = Stock::BOOK.grammage * GRAVITY;
    let d = weight * width * width * width / gamma;
    let stock = Stock {
        stiffness_along: d,
        stiffness_across: d,
        poisson: 0.0,
        ..Stock::BOOK
    };
    Sheet::new(SheetSettings::leaf(width, 0.21, stock)).unwrap()
}

/// Steps until the sheet hangs still. A page swings for half a minute; stopping
/// it whenever it slows down (kinetic damping) leaves its shape at rest as it is.
fn settle(sheet: &mut Sheet) {
    let energy = |sheet: &Sheet| sheet.velocities().iter().map(|v| v * v).sum::<f32>();
    let mut before = 0.0;
    for step in 0..120 * 20 {
        sheet.step();
        let now = energy(sheet);
        if now < before {
            let positions = sheet.positions().to_vec();
            sheet.write_nodes(&positions, &vec![0.0; positions.len()]);
        }
        before = now;
        if step > 60 && sheet.greatest_speed() < 1e-4 && now < 1e-8 {
            break;
        }
    }
}

/// Reach and drop of the middle of the fore-edge over the width.
fn tip(sheet: &Sheet) -> [f64; 2] {
    let (columns, rows) = sheet.grid_size();
    let at = 3 * (rows / 2 * columns + columns - 1);
    let x = &sheet.positions()[at..at + 3];
    [f64::from(x[0]) / 0.148, -f64::from(x[2]) / 0.148]
}

#[test]
fn a_hanging_page_hangs_as_it_should() {
    let table = include_str!("../../../tests/anchors/heavy_elastica.csv");
    for line in table.lines().skip(1) {
        let values: Vec<f64> = line.trim().split(',').map(|x| x.parse().unwrap()).collect();
        let [gamma, reach, drop] = [values[0], values[1], values[2]];
        if !(0.1..=1000.0).contains(&gamma) {
            continue;
        }
        let mut sheet = strip(gamma);
        settle(&mut sheet);
        let [w, h] = tip(&sheet);
        let error = (w - reach).hypot(h - drop);
        println!(
            "Gamma {gamma}: {w:.4} {h:.4}, off by {:.3} %, strain {:.1e}",
            100.0 * error,
            sheet.max_edge_strain()
        );
        assert!(
            error
                < if [1.0, 10.0, 100.0].contains(&gamma) {
                    0.01
                } else {
                    0.02
                }
        );
        assert!(sheet.max_edge_strain() < 1e-3);
    }
}
