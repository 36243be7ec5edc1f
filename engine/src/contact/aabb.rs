//! Axis-aligned bounding boxes.

use crate::vector::sub;

/// An axis-aligned box by its corners of least and of greatest coordinates, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    pub low: [f32; 3],
    pub high: [f32; 3],
}

impl Aabb {
    /// The box around nothing: it overlaps none, and is as [`add`](Self::add) begins.
    pub const EMPTY: Aabb = Aabb {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
    };

    /// The box around points. Coordinates that are no number are left out.
    pub fn around(points: impl IntoIterator<Item = [f32; 3]>) -> Aabb {
        let mut all = Aabb::EMPTY;
        for point in points {
            all.add(point);
        }
        all
    }

    /// Grows to hold a point.
    #[inline]
    pub fn add(&mut self, point: [f32; 3]) {
        self.unite(&Aabb {
            low: point,
            high: point,
        });
    }

    /// Grows to hold another box.
    #[inline]
    pub fn unite(&mut self, other: &Aabb) {
        // Compared by hand: a library's least and most mind what is no number, and are slow.
        for axis in 0..3 {
            let (low, high) = (other.low[axis], other.high[axis]);
            if low < self.low[axis] {
                self.low[axis] = low;
            }
            if high > self.high[axis] {
                self.high[axis] = high;
            }
        }
    }

    /// The box that reaches farther by a length along each axis, metres.
    #[inline]
    pub fn grown(&self, by: [f32; 3]) -> Aabb {
        Aabb {
            low: core::array::from_fn(|axis| self.low[axis] - by[axis]),
            high: core::array::from_fn(|axis| self.high[axis] + by[axis]),
        }
    }

    /// Lengths of its sides, metres.
    pub fn size(&self) -> [f32; 3] {
        sub(self.high, self.low)
    }

    /// Whether two boxes have a point in common, their faces counted.
    #[inline]
    pub fn overlaps(&self, other: &Aabb) -> bool {
        (0..3).all(|axis| self.overlaps_along(axis, other))
    }

    /// Whether two boxes have a point in common as seen from above, along z.
    pub fn overlaps_in_plan(&self, other: &Aabb) -> bool {
        (0..2).all(|axis| self.overlaps_along(axis, other))
    }

    #[inline]
    fn overlaps_along(&self, axis: usize, other: &Aabb) -> bool {
        self.low[axis] <= other.high[axis] && self.high[axis] >= other.low[axis]
    }

    /// Whether a point lies in it or on its faces.
    #[inline]
    pub fn holds(&self, point: [f32; 3]) -> bool {
        (0..3).all(|axis| self.low[axis] <= point[axis] && self.high[axis] >= point[axis])
    }

    /// The square of its distance from a point, square metres; 0 within it.
    #[inline]
    pub fn square_distance(&self, point: [f32; 3]) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let (below, above) = (self.low[axis] - point[axis], point[axis] - self.high[axis]);
            let beside = if below > above { below } else { above };
            if beside > 0.0 { beside } else { 0.0 }
        });
        x * x + y * y + z * z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(low: [f32; 3], high: [f32; 3]) -> Aabb {
        Aabb { low, high }
    }

    #[test]
    fn the_box_around_points_holds_them_and_no_more() {
        let points = [[0.1, -0.2, 0.3], [-0.4, 0.5, 0.0], [0.0, 0.0, f32::NAN]];
        let all = Aabb::around(points);
        assert_eq!(all, of([-0.4, -0.2, 0.0], [0.1, 0.5, 0.3]));
        assert!(points[..2].iter().all(|point| all.holds(*point)));
        assert!(!all.holds([0.1, 0.5, 0.31]));
        let mut both = Aabb::around([points[0]]);
        both.unite(&Aabb::around([points[1]]));
        assert_eq!(both, Aabb::around([points[0], points[1]]));
    }

    #[test]
    fn boxes_overlap_up_to_their_faces_and_farther_once_grown() {
        let one = of([0.0; 3], [1.0; 3]);
        for axis in 0..3 {
            let beside = |by: f32| {
                let mut other = one;
                other.low[axis] += by;
                other.high[axis] += by;
                other
            };
            for by in [1.0, -1.0] {
                assert!(one.overlaps(&beside(by)) && beside(by).overlaps(&one));
                let apart = beside(1.25 * by);
                assert!(!one.overlaps(&apart));
                assert_eq!(one.overlaps_in_plan(&apart), axis == 2);
                let mut within = [0.0; 3];
                within[axis] = 0.25;
                assert!(one.grown(within).overlaps(&apart));
            }
        }
        assert!(!Aabb::EMPTY.overlaps(&one) && !one.overlaps(&Aabb::EMPTY));
    }

    #[test]
    fn distance_is_from_the_nearest_face_edge_or_corner() {
        let one = of([0.0; 3], [1.0, 2.0, 3.0]);
        for (point, square) in [
            ([0.5, 0.5, 0.5], 0.0),
            ([-2.0, 1.0, 1.0], 4.0),
            ([0.5, 3.0, 4.0], 2.0),
            ([3.0, -1.0, 5.0], 9.0),
        ] {
            assert_eq!(one.square_distance(point), square);
        }
    }
}
