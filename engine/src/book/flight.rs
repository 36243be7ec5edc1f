//! One leaf in flight: its leaf of paper, and what is drawn of it.

mod through_itself;

use core::sync::atomic::{AtomicU32, Ordering};

use super::bend_into_gutter::{Over, bend_into_gutter, is_clear, push_edges_off, push_off};
use super::creased_mesh::CreasedMesh;
use super::leaf::Leaf;
use super::limits::{FARTHEST, NODES};
use super::phase::Phase;
use super::pile::Pile;
use crate::contact::crossing::{Tiles, is_fore_edge_past, is_past};
use crate::contact::flap_order::FlapOrder;
use crate::contact::flaps::is_turned_over;
use crate::contact::mesh::{Folds, Mesh};
use crate::contact::separate::{DrawnLeaf, find_bends, separate};
use crate::contact::separate_folded::{
    MovedLeaf, Order, Outcome, PartedLeaf, PlacedBlocks, push_off_leaf,
};
use crate::contact::separate_parts::{DrawnParts, ROUNDS};
use crate::contact::tolerance::{AT_FACET, DEEP, NOT_UPON, PAST_AT_SPINE};
use crate::contact::work::Work;
use crate::creased_only::CreasedOnly;
use crate::grid::Side;
use crate::models::sheet::SheetCrease;
use crate::paper_mesh::PaperMesh;
use crate::surface::Surface;
use crate::vector::{dot, sub};

/// By how much drawn leaves of a page 0.14 m wide may go through each other and only touch, metres: where a grab
/// has crumpled one, and where they are smooth.
pub type Tolerance = [f32; 2];

/// Leaves that were ever creased: each has a mesh of another number, also where it takes the
/// place of one that is gone.
static CREASINGS: AtomicU32 = AtomicU32::new(0);

/// Work of moving what is drawn of a flight, and of cutting it, nanoseconds.
pub const MOVING: u32 = 40_000;
pub const CUTTING: u32 = 10_000;

