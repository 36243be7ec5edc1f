//! Stretch and shear: stiff enough that no one sees them.
//!
//! Edges along rows and columns are springs; of their Hessian the part that
//! would push sideways under compression is left out, which keeps the matrix
//! positive. Shear is the product of a cell's mean tangents, by Gauss and Newton.

use super::settings::SheetSettings;
use super::system::System;

/// Stretch and shear of one sheet.
#[derive(Clone, Debug)]
pub(super) struct Membrane {
    columns: usize,
    rows: usize,
    du: f32,
    dv: f32,
    /// Stiffness of an inner edge along u and along v, N/m, halved at the rim.
    along_u: f32,
    along_v: f32,
    shear: f32,
}

impl Membrane {
    pub fn new(settings: &SheetSettings) -> Membrane {
        let [du, dv] = settings.cell();
        Membrane {
            columns: settings.columns,
            rows: settings.rows,
            du: du as f32,
            dv: dv as f32,
            along_u: (settings.stretch * dv / du) as f32,
            along_v: (settings.stretch * du / dv) as f32,
            shear: (settings.shear * du * dv) as f32,
        }
    }

    /// Adds the forces and the Hessian at `positions`.
    pub fn add_to(&self, positions: &[f32], system: &mut System) {
        let (x, columns) = (positions.as_chunks::<3>().0, self.columns);
        for row in 0..self.rows {
            let rim = if row == 0 || row + 1 == self.rows {
                0.5
            } else {
                1.0
            };
            for column in 0..columns {
                let node = row * columns + column;
                if column + 1 < columns {
                    spring(x, [node, node + 1], rim * self.along_u, self.du, system);
                }
                if row + 1 < self.rows && system.moves(node) {
                    let rim = if column == 0 || column + 1 == columns {
                        0.5
                    } else {
                        1.0
                    };
                    spring(
                        x,
                        [node, node + columns],
                        rim * self.along_v,
                        self.dv,
                        system,
                    );
                }
                if column + 1 < columns && row + 1 < self.rows {
                    self.cell(x, node, system);
                }
            }
        }
    }

    /// The shear of the cell between a node and its neighbours to the
    /// fore-edge and to the head.
    fn cell(&self, x: &[[f32; 3]], node: usize, system: &mut System) {
        let nodes = [node, node + 1, node + self.columns, node + self.columns + 1];
        let [a, b, c, d] = nodes.map(|node| x[node]);
        let (du, dv) = (0.5 / self.du, 0.5 / self.dv);
        let (mut along_u, mut along_v) = ([0.0; 3], [0.0; 3]);
        let mut strain = 0.0;
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
        let stress = self.shear * strain;
        for i in 0..4 {
            system.push(nodes[i], gradients[i].map(|g| -stress * g));
            if !system.moves(nodes[i]) {
                continue;
            }
            let scaled = gradients[i].map(|g| self.shear * g);
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
fn spring(x: &[[f32; 3]], [a, b]: [usize; 2], stiffness: f32, rest: f32, system: &mut System) {
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
