//! The leaf in flight: held by grabs, falling, or turned by a grab of its own.
//!
//! It is a [`Sheet`] over a flat table, hinged along a straight spine; the
//! gutter's bend is added where it meets the book and where it is drawn (see
//! [`bend_into_gutter`](super::bend_into_gutter())). A played turn is a grab too: it takes the leaf
//! near its corner, carries it over and lets go, so that whatever happens to
//! the leaf meanwhile happens to paper.

mod course;
mod fall;
mod held;
mod held_shut;
mod lead;
mod opening;
mod play;
mod pressed;
mod shut;
#[cfg(test)]
mod tests;

use super::book_space_leaf::BookSpaceLeaf;
use super::contacts::{ContactView, Neighbour, detect_contacts, detect_self_contacts};
use super::fraction_turned::fraction_turned;
use super::gutter::Gutter;
use super::limits::{MAX_GRABS, NODES, TICK};
use super::paper::Paper;
use super::phase::Phase;
use super::pile::Pile;
use crate::contact::flaps::Flaps;
use crate::contact::mesh::find_falling;
use crate::creased_only::CreasedOnly;
use crate::grid::Side;
use crate::models::sheet::{Sheet, SheetCrease};
use crate::stock::Stock;
use crate::surface::Surface;
use crate::turn::TurnModel;
use course::Course;
use held_shut::HeldShut;
use opening::Opening;

/// How far a released leaf's swing is looked at to choose its side, seconds.
const LOOK_AHEAD: f32 = 0.12;

/// Part of the way to the leaf's direction that the clamp does not go in a tick; in a step
/// it is the root of it.
const CLAMP_STAYS: f32 = 0.75;

/// Work of a search for contacts, nanoseconds of native code.
const SEARCH: u32 = 40_000;

/// One leaf of paper between two piles.
pub struct Leaf {
    sheet: Sheet,
    /// Its sheet's steps in a tick.
    steps: u32,
    /// Part of the way to the leaf's direction that the clamp goes in a step.
    clamp_follows: f32,
    paper: Paper,
    /// How straight it lies on a pile, 0 to 1, and its own bend out of the gutter where it
    /// is not the one of all others.
    straightness: f32,
    gutter: Option<Gutter>,
    phase: Phase,
    /// Where each grab that holds the leaf pulls, in book space, and what it holds.
    pulls: [Option<[f32; 3]>; MAX_GRABS],
    hold_of: [[f32; 2]; MAX_GRABS],
    course: Option<Course>,
    /// Ticks since a grab that holds it did something, or since it was let go where creases may
    /// hold it up, and the mean way of its nodes in a tick since then, metres.
    watched_ticks: u32,
    drift: Vec<f32>,
    /// Seconds of easing to rest so far, once it has landed.
    settling: Option<f32>,
    /// How long that takes, seconds.
    settle_time: f32,
    /// Seconds after which it is due on its side, 0 once they have gone by; None where its weight
    /// decides alone.
    due: Option<f32>,
    /// Ticks since it was let go.
    fallen: u32,
    /// Whether a grab of its own has turned it over since it was last sent elsewhere, as
    /// it lay on the other side.
    turned_over: bool,
    /// Whether the limit on its fall, and not its own motion, brought it to rest.
    put_down: bool,
    /// Angle by which it is lowered about the spine while it is eased to rest, radians; 0 where
    /// its nodes go there straight.
    lowering: f32,
    /// Fraction of the half turn done and its rate of change, 1/s.
    turned: f32,
    turn_rate: f32,
    clamp: f32,
    /// Fractions of the half turn between which grabs may pull.
    room: [f32; 2],
    in_book: BookSpaceLeaf,
    /// Its parts between creases; None where it has none.
    flaps: CreasedOnly<Flaps>,
    /// How creases open that were pressed shut; None where none do.
    opening: CreasedOnly<Opening>,
    /// How far its folds are held shut.
    shut: HeldShut,
    /// Whether it is eased to where it lies pressed flat, to open its folds anew from there, and
    /// whether it has since it was last held, played or laid.
    opens_anew: bool,
    was_opened_anew: bool,
    /// For each row the outermost node that is not folded over.
    edge: Vec<usize>,
    /// Where it landed, and the nodes of a flat leaf on the right.
    landed: Vec<f32>,
    flat: Vec<f32>,
    /// Where it is eased to rest.
    rest: Vec<f32>,
    /// Whether it falls upon folds, which may hold it up from where it comes to rest.
    is_held_up: bool,
    /// Its nodes before a tick.
    kept: Vec<f32>,
    kept_depth: f32,
    /// Searches for contacts since its work was last taken.
    searches: u32,
}

