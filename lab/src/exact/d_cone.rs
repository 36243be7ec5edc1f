//! A developable cone: a sheet that is pushed at a point into a ring or a funnel.

use core::f64::consts::PI;

use super::bisect;

/// A cone of small slope, shaped as r psi(theta) times the slope: psi is 1 where the sheet
/// touches the ring or the funnel, and A cos theta + B cos(n theta) within the sector that is lifted, of
/// half its angle on either side of theta = 0 (Cerda and Mahadevan 1998, "Conical surfaces
/// and crescent singularities in crumpled sheets").
pub struct DevelopableCone {
    /// Angle of the lifted sector, radians.
    pub sector: f64,
    n: f64,
    a: f64,
    b: f64,
}

impl DevelopableCone {
    /// The cone that is without stretch around its tip: at the end of the sector psi is 1
    /// with neither slope nor bend, so n tan(half) = tan(n half), and the integral of
    /// psi'^2 - psi^2 around the tip is 0.
    pub fn new() -> Self {
        let with_half = |half: f64| {
            // n half lies between the first and the third quarter turn.
            let tangent = half.tan();
            let n = bisect(PI / half, 1.5 * PI / half, |n| {
                (n * half).tan() > n * tangent
            });
            let b = 1.0 / ((1.0 - n * n) * (n * half).cos());
            let a = -n * n * b * (n * half).cos() / half.cos();
            Self {
                sector: 2.0 * half,
                n,
                a,
                b,
            }
        };
        let excess = |cone: &Self| {
            const PARTS: usize = 2000;
            let half = 0.5 * cone.sector;
            let at = |i: usize| {
                let theta = half * (i as f64 + 0.5) / PARTS as f64;
                let [psi, slope] = cone.psi(theta);
                slope * slope - psi * psi
            };
            2.0 * (0..PARTS).map(at).sum::<f64>() * half / PARTS as f64 - 2.0 * (PI - half)
        };
        with_half(bisect(0.6, 1.5, |half| excess(&with_half(half)) > 0.0))
    }

    /// Height over radius and slope, and the change of that with the angle, radians from the
    /// middle of the lifted sector.
    pub fn psi(&self, theta: f64) -> [f64; 2] {
        if theta.abs() >= 0.5 * self.sector {
            return [1.0, 0.0];
        }
        let (sin, cos) = theta.sin_cos();
        let (fast_sin, fast_cos) = (self.n * theta).sin_cos();
        [
            self.a * cos + self.b * fast_cos,
            -self.a * sin - self.n * self.b * fast_sin,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_developable_cone_is_lifted_over_139_degrees() {
        let cone = DevelopableCone::new();
        let sector = cone.sector.to_degrees();
        assert!((sector - 139.0).abs() < 0.05, "{sector}");
        // It meets the ring smoothly.
        let [height, slope] = cone.psi(0.4999 * cone.sector);
        assert!((height - 1.0).abs() < 1e-6 && slope.abs() < 1e-4);
    }
}
