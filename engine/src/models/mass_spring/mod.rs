//! The paper's model: a grid of masses joined by springs (Provot 1995), with
//! the three improvements of Shangguan and Zeng 2014, each of which can be
//! switched off: synchronisation ([`Settings::synchronise`]), interpolation
//! ([`MassSpring::draw_nodes`]) and key frames (the recorder is apart from it).

mod air;
mod forces;
mod grabs;
mod held;
mod integrate;
mod nodes;
mod plate;
mod settings;
mod springs;
mod strain_limit;

#[cfg(test)]
mod tests;

pub use settings::{
    Integrator, InvalidSettings, Masses, Plate, Preset, Settings, Springs, StrainLimit,
};

use crate::gesture::Gesture;
use crate::grid::Grid;
use crate::interpolate::{Interpolation, uniform_samples};
use crate::surface::{StrainRange, Surface};
use crate::synchronise::Synchroniser;
use crate::turn::TurnModel;
use air::Air;
use forces::Forces;
use held::Held;
use integrate::Motion;
use plate::Bending;
use springs::SpringSystem;
use strain_limit::Limiter;

/// Points along a side of the drawn surface, as in the paper.
const PAPER_SAMPLES: usize = 26;

/// A leaf of masses and springs, its spine column fixed.
#[derive(Clone, Debug)]
pub struct MassSpring {
    settings: Settings,
    grid: Grid,
    /// Where each node rests, from which synchronisation measures.
    rest: [Vec<f32>; 3],
    motion: Motion,
    forces: Forces,
    air: Option<Air>,
    /// One over the mass of each node were it free; 0 for padding.
    own_inverse_mass: Vec<f32>,
    /// The same, and 0 for fixed and held nodes.
    inverse_mass: Vec<f32>,
    /// The same for the strain limit, to which nodes held by a hand yield.
    limit_weight: Vec<f32>,
    /// Parts into which a step is divided.
    substeps: usize,
    /// 1 for each free node, 0 for fixed and held ones and padding.
    free: Vec<f32>,
    synchroniser: Synchroniser,
    limiter: Limiter,
    held: Vec<Held>,
    /// The gesture under way and the step at which it began.
    gesture: Option<(Gesture, u64)>,
    steps: u64,
    /// Positions before the substep, where velocities follow from positions.
    before: [Vec<f32>; 3],
    /// Where the surface is sampled; nothing when the nodes themselves are drawn.
    interpolation: Option<Interpolation>,
}

impl MassSpring {
    /// A leaf at rest on its side. It is drawn by 26 x 26 points, as in the
    /// paper, unless set otherwise.
    ///
    /// # Errors
    /// If the settings make no leaf; the error says which and why.
    pub fn new(settings: Settings) -> Result<Self, InvalidSettings> {
        settings.check()?;
        let grid = Grid::new(
            settings.columns,
            settings.rows,
            settings.width,
            settings.height,
        );
        let rest = grid.rest(settings.side);
        let (own_inverse_mass, weight) = masses(&settings, &grid);
        let mut free = grid.zeros();
        for lane in grid.node_lanes().filter(|lane| lane % grid.stride != 0) {
            free[lane] = 1.0;
        }
        let forces = Forces {
            springs: SpringSystem::new(&grid, &settings.springs),
            bending: Bending::new(&grid, &settings.plate),
            weight,
            drag: settings.drag,
            wind: settings.wind,
        };
        let uniform = uniform_samples(PAPER_SAMPLES);
        let interpolation = Interpolation::lagrange(grid.columns, grid.rows, &uniform, &uniform);
        let mut leaf = Self {
            motion: Motion::new(&grid, rest.clone(), settings.integrator),
            air: Air::new(&settings, &grid, &own_inverse_mass),
            synchroniser: Synchroniser::new(settings.synchronise, &grid, &free),
            limiter: Limiter::new(settings.strain_limit, &grid),
            inverse_mass: grid.zeros(),
            limit_weight: grid.zeros(),
            substeps: settings.substeps.max(settings.stable_substeps()),
            held: Vec::new(),
            gesture: None,
            steps: 0,
            before: grid.zeros3(),
            interpolation: Some(interpolation),
            settings,
            grid,
            rest,
            forces,
            own_inverse_mass,
            free,
        };
        leaf.constraints_changed();
        Ok(leaf)
    }

    /// What the leaf is made of.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Number of springs: 158 for 6 x 6 nodes.
    pub fn spring_count(&self) -> usize {
        self.forces.springs.count()
    }

    /// Range of strains of all structural and shear springs, now.
    pub fn strain(&self) -> StrainRange {
        self.forces.springs.strain(&self.motion.position)
    }

    /// Whether all positions and velocities are finite numbers.
    pub fn is_finite(&self) -> bool {
        let all = |axes: &[Vec<f32>; 3]| axes.iter().flatten().all(|value| value.is_finite());
        all(&self.motion.position) && all(&self.motion.velocity)
    }

