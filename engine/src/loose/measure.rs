//! What can be said of any leaf's nodes as if they were paper's.

use super::LooseLeaf;
use crate::grid::Grid;
use crate::models::sheet::Sheet;
use crate::rigidity::Rigidity;
use crate::stock::Grain;
use crate::surface::StrainRange;
use crate::turn::TurnModel;

/// Energies that a leaf of the settings' paper would have with its nodes where
/// they are and as fast as they are, joules. A model that is not moved by forces
/// has them all the same.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeafEnergies {
    /// Of motion, without the air's, J.
    pub kinetic: f64,
    /// Of bending and twist, by second differences of the nodes: no number of a creased leaf,
    /// of which these say nothing.
    pub bending: f64,
    /// Of height over the table, J.
    pub gravity: f64,
}

impl LooseLeaf {
    /// Energies now.
    pub fn energies(&self) -> LeafEnergies {
        let (columns, rows) = self.grid_size();
        let mut x = vec![0.0; 3 * columns * rows];
        let mut v = x.clone();
        self.read_nodes(&mut x, &mut v);
        let (x, v) = (x.as_chunks::<3>().0, v.as_chunks::<3>().0);
        let [width, height] = self.settings.size;
        let grid = Grid::new(columns, rows, width as f32, height as f32);
        let (du, dv) = (width / (columns - 1) as f64, height / (rows - 1) as f64);
        let rigidity = Rigidity::of(&self.settings.stock, Grain::AlongSpine);
        let mut energies = LeafEnergies::default();
        let creased = self.body.creased_sheet();
        for node in 0..columns * rows {
            let (column, row) = (node % columns, node / columns);
            let area = du * dv * f64::from(grid.area_fraction(column, row));
            let mass = creased.map_or(area * self.settings.stock.grammage, |sheet| {
                f64::from(sheet.masses()[node])
            });
            let speed: f64 = v[node].iter().map(|v| f64::from(*v).powi(2)).sum();
            energies.kinetic += 0.5 * mass * speed;
            energies.gravity += mass * self.settings.gravity * f64::from(x[node][2]);
            let at = |node: usize, axis: usize| f64::from(x[node][axis]);
            let (inside_u, inside_v) = (
                column > 0 && column + 1 < columns,
                row > 0 && row + 1 < rows,
            );
            let mut density = 0.0;
            for axis in 0..3 {
                let second = |step: usize, cell: f64| {
                    (at(node + step, axis) - 2.0 * at(node, axis) + at(node - step, axis))
                        / (cell * cell)
                };
                let uu = if inside_u { second(1, du) } else { 0.0 };
                let vv = if inside_v { second(columns, dv) } else { 0.0 };
                density += rigidity.d11 * uu * uu + rigidity.d22 * vv * vv;
                density += 2.0 * rigidity.d12 * uu * vv;
                if inside_u && inside_v {
                    let uv = (at(node + columns + 1, axis)
                        - at(node + columns - 1, axis)
                        - at(node - columns + 1, axis)
                        + at(node - columns - 1, axis))
                        / (4.0 * du * dv);
                    density += 4.0 * rigidity.d66 * uv * uv;
                }
            }
            energies.bending += 0.5 * area * density;
        }
        if creased.is_some() {
            energies.bending = f64::NAN;
        }
        energies
    }

    /// Largest stretch and compression of the edges between neighbouring nodes
    /// along rows and columns.
    pub fn strain(&self) -> StrainRange {
        let (columns, rows) = self.grid_size();
        let mut x = vec![0.0; 3 * columns * rows];
        let mut v = x.clone();
        self.read_nodes(&mut x, &mut v);
        let x = x.as_chunks::<3>().0;
        let cells = [
            self.settings.size[0] / (columns - 1) as f64,
            self.settings.size[1] / (rows - 1) as f64,
        ];
        // The nodes of a creased sheet are moved on the flat paper.
        let flat = self.body.creased_sheet().map(Sheet::flat_places);
        let flat = flat.as_ref().map(|flat| flat.as_chunks::<3>().0);
        let apart = |of: &[[f32; 3]], a: usize, b: usize| {
            let square = |axis: usize| f64::from(of[b][axis] - of[a][axis]).powi(2);
            libm::sqrt((0..3).map(square).sum())
        };
        let mut range = StrainRange::default();
        for node in 0..columns * rows {
            let ends = [
                (node % columns + 1 < columns, node + 1),
                (node / columns + 1 < rows, node + columns),
            ];
            for ((there, other), cell) in ends.into_iter().zip(cells) {
                if there {
                    let rest = flat.map_or(cell, |flat| apart(flat, node, other));
                    range.include((apart(x, node, other) / rest - 1.0) as f32);
                }
            }
        }
        range
    }
}
