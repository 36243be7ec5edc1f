//! Triangles of paper: where places and edges lie over them, and how near.

use crate::vector::{cross, dot, sub};

/// How far beyond a triangle's sides, as part of its size, what lies over it still does.
pub const BESIDE: f32 = 0.05;

/// The normal of a triangle, to the side from which its corners go around counterclockwise, twice
/// as long as it is large.
#[inline]
pub fn area_normal([a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    cross(sub(b, a), sub(c, a))
}

/// The place of which the corners have these weights.
#[inline]
pub fn place_of(weights: [f32; 3], [a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    core::array::from_fn(|i| weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i])
}

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
        let square = dot(across, across);
        let inverse = side / square.max(f32::MIN_POSITIVE).sqrt();
        // Of no area the weights are no numbers, and none of them is great enough.
        let over = 1.0 / square;
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

    /// Of the places of an edge that lie over or under the triangle the lowest; None where none
    /// does.
    pub fn lowest_of_edge(&self, ends: [[f32; 3]; 2]) -> Option<EdgePlace> {
        let heights = ends.map(|end| self.height(end));
        let of_ends = ends.map(|end| self.weights(end));
        let weights: [[f32; 2]; 3] = core::array::from_fn(|k| of_ends.map(|weights| weights[k]));
        // The part of the way on which none is below 0.
        let (mut first, mut last) = (0.0f32, 1.0f32);
        for [a, b] in weights {
            match (a < 0.0, b < 0.0) {
                (true, true) => return None,
                (true, false) if a / (a - b) > first => first = a / (a - b),
                (false, true) if a / (a - b) < last => last = a / (a - b),
                _ => {}
            }
        }
        let way = if heights[0] < heights[1] { first } else { last };
        (first <= last).then(|| EdgePlace {
            way,
            weights: weights.map(|[a, b]| (a + way * (b - a)).max(0.0)),
            height: heights[0] + way * (heights[1] - heights[0]),
        })
    }
}

/// A place of an edge over a triangle.
pub struct EdgePlace {
    /// How far along the edge it is, from 0 at its first end to 1 at its second.
    pub way: f32,
    /// How near it is to each corner of the triangle, as [`Triangle::weights`], 0 to 1.
    pub weights: [f32; 3],
    /// How high it is over the triangle's plane, metres.
    pub height: f32,
}

/// A triangle as seen from above, along the third axis.
pub struct PlanTriangle {
    from: [f32; 3],
    /// From the first corner to the second and to the third, metres.
    sides: [[f32; 3]; 2],
    /// One over twice its area in plan, 1/m^2.
    inverse: f32,
}

impl PlanTriangle {
    /// Of three points, metres; None where twice its area in plan is no more than `least`, m^2.
    pub fn of([a, b, c]: [[f32; 3]; 3], least: f32) -> Option<PlanTriangle> {
        let [u, v] = [sub(b, a), sub(c, a)];
        let area = u[0] * v[1] - u[1] * v[0];
        (area.abs() > least).then(|| PlanTriangle {
            from: a,
            sides: [u, v],
            inverse: 1.0 / area,
        })
    }

    /// How high it is at a place, metres; None where it is not there.
    #[inline]
    pub fn height_at(&self, [x, y]: [f32; 2]) -> Option<f32> {
        let [u, v] = self.sides;
        let away = [x - self.from[0], y - self.from[1]];
        let on_b = self.inverse * (away[0] * v[1] - away[1] * v[0]);
        let on_c = self.inverse * (u[0] * away[1] - u[1] * away[0]);
        let is_in = on_b >= 0.0 && on_c >= 0.0 && on_b + on_c <= 1.0;
        is_in.then(|| self.from[2] + on_b * u[2] + on_c * v[2])
    }
}