impl Leaf {
    /// A leaf of `width` x `height` metres at rest on the right, drawn at the
    /// columns `u` and at `rows` even rows. It lies on a pile as straight as `straightness`
    /// (0 to 1) says.
    pub fn new(
        [width, height]: [f64; 2],
        paper: &Paper,
        straightness: f32,
        (u, rows): (&[f32], usize),
    ) -> Leaf {
        let settings = paper.sheet([width, height]);
        let cell = [
            width as f32 / (NODES[0] - 1) as f32,
            height as f32 / (NODES[1] - 1) as f32,
        ];
        // Not `expect`: that would link the formatting of the error's numbers into the WASM.
        let Ok(mut sheet) = Sheet::new(settings) else {
            panic!("a book's sizes make a sheet");
        };
        let v: Vec<f32> = (0..rows).map(|j| j as f32 / (rows - 1) as f32).collect();
        sheet.draw_samples(u, &v);
        let flat = sheet.positions().to_vec();
        let steps = paper.steps(width);
        Leaf {
            sheet,
            steps,
            clamp_follows: 1.0 - libm::powf(CLAMP_STAYS, 1.0 / steps as f32),
            paper: *paper,
            straightness,
            gutter: (straightness > 0.0).then(|| Gutter::new(NODES[0], u)),
            phase: Phase::Resting(Side::Right),
            pulls: [None; MAX_GRABS],
            hold_of: [[1.0; 2]; MAX_GRABS],
            course: None,
            watched_ticks: 0,
            drift: vec![0.0; flat.len()],
            settling: None,
            settle_time: 0.0,
            due: None,
            fallen: 0,
            turned_over: false,
            put_down: false,
            lowering: 0.0,
            turned: 0.0,
            turn_rate: 0.0,
            clamp: 0.0,
            room: [0.0, 1.0],
            in_book: BookSpaceLeaf::new(NODES[0], NODES[1], cell),
            flaps: CreasedOnly::NONE,
            opening: CreasedOnly::NONE,
            shut: HeldShut::default(),
            opens_anew: false,
            was_opened_anew: false,
            edge: (1..=NODES[1]).map(|row| row * NODES[0] - 1).collect(),
            landed: flat.clone(),
            rest: flat.clone(),
            is_held_up: false,
            kept: flat.clone(),
            kept_depth: 0.0,
            searches: 0,
            flat,
        }
    }

    /// Creases the leaf along lines in place of those that it has, where it is. Returns
    /// whether it can be; if not, it is as it was.
    pub fn crease(&mut self, lines: &[SheetCrease]) -> bool {
        if self.sheet.crease(lines).is_err() {
            return false;
        }
        self.opening = CreasedOnly::NONE;
        self.shut = HeldShut::default();
        self.flat = self.sheet.flat_places();
        self.flaps = Flaps::of(&self.sheet).into();
        self.in_book.has_folds = false;
        let triangles = self.sheet.node_triangles().into_iter();
        self.in_book.falling = find_falling(triangles, NODES[0], NODES[0] * NODES[1]);
        let places = self.flat.chunks_exact(3 * NODES[0]).enumerate();
        let [width, height] = [self.sheet.settings().width, self.sheet.settings().height];
        self.edge = places
            .map(|(row, places)| {
                let is_whole = |column: &usize| {
                    let u = places[3 * column] / width as f32;
                    let v = places[3 * column + 1] / height as f32;
                    !self.sheet.is_beyond_crease([u, v])
                };
                let outermost = (1..NODES[0]).rev().find(is_whole).unwrap_or(1);
                row * NODES[0] + outermost
            })
            .collect();
        true
    }

    /// Whether the leaf is creased.
    pub fn is_creased(&self) -> bool {
        self.sheet.is_creased()
    }

    /// The creases that are folded beyond a right angle, as a set of bits.
    pub fn shut_creases(&self) -> u16 {
        self.flaps()
            .map_or(0, |flaps| flaps.shut(&self.in_book.points))
    }

    /// Its parts between creases; None where it has none.
    pub fn flaps(&self) -> Option<&Flaps> {
        self.flaps.as_ref()
    }

    /// Notes how creases rest that the hand which holds the leaf has opened: what is folded over
    /// lies on that side from then on.
    fn follow_rests(&mut self) {
        let Some(flaps) = self.flaps.as_mut() else {
            return;
        };
        for (number, crease) in self.sheet.creases().iter().enumerate() {
            flaps.press(number, crease.rest as f32);
        }
    }

    /// Lays the leaf still on a side, flat but for its creases.
    pub fn lay(&mut self, side: Side) {
        self.end_opening();
        self.was_opened_anew = false;
        self.release_shut();
        self.sheet.lay_folded(side);
        self.lie(side);
    }

    /// Lets a creased leaf lie still on a side where its nodes are `at`.
    fn lay_at(&mut self, side: Side, at: &[f32]) {
        self.sheet.put_back(at);
        self.lie(side);
        self.turned = self.measure_fraction();
    }

