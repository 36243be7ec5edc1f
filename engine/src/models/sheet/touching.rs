//! Parts of one sheet that lie upon each other.
//!
//! A node of one part that comes too near to a triangle of another is kept off it between the
//! sweeps that restore lengths: both move, each by how much of the two is in the way and weighs
//! (position based dynamics: Müller et al. 2007), so that no part gains speed by it. As half-spaces
//! in the solve, one for each side from where the other was to be, they threw folded flaps open.

use super::lane_nodes::LaneNodes;
use crate::triangle::{BESIDE, Triangle};

/// A node of one part of a sheet over a triangle of another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touching {
    /// Number of the node.
    pub node: usize,
    /// Numbers of the triangle's nodes.
    pub under: [usize; 3],
    /// Which corners of the triangle are on creases: parts are joined there, and keep the less
    /// distance the nearer, on the crease none.
    pub is_joined: [bool; 3],
    /// The side of the triangle on which the node lies, 1 for that of its normal or -1.
    pub side: f32,
    /// Distance that they keep, metres.
    pub distance: f32,
    /// How much of what they are too near is left as it is, metres.
    pub left: f32,
}

impl Touching {
    /// The triangle, seen from the side on which the node lies; `place` is that of a node.
    fn triangle(&self, place: impl Fn(usize) -> [f32; 3]) -> Triangle {
        Triangle::of(self.under.map(place), self.side)
    }

    /// How high the node is over the triangle, and how far from where the two would touch, metres,
    /// apart from what is left; None where it is beside the triangle, or next to the crease that
    /// joins them. `place` is that of a node.
    pub fn height_and_gap(&self, place: impl Fn(usize) -> [f32; 3] + Copy) -> Option<[f32; 2]> {
        let (triangle, node) = (self.triangle(place), place(self.node));
        let gap = self.gap(&triangle, node, triangle.weights(node))?;
        Some([triangle.height(node), gap])
    }

    fn gap(&self, triangle: &Triangle, node: [f32; 3], weights: [f32; 3]) -> Option<f32> {
        let joined = weights.iter().zip(self.is_joined).filter(|(_, is)| *is);
        let joined: f32 = joined.map(|(weight, _)| *weight).sum();
        let is_over = weights.iter().all(|weight| *weight > -BESIDE);
        // The end of a part that reaches as far as the fold that it lies in is over both sides of it.
        (is_over && joined < 1.0 - BESIDE).then(|| {
            triangle.height(node) - self.distance * (1.0 - joined).clamp(0.0, 1.0) + self.left
        })
    }

    /// Moves the node and the triangle off each other, at most so far, metres. Returns how much too
    /// near they were, metres.
    pub(super) fn restore(&self, nodes: &mut LaneNodes, mobility: &[f32], at_most: f32) -> f32 {
        let triangle = self.triangle(|at| nodes.get(at));
        let node = nodes.get(self.node);
        let weights = triangle.weights(node);
        let gap = self.gap(&triangle, node, weights);
        let Some(gap) = gap.filter(|gap| *gap < 0.0) else {
            return 0.0;
        };
        let mut mobile = mobility[self.node];
        for (at, weight) in self.under.iter().zip(weights) {
            mobile += weight * weight * mobility[*at];
        }
        if mobile > 0.0 {
            let way = (-gap).min(at_most) / mobile;
            nodes.shift(self.node, way * mobility[self.node], triangle.normal);
            for (at, weight) in self.under.iter().zip(weights) {
                nodes.shift(*at, -(way * weight * mobility[*at]), triangle.normal);
            }
        }
        -gap
    }
}
