//! How a kinematic leaf falls once it is let go: as a board of its weight would
//! about the spine, in air.

use super::settings::KinematicSettings;
use core::f64::consts::PI;

/// Time in which a bent leaf straightens out, seconds.
const STRAIGHTENS: f64 = 0.08;

/// The forces on a falling board, each over its inertia.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fall {
    /// Of its weight, rad/s^2 when it is level.
    weight: f64,
    /// Of the air, per (rad/s)^2.
    drag: f64,
}

impl Fall {
    /// A board of the leaf's size and weight, hinged at the spine, in its air.
    pub fn new(settings: &KinematicSettings) -> Self {
        let (own, air) = (settings.stock.grammage, &settings.air);
        let (width, mass) = (settings.width, own + air.added_mass);
        // Per metre of spine: inertia m w^3 / 3, weight m g w^2 / 2, drag
        // rho C w^4 / 8 times the square of the rate.
        Self {
            weight: 1.5 * settings.gravity * own / (mass * width),
            drag: 0.375 * air.density * air.drag * width / mass,
        }
    }

    /// An angle, radians, and its rate, rad/s, after a step of `h` seconds.
    pub fn step(&self, angle: f64, rate: f64, h: f64) -> (f64, f64) {
        // At the very top it would stand for seconds: it goes on to the left.
        let level = libm::cos(angle);
        let pull = if libm::fabs(level) < 1e-3 && libm::fabs(rate) < 1e-3 {
            1e-2
        } else {
            -level
        };
        let driven = rate + h * self.weight * pull;
        // Drag implicitly, so that no rate however high turns round.
        let rate = driven / (1.0 + h * self.drag * libm::fabs(driven));
        ((angle + h * rate).clamp(0.0, PI), rate)
    }

    /// Part of its bend that is left after a step of `h` seconds.
    pub fn straightening(h: f64) -> f64 {
        libm::exp(-h / STRAIGHTENS)
    }
}
