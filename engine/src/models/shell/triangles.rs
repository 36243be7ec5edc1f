//! Bending of triangles by the discrete shape operator of their three hinges
//! (Grinspun, Gingold, Reisman and Zorin 2006, "Computing discrete shape
//! operators on general meshes", with the normal of an edge midway between those
//! of its two triangles).
//!
//! Midway normals are exact for quadratic surfaces where the two triangles at
//! every edge form a parallelogram. So each cell is cut along both diagonals,
//! into two such triangulations, and bending is the mean of theirs: consistent,
//! and without a preferred diagonal. Unlike the grid's second differences this
//! energy knows angles only, and is not quadratic.

use std::collections::BTreeMap;

use super::bending::Bending;
use super::cells::MeshSettings;
use super::clamp::{Clamps, GHOST};
use super::crease::{Crease, Fold};
use super::hinge::{Angle, angle, second_derivative};
use super::mesh::Mesh;
use super::system::System;
use super::triangulation::{Diagonal, Hinge, across, leg_along_u, leg_along_v, shape_operator};
use super::vector::{Block, Vector, advance, outer, scale};
use crate::rigidity::Rigidity;

/// A right triangle: its hinges over the leg along v, the leg along u and the
/// diagonal, and the stiffness that couples them.
#[derive(Clone, Debug)]
struct TriangleElement {
    hinges: [Option<usize>; 3],
    /// Its nodes and the apexes across its edges, and where among them the
    /// vertices of each hinge are.
    nodes: Vec<usize>,
    vertices: [[Option<usize>; 4]; 3],
    /// Energy is half of the angles' product with this.
    stiffness: [[f64; 3]; 3],
}

impl TriangleElement {
    fn new(hinges: [Option<usize>; 3], all: &[Hinge], stiffness: [[f64; 3]; 3]) -> Self {
        let mut nodes = Vec::new();
        let vertices = hinges.map(|hinge| {
            let hinge = hinge.map_or([GHOST; 4], |hinge| all[hinge]);
            hinge.map(|node| {
                if node == GHOST {
                    return None;
                }
                let known = nodes.iter().position(|known| *known == node);
                Some(known.unwrap_or_else(|| {
                    nodes.push(node);
                    nodes.len() - 1
                }))
            })
        });
        Self {
            hinges,
            nodes,
            vertices,
            stiffness,
        }
    }

    /// Adds the part of the Hessian that is products of the angles' slopes.
    fn add_to(&self, angles: &[Angle], factor: f64, system: &mut System) {
        // By node and hinge.
        let mut slopes = [[[0.0; 3]; 3]; 6];
        for (side, (hinge, vertices)) in self.hinges.iter().zip(&self.vertices).enumerate() {
            let Some(hinge) = *hinge else { continue };
            for (vertex, slope) in vertices.iter().zip(&angles[hinge].gradient) {
                if let Some(vertex) = *vertex {
                    slopes[vertex][side] = *slope;
                }
            }
        }
        for (i, &a) in self.nodes.iter().enumerate() {
            let mut moments = [[0.0; 3]; 3];
            for (j, moment) in moments.iter_mut().enumerate() {
                for k in 0..3 {
                    *moment = advance(*moment, factor * self.stiffness[j][k], slopes[i][k]);
                }
            }
            for (j, &b) in self.nodes.iter().enumerate() {
                if system.wants(a, b) {
                    system.add_block(a, b, product(&moments, &slopes[j]));
                }
            }
        }
    }
}

/// The sum of the outer products of corresponding vectors.
fn product(a: &[Vector; 3], b: &[Vector; 3]) -> Block {
    let mut block = [[0.0; 3]; 3];
    for (a, b) in a.iter().zip(b) {
        for axis in 0..3 {
            block[axis] = advance(block[axis], a[axis], *b);
        }
    }
    block
}

/// The bending energy of a leaf of triangles.
#[derive(Clone, Debug)]
pub(super) struct TriangleBending {
    mesh: Mesh,
    hinges: Vec<Hinge>,
    triangles: Vec<TriangleElement>,
    /// The hinges that lie on creases.
    folds: Vec<Fold>,
    /// Ratio of damping to stiffness, and the angles from which damping pulls.
    damping: f64,
    damped: Vec<f64>,
}

