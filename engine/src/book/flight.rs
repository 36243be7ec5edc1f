//! One leaf in flight: its leaf of paper, and what is drawn of it.

mod crossings;
mod drawing;
mod separation;
mod through_itself;

use core::sync::atomic::{AtomicU32, Ordering};

pub use crossings::Tolerance;

use super::creased_mesh::CreasedMesh;
use super::leaf::Leaf;
use super::limits::NODES;
use super::phase::Phase;
use crate::contact::crossing::Tiles;
use crate::contact::drawn_parts::DrawnParts;
use crate::contact::flap_order::FlapOrder;
use crate::contact::mesh::Folds;
use crate::creased_only::CreasedOnly;
use crate::grid::Side;
use crate::models::sheet::SheetCrease;
use crate::paper_mesh::PaperMesh;
use crate::surface::Surface;

/// Leaves that were ever creased: each has a mesh of another number, also where it takes the
/// place of one that is gone.
static CREASINGS: AtomicU32 = AtomicU32::new(0);

/// Work of moving what is drawn of a flight, and of cutting it, nanoseconds.
pub const MOVING: u32 = 40_000;
pub const CUTTING: u32 = 10_000;

/// The number of what is not in flight but lies creased upon a pile.
pub const LYING: u32 = 0;

/// One leaf in flight; it may stand for several.
pub struct Flight {
    id: u32,
    low: u32,
    high: u32,
    leaf: Leaf,
    surface: Surface,
    /// For each column of the surface the leaf's cell that it lies in.
    cells: Vec<usize>,
    /// How much the surface bends at each of its points, metres.
    bends: Vec<f32>,
    tiles: Tiles,
    /// What was drawn of it last, and what is wanted to be drawn now.
    shown: Vec<f32>,
    wanted: Vec<f32>,
    held_back: bool,
    /// Whether it may have come through a neighbour in the last tick, and since it was
    /// drawn last.
    may_have_tunnelled: bool,
    needs_crossing_test: bool,
    /// Whether it has been drawn since the last tick.
    was_drawn: bool,
    /// Whether it is kept clear of its neighbours thoroughly.
    full_precision: bool,
    /// Whether the surface holds what is to be drawn in the sheet's place.
    overridden: bool,
    /// Whether what is wanted, and what was drawn last, may be bent back on itself: by a grab, by
    /// others, by its own weight, along its creases, or as it is drawn in the sheet's place.
    may_be_folded: bool,
    was_drawn_folded: bool,
    /// Whether it is then bent so far that it may reach round others.
    is_bent_back: bool,
    was_driven: bool,
    /// Whether it was found to go through a neighbour since it was taken up: where its paper
    /// did once, it may still.
    had_crossing: bool,
    /// Whether its paper went through itself after the last tick, and room to find out.
    was_through: bool,
    spare: Surface,
    /// Work of looking for where its paper goes through itself or another since it was last
    /// taken, nanoseconds.
    searching: u32,
    creased: CreasedOnly<CreasedMesh>,
    /// Rounds in which its parts have been moved off each other since it was last to be drawn anew.
    rounds: usize,
    /// The parts of what is drawn; of a whole leaf none until a creased one is next to it.
    parts: DrawnParts,
    /// The creases that are shut as it is drawn: see [`Flaps::shut`](crate::contact::flaps::Flaps::shut).
    shut: u16,
    /// Which points are folded over; empty where none is.
    turned_over: Vec<bool>,
    /// How its parts are drawn upon those of the left and of the right neighbour.
    flap_order: [FlapOrder; 2],
    /// Rises whenever what is to be drawn of it moves.
    revision: u32,
    /// The revisions of it and of its left and its right neighbour at which it was found to lie
    /// clear of that in this picture.
    clear_of: [Option<[u32; 2]>; 2],
}

