//! Whether what is drawn of a flight, or its paper, goes through others or through itself, and which
//! of them are to be asked.

use super::{CUTTING, Flight, folds};
use crate::book::bend_into_gutter::is_clear;
use crate::book::pile::Pile;
use crate::contact::crossing::{is_fore_edge_past, is_past};
use crate::contact::mesh::Mesh;
use crate::contact::tolerance::{AT_FACET, DEEP, GAP, NOT_UPON, PAST_AT_SPINE};
use crate::contact::work::Work;

/// By how much drawn leaves of a page 0.14 m wide may go through each other and only touch, metres: where
/// a grab has crumpled one, and where they are smooth.
pub type Tolerance = [f32; 2];

/// Work of looking whether the fore-edge of one of two leaves has passed the other, nanoseconds: of
/// 50 points at 200, as separation counts one where a leaf is bent.
const FORE_EDGES: u32 = 10_000;

impl Flight {
    /// Whether it may be drawn through another or through itself.
    pub fn needs_crossing_test(&self) -> bool {
        self.needs_crossing_test
    }

    /// Cuts what is drawn of it, to be looked at for [crossings](Self::is_drawn_through).
    pub fn cut_drawn(&mut self) {
        let folds = folds(self.creased.as_ref(), &self.turned_over);
        self.tiles.cut(Mesh {
            folds,
            ..Mesh::of(&self.surface)
        });
    }

    /// Whether it may reach round others in flight.
    pub fn may_be_crumpled(&self) -> bool {
        self.is_crumpled() || self.is_bent_back || self.held_back
    }

    /// Whether what is drawn of it goes through what is drawn of one on its right, or has
    /// passed its neighbour there; both as they were when they were [cut](Self::cut_drawn)
    /// last.
    pub fn is_drawn_through(
        &self,
        right: &Flight,
        is_neighbour: bool,
        [crumpled, smooth]: Tolerance,
        work: &mut Work,
    ) -> bool {
        let tolerance = if self.is_crumpled() || right.is_crumpled() {
            crumpled
        } else {
            smooth
        };
        let scale = self.scale();
        (is_neighbour && self.is_drawn_past(right))
            || self.tiles.cross(&right.tiles, tolerance * scale, work)
            || (is_neighbour && self.has_fore_edge_past(right, tolerance * scale, work))
    }

    /// Whether the fore-edge of one of what is drawn of it and of its neighbour on its right has passed
    /// the other: at a small angle leaves only graze each other where they cross, and are deep in each
    /// other where they end. Parts of creased ones are [moved](Self::separate_folded) off each other
    /// until they are clear.
    fn has_fore_edge_past(&self, right: &Flight, tolerance: f32, work: &mut Work) -> bool {
        if self.is_creased() || right.is_creased() {
            return false;
        }
        let [own, other] = [&self.surface, &right.surface].map(Mesh::of);
        work.spend(FORE_EDGES);
        let within = [tolerance, NOT_UPON * self.scale()];
        is_fore_edge_past(own, other, 1.0, within) || is_fore_edge_past(other, own, -1.0, within)
    }

    /// Whether what is drawn of it has passed its neighbour on its right at the spine.
    pub fn is_drawn_past(&self, right: &Flight) -> bool {
        let [own, other] = [&self.surface, &right.surface].map(Mesh::of);
        is_past(own, other, PAST_AT_SPINE * self.scale())
    }

    /// Whether it may be drawn through itself.
    pub fn may_be_folded(&self) -> bool {
        // What is held back is turned and moved off others picture after picture.
        self.may_be_folded || self.was_drawn_folded || self.held_back
    }

    /// Whether what is drawn of it goes through itself, as it was when it was
    /// [cut](Self::cut_drawn) last.
    pub fn is_drawn_through_itself(&mut self, work: &mut Work) -> bool {
        // Parts of a creased leaf lie upon each other, and graze where they are cut into facets.
        let apart = if self.is_creased() { -GAP } else { AT_FACET };
        self.tiles.cross_themselves(apart * self.scale(), work)
    }

    /// Whether what is drawn of it lies clear of the piles (right and left).
    pub fn is_clear_of(&self, piles: [&Pile; 2]) -> bool {
        let folds = folds(self.creased.as_ref(), &self.turned_over);
        is_clear(&self.surface.positions, folds, piles)
    }

    /// Says that its paper may be tested: see [`is_through`](Self::is_through).
    pub fn cut(&mut self) {
        self.searching += CUTTING;
        self.tiles.cut(self.leaf.in_book_space().mesh());
    }

    /// Whether its paper goes through that of the one on its right, both as they were
    /// when they were last [cut](Self::cut).
    pub fn is_through(&mut self, right: &Flight) -> bool {
        let deep = DEEP * self.scale();
        let [own, other] = [&*self, right].map(|flight| flight.leaf.in_book_space().mesh());
        let work = &mut Work::new(u32::MAX);
        let is_through = is_past(own, other, deep) || self.tiles.cross(&right.tiles, deep, work);
        self.searching = self.searching.saturating_add(work.done());
        is_through
    }

    /// Says whether it may have come through a neighbour in a tick, and whether it may be
    /// drawn through one.
    pub fn set_may_have_tunnelled(&mut self, may_have_tunnelled: bool, needs_crossing_test: bool) {
        self.may_have_tunnelled = may_have_tunnelled;
        self.needs_crossing_test &= !core::mem::take(&mut self.was_drawn);
        self.needs_crossing_test |= may_have_tunnelled || needs_crossing_test;
        self.was_driven |= needs_crossing_test;
    }

    /// Whether it may have come through a neighbour in the last tick.
    pub fn may_have_tunnelled(&self) -> bool {
        self.may_have_tunnelled
    }
}
