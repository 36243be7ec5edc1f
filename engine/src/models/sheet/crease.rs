//! Straight creases of a sheet: plastic hinges along lines at any angle.
//!
//! Paper is folded to a radius of about its caliper, far below any grid, so a
//! crease is a line whose moment is `stiffness * (angle - rest)` a length
//! (Lechenault, Thiria and Adda-Bedia 2014, "Mechanical response of a creased
//! sheet"). Turned further from its rest than it yields, it keeps the difference:
//! its rest angle follows, as that of a fold that is pressed.

/// A straight crease across a sheet, from edge to edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoldLine {
    /// Two places on its line, each u and v within 0 to 1; the crease goes on to the
    /// sheet's edges.
    pub through: [[f64; 2]; 2],
    /// Angle at which it bears no moment, radians within -pi to pi: 0 is flat, and
    /// above it the parts on either side are turned toward the side on which the
    /// normals point, that of the recto.
    pub rest: f64,
    /// Moment per length and radian, N; infinite where the angle never changes.
    pub stiffness: f64,
    /// Angle off its rest beyond which it yields, radians; infinite where it never
    /// does.
    pub yields: f64,
}

impl FoldLine {
    /// Whether every figure is one that a crease can have.
    pub(super) fn is_valid(&self) -> bool {
        let within = |at: &f64| (0.0..=1.0).contains(at);
        self.through.as_flattened().iter().all(within)
            && self.rest.abs() <= core::f64::consts::PI
            && self.stiffness > 0.0
            && self.yields > 0.0
    }
}
