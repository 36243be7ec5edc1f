//! The 2D peel: the leaf is folded flat along the line that lies half-way
//! between where a place of it rests and where a hand has drawn it, and what is
//! beyond the line is its mirror image (Beaudouin-Lafon 2001).

use crate::models::kinematic::lead::reach;

/// How far the folded part lies above the rest, as part of the width: so little
/// that none sees it, and enough to draw the one over the other.
const HAIR: f64 = 2e-4;

/// A leaf folded along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peel {
    /// Unit normal of the fold, toward what is folded over.
    normal: [f64; 2],
    /// Where along the normal the fold lies, metres.
    fold: f64,
    /// Height of what is folded over, metres.
    hair: f64,
}

impl Peel {
    /// Flat on the right.
    pub const FLAT: Self = Self {
        normal: [1.0, 0.0],
        fold: f64::MAX,
        hair: 0.0,
    };

    /// The peel of a leaf of `size` metres that brings `place` of it to a point of the
    /// table, or as near as the spine lets it.
    pub fn toward(size: [f64; 2], place: [f64; 2], at: [f64; 2]) -> Self {
        let at = within(size, place, at);
        let apart = [place[0] - at[0], place[1] - at[1]];
        let distance = libm::hypot(apart[0], apart[1]);
        if distance < 1e-9 * size[0] {
            return Self::FLAT;
        }
        let normal = apart.map(|part| part / distance);
        let middle = [0.5 * (place[0] + at[0]), 0.5 * (place[1] + at[1])];
        // Once it lies on the left it is no longer above anything.
        let left = 2.0 * place[0] - distance;
        Self {
            normal,
            fold: normal[0] * middle[0] + normal[1] * middle[1],
            hair: HAIR * size[0] * (20.0 * left / size[0]).clamp(0.0, 1.0),
        }
    }

    /// Where the place (x, y) of the flat leaf is, metres.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let beyond = self.normal[0] * x + self.normal[1] * y - self.fold;
        if beyond <= 0.0 {
            return [x, y, 0.0];
        }
        let back = 2.0 * beyond;
        [
            x - back * self.normal[0],
            y - back * self.normal[1],
            self.hair,
        ]
    }
}

/// The point nearest to `at` to which `place` can be folded while both ends of
/// the spine stay: no farther from either than it is on the flat leaf.
pub(super) fn within(size: [f64; 2], place: [f64; 2], at: [f64; 2]) -> [f64; 2] {
    let [across, y] = reach(size[1], place, [libm::fabs(at[0]), at[1]]);
    [if at[0] < 0.0 { -across } else { across }, y]
}
