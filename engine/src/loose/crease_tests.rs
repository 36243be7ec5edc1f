//! Creased loose leaves: folded, opened by a hand, turned over.

use super::*;
use crate::models::sheet::SheetCrease;
use crate::stock::Stock;

const SIZE: [f64; 2] = [0.148, 0.21];

/// A crease across the corner of foot and fore-edge, and one along the page.
const EAR: [[f64; 2]; 2] = [[0.62, 0.0], [1.0, 0.27]];
const HALF: [[f64; 2]; 2] = [[0.5, 0.0], [0.5, 1.0]];

fn creased(lines: &[[[f64; 2]; 2]]) -> LooseLeaf {
    let settings = LooseSettings::leaf(ModelKind::Sheet, SIZE, Stock::BOOK);
    let mut leaf = LooseLeaf::new(settings).unwrap();
    let lines: Vec<_> = lines.iter().map(|line| (*line, 0.0)).collect();
    leaf.crease(&lines).unwrap();
    leaf
}

/// Folds a leaf along its first crease within half a second, and lets it come to rest.
fn fold(leaf: &mut LooseLeaf, degrees: f32) {
    let h = leaf.time_step();
    let steps = (0.5 / h) as usize;
    for step in 1..=steps {
        leaf.press(0, step as f32 / steps as f32 * degrees.to_radians());
        leaf.step();
    }
    leaf.advance(1.5);
}

fn nodes(leaf: &LooseLeaf) -> (Vec<[f32; 3]>, f32) {
    let (columns, rows) = leaf.grid_size();
    let mut x = vec![0.0; 3 * columns * rows];
    let mut v = x.clone();
    leaf.read_nodes(&mut x, &mut v);
    let fastest = v.iter().fold(0.0f32, |most, v| most.max(v.abs()));
    (x.as_chunks::<3>().0.to_vec(), fastest)
}

#[test]
fn a_fold_comes_to_rest_upon_its_page() {
    for line in [EAR, HALF] {
        let mut leaf = creased(&[line]);
        fold(&mut leaf, 160.0);
        let state = leaf.crease_state(0).unwrap();
        let [angle, rest] = [state.angle, state.rest].map(f32::to_degrees);
        assert!((rest - 160.0).abs() < 0.01, "{rest}");
        // Its weight shuts it, and the paper under it stops it.
        assert!((155.0..184.0).contains(&angle), "{angle}");
        let strain = leaf.strain();
        assert!(strain.max < 0.01 && strain.min > -0.01, "{strain:?}");
        let (places, fastest) = nodes(&leaf);
        assert!(fastest < 0.01, "{fastest}");
        for [x, y, z] in &places {
            assert!(x.is_finite() && y.is_finite() && *z > -1e-3, "{x} {y} {z}");
        }
        // What was the corner lies over the page, and over its paper.
        let (columns, _) = leaf.grid_size();
        let [x, y, z] = places[columns - 1];
        assert!(
            (0.0..0.13).contains(&x) && y > -0.01 && z > 1e-4,
            "{x} {y} {z}"
        );
    }
}

#[test]
fn the_moment_is_the_stiffness_times_the_turn_from_rest() {
    let mut leaf = creased(&[HALF]);
    fold(&mut leaf, 120.0);
    // It sways about where it comes to rest, four times in three seconds.
    leaf.advance(16.0);
    let state = leaf.crease_state(0).unwrap();
    let stiffness = SheetCrease::pressed(HALF, 0.0, &Stock::BOOK, SIZE[0]).stiffness as f32;
    assert_eq!(state.moment, stiffness * (state.angle - state.rest));
    // The half that stands beyond upright falls on: the crease holds its weight about the line.
    let weight = 0.07 * 9.80665 * 0.074;
    let arm = 0.5 * 0.074 * (state.angle - core::f32::consts::FRAC_PI_2).sin();
    let held = weight * arm / state.moment;
    assert!((0.8..1.25).contains(&held), "{held} {state:?}");
}

#[test]
fn a_hand_that_opens_a_fold_changes_its_rest_and_nothing_else_does() {
    let mut leaf = creased(&[HALF]);
    fold(&mut leaf, 150.0);
    leaf.grab(1.0, 0.5);
    for step in 0..120 {
        let turned = core::f32::consts::PI * (1.0 - step as f32 / 119.0);
        let x = 0.074 + 0.07 * libm::cosf(turned);
        leaf.pull([x, 0.105, 0.002 + 0.07 * libm::sinf(turned)]);
        leaf.advance(1.0 / 60.0);
    }
    leaf.release();
    leaf.advance(1.0);
    let opened = leaf.crease_state(0).unwrap().rest.to_degrees();
    // It yields where it is turned more than half a radian off its rest; the paper beside it
    // bends too, so that the crease itself is not quite flat.
    assert!((28.0..100.0).contains(&opened), "{opened}");
    leaf.play(TurnBy::Corner, Side::Right, 0.8);
    leaf.advance(2.0);
    let after = leaf.crease_state(0).unwrap().rest.to_degrees();
    assert!((after - opened).abs() < 0.01, "{opened} {after}");
}

