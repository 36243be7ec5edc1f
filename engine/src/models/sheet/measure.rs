//! What a sheet's nodes say of how far it is from paper.

use super::Sheet;
use crate::vector::{dot, sub};

impl Sheet {
    /// Largest strain, stretch or compression, of any edge between neighbours
    /// along rows and columns.
    pub fn max_edge_strain(&self) -> f32 {
        let (columns, rows) = (self.settings.columns, self.settings.rows);
        let x = self.positions.as_chunks::<3>().0;
        let mut most = 0.0f32;
        for node in 0..columns * rows {
            let strain =
                |other: usize, rest: f64| (length(x[other], x[node]) / rest as f32 - 1.0).abs();
            if node % columns + 1 < columns {
                most = most.max(strain(node + 1, self.material.along_u(node)));
            }
            if node / columns + 1 < self.material.run_of(node / columns).end {
                most = most.max(strain(node + columns, self.material.along_v(node)));
            }
        }
        most
    }

    /// Largest shear of any cell between four nodes, radians: by how much its longer
    /// diagonal is longer than that of a rectangle of its sides, each the root mean
    /// square of two opposite edges, as the angle of a parallelogram that has it.
    ///
    /// The shorter diagonal says nothing: paper that bends or folds about the other
    /// one shortens it and shears nowhere. On such paper, bent about a diagonal of
    /// square cells of side `h` to a radius `r`, this is (h/r)^2 / 48, as edges are
    /// chords; folded flat along a diagonal it is 0.
    pub fn max_shear(&self) -> f32 {
        let square = |a, b| {
            let edge = sub(b, a);
            dot(edge, edge)
        };
        let shear = |[a, b, c, d]: [[f32; 3]; 4]| {
            let along = 0.5 * (square(a, b) + square(c, d));
            let up = 0.5 * (square(a, c) + square(b, d));
            let longer = square(a, d).max(square(b, c));
            let sine = 0.5 * (longer - along - up) / (along * up).sqrt();
            libm::asinf(sine.clamp(0.0, 1.0))
        };
        self.cells().map(shear).fold(0.0, f32::max)
    }

    /// Largest stretch of any diagonal of a cell between four nodes, as part of
    /// its length on the flat sheet; 0 if none is longer than there.
    ///
    /// A diagonal that is shorter does not count: it is a chord, and on a sheet
    /// that bends along it by an angle `a` within the cell it is shorter by
    /// a^2 / 24, though paper is not compressed.
    pub fn max_diagonal_stretch(&self) -> f32 {
        let [du, dv] = self.settings.cell().map(|cell| cell as f32);
        let rest = (du * du + dv * dv).sqrt();
        let longer = |[a, b, c, d]: [[f32; 3]; 4]| length(a, d).max(length(b, c));
        let longest = self.cells().map(longer).fold(0.0, f32::max);
        (longest / rest - 1.0).max(0.0)
    }

    /// The fastest node's speed, m/s.
    pub fn greatest_speed(&self) -> f32 {
        let v = self.velocities.as_chunks::<3>().0;
        v.iter().map(|v| dot(*v, *v)).fold(0.0, f32::max).sqrt()
    }

    /// Places of each cell's nodes: at its foot and spine, foot and fore-edge,
    /// head and spine, head and fore-edge.
    fn cells(&self) -> impl Iterator<Item = [[f32; 3]; 4]> {
        let (columns, rows) = (self.settings.columns, self.settings.rows);
        let x = self.positions.as_chunks::<3>().0;
        let nodes = (0..columns * (rows - 1)).filter(move |node| (node + 1) % columns != 0);
        nodes.map(move |node| {
            [
                x[node],
                x[node + 1],
                x[node + columns],
                x[node + columns + 1],
            ]
        })
    }
}

