//! The mechanics of a bound book: how resting pages lie, how leaves in flight
//! move and sit between them, and how the cover boards swing.
//!
//! Book space: metres; x across the spine to the right, y along the spine to
//! the head, z up from the boards; the gutter lies at x = 0, z = 0.

mod bend_into_gutter;
mod board;
mod book_space_leaf;
mod contacts;
mod creased_leaves;
mod creased_mesh;
mod draw;
#[cfg(all(test, feature = "creases"))]
mod drawn_folds_tests;
mod flight;
mod flights;
mod fold_out;
mod folded_sheet;
#[cfg(all(test, feature = "creases"))]
mod folding_tests;
mod fraction_turned;
mod gutter;
#[cfg(all(test, feature = "creases"))]
mod held_folds_tests;
mod leaf;
mod leaf_stocks;
mod limits;
mod loose_sheets;
#[cfg(all(test, feature = "creases"))]
mod page_folds_tests;
mod paper;
#[cfg(test)]
mod parts_depth;
mod phase;
mod pile;
mod pile_table;
mod shut_folds;
mod stillness;
mod surroundings;
#[cfg(test)]
mod tests;
mod torn_leaf;
mod turn_by_place;

pub use bend_into_gutter::bend_into_gutter;
pub use board::Board;
pub use fold_out::{FlapPlace, FoldOut};
pub use leaf::Leaf;
use limits::MOST_STEPPING;
pub use limits::{MAX_GRABS, MOST_FLIGHTS, TICK};
pub use loose_sheets::{step_together, wake_upon};
pub use paper::Paper;
pub use phase::Phase;
pub use pile::{LAYERS, Pile, crowded_columns};
pub use surroundings::TableAround;
pub use torn_leaf::{TearLine, TornLeaf};

use crate::grid::Side;
use crate::models::sheet::SheetCrease;
use crate::paper_mesh::PaperMesh;
use crate::stock::Stock;
use crate::surface::Surface;
use flight::Flight;
use flights::{Flights, Pattern};
use gutter::Gutter;
use leaf_stocks::LeafStocks;
use pile_table::PileTable;

/// Columns of the drawn leaf and of every pile: enough for the sharp bend out
/// of the gutter.
const COLUMNS: usize = 49;

/// Rows of the drawn leaf.
const ROWS: usize = 25;

/// A book that lies open: two piles of pages, the leaves in flight between
/// them, and two cover boards.
///
/// Leaves of paper are numbered from 0 at the front. A flight is known by the
/// number that [`pick_up`](Book::pick_up) returns; a command to one that is over, or
/// by what is no number, changes nothing.
pub struct Book {
    leaves: u32,
    pile_table: PileTable,
    /// Each side's pile closed flat, right and left.
    closed: [Pile; 2],
    /// The piles as they lie now, right and left, and as they are drawn.
    piles: [Pile; 2],
    drawn: [Pile; 2],
    gutter: Gutter,
    flights: Flights,
    boards: [Board; 2],
    /// Work of the ticks since the frame began.
    stepping: u32,
}

impl Book {
    /// A book of `leaves` pages of paper, `width` x `height` metres, together
    /// `thickness` metres thick, open before the first.
    ///
    /// None where a side is not between 1 mm and 10 m, or the thickness between 0 and 1 m.
    pub fn new(width: f64, height: f64, leaves: u32, thickness: f64) -> Option<Book> {
        let is_size = |size: f64| (0.001..=10.0).contains(&size);
        if !is_size(width) || !is_size(height) || !(0.0..=1.0).contains(&thickness) {
            return None;
        }
        let u = crowded_columns(COLUMNS);
        let closed = [Side::Right, Side::Left].map(|side| Pile::closed(side, width, thickness, &u));
        let mut book = Book {
            leaves,
            pile_table: PileTable::new(width, thickness, &u),
            piles: closed.clone(),
            drawn: closed.clone(),
            closed,
            gutter: Gutter::new(limits::NODES[0], &u),
            boards: [Board::new(Side::Right), Board::new(Side::Right)],
            stepping: 0,
            flights: Flights::new(
                leaves,
                Pattern {
                    size: [width, height],
                    paper: Paper::default(),
                    stocks: LeafStocks::default(),
                    u,
                    rows: ROWS,
                },
            ),
        };
        book.update();
        Some(book)
    }

