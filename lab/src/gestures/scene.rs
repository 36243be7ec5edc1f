//! A random gesture: a book, hands on its leaves, what they do, and afterwards.

use std::time::Instant;

use turnleaf_engine::book::{Board, Book, Paper, Phase, TICK};
use turnleaf_engine::{Side, Stock, Surface};

use super::overlap::{Overlap, measure};
use super::random::Random;

/// Ticks for which hands are at work, at most.
const LONGEST: u32 = 130;

/// Ticks of half a second, after which a leaf let go keeps its lengths.
const HALF_A_SECOND: u32 = (0.5 / TICK) as u32;

/// Ticks looked at beyond that.
const BEYOND: u32 = 20;

/// Ticks in which all leaves come to rest once they are let go, at most.
const MOST_TO_REST: u32 = 10 * 120;

/// Size of the page, metres.
const PAGE: [f64; 2] = [0.14, 0.21];

/// What a gesture did to the leaves.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Largest edge strain after any tick of any leaf.
    pub strain: f32,
    /// The same, of leaves that no hand has held for half a second.
    pub strain_after: f32,
    /// Drawn penetration, metres.
    pub drawn: Overlap,
    /// Deepest contact of a node in the solver, metres.
    pub depth: f32,
    /// Whether all that is drawn was a number.
    pub finite: bool,
    /// Leaves in flight and seconds of each frame of two ticks and an update.
    pub frames: Vec<(usize, f64)>,
    /// Most leaves in flight at once.
    pub leaves: usize,
    /// How far what is drawn is behind the paper in each frame, at most, metres.
    pub lags: Vec<f32>,
    /// Seconds from when all were let go until all lay still.
    pub rest: f32,
}

/// A hand at work.
struct Hand {
    flight: u32,
    number: u32,
    style: Style,
    at: [f32; 3],
    to: [f32; 3],
    /// Ticks until it lets go.
    left: u32,
}

/// How a hand moves.
#[derive(Clone, Copy)]
enum Style {
    /// Slowly, to near places.
    Drag,
    /// Fast, over the spine.
    Throw,
    /// It jumps to anywhere, up to three widths off.
    Wild,
}

struct Scene {
    book: Book,
    random: Random,
    hands: Vec<Hand>,
    /// For each flight the ticks since a hand of any kind held it.
    free: Vec<(u32, u32)>,
    outcome: Outcome,
    ticks: u32,
    ticks_let_go: u32,
}

/// Plays the gesture of a seed on leaves of a stock.
pub fn play(seed: u64, stock: Stock) -> Outcome {
    let mut random = Random::new(seed);
    let book = open(&mut random, stock);
    let mut scene = Scene {
        book,
        random,
        hands: Vec::new(),
        free: Vec::new(),
        ticks: 0,
        ticks_let_go: 0,
        outcome: Outcome {
            finite: true,
            ..Outcome::default()
        },
    };
    let mut ticks = 0;
    let steady = scene.random.once_in(2);
    let busy = 1 + scene.random.below(30);
    while ticks < LONGEST {
        if scene.random.once_in(busy) || scene.book.flights() == 0 {
            scene.begin();
        }
        let now = if steady { 2 } else { scene.random.below(13) };
        scene.frame(now);
        ticks += now.max(1);
    }
    for hand in std::mem::take(&mut scene.hands) {
        scene.book.release(hand.flight, hand.number);
    }
    for _ in 0..(HALF_A_SECOND + BEYOND) / 2 {
        scene.ticks_let_go += 2;
        scene.frame(2);
    }
    while scene.book.flights() > 0 && scene.ticks_let_go < MOST_TO_REST {
        scene.book.step(1);
        scene.ticks_let_go += 1;
    }
    scene.outcome.rest = scene.ticks_let_go as f32 * TICK;
    scene.outcome
}

/// A book open somewhere: also at its first and its last leaf.
fn open(random: &mut Random, stock: Stock) -> Book {
    let leaves = [1, 2, 8, 40, 100, 300][random.below(6) as usize];
    let thickness = random.between(0.5e-4, 1.2e-4) * leaves as f32;
    let mut book =
        Book::new(PAGE[0], PAGE[1], leaves, f64::from(thickness)).expect("these sizes make a book");
    *book.board_mut(0) = Board::new(Side::Left);
    book.set_paper(&Paper {
        stock,
        assist: !random.once_in(8),
        ..Paper::default()
    });
    book.lay(match random.below(4) {
        0 => 0,
        1 => leaves,
        _ => random.below(leaves + 1),
    });
    book
}

impl Scene {
    /// Begins something: a hand takes a leaf, or a turn is played.
    fn begin(&mut self) {
        let side = [Side::Right, Side::Left][self.random.below(2) as usize];
        let known = self.random.below(self.book.flights() as u32 + 1) as usize;
        let known = self.book.flight_id(known);
        let lifted = if self.random.once_in(2) || known.is_none() {
            self.lift(side)
        } else {
            known
        };
        let Some(flight) = lifted else { return };
        match self.random.below(4) {
            0 => self.play(flight),
            1 => {
                self.grab(flight);
                self.grab(flight);
            }
            _ => self.grab(flight),
        }
    }

