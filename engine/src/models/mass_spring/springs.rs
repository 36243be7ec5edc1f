//! The springs of Provot 1995 over a padded grid.
//!
//! Every spring of a family joins a node to the one a fixed number of lanes
//! further on, so a family is one pass over shifted rows: no index lists, no
//! scattered writes, four springs at a time. Lanes that hold no spring have
//! stiffness 0. Forces are kept per family and gathered afterwards, each node
//! taking what its own spring pulls and what the spring before it pushes.

use super::settings::Springs;
use crate::grid::Grid;
use crate::surface::StrainRange;

/// Keeps the root and the quotient of padding lanes finite; far below the
/// square of any spring's length.
const TINY: f32 = 1e-30;

/// One family of springs: same direction, same rest length.
#[derive(Clone, Debug)]
pub(crate) struct Family {
    /// Lanes from a spring's first node to its second.
    pub shift: usize,
    /// Rest length, in the unit of the leaf's width.
    pub rest: f32,
    /// Stiffness by the lane of the first node; 0 where there is no spring.
    stiffness: Vec<f32>,
    /// Damping along the spring by the lane of the first node.
    damping: Vec<f32>,
    damped: bool,
    /// Whether it is structural or shear, whose strain counts.
    pub holds_shape: bool,
    /// Force on the first node, after `lead` lanes of zeros.
    force: [Vec<f32>; 3],
    lead: usize,
    /// Lanes from the first that may hold a first node.
    count: usize,
    /// First nodes of its springs.
    firsts: Vec<usize>,
}

/// All springs of a leaf.
#[derive(Clone, Debug)]
pub(crate) struct SpringSystem {
    /// The springs by direction and rest length.
    pub families: Vec<Family>,
    lanes: usize,
}

impl Family {
    /// The springs from (column, row) to (column + across, row + up), where
    /// both are on the grid.
    fn new(
        grid: &Grid,
        across: isize,
        up: usize,
        stiffness: f32,
        damping: f32,
        holds_shape: bool,
    ) -> Self {
        let reach = |column: usize| {
            let to = column as isize + across;
            to >= 0 && to < grid.columns as isize
        };
        let firsts: Vec<usize> = (0..grid.rows - up)
            .flat_map(|row| (0..grid.columns).map(move |column| (column, row)))
            .filter(|&(column, _)| reach(column))
            .map(|(column, row)| grid.lane(column, row))
            .collect();
        let on_springs = |value: f32| {
            let mut lanes = vec![0.0; grid.lanes()];
            for &first in &firsts {
                lanes[first] = value;
            }
            lanes
        };
        let (du, dv) = (across as f32 * grid.du(), up as f32 * grid.dv());
        let lead = 2 * grid.stride;
        let buffer = || vec![0.0; lead + grid.lanes()];
        Self {
            shift: (up * grid.stride).wrapping_add_signed(across),
            rest: (du * du + dv * dv).sqrt(),
            stiffness: on_springs(stiffness),
            damping: on_springs(damping),
            damped: damping != 0.0,
            holds_shape,
            force: [buffer(), buffer(), buffer()],
            lead,
            count: grid.lanes() - up * grid.stride,
            firsts,
        }
    }

    /// Both nodes of each spring, as lanes.
    pub fn springs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.firsts.iter().map(|&first| (first, first + self.shift))
    }

    fn update(&mut self, position: &[Vec<f32>; 3], velocity: &[Vec<f32>; 3]) {
        let count = self.count;
        let [x, y, z] = position.each_ref().map(|axis| &axis[..count]);
        let [xs, ys, zs] = position
            .each_ref()
            .map(|axis| &axis[self.shift..self.shift + count]);
        let [fx, fy, fz] = self
            .force
            .each_mut()
            .map(|axis| &mut axis[self.lead..self.lead + count]);
        let from = Ends {
            x,
            y,
            z,
            xs,
            ys,
            zs,
        };
        pull(self.rest, &self.stiffness[..count], from, fx, fy, fz);
        if self.damped {
            let [x, y, z] = velocity.each_ref().map(|axis| &axis[..count]);
            let [xs, ys, zs] = velocity
                .each_ref()
                .map(|axis| &axis[self.shift..self.shift + count]);
            let rate = Ends {
                x,
                y,
                z,
                xs,
                ys,
                zs,
            };
            damp(&self.damping[..count], from, rate, fx, fy, fz);
        }
    }
}

/// Positions (or velocities) of the first nodes and, shifted, of the second.
#[derive(Clone, Copy)]
struct Ends<'a> {
    x: &'a [f32],
    y: &'a [f32],
    z: &'a [f32],
    xs: &'a [f32],
    ys: &'a [f32],
    zs: &'a [f32],
}

