//! What a discretisation of bending has to compute.

use super::clamp::Clamps;
use super::system::System;
use super::vector::Vector;

/// The bending energy of a leaf, with damping proportional to it: over a step
/// damping is `ratio` times the energy of the change of curvature since its
/// start (the incremental potential of stiffness-proportional damping).
pub(super) trait Bending: core::fmt::Debug + Send {
    /// Energy, J, with that of damping.
    fn energy(&self, x: &[Vector], clamps: &Clamps) -> f64;

    /// Adds gradient and Hessian: the exact one, or one without negative
    /// directions.
    fn add_to(&self, x: &[Vector], clamps: &Clamps, exact: bool, system: &mut System);

    /// Damps the change of curvature from that of `from`; 0 ends it.
    fn damp(&mut self, ratio: f64, from: &[Vector], clamps: &Clamps);

    /// Angle of a crease, radians as [`super::Crease::rest`], the mean over its
    /// length; None where the discretisation has no such crease.
    fn crease_angle(&self, _crease: usize, _x: &[Vector], _clamps: &Clamps) -> Option<f64> {
        None
    }

    /// Angle at which a crease bears no moment now, as [`Bending::crease_angle`].
    fn crease_rest(&self, _crease: usize) -> Option<f64> {
        None
    }

    /// Lets the rests of creases follow where these are, in `seconds` of time.
    fn let_creases_follow(&mut self, _x: &[Vector], _clamps: &Clamps, _seconds: f64) {}
}
