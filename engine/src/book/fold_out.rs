//! The flap of a fold-out: the part of a leaf beyond its fold, while the leaf lies uppermost.
//!
//! A flap is a leaf whose spine is the fold: a sheet that leaves the page through a hinge, and
//! meets the pages, the boards and the table as any loose sheet does. The hinge is a crease as
//! [`SheetCrease`] describes it. Its rest angle is the sheet's clamp angle, which follows where the
//! fold is turned further than it yields. The page itself lies still under it.
//!
//! A wide flap is folded again, so that shut it lies within its page. It is one sheet all the same,
//! with creases at its further folds, whose panels keep off each other as those of a creased leaf.
//!
//! Angles of the fold are 0 where the flap lies open, level beside the page, and pi where it is
//! shut upon it, on either side of the book.

use super::Book;
use super::limits::{NODES, TICK};
use super::paper::Paper;
use super::stillness::{STILL, Stillness};
use super::surroundings::{Surroundings, TableAround};
use crate::grab::{stiffness_for, strongest};
use crate::grid::Side;
use crate::interpolate::uniform_samples;
use crate::models::sheet::{Root, Sheet, SheetCrease, SheetSettings};
use crate::paper_mesh::PaperMesh;
use crate::rigidity::Rigidity;
use crate::surface::Surface;
use crate::turn::TurnModel;
use crate::vector::dot;
use core::f32::consts::{FRAC_PI_2, PI};

mod creased_flap;
#[cfg(test)]
mod folded_tests;
mod own_grabs;
mod panels;
#[cfg(test)]
mod tests;
mod turning;

pub use panels::FlapPlace;

use creased_flap::CreasedFlap;
use panels::Panels;
use turning::{Drawn, Turn};

/// Angle to which a reader presses a fold that is left open, radians: as a page's corner that was
/// folded and opened, it keeps a line.
const AJAR: f32 = PI / 9.0;

/// Speed at which a fold is pressed, radians a second: a half turn takes as long as the folding of
/// a page.
const PRESSING: f32 = PI / 0.5;

/// Part of its speed that a flap keeps in a tick once it is down: what trembles on the edge of the
/// pages is smoothed.
const SMOOTHED: f32 = 0.9;

/// How many times the force at the flap's edge that makes its fold yield a hand has: a finger that
/// lifts a page is too weak for a fold of card.
const FIRM: f64 = 4.0;

/// The number of the hand that a pointer moves.
const HAND: u32 = 0;

/// The flap of a fold-out.
#[derive(Clone, Debug)]
pub struct FoldOut {
    /// Over its fold: the fold's foot is at its origin.
    sheet: Sheet,
    steps: u32,
    side: Side,
    panels: Panels,
    /// What its further folds are, if it has any.
    creased: Option<CreasedFlap>,
    /// Width of the page, metres.
    page_width: f64,
    around: TableAround,
    /// The fold's foot in book space, metres.
    foot: [f32; 3],
    /// Where the nodes are in book space: x, y, z of each, metres.
    nodes: Vec<f32>,
    /// Angle at which the fold rests, and angle off it beyond which it yields, radians.
    rest: f32,
    yields: f32,
    /// Part of the turn of the first cell off the fold's rest that is the fold's own: the paper
    /// beside it bends by what is left.
    own: f32,
    /// Stiffness of the hand, N/m, and its greatest force, N.
    hand: [f32; 2],
    turn: Option<Turn>,
    /// How a pointer draws it where it has further folds.
    drawn: Option<Drawn>,
    is_held: bool,
    /// Where the hand pulls, in book space.
    pulled: [f32; 3],
    stillness: Stillness,
    surface: Surface,
    /// How its drawn points lie on the flat paper, where that is no grid.
    mesh: Option<PaperMesh>,
}

