//! Bending of triangles by the discrete shape operator of their three hinges
//! (Grinspun, Gingold, Reisman and Zorin 2006, "Computing discrete shape
//! operators on general meshes", with the normal of an edge midway between those
//! of its two triangles).
//!
//! Midway normals are exact for quadratic surfaces where the two triangles at
//! every edge form a parallelogram. So each cell is cut along both diagonals,
//! into two such triangulations, and bending is the mean of theirs: consistent,
//! and without a preferred diagonal. Unlike the grid's second differences this
//! energy knows angles only, and is not quadratic.

use super::bending::Bending;
use super::hinge::{Angle, angle, second_derivative};
use super::mesh::{Clamps, GHOST, Mesh};
use super::system::System;
use super::vector::{Vector, outer, scale};
use crate::rigidity::Rigidity;

/// The two ways to cut a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Diagonal {
    /// From the foot at the fore-edge to the head at the spine.
    Falling,
    /// From the foot at the spine to the head at the fore-edge.
    Rising,
}

/// Nodes of an edge and of the apexes on its left and right.
type Hinge = [usize; 4];

/// A right triangle: its hinges over the leg along v, the leg along u and the
/// diagonal, and the stiffness that couples them.
#[derive(Clone, Debug)]
struct Triangle {
    hinges: [Option<usize>; 3],
    /// Energy is half of the angles' product with this.
    stiffness: [[f64; 3]; 3],
}

/// The bending energy of a leaf of triangles.
#[derive(Clone, Debug)]
pub(super) struct TriangleBending {
    mesh: Mesh,
    hinges: Vec<Hinge>,
    triangles: Vec<Triangle>,
    /// Ratio of damping to stiffness, and the angles from which damping pulls.
    damping: f64,
    damped: Vec<f64>,
}

impl TriangleBending {
    pub fn new(mesh: &Mesh, rigidity: &Rigidity, clamps: &Clamps) -> Self {
        let mut bending = Self {
            mesh: *mesh,
            hinges: Vec::new(),
            triangles: Vec::new(),
            damping: 0.0,
            damped: Vec::new(),
        };
        for diagonal in [Diagonal::Falling, Diagonal::Rising] {
            bending.triangulate(diagonal, rigidity, clamps);
        }
        bending.damped = vec![0.0; bending.hinges.len()];
        bending
    }

    fn triangulate(&mut self, diagonal: Diagonal, rigidity: &Rigidity, clamps: &Clamps) {
        let mesh = self.mesh;
        let mut legs_v = vec![None; mesh.nodes()];
        let mut legs_u = vec![None; mesh.nodes()];
        let mut add = |hinge: Option<Hinge>| {
            hinge.map(|hinge| {
                self.hinges.push(hinge);
                self.hinges.len() - 1
            })
        };
        for (column, row) in mesh.places() {
            let here = mesh.node(column, row);
            legs_v[here] = add(leg_along_v(&mesh, diagonal, clamps, column, row));
            legs_u[here] = add(leg_along_u(&mesh, diagonal, column, row));
        }
        let weights = clamps.end_weights(&mesh);
        for (column, row) in mesh.cells() {
            let across = add(Some(across(&mesh, diagonal, column, row)));
            for upper in [false, true] {
                // The corner of the right angle.
                let right = upper == (diagonal == Diagonal::Falling);
                let (column_v, row_u) = (column + usize::from(right), row + usize::from(upper));
                let leg_v = legs_v[mesh.node(column_v, row)];
                let leg_u = legs_u[mesh.node(column, row_u)];
                let weighted = Rigidity {
                    d11: weights[column_v] * rigidity.d11,
                    ..*rigidity
                };
                let clamped = clamps.hold(column_v, &mesh);
                let shape = shape_operator(&mesh, diagonal, clamped);
                let free = [leg_v.is_none(), leg_u.is_none()];
                self.triangles.push(Triangle {
                    hinges: [leg_v, leg_u, across],
                    stiffness: stiffness(&mesh, &plate(&weighted, free), &shape),
                });
            }
        }
    }