impl TriangleBending {
    /// The bending of a grid of a plate's stiffness, held by clamps and creased along columns.
    pub fn new(mesh: &Mesh, rigidity: &Rigidity, clamps: &Clamps, creases: &[Crease]) -> Self {
        let mut bending = Self {
            mesh: *mesh,
            hinges: Vec::new(),
            triangles: Vec::new(),
            folds: Vec::new(),
            damping: 0.0,
            damped: Vec::new(),
        };
        for diagonal in [Diagonal::Falling, Diagonal::Rising] {
            bending.triangulate(diagonal, rigidity, clamps);
        }
        for (crease, folded) in creases.iter().enumerate() {
            bending.fold(crease, folded);
        }
        bending.damped = vec![0.0; bending.hinges.len()];
        bending
    }

    /// Of a mesh of cells, none of its edges clamped and Poisson's ratio 0.
    pub fn of_cells(mesh: &MeshSettings) -> Self {
        let mut bending = Self {
            mesh: Mesh {
                columns: mesh.places.len(),
                rows: 1,
                du: 1.0,
                dv: 1.0,
            },
            hinges: Vec::new(),
            triangles: Vec::new(),
            folds: Vec::new(),
            damping: 0.0,
            damped: Vec::new(),
        };
        for cut in [[0, 1, 2, 0, 2, 3], [0, 1, 3, 1, 2, 3]] {
            let triangles = mesh.cells.iter().flat_map(|cell| match cell[..] {
                [a, b, c] => vec![[a, b, c]],
                _ => {
                    let [a, b, c, d, e, f] = cut.map(|corner| cell[corner]);
                    vec![[a, b, c], [d, e, f]]
                }
            });
            bending.add_triangles(&triangles.collect::<Vec<_>>(), mesh);
        }
        bending.damped = vec![0.0; bending.hinges.len()];
        bending
    }

    fn add_triangles(&mut self, triangles: &[[usize; 3]], mesh: &MeshSettings) {
        let sides = |[a, b, c]: [usize; 3]| [(a, b, c), (b, c, a), (c, a, b)];
        let mut apexes = BTreeMap::new();
        for (from, to, apex) in triangles.iter().flat_map(|triangle| sides(*triangle)) {
            apexes.insert((from, to), apex);
        }
        let mut numbers = BTreeMap::new();
        for (&(from, to), &left) in &apexes {
            if let (true, Some(&right)) = (from < to, apexes.get(&(to, from))) {
                numbers.insert((from, to), self.hinges.len());
                self.hinges.push([from, to, left, right]);
            }
        }
        let plate = [1.0, 1.0, 0.5].map(|part| part * mesh.bending);
        for triangle in triangles {
            let area = mesh.area_of(triangle);
            let hinges = sides(*triangle)
                .map(|(from, to, _)| numbers.get(&(from.min(to), from.max(to))).copied());
            let shape = sides(*triangle).map(|(from, to, _)| {
                let [u, v] = mesh.way(from, to);
                let scale = 1.0 / (2.0 * area * u.hypot(v));
                [scale * v * v, scale * u * u, -2.0 * scale * u * v]
            });
            // Every cell is cut twice.
            let product = |i: usize, j: usize| {
                let terms = (0..3).map(|k| shape[i][k] * plate[k] * shape[j][k]);
                0.5 * area * terms.sum::<f64>()
            };
            let stiffness = core::array::from_fn(|i| core::array::from_fn(|j| product(i, j)));
            self.triangles
                .push(TriangleElement::new(hinges, &self.hinges, stiffness));
        }
    }

    /// Groups of nodes whose places are coupled.
    pub fn couplings(&self) -> impl Iterator<Item = &[usize]> {
        self.triangles.iter().map(|triangle| &triangle.nodes[..])
    }

