//! What can be seen of a drawn surface: how far it is from paper's.

use turnleaf_engine::{StrainRange, Surface, uniform_samples};

use crate::specimen::{BREADTH, LENGTH};

/// Points along a side on which surfaces are compared.
pub const POINTS: usize = 26;

/// The worst of a surface over a turn.
#[derive(Clone, Copy, Debug, Default)]
pub struct Faults {
    /// Strains of the mesh's edges.
    pub strain: StrainRange,
    /// Greatest change of the whole area, as part of it.
    pub area: f64,
    /// Greatest change of a cell's angle, degrees.
    pub angle: f64,
    /// Greatest angle between the normals of neighbouring facets, degrees.
    pub crease: f64,
    /// Greatest distance of a point of the spine from where it is bound, over the
    /// width.
    pub spine: f64,
    /// Greatest shear of a cell of nodes, degrees, as [`Sheet::max_shear`] measures it.
    ///
    /// [`Sheet::max_shear`]: turnleaf_engine::Sheet::max_shear
    pub shear: f64,
    /// Greatest stretch of a diagonal of a cell of nodes, as part of its length.
    pub diagonal: f64,
}

impl Faults {
    /// Includes a surface.
    pub fn include(&mut self, surface: &Surface) {
        let (u, v) = (
            uniform_samples(surface.columns),
            uniform_samples(surface.rows),
        );
        let strain = surface.strain(&u, &v, LENGTH as f32, BREADTH as f32);
        self.strain = self.strain.union(strain);
        let mut area = 0.0;
        for row in 0..surface.rows - 1 {
            for column in 0..surface.columns - 1 {
                let corners = corners(surface, column, row);
                area += 0.5
                    * length(cross(
                        to(corners[0], corners[2]),
                        to(corners[1], corners[3]),
                    ));
                for k in 0..4 {
                    let (a, b) = (
                        to(corners[k], corners[(k + 1) % 4]),
                        to(corners[k], corners[(k + 3) % 4]),
                    );
                    self.angle = self.angle.max((angle(a, b) - 90.0).abs());
                }
                let normal = normal(surface, column, row);
                let (right, above) = (column + 2 < surface.columns, row + 2 < surface.rows);
                let next = [(right, column + 1, row), (above, column, row + 1)];
                for (there, column, row) in next {
                    if there {
                        let other = self::normal(surface, column, row);
                        self.crease = self.crease.max(angle(normal, other));
                    }
                }
            }
        }
        self.area = self.area.max((area / (LENGTH * BREADTH) - 1.0).abs());
        for row in 0..surface.rows {
            let y = f64::from(v[row]) * BREADTH;
            let place = point(surface, 0, row);
            self.spine = self.spine.max(length(to([0.0, y, 0.0], place)) / LENGTH);
        }
    }

    /// Includes the nodes of a model, which span even cells of the flat page.
    pub fn include_nodes(&mut self, nodes: &Surface) {
        let cells = [nodes.columns, nodes.rows].map(|count| (count - 1) as f64);
        let rest = (LENGTH / cells[0]).hypot(BREADTH / cells[1]);
        for row in 0..nodes.rows - 1 {
            for column in 0..nodes.columns - 1 {
                let [a, b, c, d] = corners(nodes, column, row);
                let longest = length(to(a, c)).max(length(to(d, b)));
                let square = |from, to_| length(to(from, to_)).powi(2);
                let along = 0.5 * (square(a, b) + square(d, c));
                let up = 0.5 * (square(a, d) + square(b, c));
                let sine = 0.5 * (longest.powi(2) - along - up) / (along * up).sqrt();
                self.shear = self.shear.max(sine.clamp(0.0, 1.0).asin().to_degrees());
                self.diagonal = self.diagonal.max(longest / rest - 1.0);
            }
        }
    }
}

/// Points of the drawn facets at `POINTS` x `POINTS` places.
pub fn places(surface: &Surface) -> Vec<[f64; 3]> {
    let mut places = Vec::with_capacity(POINTS * POINTS);
    let cell = |part: f64, count: usize| {
        let at = part * (count - 1) as f64;
        let first = (at as usize).min(count - 2);
        (first, at - first as f64)
    };
    for row in 0..POINTS {
        let (r, v) = cell(row as f64 / (POINTS - 1) as f64, surface.rows);
        for column in 0..POINTS {
            let (c, u) = cell(column as f64 / (POINTS - 1) as f64, surface.columns);
            let [a, b, d, e] = corners(surface, c, r);
            places.push(std::array::from_fn(|axis| {
                let foot = a[axis] + u * (b[axis] - a[axis]);
                let head = e[axis] + u * (d[axis] - e[axis]);
                foot + v * (head - foot)
            }));
        }
    }
    places
}

