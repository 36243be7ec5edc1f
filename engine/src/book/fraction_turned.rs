//! How far round the spine a direction is turned.

/// The angle of (dx, dz) from the right-hand side, as a fraction of a half turn:
/// 0 right, 0.5 up, 1 left; downward directions mirror the upward ones.
///
/// acos by Abramowitz and Stegun 4.4.45, absolute error below 7e-5 rad, exact
/// at both ends.
pub fn fraction_turned(dx: f32, dz: f32) -> f32 {
    let length = (dx * dx + dz * dz).sqrt();
    if length < 1e-12 {
        return 0.5;
    }
    let c = (dx / length).clamp(-1.0, 1.0);
    let a = c.abs();
    let series = 1.570_728_8 + a * (-0.212_114_4 + a * (0.074_261 - a * 0.018_729_3));
    let fraction = (1.0 - a).sqrt() * series * core::f32::consts::FRAC_1_PI;
    if c >= 0.0 { fraction } else { 1.0 - fraction }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fraction_is_the_angle() {
        for i in 0..=180 {
            let angle = i as f32 * core::f32::consts::PI / 180.0;
            let (sin, cos) = libm::sincosf(angle);
            assert!((fraction_turned(cos, sin) - i as f32 / 180.0).abs() < 3e-5);
        }
    }
}
