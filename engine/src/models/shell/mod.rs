//! The reference: a leaf of paper as a thin elastic shell in double precision,
//! every step and every equilibrium solved to the end by Newton's method.
//!
//! Slow and exact, to hold the interactive models and the exact solutions
//! against. Two discretisations of bending check each other
//! ([`Discretisation`]); stretch and shear are stiff, so that the leaf bends and
//! hardly strains.

mod bending;
mod cells;
mod clamp;
mod crease;
#[cfg(test)]
mod crease_tests;
mod energy;
mod forces;
mod grid;
mod hinge;
mod membrane;
mod mesh;
mod meshed;
mod motion;
mod newton;
mod settings;
mod statics;
mod stepping;
mod system;
mod triangles;
mod triangulation;
mod vector;

#[cfg(test)]
mod motion_tests;
#[cfg(test)]
mod tests;

pub use cells::MeshSettings;
pub use crease::Crease;
pub use energy::Energies;
pub use meshed::{HalfSpace, MeshEnergies, MeshShell};
pub use settings::{Discretisation, Edge, InvalidShell, Scheme, ShellSettings, Table};

use crate::grab;
use crate::interpolate::Interpolation;
use crate::surface::Surface;
use crate::turn::TurnModel;
use bending::Bending;
use clamp::{Clamp, Clamps, direction};
use forces::{Forces, Hand};
use grid::GridBending;
use membrane::Membrane;
use mesh::Mesh;
use system::System;
use triangles::TriangleBending;
use vector::{Vector, advance, scale};

/// A leaf of paper, solved to the end.
#[derive(Debug)]
pub struct Shell {
    settings: ShellSettings,
    mesh: Mesh,
    forces: Forces,
    system: System,
    areas: Vec<f64>,
    x: Vec<Vector>,
    v: Vec<Vector>,
    /// Places and velocities one step ago, for the second-order formula.
    before: Option<(Vec<Vector>, Vec<Vector>)>,
    steps: u64,
    unsolved: u64,
    interpolation: Option<Interpolation>,
}

impl Shell {
    /// A leaf at rest without weight: from the spine on the y axis it goes on
    /// straight in the direction of its clamp there, or level, and is turned at
    /// each crease by its rest angle. A clamped fore-edge starts where it then lies.
    ///
    /// # Errors
    /// Where the settings make no leaf, in a sentence.
    pub fn new(settings: ShellSettings) -> Result<Self, InvalidShell> {
        settings.check()?;
        let mesh = Mesh {
            columns: settings.columns,
            rows: settings.rows,
            du: settings.width / (settings.columns - 1) as f64,
            dv: settings.height / (settings.rows - 1) as f64,
        };
        let clamps = Clamps {
            spine: Clamp::of(settings.spine, -1.0),
            fore_edge: Clamp::of(settings.fore_edge, 1.0),
        };
        let at_foot = folded_row(&settings, mesh.du);
        let flat = |(column, row): (usize, usize)| {
            let [x, _, z] = at_foot[column];
            [x, row as f64 * mesh.dv, z]
        };
        let area = |(column, row): (usize, usize)| mesh.width_at(column) * mesh.height_at(row);
        let areas: Vec<f64> = mesh.places().map(area).collect();
        let mut system = System::new(&mesh);
        for (node, (column, _)) in mesh.places().enumerate() {
            system.held[node] = clamps.hold(column, &mesh);
        }
        Ok(Self {
            forces: Forces {
                clamps,
                masses: areas
                    .iter()
                    .map(|area| settings.areal_mass * area)
                    .collect(),
                gravity: settings.gravity,
                loads: vec![[0.0; 3]; mesh.nodes()],
                membrane: Membrane::new(&mesh, settings.membrane),
                bending: bending(&settings, &mesh, &clamps),
                table: settings.table.is_some(),
                hand: None,
            },
            system,
            areas,
            x: mesh.places().map(flat).collect(),
            v: vec![[0.0; 3]; mesh.nodes()],
            before: None,
            steps: 0,
            unsolved: 0,
            interpolation: None,
            mesh,
            settings,
        })
    }

