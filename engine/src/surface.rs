//! What every model yields: the drawn mesh of a leaf.

/// The drawn mesh of a leaf, row by row from the foot; a row runs from the
/// spine (u = 0) to the fore-edge (u = 1).
///
/// The arrays are flat, so that a viewer can wrap them without a copy.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Points along a row, at least 2.
    pub columns: usize,
    /// Rows along the spine, at least 2.
    pub rows: usize,
    /// x, y, z of each point in metres (or in the preset's own unit of length):
    /// `3 * columns * rows`.
    pub positions: Vec<f32>,
    /// Unit normal of each point, pointing to the side that the reader sees of
    /// a leaf lying on the right: `3 * columns * rows`.
    pub normals: Vec<f32>,
    /// Rises whenever the positions change.
    pub version: u32,
    /// Rises whenever the mesh itself changes: its size, a fold, a tear.
    pub topology: u32,
}

impl Surface {
    /// A mesh of `columns` x `rows` points, all at the origin, normals up.
    ///
    /// # Panics
    /// If either is below 2.
    pub fn new(columns: usize, rows: usize) -> Self {
        assert!(columns >= 2 && rows >= 2, "a surface needs 2 x 2 points");
        let count = columns * rows;
        let normals = [0.0, 0.0, 1.0].repeat(count);
        Self {
            columns,
            rows,
            positions: vec![0.0; 3 * count],
            normals,
            version: 0,
            topology: 0,
        }
    }

    /// Gives the mesh another size; nothing happens when it already has it.
    pub fn resize(&mut self, columns: usize, rows: usize) {
        if (self.columns, self.rows) == (columns, rows) {
            return;
        }
        let (version, topology) = (self.version, self.topology);
        *self = Self::new(columns, rows);
        self.version = version.wrapping_add(1);
        self.topology = topology.wrapping_add(1);
    }

    /// Position of the point in `column` and `row`, as [`positions`](Self::positions).
    pub fn position(&self, column: usize, row: usize) -> [f32; 3] {
        point(&self.positions, row * self.columns + column)
    }

    /// Unit normal at the point in `column` and `row`.
    pub fn normal(&self, column: usize, row: usize) -> [f32; 3] {
        point(&self.normals, row * self.columns + column)
    }

    /// Says that the positions have changed.
    pub fn touch(&mut self) {
        self.version = self.version.wrapping_add(1);
    }

    /// Computes smooth normals from the positions: at each point the cross
    /// product of the central differences along u and along v, one-sided at the
    /// edges. A point whose neighbours coincide keeps its former normal.
    pub fn update_normals(&mut self) {
        let (columns, rows) = (self.columns, self.rows);
        let (points, _) = self.positions.as_chunks::<3>();
        let (normals, _) = self.normals.as_chunks_mut::<3>();
        for row in 0..rows {
            let (below, above) = (row.saturating_sub(1), (row + 1).min(rows - 1));
            let of_row = |row: usize| &points[row * columns..(row + 1) * columns];
            let (here, below, above) = (of_row(row), of_row(below), of_row(above));
            let normals = &mut normals[row * columns..(row + 1) * columns];
            for (block, normals) in normals.chunks_mut(BLOCK).enumerate() {
                let first = block * BLOCK;
                let (mut u, mut v) = ([[0.0; BLOCK]; 3], [[0.0; BLOCK]; 3]);
                for i in 0..normals.len() {
                    let column = first + i;
                    let (left, right) = (column.saturating_sub(1), (column + 1).min(columns - 1));
                    for axis in 0..3 {
                        u[axis][i] = here[right][axis] - here[left][axis];
                        v[axis][i] = above[column][axis] - below[column][axis];
                    }
                }
                write_normals(u, v, normals);
            }
        }
    }

    /// Largest and smallest strain of the mesh's edges along u and v, for a
    /// leaf whose unstrained mesh has its points at `u` times `width` and `v`
    /// times `height`.
    ///
    /// # Panics
    /// If the lengths of `u` and `v` are not the mesh's.
    pub fn strain(&self, u: &[f32], v: &[f32], width: f32, height: f32) -> StrainRange {
        assert!(u.len() == self.columns && v.len() == self.rows);
        let mut range = StrainRange::default();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let here = row * self.columns + column;
                if column + 1 < self.columns {
                    let rest = (u[column + 1] - u[column]) * width;
                    range.include(length(difference(&self.positions, here + 1, here)) / rest - 1.0);
                }
                if row + 1 < self.rows {
                    let rest = (v[row + 1] - v[row]) * height;
                    let next = here + self.columns;
                    range.include(length(difference(&self.positions, next, here)) / rest - 1.0);
                }
            }
        }
        range
    }
}

