//! What a leaf that is no longer bound lies on: the table, and on it the pages and boards of
//! the open book, as blocks with a top and upright sides.
//!
//! A sheet bends over no edge sharper than its cells. So each block counts as larger by a
//! margin of a cell's diagonal: an edge of the sheet between a node upon the block and one
//! beside it then nowhere cuts the block's own edge.

use std::rc::Rc;

use super::Book;
use super::bend_into_gutter::{Over, push_edges_off_where};
use super::pile::Pile;
use crate::contact::mesh::Folds;
use crate::contact::relief::Relief;
use crate::contact::tolerance::{DEEPEST, FAR, OVER_PILE, PUSHED_AT_ONCE};
use crate::grid::Side;
use crate::models::sheet::{CONTACTS, Contact, Sheet};
use crate::surface::Surface;
use crate::vector::dot;

/// Which contact of a node is whose; the others are free.
const TABLE: usize = 0;
const RIGHT: usize = 1;
const LEFT: usize = 2;

/// Angle from its place of rest up to which a board lies open and is met as a block, radians.
const OPEN: f32 = 0.05;

/// The table about a book.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableAround {
    /// Height of the table, metres: 0 where the pages lie on it, less where boards do.
    pub table: f32,
    /// How far boards reach beyond the pages, metres; 0 where there are none.
    pub rim: f32,
}

impl TableAround {
    /// Whether every figure is one that a table about a book can have.
    pub(super) fn is_sound(&self) -> bool {
        (-1.0..=0.0).contains(&self.table) && (0.0..=1.0).contains(&self.rim)
    }
}

/// A book as a free sheet meets it.
pub(super) struct Surroundings<'a> {
    /// Width and height of a page, metres.
    size: [f32; 2],
    /// The piles, right and left.
    piles: [&'a Pile; 2],
    /// Whether a board lies open on either side, right and left.
    has_board: [bool; 2],
    around: TableAround,
    /// The diagonal of the sheet's cells, metres.
    margin: f32,
    friction: f32,
    /// The upper sides of other loose sheets.
    under: &'a [Rc<Relief>],
}

impl<'a> Surroundings<'a> {
    /// The surroundings of a sheet.
    pub fn new(book: &'a Book, around: TableAround, sheet: &Sheet) -> Self {
        let settings = sheet.settings();
        let [du, dv] = settings.cell().map(|cell| cell as f32);
        let [front, back] = [0, 1].map(|board| book.boards[board].angle());
        let lies = [back < OPEN, front > core::f32::consts::PI - OPEN];
        Self {
            size: book.size().map(|side| side as f32),
            piles: [book.pile(Side::Right), book.pile(Side::Left)],
            has_board: lies.map(|lies| lies && around.rim > 0.0),
            around,
            margin: (du * du + dv * dv).sqrt(),
            friction: settings.stock.friction as f32,
            under: &[],
        }
    }

    /// The same with other loose sheets in it.
    pub fn over(self, under: &'a [Rc<Relief>]) -> Self {
        Self { under, ..self }
    }

    /// Finds what each node must not pass through; positions are x, y, z of each, metres.
    pub fn write_contacts(&self, positions: &[f32], contacts: &mut [[Contact; CONTACTS]]) {
        for (x, contacts) in positions.as_chunks::<3>().0.iter().zip(contacts) {
            *contacts = [Contact::default(); CONTACTS];
            let over = x[2] - self.around.table;
            if let Some((normal, gap)) = self.nearest_sheet(*x) {
                if gap < FAR {
                    // What lies upon a sheet that is raised at once comes out of it in steps.
                    contacts[TABLE] = self.half_space(*x, normal, gap.max(-DEEPEST));
                }
            } else if over < FAR {
                contacts[TABLE] = self.half_space(*x, [0.0, 0.0, 1.0], over);
            }
            let (side, slot) = if x[0] >= 0.0 { (0, RIGHT) } else { (1, LEFT) };
            if let Some((normal, gap)) = self.nearest_of_block(*x, side)
                && gap < FAR
            {
                contacts[slot] = self.half_space(*x, normal, gap);
            }
        }
    }

    /// The upper side of the highest sheet at a point, if that is above the table: its normal, and
    /// how far the point is before it, metres.
    fn nearest_sheet(&self, [x, y, z]: [f32; 3]) -> Option<([f32; 3], f32)> {
        let mut highest = (self.around.table, None);
        for relief in self.under {
            match relief.height_and_slope(x, y) {
                Some((height, slope)) if height > highest.0 => highest = (height, Some(slope)),
                _ => {}
            }
        }
        let (height, Some([along_x, along_y])) = highest else {
            return None;
        };
        let inverse = 1.0 / (1.0 + along_x * along_x + along_y * along_y).sqrt();
        let normal = [-along_x * inverse, -along_y * inverse, inverse];
        Some((normal, (z - height) * inverse))
    }

