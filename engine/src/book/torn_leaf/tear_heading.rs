//! Where the pull of two grabs leads a tear: in which direction its path shall go on.
//!
//! Paper between two grabs is pulled most along the way from one to the other, and parts across it
//! (maximum hoop stress; Erdogan and Sih 1963). So as that way swings in the plane in which the
//! sheet lay when both pulled first, the path swings with it. How the paper ahead of the tip turns
//! meanwhile is not counted: it is light, and whips about whenever a bit of the path parts.

use crate::models::sheet::{Sheet, wrapped};
use crate::real::bounded;
use crate::vector::sub;

/// Swing of the pull that a path follows, radians: less is no more than a hand trembles, and what
/// follows the swing costs as much as the beginning of a tear.
const LEAST_SWING: f64 = core::f64::consts::PI / 60.0;

/// Part of the way between two grabs that lies in the plane of the sheet, below which it says
/// nothing about a direction there.
const IN_PLANE: f64 = 0.5;

/// By how much a path turns at once, radians: what turns more does so in several steps, for nodes
/// move on the paper by that times their distance from the tip.
const MOST_AT_ONCE: f64 = 3.0 * LEAST_SWING;

/// How far a path turns at most from the heading with which its tear began, radians: so it goes on
/// away from where that was, and never comes back to itself.
const MOST_TURN: f64 = core::f64::consts::FRAC_PI_3;

/// Where a tear goes by the pull of its grabs.
#[derive(Clone, Copy, Debug)]
pub(super) struct TearHeading {
    /// Heading of the path where its tear began, radians in the sheet's frame; the one that the
    /// pull asks for; and the one that it was given last.
    begun: f64,
    asked: f64,
    given: f64,
    /// How the grabs pulled last; None before both did.
    last: Option<Pull>,
}

/// How two grabs pull a sheet.
#[derive(Clone, Copy, Debug)]
struct Pull {
    /// Two directions across each other in the plane in which the sheet lay when they pulled first,
    /// along u of its frame and about along v, of unit length.
    plane: [[f64; 3]; 2],
    /// The direction of the pull there, radians from u toward v.
    angle: f64,
}

impl TearHeading {
    /// Of a tear that begins with a heading, radians.
    pub fn from(heading: f64) -> TearHeading {
        TearHeading {
            begun: heading,
            asked: heading,
            given: heading,
            last: None,
        }
    }

    /// Grabs have changed: swings count from where they pull next.
    pub fn hold_anew(&mut self) {
        (self.asked, self.last) = (self.given, None);
    }

    /// Returns the heading of the path for grabs that pull to two places, if that is another than
    /// before.
    pub fn follow(&mut self, pulled: [[f32; 3]; 2], sheet: &Sheet) -> Option<f64> {
        let way = sub(pulled[1], pulled[0]).map(f64::from);
        if !way.iter().all(|x| x.is_finite()) {
            return None;
        }
        let Some(last) = &mut self.last else {
            self.last = Pull::of(way, sheet.lies_along()?);
            return None;
        };
        let angle = last.angle_of(way)?;
        self.asked += wrapped(angle - last.angle);
        last.angle = angle;
        let (least, most) = (self.begun - MOST_TURN, self.begun + MOST_TURN);
        let more = bounded(self.asked, least, most) - self.given;
        if more.abs() < LEAST_SWING {
            return None;
        }
        self.given += more.clamp(-MOST_AT_ONCE, MOST_AT_ONCE);
        Some(self.given)
    }
}

impl Pull {
    /// Of grabs that pull apart along a way, a sheet that lies so along u and v. None where that is
    /// not along the sheet.
    fn of(way: [f64; 3], [u, v]: [[f64; 3]; 2]) -> Option<Pull> {
        let first = unit(u)?;
        let part = dot(v, first);
        let second = unit(core::array::from_fn(|axis| v[axis] - part * first[axis]))?;
        let mut pull = Pull {
            plane: [first, second],
            angle: 0.0,
        };
        pull.angle = pull.angle_of(way)?;
        Some(pull)
    }

    /// The angle of a way in the plane, radians from u toward v; None where it is not along it.
    fn angle_of(&self, way: [f64; 3]) -> Option<f64> {
        let [u, v] = self.plane.map(|side| dot(way, side));
        let is_along = libm::hypot(u, v) > IN_PLANE * libm::sqrt(dot(way, way));
        is_along.then(|| libm::atan2(v, u))
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let long = libm::sqrt(dot(a, a));
    (long > f64::MIN_POSITIVE).then(|| a.map(|x| x / long))
}