/// Work of looking whether the fore-edge of one of two leaves has passed the other, nanoseconds.
const FORE_EDGES: u32 = 10_000;

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
    /// others, by its own weight, or as it is drawn in the sheet's place.
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

    /// The leaf's points over a flat table as it is now, for another model to write over:
    /// what they hold then is drawn next in place of the leaf itself.
    pub fn override_surface(&mut self) -> &mut [f32] {
        self.leaf.write_surface(&mut self.surface);
        self.overridden = true;
        &mut self.surface.positions
    }

    /// Draws the leaf as it is now, or as it is [overridden](Self::override_surface), between the piles
    /// (right and left); `needs_crossing_test` says that it may be drawn through a neighbour. `last` are the
    /// piles that were drawn last.
    pub fn draw(&mut self, [right, left]: [&Pile; 2], last: [&Pile; 2], needs_crossing_test: bool) {
        self.clear_of = [None; 2];
        self.rounds = 0;
        self.parts.forget();
        let is_crumpled = self.is_crumpled();
        self.needs_crossing_test |= core::mem::take(&mut self.held_back);
        // What else was written would be drawn as nothing, or as nothing but itself.
        let is_place = |x: &f32| x.abs() <= FARTHEST;
        let is_overridden =
            core::mem::take(&mut self.overridden) && self.surface.positions.iter().all(is_place);
        self.needs_crossing_test |=
            is_crumpled || is_overridden || needs_crossing_test || self.had_crossing;
        self.is_bent_back = is_overridden
            || ((is_crumpled || self.was_driven) && self.leaf.in_book_space().is_bent_back());
        // A large page folds by its own weight, or by the wind. A creased one is folded where it
        // may be.
        let is_curled = self.leaf.in_book_space().is_curled();
        self.may_be_folded =
            (is_crumpled || self.is_bent_back || is_curled) && self.creased.is_none();
        if !is_overridden {
            self.leaf.write_surface(&mut self.surface);
        }
        let straightness = self.leaf.straightness();
        let creased = self.creased.as_ref();
        let beyond = creased.map(|creased| &creased.beyond[..]);
        let how = (straightness, beyond.into());
        bend_into_gutter(&mut self.surface.positions, right, left, how);
        let scale = self.scale();
        if let Some((layers, part)) = self.leaf.drawn_shut() {
            let points = self.surface.positions.as_chunks_mut::<3>().0;
            layers.lay(points, part, scale);
        }
        self.surface.update_normals();
        self.find_turned_over();
        if self.shown.is_empty() {
            // What is drawn of others next to it may have it drawn so for as long as they move.
            self.separate_own_parts(ROUNDS, &mut Work::new(u32::MAX));
        }
        self.wanted.clone_from(&self.surface.positions);
        if self.shown.is_empty() {
            self.show_at_rest(last);
        }
        if core::mem::take(&mut self.full_precision) {
            self.bends.fill(0.0);
        }
        if is_crumpled {
            self.use_full_precision();
        }
    }

    /// Finds which of its points are folded over. Those on creases are not.
    fn find_turned_over(&mut self) {
        self.turned_over.clear();
        let shut = self.leaf.shut_creases();
        self.shut = shut;
        let Some(mesh) = self.creased.as_ref().filter(|_| shut != 0) else {
            return;
        };
        self.turned_over.resize(mesh.paper.places.len(), true);
        for (corners, part) in mesh.paper.parted_triangles() {
            if !is_turned_over(part, shut) {
                for corner in corners {
                    self.turned_over[corner] = false;
                }
            }
        }
    }

    /// Says that it was drawn last as the page upon one of the piles, which it was; a creased one
    /// too, as in a pile no folds are drawn.
    fn show_at_rest(&mut self, [right, left]: [&Pile; 2]) {
        let (pile, side) = if self.leaf.fraction_turned() < 0.5 {
            (right, Side::Right)
        } else {
            (left, Side::Left)
        };
        let columns = pile.columns();
        self.shown.clone_from(&self.surface.positions);
        let points = self.shown.as_chunks_mut::<3>().0;
        if let Some(creased) = self.creased.as_ref() {
            // Its columns are moved onto its creases.
            let settings = self.leaf.sheet().settings();
            let size = [settings.width, settings.height].map(|length| length as f32);
            for (point, [u, v]) in points.iter_mut().zip(&creased.paper.places) {
                *point = [side.sign() * u * size[0], v * size[1], 0.0];
            }
            bend_into_gutter(&mut self.shown, right, left, (0.0, CreasedOnly::NONE));
            return;
        }
        for row in points.chunks_exact_mut(columns) {
            let y = row[0][1];
            let curve = pile.curves().as_chunks::<2>().0;
            for (point, [x, z]) in row.iter_mut().zip(curve) {
                *point = [*x, y, *z];
            }
        }
    }

    /// Draws it once more as it was before others moved it, to be kept clear of them
    /// thoroughly if it `met` one or a grab has crumpled it.
    pub fn draw_again(&mut self, met: bool) {
        self.surface.positions.clone_from(&self.wanted);
        self.surface.update_normals();
        self.rounds = 0;
        self.revision += 1;
        self.had_crossing |= met;
        self.needs_crossing_test |= met;
        if met || self.is_crumpled() {
            self.use_full_precision();
        }
    }

    /// Has it kept clear of its neighbours thoroughly in this picture.
    fn use_full_precision(&mut self) {
        if !core::mem::replace(&mut self.full_precision, true) {
            find_bends(&self.surface, &mut self.bends);
        }
    }

    /// Moves what is drawn of it off the neighbour on a side.
    pub fn separate_from(&mut self, neighbour: &Flight, side: Side, work: &mut Work) {
        self.revision += 1;
        // A leaf lies on the recto's side of the one on its right.
        let (slot, sign) = match side {
            Side::Left => (0, -1.0),
            Side::Right => (1, 1.0),
        };
        let grid = (&self.cells[..], self.surface.rows);
        let scale = self.scale();
        let folds = folds(self.creased.as_ref(), &self.turned_over);
        separate(
            (&mut self.surface, &self.bends, folds),
            &neighbour.drawn(),
            [sign, scale],
            self.full_precision || neighbour.full_precision,
            [
                &probed(&self.leaf, &neighbour.leaf, slot, grid),
                &probed(&neighbour.leaf, &self.leaf, 1 - slot, grid),
            ],
            work,
        );
        self.surface.update_normals();
    }

    /// Moves the rim of what is drawn of it off the flight after its neighbour on a side, which it meets
    /// beyond that neighbour's rim, and itself off the rim of that flight.
    pub fn separate_rim_from(&mut self, after_next: &Flight, side: Side, work: &mut Work) {
        self.revision += 1;
        let sign = match side {
            Side::Left => -1.0,
            Side::Right => 1.0,
        };
        let [columns, rows] = [self.surface.columns, self.surface.rows];
        let is_rim =
            |column: usize, row: usize| column + 1 == columns || row == 0 || row + 1 == rows;
        let scale = self.scale();
        separate(
            (&mut self.surface, &self.bends, Folds::default()),
            &after_next.drawn(),
            [sign, scale],
            self.full_precision || after_next.full_precision,
            [&is_rim; 2],
            work,
        );
        self.surface.update_normals();
    }

    /// What is drawn of it.
    fn drawn(&self) -> DrawnLeaf<'_> {
        DrawnLeaf {
            surface: &self.surface,
            bends: &self.bends,
            folds: folds(self.creased.as_ref(), &self.turned_over),
        }
    }

    /// Pushes what others moved into the piles (right and left) out of them, so far over
    /// each, metres for a page 0.14 m wide.
    pub fn push_off_piles(&mut self, piles: [&Pile; 2], over: [f32; 2], work: &mut Work) {
        self.revision += 1;
        let over = Over::of(over, self.scale());
        push_off(&mut self.surface.positions, piles, over);
        self.separate_own_parts(ROUNDS, work);
        self.keep_off_piles(piles, over);
    }

    /// Pushes points and edges out of the piles (right and left), so far over each.
    fn keep_off_piles(&mut self, piles: [&Pile; 2], over: Over) {
        push_off(&mut self.surface.positions, piles, over);
        if !matches!(self.phase(), Phase::Resting(_)) {
            let folds = folds(self.creased.as_ref(), &self.turned_over);
            push_edges_off(&mut self.surface.positions, folds, piles, over);
        }
    }

    /// Moves its own parts off each other, in so many rounds at most; once no work is left only
    /// while there were fewer than [`ROUNDS`] since it was to be drawn anew. Returns whether any
    /// were moved in the last.
    fn separate_own_parts(&mut self, rounds: usize, work: &mut Work) -> bool {
        if work.is_spent() && self.rounds >= ROUNDS {
            return false;
        }
        self.rounds += rounds;
        let within = (self.scale(), rounds);
        self.leaf.flaps().is_some_and(|flaps| {
            let surface = &mut self.surface;
            self.parts.separate_flaps(surface, flaps, within, work)
        })
    }

    /// Whether it is creased.
    pub fn is_creased(&self) -> bool {
        !self.creased.is_none()
    }

    /// Finds the parts of what is drawn of it, to be kept clear of a creased neighbour.
    pub fn find_parts(&mut self) {
        if self.parts.blocks.is_empty() {
            self.parts = DrawnParts::whole(self.surface.columns, self.surface.rows);
        }
    }

    /// Finds how parts of it and of the one on its right lie upon each other as they are drawn.
    pub fn order_flaps(&mut self, right: &mut Flight) {
        let [own, other] = [&*self, right].map(|flight| Mesh {
            folds: folds(flight.creased.as_ref(), &flight.turned_over),
            ..Mesh::of(&flight.surface)
        });
        let order = FlapOrder::of(own, other);
        self.flap_order[1] = order;
        right.flap_order[0] = order.reversed();
    }

    /// Whether parts of it lie upon parts of the neighbour on a side, or under these, as both lie open.
    pub fn lies_open_beside(&self, side: Side) -> bool {
        self.flap_order[usize::from(side == Side::Right)].lie_open()
    }

    /// Moves what is drawn of it out of the piles (right and left), so far over each, its parts
    /// off each other, and all of it off the neighbour on a side, until it is clear of all.
    /// One of the two is creased, and the [parts](Self::find_parts) of both are known.
    pub fn separate_folded(
        &mut self,
        neighbour: Option<(&Flight, Side)>,
        piles: [&Pile; 2],
        over: [f32; 2],
        work: &mut Work,
    ) {
        let scale = self.scale();
        let over = Over::of(over, scale);
        let before = self.surface.positions.clone();
        let mut seen = Vec::new();
        let mut placed = neighbour.map(|(flight, _)| PlacedBlocks::of(&flight.parted()));
        // A round looks only at what moved since the one before it.
        let (mut is_clear, mut is_covered, mut crosses) = (false, false, false);
        let mut is_resolved = false;
        for _ in 0..ROUNDS {
            self.keep_off_piles(piles, over);
            let are_parts_clear = !self.is_creased() || !self.separate_own_parts(1, work);
            if let (Some((neighbour, side)), Some(placed)) = (neighbour, &mut placed) {
                if work.is_spent() {
                    is_clear = false;
                    break;
                }
                let (slot, side) = match side {
                    Side::Left => (0, -1.0),
                    Side::Right => (1, 1.0),
                };
                let order = Order {
                    side,
                    scale,
                    parts: self.flap_order[slot],
                };
                let mut own = MovedLeaf {
                    points: self.surface.positions.as_chunks_mut::<3>().0,
                    parts: &self.parts,
                    shut: self.shut,
                    seen: &mut seen,
                };
                let other = neighbour.parted();
                let outcome = push_off_leaf(&mut own, &other, placed, order, work);
                crosses |= outcome == Outcome::Crosses;
                is_clear = outcome <= Outcome::Covered;
                is_covered |= outcome == Outcome::Covered;
            }
            is_resolved = are_parts_clear && (is_clear || neighbour.is_none());
            if is_resolved {
                break;
            }
        }
        if !is_resolved {
            // What the last round moved may be in a pile, and no pile yields.
            let moved = self.surface.positions.clone();
            self.keep_off_piles(piles, over);
            is_clear &= self.surface.positions == moved;
        }
        if self.surface.positions != before {
            self.revision += 1;
            self.surface.update_normals();
        }
        if let Some((neighbour, side)) = neighbour.filter(|_| is_clear && !is_covered && !crosses) {
            let slot = usize::from(side == Side::Right);
            self.clear_of[slot] = Some([self.revision, neighbour.revision]);
        }
    }

    /// Whether it was found to lie clear of the one on its right as both are to be drawn.
    pub fn is_known_clear_of(&self, right: &Flight) -> bool {
        let [own, other] = [self.revision, right.revision];
        self.clear_of[1] == Some([own, other]) || right.clear_of[0] == Some([other, own])
    }

    fn parted(&self) -> PartedLeaf<'_> {
        PartedLeaf {
            points: self.surface.positions.as_chunks::<3>().0,
            parts: &self.parts,
            shut: self.shut,
        }
    }

    /// Whether it may be drawn through another or through itself.
    pub fn needs_crossing_test(&self) -> bool {
        self.needs_crossing_test
    }

    /// Cuts what is drawn of it, to be looked at for [crossings](Self::is_drawn_through).
    pub fn cut_drawn(&mut self) {
        let folds = folds(self.creased.as_ref(), &self.turned_over);
        self.tiles.cut(Mesh {
            folds,
            ..Mesh::of(&self.surface)
        });
    }

    /// Whether it may reach round others in flight.
    pub fn may_be_crumpled(&self) -> bool {
        self.is_crumpled() || self.is_bent_back || self.held_back
    }

    fn is_crumpled(&self) -> bool {
        self.leaf.was_held()
    }

    /// Whether what is drawn of it goes through what is drawn of one on its right, or has
    /// passed its neighbour there; both as they were when they were [cut](Self::cut_drawn)
    /// last.
    pub fn is_drawn_through(
        &self,
        right: &Flight,
        is_neighbour: bool,
        [crumpled, smooth]: Tolerance,
        work: &mut Work,
    ) -> bool {
        let tolerance = if self.is_crumpled() || right.is_crumpled() {
            crumpled
        } else {
            smooth
        };
        let scale = self.scale();
        (is_neighbour && self.is_drawn_past(right))
            || self.tiles.cross(&right.tiles, tolerance * scale, work)
            || (is_neighbour && self.has_fore_edge_past(right, tolerance * scale, work))
    }

    /// Whether the fore-edge of one of what is drawn of it and of its neighbour on its right has passed
    /// the other: at a small angle leaves only graze each other where they cross, and are deep in each
    /// other where they end. Parts of creased ones are [moved](Self::separate_folded) off each other
    /// until they are clear.
    fn has_fore_edge_past(&self, right: &Flight, tolerance: f32, work: &mut Work) -> bool {
        if self.is_creased() || right.is_creased() {
            return false;
        }
        let [own, other] = [&self.surface, &right.surface].map(Mesh::of);
        work.spend(FORE_EDGES);
        let within = [tolerance, NOT_UPON * self.scale()];
        is_fore_edge_past(own, other, 1.0, within) || is_fore_edge_past(other, own, -1.0, within)
    }

    /// Whether what is drawn of it has passed its neighbour on its right at the spine.
    pub fn is_drawn_past(&self, right: &Flight) -> bool {
        let [own, other] = [&self.surface, &right.surface].map(Mesh::of);
        is_past(own, other, PAST_AT_SPINE * self.scale())
    }

    /// Whether it may be drawn through itself.
    pub fn may_be_folded(&self) -> bool {
        // What is held back is turned and moved off others picture after picture.
        self.may_be_folded || self.was_drawn_folded || self.held_back
    }

    /// Whether what is drawn of it goes through itself, as it was when it was
    /// [cut](Self::cut_drawn) last.
    pub fn is_drawn_through_itself(&mut self, work: &mut Work) -> bool {
        self.tiles.cross_themselves(AT_FACET * self.scale(), work)
    }

    /// Whether what is drawn of it lies clear of the piles (right and left).
    pub fn is_clear_of(&self, piles: [&Pile; 2]) -> bool {
        let folds = folds(self.creased.as_ref(), &self.turned_over);
        is_clear(&self.surface.positions, folds, piles)
    }

    /// Says that its paper may be tested: see [`is_through`](Self::is_through).
    pub fn cut(&mut self) {
        self.searching += CUTTING;
        self.tiles.cut(self.leaf.in_book_space().mesh());
    }

    /// Whether its paper goes through that of the one on its right, both as they were
    /// when they were last [cut](Self::cut).
    pub fn is_through(&mut self, right: &Flight) -> bool {
        let deep = DEEP * self.scale();
        let [own, other] = [&*self, right].map(|flight| flight.leaf.in_book_space().mesh());
        let work = &mut Work::new(u32::MAX);
        let is_through = is_past(own, other, deep) || self.tiles.cross(&right.tiles, deep, work);
        self.searching = self.searching.saturating_add(work.done());
        is_through
    }

    /// Returns the work since it was last asked, nanoseconds as counted: its leaf's, and that of
    /// looking for where its paper goes through itself or another.
    pub fn take_work(&mut self) -> u32 {
        let searching = core::mem::take(&mut self.searching);
        self.leaf.take_work().saturating_add(searching)
    }

    /// Keeps what is drawn now as what is wanted.
    pub fn want(&mut self) {
        self.wanted.clone_from(&self.surface.positions);
    }

    /// Draws what was drawn last, turned about the spine as far as its paper has turned since: to
    /// where it is nearest to what is wanted.
    pub fn draw_carried(&mut self) {
        let pairs = self.shown.as_chunks::<3>().0.iter();
        let pairs = pairs.zip(self.wanted.as_chunks::<3>().0);
        let [cos, sin] = pairs.fold([0.0f32; 2], |[cos, sin], ([x, _, z], [to_x, _, to_z])| {
            [cos + x * to_x + z * to_z, sin + x * to_z - z * to_x]
        });
        let length = (cos * cos + sin * sin).sqrt();
        self.draw_turned(if length > 0.0 {
            [cos / length, sin / length]
        } else {
            [1.0, 0.0]
        });
    }

    /// Draws what was drawn last.
    pub fn draw_last(&mut self) {
        self.draw_turned([1.0, 0.0]);
    }

    /// Draws what was drawn last turned about the spine, by the cosine and the sine of an angle.
    fn draw_turned(&mut self, [cos, sin]: [f32; 2]) {
        self.revision += 1;
        (self.held_back, self.needs_crossing_test) = (true, true);
        self.surface.positions.clone_from(&self.shown);
        for [x, _, z] in self.surface.positions.as_chunks_mut::<3>().0 {
            [*x, *z] = [cos * *x - sin * *z, cos * *z + sin * *x];
        }
        self.surface.update_normals();
    }

    /// Where its points would be drawn if it were not held back.
    pub fn target(&self) -> &[f32] {
        &self.wanted
    }

    /// How far what is drawn is from where it would be if it were not held back, metres.
    pub fn lag(&self) -> f32 {
        if !self.held_back {
            return 0.0;
        }
        let points = [&self.surface.positions, &self.wanted].map(|p| p.as_chunks::<3>().0);
        let apart = points[0].iter().zip(points[1]).map(|(p, q)| {
            let away = sub(*p, *q);
            dot(away, away)
        });
        apart.fold(0.0, f32::max).sqrt()
    }

    /// Says whether it may have come through a neighbour in a tick, and whether it may be
    /// drawn through one.
    pub fn set_may_have_tunnelled(&mut self, may_have_tunnelled: bool, needs_crossing_test: bool) {
        self.may_have_tunnelled = may_have_tunnelled;
        self.needs_crossing_test &= !core::mem::take(&mut self.was_drawn);
        self.needs_crossing_test |= may_have_tunnelled || needs_crossing_test;
        self.was_driven |= needs_crossing_test;
    }

    /// Whether it may have come through a neighbour in the last tick.
    pub fn may_have_tunnelled(&self) -> bool {
        self.may_have_tunnelled
    }

    /// Keeps what is drawn now, as the way to the next begins there.
    pub fn show(&mut self) {
        self.was_drawn = true;
        self.was_drawn_folded = self.may_be_folded || self.held_back;
        self.shown.clone_from(&self.surface.positions);
        self.surface.touch();
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

/// Says of a drawn point of a leaf, by its column and row, whether it may touch a neighbour,
/// the left (0) or the right (1). Given are the leaf's cells in which its drawn columns lie,
/// and how many rows are drawn.
fn probed<'a>(
    leaf: &'a Leaf,
    neighbour: &Leaf,
    slot: usize,
    (cells, rows): (&'a [usize], usize),
) -> impl Fn(usize, usize) -> bool + use<'a> {
    let both_down = leaf.is_down() && neighbour.is_down();
    move |column, row| {
        let row = row * (NODES[1] - 1) / rows;
        both_down || leaf.in_book_space().is_close(slot, cells[column], row)
    }
}
