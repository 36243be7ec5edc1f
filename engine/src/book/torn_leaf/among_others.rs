//! What a loose sheet is to others: its upper side, on which they lie, and how grabs pull it among
//! them.

use std::rc::Rc;

use super::{Crumpled, TornLeaf};
use crate::book::Book;
use crate::book::surroundings::Surroundings;
use crate::contact::aabb::Aabb;
use crate::contact::relief::Relief;
use crate::contact::tolerance::DEEPEST;
use crate::grid::{cells, cut_cell};
use crate::surface::Surface;

impl TornLeaf {
    /// Its place among loose sheets that were [stepped together](crate::book::step_together), from
    /// the table up; the greatest number of one that was not.
    pub fn layer(&self) -> u32 {
        self.layer
    }

    /// Where a grab pulls within a tick: not through other sheets, and no faster upward than what
    /// lies upon it gets out of the way.
    pub(super) fn pulled_to(&self, grab: usize, around: &Surroundings) -> [f32; 3] {
        let mut to = around.over_sheets(self.pulled[grab]);
        if self.is_laden {
            let rise = self.steps as f32 * DEEPEST;
            let highest = match &self.crumpled {
                Some(Crumpled::Ball(ball)) => ball.highest_pull(rise),
                _ => self
                    .sheet
                    .held_place(grab as u32)
                    .map(|held| held[2] + rise),
            };
            to[2] = highest.map_or(to[2], |highest| to[2].min(highest));
        }
        to
    }

    /// Its upper side as it is drawn, or as it was when it was no more than a sliver elsewhere.
    pub(in crate::book) fn renew_relief(&mut self, book: &Book) -> Rc<Relief> {
        let points = &self.surface.positions;
        let is_outdated = |relief: &Rc<Relief>| relief.is_outdated(points);
        if self.relief.as_ref().is_some_and(is_outdated) {
            self.relief = None;
        }
        self.relief(book)
    }

    /// Its upper side as it was drawn when it was last made.
    pub(in crate::book) fn relief(&mut self, book: &Book) -> Rc<Relief> {
        if let Some(relief) = &self.relief {
            return Rc::clone(relief);
        }
        let [width, height] = book.size().map(|side| side as f32);
        let spacing = width / (book.columns().len() - 1) as f32;
        // Nothing of a sheet is farther apart than the corners of its page, stretched by a part.
        let longest = 1.1 * (width * width + height * height).sqrt();
        let shape = (self.around.table, longest);
        let points = &self.surface.positions;
        let relief = Rc::new(Relief::of(points, &self.triangles(), spacing, shape));
        self.relief = Some(Rc::clone(&relief));
        relief
    }

    /// The box around its nodes.
    pub(in crate::book) fn node_bounds(&self) -> Aabb {
        let nodes = self.sheet.positions().as_chunks::<3>().0;
        Aabb::around(nodes.iter().copied())
    }

    /// The box around what is drawn of it.
    pub(in crate::book) fn drawn_bounds(&self) -> Aabb {
        let points = self.surface.positions.as_chunks::<3>().0;
        Aabb::around(points.iter().copied())
    }

    /// Height of the table, metres.
    pub(in crate::book) fn table(&self) -> f32 {
        self.around.table
    }

    /// Whether a grab holds it.
    pub(in crate::book) fn is_held(&self) -> bool {
        self.is_held.contains(&true)
    }

    /// The triangles of what is drawn of it.
    pub(super) fn triangles(&self) -> Vec<[u32; 3]> {
        match &self.mesh {
            Some(mesh) => mesh.triangles.clone(),
            None => grid_triangles(&self.surface),
        }
    }
}

/// The triangles of a surface whose points lie row by row: two to a cell, cut along its rising
/// diagonal.
fn grid_triangles(surface: &Surface) -> Vec<[u32; 3]> {
    let columns = surface.columns;
    let triangles = cells(columns, surface.rows).flat_map(|foot| cut_cell(foot, columns, false));
    triangles
        .map(|corners| corners.map(|corner| corner as u32))
        .collect()
}