impl FoldOut {
    /// The flap at a place of a book at rest, shut upon its page.
    ///
    /// None where a figure is out of bounds, or no leaf lies on that side.
    pub fn new(book: &Book, place: FlapPlace, around: TableAround) -> Option<FoldOut> {
        let FlapPlace {
            side, fold, width, ..
        } = place;
        let on_left = book.read();
        let leaf = match side {
            Side::Right => (on_left < book.leaves).then_some(on_left),
            Side::Left => on_left.checked_sub(1),
        }?;
        if !place.is_sound() || !around.is_sound() {
            return None;
        }
        let panels = place.layout();
        let [page_width, height] = book.size();
        let paper = Paper {
            stock: book.stock_of(leaf),
            ..*book.paper()
        };
        let rest = PI - AJAR;
        let line = SheetCrease::pressed([[0.0; 2]; 2], f64::from(rest), &paper.stock, page_width);
        let nodes = [panels.columns(), NODES[1]];
        let settings = SheetSettings {
            root: Root::Hinged(line.stiffness),
            ..paper.sheet_of(nodes, [width * page_width, height])
        };
        let beside = 2.0 * Rigidity::of(&settings.stock, settings.grain).d11 / settings.cell()[0];
        let hand = hand_for(&settings, &line, panels.count);
        let mut sheet = Sheet::new(settings).ok()?;
        let rows = (0..book.rows()).map(|row| row as f32 / (book.rows() - 1) as f32);
        let rows: Vec<f32> = rows.collect();
        let creased = if panels.count == 1 {
            sheet.draw_samples(book.columns(), &rows);
            None
        } else {
            // Every fold needs columns near it, not the first alone.
            sheet.draw_samples(&uniform_samples(book.columns().len()), &rows);
            Some(CreasedFlap::new(&mut sheet, (panels, side), &line)?)
        };
        let foot = place_on_page(book, side, fold as f32);
        let across = sheet.settings().columns;
        let mut nodes = Vec::with_capacity(3 * across * NODES[1]);
        for node in 0..across * sheet.settings().rows {
            let (inward, over) = panels.shut(node % across);
            let [x, _, z] = place_on_page(book, side, (fold - inward) as f32);
            let y = (node / across) as f64 * sheet.settings().cell()[1];
            nodes.extend([x - foot[0], y as f32, z - foot[2] + over]);
        }
        let mut flap = FoldOut {
            steps: libm::roundf(TICK / sheet.time_step()).max(1.0) as u32,
            own: (beside / (beside + line.stiffness)) as f32,
            yields: line.yields as f32,
            surface: Surface::new(book.columns().len(), book.rows()),
            mesh: sheet.paper_mesh(),
            sheet,
            side,
            panels,
            creased,
            page_width,
            around,
            foot,
            nodes,
            rest,
            hand,
            turn: None,
            drawn: None,
            is_held: false,
            pulled: [f32::NAN; 3],
            stillness: Stillness::default(),
        };
        flap.set_rest(rest);
        flap.sheet.place_folded(flap.nodes.iter().copied());
        flap.update(book);
        Some(flap)
    }

    /// A hand takes hold at (`u`, `v`), each 0 to 1 or the nearer of these, u from the fold, in
    /// place of where one did. Nothing happens where one is not finite.
    pub fn grab(&mut self, u: f32, v: f32) {
        if !(u.is_finite() && v.is_finite()) {
            return;
        }
        self.let_go();
        if self.creased.is_some() {
            self.draw_from(u);
        } else {
            self.take_hold(HAND, [u, v]);
        }
    }

    /// The hand pulls to a place in book space, metres: within a kilometre, or to the nearest
    /// place that is. Nothing happens where no hand holds it or the place is not finite.
    pub fn pull(&mut self, to: [f32; 3]) {
        let is_new = to != self.pulled && to.iter().all(|x| x.is_finite());
        if !is_new || !self.is_held || self.turn.is_some() {
            return;
        }
        self.pulled = to;
        if let Some(drawn) = &mut self.drawn {
            drawn.first.get_or_insert(to[0]);
            return self.stillness.wake();
        }
        let local = core::array::from_fn(|axis| to[axis] - self.foot[axis]);
        self.sheet.pull(HAND, local);
        self.stillness.wake();
    }

