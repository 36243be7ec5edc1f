//! How a hand holds a leaf.
//!
//! A finger pad presses on some square centimetres. Each node under it is drawn
//! by a spring of its own to its place in the pad, which moves and tilts with
//! the leaf there: the hand pulls without tearing at one node, and without
//! forcing a direction on the sheet. The springs together are soft, and their
//! force is bounded, so that no pull however wild overwhelms the solver.

use crate::real::Real;
use crate::stock::GRAVITY;

/// Radius of a finger pad, metres.
pub(crate) const RADIUS: f64 = 0.02;

/// Stiffness of all springs of a hand together, N/m, unless it is stronger than a finger.
const STIFFNESS: f64 = 30.0;

/// Greatest force of a finger, N, and of any hand in weights of the leaf: a finger that would
/// lift book paper easily would tear bible paper.
const STRONGEST: f64 = 0.5;
const WEIGHTS: f64 = 14.0;

/// Area of the largest leaf that a finger turns, m^2: A5. A larger one is turned by more in proportion.
const FINGER_AREA: f64 = 0.148 * 0.21;

/// Greatest force of a hand, N, on a leaf of `grammage` kg/m^2 and `area` m^2.
pub(crate) fn strongest(grammage: f64, area: f64) -> f64 {
    let fingers = (area / FINGER_AREA).max(1.0);
    (WEIGHTS * grammage * GRAVITY * area).min(STRONGEST * fingers)
}

/// Stiffness of a hand whose greatest force is `strength`, N/m: one that is stronger than a finger
/// is not farther from its place for that.
pub(crate) fn stiffness_for(strength: f64) -> f64 {
    STIFFNESS * (strength / STRONGEST).max(1.0)
}

/// A node under the pad.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pressed<T> {
    /// Number of the node, row by row.
    pub node: usize,
    /// Its part of the pad; all together 1.
    pub weight: T,
    /// Where it lies from the middle of the pad on the flat leaf, metres along
    /// u and along v.
    pub apart: [T; 2],
}

/// The pad of a hand at (`u`, `v`), each 0 to 1, on a leaf of `columns` x `rows`
/// nodes and `size` metres: the nodes within its radius, or else those next to
/// it. The column at the spine is never held.
pub(crate) fn pad<T: Real>(
    at: (f64, f64),
    (columns, rows): (usize, usize),
    size: [f64; 2],
) -> Vec<Pressed<T>> {
    let cell = [size[0] / (columns - 1) as f64, size[1] / (rows - 1) as f64];
    pad_over(at, (columns, rows), [size, cell], |node| {
        [
            (node % columns) as f64 * cell[0],
            (node / columns) as f64 * cell[1],
        ]
    })
}

/// The same where cells have about such sides, and nodes lie on the flat leaf as `place` says,
/// metres.
pub(crate) fn pad_over<T: Real>(
    (u, v): (f64, f64),
    (columns, rows): (usize, usize),
    [size, cell]: [[f64; 2]; 2],
    place: impl Fn(usize) -> [f64; 2],
) -> Vec<Pressed<T>> {
    let middle = [u.clamp(0.0, 1.0) * size[0], v.clamp(0.0, 1.0) * size[1]];
    // Wide enough for the four corners of a cell to share the pull smoothly.
    let radius = RADIUS.max(1.2 * cell[0]).max(1.2 * cell[1]);
    let mut pressed: Vec<(usize, f64, [f64; 2])> = Vec::new();
    for row in 0..rows {
        for column in 1..columns {
            let [x, y] = place(row * columns + column);
            let apart = [x - middle[0], y - middle[1]];
            let weight = 1.0 - (apart[0] * apart[0] + apart[1] * apart[1]) / (radius * radius);
            if weight > 0.0 {
                pressed.push((row * columns + column, weight * weight, apart));
            }
        }
    }
    let total: f64 = pressed.iter().map(|p| p.1).sum();
    let of = |(node, weight, apart): (usize, f64, [f64; 2])| Pressed {
        node,
        weight: T::of(weight / total),
        apart: apart.map(T::of),
    };
    pressed.into_iter().map(of).collect()
}

/// The stiffness that a hand of stiffness `most` has when it is `away` metres from what it holds:
/// less where its force would be beyond `strongest`, N.
pub(crate) fn bounded_stiffness<T: Real>(most: T, away: T, strongest: T) -> T {
    most.min(strongest / away.max(T::of(1e-9)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pad_weighs_one_and_lies_about_its_middle() {
        for at in [(1.0, 0.0), (0.5, 0.5), (0.97, 0.33), (0.0, 1.0)] {
            let pad = pad::<f64>(at, (12, 16), [0.148, 0.21]);
            let total: f64 = pad.iter().map(|p| p.weight).sum();
            assert!((total - 1.0).abs() < 1e-12 && !pad.is_empty(), "{at:?}");
            assert!(pad.iter().all(|p| p.node % 12 > 0));
        }
    }

    #[test]
    fn a_hand_is_no_stronger_than_its_greatest_force() {
        assert_eq!(bounded_stiffness(STIFFNESS, 0.001, 0.5), STIFFNESS);
        assert!((bounded_stiffness(STIFFNESS, 0.3, 0.4) * 0.3 - 0.4).abs() < 1e-12);
        assert_eq!(strongest(1.0, FINGER_AREA), STRONGEST);
        assert!((strongest(0.01, 0.01) - 1e-4 * GRAVITY * WEIGHTS).abs() < 1e-12);
        // Ten times as long and wide it takes a hundred fingers, and gives way as far.
        let strong = strongest(1.0, 100.0 * FINGER_AREA);
        assert_eq!(strong, 100.0 * STRONGEST);
        assert_eq!(strong / stiffness_for(strong), STRONGEST / STIFFNESS);
    }
}
