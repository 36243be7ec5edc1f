//! The interactive sheet: a leaf that behaves as paper does.
//!
//! A near-isometric rectangular grid of few nodes with linear bending stiffness
//! (see [`Rigidity`](crate::Rigidity)), stretch and shear stiff enough that no
//! one sees them, weight and air, advanced by implicit Euler: one Newton step
//! from where it is, solved directly by a banded Cholesky factorisation, then
//! sweeps that restore every edge's length exactly. A cubic spline carries the
//! drawn surface. docs/physics.md derives it and compares it with other ways.

mod assemble;
mod bending;
mod chains;
mod contact;
mod crease;
mod creased;
mod creased_grid;
mod creasing;
mod crumpling;
mod facets;
mod flat;
#[cfg(test)]
mod folding_tests;
mod grabs;
mod grid_walk;
mod held;
mod hinge_angles;
mod hinge_triangle;
mod hinges;
mod laid_folded;
mod lane_nodes;
mod material;
mod measure;
mod membrane;
mod nodes;
mod patches;
mod piece_outline;
mod plates;
mod settings;
mod sweep;
mod system;
mod tearing;
#[cfg(test)]
mod tests;
mod tether;
mod torn;
mod torn_grid;
mod torn_material;
mod torn_path;
mod touching;
mod turned_path;
mod turned_sheet;

pub use contact::{CONTACTS, Contact};
pub use crease::SheetCrease;
pub use settings::{InvalidSheet, Root, SheetSettings};
pub(crate) use sweep::Apart;

use crate::creased_only::CreasedOnly;
use crate::vector::dot;
use bending::Bending;
use creased::Creased;
use grabs::Grab;
use material::Material;
use membrane::Membrane;
use sweep::Sweep;
use system::System;
pub(crate) use tether::{Tether, Tie};
pub(crate) use torn_grid::TornGrid;
pub(crate) use touching::Touching;
pub(crate) use turned_path::wrapped;

use crate::band::Band;
use crate::grid::{Grid, Side};
use crate::interpolate::{Local, uniform_samples};
use crate::surface::Surface;
use crate::synchronise::{Synchronise, Synchroniser};
use crate::turn::TurnModel;
use settings::{CAN_SYNCHRONISE, CAN_TEAR};

/// Greatest speed of a node, m/s: nothing that a grab does to paper is faster.
const FASTEST: f32 = 12.0;

/// Stiffness that holds a pinned node, N/m.
const PIN: f32 = 2e4;

/// Work of a step, of one of a creased sheet and of a sweep for each node, nanoseconds of
/// native code: means of random gestures on whole and on folded leaves.
const STEP: u32 = 500;
const CREASED_STEP: u32 = 1000;
const SWEEP: u32 = 11;

/// A leaf of paper.
#[derive(Clone, Debug)]
pub struct Sheet {
    settings: SheetSettings,
    h: f32,
    /// Kilograms of each node, and of the air it carries along its normal.
    mass: Vec<f32>,
    air_mass: Vec<f32>,
    /// Kilograms of the paper by which the air drags at each node.
    drag_mass: Vec<f32>,
    /// Weight of each node, N: x, y, z.
    weight: Vec<f32>,
    /// Other constant forces, N: x, y, z of each node.
    loads: Vec<f32>,
    material: Material,
    bending: Bending,
    creased: CreasedOnly<Box<Creased>>,
    membrane: Membrane,
    sweep: Sweep,
    system: System,
    /// The part of the matrix that never changes: inertia and bending.
    constant: Band<f32>,
    positions: Vec<f32>,
    velocities: Vec<f32>,
    before: Vec<f32>,
    normals: Vec<[f32; 3]>,
    /// For each row the place to which the clamp's tangent points, now and in the
    /// last step.
    tangents: Vec<f32>,
    last_tangents: Vec<f32>,
    /// Seconds before the start of a step at which bending is taken: see
    /// [`assemble`](Self::assemble).
    lag: f32,
    /// How much stiffer bending is to changes of shape, by more damping than steps give.
    stiffer: f32,
    /// The nodes and the clamp's tangents then.
    lagging: Vec<f32>,
    lagging_tangents: Vec<f32>,
    contacts: Vec<[Contact; CONTACTS]>,
    pins: Vec<Option<[f32; 3]>>,
    tethers: Vec<Tether>,
    ties: Vec<Tie>,
    grabs: Vec<Grab>,
    /// The values of u and v at which it is drawn.
    samples: [Vec<f32>; 2],
    interpolation: Local,
    synchroniser: Option<(Grid, Synchroniser)>,
    time: f64,
    /// Work since it was last taken.
    work: u32,
}