    /// The hand lets go. The flap falls, and its fold is pressed as readers do: open, or shut
    /// where the flap's edge is over the page. One with further folds is turned open or shut so.
    pub fn release(&mut self) {
        if self.drawn.is_some() {
            return self.turn(self.angle() < FRAC_PI_2);
        }
        self.let_go();
        self.stillness.wake();
    }

    /// Angle at which the outer end of its first panel is seen from the fold, radians: the flap is
    /// open where that is less than a right angle.
    pub fn angle(&self) -> f32 {
        inward(self.direction([0, self.panels.last_column(0)]))
    }

    /// How its drawn mesh lies on the flat paper where it has further folds.
    pub fn paper_mesh(&self) -> Option<&PaperMesh> {
        self.mesh.as_ref()
    }

    /// Whether it does not move until the next command.
    pub fn is_asleep(&self) -> bool {
        self.turn.is_none() && self.stillness.is_asleep()
    }

    /// Steps by `ticks` of [`TICK`] seconds on and beside the book, as that is drawn.
    pub fn step(&mut self, book: &Book, ticks: u32) {
        let around = Surroundings::new(book, self.around, &self.sheet);
        for _ in 0..ticks {
            if self.is_asleep() {
                return;
            }
            self.go_on();
            for left in (1..=self.steps).rev() {
                self.find_contacts(&around);
                self.sheet.step_of(left);
                self.settle();
            }
            // Grabs lay a flap with further folds down where it lies shut.
            let is_laid = self.creased.is_some() && !self.is_held && self.angle() > FRAC_PI_2;
            if is_laid || self.stillness.is_down() {
                self.sheet.slow(SMOOTHED);
            }
            self.stillness
                .count(self.sheet.velocities(), self.is_held, STILL);
        }
    }

    /// Brings the drawn surface up to date, on and beside the book as that is drawn.
    pub fn update(&mut self, book: &Book) {
        self.sheet.write_surface(&mut self.surface);
        for point in self.surface.positions.as_chunks_mut::<3>().0 {
            for axis in 0..3 {
                point[axis] += self.foot[axis];
            }
        }
        Surroundings::new(book, self.around, &self.sheet).push_off(&mut self.surface);
        if let Some(creased) = &mut self.creased {
            creased
                .folded
                .separate(&mut self.surface, self.page_width as f32);
        }
        self.surface.update_normals();
    }

    /// What is drawn, as of the last update: u from the fold outward, at the book's columns.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Thickness of the paper, metres.
    pub fn caliper(&self) -> f32 {
        self.sheet.settings().stock.caliper as f32
    }

    fn take_hold(&mut self, hand: u32, at: [f32; 2]) {
        self.sheet.grab_firmly(hand, at, self.hand);
        (self.is_held, self.turn, self.pulled) = (true, None, [f32::NAN; 3]);
        self.stillness.wake();
    }

    fn let_go(&mut self) {
        for hand in 0..self.last_grab() {
            self.sheet.release(hand);
        }
        (self.is_held, self.turn, self.drawn) = (false, None, None);
    }

    /// Moves the flap's own grabs on, and presses the folds once no hand holds the flap.
    fn go_on(&mut self) {
        self.move_grabs();
        if !self.is_held {
            let is_shut = self.angle() > FRAC_PI_2;
            self.set_rest(pressed(self.rest, is_shut));
            self.press_further(is_shut);
        }
    }

    fn find_contacts(&mut self, around: &Surroundings) {
        let (positions, contacts) = self.sheet.contact_state();
        for (node, x) in self.nodes.iter_mut().zip(positions) {
            *node = *x;
        }
        for node in self.nodes.as_chunks_mut::<3>().0 {
            for axis in 0..3 {
                node[axis] += self.foot[axis];
            }
        }
        around.write_contacts(&self.nodes, contacts);
        for contact in contacts.as_flattened_mut() {
            contact.offset -= dot(contact.normal, self.foot);
        }
        if let Some(creased) = &self.creased {
            creased.folded.keep_apart(&mut self.sheet);
        }
    }

