//! Exact solutions of beam theory, to hold the models against. All lengths over
//! the length of the strip, all loads over its stiffness.

mod buckling;
mod creased;
mod d_cone;
mod elastica;
mod pear;

pub use buckling::upright_gamma;
pub use creased::CreasedElastica;
pub use d_cone::DevelopableCone;
pub use elastica::Elastica;
pub use pear::pear_loop;

/// Roots of cos x cosh x = -1: the first three modes of a strip clamped at one
/// end vibrate with the squares of these, times sqrt(D / mass) / L^2.
pub fn vibration_roots() -> [f64; 3] {
    // cos changes sign once between neighbouring multiples of pi, and so does
    // the sum with the small 1/cosh.
    [0.0, 1.0, 2.0].map(|mode| {
        let pi = core::f64::consts::PI;
        bisect(mode * pi + 0.5, (mode + 1.0) * pi, |x| {
            let rising = if mode == 1.0 { 1.0 } else { -1.0 };
            rising * (x.cos() + 1.0 / x.cosh()) > 0.0
        })
    })
}

/// Where a condition that is false at `low` and true at `high` becomes true.
fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

/// One step of the classic Runge-Kutta method from `t` to `t + h`.
fn runge_kutta<const N: usize>(
    rate: impl Fn(f64, &[f64; N]) -> [f64; N],
    t: f64,
    y: &[f64; N],
    h: f64,
) -> [f64; N] {
    let ahead = |k: &[f64; N], part: f64| core::array::from_fn(|i| y[i] + part * h * k[i]);
    let k1 = rate(t, y);
    let k2 = rate(t + 0.5 * h, &ahead(&k1, 0.5));
    let k3 = rate(t + 0.5 * h, &ahead(&k2, 0.5));
    let k4 = rate(t + h, &ahead(&k3, 1.0));
    core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
}

#[cfg(test)]
mod tests;
