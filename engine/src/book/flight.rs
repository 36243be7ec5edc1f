//! One leaf in flight: its leaf of paper, and what is drawn of it.

use super::block::Pile;
use super::clear::{Drawn, clear, find_bends};
use super::crossing::{Blocks, is_past};
use super::gutter::Gutter;
use super::leaf::Leaf;
use super::limits::NODES;
use super::mesh::Mesh;
use super::phase::Phase;
use super::seat::{is_clear, lift, lift_edges, seat};
use super::work::Work;
use crate::grid::Side;
use crate::surface::Surface;
use crate::vector::{dot, sub};

/// By how much drawn leaves of a page 0.14 m wide may go through each other and only touch, metres: where a hand
/// has crumpled one, and where they are smooth.
pub type Touch = [f32; 2];

/// How far what is drawn of a leaf of such a page may be on the wrong side of the next at the
/// spine, metres.
const ASTRAY: f32 = 5e-5;

/// Edges of a leaf of such a page of which an end is nearer than this to the plane of a facet
/// of it, metres, do not go through it: those that end in it are.
const ROUNDING: f32 = 1e-6;

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
    /// Whether it has been drawn since the last tick.
    is_drawn: bool,
    /// Whether it is kept clear of its neighbours thoroughly.
    careful: bool,
    /// Whether the surface holds what is to be drawn in the sheet's place.
    dressed: bool,
    /// Whether it may have been bent back on itself: by a hand, by others, or as it is
    /// drawn in the sheet's place.
    may_be_folded: bool,
    was_driven: bool,
    /// Whether it was found to go through a neighbour since it was taken up: where its paper
    /// did once, it may still.
    has_met: bool,
    /// Whether its paper went through itself after the last tick, and room to find out.
    was_through: bool,
    spare: Surface,
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
            is_drawn: false,
            careful: false,
            dressed: false,
            may_be_folded: false,
            was_driven: false,
            has_met: false,
            was_through: false,
            spare: Surface::new(u.len(), rows),
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
        (self.was_driven, self.was_through, self.has_met) = (false, false, false);
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
    /// (right and left); `wary` says that it may be drawn through a neighbour. `last` are the
    /// piles that were drawn last.
    pub fn draw(&mut self, [right, left]: [&Pile; 2], last: [&Pile; 2], wary: bool) {
        let is_crumpled = core::mem::take(&mut self.held_back) || self.leaf.was_held();
        // What else was written would be drawn as nothing, or as nothing but itself.
        let is_place = |x: &f32| x.abs() <= FARTHEST;
        let is_dressed =
            core::mem::take(&mut self.dressed) && self.surface.positions.iter().all(is_place);
        self.wary |= is_crumpled || is_dressed || wary || self.has_met;
        let is_bent = || self.leaf.seated().is_bent_back();
        self.may_be_folded = is_dressed || ((is_crumpled || self.was_driven) && is_bent());
        if !is_dressed {
            self.leaf.write_surface(&mut self.surface);
        }
        seat(&mut self.surface.positions, right, left);
        self.surface.update_normals();
        self.wanted.clone_from(&self.surface.positions);
        if self.shown.is_empty() {
            self.show_at_rest(last);
        }
        if core::mem::take(&mut self.careful) {
            self.bends.fill(0.0);
        }
        if is_crumpled {
            self.take_care();
        }
    }

    /// Says that it was drawn last as the page upon one of the piles, which it was.
    fn show_at_rest(&mut self, [right, left]: [&Pile; 2]) {
        let pile = if self.leaf.share_turned() < 0.5 {
            right
        } else {
            left
        };
        let columns = pile.columns();
        self.shown.clone_from(&self.surface.positions);
        let points = self.shown.as_chunks_mut::<3>().0;
        for row in points.chunks_exact_mut(columns) {
            let y = row[0][1];
            let curve = pile.curves().as_chunks::<2>().0;
            for (point, [x, z]) in row.iter_mut().zip(curve) {
                *point = [*x, y, *z];
            }
        }
    }

    /// Draws it once more as it was before others moved it, to be kept clear of them
    /// thoroughly if it `met` one or a hand has crumpled it.
    pub fn draw_again(&mut self, met: bool) {
        self.surface.positions.clone_from(&self.wanted);
        self.surface.update_normals();
        self.has_met |= met;
        self.wary |= met;
        if met || self.is_crumpled() {
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
    pub fn clear_of(&mut self, neighbour: &Flight, side: Side, work: &mut Work) {
        // A leaf lies on the recto's side of the one on its right.
        let (slot, sign) = match side {
            Side::Left => (0, -1.0),
            Side::Right => (1, 1.0),
        };
        let grid = (&self.cells[..], self.surface.rows);
        let scale = self.scale();
        clear(
            (&mut self.surface, &self.bends),
            &neighbour.drawn(),
            [sign, scale],
            self.careful || neighbour.careful,
            probed(&self.leaf, &neighbour.leaf, slot, grid),
            probed(&neighbour.leaf, &self.leaf, 1 - slot, grid),
            work,
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
    /// each, metres for a page 0.14 m wide.
    pub fn lift_off(&mut self, piles: [&Pile; 2], over: [f32; 2]) {
        let scale = self.scale();
        let over = over.map(|over| over * scale);
        lift(&mut self.surface.positions, piles, over);
        if !matches!(self.phase(), Phase::Resting(_)) {
            lift_edges(&mut self.surface.positions, piles, over);
        }
    }

    /// Whether it may be drawn through another or through itself.
    pub fn is_wary(&self) -> bool {
        self.wary
    }

    /// Cuts what is drawn of it, to be looked at for [crossings](Self::is_drawn_through).
    pub fn cut_drawn(&mut self) {
        self.blocks.cut(Mesh::of(&self.surface));
    }

    /// Whether it may reach round others in flight.
    pub fn may_be_crumpled(&self) -> bool {
        self.is_crumpled() || self.may_be_folded
    }

    fn is_crumpled(&self) -> bool {
        self.held_back || self.leaf.was_held()
    }

    /// Whether what is drawn of it goes through what is drawn of one on its right, or has
    /// passed its neighbour there; both as they were when they were [cut](Self::cut_drawn)
    /// last.
    pub fn is_drawn_through(
        &self,
        right: &Flight,
        is_neighbour: bool,
        [crumpled, smooth]: Touch,
        work: &mut Work,
    ) -> bool {
        let touch = if self.is_crumpled() || right.is_crumpled() {
            crumpled
        } else {
            smooth
        };
        let scale = self.scale();
        let [own, other] = [&self.surface, &right.surface].map(Mesh::of);
        (is_neighbour && is_past(own, other, ASTRAY * scale))
            || self.blocks.cross(&right.blocks, touch * scale, work)
    }

    /// Whether it may be drawn through itself.
    pub fn may_be_folded(&self) -> bool {
        self.may_be_folded
    }

    /// Whether what is drawn of it goes through itself, as it was when it was
    /// [cut](Self::cut_drawn) last.
    pub fn is_drawn_through_itself(&mut self, work: &mut Work) -> bool {
        self.blocks.cross_themselves(ROUNDING * self.scale(), work)
    }

    /// Whether what is drawn of it lies clear of the piles (right and left).
    pub fn is_clear_of(&self, piles: [&Pile; 2]) -> bool {
        is_clear(&self.surface.positions, piles)
    }

    /// Says that its paper may be asked about: see [`is_through`](Self::is_through).
    pub fn cut(&mut self) {
        self.blocks.cut(self.leaf.seated().mesh());
    }

    /// Whether its paper goes through that of the one on its right, both as they were
    /// when they were last [cut](Self::cut).
    pub fn is_through(&self, right: &Flight) -> bool {
        let [own, other] = [self, right].map(|flight| flight.leaf.seated().mesh());
        let work = &mut Work::new(u32::MAX);
        let deep = DEEP * self.scale();
        is_past(own, other, deep) || self.blocks.cross(&right.blocks, deep, work)
    }

    /// Takes back what a tick did to it where its paper would be drawn through itself after
    /// it, and would not have been before. Leaves that no hand has crumpled are not looked at.
    pub fn keep_from_itself(&mut self, gutter: &Gutter, deepest: f32) {
        let was_through = core::mem::take(&mut self.was_through);
        if !self.leaf.was_held() || !self.leaf.seated().is_bent_back() {
            return;
        }
        self.was_through = self.is_paper_through_itself();
        if self.was_through && !was_through {
            self.leaf.step_back(gutter, deepest);
            self.was_through = self.is_paper_through_itself();
        }
    }

    fn is_paper_through_itself(&mut self) -> bool {
        self.leaf.write_surface(&mut self.spare);
        self.spare.update_normals();
        self.blocks.cut(Mesh::of(&self.spare));
        let touch = ROUNDING * self.scale();
        let work = &mut Work::new(u32::MAX);
        self.blocks.cross_themselves(touch, work)
    }

    /// Keeps what is drawn now as what is wanted.
    pub fn want(&mut self) {
        self.wanted.clone_from(&self.surface.positions);
    }

    /// Draws a part of the way from what was drawn last to what is wanted.
    pub fn draw_part(&mut self, part: f32) {
        (self.held_back, self.wary) = (true, true);
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
        self.wary &= !core::mem::take(&mut self.is_drawn);
        self.wary |= astray || wary;
        self.was_driven |= wary;
    }

    /// Whether it may have come through a neighbour in the last tick.
    pub fn is_astray(&self) -> bool {
        self.astray
    }

    /// Keeps what is drawn now, as the way to the next begins there.
    pub fn show(&mut self) {
        self.is_drawn = true;
        self.shown.clone_from(&self.surface.positions);
        self.surface.touch();
    }

    /// How much wider its page is than the one for which lengths are given.
    fn scale(&self) -> f32 {
        self.leaf.seated().scale
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
