//! One leaf in flight: its model, what is drawn of it, and the hands on it.

use super::HANDS;
use super::block::column_at;
use super::leaf::{Leaf, Phase};
use crate::grid::Side;
use crate::surface::Surface;

/// A hand on a leaf: where it took hold, and where it pulls to, if it does yet.
#[derive(Clone, Copy, Debug)]
struct Touch {
    u: f32,
    v: f32,
    place: Option<[f32; 3]>,
}

/// One leaf in flight; it may stand for several.
#[derive(Clone)]
pub struct Flight {
    id: u32,
    low: u32,
    high: u32,
    leaf: Leaf,
    surface: Surface,
    touches: [Option<Touch>; HANDS],
    /// The hand that the leaf follows: it follows one at a time.
    leader: usize,
}

impl Flight {
    /// A flight of a leaf, drawn at `columns` x `rows` points.
    pub fn new(leaf: Leaf, columns: usize, rows: usize) -> Flight {
        Flight {
            id: 0,
            low: 0,
            high: 0,
            leaf,
            surface: Surface::new(columns, rows),
            touches: [None; HANDS],
            leader: 0,
        }
    }

    /// Begins at rest on side `from`: `low` leaves lie left of it, `high` with it.
    pub fn take_up(&mut self, id: u32, from: Side, low: u32, high: u32) {
        (self.id, self.low, self.high) = (id, low, high);
        self.touches = [None; HANDS];
        self.leaf.lay(from);
    }

    /// Its number.
    pub fn id(&self) -> u32 {
        self.id
    }

    /// Leaves on the left of the book when it lies on the left.
    pub fn high(&self) -> u32 {
        self.high
    }

    /// What it is doing.
    pub fn phase(&self) -> Phase {
        self.leaf.phase()
    }

    /// The leaves that it stands for, by how far it has turned.
    pub fn leaves_turned(&self) -> f32 {
        self.leaf.share_turned() * (self.high - self.low) as f32
    }

    /// What is drawn of it.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// What is drawn of it, as its leaf is now, over a flat table.
    pub fn flat_surface(&mut self) -> &mut Surface {
        self.leaf.write_surface(&mut self.surface);
        &mut self.surface
    }

    /// A hand takes hold at (`u`, `v`).
    pub fn grab(&mut self, hand: u32, u: f32, v: f32) {
        let hand = hand as usize;
        if hand >= HANDS || !u.is_finite() || !v.is_finite() {
            return;
        }
        let is_free = self.touches.iter().all(Option::is_none);
        self.touches[hand] = Some(Touch { u, v, place: None });
        if is_free || self.leader == hand {
            self.follow(hand);
        }
    }

    /// The hand pulls to `place`, in book space, metres.
    pub fn hold(&mut self, hand: u32, place: [f32; 3]) {
        let hand = hand as usize;
        // Asked before the clamp below, which would take what is no number for 0.
        if !place.iter().all(|x| x.is_finite()) {
            return;
        }
        let Some(Some(touch)) = self.touches.get_mut(hand) else {
            return;
        };
        touch.place = Some(place);
        if self.leader == hand {
            self.pull(place);
        }
    }

    /// The hand lets go. When no other is left the leaf falls.
    pub fn release(&mut self, hand: u32) {
        let hand = hand as usize;
        if !self.touches.get(hand).is_some_and(Option::is_some) {
            return;
        }
        self.touches[hand] = None;
        match self.touches.iter().position(Option::is_some) {
            None => self.leaf.release(),
            Some(other) if self.leader == hand => self.follow(other),
            Some(_) => {}
        }
    }

    /// Takes the leaf to a side, out of every hand.
    pub fn play(&mut self, to: Side, seconds: f32) {
        self.touches = [None; HANDS];
        self.leaf.play(to, seconds);
    }

    /// Steps by one tick.
    pub fn step(&mut self) {
        self.leaf.step(1);
    }

    fn follow(&mut self, hand: usize) {
        self.leader = hand;
        let Some(touch) = self.touches[hand] else {
            return;
        };
        self.leaf.grab(touch.u, touch.v);
        if let Some(place) = touch.place {
            self.pull(place);
        }
    }

    /// The model's leaf turns over a flat table; the piles lift the drawn one.
    /// What lies between the two is taken off the hand's place.
    fn pull(&mut self, place: [f32; 3]) {
        let node = self.leaf.grabbed_point();
        let (u, v) = self.leaf.grabbed_at();
        let lift = (self.drawn_at(u, v)[2] - node[2]).max(0.0);
        self.leaf
            .hold([place[0], place[1], (place[2] - lift).max(0.0)]);
    }

    /// The drawn place of a point of the leaf, by the nearest point of the mesh.
    fn drawn_at(&self, u: f32, v: f32) -> [f32; 3] {
        let (columns, rows) = (self.surface.columns, self.surface.rows);
        let column = column_at(u, columns);
        let row = libm::roundf(v.clamp(0.0, 1.0) * (rows - 1) as f32) as usize;
        self.surface.position(column, row)
    }
}
