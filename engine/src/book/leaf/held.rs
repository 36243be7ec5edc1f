//! A leaf held by grabs: how they take hold of it, pull it and let go, and when it sleeps.

use super::Leaf;
use crate::book::fraction_turned::fraction_turned;
use crate::book::limits::{FARTHEST, MAX_GRABS, TICK};
use crate::book::phase::Phase;

/// A grab that has the inverse of this fraction of the half turn for its leaf between
/// others is free.
const ROOMY: f32 = 2.5;

/// A held leaf sleeps when its nodes' mean velocity over about so many ticks is less than this
/// (m/s, the root of the mean square over them): a pixel, about 0.3 mm, a second. A swing that
/// turns back is as slow for as long where it goes less than 0.1 mm to either side (book
/// paper); what only trembles in contact has no such mean. The speed doubles with every so
/// many ticks since a grab last did something: without one a leaf loses its motion, and what
/// it keeps is the solver's.
const DROWSY: f32 = 3e-4;
const DROWSY_TICKS: u32 = 16;
const DOUBLING: u32 = 60;

impl Leaf {
    /// A grab takes hold at (`u`, `v`). Whatever the leaf was doing, it goes on
    /// from where it is.
    pub fn grab(&mut self, grab: u32, u: f32, v: f32) {
        self.end_open_anew();
        let Some(own) = self.pulls.get_mut(grab as usize) else {
            return;
        };
        if !u.is_finite() || !v.is_finite() {
            return;
        }
        // Next to the spine a grab would only tear at the binding.
        let u = u.clamp(0.25, 1.0);
        self.sheet.grab(grab, u, v);
        self.hold_of[grab as usize] = [u, v.clamp(0.0, 1.0)];
        // Until it pulls somewhere it stays where it is.
        *own = None;
        self.stay_awake();
        if !matches!(self.phase, Phase::Held) {
            self.drop_course();
            self.settling = None;
            self.in_book.was_held = true;
            self.was_opened_anew = false;
            self.phase = Phase::Held;
        }
    }

    /// The grab pulls to `place`, in book space, metres; within a kilometre.
    pub fn hold(&mut self, grab: u32, place: [f32; 3]) {
        let is_held = self.sheet.held_place(grab).is_some();
        if let Some(own) = self.pulls.get_mut(grab as usize)
            && is_held
            && place.iter().all(|x| x.is_finite())
        {
            let place = Some(place.map(|x| x.clamp(-FARTHEST, FARTHEST)));
            if *own != place {
                *own = place;
                self.stay_awake();
            }
        }
    }

    /// The grab lets go. When no other is left the leaf falls to the side that
    /// its swing takes it.
    pub fn release(&mut self, grab: u32) {
        if grab as usize >= MAX_GRABS || self.sheet.held_place(grab).is_none() {
            return;
        }
        self.sheet.release(grab);
        self.pulls[grab as usize] = None;
        self.stay_awake();
        let is_held = (0..MAX_GRABS as u32).any(|grab| self.sheet.held_place(grab).is_some());
        if !is_held && self.phase == Phase::Held {
            let side = self.side_ahead();
            self.fall(side, self.help_to(side));
        }
    }

    /// Wakes it from the sleep of a leaf that is held still.
    pub(super) fn stay_awake(&mut self) {
        self.watched_ticks = 0;
        self.drift.fill(0.0);
    }

    /// Whether it does not move until the next command: it rests, or grabs hold it and it
    /// lies as still as it will.
    pub fn is_asleep(&self) -> bool {
        match self.phase {
            Phase::Resting(_) => true,
            Phase::Held => self.opening.is_none() && self.lies_still(),
            Phase::Falling(_) | Phase::Playing(_) => false,
        }
    }

    /// Says between which fractions of the half turn grabs may pull: where no other
    /// leaf in flight is.
    pub fn set_room(&mut self, room: [f32; 2]) {
        self.room = room;
    }

    pub(super) fn step_held(&mut self) {
        for grab in 0..MAX_GRABS as u32 {
            if let Some(place) = self.pulls[grab as usize] {
                let place = self.guided(self.hold_of[grab as usize], place);
                let place = self.over_table(grab, place);
                self.sheet.pull(grab, place);
            }
        }
        self.step_sheet();
        self.watch();
    }

    /// Follows the mean velocity of its nodes since they were kept.
    pub(super) fn watch(&mut self) {
        self.watched_ticks = self.watched_ticks.saturating_add(1);
        let ways = self.sheet.positions().iter().zip(&self.kept);
        for (drift, (x, before)) in self.drift.iter_mut().zip(ways) {
            *drift += (x - before - *drift) / DROWSY_TICKS as f32;
        }
    }

    /// Whether its nodes' mean velocity says that it lies as still as it will.
    pub(super) fn lies_still(&self) -> bool {
        if self.watched_ticks < DROWSY_TICKS {
            return false;
        }
        let doublings = (self.watched_ticks / DOUBLING).min(24);
        let way = DROWSY * (1 << doublings) as f32 * TICK;
        let square: f32 = self.drift.iter().map(|x| x * x).sum();
        square < way * way * (self.drift.len() / 3) as f32
    }

    /// Whether all its nodes are as slow as those of one that lies still, in the last tick of as
    /// many as tell that of a swing that turns back: what has just come down lies still long
    /// before its mean velocity says so.
    pub(super) fn is_slow(&self) -> bool {
        self.watched_ticks >= DROWSY_TICKS && self.sheet.greatest_speed() < DROWSY
    }

    /// Where a grab at (`u`, `v`) of the leaf pulls that would like to pull to a
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
        let angle = fraction_turned(x, z).max(least).min(most) * core::f32::consts::PI;
        let settings = self.sheet.settings();
        let radius = u * settings.width as f32;
        let freed = |guide: f32, free: f32| guide + freedom * (free - guide);
        let far = freed(radius, (x * x + z * z).sqrt());
        let (sin, cos) = libm::sincosf(angle);
        [far * cos, freed(v * settings.height as f32, y), far * sin]
    }

    /// The leaf's sheet turns over a flat table; in the book the gutter moves
    /// what is held. What lies between the two is taken off a grab's place.
    fn over_table(&self, grab: u32, place: [f32; 3]) -> [f32; 3] {
        let Some(held) = self.sheet.held_place(grab) else {
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
        let in_book = self.in_book.points[node];
        [0, 1, 2].map(|axis| place[axis] - (in_book[axis] - flat[node][axis]))
    }
}
