//! The creased heavy elastica: an inextensible strip clamped level at one end
//! with one crease, bent by its own weight, however far.
//!
//! As [`super::Elastica`] on either side of the crease; there the moment goes on
//! and the strip turns by the crease's angle, which is its rest angle and the
//! moment over the crease's stiffness. Several strips may be at rest at one weight.
//! The one meant grows out of the weightless strip as the weight does: so the
//! weight is raised step by step, and the angle of the tip follows by Newton's
//! method.

use core::f64::consts::FRAC_PI_2;

use super::runge_kutta;

/// Steps over each part of the length: the tests hold what follows to 1e-5.
const STEPS: usize = 1000;

/// Steps in which the weight is raised, and the least part of one that is tried.
const RAISES: f64 = 50.0;
const LEAST_RAISE: f64 = 1e-4;

/// Newton steps that a small raise of the weight may need, and the error of the
/// clamp's angle at which they end, radians.
const NEWTON_STEPS: usize = 8;
const TOLERANCE: f64 = 1e-10;

/// Most that the tip may turn in one raise, radians: further is another strip.
const MOST_TURN: f64 = 0.2;

/// A strip clamped level, with a crease.
#[derive(Clone, Copy, Debug)]
pub struct CreasedElastica {
    /// Its weight, q L^3 / D.
    pub gamma: f64,
    /// Distance of the crease from the clamp, over the length.
    pub at: f64,
    /// Angle of the crease without moment, radians, above 0 where the strip is
    /// turned up.
    pub rest: f64,
    /// Stiffness of the crease, k L / D; infinite for a rigid one.
    pub stiffness: f64,
}

/// How it hangs.
#[derive(Clone, Copy, Debug)]
pub struct CreasedHanging {
    /// How far the tip is from the clamp horizontally.
    pub reach: f64,
    /// How far it is below the clamp.
    pub drop: f64,
    /// Angle of the tip upward from level, radians, all turns counted.
    pub tip_angle: f64,
    /// Angle of the crease, radians.
    pub crease_angle: f64,
}

/// Angle from hanging straight down, its rate, both once more by the angle of the
/// tip, and how far the tip is to the right and below.
type State = [f64; 6];

impl CreasedElastica {
    /// The strip at rest.
    ///
    /// # Errors
    /// Where the strip that grows out of the weightless one ends before its weight
    /// is reached, in a sentence.
    pub fn hanging(&self) -> Result<CreasedHanging, String> {
        let (mut tip, mut gamma, mut raise) = (FRAC_PI_2 + self.rest, 0.0, 1.0 / RAISES);
        let mut slope = 0.0;
        while gamma < self.gamma {
            let next = self.gamma.min(gamma + raise * self.gamma);
            let guess = tip + slope * (next - gamma);
            match self.tip_at(next, guess) {
                Some(found) if (found - tip).abs() < MOST_TURN => {
                    slope = (found - tip) / (next - gamma);
                    (tip, gamma) = (found, next);
                    raise = (1.5 * raise).min(1.0 / RAISES);
                }
                _ => raise *= 0.5,
            }
            if raise < LEAST_RAISE {
                return Err(format!(
                    "A strip with this crease falls over at Gamma {gamma:.3}, before {}.",
                    self.gamma
                ));
            }
        }
        let (end, crease_angle) = self.shoot(gamma, tip);
        Ok(CreasedHanging {
            reach: end[4],
            drop: end[5],
            tip_angle: tip - FRAC_PI_2,
            crease_angle,
        })
    }

    /// The angle of the tip near a guess at which the strip leaves its clamp level.
    fn tip_at(&self, gamma: f64, guess: f64) -> Option<f64> {
        let mut tip = guess;
        for _ in 0..NEWTON_STEPS {
            let (end, _) = self.shoot(gamma, tip);
            let error = end[0] - FRAC_PI_2;
            if error.abs() < TOLERANCE {
                return Some(tip);
            }
            tip -= error / end[2];
        }
        None
    }

    /// The state at the clamp of the strip of a tip's angle, and its crease's angle.
    fn shoot(&self, gamma: f64, tip: f64) -> (State, f64) {
        let crease = 1.0 - self.at;
        let mut state = self.integrate(gamma, [0.0, crease], [tip, 0.0, 1.0, 0.0, 0.0, 0.0]);
        let angle = self.rest - state[1] / self.stiffness;
        state[0] -= angle;
        state[2] += state[3] / self.stiffness;
        (self.integrate(gamma, [crease, 1.0], state), angle)
    }

    fn integrate(&self, gamma: f64, [from, to]: [f64; 2], mut state: State) -> State {
        let h = (to - from) / STEPS as f64;
        for step in 0..STEPS {
            let rate = |t: f64, y: &State| {
                let (sin, cos) = y[0].sin_cos();
                let pull = gamma * t;
                [y[1], pull * sin, y[3], pull * cos * y[2], sin, cos]
            };
            state = runge_kutta(rate, from + step as f64 * h, &state, h);
        }
        state
    }
}