    /// What the leaves are made of, but for those of a [stock of their own](Self::set_leaf_stock).
    pub fn paper(&self) -> &Paper {
        &self.flights.pattern().paper
    }

    /// The stock of a leaf, counted from 0; the book's own where there is no such leaf.
    pub fn stock_of(&self, leaf: u32) -> Stock {
        self.flights.pattern().kind_of(leaf).0
    }

    /// Width and height of a page, metres.
    pub fn size(&self) -> [f64; 2] {
        self.flights.pattern().size
    }

    /// Makes the leaves of another paper; those of a [stock of their
    /// own](Self::set_leaf_stock) keep it. Leaves in flight are laid down first.
    /// Returns whether leaves can be made of it; if not, nothing changes.
    pub fn set_paper(&mut self, paper: &Paper) -> bool {
        if !paper.is_sound() {
            return false;
        }
        self.change(|pattern| {
            pattern.paper = *paper;
            let width = pattern.size[0] * paper.scale;
            pattern.stocks.bind(paper.grain, width);
        });
        true
    }

    /// Makes some leaves of a stock of their own: a cover of card, boards, plates. Leaves in
    /// flight are laid down first. Returns whether there are such leaves, they can be made of
    /// it and the book has no more than 4096 runs of leaves of other stocks; if not, no
    /// stock changes.
    ///
    /// Each leaf then moves as its stock does, and counts by its caliper in the thickness of
    /// the piles. A pile lies straighter under a leaf that is too stiff for its shape. Leaves
    /// that fly as one are of the stock of the one that lay uppermost.
    pub fn set_leaf_stock(&mut self, leaves: core::ops::Range<u32>, stock: &Stock) -> bool {
        if leaves.is_empty() || leaves.end > self.leaves || stock.check().is_err() {
            return false;
        }
        let mut is_set = false;
        self.change(|pattern| {
            let (grain, width) = (pattern.paper.grain, pattern.size[0] * pattern.paper.scale);
            is_set = pattern.stocks.set(leaves, *stock, grain, width);
        });
        is_set
    }

    /// Makes every leaf of the book's own stock again. Leaves in flight are laid down first.
    pub fn clear_leaf_stocks(&mut self) {
        self.change(|pattern| pattern.stocks.clear());
    }

    /// Changes what leaves are made of.
    fn change(&mut self, how: impl FnOnce(&mut Pattern)) {
        let mut pattern = self.flights.pattern().clone();
        how(&mut pattern);
        let read = self.flights.left();
        let creased = self.flights.take_creased();
        self.flights = Flights::new(self.leaves, pattern);
        self.flights.set_creased(creased);
        self.lay(read);
    }

    /// Lays the book open with `read` leaves of paper on the left (at most those
    /// there are) and none in flight.
    pub fn lay(&mut self, read: u32) {
        self.flights.lay(read);
        self.uncover();
        self.update();
    }

    /// Creases a leaf of paper, `leaf` counted from 0, along lines, in place of those that it
    /// has: it is then folded along them as each rests, and is drawn by itself where it lies
    /// uppermost. None of them makes it whole again. Where it lies or flies it goes on from
    /// there: the next steps fold it.
    ///
    /// Returns whether it can be creased so: there is such a leaf, no line meets the spine,
    /// they are at most 16 and lie far enough from each other for its nodes, and the book has
    /// no more than 4096 such leaves. If not, nothing changes.
    pub fn crease(&mut self, leaf: u32, creases: &[SheetCrease]) -> bool {
        let is_creased = self.flights.crease(leaf, creases);
        if is_creased {
            self.uncover();
            self.update();
        }
        is_creased
    }

    /// Turns the rest of a crease of a leaf to an angle, radians as [`SheetCrease::rest`]; the next
    /// steps fold it there. Nothing happens where the leaf neither flies nor lies uppermost,
    /// or has no such crease.
    pub fn press(&mut self, leaf: u32, crease: usize, rest: f32) {
        if rest.abs() <= core::f32::consts::PI {
            self.flights.press(leaf, crease, rest);
        }
    }

