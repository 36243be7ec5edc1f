//! The model against the paper's figures and against mechanics.

use super::*;
use crate::surface::StrainRange;

fn turn(settings: Settings, gesture: &str, seconds: f32, after: f32) -> (MassSpring, StrainRange) {
    let mut leaf = MassSpring::new(settings).unwrap();
    let gesture = leaf.settings().gesture(gesture, seconds).unwrap();
    leaf.play(gesture);
    let steps = ((seconds + after) / leaf.time_step()).round() as usize;
    let mut range = StrainRange::default();
    for _ in 0..steps {
        leaf.step();
        range = range.union(leaf.strain());
    }
    (leaf, range)
}

#[test]
fn six_by_six_nodes_have_158_springs() {
    assert_eq!(
        MassSpring::new(Settings::paper_2014())
            .unwrap()
            .spring_count(),
        158
    );
}

#[test]
fn the_paper_sheet_stretches_by_its_known_figures() {
    let (_, short) = turn(Settings::paper_2014(), "column", 11.4, 2.0);
    assert!((short.max - 1.00).abs() < 0.1, "{short:?}");
    let (_, long) = turn(Settings::paper_2014(), "column", 60.0, 2.0);
    assert!((long.max - 0.21).abs() < 0.03, "{long:?}");
}

#[test]
fn a_book_page_keeps_its_lengths_within_one_per_cent() {
    for gesture in ["column", "corner"] {
        let (leaf, range) = turn(Settings::book(0.140, 0.210, 0.070), gesture, 0.8, 1.0);
        assert!(leaf.is_finite());
        assert!(
            range.max <= 0.01 && range.min >= -0.01,
            "{gesture}: {range:?}"
        );
    }
}
