//! The mass-spring leaf at the size of a page.
//!
//! The paper's leaf is 25 units wide and takes about 11 s to turn. Here a unit is
//! a 25th of the page's width, and its time runs ten times as fast, so that a
//! turn of 1.2 s is one of 12 s there. Its constants stay its own.

use super::settings::LooseSettings;
use crate::gesture::Gesture;
use crate::interpolate::uniform_samples;
use crate::models::mass_spring::{InvalidSettings, MassSpring, Masses, Preset, Settings};
use crate::stock::GRAVITY;
use crate::surface::Surface;
use crate::turn::TurnModel;

/// Seconds of the paper's leaf in one of the page's.
const PACE: f32 = 10.0;

/// A mass-spring leaf, its unit of length and its pace.
#[derive(Clone, Debug)]
pub(super) struct Springs {
    leaf: MassSpring,
    interpolate: bool,
    /// Metres of a unit.
    unit: f32,
    /// Its seconds in a second.
    pace: f32,
    /// Nodes that a hand holds, each with its distance along the spine from the
    /// place that the hand holds, in units.
    held: Vec<(usize, usize, f32)>,
}

impl Springs {
    /// A leaf of masses and springs, flat and still on its side. Fails if the settings make none.
    pub fn new(settings: &LooseSettings) -> Result<Self, InvalidSettings> {
        let [width, height] = settings.size.map(|size| size as f32);
        let of_paper = settings.preset != Preset::Book;
        let mut own = if of_paper {
            let mut own = Settings::paper_2014();
            own.height = own.width * height / width;
            own
        } else {
            Settings::book(width, height, settings.stock.grammage as f32)
        };
        let unit = if of_paper { width / own.width } else { 1.0 };
        let pace = if of_paper { PACE } else { 1.0 };
        own.side = settings.side;
        own.synchronise = settings.synchronise;
        if let Some([columns, rows]) = settings.nodes {
            (own.columns, own.rows) = (columns, rows);
        }
        if let Some(step) = settings.time_step {
            own.time_step = pace * step as f32;
        }
        let air = settings.air as f32;
        (own.drag, own.air_drag) = (own.drag * air, own.air_drag * air);
        match &mut own.masses {
            Masses::Equal { gravity, .. } => *gravity *= (settings.gravity / GRAVITY) as f32,
            Masses::ByArea {
                gravity,
                air: carried,
                ..
            } => (*gravity, *carried) = (settings.gravity as f32, *carried * air),
        }
        let mut springs = Self {
            leaf: MassSpring::new(own)?,
            interpolate: settings.interpolate,
            unit,
            pace,
            held: Vec::new(),
        };
        springs.leaf.draw_nodes();
        let [u, v] = settings.samples.map(uniform_samples);
        springs.draw_samples(&u, &v);
        Ok(springs)
    }

    /// Draws at every pair of `u` and `v`, each 0 to 1, unless the leaf draws its nodes.
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) {
        if self.interpolate {
            self.leaf.draw_samples(u, v);
        }
    }

    /// Lays it flat and still on a side, nothing holding it.
    pub fn lay_flat(&mut self, side: crate::grid::Side) {
        self.leaf.lay_flat(side);
        self.held.clear();
    }

    /// Starts a gesture of metres and seconds: the paper's control column, or its
    /// corner.
    pub fn play(&mut self, gesture: Gesture) {
        self.leaf.play(Gesture {
            seconds: gesture.seconds * self.pace,
            radius: gesture.radius / self.unit,
            rise: gesture.rise / self.unit,
            ..gesture
        });
    }

    /// Takes hold of the nodes next to (u, v): one, or two along the spine.
    pub fn grab(&mut self, u: f32, v: f32) {
        self.release();
        let (columns, rows) = self.leaf.grid_size();
        let column = libm::roundf(u.clamp(0.0, 1.0) * (columns - 1) as f32) as usize;
        let row = v.clamp(0.0, 1.0) * (rows - 1) as f32;
        let near = libm::roundf(row);
        let first = if (row - near).abs() < 0.25 {
            near
        } else {
            libm::floorf(row)
        };
        let last = if (row - near).abs() < 0.25 {
            near
        } else {
            libm::ceilf(row)
        };
        let apart = self.leaf.settings().height / (rows - 1) as f32;
        for at in first as usize..=last as usize {
            self.held
                .push((column.max(1), at, (at as f32 - row) * apart));
        }
    }

    /// The hand pulls to a place, metres, as far as paper reaches.
    pub fn pull(&mut self, to: [f32; 3]) {
        for &(column, row, along) in &self.held {
            let [x, y, z] = to.map(|x| x.clamp(-1e3, 1e3) / self.unit);
            let place = self.leaf.within_reach(column, row, [x, y + along, z]);
            self.leaf.hold(column, row, place);
        }
    }

    /// The hand lets go.
    pub fn release(&mut self) {
        self.held.clear();
        self.leaf.release_all();
    }
}

impl TurnModel for Springs {
    fn time_step(&self) -> f32 {
        self.leaf.time_step() / self.pace
    }

    fn time(&self) -> f32 {
        self.leaf.time() / self.pace
    }

    fn step(&mut self) {
        self.leaf.step();
    }

    fn write_surface(&mut self, surface: &mut Surface) {
        self.leaf.write_surface(surface);
        for x in &mut surface.positions {
            *x *= self.unit;
        }
    }

    fn grid_size(&self) -> (usize, usize) {
        self.leaf.grid_size()
    }

    fn read_nodes(&self, positions: &mut [f32], velocities: &mut [f32]) {
        self.leaf.read_nodes(positions, velocities);
        for x in positions {
            *x *= self.unit;
        }
        for v in velocities {
            *v *= self.unit * self.pace;
        }
    }
}
