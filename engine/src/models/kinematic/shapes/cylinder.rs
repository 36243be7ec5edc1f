//! The rolled sheet: flat up to a line, then around a cylinder that lies on the
//! table, and from half-way round it flat again, back over the rest.

use super::peel;
use super::root::root;
use core::f64::consts::{FRAC_PI_2, PI};

/// A leaf rolled around a cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Unit normal of the line where it leaves the table, toward what is rolled.
    normal: [f64; 2],
    /// Where along the normal that line lies, metres.
    line: f64,
    /// Radius, metres; 0 is a fold.
    radius: f64,
}

impl Cylinder {
    /// Flat on the right.
    pub const FLAT: Self = Self {
        normal: [1.0, 0.0],
        line: f64::MAX,
        radius: 0.0,
    };

    /// The roll of a leaf of `size` metres that brings `place` of it to `at`, whose line
    /// leaves the spine alone. Where both cannot be, the height is given up.
    pub fn toward(size: [f64; 2], place: [f64; 2], at: [f64; 3]) -> Self {
        let height = at[2].max(0.0);
        let at = peel::within(size, place, [at[0], at[1]]);
        let apart = [place[0] - at[0], place[1] - at[1]];
        let distance = libm::hypot(apart[0], apart[1]);
        if distance < 1e-9 * size[0] {
            return Self::FLAT;
        }
        let normal = apart.map(|part| part / distance);
        let along = |[x, y]: [f64; 2]| normal[0] * x + normal[1] * y;
        // From `at` along the normal: how far the spine reaches.
        let spine = along([0.0, 0.0]).max(along([0.0, size[1]])) - along(at);
        let (mut line, mut radius) = free(distance, height);
        if line < spine {
            (line, radius) = beside_spine(distance, spine);
        }
        Self {
            normal,
            line: along(at) + line,
            radius,
        }
    }

    /// The roll about the line at `line` metres along the unit `normal`, of a
    /// `radius` in metres.
    pub fn of(normal: [f64; 2], line: f64, radius: f64) -> Self {
        Self {
            normal,
            line,
            radius,
        }
    }

    /// Where the place (x, y) of the flat leaf is, metres.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let beyond = self.normal[0] * x + self.normal[1] * y - self.line;
        if beyond <= 0.0 {
            return [x, y, 0.0];
        }
        let (forward, up) = if beyond < PI * self.radius {
            let (sin, cos) = libm::sincos(beyond / self.radius);
            (self.radius * sin, self.radius * (1.0 - cos))
        } else {
            (PI * self.radius - beyond, 2.0 * self.radius)
        };
        let step = forward - beyond;
        [x + step * self.normal[0], y + step * self.normal[1], up]
    }
}

/// The line, from the hand along the normal, and the radius, by which what
/// rested `distance` away comes to the hand at `height`.
fn free(distance: f64, height: f64) -> (f64, f64) {
    if distance >= FRAC_PI_2 * height {
        // It lies beyond the roll, on its top.
        let radius = 0.5 * height;
        return (0.5 * (distance - PI * radius), radius);
    }
    // It is on the roll, at an angle: the two lengths are those of a cycloid,
    // whose proportion lies between a third and a half of the angle.
    let part = distance / height;
    let angle = root(2.0 * part, (3.0 * part).min(PI), |angle| {
        angle - libm::sin(angle) - part * up(angle)
    });
    let radius = height / up(angle);
    (-radius * libm::sin(angle), radius)
}

/// 1 - cos of an angle, exact also near 0.
fn up(angle: f64) -> f64 {
    let half = libm::sin(0.5 * angle);
    2.0 * half * half
}

/// The same where the line may be no nearer than `spine`; the height follows.
fn beside_spine(distance: f64, spine: f64) -> (f64, f64) {
    if spine >= 0.0 {
        return (spine, ((distance - 2.0 * spine) / PI).max(0.0));
    }
    // angle / sin(angle) = 1 + more, which bounds the angle from both sides.
    let more = -distance / spine;
    let low = PI * libm::sqrt(more / (1.0 + more));
    let angle = root(low, libm::sqrt(6.0 * more).min(PI), |angle| {
        angle - (1.0 + more) * libm::sin(angle)
    });
    (spine, (distance - spine) / angle)
}
