//! A flat mesh of any cells, and what is made of it.

use super::settings::InvalidShell;

/// A flat mesh and what it is made of, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSettings {
    /// Places of the nodes on the flat paper.
    pub places: Vec<[f64; 2]>,
    /// The three or four nodes of each cell, counterclockwise.
    pub cells: Vec<Vec<usize>>,
    /// Bending stiffness, N m.
    pub bending: f64,
    /// Stiffness against stretch, N/m. Shear is 0.4 of it.
    pub membrane: f64,
}

impl MeshSettings {
    pub(super) fn check(&self) -> Result<(), InvalidShell> {
        for cell in &self.cells {
            let of_mesh = cell.iter().all(|node| *node < self.places.len());
            if !of_mesh || !(3..=4).contains(&cell.len()) || self.area_of(cell) <= 0.0 {
                return Err(InvalidShell(format!(
                    "A cell has three or four nodes of the mesh counterclockwise, not {cell:?}."
                )));
            }
        }
        if !(self.bending > 0.0 && self.membrane > 0.0) {
            return Err(InvalidShell(
                "A mesh's stiffness against bending and stretch is above 0.".to_owned(),
            ));
        }
        Ok(())
    }

    pub(super) fn area(&self) -> f64 {
        self.cells.iter().map(|cell| self.area_of(cell)).sum()
    }

    /// Area of the polygon of some nodes.
    pub(super) fn area_of(&self, nodes: &[usize]) -> f64 {
        let next = nodes.iter().cycle().skip(1);
        let twice = nodes.iter().zip(next).map(|(a, b)| {
            let ([au, av], [bu, bv]) = (self.places[*a], self.places[*b]);
            au * bv - av * bu
        });
        0.5 * twice.sum::<f64>()
    }

    /// The way from one node to another on the flat paper.
    pub(super) fn way(&self, from: usize, to: usize) -> [f64; 2] {
        let ([au, av], [bu, bv]) = (self.places[from], self.places[to]);
        [bu - au, bv - av]
    }
}
