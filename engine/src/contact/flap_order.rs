//! Which parts of two neighbours lie upon each other where both leaves lie open.
//!
//! The order of leaves around the spine says on which side of its neighbour a leaf lies, and of what
//! is folded over that is the outer face: pages that are closed upon each other have flaps between
//! them, and each meets the outer face of the other. Where the pages lie open, a flap that reaches
//! over the spine lies with its inner face upon the page there, or upon a flap of that; and of two
//! such flaps one lies upon the other: the one that is farther up, as far as they are over each other.

use super::mesh::Mesh;
use crate::grid::{cells, cut_cell};
use crate::triangle::PlanTriangle;
use crate::vector::{dot, unit};

/// Whether parts of a leaf lie upon those of a neighbour, by whether the part of the one and that of
/// the other is folded over; None where they face each other, and each is on the outer side of the
/// other.
#[derive(Clone, Copy, Debug)]
pub struct FlapOrder([[Option<bool>; 2]; 2]);

impl FlapOrder {
    /// That of parts which all face each other.
    pub const NONE: FlapOrder = FlapOrder([[None; 2]; 2]);

    /// The order of a leaf's parts and those of its neighbour on the right.
    pub fn of(left: Mesh<'_>, right: Mesh<'_>) -> FlapOrder {
        if !left.folds.turn_over() && !right.folds.turn_over() {
            return FlapOrder::NONE;
        }
        // A leaf on the left has its verso up, one on the right its recto.
        let [own, other] = [outer_faces(left, -1.0), outer_faces(right, 1.0)];
        let face_apart = |own: [f32; 3], other: [f32; 3]| dot(own, other) > 0.0;
        FlapOrder([
            [None, face_apart(own[0], other[1]).then_some(false)],
            [
                face_apart(own[1], other[0]).then_some(true),
                face_apart(own[1], other[1])
                    .then(|| {
                        let up = unit([own[1][0] + other[1][0], 0.0, own[1][2] + other[1][2]]);
                        let [left, right] = [left, right].map(|leaf| Flap::of(leaf, up));
                        let over = left.height_over(&right) - right.height_over(&left);
                        (over != 0.0).then_some(over > 0.0)
                    })
                    .flatten(),
            ],
        ])
    }

    /// The same as seen from the neighbour.
    pub fn reversed(self) -> FlapOrder {
        let FlapOrder(upon) = self;
        let reversed = |own: usize, other: usize| upon[other][own].map(|is_upon: bool| !is_upon);
        FlapOrder([0, 1].map(|own| [0, 1].map(|other| reversed(own, other))))
    }

    /// Whether any part lies upon another, or under it.
    pub fn lie_open(self) -> bool {
        self.0.as_flattened().iter().any(Option::is_some)
    }

    /// Whether a part lies under one of the neighbour, each of which may be folded over.
    pub fn is_under(self, own_is_flap: bool, other_is_flap: bool) -> bool {
        self.0[usize::from(own_is_flap)][usize::from(other_is_flap)] == Some(false)
    }
}

/// The mean normals of what is not folded over of a leaf, and of what is, on the recto's side of
/// the leaf (1) or on the verso's (-1).
fn outer_faces(leaf: Mesh<'_>, side: f32) -> [[f32; 3]; 2] {
    let mut sums = [[0.0; 3]; 2];
    for node in 0..leaf.points.len() {
        let normal = leaf.normal(node);
        let sum = &mut sums[usize::from(leaf.is_turned_over(node))];
        *sum = core::array::from_fn(|axis| sum[axis] + side * normal[axis]);
    }
    sums.map(unit)
}

/// What is folded over of a leaf, as seen from where its outer face is up.
struct Flap {
    /// The nodes that are folded over, and the triangles between these and creases: across the
    /// spine, along it, and up.
    nodes: Vec<[f32; 3]>,
    triangles: Vec<PlanTriangle>,
    /// From where to where it reaches across the spine.
    reach: [f32; 2],
}

impl Flap {
    fn of(leaf: Mesh<'_>, up: [f32; 3]) -> Flap {
        let seen = |node: usize| {
            let [x, y, z] = leaf.points[node];
            [x * up[2] - z * up[0], y, x * up[0] + z * up[2]]
        };
        let nodes = (0..leaf.points.len()).filter(|node| leaf.is_turned_over(*node));
        let triangles = cells(leaf.columns, leaf.rows())
            .flat_map(|foot| cut_cell(foot, leaf.columns, leaf.folds.is_falling(foot)))
            .filter(|corners| corners.iter().any(|node| leaf.is_turned_over(*node)))
            .filter_map(|corners| PlanTriangle::of(corners.map(seen), 0.0))
            .collect();
        let nodes: Vec<_> = nodes.map(seen).collect();
        let reach = nodes
            .iter()
            .fold([f32::MAX, f32::MIN], |[low, high], node| {
                [low.min(node[0]), high.max(node[0])]
            });
        Flap {
            nodes,
            triangles,
            reach,
        }
    }

    /// The sum of the heights of its nodes over the triangles of another, metres.
    fn height_over(&self, other: &Flap) -> f32 {
        let [low, high] = other.reach;
        let near = { self.nodes.iter() }.filter(|[x, ..]| (low..=high).contains(x));
        let heights = near.flat_map(|node| {
            let triangles = other.triangles.iter();
            triangles.filter_map(|triangle| Some(node[2] - triangle.height_at([node[0], node[1]])?))
        });
        heights.sum()
    }
}
