//! What presses a loose sheet into a ball: a hollow sphere about it that shrinks, as two palms do.
//!
//! So paper is crumpled in experiments on it (Vliegenthart and Gompper 2006, "Forced crumpling
//! of self-avoiding elastic sheets"). What keeps the sheet out of itself are its nodes, each of
//! which counts as a ball: paper that is held apart at its nodes crosses itself only between
//! them.

use crate::models::sheet::{Apart, CONTACTS, Contact, Sheet};
use crate::vector::{dot, sub};

/// Columns and rows of a sheet that is crumpled: half as many again as those of a leaf.
pub(super) const NODES: [usize; 2] = [14, 20];

/// Diameter of a node that keeps others away, over the lesser side of a cell: none fits through
/// the middle of a cell between its four corners.
const DIAMETER: f32 = core::f32::consts::FRAC_1_SQRT_2;

/// Steps along the grid up to which nodes are left to the hinges between them: paper folded
/// shut brings those together that are two apart.
const NEXT: usize = 2;

/// Part of a ball that balls in it fill which were poured there and not shaken.
const PACKED: f32 = 0.56;

/// Ticks for which it presses, a little over a second, and for which the sheet is held while it
/// springs back, before it falls.
const PRESSING: u32 = 144;
const HOLDING: u32 = 36;

/// Diameters up to which nodes are looked for that may touch within a step.
const NEAR: f32 = 1.5;

/// The place of the sphere among a node's contacts: after those of the book.
const SPHERE: usize = CONTACTS - 1;

/// A press about a sheet.
#[derive(Clone, Debug)]
pub(super) struct Press {
    /// Middle of the sphere, metres, and by how much it rises in a tick.
    middle: [f32; 3],
    rise: f32,
    /// Radius of the sphere, metres, and by how much it shrinks in a tick.
    radius: f32,
    shrink: f32,
    left: u32,
    gravity: [f64; 3],
    apart: NodesApart,
}

impl Press {
    /// A press about a sheet, over a table at a height, metres.
    pub fn about(sheet: &Sheet, table: f32) -> Press {
        let (settings, cell) = (sheet.settings(), sheet.settings().cell());
        let x = sheet.positions().as_chunks::<3>().0;
        let count = x.len() as f32;
        let middle = core::array::from_fn(|axis| x.iter().map(|x| x[axis]).sum::<f32>() / count);
        let radius = x.iter().fold(0.0f32, |most, x| {
            let out = sub(*x, middle);
            most.max(dot(out, out).sqrt())
        });
        let least = 0.5 * diameter(cell) * libm::cbrtf(count / PACKED);
        let height = table + 2.0 * least;
        Press {
            middle,
            rise: (height - middle[2]).max(0.0) / PRESSING as f32,
            radius,
            shrink: (radius - least).max(0.0) / PRESSING as f32,
            left: PRESSING + HOLDING,
            gravity: settings.gravity,
            apart: NodesApart::new(settings.columns, cell),
        }
    }

    /// Goes on for a tick, after which the sheet is weightless as long as it is only held. Returns
    /// whether it is still held.
    pub fn tick(&mut self, sheet: &mut Sheet) -> bool {
        self.left = self.left.saturating_sub(1);
        if self.presses() {
            self.middle[2] += self.rise;
            self.radius -= self.shrink;
        }
        let holds = self.left > 0;
        let only_holds = holds && !self.presses();
        sheet.set_gravity(if only_holds { [0.0; 3] } else { self.gravity });
        holds
    }

    /// Has the sheet kept out of itself in the next step.
    pub fn keep_apart(&self, sheet: &mut Sheet) {
        let (positions, apart) = sheet.apart_state();
        self.apart.find(positions, apart);
    }

    /// Whether it presses, and does not only hold.
    pub fn presses(&self) -> bool {
        self.left > HOLDING
    }

    /// Adds the sphere to what nodes must not pass through. It has no friction.
    pub fn write_contacts(&self, positions: &[f32], contacts: &mut [[Contact; CONTACTS]]) {
        for (x, contacts) in positions.as_chunks::<3>().0.iter().zip(contacts) {
            let out = sub(*x, self.middle);
            let away = dot(out, out).sqrt();
            if !self.presses() || away < 0.5 * self.radius {
                continue;
            }
            let normal = out.map(|out| -out / away);
            contacts[SPHERE] = Contact {
                normal,
                offset: dot(normal, self.middle) - self.radius,
                velocity: [0.0; 3],
                friction: 0.0,
                firmness: 1.0,
            };
        }
    }
}

/// Which nodes of a sheet must not come nearer to each other, and how near.
#[derive(Clone, Debug)]
struct NodesApart {
    columns: usize,
    diameter: f32,
}

impl NodesApart {
    /// For a sheet of so many columns, of cells of that width and height, metres.
    fn new(columns: usize, cell: [f64; 2]) -> Self {
        Self {
            columns,
            diameter: diameter(cell),
        }
    }

    /// Finds the pairs of nodes that may touch in the next step, for nodes at `positions`, x, y, z
    /// of each, metres.
    fn find(&self, positions: &[f32], apart: &mut Apart) {
        let x = positions.as_chunks::<3>().0;
        let near = NEAR * self.diameter;
        apart.distance = self.diameter;
        apart.pairs.clear();
        for a in 0..x.len() {
            for b in a + 1..x.len() {
                let between = sub(x[b], x[a]);
                if dot(between, between) < near * near && !self.are_next(a, b) {
                    apart.pairs.push([a, b]);
                }
            }
        }
    }

    /// Whether two nodes are near each other on the paper.
    fn are_next(&self, a: usize, b: usize) -> bool {
        let [column, row] = [a % self.columns, a / self.columns];
        let [other, above] = [b % self.columns, b / self.columns];
        column.abs_diff(other) <= NEXT && row.abs_diff(above) <= NEXT
    }
}

/// Diameter of the nodes of cells of that width and height, metres.
fn diameter([width, height]: [f64; 2]) -> f32 {
    DIAMETER * width.min(height) as f32
}