fn length(a: [f32; 3], b: [f32; 3]) -> f32 {
    let d = sub(a, b);
    dot(d, d).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::SheetSettings;
    use super::*;
    use crate::stock::Stock;

    /// A sheet of square cells, 10 mm wide, whose nodes lie where `at` puts the
    /// points (u, v), metres.
    fn shaped(at: impl Fn(f32, f32) -> [f32; 3]) -> Sheet {
        let settings = SheetSettings {
            columns: 8,
            rows: 11,
            ..SheetSettings::leaf(0.07, 0.10, Stock::BOOK)
        };
        let mut sheet = Sheet::new(settings).unwrap();
        let places: Vec<f32> = (0..88)
            .flat_map(|node| at((node % 8) as f32 * 0.01, (node / 8) as f32 * 0.01))
            .collect();
        let still = vec![0.0; places.len()];
        sheet.write_nodes(&places, &still);
        sheet
    }

    #[test]
    fn a_flat_sheet_is_neither_sheared_nor_stretched() {
        let sheet = shaped(|u, v| [0.6 * u, v, 0.8 * u]);
        assert!(sheet.max_shear() < 1e-5 && sheet.max_diagonal_stretch() < 1e-5);
    }

    #[test]
    fn a_sheared_flat_sheet_is_sheared_by_its_angle() {
        for angle in [0.02f32, -0.1, 0.7, -1.5] {
            let (sin, cos) = libm::sincosf(angle);
            let sheet = shaped(|u, v| [u + v * sin, v * cos, 0.3]);
            let shear = sheet.max_shear();
            assert!((shear - angle.abs()).abs() < 1e-4, "{angle}: {shear}");
            // Edges keep their lengths; the longer diagonal does not.
            assert!(sheet.max_edge_strain() < 1e-4);
            let stretch = (1.0 + sin.abs()).sqrt() - 1.0;
            let found = sheet.max_diagonal_stretch();
            assert!((found - stretch).abs() < 1e-4, "{angle}: {found}");
        }
    }

    #[test]
    fn a_stretched_sheet_is_stretched_along_diagonals_but_not_sheared() {
        let sheet = shaped(|u, v| [1.1 * u, 1.1 * v, 0.0]);
        assert!(sheet.max_shear() < 1e-5);
        assert!((sheet.max_diagonal_stretch() - 0.1).abs() < 1e-4);
        let sheet = shaped(|u, v| [0.9 * u, 0.9 * v, 0.0]);
        assert!(sheet.max_diagonal_stretch() == 0.0);
    }

    /// Paper on a cylinder of radius 30 mm whose axis makes an angle with the spine.
    fn rolled(axis: f32) -> Sheet {
        let (sin, cos) = libm::sincosf(axis);
        shaped(|u, v| {
            let (along, across) = (u * sin + v * cos, u * cos - v * sin);
            let (high, far) = libm::sincosf(across / 0.03);
            [0.03 * far, along, 0.03 * high]
        })
    }

    #[test]
    fn a_cylinder_is_neither_sheared_nor_stretched_but_by_its_chords() {
        for axis in [0.0, core::f32::consts::FRAC_PI_2] {
            let sheet = rolled(axis);
            assert!(sheet.max_shear() < 1e-5 && sheet.max_diagonal_stretch() < 1e-5);
        }
        let sheet = rolled(core::f32::consts::FRAC_PI_4);
        let chord = (0.01f32 / 0.03).powi(2) / 48.0;
        let shear = sheet.max_shear();
        assert!((shear / chord - 1.0).abs() < 0.02, "{shear} for {chord}");
        assert!(sheet.max_diagonal_stretch() < 1e-5);
    }

    #[test]
    fn a_sheet_folded_flat_along_a_diagonal_is_not_sheared() {
        // Mirrored beyond the diagonal of its square cells.
        let sheet = shaped(|u, v| if u > v { [v, u, 0.0] } else { [u, v, 0.0] });
        assert!(sheet.max_shear() < 1e-3, "{}", sheet.max_shear());
    }
}
