//! One leaf over a table, by any of the models.

use super::settings::{InvalidLoose, LooseSettings};
use super::springs::Springs;
use super::table_sheet::TableSheet;
use crate::air::Air;
use crate::gesture::{Gesture, Grip};
use crate::grid::Side;
use crate::interpolate::uniform_samples;
use crate::models::ModelKind;
use crate::models::kinematic::{Kinematic, KinematicSettings};
use crate::models::sheet::Sheet;
use crate::models::shell::{Edge, Shell, ShellSettings, Table};
use crate::stock::Grain;
use crate::turn::TurnModel;

/// A leaf of some model. It turns freely about the spine.
#[derive(Debug)]
pub(super) enum Body {
    Kinematic(Box<Kinematic>),
    Springs(Box<Springs>),
    Sheet(Box<TableSheet>),
    Shell(Box<Shell>),
}

impl Body {
    /// A leaf of the settings' model, flat and still on its side. Fails if the model rejects the
    /// settings.
    pub fn new(settings: &LooseSettings) -> Result<Self, InvalidLoose> {
        let [width, height] = settings.size;
        let mut air = Air::still(width);
        (air.density, air.added_mass) = (air.density * settings.air, air.added_mass * settings.air);
        let [u, v] = settings
            .samples
            .map(|count| uniform_samples(count.clamp(2, 1024)));
        let shape = match settings.kind {
            ModelKind::Kinematic(shape) => shape,
            ModelKind::MassSpring => return Ok(Self::Springs(Box::new(Springs::new(settings)?))),
            ModelKind::Sheet => {
                let sheet = TableSheet::new(settings, air, [&u, &v])?;
                return Ok(Self::Sheet(Box::new(sheet)));
            }
            ModelKind::Shell => {
                let mut own = ShellSettings {
                    gravity: [0.0, 0.0, -settings.gravity],
                    air,
                    spine: Edge::Hinged {
                        angle: 0.0,
                        stiffness: 0.0,
                    },
                    table: Some(Table {
                        friction: settings.stock.friction,
                    }),
                    discretisation: settings.discretisation,
                    ..ShellSettings::leaf(&settings.stock, Grain::AlongSpine, width, height)
                };
                if let Some([columns, rows]) = settings.nodes {
                    (own.columns, own.rows) = (columns, rows);
                }
                own.time_step = settings.time_step.unwrap_or(own.time_step);
                let rows = own.rows;
                let mut shell = Shell::new(own)?;
                if rows < 4 {
                    let sentence = format!("A drawn shell has at least 4 rows, not {rows}.");
                    return Err(InvalidLoose(sentence));
                }
                shell.draw_samples(&u, &v);
                return Ok(Self::Shell(Box::new(shell)));
            }
        };
        let base = KinematicSettings::leaf(shape, width, height, settings.stock);
        let own = KinematicSettings {
            side: settings.side,
            air,
            gravity: settings.gravity,
            time_step: settings.time_step.unwrap_or(base.time_step),
            columns: settings.samples[0],
            rows: settings.samples[1],
            ..base
        };
        Ok(Self::Kinematic(Box::new(Kinematic::new(own)?)))
    }

    /// The leaf as any model.
    pub fn model(&self) -> &dyn TurnModel {
        match self {
            Self::Kinematic(leaf) => &**leaf,
            Self::Springs(leaf) => &**leaf,
            Self::Sheet(leaf) => &leaf.sheet,
            Self::Shell(leaf) => &**leaf,
        }
    }

    /// The leaf as any model, to be changed.
    pub fn model_mut(&mut self) -> &mut dyn TurnModel {
        match self {
            Self::Kinematic(leaf) => &mut **leaf,
            Self::Springs(leaf) => &mut **leaf,
            Self::Sheet(leaf) => &mut leaf.sheet,
            Self::Shell(leaf) => &mut **leaf,
        }
    }

    /// Advances by a step.
    pub fn step(&mut self) {
        match self {
            Self::Sheet(leaf) => leaf.step(),
            _ => self.model_mut().step(),
        }
    }

    /// The sheet, if it is one.
    pub fn sheet(&self) -> Option<&TableSheet> {
        match self {
            Self::Sheet(leaf) => Some(leaf),
            _ => None,
        }
    }