#[test]
fn a_folded_page_is_turned_over_folded() {
    let mut leaf = creased(&[EAR]);
    fold(&mut leaf, 150.0);
    leaf.play(TurnBy::Corner, Side::Right, 0.9);
    leaf.advance(2.5);
    assert!(!leaf.is_playing());
    let (places, _) = nodes(&leaf);
    let (columns, rows) = leaf.grid_size();
    let head = places[columns * rows - 1];
    assert!(head[0] < -0.12 && head[2] < 0.04, "{head:?}");
    let state = leaf.crease_state(0).unwrap();
    assert!((state.rest.to_degrees() - 150.0).abs() < 0.01);
    assert!(state.angle.to_degrees() > 90.0, "{state:?}");
}

#[test]
fn what_is_drawn_lies_on_the_paper_as_it_says() {
    let mut leaf = creased(&[EAR]);
    let mesh = leaf.paper_mesh().unwrap();
    let mut surface = Surface::new(2, 2);
    leaf.write_surface(&mut surface);
    assert_eq!(mesh.places.len(), surface.columns * surface.rows);
    for (place, x) in mesh.places.iter().zip(surface.positions.as_chunks::<3>().0) {
        for axis in 0..2 {
            assert!((place[axis] * SIZE[axis] as f32 - x[axis]).abs() < 1e-6);
        }
    }
    assert!(mesh.parts.contains(&1) && mesh.parts.contains(&0));
    leaf.crease(&[]).unwrap();
    assert!(leaf.paper_mesh().is_none() && leaf.crease_state(0).is_none());
}

#[test]
fn what_cannot_be_creased_is_rejected_and_stays_as_it_was() {
    let mut leaf = creased(&[EAR]);
    let before = leaf.paper_mesh();
    let across = [[0.0, 0.5], [1.0, 0.5]];
    let beside = [[0.621, 0.0], [1.0, 0.271]];
    for (lines, said) in [
        (vec![across], "spine"),
        (vec![EAR, beside], "too near each other"),
        (vec![HALF; 17], "16 creases"),
        (vec![[[0.5, f64::NAN], [0.5, 1.0]]], "two places"),
        (vec![[[0.5, 0.5], [0.5, 0.5]]], "two places"),
    ] {
        let lines: Vec<_> = lines.into_iter().map(|line| (line, 1.0)).collect();
        let error = leaf.crease(&lines).unwrap_err().to_string();
        assert!(error.contains(said) && error.ends_with('.'), "{error}");
        assert_eq!(leaf.paper_mesh(), before);
    }
    assert!(leaf.draw_samples(&[0.0, 0.5, 1.0], &[0.0, 1.0]).is_err());
    assert!(leaf.draw_samples(&[0.1, 0.5, 1.0], &[0.0, 1.0]).is_err());
    assert_eq!(leaf.paper_mesh(), before);
    leaf.record(0.1);
    leaf.advance(0.3);
    assert!(leaf.finish_record().is_none());
    let rigid = ModelKind::ALL
        .iter()
        .find(|kind| **kind != ModelKind::Sheet)
        .unwrap();
    let mut rigid = LooseLeaf::new(LooseSettings::leaf(*rigid, SIZE, Stock::BOOK)).unwrap();
    let error = rigid.crease(&[(EAR, 1.0)]).unwrap_err().to_string();
    assert!(error.contains("only the sheet"), "{error}");
}

/// A crease of a number that there is not is none, of any number; one that is pressed shut can be
/// made anew as it says that it is.
#[test]
fn what_a_crease_says_can_be_given_back() {
    let mut leaf = creased(&[HALF]);
    leaf.press(0, 2.5);
    for none in [1, 16, 32, usize::MAX - 15] {
        leaf.press(none, -2.5);
    }
    let flaps = leaf.body.sheet().unwrap().flaps.as_ref().unwrap();
    assert_eq!(flaps.drawn_side(0, 1, false), Some(1.0));
    leaf.press(0, core::f32::consts::PI);
    let rest = leaf.crease_state(0).unwrap().rest;
    leaf.crease(&[(HALF, f64::from(rest))]).unwrap();
}

/// A leaf that is held as it is creased shut has its crease opened by the hand at once, and what
/// is beyond that may then lie on either side.
#[test]
fn parts_follow_a_crease_that_a_hand_opens() {
    let settings = LooseSettings::leaf(ModelKind::Sheet, SIZE, Stock::BOOK);
    let mut leaf = LooseLeaf::new(settings).unwrap();
    leaf.grab(1.0, 0.5);
    leaf.crease(&[(HALF, 2.0)]).unwrap();
    let side = |leaf: &LooseLeaf| {
        let flaps = leaf.body.sheet().unwrap().flaps.as_ref().unwrap();
        flaps.drawn_side(0, 1, false)
    };
    assert_eq!(side(&leaf), Some(1.0));
    leaf.step();
    let rest = leaf.crease_state(0).unwrap().rest;
    assert!(rest < 1.5, "{rest}");
    assert_eq!(side(&leaf), None);
}
