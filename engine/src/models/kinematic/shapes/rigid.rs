//! A board that swings about the spine, as the leaves of most libraries do.

/// A leaf that does not bend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    cos: f64,
    sin: f64,
}

impl Rigid {
    /// At an angle over the right-hand page, radians.
    pub fn at(angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { cos, sin }
    }

    /// Where the place (x, y) of the flat leaf is, metres.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        [x * self.cos, y, x * self.sin]
    }
}
