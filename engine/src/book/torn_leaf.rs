//! A leaf that is torn out of the book: bound by less and less of the spine, then a loose sheet
//! on or beside the book.
//!
//! Griffith's rule: a row of the spine gives way when the energy that it holds reaches the work
//! of tearing it, the work of fracture `G` of paper times its caliper times the length that
//! holds there (folding.md has the figures). A row is a [`Tether`], whose stiffness follows from
//! that work and from how far a torn edge opens before it parts. A tear grows from its ends:
//! paper gives way where it is notched, as at its rims, long before it does elsewhere.

use std::rc::Rc;

use super::Book;
use super::creased_mesh::CreasedMesh;
use super::flight::Flight;
use super::folded_sheet::FoldedSheet;
use super::limits::{NODES, TICK};
use super::relief::{Relief, bounds};
use super::stillness::{STILL, Stillness};
use super::surroundings::{Surroundings, TableAround};
use super::tolerance::DEEPEST;
use crate::flaps::Flaps;
use crate::grid::Side;
use crate::models::sheet::{CAN_CREASE, Root, Sheet, SheetSettings, Tether, TornMesh};
use crate::stock::GRAVITY;
use crate::surface::Surface;
use crate::turn::TurnModel;

mod across;
#[cfg(test)]
mod across_tests;
mod ball;
#[cfg(test)]
mod crumpling_tests;
mod drawn_offset;
#[cfg(test)]
mod folded_tests;
mod fracture;
#[cfg(test)]
mod meeting_tests;
mod nodes;
mod press;
mod tear_heading;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod turning_tests;

use across::Across;
use ball::Ball;
use drawn_offset::DrawnOffset;
use fracture::{stiffness_of, work_of};
use nodes::{finer, nodes_of};
use press::Press;

/// How a leaf is bound, which says what there is to tear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TearLine {
    /// Along the whole spine: sewn or glued.
    Sewn,
    /// At two staples, each of whose crowns holds 12 mm of paper.
    Stapled,
    /// Along a line of cuts that leave three tenths of the paper.
    Perforated,
}

/// Part of a perforated line that is paper: cuts of 2.5 mm with 1 mm between them.
const TIES: f64 = 0.3;

/// Width of a staple, metres, and where the two are along the spine.
const STAPLE: f64 = 0.012;
const STAPLES: [f64; 2] = [0.25, 0.75];

/// Stiffness of a hand that tears, N/m, and its greatest force, N: it feels some centimetres of
/// pull, and is as strong as finger and thumb.
const PULL: [f32; 2] = [200.0, 20.0];

/// Grabs that a sheet tells apart, numbered from 0: two tear it across.
pub const MAX_PULLS: usize = 2;

/// Speed of the nodes of a ball, root of the mean square, m/s, below which it lies still: a tenth of what gravity gives it in a tick, which its contacts take from
/// it again, node by node.
const BALL_STILL: f32 = 0.1 * GRAVITY as f32 * TICK;

/// Ticks in which what was drawn of the bound leaf becomes what is drawn of the torn one: the
/// sheet's cells are coarser than the bend out of the gutter. Where the path of a tear turns, paper
/// that comes to the other piece moves by up to what a tear opens, in twice as many.
const BLENDED: u32 = 12;
const TURNED: u32 = 2 * BLENDED;

/// A row of the spine that holds.
#[derive(Clone, Copy, Debug)]
struct BoundRow {
    tether: Tether,
    /// Work of tearing it, J.
    work: f32,
}

/// How far a sheet is crumpled.
#[derive(Clone, Debug)]
enum Crumpled {
    /// It is pressed.
    Pressed(Press),
    /// It has come to its shape.
    Ball(Ball),
}

/// A leaf that is torn out, or has been.
#[derive(Clone, Debug)]
pub struct TornLeaf {
    sheet: Sheet,
    steps: u32,
    around: TableAround,
    /// The rows that hold, from the foot.
    bound: Vec<BoundRow>,
    /// Work done in tearing since it was last asked for, J.
    torn: f32,
    /// Whether each grab holds it, and where it pulls.
    is_held: [bool; MAX_PULLS],
    pulled: [[f32; 3]; MAX_PULLS],
    stillness: Stillness,
    surface: Surface,
    drawn_offset: DrawnOffset,
    crumpled: Option<Crumpled>,
    /// Its parts, of one that was folded when it was torn out.
    folded: Option<FoldedSheet>,
    /// What holds one that is torn across.
    across: Across,
    /// How what is drawn of a sheet that is torn across lies on its page, and how often that has
    /// changed.
    mesh: TornMesh,
    mesh_version: u32,
    /// Its place among loose sheets, from the table up; the greatest of one that has met none.
    pub(super) layer: u32,
    /// Whether others lie upon it.
    pub(super) is_laden: bool,
    /// Its upper side, if another sheet has come near it.
    relief: Option<Rc<Relief>>,
}