    /// The creases of a leaf, each with the angle at which it rests now; none where it has none.
    pub fn creases(&self, leaf: u32) -> Vec<SheetCrease> {
        self.flights.creases(leaf)
    }

    /// Whether a creased leaf lies upon the pile of a side and is drawn by itself: the first of
    /// those [drawn](Self::drawn_leaves) on the left, the last on the right.
    pub fn lies_creased(&self, side: Side) -> bool {
        self.flights.lying(side).is_some()
    }

    /// How the drawn mesh of the leaf at `index`, counted from the left, lies on its flat paper
    /// where it is creased; None where it is not, and its points lie at the [columns](Self::columns)
    /// and even rows. The surface's `topology` rises when it changes.
    pub fn paper_mesh(&self, index: usize) -> Option<&PaperMesh> {
        self.flights.order().get(index)?.paper_mesh()
    }

    /// How many leaves are drawn by themselves: those in flight, and creased ones that lie
    /// upon a pile. Whatever is asked by an `index` is of one of these, counted from 0 at the left;
    /// None where there is none of that number.
    pub fn drawn_leaves(&self) -> usize {
        self.flights.order().len()
    }

    /// Draws creased leaves that lie uppermost by themselves.
    fn uncover(&mut self) {
        for side in [Side::Left, Side::Right] {
            self.write_piles();
            let [right, left] = &self.piles;
            self.gutter.update(right.angles(), left.angles());
            self.flights.uncover(side, &self.gutter, [right, left]);
        }
    }

    /// Takes up the uppermost leaf of side `from`, or several that fly as one.
    /// While it lies on the right, `low` leaves are on the left; once it lies on
    /// the left, `high`. Returns the number of the flight, never 0.
    ///
    /// None where these are not the uppermost leaves of that side, or where
    /// [`MOST_FLIGHTS`] are in flight.
    pub fn pick_up(&mut self, from: Side, low: u32, high: u32) -> Option<u32> {
        let id = self.flights.pick_up(from, low, high)?;
        self.uncover();
        self.update();
        Some(id)
    }

    /// A grab (0 to 3) takes hold of a flight at (`u`, `v`). A reader holds one leaf
    /// at a time, with several fingers if need be: what was held before is let go,
    /// and the other leaves in flight make way to their sides of it.
    pub fn grab(&mut self, id: u32, grab: u32, u: f32, v: f32) {
        self.flights.grab(id, grab, u, v);
    }

    /// A grab that holds a flight pulls it to `place`, in book space, metres: within a
    /// kilometre, or to the nearest place that is. Nothing happens where it is not finite.
    pub fn hold(&mut self, id: u32, grab: u32, place: [f32; 3]) {
        if let Some(flight) = self.flights.get_mut(id) {
            flight.leaf_mut().hold(grab, place);
        }
    }

    /// A grab lets go of a flight. Once no grab holds it, it falls to the side
    /// that its swing takes it, and the leaves between it and that side with it.
    pub fn release(&mut self, id: u32, grab: u32) {
        self.flights.release(id, grab);
    }

    /// Takes a flight to a side, out of every grab: from rest by the recorded
    /// turn, `seconds` long (0.2 to 600 or the nearer of these, 0.8 where not finite). The leaves between it and that side go there too.
    pub fn play(&mut self, id: u32, to: Side, seconds: f32) {
        self.flights.play(id, to, seconds);
    }

    /// Work of the last tick: counted by steps, sweeps and searches for contacts, in about
    /// nanoseconds of native code, the same on every machine; 0 where nothing moved.
    pub fn tick_work(&self) -> u32 {
        self.flights.tick_work()
    }

    /// Steps all flights by `ticks` of [`TICK`] seconds, tick by tick. A flight
    /// that rests is over once no other is between it and its pile.
    pub fn step(&mut self, ticks: u32) {
        for _ in 0..ticks {
            if self.flights.is_still() {
                self.flights.rest();
                return;
            }
            self.write_piles();
            self.gutter
                .update(self.piles[0].angles(), self.piles[1].angles());
            self.flights
                .step(&self.gutter, [&self.piles[0], &self.piles[1]]);
        }
    }

