//! Bending by second differences over the grid (Bergou et al. 2006, "A quadratic
//! bending model for inextensible surfaces", is the same idea on triangles).
//!
//! On a nearly inextensible sheet |x_uu|, |x_vv| and |x_uv| are the curvatures
//! and the twist. A second difference is 2 sin(angle / 2) over the distance of
//! the nodes, so that the energy quadratic in it is soft where a cell bends far;
//! the next term of angle^2 = s^2 + s^4 / 12 + ... makes that good. Along a free
//! edge bending across the edge costs nothing, so there the energy is the least
//! over it.

use super::bending::Bending;
use super::clamp::Clamps;
use super::mesh::Mesh;
use super::system::System;
use super::vector::{Vector, along, difference, dot, scale};
use crate::rigidity::Rigidity;

/// A weighted sum of places, and of the direction beyond a clamped edge.
#[derive(Clone, Debug)]
struct Stencil {
    terms: Vec<(usize, f64)>,
    /// Node on a clamped edge beyond which the sum goes on, and the weight of
    /// the unit direction there.
    beyond: Option<(usize, f64)>,
    /// Energy is half of this times the sum's square and `arc` times its fourth
    /// power.
    stiffness: f64,
    arc: f64,
}

impl Stencil {
    /// The same, its fourth power as for a stiffness `ratio` times its own: the
    /// mixed sum has none.
    fn with_arc_of(self, ratio: f64) -> Self {
        Self {
            arc: ratio * self.arc,
            ..self
        }
    }
}

/// The bending energy of a grid.
#[derive(Clone, Debug)]
pub(super) struct GridBending {
    mesh: Mesh,
    stencils: Vec<Stencil>,
    /// Ratio of damping to stiffness, and the sums from which damping pulls.
    damping: f64,
    damped: Vec<Vector>,
}

impl GridBending {
    /// The bending of a grid of a plate's stiffness, held by clamps.
    pub fn new(mesh: &Mesh, rigidity: &Rigidity, clamps: &Clamps) -> Self {
        let plates = clamps.plates(mesh, rigidity);
        let mut stencils = Vec::new();
        for (column, row) in mesh.places() {
            let clamped = clamps.hold(column, mesh);
            let uu = along_u(mesh, column, row, clamped);
            let vv = along_v(mesh, column, row).filter(|_| !clamped);
            let area = mesh.width_at(column) * mesh.height_at(row);
            let plate = &plates[column];
            let Rigidity { d11, d22, d12, .. } = *plate;
            let mut add = |stencil: Stencil, d: f64| {
                stencils.push(Stencil {
                    stiffness: d * area,
                    ..stencil
                });
            };
            match (uu, vv) {
                (Some(uu), Some(vv)) => {
                    // 2 uu.vv is |uu + vv|^2 less |uu|^2 and |vv|^2.
                    add(sum(&uu, &vv), d12);
                    add(uu.with_arc_of(d11 / (d11 - d12)), d11 - d12);
                    add(vv.with_arc_of(d22 / (d22 - d12)), d22 - d12);
                }
                (Some(uu), None) if clamped => add(uu, d11),
                (Some(uu), None) => add(uu, plate.free_d11()),
                (None, Some(vv)) => add(vv, plate.free_d22()),
                (None, None) => {}
            }
        }
        stencils.extend(mesh.cells().map(|cell| twist(mesh, cell, rigidity.d66)));
        let damped = vec![[0.0; 3]; stencils.len()];
        Self {
            mesh: *mesh,
            stencils,
            damping: 0.0,
            damped,
        }
    }

    fn sum(&self, stencil: &Stencil, x: &[Vector], clamps: &Clamps) -> Vector {
        let mut sum = [0.0; 3];
        for &(node, weight) in &stencil.terms {
            for axis in 0..3 {
                sum[axis] += weight * x[node][axis];
            }
        }
        if let Some((edge, weight)) = stencil.beyond {
            let beyond = clamps.beyond(edge, &self.mesh);
            for axis in 0..3 {
                sum[axis] += weight * beyond[axis];
            }
        }
        sum
    }
}

