//! The leaf in flight: held by hands, falling, or turned by a hand of its own.
//!
//! It is a [`Sheet`] over a flat table, hinged along a straight spine; the
//! gutter's bend is added where it meets the book and where it is drawn (see
//! [`seat`](super::seat())). A played turn is a hand too: it takes the leaf
//! near its corner, carries it over and lets go, so that whatever happens to
//! the leaf meanwhile happens to paper.

mod course;
mod fall;
mod play;
#[cfg(test)]
mod tests;

use super::block::Pile;
use super::gutter::Gutter;
use super::limits::{MAX_GRABS, NODES, TICK};
use super::meet::{Neighbour, Sheetlike, meet_itself, meet_others};
use super::paper::Paper;
use super::phase::Phase;
use super::seat::share_turned;
use super::seated::Seated;
use crate::grid::Side;
use crate::models::sheet::{Sheet, SheetSettings};
use crate::surface::Surface;
use crate::turn::TurnModel;
use course::Course;

/// How far a released leaf's swing is looked at to choose its side, seconds.
const LOOK_AHEAD: f32 = 0.12;

/// A hand that has the inverse of this share of the half turn for its leaf between
/// others is free.
const ROOMY: f32 = 2.5;

/// Part of the way to the leaf's direction that the clamp does not go in a tick; in a step
/// it is the root of it.
const CLAMP_STAYS: f32 = 0.75;

/// Farther than this from the spine no hand pulls, metres.
const FARTHEST: f32 = 1e3;

/// One leaf of paper between two piles.
pub struct Leaf {
    sheet: Sheet,
    /// How many leaves are in the air, and its sheet's steps in a tick then.
    flying: usize,
    steps: u32,
    /// Part of the way to the leaf's direction that the clamp goes in a step.
    clamp_follows: f32,
    paper: Paper,
    phase: Phase,
    /// Where each hand that holds the leaf pulls, in book space, and what it holds.
    hands: [Option<[f32; 3]>; MAX_GRABS],
    hold_of: [[f32; 2]; MAX_GRABS],
    course: Option<Course>,
    /// Seconds of easing to rest so far, once it has landed.
    settling: Option<f32>,
    /// How hard it is helped over: 1 after a hand, more after a quick turn.
    haste: f32,
    /// Ticks since it was let go.
    fallen: u32,
    /// Whether a hand of its own has turned it over since it was last sent elsewhere, as
    /// it lay on the other side.
    turned_over: bool,
    /// Whether the limit on its fall, and not its own motion, brought it to rest.
    put_down: bool,
    /// Share of the half turn done and its rate of change, 1/s.
    share: f32,
    share_rate: f32,
    clamp: f32,
    /// Shares of the half turn between which hands may pull.
    room: [f32; 2],
    seated: Seated,
    /// Where it landed, and the nodes of a flat leaf on the right.
    landed: Vec<f32>,
    flat: Vec<f32>,
    /// Its nodes before a tick.
    kept: Vec<f32>,
    kept_depth: f32,
}

impl Leaf {
    /// A leaf of `width` x `height` metres at rest on the right, drawn at the
    /// columns `u` and at `rows` even rows.
    pub fn new([width, height]: [f64; 2], paper: &Paper, u: &[f32], rows: usize) -> Leaf {
        let settings = paper.sheet([width, height], 1);
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
        let mut leaf = Leaf {
            sheet,
            flying: 1,
            steps: 0,
            clamp_follows: 0.0,
            paper: *paper,
            phase: Phase::Resting(Side::Right),
            hands: [None; MAX_GRABS],
            hold_of: [[1.0; 2]; MAX_GRABS],
            course: None,
            settling: None,
            haste: 1.0,
            fallen: 0,
            turned_over: false,
            put_down: false,
            share: 0.0,
            share_rate: 0.0,
            clamp: 0.0,
            room: [0.0, 1.0],
            seated: Seated::new(NODES[0], NODES[1], cell),
            landed: flat.clone(),
            kept: flat.clone(),
            kept_depth: 0.0,
            flat,
        };
        leaf.set_steps(paper.steps(width, 1));
        leaf
    }

    /// Says how many leaves are in the air, which its steps depend on.
    pub fn set_flying(&mut self, flying: usize) {
        if flying == self.flying {
            return;
        }
        self.flying = flying;
        let [width, height] = [self.sheet.settings().width, self.sheet.settings().height];
        let settings = self.paper.sheet([width, height], flying);
        let pace = |of: &SheetSettings| (of.time_step, of.shear_sweeps);
        if pace(&settings) != pace(self.sheet.settings()) {
            self.set_steps(self.paper.steps(width, flying));
            self.sheet.pace(&settings);
        }
    }

    fn set_steps(&mut self, steps: u32) {
        self.steps = steps;
        self.clamp_follows = 1.0 - libm::powf(CLAMP_STAYS, 1.0 / steps as f32);
    }

