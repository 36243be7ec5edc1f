//! How pages lie in a pile.

use super::*;

const WIDTH: f64 = 0.14;

fn layer(pile: &Pile, layer: usize) -> Vec<(f32, f32)> {
    let n = 2 * pile.columns();
    pile.curves()[layer * n..(layer + 1) * n]
        .chunks_exact(2)
        .map(|p| (p[0], p[1]))
        .collect()
}

fn height_at(curve: &[(f32, f32)], x: f32) -> Option<f32> {
    curve.windows(2).find_map(|w| {
        let ((x0, z0), (x1, z1)) = (w[0], w[1]);
        (x0 <= x && x <= x1).then(|| z0 + (z1 - z0) * (x - x0) / (x1 - x0))
    })
}

#[test]
fn fore_edges_land_at_their_heights() {
    let u = crowded_columns(49);
    for thickness in [0.0, 0.0002, 0.001, 0.005, 0.01, 0.02, 0.03] {
        let pile = Pile::new(Side::Right, WIDTH, thickness, &u);
        for k in 0..LAYERS {
            let height = thickness * (1.0 - k as f64 / (LAYERS - 1) as f64);
            let end = *layer(&pile, k).last().unwrap();
            assert!(
                (end.1 as f64 - height).abs() < 1e-4,
                "thickness {thickness}, layer {k}: {} for {height}",
                end.1
            );
        }
    }
}

#[test]
fn pages_keep_their_length_and_never_stand_beyond_vertical() {
    let u = crowded_columns(49);
    // The last two piles are thicker than their pages are wide.
    for (width, thickness) in [
        (WIDTH, 0.001),
        (WIDTH, 0.01),
        (WIDTH, 0.02),
        (0.028, 0.03),
        (0.02, 0.2),
    ] {
        let pile = Pile::new(Side::Right, width, thickness, &u);
        for k in 0..LAYERS {
            let page = layer(&pile, k);
            let length: f32 = page
                .windows(2)
                .map(|w| (w[1].0 - w[0].0).hypot(w[1].1 - w[0].1))
                .sum();
            assert!((length / width as f32 - 1.0).abs() < 5e-3, "{length}");
            assert!(
                page.windows(2).all(|w| w[1].0 > w[0].0),
                "thickness {thickness}, layer {k}: {page:?}"
            );
        }
    }
}

#[test]
fn layers_lie_upon_each_other_without_crossing() {
    let u = crowded_columns(49);
    for thickness in [0.0005, 0.002, 0.005, 0.01, 0.015, 0.02] {
        let pile = Pile::new(Side::Right, WIDTH, thickness, &u);
        for k in 1..LAYERS {
            let (upper, lower) = (layer(&pile, k - 1), layer(&pile, k));
            for &(x, z) in &upper {
                if let Some(below) = height_at(&lower, x) {
                    assert!(
                        z >= below - 2e-5,
                        "thickness {thickness}, layer {k}: {z} under {below} at {x}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_straight_pile_keeps_its_lengths_and_the_heights_of_its_edges() {
    let u = crowded_columns(49);
    for (side, thickness) in [(Side::Right, 0.02), (Side::Left, 0.004)] {
        let pile = Pile::new(side, WIDTH, thickness, &u);
        for part in [0.0, 0.5, 1.0] {
            let mut straight = pile.clone();
            straight.straighten(part);
            for k in 0..LAYERS {
                let (before, after) = (layer(&pile, k), layer(&straight, k));
                let length = |curve: &[(f32, f32)]| -> f32 {
                    let steps = curve.windows(2);
                    steps
                        .map(|w| (w[1].0 - w[0].0).hypot(w[1].1 - w[0].1))
                        .sum()
                };
                assert!((length(&before) - length(&after)).abs() < 1e-5);
                let [end, was] = [&after, &before].map(|curve| *curve.last().unwrap());
                let most = if part == 0.5 { 1e-3 } else { 1e-5 };
                assert!((end.1 - was.1).abs() < most, "{part}: {end:?} for {was:?}");
                let chord = (end.1 - after[0].1) / (end.0 - after[0].0);
                let off = after
                    .iter()
                    .map(|p| (p.1 - chord * (p.0 - after[0].0)).abs());
                let bend = off.fold(0.0, f32::max);
                assert!(part < 1.0 || bend < 1e-5, "{bend}");
            }
        }
    }
}

#[test]
fn left_is_the_mirror_of_right() {
    let u = crowded_columns(49);
    let right = Pile::new(Side::Right, WIDTH, 0.008, &u);
    let left = Pile::new(Side::Left, WIDTH, 0.008, &u);
    for (r, l) in right
        .curves()
        .chunks_exact(2)
        .zip(left.curves().chunks_exact(2))
    {
        assert_eq!((r[0], r[1]), (-l[0], l[1]));
    }
    assert_eq!(right.angles(), left.angles());
}

#[test]
fn height_is_the_top_curve() {
    let u = crowded_columns(49);
    let pile = Pile::new(Side::Left, WIDTH, 0.01, &u);
    for &(x, z) in &layer(&pile, 0) {
        assert!((pile.height(-x) - z).abs() < 1e-6);
    }
    assert_eq!(pile.height(1.0), layer(&pile, 0).last().unwrap().1);
}
