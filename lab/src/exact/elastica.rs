//! The heavy elastica: an inextensible strip clamped at one end, bent by its own
//! weight and by a dead load at its tip, however far.
//!
//! With psi the angle of the strip up from hanging straight down, and t the
//! distance from the tip, moments balance as
//!
//! D psi'' = (q t + P) sin psi,   psi(0) = tip angle,   psi'(0) = 0
//!
//! (Landau and Lifshitz, Theory of Elasticity, section 19). Shot from the tip
//! every angle has one strip, and where it first reaches the angle of the clamp
//! falls steadily as the tip angle falls: so bisection finds it. A heavy strip's
//! tip hangs within e^-60 of straight down, hence the logarithm.

use core::f64::consts::{FRAC_PI_2, PI};

use super::{bisect, runge_kutta};

/// Steps over the length: many for a method of fourth order; the tests hold what
/// follows to 1e-5 against solutions found by other means.
const STEPS: usize = 4000;

/// A strip clamped at one end.
#[derive(Clone, Copy, Debug)]
pub struct Elastica {
    /// Its weight, q L^3 / D.
    pub gamma: f64,
    /// Dead load at its tip, downward, P L^2 / D.
    pub load: f64,
    /// Angle of its clamp upward from level, radians, within -pi to pi.
    pub clamp_angle: f64,
}

/// How it hangs: the shape that grows out of the straight strip as the load does.
#[derive(Clone, Copy, Debug)]
pub struct Hanging {
    /// How far the tip is from the clamp horizontally.
    pub reach: f64,
    /// How far it is below the clamp.
    pub drop: f64,
    /// Angle of the tip upward from level, radians.
    pub tip_angle: f64,
}

impl Elastica {
    /// The strip at rest.
    pub fn hanging(&self) -> Hanging {
        // Bent over backward is the mirror image of bent forward.
        if self.clamp_angle.abs() > FRAC_PI_2 {
            let mirror = |angle: f64| angle.signum() * PI - angle;
            let front = Elastica {
                clamp_angle: mirror(self.clamp_angle),
                ..*self
            }
            .hanging();
            return Hanging {
                reach: -front.reach,
                tip_angle: self.clamp_angle.signum() * PI - front.tip_angle,
                ..front
            };
        }
        let clamp = self.clamp_angle + FRAC_PI_2;
        if clamp <= 0.0 {
            return self.shape(0.0);
        }
        let tip = bisect(-400.0, 0.0, |log| self.reaches(clamp * log.exp(), clamp));
        self.shape(clamp * tip.exp())
    }

    /// Whether the strip of a tip angle reaches the clamp's within its length.
    fn reaches(&self, tip: f64, clamp: f64) -> bool {
        let mut state = [tip, 0.0];
        let h = 1.0 / STEPS as f64;
        for step in 0..STEPS {
            if state[0] >= clamp {
                return true;
            }
            let rate = |t: f64, y: &[f64; 2]| [y[1], self.moment_arm(t) * y[0].sin()];
            state = runge_kutta(rate, step as f64 * h, &state, h);
        }
        state[0] >= clamp
    }

    /// The strip of a tip angle.
    fn shape(&self, tip: f64) -> Hanging {
        let mut state = [tip, 0.0, 0.0, 0.0];
        let h = 1.0 / STEPS as f64;
        for step in 0..STEPS {
            let rate = |t: f64, y: &[f64; 4]| {
                let (sin, cos) = y[0].sin_cos();
                [y[1], self.moment_arm(t) * sin, sin, cos]
            };
            state = runge_kutta(rate, step as f64 * h, &state, h);
        }
        Hanging {
            reach: state[2],
            drop: state[3],
            tip_angle: tip - FRAC_PI_2,
        }
    }

    fn moment_arm(&self, t: f64) -> f64 {
        self.gamma * t + self.load
    }
}
