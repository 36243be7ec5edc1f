//! How the edges of a leaf are held.

use super::mesh::Mesh;
use super::settings::Edge;
use super::vector::{Vector, advance, scale};
use crate::rigidity::Rigidity;

/// Marks the node beyond a clamped edge, which follows from the clamp.
pub(super) const GHOST: usize = usize::MAX;

/// An edge whose nodes are held, and from which the leaf goes on in a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clamp {
    /// Unit direction in which the leaf would go on beyond the edge.
    pub beyond: Vector,
    /// Stiffness of the hinge between clamp and leaf, N; infinite for none.
    hinge: f64,
}

impl Clamp {
    /// The clamp of an edge, None of a free one. `sense` is 1 where rising u
    /// leads beyond the edge, -1 where it leads into the leaf.
    pub fn of(edge: Edge, sense: f64) -> Option<Self> {
        let (angle, hinge) = match edge {
            Edge::Free => return None,
            Edge::Clamped { angle } => (angle, f64::INFINITY),
            Edge::Hinged { angle, stiffness } => (angle, stiffness),
        };
        Some(Self {
            beyond: scale(sense, direction(angle)),
            hinge,
        })
    }

    /// Part of the turn between clamp and leaf that bends the leaf's half cell of
    /// stiffness `half_cell`, N; the hinge takes the rest.
    fn fraction(&self, half_cell: f64) -> f64 {
        1.0 / (1.0 + half_cell / self.hinge)
    }
}

/// The unit direction `angle` radians over the x axis.
pub(super) fn direction(angle: f64) -> Vector {
    [libm::cos(angle), 0.0, libm::sin(angle)]
}

/// The clamps at the spine and at the fore-edge, where there are any.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clamps {
    /// At u = 0; None where that edge is free.
    pub spine: Option<Clamp>,
    /// At u = 1, likewise.
    pub fore_edge: Option<Clamp>,
}

impl Clamps {
    /// Whether the nodes of a column are held by a clamp.
    pub fn hold(&self, column: usize, mesh: &Mesh) -> bool {
        self.at(column, mesh).is_some()
    }

    /// The clamp at a column.
    fn at(&self, column: usize, mesh: &Mesh) -> Option<&Clamp> {
        if column == 0 {
            self.spine.as_ref()
        } else if column + 1 == mesh.columns {
            self.fore_edge.as_ref()
        } else {
            None
        }
    }

    /// Unit direction beyond the clamped edge that a node lies on.
    pub fn beyond(&self, node: usize, mesh: &Mesh) -> Vector {
        let clamp = self.at(node % mesh.columns, mesh);
        clamp.map_or([0.0; 3], |clamp| clamp.beyond)
    }

    /// Place of a node, or where it is a ghost that of the node beyond `edge`.
    pub fn place(&self, node: usize, edge: usize, mesh: &Mesh, x: &[Vector]) -> Vector {
        if node == GHOST {
            advance(x[edge], mesh.du, self.beyond(edge, mesh))
        } else {
            x[node]
        }
    }

    /// The plate as each column sees it. Near a clamp its stiffness is weighted
    /// by one over the weights of Gregory's rule (relative to the trapezoidal
    /// rule's): the turn of a leaf between two places is the integral of moment
    /// over stiffness, and this is a better quadrature of it. A hinge makes the
    /// half cell at the clamp softer.
    pub fn plates(&self, mesh: &Mesh, rigidity: &Rigidity) -> Vec<Rigidity> {
        let mut plates = vec![*rigidity; mesh.columns];
        for (i, weight) in [4.0 / 3.0, 6.0 / 7.0, 24.0 / 23.0].into_iter().enumerate() {
            if self.spine.is_some() {
                plates[i].d11 *= weight;
            }
            if self.fore_edge.is_some() {
                plates[mesh.columns - 1 - i].d11 *= weight;
            }
        }
        for column in [0, mesh.columns - 1] {
            if let Some(clamp) = self.at(column, mesh) {
                let plate = &mut plates[column];
                *plate = plate.behind_hinge(clamp.fraction(2.0 * plate.d11 / mesh.du));
            }
        }
        plates
    }
}
