//! A flat mesh of any cells, and what is made of it.

use super::settings::InvalidShell;

/// A flat mesh and what it is made of, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSettings {
    /// Places of the nodes on the flat paper, m.
    pub places: Vec<[f64; 2]>,
    /// The three or four nodes of each cell, counterclockwise.
    pub cells: Vec<Vec<usize>>,
    /// Bending stiffness, N m.
    pub bending: f64,
    /// Stiffness against stretch, N/m. Shear is 0.4 of it.
    pub membrane: f64,
}

impl MeshSettings {
    /// Whether every cell has three or four nodes of the mesh, counterclockwise, and every
    /// stiffness is above 0. Fails with a sentence.
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

    /// Area of all cells, m^2.
    pub(super) fn area(&self) -> f64 {
        self.cells.iter().map(|cell| self.area_of(cell)).sum()
    }

    /// Area of the polygon of some nodes, m^2; below 0 where they go around clockwise.
    pub(super) fn area_of(&self, nodes: &[usize]) -> f64 {
        let next = nodes.iter().cycle().skip(1);
        let twice = nodes.iter().zip(next).map(|(a, b)| {
            let ([au, av], [bu, bv]) = (self.places[*a], self.places[*b]);
            au * bv - av * bu
        });
        0.5 * twice.sum::<f64>()
    }

    /// Cuts the edge between two nodes. An end whose cells hang together no longer gets a
    /// second node, which the cells on one side then have in its place. Returns the nodes
    /// that were doubled; their doubles are the last of the mesh, in the same order.
    ///
    /// # Errors
    /// Where the edge is not between two cells, or no end of it comes apart, in a sentence.
    pub(super) fn cut(&mut self, from: usize, to: usize) -> Result<Vec<usize>, InvalidShell> {
        let beside = |from, to| {
            let has_side = |cell: &Vec<usize>| sides(cell).any(|side| side == (from, to));
            self.cells.iter().position(has_side)
        };
        let (Some(left), Some(right)) = (beside(from, to), beside(to, from)) else {
            return Err(InvalidShell(format!(
                "Only an edge between two cells can be cut, not that from node {from} to {to}."
            )));
        };
        let mut doubled = Vec::new();
        for (end, other) in [(from, to), (to, from)] {
            let fan = self.fan(left, end, other);
            if fan.contains(&right) {
                continue;
            }
            for cell in fan {
                for node in self.cells[cell].iter_mut().filter(|node| **node == end) {
                    *node = self.places.len();
                }
            }
            self.places.push(self.places[end]);
            doubled.push(end);
        }
        if doubled.is_empty() {
            return Err(InvalidShell(format!(
                "A cut starts at the paper's edge, which neither node {from} nor {to} is at."
            )));
        }
        Ok(doubled)
    }

    /// The cells around a node that can be reached from one of them over edges from the node,
    /// but for that to `barred`.
    fn fan(&self, start: usize, node: usize, barred: usize) -> Vec<usize> {
        let spokes = |cell: usize| {
            let others = sides(&self.cells[cell]).filter_map(move |side| match side {
                (from, to) if from == node => Some(to),
                (from, to) if to == node => Some(from),
                _ => None,
            });
            others.filter(move |other| *other != barred)
        };
        let mut fan = vec![start];
        let mut next = 0;
        while next < fan.len() {
            for spoke in spokes(fan[next]) {
                for cell in 0..self.cells.len() {
                    if !fan.contains(&cell) && spokes(cell).any(|other| other == spoke) {
                        fan.push(cell);
                    }
                }
            }
            next += 1;
        }
        fan
    }

    /// The way from one node to another on the flat paper, m.
    pub(super) fn way(&self, from: usize, to: usize) -> [f64; 2] {
        let ([au, av], [bu, bv]) = (self.places[from], self.places[to]);
        [bu - au, bv - av]
    }
}

/// The directed edges of a cell.
fn sides(cell: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    let next = cell.iter().cycle().skip(1);
    cell.iter().copied().zip(next.copied())
}
