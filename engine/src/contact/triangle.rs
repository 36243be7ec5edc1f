//! A triangle of what is drawn, and where places lie over it.

use super::flaps::BESIDE;
use crate::vector::{cross, dot, sub};

/// A triangle between points, looked at from a side. What follows from its corners alone is
/// computed once for all places that are looked at beside it.
pub struct Triangle {
    from: [f32; 3],
    /// Its unit normal, to the side that it is looked at from.
    pub normal: [f32; 3],
    /// Along these a place comes nearer to the second corner and to the third, by 1 from the edge
    /// between the other two to the corner, 1 / metres.
    toward: [[f32; 3]; 2],
}

impl Triangle {
    /// Of three points, metres, looked at from the side from which they go around
    /// counterclockwise, 1, or from the other, -1. One without an area has no normal, and no place
    /// over it.
    pub fn of([a, b, c]: [[f32; 3]; 3], side: f32) -> Triangle {
        let (u, v) = (sub(b, a), sub(c, a));
        let across = cross(u, v);
        let square = dot(across, across).max(f32::MIN_POSITIVE);
        let [inverse, over] = [side / square.sqrt(), 1.0 / square];
        Triangle {
            from: a,
            normal: across.map(|x| x * inverse),
            toward: [cross(v, across), cross(across, u)].map(|way| way.map(|x| x * over)),
        }
    }

    /// How high a place is over its plane, metres; less than 0 under it.
    pub fn height(&self, place: [f32; 3]) -> f32 {
        dot(sub(place, self.from), self.normal)
    }

    /// How near a place is to each corner: 1 on it, 0 on the edge between the others, below 0
    /// beyond that edge.
    pub fn weights(&self, place: [f32; 3]) -> [f32; 3] {
        let away = sub(place, self.from);
        let [b, c] = self.toward.map(|toward| dot(away, toward));
        [1.0 - b - c, b, c]
    }

    /// [How near](Self::weights) a place is to each corner, 0 to 1, if it lies over or under the
    /// triangle or hardly [beside](BESIDE) it.
    pub fn weights_over(&self, place: [f32; 3]) -> Option<[f32; 3]> {
        let weights = self.weights(place);
        let is_over = weights.iter().all(|weight| *weight > -BESIDE);
        is_over.then(|| weights.map(|weight| weight.max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A right triangle with legs of 20 and 10 mm, 5 mm above the origin.
    fn corners() -> [[f32; 3]; 3] {
        [[0.0, 0.0, 0.005], [0.02, 0.0, 0.005], [0.0, 0.01, 0.005]]
    }

    #[test]
    fn a_place_is_as_high_over_it_as_it_is_under_it_from_the_other_side() {
        for side in [1.0, -1.0] {
            let triangle = Triangle::of(corners(), side);
            let height = triangle.height([0.3, -0.2, 0.007]);
            assert!((height - side * 0.002).abs() < 1e-8, "{height}");
            assert_eq!(triangle.normal, [0.0, 0.0, side]);
        }
    }

    #[test]
    fn weights_are_those_of_the_corners_that_make_up_a_place() {
        let triangle = Triangle::of(corners(), 1.0);
        for weights in [[1.0f32, 0.0, 0.0], [0.2, 0.5, 0.3], [0.5, 0.7, -0.2]] {
            let place: [f32; 3] = core::array::from_fn(|axis| {
                let of = corners().into_iter().zip(weights);
                of.map(|(corner, weight)| weight * corner[axis]).sum()
            });
            let found = triangle.weights([place[0], place[1], 0.02]);
            for (found, weight) in found.into_iter().zip(weights) {
                assert!((found - weight).abs() < 1e-6, "{found} of {weight}");
            }
            let is_over = triangle.weights_over(place).is_some();
            assert_eq!(is_over, weights[2] > -BESIDE, "{weights:?}");
        }
    }

    #[test]
    fn nothing_lies_over_one_without_an_area() {
        let triangle = Triangle::of([[0.0; 3], [0.01, 0.0, 0.0], [0.02, 0.0, 0.0]], 1.0);
        assert_eq!(triangle.normal, [0.0; 3]);
    }
}
