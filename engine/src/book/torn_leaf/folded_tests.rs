//! Leaves that are folded when they are torn out.

use super::tests::{AROUND, deepest, held_folded, pulled, settle, tear_off};
use super::*;
use crate::book::parts_depth::depth_of_parts;
use crate::models::sheet::SheetCrease;
use crate::stock::Stock;

/// How deep a sheet that lies is drawn in itself at most, metres.
const DEEP: f32 = 1e-4;

fn fold(from: [f64; 2], to: [f64; 2], degrees: f64, stock: &Stock) -> SheetCrease {
    SheetCrease::pressed([from, to], degrees.to_radians(), stock, 0.148)
}

/// A corner at the head, and in two toward the recto and toward the verso.
fn foldings(stock: &Stock) -> [Vec<SheetCrease>; 3] {
    let along = |u, degrees| fold([u, 0.0], [u, 1.0], degrees, stock);
    [
        vec![fold([0.8, 1.0], [1.0, 0.86], 160.0, stock)],
        vec![along(0.6, 160.0)],
        vec![along(0.6, -160.0)],
    ]
}

/// Where the leaf is held: within its outer fold.
const GRABBED: [f32; 2] = [0.3, 0.5];

#[test]
fn a_folded_leaf_is_torn_out_as_it_is_drawn_and_lies_folded() {
    for stock in [Stock::BIBLE, Stock::BOOK] {
        for side in [Side::Right, Side::Left] {
            for (k, lines) in foldings(&stock).iter().enumerate() {
                let what = format!("{} kg/m2, {side:?}, {k}", stock.grammage);
                let (book, id) = held_folded(side, stock, GRABBED, lines);
                let drawn = book.flights.get(id).unwrap().surface().positions.clone();
                let torn = TornLeaf::tear(&book, id, TearLine::Sewn, 0..NODES[1], AROUND).unwrap();
                let apart = drawn.iter().zip(&torn.surface().positions);
                let most = apart.fold(0.0f32, |most, (a, b)| most.max((a - b).abs()));
                // It is lifted off what it lies on by the last tenth of a millimetre.
                assert!(most < 2.0 * DEEP, "{what}: it jumps by {most} m");
                let rests = torn.sheet().creases();
                let mut strain = torn.sheet().max_edge_strain();
                let (mut leaf, away, _) = tear_off(&book, id, TearLine::Sewn, (side, GRABBED));
                let from = pulled(side, GRABBED, away);
                for tick in 0..240 {
                    let part = (tick as f32 / 120.0).min(1.0);
                    let to = [side.sign() * 0.36, 0.1, 0.08];
                    let to = core::array::from_fn(|k| from[k] + part * (to[k] - from[k]));
                    leaf.pull(0, to);
                    leaf.step(&book, 1);
                    strain = strain.max(leaf.sheet().max_edge_strain());
                }
                leaf.release();
                strain = strain.max(settle(&mut leaf, &book));
                let mesh = leaf.paper_mesh().unwrap();
                let depth = depth_of_parts(leaf.surface(), mesh, lines);
                println!("{what}: strain {strain}, in itself {depth} m");
                assert!(strain < 0.01, "{what}: {strain}");
                assert!(depth < DEEP, "{what}: {depth}");
                // The jerk with which it comes off opens folds, and does not turn them over.
                for (before, after) in rests.iter().zip(leaf.sheet().creases()) {
                    assert!(
                        before.rest * after.rest > 0.0,
                        "{what}: {before:?}, {after:?}"
                    );
                }
                assert_eq!(deepest(&leaf, &book), 0.0, "{what}");
            }
        }
    }
}

#[test]
fn a_folded_leaf_that_is_cut_out_and_dropped_keeps_its_folds() {
    for side in [Side::Right, Side::Left] {
        for (k, lines) in foldings(&Stock::BOOK).iter().enumerate() {
            let what = format!("{side:?}, {k}");
            let (book, id) = held_folded(side, Stock::BOOK, GRABBED, lines);
            let mut leaf = TornLeaf::tear(&book, id, TearLine::Sewn, 0..NODES[1], AROUND).unwrap();
            let rests = leaf.sheet().creases();
            leaf.cut();
            let strain = settle(&mut leaf, &book);
            let depth = depth_of_parts(leaf.surface(), leaf.paper_mesh().unwrap(), lines);
            let turned = rests.iter().zip(leaf.sheet().creases());
            let turned = turned.fold(0.0f64, |most, (before, after)| {
                most.max((before.rest - after.rest).abs().to_degrees())
            });
            println!("{what}: strain {strain}, in itself {depth} m, rest off by {turned} degrees");
            assert!(strain < 0.01 && depth < DEEP, "{what}: {strain}, {depth}");
            assert!(turned < 1.0, "{what}: {turned}");
            assert_eq!(deepest(&leaf, &book), 0.0, "{what}");
        }
    }
}

#[test]
fn a_leaf_whose_folds_lie_upon_folds_stays_in_the_book() {
    let along = |u, degrees| fold([u, 0.0], [u, 1.0], degrees, &Stock::BOOK);
    let letter = [along(0.4, 160.0), along(0.72, 175.0)];
    let (book, id) = held_folded(Side::Right, Stock::BOOK, GRABBED, &letter);
    assert!(TornLeaf::tear(&book, id, TearLine::Sewn, 0..NODES[1], AROUND).is_none());
}

#[test]
fn a_folded_sheet_is_crumpled_but_not_torn_across() {
    let lines = &foldings(&Stock::BOOK)[1];
    let (book, id) = held_folded(Side::Right, Stock::BOOK, GRABBED, lines);
    let (mut leaf, ..) = tear_off(&book, id, TearLine::Sewn, (Side::Right, GRABBED));
    assert!(!leaf.tear_across(&[[0.3, 0.0], [0.3, 1.0]], false));
    assert!(leaf.paper_mesh().is_some());
    assert!(leaf.crumple());
    // It is drawn as facets, none of which is the page that was folded over.
    assert!(!leaf.paper_mesh().unwrap().parts.contains(&0));
    settle(&mut leaf, &book);
    assert!(leaf.surface().positions.iter().all(|x| x.is_finite()));
    assert_eq!(deepest(&leaf, &book), 0.0);
}