    /// The sheet, if it is one and creased.
    pub fn creased_sheet(&self) -> Option<&Sheet> {
        let sheet = self.sheet().map(|leaf| &leaf.sheet);
        sheet.filter(|sheet| sheet.is_creased())
    }

    /// The sheet, if it is one, to be changed.
    pub fn sheet_mut(&mut self) -> Option<&mut TableSheet> {
        match self {
            Self::Sheet(leaf) => Some(leaf),
            _ => None,
        }
    }

    /// Draws at every pair of `u` and `v`; a mass-spring leaf that draws its nodes
    /// goes on to.
    ///
    /// # Errors
    /// Where a creased sheet cannot be drawn so.
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) -> Result<(), InvalidLoose> {
        match self {
            Self::Kinematic(leaf) => leaf.draw_samples(u, v),
            Self::Springs(leaf) => leaf.draw_samples(u, v),
            Self::Sheet(leaf) => return leaf.draw_samples(u, v),
            Self::Shell(leaf) => leaf.draw_samples(u, v),
        }
        Ok(())
    }

    /// Lays it flat, but for its creases, and still on a side, nothing holding it.
    pub fn lay_flat(&mut self, side: Side) {
        match self {
            Self::Kinematic(leaf) => leaf.lay_flat(side),
            Self::Springs(leaf) => leaf.lay_flat(side),
            Self::Sheet(leaf) => leaf.lay(side),
            Self::Shell(leaf) => {
                leaf.release();
                let sign = f64::from(side.sign());
                let flat: Vec<f64> = flat(leaf.settings())
                    .flat_map(|[x, y]| [sign * x, y, 0.0])
                    .collect();
                leaf.write_nodes(&flat, &vec![0.0; flat.len()]);
            }
        }
    }

    /// Begins a timed turn. Returns whether the model carries it out by itself.
    pub fn play(&mut self, gesture: Gesture) -> bool {
        match self {
            Self::Kinematic(leaf) => leaf.play(gesture),
            Self::Springs(leaf) => leaf.play(gesture),
            Self::Sheet(leaf) => {
                let v = grip_v(gesture.grip);
                let u = leaf.grip_u(v);
                leaf.sheet.grab(0, u, v);
                return false;
            }
            Self::Shell(_) => {
                self.grab(1.0, grip_v(gesture.grip));
                return false;
            }
        }
        true
    }

    /// A hand takes hold at (`u`, `v`), each 0 to 1.
    pub fn grab(&mut self, u: f32, v: f32) {
        match self {
            Self::Kinematic(leaf) => leaf.grab(u, v),
            Self::Springs(leaf) => leaf.grab(u, v),
            Self::Sheet(leaf) => leaf.sheet.grab(0, u, v),
            Self::Shell(leaf) => leaf.grab(f64::from(u), f64::from(v)),
        }
    }

    /// The hand pulls to a place, metres.
    pub fn pull(&mut self, to: [f32; 3]) {
        match self {
            Self::Kinematic(leaf) => leaf.pull(to),
            Self::Springs(leaf) => leaf.pull(to),
            Self::Sheet(leaf) => leaf.sheet.pull(0, to),
            Self::Shell(leaf) => leaf.pull(to.map(f64::from)),
        }
    }

    /// The hand lets go.
    pub fn release(&mut self) {
        match self {
            Self::Kinematic(leaf) => leaf.release(),
            Self::Springs(leaf) => leaf.release(),
            Self::Sheet(leaf) => leaf.sheet.release(0),
            Self::Shell(leaf) => leaf.release(),
        }
    }
}

/// Where along the fore-edge a grip holds: its middle, or its foot.
pub(super) fn grip_v(grip: Grip) -> f32 {
    match grip {
        Grip::ForeEdge => 0.5,
        Grip::FootCorner => 0.0,
    }
}

/// Places of the nodes on the flat leaf, metres.
fn flat(settings: &ShellSettings) -> impl Iterator<Item = [f64; 2]> + use<> {
    let (columns, rows) = (settings.columns, settings.rows);
    let cell = [
        settings.width / (columns - 1) as f64,
        settings.height / (rows - 1) as f64,
    ];
    (0..rows).flat_map(move |row| {
        (0..columns).map(move |column| [column as f64 * cell[0], row as f64 * cell[1]])
    })
}
