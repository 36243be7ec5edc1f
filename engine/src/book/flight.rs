//! One leaf in flight: its leaf of paper, and what is drawn of it.

use super::block::Pile;
use super::clear::{Drawn, clear, find_bends};
use super::crossing::{Blocks, is_past};
use super::leaf::{Leaf, NODES, Phase};
use super::mesh::Mesh;
use super::seat::{lift, lift_edges, seat};
use crate::grid::Side;
use crate::surface::Surface;
use crate::vector::{dot, sub};

/// By how much drawn leaves may go through each other and only touch, metres: where a hand
/// has crumpled one, and where they are smooth.
pub type Touch = [f32; 2];

/// How far what is drawn of a leaf may be on the wrong side of the next at the spine,
/// metres.
const ASTRAY: f32 = 5e-5;

/// By how much facets between nodes may go through each other, metres, as arcs on either
/// side of them do not.
const DEEP: f32 = 1.5e-3;

/// Farther than this from the spine nothing is drawn in a leaf's place, metres.
const FARTHEST: f32 = 1e3;

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
    blocks: Blocks,
    /// What was drawn of it last, and what is wanted to be drawn now.
    shown: Vec<f32>,
    wanted: Vec<f32>,
    held_back: bool,
    /// Whether it may have come through a neighbour in the last tick, and since it was
    /// drawn last.
    astray: bool,
    wary: bool,
    /// Whether it is kept clear of its neighbours thoroughly.
    careful: bool,
    /// Whether the surface holds what is to be drawn in the sheet's place.
    dressed: bool,
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
            blocks: Blocks::default(),
            shown: Vec::new(),
            wanted: Vec::new(),
            held_back: false,
            astray: false,
            wary: false,
            careful: false,
            dressed: false,
            cells: u.iter().map(cell).collect(),
        }
    }

    /// Begins at rest on side `from`: `low` leaves lie left of it, `high` with it.
    pub fn take_up(&mut self, id: u32, from: Side, low: u32, high: u32) {
        (self.id, self.low, self.high) = (id, low, high);
        self.leaf.lay(from);
        self.shown.clear();
        (self.astray, self.wary) = (false, false);
        self.dressed = false;
    }

    /// Its number.
    pub fn id(&self) -> u32 {
        self.id
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

    /// The leaves that it stands for, by how far it has turned.
    pub fn leaves_turned(&self) -> f32 {
        self.leaf.share_turned() * self.leaves() as f32
    }

    /// What is drawn of it.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The leaf's points over a flat table as it is now, for another model to write over:
    /// what they hold then is drawn next in place of the leaf itself.
    pub fn dress(&mut self) -> &mut [f32] {
        self.leaf.write_surface(&mut self.surface);
        self.dressed = true;
        &mut self.surface.positions
    }

    /// Draws the leaf as it is now, or as it is [dressed](Self::dress), between the piles
    /// (right and left); `wary` says that it may be drawn through a neighbour.
    pub fn draw(&mut self, [right, left]: [&Pile; 2], wary: bool) {
        let is_crumpled = core::mem::take(&mut self.held_back) || self.leaf.was_held();
        self.wary |= is_crumpled || wary;
        // What else was written would be drawn as nothing, or as nothing but itself.
        let is_place = |x: &f32| x.abs() <= FARTHEST;
        let is_dressed = core::mem::take(&mut self.dressed);
        if !is_dressed || !self.surface.positions.iter().all(is_place) {
            self.leaf.write_surface(&mut self.surface);
        }
        seat(&mut self.surface.positions, right, left);
        self.surface.update_normals();
        self.wanted.clone_from(&self.surface.positions);
        if core::mem::take(&mut self.careful) {
            self.bends.fill(0.0);
        }
        if is_crumpled {
            self.take_care();
        }
    }

    /// Draws it once more as it was before others moved it, to be kept clear of them
    /// thoroughly if it is wary or `met` one.
    pub fn draw_again(&mut self, met: bool) {
        self.surface.positions.clone_from(&self.wanted);
        self.surface.update_normals();
        self.wary |= met;
        if self.wary {
            self.take_care();
        }
    }

    /// Has it kept clear of its neighbours thoroughly in this picture.
    fn take_care(&mut self) {
        if !core::mem::replace(&mut self.careful, true) {
            find_bends(&self.surface, &mut self.bends);
        }
    }

    /// Moves what is drawn of it off the neighbour on a side.
    pub fn clear_of(&mut self, neighbour: &Flight, side: Side) {
        // A leaf lies on the recto's side of the one on its right.
        let (slot, sign) = match side {
            Side::Left => (0, -1.0),
            Side::Right => (1, 1.0),
        };
        let grid = (&self.cells[..], self.surface.rows);
        clear(
            (&mut self.surface, &self.bends),
            &neighbour.drawn(),
            sign,
            self.careful || neighbour.careful,
            probed(&self.leaf, &neighbour.leaf, slot, grid),
            probed(&neighbour.leaf, &self.leaf, 1 - slot, grid),
        );
        self.surface.update_normals();
    }

    /// What is drawn of it.
    fn drawn(&self) -> Drawn<'_> {
        Drawn {
            surface: &self.surface,
            bends: &self.bends,
        }
    }

    /// Lifts what others pushed into the piles (right and left) out of them, so far over
    /// each, metres.
    pub fn lift_off(&mut self, piles: [&Pile; 2], over: [f32; 2]) {
        lift(&mut self.surface.positions, piles, over);
        if !self.leaf.is_down() {
            lift_edges(&mut self.surface.positions, piles, over);
        }
    }

    /// Whether what is drawn of it goes through what is drawn of the one on its right.
    pub fn is_drawn_through(&mut self, right: &mut Flight, [crumpled, smooth]: Touch) -> bool {
        if !self.wary && !right.wary {
            return false;
        }
        let is_crumpled = |flight: &Flight| flight.held_back || flight.leaf.was_held();
        let touch = if is_crumpled(self) || is_crumpled(right) {
            crumpled
        } else {
            smooth
        };
        let [own, other] = [&self.surface, &right.surface].map(Mesh::of);
        self.blocks.cut(own);
        right.blocks.cut(other);
        is_past(own, other, ASTRAY) || self.blocks.cross(&right.blocks, touch)
    }

    /// Says that its paper may be asked about: see [`is_through`](Self::is_through).
    pub fn cut(&mut self) {
        self.blocks.cut(self.leaf.seated().mesh());
    }

    /// Whether its paper goes through that of the one on its right, both as they were
    /// when they were last [cut](Self::cut).
    pub fn is_through(&self, right: &Flight) -> bool {
        let [own, other] = [self, right].map(|flight| flight.leaf.seated().mesh());
        is_past(own, other, DEEP) || self.blocks.cross(&right.blocks, DEEP)
    }

    /// Begins to look for what can be drawn of it, short of what is wanted.
    pub fn hold_back(&mut self) {
        if self.held_back {
            return;
        }
        (self.held_back, self.wary) = (true, true);
        self.wanted.clone_from(&self.surface.positions);
        if self.shown.is_empty() {
            self.shown.clone_from(&self.surface.positions);
        }
    }

    /// Draws a part of the way from what was drawn last to what is wanted.
    pub fn draw_part(&mut self, part: f32) {
        let ways = self.shown.iter().zip(&self.wanted);
        for (place, (from, to)) in self.surface.positions.iter_mut().zip(ways) {
            *place = from + part * (to - from);
        }
        self.surface.update_normals();
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
    pub fn set_astray(&mut self, astray: bool, wary: bool) {
        self.astray = astray;
        self.wary |= astray || wary;
    }

    /// Whether it may have come through a neighbour in the last tick.
    pub fn is_astray(&self) -> bool {
        self.astray
    }

    /// Keeps what is drawn now, as the way to the next begins there.
    pub fn show(&mut self) {
        self.wary = false;
        self.shown.clone_from(&self.surface.positions);
        self.surface.touch();
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
        both_down || leaf.seated().is_close(slot, cells[column], row)
    }
}