    fn lie(&mut self, side: Side) {
        self.sheet.loads_mut().fill(0.0);
        self.pulls = [None; MAX_GRABS];
        self.course = None;
        self.settling = None;
        (self.turned_over, self.put_down) = (false, false);
        self.opens_anew = false;
        let left = side == Side::Left;
        self.turned = if left { 1.0 } else { 0.0 };
        self.clamp = if left { core::f32::consts::PI } else { 0.0 };
        self.turn_rate = 0.0;
        self.in_book.forget();
        self.kept.copy_from_slice(self.sheet.positions());
        self.phase = Phase::Resting(side);
    }

    /// What the leaf is doing.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// How far the fore-edge has turned: 0 on the right, 1 on the left.
    pub fn fraction_turned(&self) -> f32 {
        self.turned
    }

    /// Whether a grab has held it since it last lay still, and may have crumpled it.
    pub fn was_held(&self) -> bool {
        self.in_book.was_held
    }

    /// The leaf's nodes in the book, as of the last [`bend_into_gutter`](Self::bend_into_gutter).
    pub fn in_book_space(&self) -> &BookSpaceLeaf {
        &self.in_book
    }

    /// The sheet itself.
    pub fn sheet(&self) -> &Sheet {
        &self.sheet
    }

    /// Writes the leaf's surface, over a flat table (see [`bend_into_gutter`](super::bend_into_gutter())).
    pub fn write_surface(&mut self, surface: &mut Surface) {
        self.sheet.write_surface(surface);
    }

    /// The side on which the leaf will be in a moment if it goes on as it does.
    fn side_ahead(&self) -> Side {
        if self.turned + LOOK_AHEAD * self.turn_rate > 0.5 {
            Side::Left
        } else {
            Side::Right
        }
    }

    /// Its stock, and how straight it lies on a pile, 0 to 1.
    pub fn kind(&self) -> (Stock, f32) {
        (self.paper.stock, self.straightness)
    }

    /// How straight it lies on a pile, 0 to 1.
    pub fn straightness(&self) -> f32 {
        self.straightness
    }

    /// Finds how the piles (right and left) bend it out of the gutter in a tick.
    pub fn bend_over(&mut self, piles: [&Pile; 2]) {
        if let Some(gutter) = &mut self.gutter {
            let [right, left] = piles.map(|pile| pile.angles_for(self.straightness));
            gutter.update(&right, &left);
        }
    }

    /// Finds where the leaf's nodes are in the book, which has a `gutter` for those that have
    /// none of their own.
    pub fn bend_into_gutter(&mut self, gutter: &Gutter) {
        let in_book = &mut self.in_book;
        let gutter = self.gutter.as_ref().unwrap_or(gutter);
        gutter.bend(self.sheet.positions(), in_book);
        self.shut.lay_in_book(in_book);
        let velocities = self.sheet.velocities().as_chunks::<3>().0;
        let states = in_book.velocities.iter_mut().zip(velocities);
        for ((own, v), [cos, sin]) in states.zip(&in_book.turned) {
            *own = [cos * v[0] - sin * v[2], v[1], sin * v[0] + cos * v[2]];
        }
        if let Some(flaps) = self.flaps.as_ref() {
            in_book.has_folds = flaps.face_as_the_rest(&in_book.points, &mut in_book.normals);
            if in_book.has_folds {
                in_book.bound_rows();
            }
        }
    }