impl TornLeaf {
    /// Begins to tear the leaf of a flight out of a book, from where it is drawn. `line` says
    /// what binds it; the rows from `bound.start` to `bound.end` (from the foot, of 14) still do.
    /// The flight itself is not changed.
    ///
    /// None where folds of its leaf lie upon folds, where there is no such flight, where `bound` is no range of rows, or a figure of
    /// `around` is none that a table can have.
    pub fn tear(
        book: &Book,
        id: u32,
        line: TearLine,
        bound: core::ops::Range<usize>,
        around: TableAround,
    ) -> Option<TornLeaf> {
        let flight = book.flights.get(id)?;
        if bound.start > bound.end || bound.end > NODES[1] || !around.is_sound() {
            return None;
        }
        let drawn = flight.surface();
        let sheet = sheet_of(flight, book)?;
        let bound = bound_rows(&sheet, line, bound);
        let mut torn = TornLeaf::of(sheet, around);
        torn.drawn_offset = DrawnOffset::new(&drawn.positions, &torn.surface.positions, BLENDED);
        torn.bound = bound;
        torn.folded = FoldedSheet::of(&torn.sheet);
        torn.tie();
        torn.update(book);
        Some(torn)
    }

    /// A loose sheet of the paper of a book, which lies flat beside it: what is torn in play, so that
    /// what tears has run once before a reader waits for it.
    pub fn blank(book: &Book, around: TableAround) -> Option<TornLeaf> {
        let settings = SheetSettings {
            root: Root::Free,
            ..book.paper().sheet(book.size(), 1)
        };
        let sheet = around.is_sound().then(|| Sheet::new(settings).ok())??;
        Some(TornLeaf::of(sheet, around))
    }

    /// A loose sheet.
    fn of(mut sheet: Sheet, around: TableAround) -> TornLeaf {
        let mut surface = Surface::new(2, 2);
        sheet.write_surface(&mut surface);
        surface.update_normals();
        TornLeaf {
            steps: libm::roundf(TICK / sheet.time_step()).max(1.0) as u32,
            mesh: sheet.torn_mesh(),
            folded: None,
            mesh_version: 0,
            layer: u32::MAX,
            is_laden: false,
            relief: None,
            drawn_offset: DrawnOffset::default(),
            bound: Vec::new(),
            sheet,
            around,
            torn: 0.0,
            is_held: [false; MAX_PULLS],
            pulled: [[f32::NAN; 3]; MAX_PULLS],
            stillness: Stillness::default(),
            surface,
            crumpled: None,
            across: Across::default(),
        }
    }

    /// A grab of a number takes hold at (`u`, `v`) of the page, each 0 to 1 or the nearer of these,
    /// in place of where it did. Nothing happens where one is not finite or there is no such
    /// grab; a ball has the first alone.
    pub fn grab(&mut self, grab: usize, u: f32, v: f32) {
        if grab >= MAX_PULLS || !(u.is_finite() && v.is_finite()) {
            return;
        }
        match &mut self.crumpled {
            None => self.sheet.grab_firmly(grab as u32, [u, v], PULL),
            Some(Crumpled::Ball(ball)) if grab == 0 => {
                ball.grab([u, v].map(|at| at.clamp(0.0, 1.0)));
            }
            Some(_) => return,
        }
        (self.is_held[grab], self.pulled[grab]) = (true, [f32::NAN; 3]);
        self.across.hold_anew();
        self.wake();
    }

    /// A grab pulls to a place in book space, metres: within a kilometre, or to the nearest
    /// place that is. Nothing happens where it holds nothing or the place is not finite.
    pub fn pull(&mut self, grab: usize, to: [f32; 3]) {
        if grab < MAX_PULLS && to.iter().all(|x| x.is_finite()) && to != self.pulled[grab] {
            self.sheet.pull(grab as u32, to);
            self.pulled[grab] = to;
            self.wake();
        }
    }