    fn vertices(&self, hinge: &Hinge, x: &[Vector], clamps: &Clamps) -> [Vector; 4] {
        let apex_edge = [hinge[0], hinge[0], hinge[0], hinge[1]];
        core::array::from_fn(|i| clamps.place(hinge[i], apex_edge[i], &self.mesh, x))
    }

    fn angles(&self, x: &[Vector], clamps: &Clamps) -> Vec<Angle> {
        let of = |hinge| angle(&self.vertices(hinge, x, clamps));
        self.hinges.iter().map(of).collect()
    }

    /// Angle of a hinge of a triangle and its change since the start of the step.
    fn bent(&self, hinge: Option<usize>, angles: &[Angle]) -> (f64, f64) {
        hinge.map_or((0.0, 0.0), |h| {
            let value = angles[h].value;
            (value, value - self.damped[h])
        })
    }

    /// Adds what the angles' first derivatives give, and sums up the moment over
    /// each hinge.
    fn add_angles(&self, angles: &[Angle], system: &mut System) -> Vec<f64> {
        let mut moments = vec![0.0; self.hinges.len()];
        for triangle in &self.triangles {
            let bent = triangle.hinges.map(|hinge| self.bent(hinge, angles));
            for (i, first) in triangle.hinges.iter().enumerate() {
                let Some(first) = *first else { continue };
                for (j, second) in triangle.hinges.iter().enumerate() {
                    let Some(second) = *second else { continue };
                    let k = triangle.stiffness[i][j];
                    moments[first] += k * (bent[j].0 + self.damping * bent[j].1);
                    let stiffness = k * (1.0 + self.damping);
                    self.couple(stiffness, first, second, angles, system);
                }
            }
        }
        moments
    }

    fn couple(
        &self,
        stiffness: f64,
        first: usize,
        second: usize,
        angles: &[Angle],
        system: &mut System,
    ) {
        for (a, slope) in self.hinges[first].iter().zip(&angles[first].gradient) {
            for (b, other) in self.hinges[second].iter().zip(&angles[second].gradient) {
                if *a != GHOST && *b != GHOST && system.wants(*a, *b) {
                    system.add_block(*a, *b, outer(stiffness, *slope, *other));
                }
            }
        }
    }
}

impl Bending for TriangleBending {
    fn energy(&self, x: &[Vector], clamps: &Clamps) -> f64 {
        let angles = self.angles(x, clamps);
        let mut energy = 0.0;
        for triangle in &self.triangles {
            let bent = triangle.hinges.map(|hinge| self.bent(hinge, &angles));
            for i in 0..3 {
                for j in 0..3 {
                    let products = bent[i].0 * bent[j].0 + self.damping * bent[i].1 * bent[j].1;
                    energy += 0.5 * triangle.stiffness[i][j] * products;
                }
            }
        }
        energy
    }

    fn add_to(&self, x: &[Vector], clamps: &Clamps, exact: bool, system: &mut System) {
        let angles = self.angles(x, clamps);
        let moments = self.add_angles(&angles, system);
        for ((hinge, angle), &moment) in self.hinges.iter().zip(&angles).zip(&moments) {
            for (&node, &slope) in hinge.iter().zip(&angle.gradient) {
                if node != GHOST {
                    system.add_gradient(node, scale(moment, slope));
                }
            }
            if exact {
                second_derivative(&self.vertices(hinge, x, clamps), |i, j, block| {
                    let (a, b) = (hinge[i], hinge[j]);
                    if a != GHOST && b != GHOST && system.wants(a, b) {
                        system.add_block(a, b, block.map(|row| scale(moment, row)));
                    }
                });
            }
        }
    }

    fn damp(&mut self, ratio: f64, from: &[Vector], clamps: &Clamps) {
        self.damping = ratio;
        let angles = self.angles(from, clamps);
        self.damped = angles.iter().map(|angle| angle.value).collect();
    }
}