    fn triangulate(&mut self, diagonal: Diagonal, rigidity: &Rigidity, clamps: &Clamps) {
        let mesh = self.mesh;
        let mut legs_v = vec![None; mesh.nodes()];
        let mut legs_u = vec![None; mesh.nodes()];
        for (column, row) in mesh.places() {
            let here = mesh.node(column, row);
            legs_v[here] = self.add(leg_along_v(&mesh, diagonal, clamps, column, row));
            legs_u[here] = self.add(leg_along_u(&mesh, diagonal, column, row));
        }
        let plates = clamps.plates(&mesh, rigidity);
        for (column, row) in mesh.cells() {
            let across = self.add(Some(across(&mesh, diagonal, column, row)));
            for upper in [false, true] {
                // The corner of the right angle.
                let right = upper == (diagonal == Diagonal::Falling);
                let (column_v, row_u) = (column + usize::from(right), row + usize::from(upper));
                let leg_v = legs_v[mesh.node(column_v, row)];
                let leg_u = legs_u[mesh.node(column, row_u)];
                let clamped = clamps.hold(column_v, &mesh);
                let shape = shape_operator(&mesh, diagonal, clamped);
                let free = [leg_v.is_none(), leg_u.is_none()];
                let stiffness = stiffness(&mesh, &plates[column_v].moments(free), &shape);
                let triangle =
                    TriangleElement::new([leg_v, leg_u, across], &self.hinges, stiffness);
                self.triangles.push(triangle);
            }
        }
    }

    /// Makes folds of the hinges on a crease.
    fn fold(&mut self, crease: usize, folded: &Crease) {
        let (columns, length) = (self.mesh.columns, self.mesh.dv);
        // Each edge is a hinge of both triangulations, with half of the crease.
        let spring = 0.5 * length * folded.stiffness;
        for (hinge, &[from, to, ..]) in self.hinges.iter().enumerate() {
            if from % columns != folded.column || to != from + columns {
                continue;
            }
            let of_triangle = |triangle: &TriangleElement| match triangle.hinges[0] {
                Some(leg) if leg == hinge => triangle.stiffness[0][0],
                _ => 0.0,
            };
            let paper = self.triangles.iter().map(of_triangle).sum();
            self.folds
                .push(Fold::new((hinge, crease), folded, [paper, spring]));
        }
    }

    fn add(&mut self, hinge: Option<Hinge>) -> Option<usize> {
        self.hinges.extend(hinge);
        hinge.map(|_| self.hinges.len() - 1)
    }

    fn vertices(&self, hinge: &Hinge, x: &[Vector], clamps: &Clamps) -> [Vector; 4] {
        let apex_edge = [hinge[0], hinge[0], hinge[0], hinge[1]];
        core::array::from_fn(|i| clamps.place(hinge[i], apex_edge[i], &self.mesh, x))
    }

    /// What the paper bends at each hinge: all of its angle but on a crease.
    fn angles(&self, x: &[Vector], clamps: &Clamps) -> Vec<Angle> {
        let of = |hinge| angle(&self.vertices(hinge, x, clamps));
        let mut angles: Vec<Angle> = self.hinges.iter().map(of).collect();
        for fold in &self.folds {
            let angle = &mut angles[fold.hinge];
            angle.value = fold.bent(angle.value);
            angle.gradient = angle.gradient.map(|slope| scale(fold.slope(), slope));
        }
        angles
    }

    /// Angle of a hinge of a triangle and its change since the start of the step.
    fn bent(&self, hinge: Option<usize>, angles: &[Angle]) -> (f64, f64) {
        hinge.map_or((0.0, 0.0), |h| {
            let value = angles[h].value;
            (value, value - self.damped[h])
        })
    }

    /// Moment over each hinge.
    fn moments(&self, angles: &[Angle]) -> Vec<f64> {
        let mut moments = vec![0.0; self.hinges.len()];
        for triangle in &self.triangles {
            let bent = triangle.hinges.map(|hinge| self.bent(hinge, angles));
            for (i, hinge) in triangle.hinges.iter().enumerate() {
                let Some(hinge) = *hinge else { continue };
                for j in 0..3 {
                    let angle = bent[j].0 + self.damping * bent[j].1;
                    moments[hinge] += triangle.stiffness[i][j] * angle;
                }
            }
        }
        for fold in &self.folds {
            let (bent, change) = self.bent(Some(fold.hinge), angles);
            moments[fold.hinge] += fold.stiffness * (bent + self.damping * change);
        }
        moments
    }
}

