//! Straight creases of a sheet: plastic hinges along lines at any angle.
//!
//! Paper is folded to a radius of about its caliper, far below any grid, so a
//! crease is a line whose moment is `stiffness * (angle - rest)` a length
//! (Lechenault, Thiria and Adda-Bedia 2014, "Mechanical response of a creased
//! sheet"). Turned further from its rest than it yields, it keeps the difference:
//! its rest angle follows, as that of a fold that is pressed. It may creep too (see
//! `models/plastic_hinge.rs`).

use crate::models::plastic_hinge::Plasticity;
use crate::stock::Stock;

/// A straight crease across a sheet, from edge to edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetCrease {
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
    /// Angle by which its rest creeps toward where it is held in a time that grows e-fold,
    /// radians, from 1 s on at its yield; 0 where it does not.
    pub creep: f64,
}

/// Stiffness of a crease over that of the paper across a width of the page: k L / D, where
/// paper folded by hand has a few (Lechenault, Thiria and Adda-Bedia 2014).
const PRESSED: f64 = 6.0;

/// Angle off its rest beyond which a crease pressed by hand yields, radians: pressing it shut
/// that rests a little open does not change it, and opening it does.
const YIELDS: f64 = 0.5;

/// Angle by which a crease of paper creeps in a time that grows e-fold, radians: 6 degrees a decade
/// (the slope of Farain 2020, "Relaxation constant in the folding of thin viscoelastic sheets",
/// taken for degrees; the same in every load and caliper).
const CREEP: f64 = 6.0 / 180.0 * core::f64::consts::PI / core::f64::consts::LN_10;

impl SheetCrease {
    /// A crease pressed by hand through two places (u and v) into a page `width` metres wide,
    /// of a stock, that rests at an angle, radians as [`SheetCrease::rest`].
    pub fn pressed(through: [[f64; 2]; 2], rest: f64, stock: &Stock, width: f64) -> SheetCrease {
        SheetCrease {
            through,
            rest,
            stiffness: PRESSED * stock.stiffness_across / width,
            yields: YIELDS,
            creep: 0.0,
        }
    }

    /// The crease after so many seconds in which it is held at an angle, radians as
    /// [`rest`](Self::rest), as one pressed by hand creeps. Beyond its yield it springs back, as
    /// all creases do that no hand holds.
    pub(crate) fn held_at(&self, angle: f64, seconds: f64) -> SheetCrease {
        let turned = angle - self.rest;
        let hinge = Plasticity {
            yields: self.yields,
            creep: CREEP,
        };
        let crept = if turned.abs() <= self.yields {
            hinge.follow(turned, false, seconds)
        } else {
            0.0
        };
        SheetCrease {
            rest: self.rest + crept,
            ..*self
        }
    }

    /// Whether the spine, whose ends the crease's line does not meet, lies all on one side of
    /// it: only then can a bound leaf be folded along it. `size` is the leaf's, metres.
    pub(crate) fn leaves_spine(&self, [width, height]: [f64; 2]) -> bool {
        let [a, b] = self.through.map(|[u, v]| [u * width, v * height]);
        let way = [b[0] - a[0], b[1] - a[1]];
        let side = |y: f64| way[0] * (y - a[1]) + way[1] * a[0];
        side(0.0) * side(height) > 0.0
    }

    /// Whether every figure is one that a crease can have.
    pub(crate) fn is_valid(&self) -> bool {
        let within = |at: &f64| (0.0..=1.0).contains(at);
        self.through.as_flattened().iter().all(within)
            && self.through[0] != self.through[1]
            // What rests at half a turn in single precision does too.
            && self.rest.abs() <= f64::from(core::f32::consts::PI)
            && self.stiffness > 0.0
            && self.yields > 0.0
            // What creeps has a yield to count from.
            && (self.creep == 0.0 || (self.creep > 0.0 && (self.creep + self.yields).is_finite()))
    }
}
