//! How the rest of a hinge follows its turn: what yields at once, and what creeps with time.
//!
//! Beyond its yield a hinge keeps the difference. Below it, paper that is kept bent flows ever
//! more slowly: a crease relaxes with the logarithm of time (Thiria and Adda-Bedia 2011,
//! "Relaxation mechanisms in the unfolding of thin sheets"). That is what thermally activated
//! flow gives (Eyring 1936): with x the turn off the rest, y the yield and c the creep, the
//! rest follows by
//!
//! dx/dt = -(c / T) exp((x - y) / c), so that x(t) = y - c ln(exp((y - x(0)) / c) + t / T)
//!
//! where nothing turns the hinge meanwhile. T is how long it takes to press a crease: at its
//! yield a crease loses c within about that time, c ln 10 more in each decade after it. As c
//! goes to 0 nothing flows below the yield, and all of it beyond.

/// How long a crease is pressed, s: what it bears so long without flowing much is its yield.
const PRESSING: f64 = 1.0;

/// How a hinge keeps its turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plasticity {
    /// Angle off its rest beyond which it yields at once, radians.
    pub yields: f64,
    /// Angle by which it creeps in a time that grows e-fold, radians; 0 where it does not.
    pub creep: f64,
}

impl Plasticity {
    /// Returns by how much the rest follows a hinge that is `turned` radians off it, in
    /// `seconds` of time; it yields only if it `may_yield`.
    pub fn follow(&self, turned: f64, may_yield: bool, seconds: f64) -> f64 {
        let mut off = turned.abs();
        if may_yield {
            off = off.min(self.yields);
        }
        if self.creep > 0.0 {
            off = self.crept(off, seconds);
        }
        (turned.abs() - off).copysign(turned)
    }

    /// What is left of a turn off the rest after a time in which the hinge is held.
    fn crept(&self, off: f64, seconds: f64) -> f64 {
        let below = (self.yields - off) / self.creep;
        let time = seconds / PRESSING;
        // Two ways to write one logarithm: the first keeps the digits of a slow flow, the second
        // is finite far beyond the yield.
        let flowed = if below > 0.0 {
            libm::log1p(time * libm::exp(-below))
        } else {
            (libm::log(libm::exp(below) + time) - below).max(0.0)
        };
        (off - self.creep * flowed).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hinge_without_creep_keeps_what_is_beyond_its_yield_alone() {
        let hinge = Plasticity {
            yields: 0.5,
            creep: 0.0,
        };
        assert_eq!(hinge.follow(0.4, true, 1e9), 0.0);
        assert_eq!(hinge.follow(-0.75, true, 0.0), -0.25);
        assert_eq!(hinge.follow(0.75, false, 1.0), 0.0);
    }

    #[test]
    fn a_hinge_that_is_held_creeps_with_the_logarithm_of_time() {
        let hinge = Plasticity {
            yields: 0.5,
            creep: 0.03,
        };
        for start in [0.5f64, -0.45, 0.35] {
            let mut turned = start;
            let mut seconds = 0.0;
            let mut decades = [1.0, 10.0, 100.0].into_iter().peekable();
            while let Some(decade) = decades.peek() {
                turned -= hinge.follow(turned, true, 0.005);
                seconds += 0.005;
                if seconds >= *decade {
                    let from = ((0.5 - start.abs()) / 0.03).exp();
                    let exact = 0.5 - 0.03 * (from + seconds).ln();
                    let off = (turned.abs() - exact).abs();
                    assert!(off < 1e-8, "from {start} after {seconds} s: {off} rad off");
                    decades.next();
                }
            }
        }
    }

    #[test]
    fn far_beyond_its_yield_a_hinge_that_may_not_yield_flows_to_it() {
        let hinge = Plasticity {
            yields: 0.3,
            creep: 1e-3,
        };
        assert_eq!(hinge.follow(3.0, false, 0.0), 0.0);
        let left = 3.0 - hinge.follow(3.0, false, 1.0);
        assert!((left - 0.3).abs() < 1e-3, "{left}");
    }

    #[test]
    fn one_long_step_creeps_as_far_as_many_short_ones() {
        let hinge = Plasticity {
            yields: 0.4,
            creep: 0.02,
        };
        let long = 0.4 - hinge.follow(0.4, true, 50.0);
        let mut short = 0.4;
        for _ in 0..1000 {
            short -= hinge.follow(short, true, 0.05);
        }
        assert!((long - short).abs() < 1e-4, "{long} and {short}");
    }
}
