//! The angles of a sheet's hinges and their slopes, four hinges at a time.

use crate::lanes::Four;

/// Places of four hinges' vertices: x, y, z of each, in lanes.
type Vertices = [[Four; 3]; 4];

/// Of one hinge the slopes of its angle by the places of its vertices: x, y, z and nothing.
pub(super) type Slopes = [Four; 4];

/// An edge's two ends and the apexes on its left and on its right.
pub(super) type Hinge = [usize; 4];

/// The vertices of four hinges, of places x, y, z and anything each.
#[inline(always)]
fn gather(hinges: &[Hinge; 4], places: &[Four]) -> Vertices {
    core::array::from_fn(|vertex| {
        let [a, b, c, d] = hinges;
        let rows = [a, b, c, d].map(|hinge| places[hinge[vertex]]);
        let [x, y, z, _] = Four::transpose(rows);
        [x, y, z]
    })
}

/// What the angles of four hinges are found by.
struct Arms {
    edge: [Four; 3],
    arms: [[Four; 3]; 2],
    normals: [[Four; 3]; 2],
    length: Four,
    square: Four,
}

impl Arms {
    #[inline(always)]
    fn of(x: &Vertices) -> Self {
        let edge = sub(x[1], x[0]);
        let arms = [sub(x[2], x[0]), sub(x[3], x[0])];
        let square = dot(edge, edge);
        Self {
            edge,
            arms,
            normals: [cross(edge, arms[0]), cross(arms[1], edge)],
            length: square.sqrt(),
            square,
        }
    }

    /// The angles over the edge from the first vertex to the second, with the third on the
    /// left and the fourth on the right, seen from where the normals point: above 0 where the
    /// sheet bulges towards them (as in Tamstorf and Grinspun 2013).
    #[inline(always)]
    fn angles(&self) -> [f32; 4] {
        let [left, right] = self.normals;
        let sine = (dot(cross(left, right), self.edge) / self.length).array();
        let cosine = dot(left, right).array();
        [0, 1, 2, 3].map(|lane| libm::atan2f(sine[lane], cosine[lane]))
    }
}

/// The angles of four hinges, radians.
pub(super) fn angles(hinges: &[Hinge; 4], places: &[Four]) -> [f32; 4] {
    Arms::of(&gather(hinges, places)).angles()
}

/// The angles of four hinges and their slopes, those times `moves` for each vertex.
#[inline(always)]
pub(super) fn measure(
    hinges: &[Hinge; 4],
    places: &[Four],
    moves: &[Four; 4],
    slopes: &mut [Slopes; 4],
) -> [f32; 4] {
    let arms = Arms::of(&gather(hinges, places));
    let one = Four::splat(1.0);
    let nothing = Four::splat(0.0);
    let least = Four::splat(f32::MIN_POSITIVE);
    let by_apex = |side: usize| {
        let normal = arms.normals[side];
        let scale = (nothing - arms.length) / least.greater(dot(normal, normal));
        let foot = dot(arms.arms[side], arms.edge) / arms.square;
        (normal.map(|normal| scale * normal), foot)
    };
    let ((left, left_foot), (right, right_foot)) = (by_apex(0), by_apex(1));
    let (left_start, right_start) = (left_foot - one, right_foot - one);
    let by_axis = |axis: usize| {
        let (left, right) = (left[axis], right[axis]);
        [
            moves[0] * (left_start * left + right_start * right),
            moves[1] * (nothing - (left_foot * left + right_foot * right)),
            moves[2] * left,
            moves[3] * right,
        ]
    };
    let [x, y, z] = [by_axis(0), by_axis(1), by_axis(2)];
    for vertex in 0..4 {
        let rows = Four::transpose([x[vertex], y[vertex], z[vertex], nothing]);
        for (slopes, row) in slopes.iter_mut().zip(rows) {
            slopes[vertex] = row;
        }
    }
    arms.angles()
}

#[inline(always)]
fn sub(a: [Four; 3], b: [Four; 3]) -> [Four; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn dot(a: [Four; 3], b: [Four; 3]) -> Four {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: [Four; 3], b: [Four; 3]) -> [Four; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