impl Sheet {
    /// A sheet at rest on the right, flat and level.
    ///
    /// # Errors
    /// Where a setting is no number or out of bounds.
    pub fn new(settings: SheetSettings) -> Result<Sheet, InvalidSheet> {
        settings.check()?;
        let (columns, rows) = (settings.columns, settings.rows);
        let nodes = columns * rows;
        let h = settings.time_step as f32;
        let material = Material::even(&settings);
        let samples = [
            uniform_samples(4 * columns - 3),
            uniform_samples(2 * rows - 1),
        ];
        let mut sheet = Sheet {
            h,
            air_mass: vec![0.0; nodes],
            drag_mass: vec![0.0; nodes],
            mass: vec![0.0; nodes],
            weight: vec![0.0; 3 * nodes],
            loads: vec![0.0; 3 * nodes],
            bending: Bending::new(&settings),
            creased: CreasedOnly::NONE,
            membrane: Membrane::new(&settings, &material),
            sweep: Sweep::new(&settings, &material),
            system: System::new(columns, rows, settings.first(), 0),
            constant: System::new(columns, rows, settings.first(), 0).matrix,
            material,
            positions: vec![0.0; 3 * nodes],
            velocities: vec![0.0; 3 * nodes],
            before: vec![0.0; 3 * nodes],
            normals: vec![[0.0, 0.0, 1.0]; nodes],
            tangents: vec![0.0; 3 * rows],
            last_tangents: vec![0.0; 3 * rows],
            lag: 0.0,
            stiffer: 1.0,
            lagging: vec![0.0; 3 * nodes],
            lagging_tangents: vec![0.0; 3 * rows],
            contacts: vec![[Contact::default(); CONTACTS]; nodes],
            pins: vec![None; nodes],
            tethers: Vec::new(),
            ties: Vec::new(),
            grabs: Vec::new(),
            interpolation: Local::b_spline((columns, rows), &samples[0], &samples[1]),
            samples,
            synchroniser: None,
            time: 0.0,
            work: 0,
            settings,
        };
        sheet.weigh();
        sheet.prepare();
        sheet.lay_flat(Side::Right);
        Ok(sheet)
    }

    /// Finds what each node weighs.
    fn weigh(&mut self) {
        for node in 0..self.mass.len() {
            let area = self.material.area_at(node);
            self.mass[node] = (self.settings.stock.grammage * area) as f32;
            self.air_mass[node] = (self.settings.air.added_mass * area) as f32;
        }
        self.drag_mass.copy_from_slice(&self.mass);
        self.weigh_masses();
    }

    /// Finds the weight of each node's mass.
    fn weigh_masses(&mut self) {
        let gravity = self.settings.gravity.map(|g| g as f32);
        for (weight, mass) in self.weight.chunks_exact_mut(3).zip(&self.mass) {
            for (weight, g) in weight.iter_mut().zip(gravity) {
                *weight = mass * g;
            }
        }
    }

    /// Changes the acceleration of gravity, m/s^2. Nothing happens where it is no number.
    pub fn set_gravity(&mut self, gravity: [f64; 3]) {
        if gravity.iter().all(|g| g.is_finite()) {
            self.settings.gravity = gravity;
            self.weigh_masses();
        }
    }

    /// Computes what depends on the settings alone.
    fn prepare(&mut self) {
        let settings = &self.settings;
        let h = settings.time_step;
        // Implicit Euler damps as a step's time of damping would. What the paper has
        // less is taken back by the lag, what it has more is added.
        let damping = settings.damping_time();
        self.lag = (h - damping).max(0.0) as f32;
        let more = ((damping - h).max(0.0) / h) as f32;
        let first = settings.first();
        self.constant.clear();
        self.stiffer = 1.0 + more;
        if self.creased().is_none() {
            self.bending.add_to(&mut self.constant, first, self.stiffer);
        }
        for node in 0..self.mass.len() {
            if self.system.moves(node) {
                let at = self.system.unknown(node);
                for axis in 0..3 {
                    self.constant
                        .add(at + axis, at + axis, self.mass[node] / (self.h * self.h));
                }
            }
        }
        let asked = CAN_SYNCHRONISE && settings.synchronise != Synchronise::Off;
        self.synchroniser = asked.then(|| {
            let (width, height) = (settings.width as f32, settings.height as f32);
            let grid = Grid::new(settings.columns, settings.rows, width, height);
            let mut free = grid.zeros();
            for lane in grid.node_lanes() {
                free[lane] = if lane % grid.stride >= first {
                    1.0
                } else {
                    0.0
                };
            }
            let synchroniser = Synchroniser::new(settings.synchronise, &grid, &free);
            (grid, synchroniser)
        });
    }

    /// Advances by a step, the first of `count` in which its grabs shall go the way
    /// to where they pull.
    pub(crate) fn step_of(&mut self, count: u32) {
        // Torn through, pieces that are not parted yet go where their grabs do.
        let tears = CAN_TEAR && self.is_both_pieces();
        grabs::follow(&mut self.grabs, &self.settings, self.h, count, tears);
        self.advance();
    }

    /// The settings it was made of.
    pub fn settings(&self) -> &SheetSettings {
        &self.settings
    }

