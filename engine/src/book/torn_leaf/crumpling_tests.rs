use super::ball::Ball;
use super::tests::{AROUND, held, lying, settle};
use super::*;
use crate::stock::Stock;
use crate::vector::{dot, sub};

/// Root of the mean square distance of the nodes from their middle, metres.
fn spread(leaf: &TornLeaf) -> f32 {
    let x = leaf.sheet().positions().as_chunks::<3>().0;
    let count = x.len() as f32;
    let middle = core::array::from_fn(|axis| x.iter().map(|x| x[axis]).sum::<f32>() / count);
    let squares = x.iter().map(|x| {
        let out = sub(*x, middle);
        dot(out, out)
    });
    (squares.sum::<f32>() / count).sqrt()
}

#[test]
fn a_sheet_that_is_crumpled_stays_a_ball() {
    for stock in [Stock::BIBLE, Stock::BOOK, Stock::COATED] {
        let (book, mut leaf) = lying(stock, 0.4);
        let flat = spread(&leaf);
        assert!(leaf.crumple() && leaf.is_crumpled());
        assert!(!leaf.crumple());
        let size = [leaf.surface().columns, leaf.surface().rows];
        assert_eq!(size, press::NODES.map(|nodes| 2 * nodes - 1));
        let worst = settle(&mut leaf, &book);
        let x = &leaf.surface().positions;
        assert!(x.iter().all(|x| x.is_finite()));
        let heights = x.as_chunks::<3>().0.iter().map(|x| x[2]);
        let low = heights.fold(f32::INFINITY, f32::min);
        let ball = spread(&leaf);
        let strain = leaf.sheet().max_edge_strain();
        let work = leaf.take_work();
        eprintln!(
            "{} g/m2: {:.1} of {:.1} mm, strain {strain:.4}, at worst {worst:.4}, {work:.2e} J, lowest {:.2} mm",
            1e3 * stock.grammage,
            1e3 * ball,
            1e3 * flat,
            1e3 * (low - AROUND.table)
        );
        // What is pressed into a third of its size springs back to no more than half.
        assert!(ball < 0.5 * flat, "{ball} of {flat}");
        assert!(strain < 0.01 && worst < 0.03, "{strain}, {worst}");
        assert!(work > 0.0);
        assert!((0.0..1e-3).contains(&(low - AROUND.table)), "{low}");
        // It lies still by itself, and is not left so after a time.
        assert!(!leaf.stillness.is_down(), "{:?}", leaf.stillness);
    }
}

#[test]
fn a_ball_turns_as_a_rigid_body_does() {
    let (_, mut leaf) = lying(Stock::BOOK, 0.4);
    assert!(leaf.crumple());
    let mut ball = Ball::of(&leaf.sheet);
    // A flat sheet of 148 x 210 mm about its own plane's normal: m (a^2 + b^2) / 12.
    let plate = 0.07 * 0.148 * 0.21 * (0.148f32.powi(2) + 0.21f32.powi(2)) / 12.0;
    let spun = ball.lighten([0.0, 0.0, plate]);
    assert!((spun[2] - 1.0).abs() < 0.02, "{spun:?}");
    // Pushed beside its centre it moves and turns as its mass and its moment say.
    let mass = ball.mass;
    ball.kick([0.05, 0.0, 0.0], [0.0, 1.0, 0.0], mass);
    assert!((ball.velocity[1] - 1.0).abs() < 1e-5, "{:?}", ball.velocity);
    assert!(
        (ball.spin[2] * plate / (0.05 * mass) - 1.0).abs() < 0.02,
        "{:?}",
        ball.spin
    );
}

#[test]
fn a_leaf_that_is_still_bound_is_not_crumpled() {
    let (book, id) = held(Side::Right, Stock::BOOK, [0.95, 0.95]);
    let mut leaf = TornLeaf::tear(&book, id, TearLine::Sewn, 0..NODES[1], AROUND).unwrap();
    assert!(!leaf.crumple() && !leaf.is_crumpled());
    leaf.cut();
    assert!(leaf.crumple());
}

#[test]
fn a_ball_is_carried_and_thrown() {
    let (book, mut leaf) = lying(Stock::BOOK, 0.4);
    assert!(leaf.crumple());
    settle(&mut leaf, &book);
    let before = spread(&leaf);
    leaf.grab(0, 0.5, 0.5);
    for tick in 0..240 {
        let part = (tick as f32 / 120.0).min(1.0);
        leaf.pull(0, [0.4, 0.2 - 0.3 * part, 0.1]);
        leaf.step(&book, 1);
    }
    let held = leaf.sheet().positions().as_chunks::<3>().0;
    let mean = held.iter().map(|x| x[1]).sum::<f32>() / held.len() as f32;
    assert!((mean + 0.1).abs() < 0.05, "{mean}");
    leaf.release();
    settle(&mut leaf, &book);
    let after = spread(&leaf);
    assert!(after < 1.3 * before, "{after} after {before}");
}
