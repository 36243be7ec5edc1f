//! Newton's method with a line search.

use super::system::System;
use super::vector::{Vector, advance, length};

/// A potential to minimise over the places of the free nodes.
pub(super) trait Potential {
    /// Its value, J.
    fn value(&self, x: &[Vector]) -> f64;

    /// Adds gradient and Hessian: the exact one, or one without negative
    /// directions.
    fn add_to(&self, x: &[Vector], exact: bool, system: &mut System);
}

/// Part of the decrease foretold that a step must bring.
const ENOUGH: f64 = 1e-4;

/// Relative accuracy to which values of a potential can be compared.
const ROUNDING: f64 = 1e-12;

/// Shortest part of a Newton step.
const SHORTEST: f64 = 1e-10;

/// Moves `x` to a minimum of the potential, until no node moves further than
/// `tolerance` in a step. Returns whether that took at most `most` steps.
pub(super) fn minimise(
    potential: &impl Potential,
    x: &mut Vec<Vector>,
    system: &mut System,
    tolerance: f64,
    most: usize,
) -> bool {
    let mut value = potential.value(x);
    for _ in 0..most {
        let (step, slope) = newton_step(potential, x, system);
        let longest = step.iter().map(|s| length(*s)).fold(0.0, f64::max);
        if !longest.is_finite() {
            return false;
        }
        let Some((reached, lower, part)) = search(potential, x, &step, value, slope) else {
            return longest < tolerance;
        };
        (*x, value) = (reached, lower);
        if longest * part < tolerance && part > 0.5 {
            return true;
        }
    }
    false
}

/// The exact Newton step where it leads downhill for certain, or else that of a
/// Hessian without negative directions.
fn newton_step(
    potential: &impl Potential,
    x: &[Vector],
    system: &mut System,
) -> (Vec<Vector>, f64) {
    for exact in [true, false] {
        system.clear();
        potential.add_to(x, exact, system);
        if system.factorise() {
            break;
        }
    }
    system.newton_step()
}

/// The longest of the step, its half, its quarter and so on that lowers the
/// potential enough: the places, the potential there and the part of the step.
fn search(
    potential: &impl Potential,
    x: &[Vector],
    step: &[Vector],
    value: f64,
    slope: f64,
) -> Option<(Vec<Vector>, f64, f64)> {
    let mut part = 1.0;
    while part > SHORTEST {
        let moved: Vec<Vector> = x
            .iter()
            .zip(step)
            .map(|(x, s)| advance(*x, part, *s))
            .collect();
        let lower = potential.value(&moved);
        if lower <= value + ENOUGH * part * slope + ROUNDING * value.abs() {
            return Some((moved, lower, part));
        }
        part *= 0.5;
    }
    None
}
