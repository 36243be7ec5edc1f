//! A leaf as others meet it: a grid of points with normals, and the nearest
//! place on it.

/// Points of a leaf in book space, row by row from the foot.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    pub columns: usize,
    pub points: &'a [[f32; 3]],
    /// Unit normals, to the side of the recto.
    pub normals: &'a [[f32; 3]],
}

/// What lies next to a point on a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    /// The nearest node.
    pub node: usize,
    /// How far the point is from the surface, to the side of the recto, metres.
    pub height: f32,
    /// The surface's normal there.
    pub normal: [f32; 3],
}

/// How far beyond an edge, in cells, a point is still above the mesh.
const OVERHANG: f32 = 1.0;

/// Most steps of the walk to the nearest node. Contacts move by less than a
/// cell from one tick to the next, so nearly all walks are of one step.
const WALK: usize = 64;

impl Mesh<'_> {
    fn rows(&self) -> usize {
        self.points.len() / self.columns
    }

    /// Tangents at a node, a cell long along u and along v.
    fn tangents(&self, node: usize) -> [[f32; 3]; 2] {
        tangents(self.points, self.columns, node)
    }

    /// Walks from node `start` to the node nearest to a point.
    pub fn nearest_node(&self, point: [f32; 3], start: usize) -> usize {
        let away = |node: usize| {
            let d = sub(point, self.points[node]);
            dot(d, d)
        };
        let (mut here, mut least) = (start, away(start));
        for _ in 0..WALK {
            let (column, row) = (here % self.columns, here / self.columns);
            let mut best = here;
            for row in row.saturating_sub(1)..(row + 2).min(self.rows()) {
                for column in column.saturating_sub(1)..(column + 2).min(self.columns) {
                    let node = row * self.columns + column;
                    let d = away(node);
                    if d < least {
                        (best, least) = (node, d);
                    }
                }
            }
            if best == here {
                break;
            }
            here = best;
        }
        here
    }

    /// The surface next to a point, sought from node `start`; None where the
    /// point lies beside the mesh rather than over or under it.
    ///
    /// Between nodes the surface is that whose normals run evenly from one to
    /// the next, which is right to third order in the size of a cell.
    pub fn near(&self, point: [f32; 3], start: usize) -> Option<Near> {
        let node = self.nearest_node(point, start);
        let away = sub(point, self.points[node]);
        let [u, v] = self.tangents(node);
        let (column, row) = (node % self.columns, node / self.columns);
        let a = dot(away, u) / dot(u, u).max(1e-12);
        let b = dot(away, v) / dot(v, v).max(1e-12);
        let beyond = |at: f32, i: usize, count: usize| {
            (i == 0 && at < -OVERHANG) || (i + 1 == count && at > OVERHANG)
        };
        if beyond(a, column, self.columns) || beyond(b, row, self.rows()) {
            return None;
        }
        let own = self.normals[node];
        let toward = |at: f32, i: usize, count: usize, step: usize| {
            let other = if at > 0.0 && i + 1 < count {
                node + step
            } else if at < 0.0 && i > 0 {
                node - step
            } else {
                node
            };
            let part = at.abs().min(1.0);
            sub(self.normals[other], own).map(|d| part * d)
        };
        let (du, dv) = (
            toward(a, column, self.columns, 1),
            toward(b, row, self.rows(), self.columns),
        );
        let halfway: [f32; 3] = core::array::from_fn(|i| own[i] + 0.5 * (du[i] + dv[i]));
        let there: [f32; 3] = core::array::from_fn(|i| own[i] + du[i] + dv[i]);
        Some(Near {
            node,
            height: dot(away, unit(halfway)),
            normal: unit(there),
        })
    }

    /// As [`near`](Self::near) over the mesh as it is drawn: flat facets between
    /// the points.
    pub fn near_drawn(&self, point: [f32; 3], start: usize) -> Option<Near> {
        let near = self.near(point, start)?;
        let (column, row) = (near.node % self.columns, near.node / self.columns);
        let away = sub(point, self.points[near.node]);
        let [u, v] = self.tangents(near.node);
        let toward = |along: [f32; 3], at: usize, count: usize, step: usize| {
            if (dot(away, along) > 0.0 && at + 1 < count) || at == 0 {
                (near.node + step, 1.0)
            } else {
                (near.node - step, -1.0)
            }
        };
        let (beside, a) = toward(u, column, self.columns, 1);
        let (above, b) = toward(v, row, self.rows(), self.columns);
        let [u, v] = [beside, above].map(|node| sub(self.points[node], self.points[near.node]));
        let normal = unit(cross(u, v)).map(|n| a * b * n);
        Some(Near {
            height: dot(away, normal),
            normal,
            ..near
        })
    }
}

