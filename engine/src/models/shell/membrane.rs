//! Stretch and shear in the plane of the leaf.
//!
//! Every strain is a product of two edge-like differences of nodes: along an
//! edge a the Green strain (a.a - 1) / 2, between a and b the shear a.b, both
//! per unit of length. Both discretisations of bending share it.

use super::cells::MeshSettings;
use super::mesh::Mesh;
use super::system::System;
use super::vector::{Vector, dot, length, outer, scale};

/// Stiffness in shear over that in stretch, of paper: its shear modulus over the
/// geometric mean of its Young's moduli (typical).
const SHEAR: f64 = 0.4;

/// A strain c (p.q) - r with p and q weighted sums of its nodes' places.
#[derive(Clone, Debug)]
struct Strain<const N: usize> {
    nodes: [usize; N],
    p: [f64; N],
    q: [f64; N],
    c: f64,
    rest: f64,
    /// Added to the strain; see [`Membrane::swing`].
    swing: f64,
    /// Newtons a metre times area: energy is half of this times strain squared.
    stiffness: f64,
}

impl<const N: usize> Strain<N> {
    fn sum(&self, weights: &[f64; N], x: &[Vector]) -> Vector {
        let mut sum = [0.0; 3];
        for (node, weight) in self.nodes.iter().zip(weights) {
            for axis in 0..3 {
                sum[axis] += weight * x[*node][axis];
            }
        }
        sum
    }

    fn energy(&self, x: &[Vector]) -> f64 {
        let product = dot(self.sum(&self.p, x), self.sum(&self.q, x));
        let strain = self.c * product - self.rest + self.swing;
        0.5 * self.stiffness * strain * strain
    }

    /// What the mean of the strains at both ends of a way is above that in the
    /// middle, where each node is `half` from the ends.
    fn swing(&self, half: &[Vector]) -> f64 {
        self.c * dot(self.sum(&self.p, half), self.sum(&self.q, half))
    }

    fn add_to(&self, x: &[Vector], softness: f64, exact: bool, system: &mut System) {
        let (p, q) = (self.sum(&self.p, x), self.sum(&self.q, x));
        let k = self.stiffness * softness;
        let tension = k * (self.c * dot(p, q) - self.rest + self.swing);
        // Half of c (p.q) - r is a square for stretch only: its tension may stay
        // in a Hessian that must be positive, all else may not.
        let keep = exact || (self.c < 1.0 && tension > 0.0);
        let mut slopes = [[0.0; 3]; N];
        for i in 0..N {
            for axis in 0..3 {
                slopes[i][axis] = self.c * (self.p[i] * q[axis] + self.q[i] * p[axis]);
            }
            system.add_gradient(self.nodes[i], scale(tension, slopes[i]));
        }
        for i in 0..N {
            for j in 0..N {
                let (a, b) = (self.nodes[i], self.nodes[j]);
                if !system.wants(a, b) {
                    continue;
                }
                system.add_block(a, b, outer(k, slopes[i], slopes[j]));
                if keep {
                    let both = self.p[i] * self.q[j] + self.p[j] * self.q[i];
                    system.add_scalar(a, b, tension * self.c * both);
                }
            }
        }
    }
}

/// All strains of a leaf.
#[derive(Clone, Debug)]
pub(super) struct Membrane {
    stretch: Vec<Strain<2>>,
    shear: Vec<Strain<4>>,
    /// A factor of all stiffness, 1 but on the way to an equilibrium.
    pub softness: f64,
}

impl Membrane {
    /// Of stretching stiffness `stiffness` N/m.
    pub fn new(mesh: &Mesh, stiffness: f64) -> Self {
        Self {
            stretch: edges(mesh, stiffness),
            shear: mesh
                .cells()
                .map(|cell| shear(mesh, cell, SHEAR * stiffness))
                .collect(),
            softness: 1.0,
        }
    }

    /// Of a mesh of cells: every edge has half of the area of the cells beside it.
    pub fn of_cells(mesh: &MeshSettings) -> Self {
        let (mut stretch, mut shear) = (Vec::new(), Vec::new());
        for cell in &mesh.cells {
            let sides = cell.len();
            let area = mesh.area_of(cell);
            for (side, &from) in cell.iter().enumerate() {
                let to = cell[(side + 1) % sides];
                let [u, v] = mesh.way(from, to);
                let weights = [-1.0, 1.0].map(|w| w / u.hypot(v));
                stretch.push(Strain {
                    nodes: [from, to],
                    p: weights,
                    q: weights,
                    c: 0.5,
                    rest: 0.5,
                    swing: 0.0,
                    stiffness: 0.5 * mesh.membrane * area,
                });
            }
            if let &[a, b, c, d] = &cell[..] {
                shear.push(shear_of([a, b, d, c], mesh, area));
            }
        }
        Self {
            stretch,
            shear,
            softness: 1.0,
        }
    }