    /// All grabs are released.
    pub fn release(&mut self) {
        for grab in 0..MAX_PULLS {
            self.sheet.release(grab as u32);
        }
        if let Some(Crumpled::Ball(ball)) = &mut self.crumpled {
            ball.release();
        }
        (self.is_held, self.pulled) = ([false; MAX_PULLS], [[f32::NAN; 3]; MAX_PULLS]);
        self.across.hold_anew();
        self.wake();
    }

    /// The rows, from the foot, between which the spine still holds it; empty once it is off.
    pub fn bound(&self) -> core::ops::Range<usize> {
        let row = |bound: &BoundRow| bound.tether.node / NODES[0];
        match (self.bound.first(), self.bound.last()) {
            (Some(first), Some(last)) => row(first)..row(last) + 1,
            _ => 0..0,
        }
    }

    /// Tears what still holds at the spine or across, without work: it is off, or torn through.
    pub fn cut(&mut self) {
        self.bound.clear();
        self.tie();
        self.across.cut(&mut self.sheet);
        self.wake();
    }

    /// Crumples the sheet: it is pressed into a ball, for a little over a second of its own
    /// time, over the place where it is. A hand that held it lets go. From then on it keeps every
    /// sharp bend, and its surface is one of flat facets, of another size; folds that it had are
    /// among these. Returns whether it is crumpled: one that is still bound is not, nor one that
    /// has been or is torn across.
    pub fn crumple(&mut self) -> bool {
        if !self.bound.is_empty() || self.is_crumpled() || self.sheet.is_torn() {
            return false;
        }
        let leaf = self.sheet.settings();
        let mut settings = SheetSettings {
            columns: press::NODES[0],
            rows: press::NODES[1],
            ..leaf.clone()
        }
        .bearable(f64::from(TICK));
        let area = |settings: &SheetSettings| settings.cell()[0] * settings.cell()[1];
        // As stiff in its plane for the mass of a node as it was.
        settings.stretch *= area(&settings) / area(leaf);
        let Ok(mut sheet) = Sheet::new(settings) else {
            return false;
        };
        sheet.place(finer(&self.sheet, press::NODES).into_iter().flatten());
        sheet.crumple();
        let press = Press::about(&sheet, self.around.table);
        self.crumpled = Some(Crumpled::Pressed(press));
        self.folded = None;
        self.sheet = sheet;
        self.release();
        self.drawn_offset = DrawnOffset::default();
        // What is drawn is of facets from now on.
        self.sheet.write_surface(&mut self.surface);
        self.surface.update_normals();
        true
    }

    /// Begins to tear the sheet across, along a path on its page: u and v of places, from the edge
    /// next to the first, where the tear begins, to the edge next to the last. All grabs are
    /// released. The sheet is where it was, and its surface has another size.
    ///
    /// Returns whether it does: not one that is bound, folded, crumpled, torn across already or a piece,
    /// and not along a path that leaves the page, has both its ends on one edge, or parts a piece
    /// narrower than a cell or more crooked than a grid can be.
    ///
    /// If `turns`, the path ahead of the tip turns with the pull of both grabs as it goes on: across
    /// the way from one to the other, as that swings on the paper from where they first
    /// pulled.
    pub fn tear_across(&mut self, path: &[[f64; 2]], turns: bool) -> bool {
        if !self.bound.is_empty()
            || self.is_crumpled()
            || self.folded.is_some()
            || self.sheet.is_torn()
        {
            return false;
        }
        let Some((sheet, across)) = Across::begin(&self.sheet, path, turns) else {
            return false;
        };
        self.across = across;
        self.take_sheet(sheet);
        true
    }

    /// Number of nodes of the path at which a sheet that is torn across still holds.
    pub fn ties(&self) -> usize {
        self.across.count()
    }

    /// How far along its path a sheet is torn across, metres: from the first place of the path
    /// on. Infinite once it is torn through; 0 of any other sheet.
    pub fn opened(&self) -> f32 {
        match self.across.tip() {
            Some(tip) => tip,
            None if self.sheet.is_torn() => f32::INFINITY,
            None => 0.0,
        }
    }

