//! A reader of a book: the commands that the viewer makes of what a reader does, as it does in
//! `turning.ts`, frame after frame.

use cpu_time::ThreadTime;
use turnleaf_engine::book::{Book, TICK};
use turnleaf_engine::{SheetCrease, Side};

use super::watch::{Frame, Watch, Watched};
use crate::gestures::creasing::measure_at_rest;
use crate::gestures::timed_folding::TimedFolding;

/// Longest that leaves may take to come to rest once a reader is done, frames.
const MOST_TO_REST: u32 = 600;

/// The viewer's: most leaves in flight, most of a held key's turns that wait, length of a turn,
/// least time between two leaves, seconds; leaves that a jump turns one by one, and leaves that fly
/// in a longer one.
const MOST_FLIGHTS: usize = 12;
const MOST_WAITING: usize = 3;
const SECONDS: f32 = 0.8;
const APART: f32 = 0.09 * SECONDS;
const MOST_SINGLE: u32 = 12;
const RIFFLED: u32 = 9;

/// Ticks of a frame.
const TICKS: u32 = 2;

/// A leaf in flight.
struct Flight {
    id: u32,
    low: u32,
    high: u32,
    to: Side,
}

/// A reader.
pub struct Reader {
    book: Book,
    /// Leaves of the book.
    leaves: u32,
    page: [f32; 2],
    /// From the left to the right.
    flights: Vec<Flight>,
    /// Spreads still to reach, a turn each.
    plan: Vec<u32>,
    /// Time since a leaf was picked up, seconds.
    since: f32,
    /// The flight that each grab holds.
    held: [Option<u32>; 2],
    /// The flight that was taken or caught last.
    taken: Option<u32>,
    /// A leaf that is being folded before the reader's eyes.
    folding: Option<TimedFolding>,
    watch: Watch,
}

impl Reader {
    /// One who begins to read an open book whose pages have this width and height, metres. Every so
    /// many pictures it is measured how deep leaves are drawn in each other.
    pub fn new((book, leaves): (Book, u32), page: [f32; 2], looked_at: usize) -> Reader {
        Reader {
            book,
            leaves,
            page,
            flights: Vec::new(),
            plan: Vec::new(),
            since: f32::INFINITY,
            held: [None; 2],
            taken: None,
            folding: None,
            watch: Watch::new(looked_at),
        }
    }

    /// Width and height of a page, metres.
    pub fn page(&self) -> [f32; 2] {
        self.page
    }

    /// How high the pages lie at a distance from the spine, metres.
    pub fn floor(&self, x: f32) -> f32 {
        let side = if x < 0.0 { Side::Left } else { Side::Right };
        self.book.pile(side).height(x.abs())
    }

    /// Whether anything is to be stepped.
    pub fn moves(&self) -> bool {
        !self.flights.is_empty() || !self.plan.is_empty()
    }

    /// Looks on until all lies at rest, for ten seconds at most.
    pub fn come_to_rest(&mut self) {
        for _ in 0..MOST_TO_REST {
            if !self.moves() {
                break;
            }
            self.frame();
        }
    }

    /// How deep what lies at rest is drawn in itself, metres.
    pub fn in_itself_at_rest(&self) -> f32 {
        measure_at_rest(&self.book, self.page).itself
    }

    /// Picks up the leaf on the right and folds it along lines, in place of its folds.
    pub fn fold(&mut self, lines: &[SheetCrease]) {
        let leaf = self.right_end();
        self.take(Side::Right);
        if self.taken.is_none() {
            return;
        }
        if let Some(folding) = TimedFolding::begin(&mut self.book, leaf, lines) {
            self.folding = Some(folding);
        }
    }

    /// Presses what is being folded by a tick.
    fn press_folds(&mut self) {
        let book = &mut self.book;
        self.folding.take_if(|folding| !folding.press(book));
    }

    /// What was seen.
    pub fn into_watched(self) -> Watched {
        self.watch.watched
    }

    /// A key, a click or a flick: turns one leaf on (1) or back (-1).
    pub fn press(&mut self, by: i32) {
        let to = if by > 0 { Side::Left } else { Side::Right };
        let is_back = |flight: &&Flight| flight.to != to;
        let back = match to {
            Side::Left => self.flights.iter().find(is_back),
            Side::Right => self.flights.iter().rfind(is_back),
        };
        if let Some(id) = back
            .map(|flight| flight.id)
            .filter(|_| self.plan.is_empty())
        {
            self.play(id, to);
        } else if self.plan.len() < MOST_WAITING {
            let last = self.plan.last().copied().unwrap_or(self.landing());
            self.plan.push(last.saturating_add_signed(by));
        }
    }