/// Hooke's law on the first node of each spring: k (l - rest) along the spring.
#[inline(never)]
fn pull(rest: f32, k: &[f32], ends: Ends, fx: &mut [f32], fy: &mut [f32], fz: &mut [f32]) {
    let n = k.len();
    let (x, y, z) = (&ends.x[..n], &ends.y[..n], &ends.z[..n]);
    let (xs, ys, zs) = (&ends.xs[..n], &ends.ys[..n], &ends.zs[..n]);
    let (fx, fy, fz) = (&mut fx[..n], &mut fy[..n], &mut fz[..n]);
    for i in 0..n {
        let (dx, dy, dz) = (xs[i] - x[i], ys[i] - y[i], zs[i] - z[i]);
        let length = (dx * dx + dy * dy + dz * dz + TINY).sqrt();
        let pull = k[i] * ((length - rest) / length);
        fx[i] = pull * dx;
        fy[i] = pull * dy;
        fz[i] = pull * dz;
    }
}

/// Adds damping of the rate at which each spring lengthens.
#[inline(never)]
fn damp(c: &[f32], ends: Ends, rate: Ends, fx: &mut [f32], fy: &mut [f32], fz: &mut [f32]) {
    for i in 0..c.len() {
        let (dx, dy, dz) = (
            ends.xs[i] - ends.x[i],
            ends.ys[i] - ends.y[i],
            ends.zs[i] - ends.z[i],
        );
        let (wx, wy, wz) = (
            rate.xs[i] - rate.x[i],
            rate.ys[i] - rate.y[i],
            rate.zs[i] - rate.z[i],
        );
        let along = c[i] * ((dx * wx + dy * wy + dz * wz) / (dx * dx + dy * dy + dz * dz + TINY));
        fx[i] += along * dx;
        fy[i] += along * dy;
        fz[i] += along * dz;
    }
}

impl SpringSystem {
    /// The three kinds of springs of Provot 1995 over a grid: 60 structural, 50
    /// shear and 48 bend springs for 6 x 6 nodes.
    pub fn new(grid: &Grid, springs: &Springs) -> Self {
        let kinds: [(isize, usize, f32, bool); 6] = [
            (1, 0, springs.structural, true),
            (0, 1, springs.structural, true),
            (1, 1, springs.shear, true),
            (-1, 1, springs.shear, true),
            (2, 0, springs.bend, false),
            (0, 2, springs.bend, false),
        ];
        let families = kinds
            .map(|(across, up, stiffness, shape)| {
                let damping = if stiffness > 0.0 {
                    springs.damping
                } else {
                    0.0
                };
                Family::new(grid, across, up, stiffness, damping, shape)
            })
            .to_vec();
        Self {
            families,
            lanes: grid.lanes(),
        }
    }

    /// Number of springs.
    pub fn count(&self) -> usize {
        self.families.iter().map(|family| family.firsts.len()).sum()
    }

    /// Adds the springs' forces on every node to `force`.
    pub fn add_forces(
        &mut self,
        position: &[Vec<f32>; 3],
        velocity: &[Vec<f32>; 3],
        force: &mut [Vec<f32>; 3],
    ) {
        let lanes = self.lanes;
        for family in &mut self.families {
            family.update(position, velocity);
        }
        for axis in 0..3 {
            let sum = &mut force[axis][..lanes];
            for family in &self.families {
                let (lead, shift) = (family.lead, family.shift);
                let own = &family.force[axis][lead..lead + lanes];
                let other = &family.force[axis][lead - shift..lead - shift + lanes];
                for i in 0..lanes {
                    sum[i] += own[i] - other[i];
                }
            }
        }
    }

    /// Range of strains of the structural and shear springs.
    pub fn strain(&self, position: &[Vec<f32>; 3]) -> StrainRange {
        let mut range = StrainRange::default();
        for family in self.families.iter().filter(|family| family.holds_shape) {
            for (a, b) in family.springs() {
                let d = [0, 1, 2].map(|axis| position[axis][b] - position[axis][a]);
                let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
                range.include(length / family.rest - 1.0);
            }
        }
        range
    }

    /// Energy stored in the springs, J.
    pub fn energy(&self, position: &[Vec<f32>; 3]) -> f64 {
        let mut energy = 0.0;
        for family in &self.families {
            for (a, b) in family.springs() {
                let d = [0, 1, 2]
                    .map(|axis| f64::from(position[axis][b]) - f64::from(position[axis][a]));
                let stretch =
                    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt() - f64::from(family.rest);
                energy += 0.5 * f64::from(family.stiffness[a]) * stretch * stretch;
            }
        }
        energy
    }
}
