//! Stretch and shear: stiff enough that no one sees them.
//!
//! Edges along rows and columns are springs; of their Hessian the part that
//! would push sideways under compression is left out, which keeps the matrix
//! positive. Shear is the product of a cell's mean tangents, by Gauss and Newton.

use super::material::Material;
use super::settings::{CAN_CREASE, SheetSettings};
use super::system::System;
use crate::vector::{dot, sub};
use core::ops::Range;

/// An edge: what it rests at, metres, and its stiffness, N/m.
#[derive(Clone, Copy, Debug, Default)]
struct Spring {
    rest: f32,
    stiffness: f32,
}

/// A cell: half of one over its sides, 1/m, the product of its mean tangents at rest, and
/// its stiffness against a change of that, N m.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    du: f32,
    dv: f32,
    rest: f32,
    stiffness: f32,
}

/// Stretch and shear of one sheet.
#[derive(Clone, Debug)]
pub(super) struct Membrane {
    columns: usize,
    rows: usize,
    /// Of each node's edge to the next in its row, and to the next in its column.
    along_u: Vec<Spring>,
    along_v: Vec<Spring>,
    /// Of the cell of which a node is the foot by the spine.
    cells: Vec<Cell>,
    /// Diagonals along which cells are folded, which shear no more as a whole.
    diagonals: Vec<([usize; 2], Spring)>,
    /// Diagonals that can be shorter than at rest, and not longer: of paper that crumples.
    slack: Vec<([usize; 2], Spring)>,
}

impl Membrane {
    /// Stretch and shear of the settings' stiffness between the nodes of a material.
    pub fn new(settings: &SheetSettings, material: &Material) -> Membrane {
        let (columns, rows) = (settings.columns, settings.rows);
        let [du, dv] = settings.cell();
        let nodes = columns * rows;
        let mut membrane = Membrane {
            columns,
            rows,
            along_u: vec![Spring::default(); nodes],
            along_v: vec![Spring::default(); nodes],
            cells: vec![Cell::default(); nodes],
            diagonals: Vec::new(),
            slack: Vec::new(),
        };
        let rim = |i: usize, run: &Range<usize>| {
            if i == run.start || i + 1 == run.end {
                0.5f64
            } else {
                1.0
            }
        };
        // Halved at the rim.
        let spring = |part: f64, across: f64, rest: f64| Spring {
            rest: rest as f32,
            stiffness: part as f32 * (settings.stretch * across / rest) as f32,
        };
        for node in 0..nodes {
            let (column, row) = (node % columns, node / columns);
            let run = material.run_of(row);
            if column + 1 < columns {
                membrane.along_u[node] = spring(rim(row, &run), dv, material.along_u(node));
            }
            if row + 1 < run.end {
                let part = rim(column, &(0..columns));
                membrane.along_v[node] = spring(part, du, material.along_v(node));
            }
        }
        let along_diagonal = |foot: usize, square: f64| Spring {
            rest: square.sqrt() as f32,
            stiffness: (settings.stretch * material.area(foot) / square) as f32,
        };
        for foot in material.cells() {
            if let Some(diagonals) = material.slack_diagonals(foot) {
                let springs =
                    diagonals.map(|(edge, rest)| (edge, along_diagonal(foot, rest * rest)));
                membrane.slack.extend(springs);
                continue;
            }
            if let Some(edge) = material.folded_diagonal(foot) {
                let [a, b] = edge.map(|node| material.places[node]);
                let d = [b[0] - a[0], b[1] - a[1]];
                let square = d[0] * d[0] + d[1] * d[1];
                membrane
                    .diagonals
                    .push((edge, along_diagonal(foot, square)));
                continue;
            }
            let [du, dv] = material.sides(foot);
            membrane.cells[foot] = Cell {
                du: 0.5 / du as f32,
                dv: 0.5 / dv as f32,
                rest: (0.25 * material.skew(foot) / (du * dv)) as f32,
                stiffness: (settings.shear * du * dv) as f32,
            };
        }
        membrane
    }

    /// Adds the forces and the Hessian at `positions`.
    pub fn add_to(&self, positions: &[f32], system: &mut System) {
        let (x, columns) = (positions.as_chunks::<3>().0, self.columns);
        for row in 0..self.rows {
            for column in 0..columns {
                let node = row * columns + column;
                if column + 1 < columns {
                    spring(x, [node, node + 1], self.along_u[node], system);
                }
                if row + 1 < self.rows && system.moves(node) {
                    spring(x, [node, node + columns], self.along_v[node], system);
                }
                if column + 1 < columns && row + 1 < self.rows {
                    self.cell(x, node, system);
                }
            }
        }
        if CAN_CREASE {
            for (edge, along) in &self.diagonals {
                spring(x, *edge, *along, system);
            }
            for (edge, along) in &self.slack {
                let d = sub(x[edge[1]], x[edge[0]]);
                if dot(d, d) > along.rest * along.rest {
                    spring(x, *edge, *along, system);
                }
            }
        }
    }

    /// The shear of the cell between a node and its neighbours to the
    /// fore-edge and to the head.
    fn cell(&self, x: &[[f32; 3]], node: usize, system: &mut System) {
        let cell = &self.cells[node];
        if cell.stiffness == 0.0 {
            return;
        }
        let nodes = [node, node + 1, node + self.columns, node + self.columns + 1];
        let [a, b, c, d] = nodes.map(|node| x[node]);
        let (du, dv) = (cell.du, cell.dv);
        let (mut along_u, mut along_v) = ([0.0; 3], [0.0; 3]);
        let mut strain = -cell.rest;
        for axis in 0..3 {
            let (falling, rising) = (b[axis] - c[axis], d[axis] - a[axis]);
            along_u[axis] = (falling + rising) * du;
            along_v[axis] = (rising - falling) * dv;
            strain += along_u[axis] * along_v[axis];
        }
        let (mut across, mut down) = ([0.0; 3], [0.0; 3]);
        for axis in 0..3 {
            let (p, q) = (along_v[axis] * du, along_u[axis] * dv);
            (across[axis], down[axis]) = (p + q, p - q);
        }
        // Of the strain, by the four nodes: -across, down, -down, across.
        let gradients = [across.map(|g| -g), down, down.map(|g| -g), across];
        let stress = cell.stiffness * strain;
        for i in 0..4 {
            system.push(nodes[i], gradients[i].map(|g| -stress * g));
            if !system.moves(nodes[i]) {
                continue;
            }
            let scaled = gradients[i].map(|g| cell.stiffness * g);
            for k in 0..=i {
                if system.moves(nodes[k]) {
                    system.add_product(nodes[i], nodes[k], scaled, gradients[k]);
                }
            }
        }
    }
}

/// A spring between two nodes, the second after the first.
#[inline(always)]
fn spring(x: &[[f32; 3]], [a, b]: [usize; 2], spring: Spring, system: &mut System) {
    let Spring { rest, stiffness } = spring;
    let d: [f32; 3] = core::array::from_fn(|axis| x[b][axis] - x[a][axis]);
    let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt().max(1e-9);
    let inverse = 1.0 / length;
    let tension = stiffness * (length - rest) * inverse;
    let force = d.map(|d| tension * d);
    system.push(a, force);
    system.push(b, force.map(|f| -f));
    let sideways = tension.max(0.0);
    let along = (stiffness - sideways) * inverse * inverse;
    system.add_spring(a, b, d, along, sideways);
}
