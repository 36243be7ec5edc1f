//! Where the hinges of a leaf's two triangulations lie.

use super::clamp::{Clamps, GHOST};
use super::mesh::Mesh;

/// The two ways to cut a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Diagonal {
    /// From the foot at the fore-edge to the head at the spine.
    Falling,
    /// From the foot at the spine to the head at the fore-edge.
    Rising,
}

/// Nodes of an edge and of the apexes on its left and right.
pub(super) type Hinge = [usize; 4];

/// Hinge over the edge from a node to the one above it; at a clamped edge
/// against the clamp, at a free edge none.
pub(super) fn leg_along_v(
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
pub(super) fn leg_along_u(
    mesh: &Mesh,
    diagonal: Diagonal,
    column: usize,
    row: usize,
) -> Option<Hinge> {
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
pub(super) fn across(mesh: &Mesh, diagonal: Diagonal, column: usize, row: usize) -> Hinge {
    let foot = mesh.node(column, row);
    let head = foot + mesh.columns;
    match diagonal {
        Diagonal::Falling => [foot + 1, head, foot, head + 1],
        Diagonal::Rising => [foot, head + 1, head, foot + 1],
    }
}

/// Curvatures (along u, along v, twice the twist) of a triangle by the angles of
/// its three hinges. Half of an angle belongs to a triangle, against a clamp all.
pub(super) fn shape_operator(mesh: &Mesh, diagonal: Diagonal, clamped: bool) -> [[f64; 3]; 3] {
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