    /// Lets `seconds` pass in which nothing moves and no one steps the book: creases of leaves that lie
    /// under others creep toward where they are pressed. Seconds that are not finite, or below 0, pass
    /// none.
    pub fn wait(&mut self, seconds: f64) {
        if seconds.is_finite() && seconds > 0.0 {
            self.flights.wait(seconds);
        }
    }

    /// Begins a frame: what [`step_frame`](Self::step_frame) may step is counted from here on.
    pub fn begin_frame(&mut self) {
        self.stepping = 0;
    }

    /// Steps all flights as [`step`](Self::step) does, by at most `ticks`, and by fewer where
    /// those of the frame have taken as much work as a frame may have: where many leaves
    /// meet, they move slower instead of each frame taking longer than the one before.
    /// Returns by how many.
    pub fn step_frame(&mut self, ticks: u32) -> u32 {
        for done in 0..ticks {
            if self.stepping >= MOST_STEPPING {
                return done;
            }
            if self.flights.is_still() {
                self.flights.rest();
                break;
            }
            self.step(1);
            self.stepping = self.stepping.saturating_add(self.tick_work());
        }
        ticks
    }

    /// Brings the drawn surfaces and the piles up to date with leaves and boards.
    pub fn update(&mut self) {
        self.write_piles();
        let [now, last] = [&self.piles, &self.drawn].map(|piles| [&piles[0], &piles[1]]);
        if self.flights.draw(now, last) {
            for (drawn, pile) in self.drawn.iter_mut().zip(&self.piles) {
                drawn.copy(pile);
            }
        }
    }

    fn write_piles(&mut self) {
        let turned = self.flights.turned();
        self.pile_table
            .write(Side::Right, 1.0 - turned, &mut self.piles[0]);
        self.pile_table
            .write(Side::Left, turned, &mut self.piles[1]);
        let straightness = self.flights.straightness();
        for (pile, straightness) in self.piles.iter_mut().zip(straightness) {
            if straightness > 0.0 {
                pile.straighten(straightness);
            }
        }
        // The front board shuts the pile on the right, the back board the left.
        let shut = [
            closing(self.boards[0].angle()),
            closing(core::f32::consts::PI - self.boards[1].angle()),
        ];
        for side in 0..2 {
            if shut[side] > 0.0 {
                self.piles[side].blend_toward(&self.closed[side], shut[side]);
            }
        }
    }

    /// Leaves of the left pile.
    pub fn read(&self) -> u32 {
        self.flights.left()
    }

    /// Leaves in flight.
    pub fn flights(&self) -> usize {
        self.flights.flying()
    }

    /// The number by which the drawn leaf at `index` is commanded.
    pub fn flight_id(&self, index: usize) -> Option<u32> {
        self.flights.order().get(index).map(|flight| flight.id())
    }

    /// Leaves of paper that the drawn leaf at `index` stands for.
    pub fn leaves(&self, index: usize) -> Option<u32> {
        self.flights
            .order()
            .get(index)
            .map(|flight| flight.leaves())
    }

    /// Whether the book sleeps: nothing moves in it until the next command. No leaf is in
    /// flight or all are held and lie still, and so do the boards.
    pub fn is_asleep(&self) -> bool {
        let mut leaves = self.flights.order().iter().map(|flight| flight.leaf());
        leaves.all(Leaf::is_asleep) && self.boards.iter().all(Board::is_still)
    }

    /// What a flight is doing; None once it is over.
    pub fn phase(&self, id: u32) -> Option<Phase> {
        self.flights.get(id).map(|flight| flight.phase())
    }

    /// The surface of the drawn leaf at `index`, as of the last update.
    pub fn surface(&self, index: usize) -> Option<&Surface> {
        self.flights
            .order()
            .get(index)
            .map(|flight| flight.surface())
    }

    /// Where the points of the drawn leaf at `index` would have been drawn in the last update if
    /// they were not held back: x, y, z in metres. See [`lag`](Self::lag).
    pub fn target(&self, index: usize) -> Option<&[f32]> {
        self.flights.order().get(index).map(Flight::target)
    }