impl Bending for TriangleBending {
    fn energy(&self, x: &[Vector], clamps: &Clamps) -> f64 {
        let angles = self.angles(x, clamps);
        let mut energy = 0.0;
        for triangle in &self.triangles {
            let bent = triangle.hinges.map(|hinge| self.bent(hinge, &angles));
            for i in 0..3 {
                for j in 0..3 {
                    let products = bent[i].0 * bent[j].0 + self.damping * bent[i].1 * bent[j].1;
                    energy += 0.5 * triangle.stiffness[i][j] * products;
                }
            }
        }
        for fold in &self.folds {
            let (bent, change) = self.bent(Some(fold.hinge), &angles);
            let squares = bent * bent + self.damping * change * change;
            energy += 0.5 * fold.stiffness * squares;
        }
        energy
    }

    fn add_to(&self, x: &[Vector], clamps: &Clamps, exact: bool, system: &mut System) {
        let angles = self.angles(x, clamps);
        for triangle in &self.triangles {
            triangle.add_to(&angles, 1.0 + self.damping, system);
        }
        for fold in &self.folds {
            let factor = (1.0 + self.damping) * fold.stiffness;
            let (hinge, slopes) = (&self.hinges[fold.hinge], &angles[fold.hinge].gradient);
            for (&a, &by_a) in hinge.iter().zip(slopes) {
                for (&b, &by_b) in hinge.iter().zip(slopes) {
                    if system.wants(a, b) {
                        system.add_block(a, b, outer(factor, by_a, by_b));
                    }
                }
            }
        }
        let mut moments = self.moments(&angles);
        for ((hinge, angle), &moment) in self.hinges.iter().zip(&angles).zip(&moments) {
            for (&node, &slope) in hinge.iter().zip(&angle.gradient) {
                if node != GHOST {
                    system.add_gradient(node, scale(moment, slope));
                }
            }
        }
        if !exact {
            return;
        }
        // From here on by the hinges' own angles.
        for fold in &self.folds {
            moments[fold.hinge] *= fold.slope();
        }
        for (hinge, &moment) in self.hinges.iter().zip(&moments) {
            second_derivative(&self.vertices(hinge, x, clamps), |i, j, block| {
                let (a, b) = (hinge[i], hinge[j]);
                if a != GHOST && b != GHOST && system.wants(a, b) {
                    system.add_block(a, b, block.map(|row| scale(moment, row)));
                }
            });
        }
    }

    fn damp(&mut self, ratio: f64, from: &[Vector], clamps: &Clamps) {
        self.damping = ratio;
        let angles = self.angles(from, clamps);
        self.damped = angles.iter().map(|angle| angle.value).collect();
    }

    fn crease_angle(&self, crease: usize, x: &[Vector], clamps: &Clamps) -> Option<f64> {
        let angles = self.angles(x, clamps);
        let of = |fold: &Fold| fold.angle(angles[fold.hinge].value);
        mean(
            self.folds
                .iter()
                .filter(|fold| fold.crease == crease)
                .map(of),
        )
    }

    fn crease_rest(&self, crease: usize) -> Option<f64> {
        let folds = self.folds.iter().filter(|fold| fold.crease == crease);
        mean(folds.map(Fold::rest))
    }

    fn let_creases_follow(&mut self, x: &[Vector], clamps: &Clamps, seconds: f64) {
        if self.folds.is_empty() {
            return;
        }
        let angles = self.angles(x, clamps);
        for fold in &mut self.folds {
            fold.follow(angles[fold.hinge].value, seconds);
        }
    }
}

/// The mean of hinges' angles as a crease counts them, which are positive where its hinges' are
/// not; None of none.
fn mean(angles: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = angles.fold((0.0, 0.0), |(sum, count), angle| (sum - angle, count + 1.0));
    (count > 0.0).then(|| sum / count)
}

/// Stiffness between angles: that of the plate, over the triangle's area, half
/// of it as every cell is cut twice.
fn stiffness(mesh: &Mesh, plate: &[[f64; 3]; 3], shape: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let area = mesh.du * mesh.dv / 4.0;
    let mut stiffness = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            for a in 0..3 {
                for b in 0..3 {
                    stiffness[i][j] += area * shape[i][a] * plate[a][b] * shape[j][b];
                }
            }
        }
    }
    stiffness
}
