//! A flight whose paper goes through itself: found out after a tick, taken back, or opened anew.

use super::{CUTTING, Flight, MOVING, folds};
use crate::book::gutter::Gutter;
use crate::book::phase::Phase;
use crate::contact::mesh::Mesh;
use crate::contact::separate_parts::{ROUNDS, Rounds};
use crate::contact::tolerance::{AT_FACET, DEEP, GAP};
use crate::contact::work::Work;

impl Flight {
    /// Takes back what a tick did to it where its paper would be drawn through itself after
    /// it, and would not have been before; of a creased one that a grab holds, where its paper goes
    /// through itself deeper than contact between its parts brings out again. Whole leaves that no
    /// grab has crumpled and that are not curled are not looked at, and creased ones that no grab
    /// holds neither: contact moves their parts, which taken back in a turn stay caught.
    pub fn keep_from_itself(&mut self, gutter: &Gutter, deepest: f32) {
        let was_through = core::mem::take(&mut self.was_through);
        let may_be_folded = if self.leaf.is_creased() {
            self.leaf.phase() == Phase::Held
        } else {
            self.leaf.was_held() || self.leaf.in_book_space().is_curled()
        };
        if !may_be_folded {
            return;
        }
        self.was_through = self.is_paper_through_itself();
        if self.was_through && !was_through {
            self.leaf.step_back(gutter, deepest);
            self.was_through = self.is_paper_through_itself();
        }
    }

    /// Has a creased leaf that has landed in this tick open its folds anew, from pressed flat, where
    /// it would be drawn through itself: no paper can come to lie so, and contact between its parts
    /// does not bring it out any more.
    pub fn open_where_through_itself(&mut self) {
        if !self.is_creased() || !self.leaf.has_landed() || self.leaf.is_held_shut() {
            return;
        }
        let work = &mut Work::new(u32::MAX);
        self.cut_spare(work);
        if self.crosses_itself(-GAP, work) {
            self.leaf.open_anew();
        }
    }

    fn is_paper_through_itself(&mut self) -> bool {
        let work = &mut Work::new(u32::MAX);
        if !self.leaf.is_creased() {
            self.cut_spare(work);
            return self.crosses_itself(AT_FACET, work);
        }
        work.spend(CUTTING);
        // Over the flat table: what is put back is there as it was, whatever the gutter did.
        let points = self.leaf.sheet().positions().as_chunks::<3>().0;
        self.tiles.cut(Mesh {
            points,
            ..self.leaf.in_book_space().mesh()
        });
        // Parts that lie upon each other are drawn apart, to the side to which they are folded.
        self.crosses_itself(-DEEP, work)
    }

    /// Cuts its paper as it would be drawn over the flat table, its parts moved off each other.
    fn cut_spare(&mut self, work: &mut Work) {
        work.spend(MOVING + CUTTING);
        self.leaf.write_surface(&mut self.spare);
        let rounds = Rounds {
            scale: self.scale(),
            most: ROUNDS,
            edges: false,
        };
        if let Some(flaps) = self.leaf.flaps() {
            let spare = &mut self.spare;
            self.parts.forget();
            self.parts.separate_flaps(spare, flaps, rounds, work);
        }
        self.spare.update_normals();
        self.tiles.cut(Mesh {
            folds: folds(self.creased.as_ref(), &[]),
            ..Mesh::of(&self.spare)
        });
    }

    /// Whether what was cut goes through itself where it is nearer than `apart` metres, of a page
    /// 0.14 m wide. Counts the work.
    fn crosses_itself(&mut self, apart: f32, work: &mut Work) -> bool {
        let is_through = self.tiles.cross_themselves(apart * self.scale(), work);
        self.searching = self.searching.saturating_add(work.done());
        is_through
    }
}