/// How much of the turn is done, 0 on the right to 1 on the left: by the angle of
/// the fore-edge about the spine, as the viewer looks.
pub fn progress(places: &[[f64; 3]]) -> f64 {
    let edge = places.iter().skip(POINTS - 1).step_by(POINTS);
    let angles = edge.map(|[x, _, z]| z.max(0.0).atan2(*x));
    angles.sum::<f64>() / (POINTS as f64 * std::f64::consts::PI)
}

/// Distances of places from one another, over the width.
pub fn distances(a: &[[f64; 3]], b: &[[f64; 3]]) -> impl Iterator<Item = f64> {
    a.iter().zip(b).map(|(a, b)| length(to(*a, *b)) / LENGTH)
}

fn point(surface: &Surface, column: usize, row: usize) -> [f64; 3] {
    surface.position(column, row).map(f64::from)
}

/// Corners of a cell, around it.
fn corners(surface: &Surface, column: usize, row: usize) -> [[f64; 3]; 4] {
    [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(c, r)| point(surface, column + c, row + r))
}

fn normal(surface: &Surface, column: usize, row: usize) -> [f64; 3] {
    let corners = corners(surface, column, row);
    cross(to(corners[0], corners[2]), to(corners[1], corners[3]))
}

fn to(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| b[axis] - a[axis])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn length(a: [f64; 3]) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

/// Angle between directions, degrees; 0 where one has none.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let across = length(cross(a, b));
    let along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    across.atan2(along).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet lying flat on the right, its fore-edge's last column raised by an
    /// angle and all of it stretched across the spine.
    fn sheet(raised: f64, stretch: f64) -> Surface {
        let mut surface = Surface::new(5, 4);
        for row in 0..4 {
            for column in 0..5 {
                let (x, last) = (stretch * LENGTH * column as f64 / 4.0, column == 4);
                let cell = stretch * LENGTH / 4.0;
                let (sin, cos) = raised.sin_cos();
                let place = if last {
                    [x - cell + cell * cos, 0.0, cell * sin]
                } else {
                    [x, 0.0, 0.0]
                };
                let at = 3 * (row * 5 + column);
                surface.positions[at] = place[0] as f32;
                surface.positions[at + 1] = (BREADTH * row as f64 / 3.0) as f32;
                surface.positions[at + 2] = place[2] as f32;
            }
        }
        surface
    }

    #[test]
    fn a_flat_sheet_has_no_fault() {
        let mut faults = Faults::default();
        faults.include(&sheet(0.0, 1.0));
        assert!(faults.strain.max < 1e-5 && faults.strain.min > -1e-5);
        assert!(faults.area < 1e-5 && faults.angle < 1e-3 && faults.crease < 1e-3);
        assert!(faults.spine < 1e-6);
    }

    #[test]
    fn a_crease_and_a_stretch_are_seen_as_what_they_are() {
        let mut faults = Faults::default();
        faults.include(&sheet(0.5, 1.1));
        assert!((faults.crease - 0.5f64.to_degrees()).abs() < 1e-3);
        assert!((faults.area - 0.1).abs() < 1e-5);
        assert!((faults.strain.max - 0.1).abs() < 1e-5);
        assert!(faults.angle < 1e-3);
    }

    #[test]
    fn sheared_nodes_are_sheared_by_their_angle() {
        for shear in [0.0f64, 0.3, -1.2] {
            let mut nodes = sheet(0.0, 1.0);
            for point in nodes.positions.as_chunks_mut::<3>().0 {
                let v = f64::from(point[1]);
                point[0] += (v * shear.sin()) as f32;
                point[1] = (v * shear.cos()) as f32;
            }
            let mut faults = Faults::default();
            faults.include_nodes(&nodes);
            assert!((faults.shear - shear.abs().to_degrees()).abs() < 1e-3);
            let (du, dv) = (LENGTH / 4.0, BREADTH / 3.0);
            let square = du * du + dv * dv + 2.0 * du * dv * shear.sin().abs();
            let longer = (square / (du * du + dv * dv)).sqrt() - 1.0;
            assert!((faults.diagonal - longer).abs() < 1e-5);
        }
    }

    #[test]
    fn places_of_facets_are_those_of_the_sheet() {
        let coarse = places(&sheet(0.0, 1.0));
        for (k, place) in coarse.iter().enumerate() {
            let x = LENGTH * (k % POINTS) as f64 / (POINTS - 1) as f64;
            let y = BREADTH * (k / POINTS) as f64 / (POINTS - 1) as f64;
            assert!((place[0] - x).abs() < 1e-7 && (place[1] - y).abs() < 1e-7);
        }
        assert!(distances(&coarse, &coarse).all(|distance| distance == 0.0));
    }
}
