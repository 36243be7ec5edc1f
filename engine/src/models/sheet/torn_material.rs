//! The flat paper of a page that is torn across, and of its pieces.

use super::material::Material;
use super::torn_grid::TornGrid;
use core::ops::Range;

impl Material {
    /// The grid of a page that is torn across.
    pub fn torn(grid: &TornGrid) -> Self {
        Self {
            columns: grid.columns,
            rows: grid.rows[0] + grid.rows[1],
            places: grid.places.clone(),
            is_even: false,
            crumples: false,
            cell: grid.cell(),
            size: grid.frame.size(),
            folds: Vec::new(),
            diagonals: grid.diagonals.clone(),
            is_torn: true,
            seam: Some(grid.rows[0]),
        }
    }

    /// The grid of some of a torn page's rows, which hang together.
    pub fn piece(&self, rows: Range<usize>) -> Self {
        let nodes = rows.start * self.columns..rows.end * self.columns;
        let is_in = |edge: &&[usize; 2]| nodes.contains(&edge[0]) && nodes.contains(&edge[1]);
        let diagonals = self.diagonals.iter().filter(is_in);
        Self {
            columns: self.columns,
            rows: rows.len(),
            places: self.places[nodes.clone()].to_vec(),
            is_even: false,
            crumples: false,
            cell: self.cell,
            size: self.size,
            folds: Vec::new(),
            diagonals: diagonals
                .map(|edge| edge.map(|node| node - nodes.start))
                .collect(),
            is_torn: true,
            seam: None,
        }
    }

    /// The same torn page with `parts` cells in place of each along u and along v.
    pub fn refined(&self, parts: usize) -> Self {
        let columns = parts * (self.columns - 1) + 1;
        let refined = |rows: usize| parts * (rows - 1) + 1;
        let runs = self.runs().into_iter().filter(|run| !run.is_empty());
        let mut places = Vec::new();
        for run in runs {
            for row in 0..refined(run.len()) {
                let low = (row / parts).min(run.len() - 2);
                let t = row as f64 / parts as f64 - low as f64;
                for column in 0..columns {
                    let left = (column / parts).min(self.columns - 2);
                    let s = column as f64 / parts as f64 - left as f64;
                    let foot = (run.start + low) * self.columns + left;
                    let head = foot + self.columns;
                    let [a, b, c, d] = [foot, foot + 1, head, head + 1].map(|n| self.places[n]);
                    places.push([0, 1].map(|k| {
                        let [near, far] = [a[k] + s * (b[k] - a[k]), c[k] + s * (d[k] - c[k])];
                        near + t * (far - near)
                    }));
                }
            }
        }
        Self {
            columns,
            rows: places.len() / columns,
            places,
            is_even: false,
            crumples: false,
            cell: self.cell.map(|side| side / parts as f64),
            size: self.size,
            folds: Vec::new(),
            diagonals: Vec::new(),
            is_torn: true,
            seam: self.seam.map(refined),
        }
    }
}