impl Flight {
    /// A flight of a leaf, drawn at the columns `u` and at `rows` rows.
    pub fn new(leaf: Leaf, u: &[f32], rows: usize) -> Flight {
        let last = NODES[0] - 2;
        let cell = |u: &f32| ((u * (last + 1) as f32) as usize).min(last);
        Flight {
            id: 0,
            low: 0,
            high: 0,
            leaf,
            surface: Surface::new(u.len(), rows),
            bends: vec![0.0; u.len() * rows],
            tiles: Tiles::default(),
            shown: Vec::new(),
            wanted: Vec::new(),
            held_back: false,
            may_have_tunnelled: false,
            needs_crossing_test: false,
            was_drawn: false,
            full_precision: false,
            overridden: false,
            may_be_folded: false,
            was_drawn_folded: false,
            is_bent_back: false,
            was_driven: false,
            had_crossing: false,
            was_through: false,
            spare: Surface::new(u.len(), rows),
            searching: 0,
            creased: CreasedOnly::NONE,
            rounds: 0,
            parts: DrawnParts::default(),
            shut: 0,
            turned_over: Vec::new(),
            flap_order: [FlapOrder::NONE; 2],
            revision: 0,
            clear_of: [None; 2],
            cells: u.iter().map(cell).collect(),
        }
    }

    /// Begins at rest on side `from`: `low` leaves lie left of it, `high` with it.
    pub fn take_up(&mut self, id: u32, from: Side, low: u32, high: u32) {
        (self.id, self.low, self.high) = (id, low, high);
        self.leaf.lay(from);
        self.shown.clear();
        self.was_drawn_folded = false;
        (self.may_have_tunnelled, self.needs_crossing_test) = (false, false);
        self.overridden = false;
        (self.was_driven, self.was_through, self.had_crossing) = (false, false, false);
    }

    /// Creases its leaf along lines: see [`Leaf::crease`].
    pub fn crease(&mut self, creases: &[SheetCrease]) -> bool {
        if !self.leaf.crease(creases) {
            return false;
        }
        let sheet = self.leaf.sheet();
        let columns = sheet.drawn_columns();
        let mesh = sheet.paper_mesh();
        let parts = mesh.as_ref().map(|mesh| DrawnParts::of(mesh, columns));
        self.parts = parts.unwrap_or_default();
        self.creased = mesh.map(|mesh| CreasedMesh::of(mesh, columns)).into();
        self.surface.topology = CREASINGS.fetch_add(1, Ordering::Relaxed).wrapping_add(1);
        true
    }

    /// How its drawn mesh lies on the flat paper where its leaf is creased.
    pub fn paper_mesh(&self) -> Option<&PaperMesh> {
        self.creased.as_ref().map(|creased| &creased.paper)
    }

    /// Gives it another number, as it lies or is picked up from there.
    pub fn call(&mut self, id: u32) {
        self.id = id;
    }

    /// Its number.
    pub fn id(&self) -> u32 {
        self.id
    }

    /// Whether it is a creased leaf that lies uppermost upon a pile, and not in flight.
    pub fn lies(&self) -> bool {
        self.id == LYING && self.is_creased()
    }

    /// Leaves on the left of the book while it lies on the right.
    pub fn low(&self) -> u32 {
        self.low
    }

    /// Leaves on the left of the book when it lies on the left.
    pub fn high(&self) -> u32 {
        self.high
    }

    /// Leaves of paper that it stands for.
    pub fn leaves(&self) -> u32 {
        self.high - self.low
    }

    /// What it is doing.
    pub fn phase(&self) -> Phase {
        self.leaf.phase()
    }

    /// What is drawn of it.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Whether it is creased.
    pub fn is_creased(&self) -> bool {
        !self.creased.is_none()
    }

    fn is_crumpled(&self) -> bool {
        self.leaf.was_held()
    }

    /// Returns the work since it was last asked, nanoseconds as counted: its leaf's, and that of
    /// looking for where its paper goes through itself or another.
    pub fn take_work(&mut self) -> u32 {
        let searching = core::mem::take(&mut self.searching);
        self.leaf.take_work().saturating_add(searching)
    }

    /// How much wider its page is than the one for which lengths are given.
    fn scale(&self) -> f32 {
        self.leaf.in_book_space().scale
    }

    /// Its leaf, to be held, played and stepped.
    pub fn leaf_mut(&mut self) -> &mut Leaf {
        &mut self.leaf
    }

    /// Its leaf.
    pub fn leaf(&self) -> &Leaf {
        &self.leaf
    }
}

/// What the creases of a leaf change of what is drawn of it, of which points are turned over.
fn folds<'a>(creased: Option<&'a CreasedMesh>, turned_over: &'a [bool]) -> Folds<'a> {
    Folds::of(turned_over, creased.map_or(&[], |creased| &creased.falling))
}
