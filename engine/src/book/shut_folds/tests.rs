use super::*;
use crate::book::leaf::Leaf;
use crate::book::limits::NODES;
use crate::book::paper::Paper;
use crate::book::pile::crowded_columns;
use crate::models::sheet::SheetCrease;
use crate::stock::Stock;

const PAGE: [f64; 2] = [0.14, 0.21];

fn fold(from: [f64; 2], to: [f64; 2], degrees: f64) -> SheetCrease {
    SheetCrease::pressed([from, to], degrees.to_radians(), &Stock::BOOK, PAGE[0])
}

fn along(u: f64, degrees: f64) -> SheetCrease {
    fold([u, 0.0], [u, 1.0], degrees)
}

/// A leaf that lies flat on the right, creased.
fn leaf(creases: &[SheetCrease]) -> Leaf {
    let u = crowded_columns(49);
    let mut leaf = Leaf::new(PAGE, &Paper::default(), 0.0, (&u, 25));
    assert!(leaf.crease(creases));
    leaf
}

fn shut_folds(leaf: &Leaf) -> Option<ShutFolds> {
    ShutFolds::of(leaf.sheet(), leaf.flaps()?)
}

/// Each part of a letter lies a layer over the one that it is folded onto, and where the flat paper
/// is folded to, but for what is pressed together next to the spine.
#[test]
fn layers_lie_upon_each_other_where_the_paper_is_folded_to() {
    for sign in [1.0f32, -1.0] {
        let leaf = leaf(&[
            along(0.4, f64::from(sign) * 160.0),
            along(0.7, f64::from(sign) * 170.0),
        ]);
        let folds = shut_folds(&leaf).expect("a letter can be shut");
        let flat = leaf.sheet().flat_places();
        let flat = flat.as_chunks::<3>().0;
        let mut points = flat.to_vec();
        folds.nodes.lay(&mut points, 1.0, 1.0);
        let places = folds.places.as_chunks::<3>().0;
        let least = OVERHANG * PAGE[0] as f32;
        let mut found = [0; 3];
        for (node, ([x, y, z], place)) in points.iter().zip(places).enumerate() {
            let u = flat[node][0] / PAGE[0] as f32;
            if place[0] > least && node % NODES[0] > 0 {
                assert!((x - place[0]).abs() < 1e-5, "{x} for {}", place[0]);
            }
            assert!((y - place[1]).abs() < 1e-5, "{y} for {}", place[1]);
            // The outer part lies between the others.
            let layers = if u > 0.72 {
                1.0
            } else if u > 0.42 && u < 0.68 {
                2.0
            } else if u < 0.38 {
                0.0
            } else {
                continue;
            };
            if place[0] > least {
                found[layers as usize] += 1;
                assert!((z - sign * layers * PARTS_GAP).abs() < 1e-6, "{z} at {u}");
            }
        }
        assert!(found.iter().all(|count| *count > 10), "{found:?}");
    }
}

#[test]
fn what_reaches_far_beyond_the_spine_or_crosses_is_not_shut() {
    assert!(shut_folds(&leaf(&[along(0.48, 160.0)])).is_some());
    assert!(shut_folds(&leaf(&[along(0.35, 160.0)])).is_none());
    let slanted = fold([0.2, 0.0], [1.0, 0.8], 160.0);
    assert!(shut_folds(&leaf(&[along(0.55, 160.0), slanted])).is_none());
    // What is folded by less than a right angle stays as it is.
    assert!(shut_folds(&leaf(&[along(0.6, 80.0)])).is_none());
}

/// Nodes that are carried weigh on those that carry them, until each weighs by itself again.
#[test]
fn what_is_carried_weighs_on_what_carries_it() {
    let leaf = leaf(&[along(0.4, 160.0), along(0.7, 170.0)]);
    let layers = shut_folds(&leaf).expect("a letter can be shut").nodes;
    let mut sheet = leaf.sheet().clone();
    let before = sheet.masses().to_vec();
    let sum = |masses: &[f32]| masses.iter().sum::<f32>();
    sheet.stack(0b11, layers.carried());
    assert!((sum(sheet.masses()) / sum(&before) - 1.0).abs() < 1e-5);
    for (node, ..) in layers.carried() {
        assert!(sheet.masses()[node] < 0.05 * before[node]);
    }
    sheet.unstack();
    assert_eq!(sheet.masses(), before);
}