/// Largest and smallest of a set of strains; 0.01 is one per cent longer than
/// at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StrainRange {
    /// The largest stretch, 0 or above.
    pub max: f32,
    /// The largest compression, 0 or below.
    pub min: f32,
}

impl StrainRange {
    /// Widens the range to include one strain.
    pub fn include(&mut self, strain: f32) {
        if strain > self.max {
            self.max = strain;
        }
        if strain < self.min {
            self.min = strain;
        }
    }

    /// The range that includes both.
    pub fn union(self, other: Self) -> Self {
        Self {
            max: self.max.max(other.max),
            min: self.min.min(other.min),
        }
    }
}

fn point(array: &[f32], index: usize) -> [f32; 3] {
    [array[3 * index], array[3 * index + 1], array[3 * index + 2]]
}

fn difference(array: &[f32], a: usize, b: usize) -> [f32; 3] {
    let (a, b) = (point(array, a), point(array, b));
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Points whose normals are computed together.
const BLOCK: usize = 8;

/// Cross products of one array an axis, brought to length 1; where they vanish
/// or overflow, the former normal stays.
fn write_normals(u: [[f32; BLOCK]; 3], v: [[f32; BLOCK]; 3], normals: &mut [[f32; 3]]) {
    let (mut n, mut scale) = ([[0.0; BLOCK]; 3], [0.0; BLOCK]);
    for i in 0..BLOCK {
        let x = u[1][i] * v[2][i] - u[2][i] * v[1][i];
        let y = u[2][i] * v[0][i] - u[0][i] * v[2][i];
        let z = u[0][i] * v[1][i] - u[1][i] * v[0][i];
        scale[i] = 1.0 / (x * x + y * y + z * z).sqrt();
        (n[0][i], n[1][i], n[2][i]) = (x, y, z);
    }
    for (i, normal) in normals.iter_mut().enumerate() {
        if scale[i].is_finite() && scale[i] > 0.0 {
            *normal = [n[0][i] * scale[i], n[1][i] * scale[i], n[2][i] * scale[i]];
        }
    }
}

fn length(a: [f32; 3]) -> f32 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(tilt: f32) -> Surface {
        let mut surface = Surface::new(4, 3);
        for row in 0..3 {
            for column in 0..4 {
                let at = 3 * (row * 4 + column);
                surface.positions[at] = column as f32 * tilt.cos();
                surface.positions[at + 1] = row as f32;
                surface.positions[at + 2] = column as f32 * tilt.sin();
            }
        }
        surface
    }

    #[test]
    fn normals_of_a_tilted_plane_are_its_own() {
        let mut surface = plane(0.3);
        surface.update_normals();
        for n in surface.normals.chunks_exact(3) {
            assert!((n[0] + 0.3f32.sin()).abs() < 1e-6);
            assert!(n[1].abs() < 1e-6);
            assert!((n[2] - 0.3f32.cos()).abs() < 1e-6);
        }
    }

    #[test]
    fn a_leaf_lying_on_the_right_faces_up_and_on_the_left_down() {
        let mut right = plane(0.0);
        right.update_normals();
        assert_eq!(right.normal(1, 1), [0.0, 0.0, 1.0]);
        let mut left = plane(core::f32::consts::PI);
        left.update_normals();
        assert!(left.normal(1, 1)[2] < -0.999);
    }

    #[test]
    fn coincident_points_keep_finite_normals() {
        let mut surface = Surface::new(3, 3);
        surface.update_normals();
        assert!(surface.normals.iter().all(|n| n.is_finite()));
    }

    #[test]
    fn strain_of_a_stretched_plane() {
        let mut surface = plane(0.2);
        for at in (0..surface.positions.len()).step_by(3) {
            surface.positions[at] *= 1.1;
            surface.positions[at + 2] *= 1.1;
        }
        let u = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];
        let range = surface.strain(&u, &[0.0, 0.5, 1.0], 3.0, 2.0);
        assert!((range.max - 0.1).abs() < 1e-6 && range.min.abs() < 1e-6);
    }

    #[test]
    fn resizing_raises_the_topology() {
        let mut surface = Surface::new(3, 3);
        surface.resize(3, 3);
        assert_eq!(surface.topology, 0);
        surface.resize(5, 4);
        assert_eq!((surface.topology, surface.positions.len()), (1, 60));
    }
}