    /// The points of the drawn leaf at `index`: x, y, z in metres over a flat table, at the
    /// surface's columns and rows, as its sheet is now. What is written over them is what the next
    /// update bends into the gutter and draws, in place of the sheet: so another model shows a leaf
    /// that grabs and contacts move as paper.
    pub fn override_surface(&mut self, index: usize) -> Option<&mut [f32]> {
        self.flights.override_surface(index)
    }

    /// Thickness of the paper of the drawn leaf at `index`, metres.
    pub fn caliper(&self, index: usize) -> Option<f32> {
        let flight = self.flights.order().get(index)?;
        Some(flight.leaf().sheet().settings().stock.caliper as f32)
    }

    /// Largest strain, stretch or compression, of any edge between neighbouring nodes of the drawn
    /// leaf at `index`.
    pub fn strain(&self, index: usize) -> Option<f32> {
        let flight = self.flights.order().get(index)?;
        Some(flight.leaf().sheet().max_edge_strain())
    }

    /// Largest shear of a cell of the drawn leaf at `index`, radians. See
    /// [`Sheet::max_shear`](crate::Sheet::max_shear).
    pub fn shear(&self, index: usize) -> Option<f32> {
        let flight = self.flights.order().get(index)?;
        Some(flight.leaf().sheet().max_shear())
    }

    /// Largest stretch of a diagonal of a cell of the drawn leaf at `index`. See
    /// [`Sheet::max_diagonal_stretch`](crate::Sheet::max_diagonal_stretch).
    pub fn diagonal_stretch(&self, index: usize) -> Option<f32> {
        let flight = self.flights.order().get(index)?;
        Some(flight.leaf().sheet().max_diagonal_stretch())
    }

    /// Deepest contact of a node of the drawn leaf at `index` in the last tick, metres, before the
    /// tick pushed it out.
    pub fn depth(&self, index: usize) -> Option<f32> {
        let flight = self.flights.order().get(index)?;
        Some(flight.leaf().in_book_space().depth)
    }

    /// Whether the drawn leaf at `index` is being eased flat: its nodes are then moved to their
    /// places of rest.
    pub fn is_settling(&self, index: usize) -> Option<bool> {
        let flight = self.flights.order().get(index)?;
        Some(flight.leaf().is_down())
    }

    /// How many flights have joined a pile by coming to rest since the book was made
    /// or its paper changed, and how many of them did not lie still by themselves in
    /// time but were put down.
    pub fn landed(&self) -> [u32; 2] {
        self.flights.landed()
    }

    /// How far the drawn leaf at `index` is drawn from where its paper is, metres, as it would be
    /// drawn through another leaf there.
    pub fn lag(&self, index: usize) -> Option<f32> {
        self.flights.order().get(index).map(|flight| flight.lag())
    }

    /// Work of the last update to keep what is drawn clear of each other: counted by what was
    /// looked at, in about nanoseconds of native code, the same on every machine. From
    /// 4 million on only what was begun is ended, and what was drawn last is drawn again.
    pub fn update_work(&self) -> u32 {
        self.flights.work()
    }

    /// The front board (0) or the back board (any other number).
    pub fn board_mut(&mut self, number: u32) -> &mut Board {
        &mut self.boards[number.min(1) as usize]
    }

    /// u of each column of the surfaces and of the piles.
    pub fn columns(&self) -> &[f32] {
        &self.flights.pattern().u
    }

    /// Rows of every flight's surface.
    pub fn rows(&self) -> usize {
        ROWS
    }

    /// The pages at rest on a side, as of the last update.
    pub fn pile(&self, side: Side) -> &Pile {
        match side {
            Side::Right => &self.drawn[0],
            Side::Left => &self.drawn[1],
        }
    }
}

/// How far a board at `angle` above the pile it shuts has pressed the pages
/// flat: 0 from upright on, 1 when shut.
fn closing(angle: f32) -> f32 {
    let t = (1.0 - angle / core::f32::consts::FRAC_PI_2).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
