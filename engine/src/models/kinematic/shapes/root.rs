//! Where a function is 0.

/// Where a function rises from 0 or below at `low` to 0 or above at `high`, to
/// the last few bits (regula falsi after Illinois; Dowell and Jarratt 1971).
pub(super) fn root(low: f64, high: f64, of: impl Fn(f64) -> f64) -> f64 {
    let (mut a, mut b) = (low, high);
    let (mut fa, mut fb) = (of(a), of(b));
    for _ in 0..60 {
        if fa == 0.0 || libm::fabs(b - a) <= 1e-13 * (high - low) {
            return a;
        }
        if fb == 0.0 || fb == fa {
            return b;
        }
        let c = b - fb * (b - a) / (fb - fa);
        let fc = of(c);
        if (fc < 0.0) == (fb < 0.0) {
            fa *= 0.5;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (c, fc);
    }
    b
}