impl Bending for GridBending {
    fn energy(&self, x: &[Vector], clamps: &Clamps) -> f64 {
        let mut energy = 0.0;
        for (stencil, &damped) in self.stencils.iter().zip(&self.damped) {
            let sum = self.sum(stencil, x, clamps);
            let apart = difference(sum, damped);
            let square = dot(sum, sum);
            let bent = square + stencil.arc * square * square;
            energy += 0.5 * stencil.stiffness * (bent + self.damping * dot(apart, apart));
        }
        energy
    }

    fn add_to(&self, x: &[Vector], clamps: &Clamps, _exact: bool, system: &mut System) {
        for (stencil, &damped) in self.stencils.iter().zip(&self.damped) {
            let sum = self.sum(stencil, x, clamps);
            let arc = 2.0 * stencil.arc;
            let straight = 1.0 + arc * dot(sum, sum);
            let mut pull = [0.0; 3];
            for axis in 0..3 {
                pull[axis] = straight * sum[axis] + self.damping * (sum[axis] - damped[axis]);
            }
            let stiffness = stencil.stiffness;
            let block = along(
                stiffness * (straight + self.damping),
                2.0 * stiffness * arc,
                sum,
            );
            for &(a, weight) in &stencil.terms {
                system.add_gradient(a, scale(stencil.stiffness * weight, pull));
                for &(b, other) in &stencil.terms {
                    if system.wants(a, b) {
                        system.add_block(a, b, block.map(|row| scale(weight * other, row)));
                    }
                }
            }
        }
    }

    fn damp(&mut self, ratio: f64, from: &[Vector], clamps: &Clamps) {
        self.damping = ratio;
        self.damped = self
            .stencils
            .iter()
            .map(|stencil| self.sum(stencil, from, clamps))
            .collect();
    }
}

/// x_uu at a node. At a clamped edge it is that between the clamp and the first
/// edge of the grid, half a cell away.
fn along_u(mesh: &Mesh, column: usize, row: usize, clamped: bool) -> Option<Stencil> {
    let here = mesh.node(column, row);
    let w = 1.0 / (mesh.du * mesh.du);
    let inner = if column == 0 { here + 1 } else { here - 1 };
    let (terms, beyond) = if clamped {
        let terms = vec![(here, -2.0 * w), (inner, 2.0 * w)];
        (terms, Some((here, 2.0 / mesh.du)))
    } else if column == 0 || column + 1 == mesh.columns {
        return None;
    } else {
        (vec![(here - 1, w), (here, -2.0 * w), (here + 1, w)], None)
    };
    Some(Stencil {
        terms,
        beyond,
        stiffness: 0.0,
        arc: mesh.du * mesh.du / if clamped { 48.0 } else { 12.0 },
    })
}

/// x_vv at a node, unless it lies at the foot or the head.
fn along_v(mesh: &Mesh, column: usize, row: usize) -> Option<Stencil> {
    if row == 0 || row + 1 == mesh.rows {
        return None;
    }
    let (here, w) = (mesh.node(column, row), 1.0 / (mesh.dv * mesh.dv));
    let (below, above) = (here - mesh.columns, here + mesh.columns);
    Some(Stencil {
        terms: vec![(below, w), (here, -2.0 * w), (above, w)],
        beyond: None,
        stiffness: 0.0,
        arc: mesh.dv * mesh.dv / 12.0,
    })
}

fn sum(uu: &Stencil, vv: &Stencil) -> Stencil {
    let mut terms = uu.terms.clone();
    for &(node, weight) in &vv.terms {
        match terms.iter_mut().find(|(known, _)| *known == node) {
            Some((_, known)) => *known += weight,
            None => terms.push((node, weight)),
        }
    }
    Stencil {
        terms,
        beyond: None,
        stiffness: 0.0,
        arc: 0.0,
    }
}

/// x_uv in the middle of a cell.
fn twist(mesh: &Mesh, (column, row): (usize, usize), d66: f64) -> Stencil {
    let (here, area) = (mesh.node(column, row), mesh.du * mesh.dv);
    let (w, above) = (1.0 / area, here + mesh.columns);
    Stencil {
        terms: vec![(here, w), (here + 1, -w), (above, -w), (above + 1, w)],
        beyond: None,
        stiffness: 4.0 * d66 * area,
        arc: 0.0,
    }
}
