//! Straight creases along columns of a shell: hinges with a rest angle.
//!
//! Paper is folded to a radius of about its caliper, far below any grid, so a
//! crease is a line whose moment is `stiffness * (angle - rest)` a length
//! (Lechenault, Thiria and Adda-Bedia 2014, "Mechanical response of a creased
//! sheet"). The hinge of the mesh that lies on it turns by the crease's angle and
//! by what the paper in the two half cells beside it bends. The same moment goes
//! through both, so they are springs in series. In time its rest follows its turn as
//! that of a sheet's crease does (see `models/plastic_hinge.rs`).

use crate::models::plastic_hinge::Plasticity;

/// A straight crease along a column of nodes, parallel to the spine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crease {
    /// The column, neither the first nor the last.
    pub column: usize,
    /// Angle at which it bears no moment, radians within -pi to pi: 0 is flat,
    /// and above it the part towards the fore-edge is turned up.
    pub rest: f64,
    /// Moment per length and radian, N; infinite where the angle never changes.
    pub stiffness: f64,
    /// Angle off its rest beyond which it yields in a step, radians; infinite where it never does.
    pub yields: f64,
    /// Angle by which its rest creeps toward where it is held in a time that grows e-fold,
    /// radians, from 1 s on at its yield; 0 where it does not.
    pub creep: f64,
}

impl Crease {
    /// An elastic crease: neither yields nor creeps.
    pub fn elastic(column: usize, rest: f64, stiffness: f64) -> Crease {
        Crease {
            column,
            rest,
            stiffness,
            yields: f64::INFINITY,
            creep: 0.0,
        }
    }
}

/// A hinge of the mesh on a crease.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fold {
    /// Which hinge, and which crease.
    pub hinge: usize,
    /// The crease's place in the settings' list.
    pub crease: usize,
    /// Angle of the hinge where neither crease nor paper bears a moment.
    rest: f64,
    /// Part of the turn from there that bends the paper beside the crease.
    fraction: f64,
    /// Energy in the crease is half of this times that part's square.
    pub stiffness: f64,
    plasticity: Plasticity,
}

impl Fold {
    /// The fold of a hinge whose paper alone would have a moment of `paper` times
    /// its angle, and whose part of crease number `crease` has one of `spring` times its own, N m.
    pub fn new(
        (hinge, crease): (usize, usize),
        folded: &Crease,
        [paper, spring]: [f64; 2],
    ) -> Self {
        Self {
            hinge,
            crease,
            // A hinge's angle is positive where the surface bulges upward.
            rest: -folded.rest,
            fraction: 1.0 / (1.0 + paper / spring),
            stiffness: paper * paper / spring,
            plasticity: Plasticity {
                yields: folded.yields,
                creep: folded.creep,
            },
        }
    }

    /// What the paper bends where the hinge is at an angle, both radians.
    pub fn bent(&self, angle: f64) -> f64 {
        self.fraction * (angle - self.rest)
    }

    /// The change of that with the angle.
    pub fn slope(&self) -> f64 {
        self.fraction
    }

    /// Angle of the crease where the paper beside it bends by `bent`.
    pub fn angle(&self, bent: f64) -> f64 {
        self.rest + self.turned(bent)
    }

    /// Angle at which the crease bears no moment, radians.
    pub fn rest(&self) -> f64 {
        self.rest
    }

    /// Lets its rest follow a crease beside which the paper bends by `bent`, in `seconds`.
    pub fn follow(&mut self, bent: f64, seconds: f64) {
        let turned = self.turned(bent);
        self.rest += self.plasticity.follow(turned, true, seconds);
    }

    /// How far the crease is off its rest where the paper beside it bends by `bent`.
    fn turned(&self, bent: f64) -> f64 {
        bent / self.fraction - bent
    }
}