/// The weights of a triangle's corners of its place nearest to a point (Ericson,
/// Real-Time Collision Detection, 2005, 5.1.5).
pub fn nearest_weights(p: [f32; 3], [a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let along = |from: f32, to: f32| from / (from - to).max(1e-30);
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = along(d1, d3);
        return [1.0 - t, t, 0.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = along(d2, d6);
        return [1.0 - t, 0.0, t];
    }
    let va = d3 * d6 - d5 * d4;
    let (e, f) = (d4 - d3, d5 - d6);
    if va <= 0.0 && e >= 0.0 && f >= 0.0 {
        let t = e / (e + f).max(1e-30);
        return [0.0, 1.0 - t, t];
    }
    let whole = 1.0 / (va + vb + vc).max(1e-30);
    let (v, w) = (vb * whole, vc * whole);
    [1.0 - v - w, v, w]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

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
    fn an_edge_is_lowest_over_a_triangle_at_its_end_or_where_it_passes_its_side() {
        let triangle = Triangle::of(corners(), 1.0);
        let edge = |from: [f32; 3], to: [f32; 3]| {
            let place = triangle.lowest_of_edge([from, to])?;
            Some([place.way, place.weights[0], place.height])
        };
        let is = |found: Option<[f32; 3]>, expected: [f32; 3]| {
            let off = |(a, b): (f32, f32)| (a - b).abs();
            let found = found.expect("it lies over it");
            found.into_iter().zip(expected).map(off).fold(0.0, f32::max) < 1e-6
        };
        // Ends over it, from one beside it, and past it.
        assert!(is(
            edge([0.0, 0.0, 0.006], [0.01, 0.0, 0.004]),
            [1.0, 0.5, -1e-3]
        ));
        assert!(is(
            edge([-0.01, 0.0, 0.0], [0.01, 0.0, 0.01]),
            [0.5, 1.0, 0.0]
        ));
        assert!(edge([-0.01, 0.0, 0.0], [-0.01, 0.02, 0.0]).is_none());
        assert!(edge([0.021, 0.0, 0.0], [0.0, 0.011, 0.0]).is_none());
    }

    #[test]
    fn the_height_in_plan_is_that_of_the_plane() {
        let [a, b, c] = [[0.0, 0.0, 0.01], [0.02, 0.0, 0.03], [0.0, 0.01, 0.0]];
        for corners in [[a, b, c], [a, c, b]] {
            let plan = PlanTriangle::of(corners, 0.0).expect("it has an area");
            let height = plan.height_at([0.01, 0.0025]).expect("it is there");
            assert!((height - 0.0175).abs() < 1e-7, "{height}");
            assert!(plan.height_at([0.02, 0.0001]).is_none());
            assert!(PlanTriangle::of(corners, 2.1e-4).is_none());
        }
        let upright = [a, b, [0.01, 0.0, 0.05]];
        assert!(PlanTriangle::of(upright, 0.0).is_none());
    }

    /// As near as any of many places of the triangle.
    #[test]
    fn the_nearest_place_is_nearer_than_any_other() {
        let mut random = Random::new(1);
        let mut point = || core::array::from_fn(|_| random.between(-1.0, 1.0));
        for _ in 0..200 {
            let (place, corners) = (point(), [point(), point(), point()]);
            let square = |weights: [f32; 3]| {
                let away = sub(place, place_of(weights, corners));
                dot(away, away)
            };
            let nearest = nearest_weights(place, corners);
            let sum: f32 = nearest.iter().sum();
            assert!(nearest.iter().all(|weight| *weight >= 0.0) && (sum - 1.0).abs() < 1e-6);
            for i in 0..=20 {
                for j in 0..=20 - i {
                    let [b, c] = [i, j].map(|k| k as f32 / 20.0);
                    assert!(square(nearest) <= square([1.0 - b - c, b, c]) + 1e-6);
                }
            }
        }
    }

    #[test]
    fn nothing_lies_over_one_without_an_area() {
        let triangle = Triangle::of([[0.0; 3], [0.01, 0.0, 0.0], [0.02, 0.0, 0.0]], 1.0);
        assert_eq!(triangle.normal, [0.0; 3]);
        assert!(triangle.weights_over([0.005, 0.0, 0.001]).is_none());
    }
}