    /// Finds what the leaf touches: the piles (right, left), its neighbours (left,
    /// right) and, where `itself` says so, its own other parts.
    pub fn detect_contacts(
        &mut self,
        piles: [&Pile; 2],
        neighbours: [Option<Neighbour<'_>>; 2],
        itself: bool,
    ) {
        self.searches += 1;
        if let (true, Some(flaps)) = (itself, self.flaps.as_ref()) {
            if self.shut.is_stacked {
                self.sheet.touch(Vec::new());
            } else {
                flaps.touch(&mut self.sheet, self.steps);
            }
        }
        let friction = self.sheet.settings().stock.friction as f32;
        let (flat, contacts) = self.sheet.contact_state();
        let mut sheet = ContactView {
            flat,
            contacts,
            friction,
        };
        detect_contacts(&mut self.in_book, piles, neighbours, &mut sheet);
        if itself && self.flaps.is_none() {
            detect_self_contacts(&mut self.in_book, &mut sheet);
        }
    }

    /// Returns the work since it was last asked, in about nanoseconds of native code, as it
    /// is counted by the sheet, and by searches for contacts.
    pub fn take_work(&mut self) -> u32 {
        let searches = SEARCH * core::mem::take(&mut self.searches);
        self.sheet.take_work().saturating_add(searches)
    }

    /// Brings what a tick drove deep into piles or firm neighbours back out.
    pub fn push_out(&mut self) {
        if !self.is_down() {
            self.sheet.push_out();
        }
    }

    /// Ends a tick: grabs give way to what the leaf is still deeper in than
    /// `deep`, metres.
    pub fn give_way(&mut self, deep: f32) {
        if self.in_book.depth > deep {
            self.sheet.give_way();
        }
    }

    /// Keeps where the leaf is, to come [back](Self::step_back).
    pub fn keep(&mut self) {
        // A whole tick's way: what a step drives into others is brought out again after it.
        if matches!(self.phase, Phase::Falling(_)) && self.may_be_held_up() {
            self.watch();
        }
        self.kept.clear();
        self.kept.extend_from_slice(self.sheet.positions());
        self.kept_depth = self.in_book.depth;
    }

    /// Whether it has come deeper than `deep` metres into something since it was last
    /// [kept](Self::keep).
    pub fn has_sunk(&self, deep: f32) -> bool {
        self.in_book.depth > deep.max(self.kept_depth)
    }

    /// Takes back what it did since it was last [kept](Self::keep): it is there
    /// again, and still. Neighbours that nodes of it seem deeper in than `deep` metres are
    /// not minded at the next: none can be, and it would be taken back for ever.
    pub fn step_back(&mut self, gutter: &Gutter, deep: f32) {
        self.sheet.put_back(&self.kept);
        self.sheet.give_way();
        self.in_book.depth = self.kept_depth;
        self.in_book.forget_deep(deep);
        self.bend_into_gutter(gutter);
    }

    /// Says whether it falls upon folds, which may hold it up from where it comes to rest.
    pub fn set_held_up(&mut self, is_held_up: bool) {
        self.is_held_up = is_held_up;
    }

    /// Wakes a leaf that rested upon one that moves now.
    pub fn wake(&mut self) {
        if let Phase::Resting(side) = self.phase {
            self.fall(side, self.paper.assist.then_some(0.0));
        }
    }

    /// Whether the limit on the time of a fall eases it to rest, or has.
    pub fn was_put_down(&self) -> bool {
        self.put_down
    }

    /// Whether it lies still, or is about to.
    pub fn is_down(&self) -> bool {
        matches!(self.phase, Phase::Resting(_)) || self.settling.is_some()
    }

    /// Steps by one tick of [`TICK`] seconds. `supported` says whether what lies
    /// under it, where it goes, is down; only then may it come to rest. `has_way` says
    /// whether no other lies upon it in its way there; only then may it be turned over.
    /// `is_pressed` says whether another comes down upon its folds, or leaves them.
    pub fn step(&mut self, supported: bool, has_way: bool, is_pressed: bool) {
        let before = self.turned;
        // A hand opens folds that it holds, and nothing else does.
        self.sheet
            .let_yield(self.phase == Phase::Held && self.opening.is_none());
        if !matches!(self.phase, Phase::Resting(_)) && !self.hold_shut(is_pressed) {
            self.step_opening();
        }
        self.come_due();
        match self.phase {
            Phase::Resting(_) => return,
            Phase::Held => {
                self.step_held();
                self.follow_rests();
            }
            Phase::Falling(side) => self.step_falling(side, supported, has_way),
            Phase::Playing(side) => self.step_playing(side),
        }
        if let Phase::Resting(_) = self.phase {
            return;
        }
        self.lay_shut();
        self.slow_opening();
        self.turned = self.measure_fraction();
        // Smoothed over about 30 ms: a grab's last twitch is not its throw.
        let rate = (self.turned - before) / TICK;
        self.turn_rate += (rate - self.turn_rate) * 0.3;
    }

    fn step_sheet(&mut self) {
        for left in (1..=self.steps).rev() {
            let wanted = self.root_angle();
            self.clamp += (wanted - self.clamp) * self.clamp_follows;
            self.sheet.set_clamp_angle(self.clamp);
            self.sheet.step_of(left);
        }
    }

    /// Mean over the rows of the angle at which the leaf leaves the spine.
    fn root_angle(&self) -> f32 {
        let rows = self.sheet.positions().chunks_exact(3 * NODES[0]);
        let sum: f32 = rows.map(|row| libm::atan2f(row[8].max(0.0), row[6])).sum();
        sum / NODES[1] as f32
    }

    /// Mean over the fore-edge, and the folds that are in its place, of how far it has turned.
    fn measure_fraction(&self) -> f32 {
        let nodes = self.sheet.positions().as_chunks::<3>().0;
        let edge = self.edge.iter().map(|node| nodes[*node]);
        let sum: f32 = edge.map(|[x, _, z]| fraction_turned(x, z)).sum();
        sum / NODES[1] as f32
    }
}
