//! Leaves of a book that are folded and torn out at random, before a gesture and in it.

use turnleaf_engine::book::{Book, Phase};
use turnleaf_engine::{SheetCrease, Side};

use super::folding::{Fold, place_beyond};
use super::overlap::{Overlap, measure};
use super::parts::inside_parts;
use super::random::Random;
use super::tearing::{Event, GRAB, Tear, Torn};
use super::timed_folding::TimedFolding;
use super::world::{Opened, World};

/// Leaves on either side of the opening that are folded before the gesture, once in two.
const BESIDE: u32 = 3;

/// What folds and tears did. Lengths are in metres on a page 140 mm wide.
#[derive(Clone, Copy, Debug, Default)]
pub struct CreaseOutcome {
    /// Folds that were made.
    pub made: u32,
    /// Folds that leaves have too few nodes for.
    pub rejected: u32,
    /// How far creases of leaves that no pointer held since came off the rests they were given, at
    /// most, radians.
    pub rests_off: f32,
    /// The same of all others, which a hand may open.
    pub rests_off_held: f32,
    /// Drawn penetration before the gesture and once all lies at rest; in itself counts by parts
    /// too.
    pub at_rest: Overlap,
    /// Torn leaves.
    pub torn: Torn,
}

/// A leaf that was folded.
struct FoldedLeaf {
    leaf: u32,
    made: Vec<SheetCrease>,
    /// Whether a pointer has held it since.
    was_held: bool,
}

/// The folds and tears of a gesture.
pub struct Creasing {
    /// Numbers of its own, so that the pointers of a seed are the same.
    random: Random,
    fold: Fold,
    page: [f64; 2],
    leaves: Vec<FoldedLeaf>,
    pressing: Option<TimedFolding>,
    tear: Option<Tear>,
    /// What has been seen so far.
    pub outcome: CreaseOutcome,
}

impl Creasing {
    /// Folds leaves about where a book lies open.
    pub fn begin(seed: u64, fold: Fold, opened: &mut Opened, page: [f64; 2]) -> Creasing {
        let mut creasing = Creasing {
            random: Random::new(seed.wrapping_mul(0x9e6c_63d0_876a_3f35) ^ 0x51ed_270b),
            fold,
            page,
            leaves: Vec::new(),
            pressing: None,
            tear: None,
            outcome: CreaseOutcome::default(),
        };
        let read = opened.book.read();
        for leaf in read.saturating_sub(BESIDE)..(read + BESIDE).min(opened.leaves) {
            // Those that lie open are, so that every gesture has a fold in sight.
            if leaf == read || leaf + 1 == read || creasing.random.once_in(2) {
                creasing.fold(&mut opened.book, leaf);
            }
        }
        creasing.look_at_rest(&opened.book);
        creasing
    }

    /// Folds a leaf at once. Returns whether it has the nodes for it.
    fn fold(&mut self, book: &mut Book, leaf: u32) -> bool {
        let lines = self.lines(book, leaf);
        let is_folded = book.crease(leaf, &lines);
        self.count(is_folded, leaf, lines);
        is_folded
    }

    fn lines(&mut self, book: &Book, leaf: u32) -> Vec<SheetCrease> {
        let stock = book.stock_of(leaf);
        self.fold.lines(&mut self.random, &stock, self.page)
    }

    fn count(&mut self, is_folded: bool, leaf: u32, made: Vec<SheetCrease>) {
        if !is_folded {
            self.outcome.rejected += 1;
            return;
        }
        self.outcome.made += 1;
        self.leaves.retain(|folded| folded.leaf != leaf);
        self.leaves.push(FoldedLeaf {
            leaf,
            made,
            was_held: false,
        });
    }

    /// Folds or opens the uppermost leaf of a side, or begins to tear it out.
    pub fn act(&mut self, opened: &mut Opened, side: Side) {
        let Opened { book, leaves, .. } = opened;
        let read = book.read();
        let uppermost = match side {
            Side::Right => read + in_flight(book),
            Side::Left => match read.checked_sub(1) {
                Some(leaf) => leaf,
                None => return,
            },
        };
        if uppermost >= *leaves {
            return;
        }
        match self.random.below(4) {
            0 => {
                self.fold(book, uppermost);
            }
            1 => {
                if book.crease(uppermost, &[]) {
                    self.leaves.retain(|folded| folded.leaf != uppermost);
                }
            }
            2 => self.begin_to_fold(book, uppermost, side),
            _ => {
                if self.tear.is_some() || *leaves < 2 {
                    return;
                }
                let flight = book.pick_up(side, uppermost, uppermost + 1);
                let tear = |flight| Tear::begin(book, flight, side, &mut self.random);
                self.tear = flight.and_then(tear);
            }
        }
    }

    /// Folds a leaf before the reader's eyes, as the viewer does: picked up, it is pressed.
    fn begin_to_fold(&mut self, book: &mut Book, leaf: u32, side: Side) {
        if self.pressing.is_some() || book.pick_up(side, leaf, leaf + 1).is_none() {
            return;
        }
        let made = self.lines(book, leaf);
        self.pressing = TimedFolding::begin(book, leaf, &made);
        self.count(self.pressing.is_some(), leaf, made);
    }

    /// A place of a flight's leaf, u and v, that is folded over, if it has one.
    pub fn flap_of(&mut self, book: &Book, flight: u32) -> Option<[f32; 2]> {
        let leaf = leaf_of(book, flight)?;
        let folded = self.leaves.iter().find(|folded| folded.leaf == leaf)?;
        if self.random.once_in(2) {
            return None;
        }
        place_beyond(&folded.made, &mut self.random, self.page)
    }

