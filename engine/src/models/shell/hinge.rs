//! The angle between two triangles that share an edge, with its first and
//! second derivatives (as in Tamstorf and Grinspun 2013, "Discrete bending
//! forces and their Jacobians", arranged by triangles).

use super::vector::{Block, Vector, advance, cross, difference, dot, length, outer, scale};

/// An angle and its derivatives by the places of the edge's two ends and of the
/// apexes on its left and on its right.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Angle {
    /// Positive where the surface bulges towards its normals, radians.
    pub value: f64,
    /// Its derivatives by the places of the four vertices, rad/m.
    pub gradient: [Vector; 4],
}

/// The angle over the edge from `x[0]` to `x[1]`, with the apex `x[2]` on the
/// left and `x[3]` on the right, seen from where the normals point.
pub(super) fn angle(x: &[Vector; 4]) -> Angle {
    let edge = difference(x[1], x[0]);
    let left = cross(edge, difference(x[2], x[0]));
    let right = cross(difference(x[3], x[0]), edge);
    let sine = dot(cross(left, right), edge) / length(edge);
    let value = libm::atan2(sine, dot(left, right));
    let mut gradient = [[0.0; 3]; 4];
    for (apex, sign) in [(2, 1.0), (3, -1.0)] {
        let side = Side::new(x, apex);
        let slope = scale(sign, side.slope);
        for (vertex, weight) in side.weights(apex) {
            for axis in 0..3 {
                gradient[vertex][axis] += weight * slope[axis];
            }
        }
    }
    Angle { value, gradient }
}

/// Calls `add(i, j, block)` with parts of the second derivative of the angle by
/// the places of vertices i and j, over all ordered pairs. Only their sum is
/// symmetric.
pub(super) fn second_derivative(x: &[Vector; 4], mut add: impl FnMut(usize, usize, Block)) {
    for (apex, sign) in [(2, 1.0), (3, -1.0)] {
        let side = Side::new(x, apex);
        let (of_slope, of_foot) = side.derivatives();
        let by_vertex = [
            (0, of_slope[0], of_foot[0]),
            (1, of_slope[1], of_foot[1]),
            (apex, of_slope[2], of_foot[2]),
        ];
        for (i, weight) in side.weights(apex) {
            // Weights are foot - 1, -foot and 1.
            let turn = [1.0, -1.0, 0.0][i.min(2)];
            for (j, slope, foot) in by_vertex {
                let mut block = outer(sign * turn, side.slope, foot);
                for row in 0..3 {
                    for column in 0..3 {
                        block[row][column] += sign * weight * slope[row][column];
                    }
                }
                add(i, j, block);
            }
        }
    }
}

/// One triangle of a hinge.
struct Side {
    edge: Vector,
    /// From the start of the edge to the apex.
    arm: Vector,
    /// Across the triangle, as long as twice its area.
    normal: Vector,
    /// Where the apex stands over the edge: 0 its start, 1 its end.
    foot: f64,
    /// Derivative of the angle by the place of the apex.
    slope: Vector,
}

impl Side {
    fn new(x: &[Vector; 4], apex: usize) -> Self {
        let edge = difference(x[1], x[0]);
        let arm = difference(x[apex], x[0]);
        let normal = cross(edge, arm);
        Self {
            edge,
            arm,
            normal,
            foot: dot(arm, edge) / dot(edge, edge),
            slope: scale(-length(edge) / dot(normal, normal), normal),
        }
    }

    /// Derivatives by the edge's ends and the apex, in parts of `slope`: the
    /// angle changes under no translation and no rotation.
    fn weights(&self, apex: usize) -> [(usize, f64); 3] {
        [(0, self.foot - 1.0), (1, -self.foot), (apex, 1.0)]
    }

    /// Derivatives of `slope` and `foot` by start and end of the edge and the apex.
    fn derivatives(&self) -> ([Block; 3], [Vector; 3]) {
        let (e, d, n) = (self.edge, self.arm, self.normal);
        let (ee, nn, long) = (dot(e, e), dot(n, n), length(e));
        let (mut by_edge, mut by_arm) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        for axis in 0..3 {
            let mut unit = [0.0; 3];
            unit[axis] = 1.0;
            let of_normal = |change: Vector| {
                let along = 2.0 * dot(n, change) / nn;
                scale(-long / nn, advance(change, -along, n))
            };
            let edge = of_normal(cross(unit, d));
            let arm = of_normal(cross(e, unit));
            for row in 0..3 {
                by_edge[row][axis] = edge[row] - n[row] / nn * (e[axis] / long);
                by_arm[row][axis] = arm[row];
            }
        }
        let mut by_start = [[0.0; 3]; 3];
        for row in 0..3 {
            for axis in 0..3 {
                by_start[row][axis] = -by_edge[row][axis] - by_arm[row][axis];
            }
        }
        let foot_edge = advance(scale(1.0 / ee, d), -2.0 * self.foot / ee, e);
        let foot_arm = scale(1.0 / ee, e);
        let foot_start = advance(scale(-1.0, foot_edge), -1.0, foot_arm);
        (
            [by_start, by_edge, by_arm],
            [foot_start, foot_edge, foot_arm],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::for_seeds;

    #[test]
    fn derivatives_are_those_of_differences() {
        for_seeds(|random| {
            let mut x = [
                [0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [-1.0, 0.4, 0.0],
                [1.0, 0.7, 0.0],
            ];
            for axis in x.as_flattened_mut() {
                *axis += f64::from(random.between(-0.4, 0.4));
            }
            let mut second = [[[[0.0; 3]; 3]; 4]; 4];
            second_derivative(&x, |i, j, block| {
                for (sum, part) in second[i][j]
                    .as_flattened_mut()
                    .iter_mut()
                    .zip(block.as_flattened())
                {
                    *sum += part;
                }
            });
            let at = |j: usize, b: usize, h: f64| {
                let mut moved = x;
                moved[j][b] += h;
                angle(&moved)
            };
            let h = 1e-5;
            for (j, b) in (0..4).flat_map(|j| (0..3).map(move |b| (j, b))) {
                let (more, less) = (at(j, b, h), at(j, b, -h));
                let slope = (more.value - less.value) / (2.0 * h);
                assert!((slope - angle(&x).gradient[j][b]).abs() < 1e-7, "{j} {b}");
                for (i, a) in (0..4).flat_map(|i| (0..3).map(move |a| (i, a))) {
                    let bend = (more.gradient[i][a] - less.gradient[i][a]) / (2.0 * h);
                    assert!((bend - second[i][j][a][b]).abs() < 1e-6, "{i} {a} {j} {b}");
                }
            }
        });
    }
}