    /// What the leaf is made of.
    pub fn settings(&self) -> &ShellSettings {
        &self.settings
    }

    /// Turns the clamp or hinge at the spine to `angle` radians over the x axis. Nothing
    /// happens at a free spine.
    pub fn set_clamp_angle(&mut self, angle: f64) {
        if let Some(spine) = &mut self.forces.clamps.spine {
            spine.beyond = scale(-1.0, direction(angle));
        }
    }

    /// Moves a clamped or hinged fore-edge to `x` and `z` metres, each node keeping its
    /// height along the spine, and turns it to `angle` radians. Nothing happens
    /// at a free fore-edge.
    pub fn hold_fore_edge(&mut self, x: f64, z: f64, angle: f64) {
        if let Some(fore_edge) = &mut self.forces.clamps.fore_edge {
            fore_edge.beyond = direction(angle);
            for row in 0..self.mesh.rows {
                let node = self.mesh.node(self.mesh.columns - 1, row);
                self.x[node] = [x, row as f64 * self.mesh.dv, z];
            }
        }
    }

    /// Constant forces on the nodes, N: x, y, z of each, row by row from the
    /// foot, each row from the spine to the fore-edge.
    pub fn loads_mut(&mut self) -> &mut [f64] {
        self.forces.loads.as_flattened_mut()
    }

    /// Acceleration of gravity, m/s^2.
    pub fn set_gravity(&mut self, gravity: [f64; 3]) {
        self.forces.gravity = gravity;
    }

    /// Holds the node in `column` and `row` at a place (metres), or lets it go
    /// again. A clamp's node stays the clamp's.
    ///
    /// # Panics
    /// If there is no such node.
    pub fn pin(&mut self, column: usize, row: usize, place: Option<[f64; 3]>) {
        assert!(column < self.mesh.columns && row < self.mesh.rows);
        if self.forces.clamps.hold(column, &self.mesh) {
            return;
        }
        let node = self.mesh.node(column, row);
        self.system.held[node] = place.is_some();
        if let Some(place) = place {
            self.x[node] = place;
        }
    }

    /// A hand takes hold of the leaf about (`u`, `v`), each 0 to 1, where it is.
    pub fn grab(&mut self, u: f64, v: f64) {
        let grid = (self.mesh.columns, self.mesh.rows);
        let pad = grab::pad((u, v), grid, [self.settings.width, self.settings.height]);
        let mut target = [0.0; 3];
        for pressed in &pad {
            target = advance(target, pressed.weight, self.x[pressed.node]);
        }
        let frame = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let area = self.settings.width * self.settings.height;
        let strength = grab::strongest(self.settings.areal_mass, area);
        self.forces.hand = Some(Hand {
            pad,
            target,
            strength,
            frame,
        });
    }

    /// Moves the hand to a place, m. Nothing happens without one.
    pub fn pull(&mut self, target: [f64; 3]) {
        if let Some(hand) = &mut self.forces.hand {
            hand.target = target;
        }
    }

    /// The hand lets go.
    pub fn release(&mut self) {
        self.forces.hand = None;
    }

    /// Places of the nodes, m: x, y, z of each, row by row from the foot, each
    /// row from the spine to the fore-edge.
    pub fn positions(&self) -> &[f64] {
        self.x.as_flattened()
    }

    /// Velocities of the nodes, m/s, as [`Shell::positions`].
    pub fn velocities(&self) -> &[f64] {
        self.v.as_flattened()
    }

    /// Places and velocities from which to go on, as [`Shell::positions`].
    ///
    /// # Panics
    /// If a slice is not `3 * columns * rows` long.
    pub fn write_nodes(&mut self, positions: &[f64], velocities: &[f64]) {
        self.x.as_flattened_mut().copy_from_slice(positions);
        self.v.as_flattened_mut().copy_from_slice(velocities);
        self.before = None;
    }