    /// Parts a sheet that is torn through: this is what lies to the right of the path from then
    /// on, and what is returned is the piece to the left of it, where it was. Right and left are
    /// those of the path toward rising u, or toward rising v of a path that is steeper. All grabs
    /// are released. None of any other sheet.
    pub fn part(&mut self) -> Option<TornLeaf> {
        let [foot, head] = self.sheet.parted()?;
        // Both go on as they were drawn.
        let offset = core::mem::take(&mut self.drawn_offset);
        self.take_sheet(foot);
        let mut parted = TornLeaf::of(head, self.around);
        parted.layer = self.layer;
        let offsets = offset.parted(self.surface.positions.len());
        [self.drawn_offset, parted.drawn_offset] = offsets;
        Some(parted)
    }

    /// Whether it is crumpled, or being crumpled.
    pub fn is_crumpled(&self) -> bool {
        self.crumpled.is_some()
    }

    /// Returns the work done in tearing, and in creasing one that is crumpled, since it was last
    /// asked for, J: what is heard.
    pub fn take_work(&mut self) -> f32 {
        core::mem::take(&mut self.torn) + self.sheet.take_yielded()
    }

    /// Whether it does not move until the next command: it lies or is held still, or has been let
    /// go, or held by grabs that do not move, for so long that it is left as it is.
    pub fn is_asleep(&self) -> bool {
        self.stillness.is_asleep()
    }

    /// Steps by `ticks` of [`TICK`] seconds on and beside a book as it is drawn.
    pub fn step(&mut self, book: &Book, ticks: u32) {
        for _ in 0..ticks {
            if self.is_asleep() {
                return;
            }
            self.tick_over(book, &[]);
        }
    }

    /// Steps by a tick on and beside a book as it is drawn, and over other sheets.
    pub(super) fn tick_over(&mut self, book: &Book, under: &[Rc<Relief>]) {
        let around = Surroundings::new(book, self.around, &self.sheet).over(under);
        let pulled: [_; MAX_PULLS] = core::array::from_fn(|grab| self.pulled_to(grab, &around));
        if let Some(Crumpled::Ball(ball)) = &mut self.crumpled {
            ball.step(TICK, &around, pulled[0]);
            ball.write_nodes(&mut self.sheet);
        } else {
            for (grab, to) in pulled.into_iter().enumerate() {
                self.sheet.pull(grab as u32, to);
            }
            self.step_sheet(&around);
        }
        self.drawn_offset.tick();
        if let Some(Crumpled::Pressed(_)) = &self.crumpled {
            return;
        }
        let slowest = if self.is_crumpled() {
            BALL_STILL
        } else {
            STILL
        };
        let velocities = self.sheet.velocities();
        let is_held = self.is_held();
        self.stillness.count(velocities, is_held, slowest);
    }

