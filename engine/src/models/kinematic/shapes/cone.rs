//! The cone (Hong, Card and Chen 2006): the leaf is bent around a cone whose
//! apex lies on the line of the spine, and turned about the spine. Lengths on
//! it are those of the flat leaf, and the spine stays where it is.

use super::root::root;
use core::f64::consts::{FRAC_PI_2, PI};

/// Greatest angle around the cone, radians: beyond it the leaf would come to lie
/// on itself.
const ROUND: f64 = 1.5 * PI;

/// Most conical leaf: its apex is a third of the height from it.
const MOST_CONICAL: f64 = 0.75;

/// Below this the cone is as good as a cylinder, and its apex near enough for
/// the arithmetic.
const LEAST_CONICAL: f64 = 1e-4;

/// A leaf bent around a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// From the apex to the leaf along the spine, metres, and whether the apex is
    /// over the head instead of under the foot.
    apex: f64,
    over_head: bool,
    height: f64,
    /// Sine of the cone's half-angle: 1 is flat.
    sine: f64,
    /// Angle about the spine, radians.
    turn: f64,
}

impl Cone {
    /// Flat on the right.
    pub const FLAT: Self = Self {
        apex: 1.0,
        over_head: false,
        height: 1.0,
        sine: 1.0,
        turn: 0.0,
    };

    /// A cone by its own figures: its apex at `apex` metres under the foot of a
    /// leaf, its half-angle and its angle about the spine in radians.
    pub fn of(apex: f64, half_angle: f64, turn: f64) -> Self {
        Self {
            apex,
            sine: libm::sin(half_angle),
            turn,
            ..Self::FLAT
        }
    }

    /// The cone of a leaf of `size` metres that brings `place` of it to `at`: to its
    /// direction from the spine, to its distance from the spine, and, where
    /// `conical` is none, as near to its place along the spine as a cone can.
    /// Else `conical` is how conical the leaf is: 0 a cylinder, up to 1 with the
    /// apex nearer to the foot, down to -1 to the head.
    ///
    /// It bends toward the left, so over the right-hand page it comes no nearer
    /// to the spine than its bend lets it while it leaves the spine level.
    pub fn toward(size: [f64; 2], place: [f64; 2], at: [f64; 3], conical: Option<f64>) -> Self {
        let distance = libm::hypot(at[0], at[2]);
        let angle = libm::atan2(at[2].max(0.0), at[0]);
        let bent = |conical: f64| Self::bent(size, place, distance, conical);
        let conical = conical.unwrap_or_else(|| {
            let away = |conical: f64| bent(conical).curl(place)[1] - at[1];
            let (low, high) = (away(-MOST_CONICAL), away(MOST_CONICAL));
            if low >= 0.0 || high <= 0.0 {
                let nearer = libm::fabs(low) < libm::fabs(high);
                return if nearer { -MOST_CONICAL } else { MOST_CONICAL };
            }
            root(-MOST_CONICAL, MOST_CONICAL, away)
        });
        // What leads over the left-hand page must not go through it.
        let first = |cone: &Self| [size[0], if cone.over_head { size[1] } else { 0.0 }];
        let through = |conical: f64| {
            let cone = bent(conical);
            angle - cone.lead(place) + cone.lead(first(&cone)) - PI
        };
        let mut cone = bent(conical);
        if through(conical) > 0.0 {
            cone = bent(conical * root(0.0, 1.0, |part| through(part * conical)));
        }
        if cone.lead(place) > angle {
            let open = |sine: f64| Self { sine, ..cone };
            let sine = root(cone.sine, 1.0, |sine| angle - open(sine).lead(place));
            cone = open(sine);
        }
        let most = PI - cone.lead(first(&cone));
        cone.turn = (angle - cone.lead(place)).min(most).max(0.0);
        cone
    }

    /// Bent so far that `place` is `distance` from the spine, level at the spine.
    fn bent(size: [f64; 2], place: [f64; 2], distance: f64, conical: f64) -> Self {
        let part = libm::fabs(conical).clamp(LEAST_CONICAL, MOST_CONICAL);
        let mut cone = Self {
            apex: size[1] * (1.0 / part - 1.0),
            over_head: conical < 0.0,
            height: size[1],
            ..Self::FLAT
        };
        let away = |sine: f64| {
            let [x, _, z] = Self { sine, ..cone }.curl(place);
            libm::hypot(x, z) - distance
        };
        let tightest = libm::atan2(size[0], cone.apex) / ROUND;
        cone.sine = if distance >= place[0] {
            1.0
        } else if away(tightest) >= 0.0 {
            tightest
        } else {
            root(tightest, 1.0, away)
        };
        cone
    }

    /// Angle by which a place runs ahead of the leaf at the spine.
    fn lead(&self, place: [f64; 2]) -> f64 {
        let [x, _, z] = self.curl(place);
        libm::atan2(z, x)
    }

    /// Where a place is while the leaf leaves the spine level.
    fn curl(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let up = if self.over_head { self.height - y } else { y };
        let from = self.apex + up;
        let far = libm::hypot(x, from);
        let around = libm::atan2(x, from) / self.sine;
        let (sin, cos) = libm::sincos(around);
        let radius = far * self.sine;
        let rise = radius * (1.0 - cos);
        // From the apex `far`, without the rounding of a far apex.
        let along = up + x * x / (far + from) - rise * self.sine;
        let y = if self.over_head {
            self.height - along
        } else {
            along
        };
        let cosine = libm::sqrt((1.0 - self.sine * self.sine).max(0.0));
        [radius * sin, y, rise * cosine]
    }

    /// Where the place (x, y) of the flat leaf is, metres.
    pub fn place(&self, place: [f64; 2]) -> [f64; 3] {
        let [x, y, z] = self.curl(place);
        let (sin, cos) = libm::sincos(self.turn);
        [x * cos - z * sin, y, x * sin + z * cos]
    }

    /// Half-angle of the cone, radians: a right angle is flat.
    pub fn half_angle(&self) -> f64 {
        if self.sine >= 1.0 {
            FRAC_PI_2
        } else {
            libm::asin(self.sine)
        }
    }

    /// Angle about the spine at which it leaves it, radians.
    pub fn turn(&self) -> f64 {
        self.turn
    }
}
