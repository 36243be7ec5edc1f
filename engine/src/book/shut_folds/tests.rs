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

/// What lies under the part next to the spine is level with what that lay upon before: on the right what
/// is folded to the verso, on the left what is folded to the recto.
#[test]
fn what_others_lie_over_is_raised_by_those_under_it() {
    for (sign, turned, raised) in [(-1.0, 0.0, 2.0), (1.0, 0.0, 0.0), (1.0, 1.0, -2.0)] {
        let leaf = leaf(&[along(0.4, sign * 160.0), along(0.7, sign * 170.0)]);
        let layers = shut_folds(&leaf).expect("a letter can be shut").nodes;
        let mut points = leaf.sheet().flat_places().as_chunks::<3>().0.to_vec();
        layers.raise(&mut points, 1.0, turned, 1.0);
        layers.lay(&mut points, 1.0, 1.0);
        let away = points.iter().filter(|[x, ..]| *x > 0.1 * PAGE[0] as f32);
        let [low, high] = away.fold([f32::MAX, f32::MIN], |[low, high], [.., z]| {
            [low.min(*z), high.max(*z)]
        });
        let others = raised + 2.0 * sign as f32;
        let expected = [raised.min(others), raised.max(others)].map(|layers| layers * PARTS_GAP);
        for (found, expected) in [low, high].into_iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-6,
                "{low} to {high} for {expected}"
            );
        }
        let bound = points.iter().step_by(NODES[0]);
        assert!(bound.clone().all(|[.., z]| *z == 0.0), "the spine stays");
    }
}

/// What pushes one point of a letter's outer part, or of its page, moves all of its layers there by as
/// much, and no other; the spine stays.
#[test]
fn layers_that_are_pushed_point_by_point_move_as_one() {
    let leaf = leaf(&[along(0.4, 160.0), along(0.7, 170.0)]);
    let layers = shut_folds(&leaf).expect("a letter can be shut").nodes;
    let mut before = leaf.sheet().flat_places().as_chunks::<3>().0.to_vec();
    layers.lay(&mut before, 1.0, 1.0);
    let over: Vec<Carried> = layers.carried().collect();
    let place = |points: &[[f32; 3]], (_, corners, weights): &Carried| {
        place_of(*weights, corners.map(|corner| points[corner]))
    };
    let is_bound = |node: usize| node.is_multiple_of(NODES[0]);
    for pushed in 0..before.len() {
        let mut points = before.clone();
        points[pushed][2] += 1e-3;
        layers.move_as_one(&mut points, &before, is_bound);
        let is_carried = over.iter().any(|(point, ..)| *point == pushed);
        let moved = points[pushed][2] - before[pushed][2];
        assert!(
            is_bound(pushed) || is_carried && moved > 0.5e-3 || (moved - 1e-3).abs() < 1e-7,
            "{moved} m at {pushed}"
        );
        for carried in &over {
            let [was, is] = [&before, &points].map(|points| {
                let away = sub(points[carried.0], place(points, carried));
                away.map(|x| x as f64)
            });
            let off = (0..3).map(|axis| (is[axis] - was[axis]).abs());
            assert!(
                off.fold(0.0, f64::max) < 1e-7,
                "{is:?} for {was:?} at {}",
                carried.0
            );
        }
    }
}