/// Tangents at a node of a grid, a cell long along u and along v.
fn tangents(points: &[[f32; 3]], columns: usize, node: usize) -> [[f32; 3]; 2] {
    let (column, row, rows) = (node % columns, node / columns, points.len() / columns);
    let along = |at: usize, count: usize, step: usize| {
        let (before, after) = (usize::from(at > 0), usize::from(at + 1 < count));
        let d = sub(points[node + after * step], points[node - before * step]);
        let inverse = 1.0 / (before + after) as f32;
        d.map(|d| d * inverse)
    };
    [along(column, columns, 1), along(row, rows, columns)]
}

/// Computes the normals of a grid of points by central differences; where they
/// vanish, the former normal stays.
pub fn update_normals(points: &[[f32; 3]], columns: usize, normals: &mut [[f32; 3]]) {
    for (node, normal) in normals.iter_mut().enumerate() {
        let [u, v] = tangents(points, columns, node);
        let n = cross(u, v);
        let length = dot(n, n).sqrt();
        if length > 1e-12 {
            *normal = n.map(|n| n / length);
        }
    }
}

pub fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn sub(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn unit(a: [f32; 3]) -> [f32; 3] {
    let inverse = 1.0 / dot(a, a).sqrt().max(1e-12);
    a.map(|a| a * inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mesh rolled about an axis along v with a radius, cells of 10 mm.
    fn rolled(radius: f32) -> [Vec<[f32; 3]>; 2] {
        let place = |node: usize| {
            let (u, v) = ((node % 10) as f32 * 0.01, (node / 10) as f32 * 0.01);
            let (sin, cos) = libm::sincosf(u / radius);
            [radius * sin, v, radius * (1.0 - cos)]
        };
        let points: Vec<_> = (0..80).map(place).collect();
        let mut normals = vec![[0.0; 3]; 80];
        update_normals(&points, 10, &mut normals);
        [points, normals]
    }

    fn mesh([points, normals]: &[Vec<[f32; 3]>; 2]) -> Mesh<'_> {
        Mesh {
            columns: 10,
            points,
            normals,
        }
    }

    #[test]
    fn heights_over_a_roll_are_those_over_its_cylinder() {
        let radius = 0.06;
        let rolled = rolled(radius);
        let mesh = mesh(&rolled);
        for (u, height) in [(0.033f32, 0.004), (0.047, -0.003), (0.052, 0.0)] {
            let (sin, cos) = libm::sincosf(u / radius);
            // To the side of the recto is toward the axis.
            let r = radius - height;
            let point = [r * sin, 0.036, radius - r * cos];
            let near = mesh.near(point, 0).unwrap();
            assert!(
                (near.height - height).abs() < 1.5e-4,
                "{near:?} for {height}"
            );
            assert!((near.normal[0] + sin).abs() < 0.02);
            // Facets cut inside the arc by cell^2 / 8 radius at most.
            let drawn = mesh.near_drawn(point, 0).unwrap();
            assert!((drawn.height - near.height).abs() < 3e-4, "{drawn:?}");
            assert!(dot(drawn.normal, near.normal) > 0.99);
        }
    }

    #[test]
    fn beside_a_mesh_there_is_nothing() {
        let rolled = rolled(10.0);
        let mesh = mesh(&rolled);
        assert!(mesh.near([0.12, 0.03, 0.001], 0).is_none());
        assert!(mesh.near([0.05, -0.02, 0.001], 0).is_none());
        assert!(mesh.near([0.05, 0.03, 0.001], 79).is_some());
    }
}