    /// Draws the surface at every pair of `u` (0 spine, 1 fore-edge) and `v`
    /// (0 foot, 1 head), rising and within 0..1, by Lagrange interpolation.
    ///
    /// # Panics
    /// As [`Interpolation::lagrange`].
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) {
        self.interpolation = Some(Interpolation::lagrange(
            self.grid.columns,
            self.grid.rows,
            u,
            v,
        ));
    }

    /// Draws the nodes themselves, without interpolation.
    pub fn draw_nodes(&mut self) {
        self.interpolation = None;
    }

    /// One part of a step, in the paper's order: held nodes move to where they are `part` of the way
    /// through it, then forces are computed, then the others move.
    fn substep(&mut self, h: f32, part: f32) {
        let follows = self.limiter.moves_velocity();
        if follows {
            for axis in 0..3 {
                self.before[axis].copy_from_slice(&self.motion.position[axis]);
            }
        }
        self.place_fixed_and_held(part);
        if let Some(air) = &self.air {
            air.apply(
                &self.grid,
                h,
                &self.free,
                &self.motion.position,
                &mut self.motion.velocity,
            );
        }
        self.motion.advance(
            self.settings.integrator,
            h,
            &mut self.forces,
            &self.inverse_mass,
        );
        if self.settings.floor {
            rest_on_floor(&self.free, &mut self.motion);
        }
        // Held nodes that have velocities were moved by these too.
        if follows {
            self.place_fixed_and_held(part);
        }
        self.synchroniser.apply(
            &self.grid,
            &self.free,
            &self.rest,
            &mut self.motion.position,
        );
        let (springs, position) = (&self.forces.springs, &mut self.motion.position);
        self.limiter.apply(
            &self.grid,
            springs,
            (&self.inverse_mass, &self.limit_weight),
            self.settings.floor,
            position,
        );
        if follows {
            let rate = 1.0 / h;
            for axis in 0..3 {
                let (x, v) = (&self.motion.position[axis], &mut self.motion.velocity[axis]);
                for ((v, x), before) in v.iter_mut().zip(x).zip(&self.before[axis]) {
                    *v = (x - before) * rate;
                }
            }
        }
    }
}

impl TurnModel for MassSpring {
    fn time_step(&self) -> f32 {
        self.settings.time_step
    }

    fn time(&self) -> f32 {
        (self.steps as f64 * f64::from(self.settings.time_step)) as f32
    }

    fn step(&mut self) {
        let substeps = self.substeps;
        let h = self.settings.time_step / substeps as f32;
        for substep in 1..=substeps {
            self.substep(h, substep as f32 / substeps as f32);
        }
        self.steps += 1;
        self.remember_held();
    }

    fn write_surface(&mut self, surface: &mut Surface) {
        match &mut self.interpolation {
            Some(lagrange) => {
                let (columns, rows) = lagrange.samples();
                surface.resize(columns, rows);
                let axes = self.motion.position.each_ref().map(|axis| &axis[..]);
                lagrange.apply(axes, self.grid.stride, &mut surface.positions);
            }
            None => {
                surface.resize(self.grid.columns, self.grid.rows);
                self.grid
                    .interleave(&self.motion.position, &mut surface.positions);
            }
        }
        surface.touch();
    }

    fn grid_size(&self) -> (usize, usize) {
        (self.grid.columns, self.grid.rows)
    }

    fn read_nodes(&self, positions: &mut [f32], velocities: &mut [f32]) {
        self.grid.interleave(&self.motion.position, positions);
        self.grid.interleave(&self.motion.velocity, velocities);
    }
}

/// One over the mass, and the weight, of each node.
fn masses(settings: &Settings, grid: &Grid) -> (Vec<f32>, Vec<f32>) {
    let (mut inverse, mut weight) = (grid.zeros(), grid.zeros());
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            let lane = grid.lane(column, row);
            (inverse[lane], weight[lane]) = match settings.masses {
                Masses::Equal { mass, gravity } => (1.0 / mass, gravity),
                Masses::ByArea {
                    grammage,
                    air,
                    gravity,
                } => {
                    let area = grid.du() * grid.dv() * grid.area_fraction(column, row);
                    (1.0 / ((grammage + air) * area), grammage * area * gravity)
                }
            };
        }
    }
    (inverse, weight)
}

/// Puts free nodes below the table onto it and takes their downward speed.
fn rest_on_floor(free: &[f32], motion: &mut Motion) {
    let (z, v) = (&mut motion.position[2], &mut motion.velocity[2]);
    for ((z, v), free) in z.iter_mut().zip(v.iter_mut()).zip(free) {
        let below = *z < 0.0 && *free > 0.0;
        *z = if below { 0.0 } else { *z };
        *v = if below && *v < 0.0 { 0.0 } else { *v };
    }
}