    /// Draws the surface at every pair of `u` (0 spine, 1 fore-edge) and `v`
    /// (0 foot, 1 head), rising and within 0..1, by cubic splines through the
    /// nodes, instead of the nodes themselves.
    ///
    /// # Panics
    /// As [`Interpolation::spline`], so with fewer than 4 rows.
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) {
        let (columns, rows) = (self.mesh.columns, self.mesh.rows);
        self.interpolation = Some(Interpolation::spline(columns, rows, u, v));
    }

    /// Angle of a crease by its place in [`ShellSettings::creases`], radians as
    /// [`Crease::rest`], the mean over its length; None where there is none.
    pub fn crease_angle(&self, crease: usize) -> Option<f64> {
        let Forces {
            bending, clamps, ..
        } = &self.forces;
        bending.crease_angle(crease, &self.x, clamps)
    }

    /// Angle at which a crease bears no moment now, as [`Shell::crease_angle`]: in steps it yields
    /// and creeps, where its [`Crease`] says so, and never in equilibria that are
    /// [settled](Shell::settle) to.
    pub fn crease_rest(&self, crease: usize) -> Option<f64> {
        self.forces.bending.crease_rest(crease)
    }

    /// Largest change of length of a grid edge along u or v, relative to it.
    pub fn max_edge_strain(&self) -> f64 {
        self.forces.membrane.max_edge_strain(&self.x)
    }

    /// Steps so far whose equations were not solved to the tolerance.
    pub fn unsolved_steps(&self) -> u64 {
        self.unsolved
    }
}

impl TurnModel for Shell {
    fn time_step(&self) -> f32 {
        self.settings.time_step as f32
    }

    fn time(&self) -> f32 {
        (self.steps as f64 * self.settings.time_step) as f32
    }

    fn step(&mut self) {
        self.advance();
        self.steps += 1;
    }

    fn write_surface(&mut self, surface: &mut Surface) {
        let nodes: Vec<f32> = self.positions().iter().map(|x| *x as f32).collect();
        match &mut self.interpolation {
            Some(interpolation) => {
                let (columns, rows) = interpolation.samples();
                surface.resize(columns, rows);
                interpolation.apply_interleaved(&nodes, &mut surface.positions);
            }
            None => {
                surface.resize(self.mesh.columns, self.mesh.rows);
                surface.positions.copy_from_slice(&nodes);
            }
        }
        surface.touch();
    }

    fn grid_size(&self) -> (usize, usize) {
        (self.mesh.columns, self.mesh.rows)
    }

    fn read_nodes(&self, positions: &mut [f32], velocities: &mut [f32]) {
        let copies = [
            (positions, self.positions()),
            (velocities, self.velocities()),
        ];
        for (to, from) in copies {
            assert_eq!(to.len(), from.len(), "3 floats a node");
            for (to, from) in to.iter_mut().zip(from) {
                *to = *from as f32;
            }
        }
    }
}

fn bending(settings: &ShellSettings, mesh: &Mesh, clamps: &Clamps) -> Box<dyn Bending> {
    let rigidity = &settings.rigidity;
    match settings.discretisation {
        Discretisation::Grid => Box::new(GridBending::new(mesh, rigidity, clamps)),
        Discretisation::Triangles => Box::new(TriangleBending::new(
            mesh,
            rigidity,
            clamps,
            &settings.creases,
        )),
    }
}

/// Places of the nodes at the foot, `du` apart, where nothing bends but creases.
fn folded_row(settings: &ShellSettings, du: f64) -> Vec<Vector> {
    let start = match settings.spine {
        Edge::Free => 0.0,
        Edge::Clamped { angle } | Edge::Hinged { angle, .. } => angle,
    };
    let (mut angle, mut corner, mut since) = (start, [0.0; 3], 0);
    let mut row = Vec::with_capacity(settings.columns);
    for column in 0..settings.columns {
        let place = advance(corner, (column - since) as f64 * du, direction(angle));
        row.push(place);
        for crease in settings.creases.iter().filter(|c| c.column == column) {
            (corner, since) = (place, column);
            angle += crease.rest;
        }
    }
    row
}
