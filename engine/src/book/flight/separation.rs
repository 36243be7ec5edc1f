//! What is drawn of a flight, moved off its own parts, off those next to it and out of the piles.

use super::{Flight, folds};
use crate::book::bend_into_gutter::{Over, push_edges_off, push_off};
use crate::book::leaf::Leaf;
use crate::book::limits::NODES;
use crate::book::phase::Phase;
use crate::book::pile::Pile;
use crate::book::shut_folds::Layers;
use crate::contact::drawn_parts::DrawnParts;
use crate::contact::flap_order::FlapOrder;
use crate::contact::mesh::{Folds, Mesh};
use crate::contact::parted_leaf::{MovedLeaf, Order, PartedLeaf, PlacedBlocks};
use crate::contact::separate::{DrawnLeaf, is_rim, separate};
use crate::contact::separate_folded::{Outcome, push_off_leaf};
use crate::contact::separate_parts::{ROUNDS, Rounds};
use crate::contact::work::Work;
use crate::grid::Side;

impl Flight {
    /// Moves what is drawn of it off the neighbour on a side.
    pub fn separate_from(&mut self, neighbour: &Flight, side: Side, work: &mut Work) {
        self.revision += 1;
        // A leaf lies on the recto's side of the one on its right.
        let (slot, sign) = match side {
            Side::Left => (0, -1.0),
            Side::Right => (1, 1.0),
        };
        let grid = (&self.cells[..], self.surface.rows);
        let scale = self.scale();
        let folds = folds(self.creased.as_ref(), &self.turned_over);
        separate(
            (&mut self.surface, &self.bends, folds),
            &neighbour.drawn(),
            [sign, scale],
            self.full_precision || neighbour.full_precision,
            [
                &probed(&self.leaf, &neighbour.leaf, slot, grid),
                &probed(&neighbour.leaf, &self.leaf, 1 - slot, grid),
            ],
            work,
        );
        self.surface.update_normals();
    }

    /// Moves the rim of what is drawn of it off the flight after its neighbour on a side, which it meets
    /// beyond that neighbour's rim, and itself off the rim of that flight.
    pub fn separate_rim_from(&mut self, after_next: &Flight, side: Side, work: &mut Work) {
        self.revision += 1;
        let scale = self.scale();
        let is_rim = |column: usize, row: usize| is_rim(&after_next.surface, column, row);
        separate(
            (&mut self.surface, &self.bends, Folds::default()),
            &after_next.drawn(),
            [side.sign(), scale],
            self.full_precision || after_next.full_precision,
            [&is_rim; 2],
            work,
        );
        self.surface.update_normals();
    }