    /// Draws at the values `u` and `v` (each rising and within 0 to 1).
    ///
    /// # Panics
    /// As [`Interpolation::spline`](crate::Interpolation::spline), whose surface this is.
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) {
        let (columns, rows) = (self.settings.columns, self.settings.rows);
        self.interpolation = Local::b_spline((columns, rows), u, v);
        self.samples = [u.to_vec(), v.to_vec()];
        self.redraw_creases();
    }

    /// Brings what is deep in its firm contacts back out of them, for contacts found
    /// anew where the step led. It stops what moved in, and throws nothing out.
    pub(crate) fn push_out(&mut self) {
        self.before.copy_from_slice(&self.positions);
        self.sweep_edges();
        let x = self.positions.as_chunks::<3>().0;
        let before = self.before.as_chunks::<3>().0;
        let v = self.velocities.as_chunks_mut::<3>().0;
        for ((v, x), before) in v.iter_mut().zip(x).zip(before) {
            let out: [f32; 3] = core::array::from_fn(|axis| x[axis] - before[axis]);
            let square = dot(out, out);
            let against = dot(*v, out).min(0.0);
            if against < 0.0 {
                let stop = (square / self.h).min(-against) / square;
                for axis in 0..3 {
                    v[axis] += stop * out[axis];
                }
            }
        }
    }

    /// Grabs give way to what they could not draw the sheet through.
    pub(crate) fn give_way(&mut self) {
        for grab in &mut self.grabs {
            grab.give_way(&self.positions);
        }
    }

    fn advance(&mut self) {
        self.update_normals();
        self.assemble();
        self.before.copy_from_slice(&self.positions);
        let is_creased = self.creased().is_some();
        self.spend(if is_creased { CREASED_STEP } else { STEP });
        if self.system.solve(&mut self.positions) {
            self.sweep_edges();
            self.synchronise();
        }
        let inverse = 1.0 / self.h;
        let states = self.velocities.chunks_exact_mut(3);
        let moved = self
            .positions
            .chunks_exact(3)
            .zip(self.before.chunks_exact(3));
        for (v, (x, before)) in states.zip(moved) {
            let new: [f32; 3] = core::array::from_fn(|axis| (x[axis] - before[axis]) * inverse);
            let slower = (FASTEST / dot(new, new).sqrt().max(FASTEST)).min(1.0);
            v.copy_from_slice(&new.map(|v| v * slower));
        }
        if let Some(creased) = self.creased.as_mut() {
            creased
                .hinges
                .settle(&self.positions, &self.tangents, self.h);
        }
        self.last_tangents.copy_from_slice(&self.tangents);
        self.time += f64::from(self.h);
    }

    fn sweep_edges(&mut self) {
        let sweeps = self.sweep.run(&mut self.positions, &self.contacts);
        self.spend(sweeps * SWEEP);
    }

    fn spend(&mut self, of_node: u32) {
        let nodes = self.mass.len() as u32;
        self.work = self.work.saturating_add(of_node.saturating_mul(nodes));
    }

    /// Returns the work since it was last asked, in about nanoseconds of native code: counted
    /// by steps and sweeps, the same on every machine.
    pub(crate) fn take_work(&mut self) -> u32 {
        core::mem::take(&mut self.work)
    }

    fn synchronise(&mut self) {
        let (true, Some((grid, synchroniser))) = (CAN_SYNCHRONISE, &self.synchroniser) else {
            return;
        };
        let mut axes = grid.zeros3();
        grid.deinterleave(&self.positions, &mut axes);
        let first = self.settings.first();
        let mut free = grid.zeros();
        for lane in grid.node_lanes() {
            free[lane] = if lane % grid.stride >= first {
                1.0
            } else {
                0.0
            };
        }
        synchroniser.apply(grid, &free, &grid.rest(Side::Right), &mut axes);
        grid.interleave(&axes, &mut self.positions);
    }
}

impl TurnModel for Sheet {
    fn time_step(&self) -> f32 {
        self.h
    }

    fn time(&self) -> f32 {
        self.time as f32
    }

    fn step(&mut self) {
        self.step_of(1);
    }

    fn write_surface(&mut self, surface: &mut Surface) {
        let (columns, rows) = self.interpolation.samples();
        surface.resize(columns, rows);
        match self.creased.as_mut() {
            Some(creased) => {
                let points = &mut surface.positions;
                match &mut creased.patches {
                    Some(patches) => patches.apply(&self.positions, points),
                    None => facets::write(
                        self.settings.columns,
                        self.settings.rows,
                        &self.positions,
                        points,
                    ),
                }
            }
            _ => self
                .interpolation
                .apply_interleaved(&self.positions, &mut surface.positions),
        }
        surface.touch();
    }

    fn grid_size(&self) -> (usize, usize) {
        (self.settings.columns, self.settings.rows)
    }

    fn read_nodes(&self, positions: &mut [f32], velocities: &mut [f32]) {
        positions.copy_from_slice(&self.positions);
        velocities.copy_from_slice(&self.velocities);
    }
}
