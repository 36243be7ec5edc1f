//! A leaf that is torn out of the book: bound by less and less of the spine, then a loose sheet
//! on or beside the book.
//!
//! Griffith's rule: a row of the spine gives way when the energy that it holds reaches the work
//! of tearing it, the work of fracture `G` of paper times its caliper times the length that
//! holds there (docs/reports/folding.md has them). A row is a spring, whose stiffness follows from
//! that work and from how far a torn edge opens before it parts. A tear grows from its ends:
//! paper gives way where it is notched, as at its rims, long before it does elsewhere.

use std::rc::Rc;

use super::Book;
use super::flight::Flight;
use super::folded_sheet::FoldedSheet;
use super::limits::{NODES, TICK};
use super::stillness::{STILL, Stillness};
use super::surroundings::{Surroundings, TableAround};
use crate::contact::flaps::Flaps;
use crate::contact::relief::Relief;
use crate::grid::Side;
use crate::models::sheet::{Root, Sheet, SheetSettings};
use crate::paper_mesh::PaperMesh;
use crate::stock::GRAVITY;
use crate::surface::Surface;
use crate::turn::TurnModel;

mod across;
#[cfg(test)]
mod across_tests;
mod among_others;
mod ball;
mod bound_rows;
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
pub use bound_rows::TearLine;
use bound_rows::{BoundRow, bound_rows};
use drawn_offset::DrawnOffset;
use nodes::{finer, nodes_of};
use press::Press;

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
    /// How its drawn points lie on its page, where that is no grid.
    mesh: Option<PaperMesh>,
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
            ..book.paper().sheet(book.size())
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
            mesh: sheet.paper_mesh(),
            folded: None,
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
        self.draw_anew();
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
        if let Some(folded) = &mut self.folded {
            folded.separate(&mut self.surface, self.sheet.settings().width as f32);
        }
        self.surface.update_normals();
    }

    /// What is drawn, as of the last update.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// How what is drawn lies on its page; None where its points lie in even columns and rows. The
    /// surface's `topology` rises when it changes.
    pub fn paper_mesh(&self) -> Option<&PaperMesh> {
        self.mesh.as_ref()
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
            if let Some(folded) = &self.folded {
                folded.keep_apart(&mut self.sheet);
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
        self.draw_anew();
        self.drawn_offset = DrawnOffset::new(&shown, &self.surface.positions, TURNED);
    }

    /// Goes on as another sheet, which is drawn at once. All grabs are released.
    fn take_sheet(&mut self, sheet: Sheet) {
        let (version, topology) = (self.surface.version, self.surface.topology);
        *self = TornLeaf {
            torn: self.torn,
            across: core::mem::take(&mut self.across),
            layer: self.layer,
            relief: self.relief.take(),
            ..TornLeaf::of(sheet, self.around)
        };
        self.surface.version = version.wrapping_add(1);
        self.surface.topology = topology.wrapping_add(1);
    }

    /// Draws the sheet by another mesh, which it has from now on.
    fn draw_anew(&mut self) {
        self.mesh = self.sheet.paper_mesh();
        self.sheet.write_surface(&mut self.surface);
        self.surface.topology = self.surface.topology.wrapping_add(1);
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
    let mut nodes = if leaf.is_creased() {
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
