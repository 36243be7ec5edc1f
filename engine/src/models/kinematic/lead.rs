//! What leads a kinematic leaf, and how far paper lets it be led.

/// The place of the leaf that is led, and where it is led.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lead {
    /// Metres along u and v.
    pub place: [f64; 2],
    /// Angle about the spine for a turn from right to left, radians: 0 level on the right, pi on the
    /// left.
    pub angle: f64,
    /// Distance from the spine, metres.
    pub distance: f64,
    /// Place along the spine from the foot, metres.
    pub along: f64,
    /// How conical a cone is, -1 to 1 as of [`Cone::toward`](super::shapes::Cone::toward); None where the
    /// place to which it leads says it.
    pub conical: Option<f64>,
}

impl Lead {
    /// A place of the flat leaf, metres along u and v, led to where it is when the leaf lies at an
    /// angle, radians.
    pub fn rest(place: [f64; 2], angle: f64) -> Self {
        Self {
            place,
            angle,
            distance: place[0],
            along: place[1],
            conical: None,
        }
    }

    /// Where it is led: x, y, z in metres.
    pub fn at(&self) -> [f64; 3] {
        let (sin, cos) = libm::sincos(self.angle);
        [self.distance * cos, self.along, self.distance * sin]
    }

    /// Leads to a place, metres, or the nearest that paper reaches on a spine `height` metres long.
    pub fn go(&mut self, height: f64, [x, y, z]: [f64; 3]) {
        let (distance, z) = (libm::hypot(x, z.max(0.0)), z.max(0.0));
        [self.distance, self.along] = reach(height, self.place, [distance, y]);
        self.angle = libm::atan2(z, x);
    }
}

/// The point nearest to `at` (distance from the spine, place along it; all metres) where
/// paper reaches: no farther from either end of a spine of `height` than `place`
/// is on the flat leaf.
pub(super) fn reach(height: f64, place: [f64; 2], at: [f64; 2]) -> [f64; 2] {
    let middles = [0.0, height];
    let far = |[x, y]: [f64; 2], end: usize| libm::hypot(x, y - middles[end]);
    let most = |end: usize| far(place, end);
    let onto = |end: usize| {
        let scale = most(end) / far(at, end).max(1e-12);
        let middle = middles[end];
        [at[0] * scale, middle + (at[1] - middle) * scale]
    };
    let within = |point: [f64; 2], end: usize| far(point, end) <= most(end) * (1.0 + 1e-12);
    if within(at, 0) && within(at, 1) {
        return at;
    }
    for end in [0, 1] {
        if !within(at, end) {
            let nearest = onto(end);
            if within(nearest, 1 - end) {
                return nearest;
            }
        }
    }
    place
}