    /// Says that a pointer holds a flight.
    pub fn hold(&mut self, book: &Book, flight: u32) {
        let leaf = leaf_of(book, flight);
        for folded in &mut self.leaves {
            folded.was_held |= Some(folded.leaf) == leaf;
        }
    }

    /// Whether leaves may be turned: not under a torn sheet, which the viewer would put aside.
    pub fn lets_turn(&self, book: &Book) -> bool {
        !self.tear.as_ref().is_some_and(|tear| tear.lies_over(book))
    }

    /// Whether a leaf is being torn out, or a torn one has not come to rest.
    pub fn moves(&self) -> bool {
        self.tear.as_ref().is_some_and(Tear::moves)
    }

    /// Presses what is folded by a tick.
    pub fn press(&mut self, book: &mut Book) {
        self.pressing.take_if(|pressing| !pressing.press(book));
    }

    /// Steps and draws a leaf that is torn by a frame of `ticks`. Returns whether all leaves in
    /// flight were laid, as the book is bound anew without it.
    pub fn step(&mut self, opened: &mut Opened, ticks: u32, world: &World) -> bool {
        let Some(tear) = &mut self.tear else {
            return false;
        };
        let book = &mut opened.book;
        // A turn that is laid takes along what is torn of it.
        if tear
            .flight()
            .is_some_and(|flight| book.phase(flight) != Some(Phase::Held))
        {
            self.tear = None;
            return false;
        }
        match tear.step(book, ticks, &mut self.random, &mut self.outcome.torn) {
            Event::None => false,
            Event::GivenUp(flight) => {
                book.release(flight, GRAB);
                self.tear = None;
                false
            }
            Event::Off(flight) => {
                let leaf = leaf_of(book, flight).expect("it was in flight until now");
                self.take_out(opened, leaf, world);
                true
            }
        }
    }

    /// Binds a book anew without a leaf, as the viewer does.
    fn take_out(&mut self, opened: &mut Opened, leaf: u32, world: &World) {
        self.pressing = None;
        // It may have been folded, or opened again, while it was torn.
        self.leaves.retain(|folded| folded.leaf != leaf);
        let book = &opened.book;
        let mut folds = Vec::new();
        for folded in &mut self.leaves {
            let now = book.creases(folded.leaf);
            folded.leaf -= u32::from(folded.leaf > leaf);
            folds.push((folded.leaf, now));
        }
        opened.bind_without(leaf, world);
        for (leaf, creases) in folds {
            let is_folded = opened.book.crease(leaf, &creases);
            assert!(is_folded, "what was folded can be");
        }
    }

    /// All pointers let go.
    pub fn let_go(&mut self, book: &mut Book) {
        if let Some(Event::GivenUp(flight)) = self.tear.as_mut().map(Tear::release) {
            book.release(flight, GRAB);
            self.tear = None;
        }
    }

    /// Looks at a torn leaf as it is drawn. Returns whether all is a number.
    pub fn look(&mut self, book: &Book) -> bool {
        let torn = &mut self.outcome.torn;
        self.tear.as_ref().is_none_or(|tear| tear.look(book, torn))
    }

    /// Looks at leaves of a book that lies at rest, as it is drawn.
    pub fn look_at_rest(&mut self, book: &Book) {
        let page = self.page.map(|side| side as f32);
        let found = measure_at_rest(book, page);
        self.outcome.at_rest = self.outcome.at_rest.worse(found.scaled(0.14 / page[0]));
    }

    /// Compares the rests of creases with those that they were given.
    pub fn compare_rests(&mut self, book: &Book) {
        let pressed = self.pressing.as_ref().map(|pressing| pressing.leaf);
        for folded in &self.leaves {
            if pressed == Some(folded.leaf) {
                continue;
            }
            let now = book.creases(folded.leaf);
            let pairs = now.iter().zip(&folded.made);
            let off = pairs.map(|(now, made)| (now.rest - made.rest).abs() as f32);
            let off = off.fold(0.0, f32::max);
            let most = if folded.was_held {
                &mut self.outcome.rests_off_held
            } else {
                &mut self.outcome.rests_off
            };
            *most = most.max(off);
        }
    }
}

/// Measures what a book draws that lies at rest, and whose pages have this width and height, metres:
/// leaves in themselves by the sides of their folds too.
pub fn measure_at_rest(book: &Book, page: [f32; 2]) -> Overlap {
    let mut found = measure(book, page);
    for index in 0..book.drawn_leaves() {
        let (Some(surface), Some(mesh)) = (book.surface(index), book.paper_mesh(index)) else {
            continue;
        };
        let creases = book.creases(low_of(book, index));
        let inside = inside_parts(surface, mesh, &creases, page[0]);
        found.itself = found.itself.max(inside);
    }
    found
}

/// Leaves of paper in flight.
pub fn in_flight(book: &Book) -> u32 {
    let drawn = 0..book.drawn_leaves();
    let flying = drawn.filter(|index| book.flight_id(*index) != Some(0));
    flying.filter_map(|index| book.leaves(index)).sum()
}

/// The leaf of a flight that stands for one alone.
fn leaf_of(book: &Book, flight: u32) -> Option<u32> {
    let index = (0..book.drawn_leaves()).find(|k| book.flight_id(*k) == Some(flight))?;
    (book.leaves(index) == Some(1)).then(|| low_of(book, index))
}

/// The first leaf of what is drawn at `index`, counted from the left.
fn low_of(book: &Book, index: usize) -> u32 {
    let lies = u32::from(book.lies_creased(Side::Left));
    let before: u32 = (0..index).filter_map(|k| book.leaves(k)).sum();
    book.read() - lies + before
}