    /// Lays the leaf flat and still on a side.
    pub fn lay(&mut self, side: Side) {
        self.sheet.lay_flat(side);
        self.sheet.loads_mut().fill(0.0);
        self.hands = [None; MAX_GRABS];
        self.course = None;
        self.settling = None;
        (self.turned_over, self.put_down) = (false, false);
        let left = side == Side::Left;
        self.share = if left { 1.0 } else { 0.0 };
        self.clamp = if left { core::f32::consts::PI } else { 0.0 };
        self.share_rate = 0.0;
        self.seated.forget();
        self.phase = Phase::Resting(side);
    }

    /// What the leaf is doing.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// How far the fore-edge has turned: 0 on the right, 1 on the left.
    pub fn share_turned(&self) -> f32 {
        self.share
    }

    /// Whether a hand has held it since it last lay still, and may have crumpled it.
    pub fn was_held(&self) -> bool {
        self.seated.was_held
    }

    /// The leaf's nodes in the book, as of the last [`seat`](Self::seat).
    pub fn seated(&self) -> &Seated {
        &self.seated
    }

    /// The sheet itself.
    pub fn sheet(&self) -> &Sheet {
        &self.sheet
    }

    /// Writes the leaf's surface, over a flat table (see [`seat`](super::seat())).
    pub fn write_surface(&mut self, surface: &mut Surface) {
        self.sheet.write_surface(surface);
    }

    /// A hand takes hold at (`u`, `v`). Whatever the leaf was doing, it goes on
    /// from where it is.
    pub fn grab(&mut self, hand: u32, u: f32, v: f32) {
        let Some(own) = self.hands.get_mut(hand as usize) else {
            return;
        };
        if !u.is_finite() || !v.is_finite() {
            return;
        }
        // Next to the spine a hand would only tear at the binding.
        let u = u.clamp(0.25, 1.0);
        self.sheet.grab(hand, u, v);
        self.hold_of[hand as usize] = [u, v.clamp(0.0, 1.0)];
        // Until it pulls somewhere it stays where it is.
        *own = None;
        if !matches!(self.phase, Phase::Held) {
            self.drop_course();
            self.settling = None;
            self.seated.was_held = true;
            self.phase = Phase::Held;
        }
    }

    /// The hand pulls to `place`, in book space, metres; within a kilometre.
    pub fn hold(&mut self, hand: u32, place: [f32; 3]) {
        let is_held = self.sheet.held_place(hand).is_some();
        if let Some(own) = self.hands.get_mut(hand as usize)
            && is_held
            && place.iter().all(|x| x.is_finite())
        {
            *own = Some(place.map(|x| x.clamp(-FARTHEST, FARTHEST)));
        }
    }

    /// The hand lets go. When no other is left the leaf falls to the side that
    /// its swing takes it.
    pub fn release(&mut self, hand: u32) {
        if hand as usize >= MAX_GRABS || self.sheet.held_place(hand).is_none() {
            return;
        }
        self.sheet.release(hand);
        self.hands[hand as usize] = None;
        let is_held = (0..MAX_GRABS as u32).any(|hand| self.sheet.held_place(hand).is_some());
        if !is_held && self.phase == Phase::Held {
            self.fall(self.side_ahead(), 1.0);
        }
    }

    /// The side on which the leaf will be in a moment if it goes on as it does.
    fn side_ahead(&self) -> Side {
        if self.share + LOOK_AHEAD * self.share_rate > 0.5 {
            Side::Left
        } else {
            Side::Right
        }
    }

    /// Finds where the leaf's nodes are in the book.
    pub fn seat(&mut self, gutter: &Gutter) {
        let seated = &mut self.seated;
        gutter.seat(self.sheet.positions(), seated);
        let velocities = self.sheet.velocities().as_chunks::<3>().0;
        let states = seated.velocities.iter_mut().zip(velocities);
        for ((own, v), [cos, sin]) in states.zip(&seated.turned) {
            *own = [cos * v[0] - sin * v[2], v[1], sin * v[0] + cos * v[2]];
        }
    }