    /// Energy, J, where the nodes are at `x`, m.
    pub fn energy(&self, x: &[Vector]) -> f64 {
        let stretch: f64 = self.stretch.iter().map(|s| s.energy(x)).sum();
        let shear: f64 = self.shear.iter().map(|s| s.energy(x)).sum();
        self.softness * (stretch + shear)
    }

    /// Adds gradient and Hessian: the exact one, or one without negative directions.
    pub fn add_to(&self, x: &[Vector], exact: bool, system: &mut System) {
        for strain in &self.stretch {
            strain.add_to(x, self.softness, exact, system);
        }
        for strain in &self.shear {
            strain.add_to(x, self.softness, exact, system);
        }
    }

    /// Lets forces follow from the mean of the strains at the start and the end
    /// of a step, from which its middle is `half` away. As strains are quadratic
    /// in the places, the work done over the step is then the change of energy
    /// (Simo and Tarnow 1992, "The discrete energy-momentum method").
    pub fn swing(&mut self, half: &[Vector]) {
        for strain in &mut self.stretch {
            strain.swing = strain.swing(half);
        }
        for strain in &mut self.shear {
            strain.swing = strain.swing(half);
        }
    }

    /// Largest change of length of an edge along u or v, relative to its length.
    pub fn max_edge_strain(&self, x: &[Vector]) -> f64 {
        let of = |s: &Strain<2>| (length(s.sum(&s.p, x)) - 1.0).abs();
        self.stretch.iter().map(of).fold(0.0, f64::max)
    }
}

fn edges(mesh: &Mesh, stiffness: f64) -> Vec<Strain<2>> {
    let mut edges = Vec::new();
    let mut add = |from: usize, to: usize, rest: f64, width: f64| {
        let weights = [-1.0 / rest, 1.0 / rest];
        edges.push(Strain {
            nodes: [from, to],
            p: weights,
            q: weights,
            c: 0.5,
            rest: 0.5,
            swing: 0.0,
            stiffness: stiffness * rest * width,
        });
    };
    for (column, row) in mesh.places() {
        let here = mesh.node(column, row);
        if column + 1 < mesh.columns {
            add(here, here + 1, mesh.du, mesh.height_at(row));
        }
        if row + 1 < mesh.rows {
            add(here, here + mesh.columns, mesh.dv, mesh.width_at(column));
        }
    }
    edges
}

/// Shear of a cell, between the means of its opposite edges. Measured at its
/// corners instead, as triangles of both diagonals would, it makes the leaf far
/// too stiff where a cell is not plane.
fn shear(mesh: &Mesh, (column, row): (usize, usize), stiffness: f64) -> Strain<4> {
    let foot = mesh.node(column, row);
    let head = foot + mesh.columns;
    Strain {
        nodes: [foot, foot + 1, head, head + 1],
        p: [-0.5, 0.5, -0.5, 0.5].map(|w| w / mesh.du),
        q: [-0.5, -0.5, 0.5, 0.5].map(|w| w / mesh.dv),
        c: 1.0,
        rest: 0.0,
        swing: 0.0,
        stiffness: stiffness * mesh.du * mesh.dv,
    }
}

/// Shear between the middle lines of a cell of any four corners, foot and head as in
/// [`shear`].
fn shear_of(nodes: [usize; 4], mesh: &MeshSettings, area: f64) -> Strain<4> {
    let middle = |signs: [f64; 4]| {
        let mut line = [0.0; 2];
        for (node, sign) in nodes.iter().zip(signs) {
            for axis in 0..2 {
                line[axis] += 0.5 * sign * mesh.places[*node][axis];
            }
        }
        let long = line[0].hypot(line[1]);
        (signs.map(|sign| 0.5 * sign / long), line.map(|w| w / long))
    };
    let (p, across) = middle([-1.0, 1.0, -1.0, 1.0]);
    let (q, up) = middle([-1.0, -1.0, 1.0, 1.0]);
    Strain {
        nodes,
        p,
        q,
        c: 1.0,
        rest: across[0] * up[0] + across[1] * up[1],
        swing: 0.0,
        stiffness: SHEAR * mesh.membrane * area,
    }
}