/// Hinge over the edge from a node to the one above it; at a clamped edge
/// against the clamp, at a free edge none.
fn leg_along_v(
    mesh: &Mesh,
    diagonal: Diagonal,
    clamps: &Clamps,
    column: usize,
    row: usize,
) -> Option<Hinge> {
    let outer = column == 0 || column + 1 == mesh.columns;
    if row + 1 == mesh.rows || (outer && !clamps.hold(column, mesh)) {
        return None;
    }
    let here = mesh.node(column, row);
    let above = here + mesh.columns;
    let falling = diagonal == Diagonal::Falling;
    let left = if falling { above } else { here };
    let right = if falling { here } else { above };
    let left = if column == 0 { GHOST } else { left - 1 };
    let last = column + 1 == mesh.columns;
    let right = if last { GHOST } else { right + 1 };
    Some([here, above, left, right])
}

/// Hinge over the edge from a node to the next towards the fore-edge; none at
/// the foot and the head.
fn leg_along_u(mesh: &Mesh, diagonal: Diagonal, column: usize, row: usize) -> Option<Hinge> {
    if column + 1 == mesh.columns || row == 0 || row + 1 == mesh.rows {
        return None;
    }
    let here = mesh.node(column, row);
    let next = here + 1;
    Some(match diagonal {
        Diagonal::Falling => [here, next, here + mesh.columns, next - mesh.columns],
        Diagonal::Rising => [here, next, next + mesh.columns, here - mesh.columns],
    })
}

/// Hinge over the diagonal of a cell.
fn across(mesh: &Mesh, diagonal: Diagonal, column: usize, row: usize) -> Hinge {
    let foot = mesh.node(column, row);
    let head = foot + mesh.columns;
    match diagonal {
        Diagonal::Falling => [foot + 1, head, foot, head + 1],
        Diagonal::Rising => [foot, head + 1, head, foot + 1],
    }
}

/// Curvatures (along u, along v, twice the twist) of a triangle by the angles of
/// its three hinges. Half of an angle belongs to a triangle, against a clamp all.
fn shape_operator(mesh: &Mesh, diagonal: Diagonal, clamped: bool) -> [[f64; 3]; 3] {
    let (du, dv) = (mesh.du, mesh.dv);
    let long = du * du + dv * dv;
    let sign = match diagonal {
        Diagonal::Falling => 1.0,
        Diagonal::Rising => -1.0,
    };
    let leg_v = if clamped { 2.0 / du } else { 1.0 / du };
    let scale = long.sqrt() / (du * dv) / long;
    [
        [leg_v, 0.0, 0.0],
        [0.0, 1.0 / dv, 0.0],
        [
            scale * dv * dv,
            scale * du * du,
            scale * 2.0 * sign * du * dv,
        ],
    ]
}

/// Moments by curvatures, where those across free edges are left to themselves.
fn plate(rigidity: &Rigidity, free: [bool; 2]) -> [[f64; 3]; 3] {
    let Rigidity { d11, d22, d12, d66 } = *rigidity;
    let (uu, vv, uv) = match free {
        [false, false] => (d11, d22, d12),
        [true, false] => (0.0, d22 - d12 * d12 / d11, 0.0),
        [false, true] => (d11 - d12 * d12 / d22, 0.0, 0.0),
        [true, true] => (0.0, 0.0, 0.0),
    };
    [[uu, uv, 0.0], [uv, vv, 0.0], [0.0, 0.0, d66]]
}

/// Stiffness between angles: that of the plate, over the triangle's area, half
/// of it as every cell is cut twice.
fn stiffness(mesh: &Mesh, plate: &[[f64; 3]; 3], shape: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let area = mesh.du * mesh.dv / 4.0;
    let mut stiffness = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            for a in 0..3 {
                for b in 0..3 {
                    stiffness[i][j] += area * shape[i][a] * plate[a][b] * shape[j][b];
                }
            }
        }
    }
    stiffness
}
