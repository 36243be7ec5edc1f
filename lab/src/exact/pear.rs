//! The pear loop: a weightless strip whose two ends are clamped together, side
//! by side and parallel (the "pear-shaped loop" of Peirce 1930, by which cloth
//! is measured).
//!
//! By symmetry half of it, from the top, where it runs level and only a level
//! force acts: theta'' = F sin theta, theta(0) = 0. The force F and the
//! curvature at the top are those for which the strip ends at half its length
//! upright and under the top.

use core::f64::consts::FRAC_PI_2;

use super::runge_kutta;

/// Steps over half the loop.
const STEPS: usize = 2000;

/// A pear loop's size over the length of the strip.
#[derive(Clone, Copy, Debug)]
pub struct Pear {
    /// From the clamp to the top.
    pub height: f64,
    /// Where it is widest.
    pub width: f64,
}

/// The pear loop.
pub fn pear_loop() -> Pear {
    // Newton's method from a circle pressed together a little.
    let (mut force, mut curvature) = (20.0, 6.0);
    for _ in 0..30 {
        let (end, _) = half(force, curvature);
        let small = 1e-6;
        let (by_force, _) = half(force + small, curvature);
        let (by_curvature, _) = half(force, curvature + small);
        let a = [0, 1].map(|i| (by_force[i] - end[i]) / small);
        let b = [0, 1].map(|i| (by_curvature[i] - end[i]) / small);
        let determinant = a[0] * b[1] - a[1] * b[0];
        force -= (end[0] * b[1] - end[1] * b[0]) / determinant;
        curvature -= (a[0] * end[1] - a[1] * end[0]) / determinant;
    }
    half(force, curvature).1
}

/// What half a loop misses at its end, in angle and in place, and its size.
fn half(force: f64, curvature: f64) -> ([f64; 2], Pear) {
    let mut state = [0.0, curvature, 0.0, 0.0];
    let h = 0.5 / STEPS as f64;
    let mut widest: f64 = 0.0;
    for step in 0..STEPS {
        let rate = |_: f64, y: &[f64; 4]| [y[1], -force * y[0].sin(), y[0].cos(), y[0].sin()];
        state = runge_kutta(rate, step as f64 * h, &state, h);
        widest = widest.max(state[2]);
    }
    let size = Pear {
        height: state[3],
        width: 2.0 * widest,
    };
    ([state[0] - FRAC_PI_2, state[2]], size)
}
