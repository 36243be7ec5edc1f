//! When a sheet standing upright falls over.

use super::bisect;

/// Critical weight of a strip clamped at its foot and standing: the least q L^3/D
/// at which theta'' + Gamma t theta = 0, t from the tip, theta'(0) = 0,
/// theta(1) = 0, has a solution (Greenhill 1881), summed as its power series.
pub fn upright_gamma() -> f64 {
    let at_foot = |gamma: f64| {
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 1..40 {
            let n = 3.0 * f64::from(k);
            term *= -gamma / (n * (n - 1.0));
            sum += term;
        }
        sum
    };
    bisect(0.0, 20.0, |gamma| at_foot(gamma) < 0.0)
}