    /// Finds what the leaf touches: the piles (right, left), its neighbours (left,
    /// right) and, where `itself` says so, its own other parts.
    pub fn meet(
        &mut self,
        piles: [&Pile; 2],
        neighbours: [Option<Neighbour<'_>>; 2],
        itself: bool,
    ) {
        let friction = self.sheet.settings().stock.friction as f32;
        let (flat, contacts) = self.sheet.contact_state();
        let mut sheet = Sheetlike {
            flat,
            contacts,
            friction,
        };
        meet_others(&mut self.seated, piles, neighbours, &mut sheet);
        if itself {
            meet_itself(&mut self.seated, &mut sheet);
        }
    }

    /// Brings what a tick drove deep into piles or firm neighbours back out.
    pub fn push_out(&mut self) {
        if !self.is_down() {
            self.sheet.push_out();
        }
    }

    /// Ends a tick: hands give way to what the leaf is still deeper in than
    /// `deep`, metres.
    pub fn give_way(&mut self, deep: f32) {
        if self.seated.depth > deep {
            self.sheet.give_way();
        }
    }

    /// Keeps where the leaf is, to come [back](Self::step_back).
    pub fn keep(&mut self) {
        self.kept.clear();
        self.kept.extend_from_slice(self.sheet.positions());
        self.kept_depth = self.seated.depth;
    }

    /// Whether it has come deeper than `deep` metres into something since it was last
    /// [kept](Self::keep).
    pub fn has_sunk(&self, deep: f32) -> bool {
        self.seated.depth > deep.max(self.kept_depth)
    }

    /// Takes back what it did since it was last [kept](Self::keep): it is there
    /// again, and still. Neighbours that nodes of it seem deeper in than `deep` metres are
    /// not minded at the next: none can be, and it would be taken back for ever.
    pub fn step_back(&mut self, gutter: &Gutter, deep: f32) {
        self.sheet.put_back(&self.kept);
        self.sheet.give_way();
        self.seated.depth = self.kept_depth;
        self.seated.forget_deep(deep);
        self.seat(gutter);
    }

    /// Wakes a leaf that rested upon one that moves now.
    pub fn wake(&mut self) {
        if let Phase::Resting(side) = self.phase {
            self.fall(side, 1.0);
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
    pub fn step(&mut self, supported: bool, has_way: bool) {
        let before = self.share;
        match self.phase {
            Phase::Resting(_) => return,
            Phase::Held => self.step_held(),
            Phase::Falling(side) => self.step_falling(side, supported, has_way),
            Phase::Playing(side) => self.step_playing(side),
        }
        if let Phase::Resting(_) = self.phase {
            return;
        }
        self.share = self.measure_share();
        // Smoothed over about 30 ms: a hand's last twitch is not its throw.
        let rate = (self.share - before) / TICK;
        self.share_rate += (rate - self.share_rate) * 0.3;
    }

    /// Says between which shares of the half turn hands may pull: where no other
    /// leaf in flight is.
    pub fn set_room(&mut self, room: [f32; 2]) {
        self.room = room;
    }

    fn step_held(&mut self) {
        for hand in 0..MAX_GRABS as u32 {
            if let Some(place) = self.hands[hand as usize] {
                let place = self.guided(self.hold_of[hand as usize], place);
                let place = self.over_table(hand, place);
                self.sheet.pull(hand, place);
            }
        }
        self.step_sheet();
    }

    /// Where a hand at (`u`, `v`) of the leaf pulls that would like to pull to a
    /// place. Beside others in flight it is guided: between them, and the less room
    /// they leave the nearer to where a stiff leaf would have it, so that it neither
    /// draws the leaf through them nor crumples it against them.
    fn guided(&self, [u, v]: [f32; 2], place: [f32; 3]) -> [f32; 3] {
        let [least, most] = self.room;
        let freedom = ((most - least) * ROOMY).min(1.0);
        if freedom == 1.0 && least == 0.0 && most == 1.0 {
            return place;
        }
        let [x, y, z] = place;
        let angle = share_turned(x, z).max(least).min(most) * core::f32::consts::PI;
        let settings = self.sheet.settings();
        let radius = u * settings.width as f32;
        let freed = |guide: f32, free: f32| guide + freedom * (free - guide);
        let far = freed(radius, (x * x + z * z).sqrt());
        let (sin, cos) = libm::sincosf(angle);
        [far * cos, freed(v * settings.height as f32, y), far * sin]
    }

    fn step_sheet(&mut self) {
        for left in (1..=self.steps).rev() {
            let wanted = self.root_angle();
            self.clamp += (wanted - self.clamp) * self.clamp_follows;
            self.sheet.set_clamp_angle(self.clamp);
            self.sheet.step_of(left);
        }
    }

    /// The leaf's sheet turns over a flat table; in the book the gutter moves
    /// what is held. What lies between the two is taken off a hand's place.
    fn over_table(&self, hand: u32, place: [f32; 3]) -> [f32; 3] {
        let Some(held) = self.sheet.held_place(hand) else {
            return place;
        };
        let flat = self.sheet.positions().as_chunks::<3>().0;
        let distance = |p: &[f32; 3]| {
            let d = [p[0] - held[0], p[1] - held[1], p[2] - held[2]];
            d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
        };
        let (mut node, mut least) = (0, f32::MAX);
        for (k, point) in flat.iter().enumerate() {
            if distance(point) < least {
                (node, least) = (k, distance(point));
            }
        }
        let seated = self.seated.points[node];
        [0, 1, 2].map(|axis| place[axis] - (seated[axis] - flat[node][axis]))
    }

    /// Mean over the rows of the angle at which the leaf leaves the spine.
    fn root_angle(&self) -> f32 {
        let rows = self.sheet.positions().chunks_exact(3 * NODES[0]);
        let sum: f32 = rows.map(|row| libm::atan2f(row[8].max(0.0), row[6])).sum();
        sum / NODES[1] as f32
    }

    /// Mean over the fore-edge of how far it has turned.
    fn measure_share(&self) -> f32 {
        let rows = self.sheet.positions().chunks_exact(3 * NODES[0]);
        let end = 3 * (NODES[0] - 1);
        let sum: f32 = rows.map(|row| share_turned(row[end], row[end + 2])).sum();
        sum / NODES[1] as f32
    }
}