    /// What is drawn of it.
    fn drawn(&self) -> DrawnLeaf<'_> {
        DrawnLeaf {
            surface: &self.surface,
            bends: &self.bends,
            folds: folds(self.creased.as_ref(), &self.turned_over),
        }
    }

    /// Pushes what others moved into the piles (right and left) out of them, so far over
    /// each, metres for a page 0.14 m wide.
    pub fn push_off_piles(&mut self, piles: [&Pile; 2], over: [f32; 2], work: &mut Work) {
        self.revision += 1;
        let over = Over::of(over, self.scale());
        self.push_off(piles, over, false);
        self.separate_own_parts(ROUNDS, work);
        self.keep_off_piles(piles, over);
    }

    /// Lifts a packet over the piles (right and left), so far over each, metres for a page 0.14 m wide,
    /// before its layers are moved off each other: what lifts it point by point brings them together, and to
    /// move them apart once others are met takes as much work as these.
    pub(super) fn lift_packet(&mut self, piles: [&Pile; 2], over: [f32; 2]) {
        if self.packet().is_some() {
            self.keep_off_piles(piles, Over::of(over, self.scale()));
        }
    }

    /// Its layers once its folds are shut, as one packet.
    pub(super) fn packet(&self) -> Option<&Layers> {
        packet_of(&self.leaf)
    }

    /// Has the layers of a packet move as one, where its points were moved one by one from `before`.
    fn move_as_one(&mut self, before: &[f32]) {
        if let Some(layers) = packet_of(&self.leaf) {
            let points = self.surface.positions.as_chunks_mut::<3>().0;
            let is_bound = |point: usize| self.parts.is_bound(point);
            layers.move_as_one(points, before.as_chunks::<3>().0, is_bound);
        }
    }

    /// Pushes points and edges out of the piles (right and left), so far over each.
    fn keep_off_piles(&mut self, piles: [&Pile; 2], over: Over) {
        self.push_off(piles, over, !matches!(self.phase(), Phase::Resting(_)));
    }

    /// Pushes points out of the piles (right and left), so far over each, and if true edges; the layers of
    /// a packet move as one.
    fn push_off(&mut self, piles: [&Pile; 2], over: Over, with_edges: bool) {
        let before = self.packet().map(|_| self.surface.positions.clone());
        push_off(&mut self.surface.positions, piles, over);
        if with_edges {
            let folds = folds(self.creased.as_ref(), &self.turned_over);
            push_edges_off(&mut self.surface.positions, folds, piles, over);
        }
        if let Some(before) = before.filter(|before| *before != self.surface.positions) {
            self.move_as_one(&before);
        }
    }

    /// Moves its own parts off each other, in so many rounds at most; once no work is left only
    /// while there were fewer than [`ROUNDS`] since it was to be drawn anew. Returns whether any
    /// were moved in the last.
    pub(super) fn separate_own_parts(&mut self, rounds: usize, work: &mut Work) -> bool {
        if work.is_spent() && self.rounds >= ROUNDS {
            return false;
        }
        self.rounds += rounds;
        let rounds = Rounds {
            scale: self.scale(),
            most: rounds,
            // What lies is as it was when it was looked at after it had landed, and points are enough.
            edges: !matches!(self.phase(), Phase::Resting(_)),
        };
        self.leaf.flaps().is_some_and(|flaps| {
            let surface = &mut self.surface;
            self.parts.separate_flaps(surface, flaps, rounds, work)
        })
    }

    /// Finds the parts of what is drawn of it, to be kept clear of a creased neighbour.
    pub fn find_parts(&mut self) {
        if self.parts.blocks.is_empty() {
            self.parts = DrawnParts::whole(self.surface.columns, self.surface.rows);
        }
    }

    /// Finds how parts of it and of the one on its right lie upon each other as they are drawn.
    pub fn order_flaps(&mut self, right: &mut Flight) {
        let [own, other] = [&*self, right].map(|flight| Mesh {
            folds: folds(flight.creased.as_ref(), &flight.turned_over),
            ..Mesh::of(&flight.surface)
        });
        let order = FlapOrder::of(own, other);
        self.flap_order[1] = order;
        right.flap_order[0] = order.reversed();
    }

    /// Whether parts of it lie upon parts of the neighbour on a side, or under these, as both lie open.
    pub fn lies_open_beside(&self, side: Side) -> bool {
        self.flap_order[usize::from(side == Side::Right)].lie_open()
    }

    /// Moves what is drawn of it out of the piles (right and left), so far over each, its parts
    /// off each other, and all of it off the neighbour on a side, until it is clear of all.
    /// One of the two is creased, and the [parts](Self::find_parts) of both are known.
    pub fn separate_folded(
        &mut self,
        neighbour: Option<(&Flight, Side)>,
        piles: [&Pile; 2],
        over: [f32; 2],
        work: &mut Work,
    ) {
        let scale = self.scale();
        let over = Over::of(over, scale);
        let before = self.surface.positions.clone();
        let mut seen = Vec::new();
        let mut placed = neighbour.map(|(flight, side)| {
            let other = flight.parted(side.opposite());
            PlacedBlocks::of(&other)
        });
        let covered = neighbour.map_or(Vec::new(), |(_, side)| self.covered_on(side).to_vec());
        // A round looks only at what moved since the one before it.
        let (mut is_clear, mut is_covered, mut crosses) = (false, false, false);
        let mut is_resolved = false;
        for _ in 0..ROUNDS {
            self.keep_off_piles(piles, over);
            let are_parts_clear = !self.is_creased() || !self.separate_own_parts(1, work);
            if let (Some((neighbour, side)), Some(placed)) = (neighbour, &mut placed) {
                if work.is_spent() {
                    is_clear = false;
                    break;
                }
                let other = neighbour.parted(side.opposite());
                let (slot, side) = match side {
                    Side::Left => (0, -1.0),
                    Side::Right => (1, 1.0),
                };
                let order = Order {
                    side,
                    scale,
                    parts: self.flap_order[slot],
                };
                let last = self.packet().map(|_| self.surface.positions.clone());
                let mut own = MovedLeaf {
                    points: self.surface.positions.as_chunks_mut::<3>().0,
                    parts: &self.parts,
                    shut: self.shut,
                    covered: &covered,
                    seen: &mut seen,
                };
                let outcome = push_off_leaf(&mut own, &other, placed, order, work);
                crosses |= outcome == Outcome::Crosses;
                is_clear = outcome <= Outcome::Covered;
                is_covered |= outcome == Outcome::Covered;
                if let Some(last) = last.filter(|_| outcome >= Outcome::Moved) {
                    self.move_as_one(&last);
                }
            }
            is_resolved = are_parts_clear && (is_clear || neighbour.is_none());
            if is_resolved {
                break;
            }
        }
        if !is_resolved {
            // What the last round moved may be in a pile, and no pile yields.
            let moved = self.surface.positions.clone();
            self.keep_off_piles(piles, over);
            is_clear &= self.surface.positions == moved;
        }
        if self.surface.positions != before {
            self.revision += 1;
            self.surface.update_normals();
        }
        if let Some((neighbour, side)) = neighbour.filter(|_| is_clear && !is_covered && !crosses) {
            let slot = usize::from(side == Side::Right);
            self.clear_of[slot] = Some([self.revision, neighbour.revision]);
        }
    }

    /// Whether it was found to lie clear of the one on its right as both are to be drawn.
    pub fn is_known_clear_of(&self, right: &Flight) -> bool {
        let [own, other] = [self.revision, right.revision];
        self.clear_of[1] == Some([own, other]) || right.clear_of[0] == Some([other, own])
    }

    /// What is drawn of it, for a leaf on a side of it.
    fn parted(&self, side: Side) -> PartedLeaf<'_> {
        PartedLeaf {
            points: self.surface.positions.as_chunks::<3>().0,
            parts: &self.parts,
            shut: self.shut,
            covered: self.covered_on(side),
        }
    }

    /// The parts of a packet that others cover where a leaf on a side of it lies: that on the right
    /// lies on its verso.
    fn covered_on(&self, side: Side) -> &[u16] {
        let layers = self.packet();
        layers.map_or(&[], |layers| layers.parts_on(side == Side::Right))
    }
}

/// The layers of a leaf whose folds are drawn shut.
fn packet_of(leaf: &Leaf) -> Option<&Layers> {
    let shut = leaf.drawn_shut().filter(|(_, part)| *part == 1.0);
    shut.map(|(layers, _)| layers)
}

/// Says of a drawn point of a leaf, by its column and row, whether it may touch a neighbour,
/// the left (0) or the right (1). Given are the leaf's cells in which its drawn columns lie,
/// and how many rows are drawn.
fn probed<'a>(
    leaf: &'a Leaf,
    neighbour: &Leaf,
    slot: usize,
    (cells, rows): (&'a [usize], usize),
) -> impl Fn(usize, usize) -> bool + use<'a> {
    let both_down = leaf.is_down() && neighbour.is_down();
    move |column, row| {
        let row = row * (NODES[1] - 1) / rows;
        both_down || leaf.in_book_space().is_close(slot, cells[column], row)
    }
}
