//! One leaf in flight: its leaf of paper, and what is drawn of it.

use super::block::Pile;
use super::leaf::{Leaf, NODES, Phase};
use super::mesh::Mesh;
use super::seat::{lift, lift_edges, seat};
use crate::grid::Side;
use crate::surface::Surface;

/// Distance at which two drawn leaves lie upon each other, metres: seen as none,
/// and enough for the depth buffer.
const SLIVER: f32 = 5e-5;

/// What overlaps by more than this, metres, was not lying upon the other there.
const DEEPEST: f32 = 0.02;

/// One leaf in flight; it may stand for several.
#[derive(Clone)]
pub struct Flight {
    id: u32,
    low: u32,
    high: u32,
    leaf: Leaf,
    surface: Surface,
    /// For each column of the surface the leaf's cell that it lies in.
    cells: Vec<usize>,
}

impl Flight {
    /// A flight of a leaf, drawn at the columns `u` and at `rows` rows.
    pub fn new(leaf: Leaf, u: &[f32], rows: usize) -> Flight {
        let last = NODES[0] - 2;
        let cell = |u: &f32| ((u * (last + 1) as f32) as usize).min(last);
        Flight {
            id: 0,
            low: 0,
            high: 0,
            leaf,
            surface: Surface::new(u.len(), rows),
            cells: u.iter().map(cell).collect(),
        }
    }

    /// Begins at rest on side `from`: `low` leaves lie left of it, `high` with it.
    pub fn take_up(&mut self, id: u32, from: Side, low: u32, high: u32) {
        (self.id, self.low, self.high) = (id, low, high);
        self.leaf.lay(from);
    }

    /// Its number.
    pub fn id(&self) -> u32 {
        self.id
    }

    /// Leaves on the left of the book when it lies on the left.
    pub fn high(&self) -> u32 {
        self.high
    }

    /// Leaves of paper that it stands for.
    pub fn leaves(&self) -> u32 {
        self.high - self.low
    }

    /// What it is doing.
    pub fn phase(&self) -> Phase {
        self.leaf.phase()
    }

    /// The leaves that it stands for, by how far it has turned.
    pub fn leaves_turned(&self) -> f32 {
        self.leaf.share_turned() * self.leaves() as f32
    }

    /// What is drawn of it.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Draws the leaf as it is now, between the piles (right and left).
    pub fn draw(&mut self, [right, left]: [&Pile; 2]) {
        self.leaf.write_surface(&mut self.surface);
        seat(&mut self.surface.positions, right, left);
        self.surface.update_normals();
    }

    /// Lifts what is drawn of it off the neighbour on a side, where the coarser
    /// leaves that meet in the engine leave a sliver of overlap.
    pub fn clear_of(&mut self, neighbour: &Flight, side: Side) {
        let slot = if side == Side::Left { 0 } else { 1 };
        // A leaf lies on the recto's side of the one on its right.
        let sign = if side == Side::Left { -1.0 } else { 1.0 };
        let mesh = Mesh {
            columns: neighbour.surface.columns,
            points: neighbour.surface.positions.as_chunks::<3>().0,
            normals: neighbour.surface.normals.as_chunks::<3>().0,
        };
        let both_down = self.leaf.is_down() && neighbour.leaf.is_down();
        let points = self.surface.positions.as_chunks_mut::<3>().0;
        for (node, point) in points.iter_mut().enumerate() {
            let (column, row) = (node % mesh.columns, node / mesh.columns);
            let cell = self.cells[column];
            let row = row * (NODES[1] - 1) / self.surface.rows;
            if column == 0 || !(both_down || self.leaf.seated().is_close(slot, cell, row)) {
                continue;
            }
            if let Some(near) = mesh.near_drawn(*point, node) {
                let lack = SLIVER - sign * near.height;
                if lack > 0.0 && (lack < DEEPEST || both_down) {
                    for axis in 0..3 {
                        point[axis] += sign * lack * near.normal[axis];
                    }
                }
            }
        }
        self.surface.update_normals();
    }

    /// Lifts what others pushed into the piles (right and left) out of them, and
    /// says that what is drawn has changed.
    pub fn finish(&mut self, [right, left]: [&Pile; 2]) {
        lift(&mut self.surface.positions, right, left);
        if !self.leaf.is_down() {
            lift_edges(&mut self.surface.positions, right, left);
        }
        self.surface.touch();
    }

    /// Its leaf, to be held, played and stepped.
    pub fn leaf_mut(&mut self) -> &mut Leaf {
        &mut self.leaf
    }

    /// Its leaf.
    pub fn leaf(&self) -> &Leaf {
        &self.leaf
    }
}