    /// Turns to a spread, or to the last.
    pub fn go_to(&mut self, spread: u32) {
        let spread = spread.min(self.leaves);
        for index in 0..self.flights.len() {
            let Flight { id, low, high, to } = self.flights[index];
            let wanted = if spread >= high {
                Side::Left
            } else if spread <= low {
                Side::Right
            } else {
                to
            };
            if wanted != to {
                self.play(id, wanted);
            }
        }
        let from = self.landing();
        let leaves = from.abs_diff(spread);
        let turns = if leaves > MOST_SINGLE {
            RIFFLED
        } else {
            leaves
        };
        let way = |turn: u32| {
            let (from, to) = (f64::from(from), f64::from(spread));
            (from + ((to - from) * f64::from(turn) / f64::from(turns)).round()) as u32
        };
        self.plan = (1..=turns).map(way).collect();
    }

    /// Takes up the leaf that lies uppermost on a side.
    pub fn take(&mut self, side: Side) {
        self.plan.clear();
        let (low, high) = match side {
            Side::Right => (self.right_end(), self.right_end() + 1),
            Side::Left => (self.left_end() - 1, self.left_end()),
        };
        self.taken = self.pick_up(side, low, high);
    }

    /// Takes hold of a leaf in the middle of those in flight where it is, by u and v.
    pub fn catch(&mut self, grab: u32, place: [f32; 2]) {
        self.plan.clear();
        self.taken = self
            .flights
            .get(self.flights.len() / 2)
            .map(|flight| flight.id);
        self.grab(grab, place);
    }

    /// Takes hold of what was taken or caught last, by u and v.
    pub fn grab(&mut self, grab: u32, [u, v]: [f32; 2]) {
        let Some(id) = self.taken else { return };
        // One leaf is held at a time.
        let is_other = |held: &Option<u32>| held.is_some_and(|held| held != id);
        { self.held.iter_mut() }
            .filter(|held| is_other(held))
            .for_each(|held| *held = None);
        self.held[grab as usize] = Some(id);
        self.book.grab(id, grab, u, v);
    }

    /// Pulls a grab to a place, metres.
    pub fn hold(&mut self, grab: u32, place: [f32; 3]) {
        if let Some(id) = self.held[grab as usize] {
            self.book.hold(id, grab, place);
        }
    }

    /// Lets go of a grab.
    pub fn release(&mut self, grab: u32) {
        if let Some(id) = self.held[grab as usize].take() {
            self.book.release(id, grab);
        }
    }

    /// A frame of two ticks and an update.
    pub fn frame(&mut self) {
        let mut frame = Frame::default();
        self.book.begin_frame();
        for _ in 0..TICKS {
            self.pick_up_next();
            self.press_folds();
            let start = ThreadTime::now();
            let stepped = self.book.step_frame(1);
            frame.seconds += start.elapsed().as_secs_f64();
            if stepped == 0 {
                break;
            }
            frame.work += self.book.tick_work();
            self.since += TICK;
            self.follow();
        }
        let start = ThreadTime::now();
        self.book.update();
        frame.seconds += start.elapsed().as_secs_f64();
        frame.work += self.book.update_work();
        self.watch.look(&self.book, self.page, frame);
    }

    /// Begins the next turn that waits, if it may begin yet.
    fn pick_up_next(&mut self) {
        while self.plan.first() == Some(&self.landing()) {
            self.plan.remove(0);
        }
        let Some(&to) = self.plan.first() else { return };
        let from = self.landing();
        let side = if from < to { Side::Right } else { Side::Left };
        let is_in_way = self.flights.iter().any(|flight| flight.to == side);
        if self.since < APART || self.flights.len() >= MOST_FLIGHTS || is_in_way {
            return;
        }
        self.plan.remove(0);
        let (low, high) = (from.min(to), from.max(to));
        if let Some(id) = self.pick_up(side, low, high) {
            let to = if side == Side::Right {
                Side::Left
            } else {
                Side::Right
            };
            self.play(id, to);
        }
    }

    fn pick_up(&mut self, side: Side, low: u32, high: u32) -> Option<u32> {
        let id = self.book.pick_up(side, low, high)?;
        self.since = 0.0;
        let to = side;
        let flight = Flight { id, low, high, to };
        match side {
            Side::Right => self.flights.push(flight),
            Side::Left => self.flights.insert(0, flight),
        }
        Some(id)
    }

    fn play(&mut self, id: u32, to: Side) {
        self.book.play(id, to, SECONDS);
        self.follow();
    }

    /// Follows the engine: leaves that others sent somewhere, and those that have landed.
    fn follow(&mut self) {
        let book = &self.book;
        self.flights.retain_mut(|flight| {
            let phase = book.phase(flight.id);
            if let Some(side) = phase.and_then(|phase| phase.side()) {
                flight.to = side;
            }
            phase.is_some()
        });
    }

    /// Leaves on the left of all in flight, and of the right pile.
    fn left_end(&self) -> u32 {
        self.flights
            .first()
            .map_or(self.book.read(), |flight| flight.low)
    }

    fn right_end(&self) -> u32 {
        self.flights
            .last()
            .map_or(self.book.read(), |flight| flight.high)
    }

    /// The spread where the book will lie when everything in flight has landed.
    fn landing(&self) -> u32 {
        let back = self.flights.iter().find(|flight| flight.to == Side::Right);
        back.map_or(self.right_end(), |flight| flight.low)
    }
}