    /// A place, metres, or the one above it that is not in another sheet: no grab pulls through one.
    pub fn over_sheets(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        let heights = self
            .under
            .iter()
            .filter_map(|relief| relief.height_and_slope(x, y));
        [x, y, heights.fold(z, |z, (height, _)| z.max(height))]
    }

    /// Lifts what is drawn off other sheets, by what keeps surfaces apart in a picture.
    pub fn push_off_sheets(&self, surface: &mut Surface, triangles: &[[u32; 3]]) {
        let points = surface.positions.as_chunks_mut::<3>().0;
        let mut rises = vec![0.0; points.len()];
        for relief in self.under {
            relief.lift(points, triangles, [OVER_PILE, PUSHED_AT_ONCE], &mut rises);
        }
        for (point, rise) in points.iter_mut().zip(rises) {
            point[2] += rise;
        }
    }

    /// The nearest face of the block on a side: its normal, and how far a point is before it,
    /// metres. None where there is no block near the point.
    fn nearest_of_block(&self, [x, y, z]: [f32; 3], side: usize) -> Option<([f32; 3], f32)> {
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let pile = self.piles[side];
        let column = pile.column_before(x.abs(), 0);
        let (height, slope) = pile.height_and_slope(x.abs(), column);
        // How far the point lies within each upright side.
        let within = |rim: f32| {
            let reach = rim + self.margin;
            let [width, height] = self.size;
            [width + reach - x.abs(), y + reach, height + reach - y]
        };
        let least = |sides: [f32; 3]| sides.into_iter().fold(f32::INFINITY, f32::min);
        let pages = within(0.0);
        let (sides, top, slope) = if !self.has_board[side] || (z > 0.0 && least(pages) > 0.0) {
            (pages, height, slope)
        } else {
            (within(self.around.rim), 0.0, 0.0)
        };
        let nearest = (0..3).fold(
            0,
            |least, k| if sides[k] < sides[least] { k } else { least },
        );
        let inside = sides[nearest];
        let normals = [[sign, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
        // Above, only what lies over the top can meet it; below, the nearer of the top and a side
        // is the way out.
        if z < top && inside <= top - z {
            return Some((normals[nearest], -inside));
        }
        let inverse = 1.0 / (1.0 + slope * slope).sqrt();
        let normal = [-sign * slope * inverse, 0.0, inverse];
        (inside > 0.0).then_some((normal, (z - top) * inverse))
    }

    /// Lifts what is drawn off what lies under them, by what keeps surfaces apart in a picture:
    /// contact holds the nodes, and the paper between them bends.
    pub fn push_off(&self, surface: &mut Surface) {
        for point in surface.positions.as_chunks_mut::<3>().0 {
            let floor = self.floor(*point) + OVER_PILE;
            // What is far below the top of a block is beside it.
            if floor - point[2] < PUSHED_AT_ONCE {
                point[2] = point[2].max(floor);
            }
        }
        // The pages are round at the gutter: an edge may cut them between its ends.
        let is_over = |[x, y, z]: [f32; 3]| {
            let [width, height] = self.size;
            let is_above = || self.floor([x, y, z]) - z < PUSHED_AT_ONCE;
            x.abs() < width && y > 0.0 && y < height && is_above()
        };
        let grid = (
            &mut surface.positions[..],
            surface.columns,
            Folds::default(),
        );
        let over = Over::of([OVER_PILE; 2], 1.0);
        push_edges_off_where(grid, self.piles, over, is_over);
    }

    /// Height of what lies under a point, metres.
    fn floor(&self, [x, y, _]: [f32; 3]) -> f32 {
        let [width, height] = self.size;
        let side = usize::from(x < 0.0);
        let over = |rim: f32| x.abs() < width + rim && y >= -rim && y <= height + rim;
        if over(0.0) {
            self.piles[side].height(x.abs())
        } else if self.has_board[side] && over(self.around.rim) {
            0.0
        } else {
            self.around.table
        }
    }

    /// The half-space whose boundary is `gap` metres from a point, toward `normal`.
    fn half_space(&self, point: [f32; 3], normal: [f32; 3], gap: f32) -> Contact {
        Contact {
            normal,
            offset: dot(normal, point) - gap,
            velocity: [0.0; 3],
            friction: self.friction,
            firmness: 1.0,
        }
    }
}