    fn lift(&mut self, side: Side) -> Option<u32> {
        let read = self.book.read();
        let many = if self.random.once_in(6) { 3 } else { 1 };
        match side {
            Side::Right => {
                let low = read + self.in_flight();
                self.book.lift(side, low, low + many)
            }
            Side::Left => self.book.lift(side, read.checked_sub(many)?, read),
        }
    }

    /// Leaves of paper in flight.
    fn in_flight(&self) -> u32 {
        (0..self.book.flights())
            .filter_map(|index| self.book.leaves(index))
            .sum()
    }

    fn play(&mut self, flight: u32) {
        let side = [Side::Right, Side::Left][self.random.below(2) as usize];
        let seconds = [0.8, 0.5, 0.3, f32::NAN, self.random.between(0.1, 2.0)];
        let seconds = seconds[self.random.below(5) as usize];
        self.hands.retain(|hand| hand.flight != flight);
        self.book.play(flight, side, seconds);
    }

    fn grab(&mut self, flight: u32) {
        let number = self.random.below(4);
        // A reader has two hands.
        if self.hands.len() == 2 {
            return;
        }
        if self
            .hands
            .iter()
            .any(|hand| (hand.flight, hand.number) == (flight, number))
        {
            return;
        }
        let edge = self.random.once_in(2);
        let u = if edge {
            1.0
        } else {
            self.random.between(0.2, 1.0)
        };
        let v = if self.random.once_in(3) {
            0.0
        } else {
            self.random.between(0.0, 1.0)
        };
        self.book.grab(flight, number, u, v);
        let style = [Style::Drag, Style::Throw, Style::Wild][self.random.below(3) as usize];
        let at = [0.0, v * PAGE[1] as f32, 0.12];
        let left = 10 + self.random.below(LONGEST);
        self.hands.push(Hand {
            flight,
            number,
            style,
            at,
            to: at,
            left,
        });
    }

    /// A frame of `ticks` and an update.
    fn frame(&mut self, ticks: u32) {
        for index in (0..self.hands.len()).rev() {
            self.work(index, ticks);
        }
        let leaves = self.book.flights();
        let mut seconds = 0.0;
        for _ in 0..ticks {
            let start = Instant::now();
            self.book.step(1);
            seconds += start.elapsed().as_secs_f64();
            self.look();
        }
        let start = Instant::now();
        self.book.update();
        seconds += start.elapsed().as_secs_f64();
        if ticks == 2 && leaves > 0 {
            self.outcome.frames.push((leaves, seconds));
        }
        self.outcome.leaves = self.outcome.leaves.max(leaves);
        let drawn = (0..self.book.flights()).filter_map(|index| self.book.surface(index));
        let finite = |surface: &Surface| surface.positions.iter().all(|x| x.is_finite());
        self.outcome.finite &= { drawn }.all(finite);
        let lag = |index: usize| self.book.lag(index).unwrap_or(0.0);
        let lag = (0..self.book.flights()).map(lag).fold(0.0, f32::max);
        self.outcome.lags.push(lag);
        self.outcome.drawn = self.outcome.drawn.worse(measure(&self.book));
    }

    /// A hand's work of a frame: it moves, or lets go.
    fn work(&mut self, index: usize, ticks: u32) {
        let width = PAGE[0] as f32;
        let random = &mut self.random;
        let hand = &mut self.hands[index];
        hand.left = hand.left.saturating_sub(ticks);
        if hand.left == 0 {
            self.book.release(hand.flight, hand.number);
            self.hands.swap_remove(index);
            return;
        }
        let (often, far, follow) = match hand.style {
            Style::Drag => (20, 1.0, 0.04),
            Style::Throw => (8, 1.2, 0.25),
            Style::Wild => (4, 3.0, 1.0),
        };
        if random.once_in(often) {
            let mut at = |low: f32, high: f32| random.between(low, high) * far * width;
            hand.to = [at(-1.0, 1.0), at(-0.3, 1.8), at(-0.2, 1.0)];
        }
        for axis in 0..3 {
            let part = (follow * ticks as f32).min(1.0);
            hand.at[axis] += part * (hand.to[axis] - hand.at[axis]);
        }
        let mut place = hand.at;
        if random.once_in(50) {
            place[random.below(3) as usize] = f32::NAN;
        }
        self.book.hold(hand.flight, hand.number, place);
    }

    /// Looks at the leaves after a tick.
    fn look(&mut self) {
        self.ticks += 1;
        let before = std::mem::take(&mut self.free);
        for index in 0..self.book.flights() {
            let Some(id) = self.book.flight_id(index) else {
                continue;
            };
            let strain = self.book.strain(index).unwrap_or(0.0);
            let depth = self.book.depth(index).unwrap_or(0.0);
            let known = before
                .iter()
                .find(|flight| flight.0 == id)
                .map_or(0, |flight| flight.1);
            let held = matches!(self.book.phase(id), Some(Phase::Held | Phase::Playing(_)));
            let free = if held { 0 } else { known + 1 };
            self.free.push((id, free));
            // No maximum of what is no number would show it.
            self.outcome.finite &= strain.is_finite() && depth.is_finite();
            self.outcome.strain = self.outcome.strain.max(strain);
            self.outcome.depth = self.outcome.depth.max(depth);
            if free > HALF_A_SECOND {
                self.outcome.strain_after = self.outcome.strain_after.max(strain);
            }
        }
    }
}