    /// Where a grab pulls within a tick: not through other sheets, and no faster upward than what
    /// lies upon it gets out of the way.
    fn pulled_to(&self, grab: usize, around: &Surroundings) -> [f32; 3] {
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

    /// Brings the drawn surface up to date, on and beside a book as it is drawn.
    pub fn update(&mut self, book: &Book) {
        self.update_over(book, &[]);
    }

    /// Brings the drawn surface up to date, on and beside a book as it is drawn and over other
    /// sheets.
    pub(super) fn update_over(&mut self, book: &Book, under: &[Rc<Relief>]) {
        self.sheet.write_surface(&mut self.surface);
        self.drawn_offset.add_to(&mut self.surface.positions);
        let around = Surroundings::new(book, self.around, &self.sheet).over(under);
        around.push_off(&mut self.surface);
        if !under.is_empty() {
            let triangles = self.triangles();
            around.push_off_sheets(&mut self.surface, &triangles);
        }
        if let (true, Some(folded)) = (CAN_CREASE, &mut self.folded) {
            folded.separate(&mut self.surface, self.sheet.settings().width as f32);
        }
        self.surface.update_normals();
    }

    /// Its upper side as it is drawn, or as it was when it was no more than a sliver elsewhere.
    pub(super) fn renew_relief(&mut self, book: &Book) -> Rc<Relief> {
        let points = &self.surface.positions;
        let is_outdated = |relief: &Rc<Relief>| relief.is_outdated(points);
        if self.relief.as_ref().is_some_and(is_outdated) {
            self.relief = None;
        }
        self.relief(book)
    }

    /// Its upper side as it was drawn when it was last made.
    pub(super) fn relief(&mut self, book: &Book) -> Rc<Relief> {
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

    /// The least and the greatest coordinates of its nodes, metres.
    pub(super) fn node_bounds(&self) -> [[f32; 3]; 2] {
        bounds(self.sheet.positions())
    }

    /// The least and the greatest coordinates of what is drawn of it, metres.
    pub(super) fn drawn_bounds(&self) -> [[f32; 3]; 2] {
        bounds(&self.surface.positions)
    }

    /// Height of the table, metres.
    pub(super) fn table(&self) -> f32 {
        self.around.table
    }

    /// Whether a grab holds it.
    pub(super) fn is_held(&self) -> bool {
        self.is_held.contains(&true)
    }

    /// The triangles of what is drawn of it.
    fn triangles(&self) -> Vec<[u32; 3]> {
        if let Some(mesh) = self.folded_mesh() {
            return mesh.triangles.as_chunks::<3>().0.to_vec();
        }
        if !self.mesh.triangles.is_empty() {
            return self.mesh.triangles.clone();
        }
        grid_triangles(&self.surface, self.is_crumpled())
    }

    /// How what is drawn of one that was folded when it was torn out lies on its page; None of any
    /// other, and once it is crumpled.
    pub fn folded_mesh(&self) -> Option<&CreasedMesh> {
        self.folded.as_ref().map(|folded| &folded.mesh)
    }

    /// What is drawn, as of the last update.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// How what is drawn of one that is torn across lies on its page; nothing of any other.
    pub fn mesh(&self) -> &TornMesh {
        &self.mesh
    }

    /// Changes whenever the mesh does.
    pub fn mesh_version(&self) -> u32 {
        self.mesh_version
    }

    /// The sheet itself.
    pub fn sheet(&self) -> &Sheet {
        &self.sheet
    }

    /// Thickness of the paper, metres.
    pub fn caliper(&self) -> f32 {
        self.sheet.settings().stock.caliper as f32
    }

    /// Steps the sheet by a tick.
    fn step_sheet(&mut self, around: &Surroundings) {
        for left in (1..=self.steps).rev() {
            let (positions, contacts) = self.sheet.contact_state();
            around.write_contacts(positions, contacts);
            if let (true, Some(folded)) = (CAN_CREASE, &self.folded) {
                folded.find_contacts(&mut self.sheet);
            }
            if let Some(Crumpled::Pressed(press)) = &self.crumpled {
                let (positions, contacts) = self.sheet.contact_state();
                press.write_contacts(positions, contacts);
                press.keep_apart(&mut self.sheet);
            }
            self.sheet.step_of(left);
            let torn = self.torn;
            self.tear_rows();
            self.torn += self.across.tear(&mut self.sheet);
            if self.torn > torn {
                self.wake();
            }
        }
        self.turn_tear();
        if let Some(Crumpled::Pressed(press)) = &mut self.crumpled
            && !press.tick(&mut self.sheet)
        {
            self.crumpled = Some(Crumpled::Ball(Ball::of(&self.sheet)));
        }
    }

    /// Turns a tear with the pull of its grabs. What is drawn goes on from where it was.
    fn turn_tear(&mut self) {
        let (offset, surface) = (&self.drawn_offset, &mut self.surface);
        let drawn = |sheet: &mut Sheet| {
            sheet.write_surface(surface);
            offset.add_to(&mut surface.positions);
            surface.positions.clone()
        };
        let Some(shown) = self.across.turn(&mut self.sheet, self.pulled, drawn) else {
            return;
        };
        self.mesh = self.sheet.torn_mesh();
        self.mesh_version = self.mesh_version.wrapping_add(1);
        self.sheet.write_surface(&mut self.surface);
        self.drawn_offset = DrawnOffset::new(&shown, &self.surface.positions, TURNED);
    }

    /// Goes on as another sheet, which is drawn at once. All grabs are released.
    fn take_sheet(&mut self, sheet: Sheet) {
        let version = self.surface.version;
        *self = TornLeaf {
            torn: self.torn,
            mesh_version: self.mesh_version.wrapping_add(1),
            across: core::mem::take(&mut self.across),
            layer: self.layer,
            relief: self.relief.take(),
            ..TornLeaf::of(sheet, self.around)
        };
        self.surface.version = version.wrapping_add(1);
    }

    /// Moves on from now, if it was asleep.
    pub(super) fn wake(&mut self) {
        self.stillness.wake();
    }

    /// Ties the sheet by the rows that hold.
    fn tie(&mut self) {
        let tethers = self.sheet.tethers_mut();
        tethers.clear();
        tethers.extend(self.bound.iter().map(|row| row.tether));
    }

    /// Tears rows at either end that hold more energy than it takes.
    fn tear_rows(&mut self) {
        let positions = self.sheet.positions();
        let (bound, mut torn) = (self.bound.len(), self.torn);
        let mut gives_way = |row: &BoundRow| {
            let energy = row.tether.energy(positions);
            torn += if energy >= row.work { row.work } else { 0.0 };
            energy >= row.work
        };
        if self.bound.last().is_some_and(&mut gives_way) {
            self.bound.pop();
        }
        if self.bound.first().is_some_and(&mut gives_way) {
            self.bound.remove(0);
        }
        self.torn = torn;
        if self.bound.len() != bound {
            self.tie();
        }
    }
}

/// The triangles of a surface whose points lie row by row: two to a cell, cut along its rising
/// diagonal; of facets about the middle of four cells, along that to the middle.
fn grid_triangles(surface: &Surface, has_facets: bool) -> Vec<[u32; 3]> {
    let (columns, rows) = (surface.columns, surface.rows);
    let mut triangles = Vec::with_capacity(2 * (columns - 1) * (rows - 1));
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let foot = row * columns + column;
            let [a, b, c, d] =
                [foot, foot + 1, foot + columns, foot + columns + 1].map(|n| n as u32);
            if has_facets && (row + column) % 2 == 1 {
                triangles.extend([[a, b, c], [b, d, c]]);
            } else {
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
    triangles
}

/// The sheet of a flight with nothing that binds it, folded as that is, where it is drawn. None
/// where folds of it lie upon folds.
fn sheet_of(flight: &Flight, book: &Book) -> Option<Sheet> {
    let (leaf, drawn) = (flight.leaf(), flight.surface());
    // Three layers are not kept out of each other where a pull of newtons flings them.
    if leaf.flaps().is_some_and(Flaps::overlap) {
        return None;
    }
    let mut sheet = Sheet::new(SheetSettings {
        root: Root::Free,
        ..leaf.sheet().settings().clone()
    })
    .ok()?;
    let rows = (0..drawn.rows).map(|row| row as f32 / (drawn.rows - 1) as f32);
    sheet.draw_samples(book.columns(), &rows.collect::<Vec<_>>());
    let mut nodes = if CAN_CREASE && leaf.is_creased() {
        sheet.crease(&leaf.sheet().creases()).ok()?;
        leaf.in_book_space().points.clone()
    } else {
        nodes_of(drawn, book.columns(), NODES)
    };
    for node in &mut nodes {
        // Cells are too coarse to follow the pages down into the gutter.
        let [x, _, z] = *node;
        let side = if x < 0.0 { Side::Left } else { Side::Right };
        node[2] = z.max(book.pile(side).height(x.abs()));
    }
    sheet.place_folded(nodes.into_iter().flatten());
    Some(sheet)
}

/// The rows of the spine between `range` (from the foot) that bind a leaf, at rest where it is.
fn bound_rows(sheet: &Sheet, line: TearLine, range: core::ops::Range<usize>) -> Vec<BoundRow> {
    let settings = sheet.settings();
    let places = sheet.positions().as_chunks::<3>().0;
    let (rows, cell) = (settings.rows, settings.cell()[1]);
    let length_at = |row: usize| match line {
        TearLine::Stapled => {
            let is_staple = |at: &f64| libm::round(at * (rows - 1) as f64) as usize == row;
            if STAPLES.iter().any(is_staple) {
                STAPLE
            } else {
                0.0
            }
        }
        TearLine::Sewn | TearLine::Perforated => {
            let part = if line == TearLine::Sewn { 1.0 } else { TIES };
            part * cell
                * if row == 0 || row + 1 == rows {
                    0.5
                } else {
                    1.0
                }
        }
    };
    range
        .filter_map(|row| {
            let work = work_of(settings.stock.caliper, length_at(row));
            let node = row * settings.columns;
            let tether = Tether {
                node,
                place: places[node],
                stiffness: stiffness_of(work, cell),
            };
            let work = work as f32;
            (work > 0.0).then_some(BoundRow { tether, work })
        })
        .collect()
}