    /// Presses the further folds: shut where all of the flap is shut or they are, else open.
    fn press_further(&mut self, is_shut: bool) {
        let Some(creased) = &mut self.creased else {
            return;
        };
        creased.press(&mut self.sheet, |_, angle, rest| {
            pressed(rest, is_shut || angle > FRAC_PI_2)
        });
    }

    /// Angle by which a further fold turns what is beyond it inward, radians.
    fn crease_angle(&self, fold: usize) -> Option<f32> {
        let [angle, _] = self.creased.as_ref()?.angle(&self.sheet, fold - 1)?;
        Some(Panels::way(fold) * angle)
    }

    /// The fold's rest follows where it is turned further than it yields.
    fn settle(&mut self) {
        // Where there are further folds, all are pressed by hand.
        if self.creased.is_some() {
            return;
        }
        let off = self.own * (self.first_angle() - self.rest);
        let beyond = off.abs() - self.yields;
        if beyond > 0.0 {
            self.set_rest(self.rest + beyond.copysign(off));
        }
    }

    fn set_rest(&mut self, rest: f32) {
        self.rest = rest.clamp(0.0, PI);
        self.sheet.set_clamp_angle(match self.side {
            Side::Right => self.rest,
            Side::Left => PI - self.rest,
        });
    }

    /// Angle at which the first column beyond the fold is seen from it, radians, -pi/2 to 3/2 pi.
    fn first_angle(&self) -> f32 {
        inward(self.direction([0, 1]))
    }

    /// Direction in which a column is seen from another, radians, -pi to pi: 0 outward, pi / 2 up;
    /// the mean of the rows.
    fn direction(&self, [from, to]: [usize; 2]) -> f32 {
        let columns = self.sheet.settings().columns;
        let nodes = self.sheet.positions().as_chunks::<3>().0;
        let [mut out, mut up] = [0.0; 2];
        for row in nodes.chunks(columns) {
            out += self.side.sign() * (row[to][0] - row[from][0]);
            up += row[to][2] - row[from][2];
        }
        libm::atan2f(up, out)
    }
}

/// The rest angle of a fold after a tick in which it is pressed open or shut, radians. One that
/// rests flatter than readers press it stays so.
fn pressed(rest: f32, is_shut: bool) -> f32 {
    let to = if is_shut { PI } else { AJAR.min(rest) };
    rest + (to - rest).clamp(-PRESSING * TICK, PRESSING * TICK)
}

/// The same direction within -pi/2 to 3/2 pi, as a flap is seen that lies open or over its page.
fn inward(direction: f32) -> f32 {
    if direction < -FRAC_PI_2 {
        direction + 2.0 * PI
    } else {
        direction
    }
}

/// Stiffness, N/m, and greatest force, N, of a hand on a flap with such a fold: as of any hand on
/// a leaf of its weight, or as much firmer as folds between so many panels need.
fn hand_for(settings: &SheetSettings, line: &SheetCrease, panels: usize) -> [f32; 2] {
    let SheetSettings { width, height, .. } = *settings;
    let to_yield = line.stiffness * line.yields * height / width * panels as f64;
    let force = strongest(settings.stock.grammage, width * height).max(FIRM * to_yield);
    [stiffness_for(force), force].map(|figure| figure as f32)
}

/// A place at the foot of the uppermost page of a side, at `u` of its width, in book space.
fn place_on_page(book: &Book, side: Side, u: f32) -> [f32; 3] {
    let columns = book.columns();
    let at = columns.partition_point(|column| *column <= u);
    let k = at.clamp(1, columns.len() - 1) - 1;
    let part = (u - columns[k]) / (columns[k + 1] - columns[k]);
    let [[x0, z0], [x1, z1]] = [k, k + 1].map(|column| book.pile(side).place(column));
    [
        side.sign() * (x0 + part * (x1 - x0)),
        0.0,
        z0 + part * (z1 - z0),
    ]
}
