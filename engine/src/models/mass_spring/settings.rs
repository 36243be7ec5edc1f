//! What a mass-spring leaf is made of, and the named presets.

use crate::gesture::{Gesture, Grip};
use crate::grid::Side;
use crate::stock::GRAVITY;
use crate::synchronise::Synchronise;

/// How positions and velocities follow from forces. All three are of fixed step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// x += h v, then v += h a: first order, gains energy.
    ExplicitEuler,
    /// v += h a, then x += h v: first order, keeps energy on average; the paper's.
    SemiImplicitEuler,
    /// The classic Runge-Kutta method: fourth order, four times the forces.
    RungeKutta4,
}

/// What keeps springs from stretching.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StrainLimit {
    /// Nothing but the springs themselves.
    Off,
    /// Provot 1995: a structural or shear spring longer than 1 + `limit` times
    /// its rest length is projected back to that, its free ends moved alike;
    /// `passes` rounds over all springs. Velocities are not touched.
    Provot {
        /// Greatest stretch, as part of the rest length.
        limit: f32,
        /// Rounds over all springs.
        passes: usize,
    },
    /// Exact length projections of whole columns and rows (a tridiagonal solve
    /// each), shear springs held within `limit` either way, the floor, and
    /// again until every spring lies within the limit, at most `passes` times.
    /// Velocities follow from the positions reached.
    Sweeps {
        /// Greatest stretch or compression, as part of the rest length.
        limit: f32,
        /// Most rounds.
        passes: usize,
    },
}

/// The three kinds of springs of Provot 1995. Stiffness in newtons a metre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Springs {
    /// Between neighbours along rows and columns, N/m.
    pub structural: f32,
    /// Along both diagonals of each cell, N/m.
    pub shear: f32,
    /// Between every other node along rows and columns, N/m.
    pub bend: f32,
    /// Damping along each structural, shear and bend spring, newtons per metre
    /// a second; the paper has none.
    pub damping: f32,
}

/// Linear bending stiffness in newton metres, beside the springs: the quadratic
/// plate energy of nearly inextensible sheets,
/// 1/2 integral of (u |x_uu|^2 + v |x_vv|^2 + 4 twist |x_uv|^2).
///
/// Bend springs alone resist only with the fourth power of curvature, so they
/// sag like cloth however stiff; this term is what bows like paper. All zero in
/// the paper's preset.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Plate {
    /// Against bending along u (across the spine), N m.
    pub u: f32,
    /// Against bending along v (along the spine), N m.
    pub v: f32,
    /// Against twist, N m.
    pub twist: f32,
    /// Loss: stiffness-proportional damping in seconds.
    pub loss: f32,
}

/// How the leaf's mass is spread over its nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Masses {
    /// The same for every node, in kilograms, and the paper's gravity: a force
    /// downward on each node in newtons, whatever its mass.
    Equal {
        /// Mass of a node.
        mass: f32,
        /// Force of gravity on a node.
        gravity: f32,
    },
    /// By the area that belongs to each node.
    ByArea {
        /// Own mass in kilograms a square metre.
        grammage: f32,
        /// Mass of the air that is dragged along, kilograms a square metre: it
        /// has inertia and no weight.
        air: f32,
        /// Acceleration of gravity in metres a second squared.
        gravity: f32,
    },
}

/// The settings of a preset that has a name of its own in key-frame files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// Anything that is not one of the named presets.
    Custom,
    /// [`Settings::paper_2014`].
    Paper2014,
    /// [`Settings::book`].
    Book,
}

impl Preset {
    /// Its name as in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Custom => "custom",
            Self::Paper2014 => "paper-2014",
            Self::Book => "book",
        }
    }

    /// Its number in key-frame files.
    pub const fn id(self) -> u32 {
        match self {
            Self::Custom => 0,
            Self::Paper2014 => 1,
            Self::Book => 2,
        }
    }

    /// The preset with a number, if there is one.
    pub const fn from_id(id: u32) -> Option<Self> {
        match id {
            0 => Some(Self::Custom),
            1 => Some(Self::Paper2014),
            2 => Some(Self::Book),
            _ => None,
        }
    }
}

/// Everything that makes a mass-spring leaf. SI units, but for the preset
/// `paper-2014`, which keeps the paper's own numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The preset that these settings are, or are derived from.
    pub preset: Preset,
    /// Columns of nodes, 3 to 16.
    pub columns: usize,
    /// Rows of nodes, 3 to 16.
    pub rows: usize,
    /// Width of the leaf from the spine to the fore-edge, metres.
    pub width: f32,
    /// Height of the leaf from the foot to the head, metres.
    pub height: f32,
    /// Side on which the leaf rests at first.
    pub side: Side,
    /// Its masses and their weight.
    pub masses: Masses,
    /// Its springs.
    pub springs: Springs,
    /// Its linear bending stiffness.
    pub plate: Plate,
    /// Drag of each node, newtons per metre a second, whatever its direction.
    pub drag: f32,
    /// Quadratic drag across the sheet: newtons a square metre, per (metre a
    /// second) squared. Half the air's density times the drag coefficient.
    pub air_drag: f32,
    /// Velocity of the air, m/s, against which both kinds of drag work.
    pub wind: [f32; 3],
    /// Whether the table, z = 0, holds the free nodes up.
    pub floor: bool,
    /// Length of a step in seconds.
    pub time_step: f32,
    /// Parts into which a step is divided, at least 1; more where a stiff plate
    /// would not be stable with as few.
    pub substeps: usize,
    /// How the nodes move.
    pub integrator: Integrator,
    /// How lines parallel to the dog-ear line are kept parallel.
    pub synchronise: Synchronise,
    /// What keeps springs from stretching.
    pub strain_limit: StrainLimit,
}

impl Settings {
    /// The paper's own leaf (Shangguan and Zeng 2014, section 3.1): 6 x 6
    /// masses 5 apart, all springs of stiffness 1, gravity 0.00981 and damping
    /// 0.7125 on each mass, semi-implicit Euler, synchronised by columns. Open
    /// in the paper and chosen here: mass 1, step 1/60, the table.
    pub fn paper_2014() -> Self {
        Self {
            preset: Preset::Paper2014,
            columns: 6,
            rows: 6,
            width: 25.0,
            height: 25.0,
            side: Side::Left,
            masses: Masses::Equal {
                mass: 1.0,
                gravity: 0.00981,
            },
            springs: Springs {
                structural: 1.0,
                shear: 1.0,
                bend: 1.0,
                damping: 0.0,
            },
            plate: Plate::default(),
            drag: 0.7125,
            air_drag: 0.0,
            wind: [0.0; 3],
            floor: true,
            time_step: 1.0 / 60.0,
            substeps: 1,
            integrator: Integrator::SemiImplicitEuler,
            synchronise: Synchronise::Columns,
            strain_limit: StrainLimit::Off,
        }
    }

    /// A page of a book in SI units: the same model with masses by area, real
    /// gravity and air, springs that hold their length within 1 % and a linear
    /// bending stiffness. `width` and `height` in metres, `grammage` in
    /// kilograms a square metre (0.070 for 70 g paper).
    ///
    /// Bending stiffness scales with the cube of the grammage, as caliper does
    /// with the grammage at one density. The air dragged along is that of a
    /// long plate moving broadside on, pi/4 times the density times the width,
    /// spread over the plate.
    pub fn book(width: f32, height: f32, grammage: f32) -> Self {
        let ratio = grammage / 0.070;
        let stiffness = ratio * ratio * ratio;
        let mut settings = Self {
            preset: Preset::Book,
            columns: 6,
            rows: 6,
            width,
            height,
            side: Side::Right,
            masses: Masses::ByArea {
                grammage,
                air: 0.785 * AIR_DENSITY * width,
                gravity: GRAVITY as f32,
            },
            springs: Springs {
                structural: 20.0,
                shear: 8.0,
                bend: 0.5,
                damping: 0.0,
            },
            plate: Plate {
                u: 1.2e-4 * stiffness,
                v: 2.7e-4 * stiffness,
                twist: 0.9e-4 * stiffness,
                loss: 2.0e-3,
            },
            drag: 0.0,
            air_drag: 0.5 * AIR_DENSITY * 1.2,
            wind: [0.0; 3],
            floor: true,
            time_step: 1.0 / 120.0,
            substeps: 4,
            integrator: Integrator::SemiImplicitEuler,
            synchronise: Synchronise::Off,
            strain_limit: StrainLimit::Sweeps {
                limit: 0.008,
                passes: 40,
            },
        };
        // The fastest bending mode is damped to half of critical at most.
        settings.plate.loss = settings.plate.loss.min(0.5 / settings.fastest_bending());
        settings
    }

    /// Upper bound of the angular frequencies of bending, radians a second; 0
    /// without a plate. Second differences along u, along v and across both have
    /// squared norms of at most 16 each.
    fn fastest_bending(&self) -> f32 {
        let du = self.width / (self.columns - 1) as f32;
        let dv = self.height / (self.rows - 1) as f32;
        let area = du * dv;
        let plate = &self.plate;
        let stiffness = plate.u * dv / (du * du * du)
            + plate.v * du / (dv * dv * dv)
            + 4.0 * plate.twist / area;
        let mass = match self.masses {
            Masses::Equal { mass, .. } => mass,
            Masses::ByArea { grammage, air, .. } => (grammage + air) * area,
        };
        (16.0 * stiffness / mass).sqrt()
    }

    /// Substeps that bending needs: the explicit integrators are stable up to 2
    /// radians of the fastest mode a substep, less with its damping.
    pub(super) fn stable_substeps(&self) -> usize {
        libm::ceilf(self.time_step * self.fastest_bending() / 1.0) as usize
    }

    /// The preset's way of turning the whole fore-edge column.
    pub fn column_gesture(&self, seconds: f32) -> Gesture {
        let gesture = Gesture::column(self.side, self.width, seconds);
        match self.preset {
            Preset::Book => Gesture {
                pull: 0.14,
                ..gesture
            },
            _ => gesture,
        }
    }

    /// The preset's way of turning by the foot corner.
    pub fn corner_gesture(&self, seconds: f32) -> Gesture {
        let gesture = Gesture::corner(self.side, self.width, seconds);
        match self.preset {
            Preset::Book => Gesture {
                grip: Grip::FootCorner,
                lag: 0.0,
                pull: 0.14,
                rise: 0.1 * self.height,
                ..gesture
            },
            _ => gesture,
        }
    }
}

/// Density of air in kilograms a cubic metre, at about 20 degrees.
const AIR_DENSITY: f32 = 1.2;

/// Why settings make no leaf, in one sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidSettings(String);

impl core::fmt::Display for InvalidSettings {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for InvalidSettings {}

impl Settings {
    /// Whether the settings make a leaf.
    ///
    /// # Errors
    /// Where they make none, in a sentence.
    pub(crate) fn check(&self) -> Result<(), InvalidSettings> {
        let reject = |sentence: String| Err(InvalidSettings(sentence));
        for (what, count) in [("columns", self.columns), ("rows", self.rows)] {
            if !(3..=16).contains(&count) {
                return reject(format!("A leaf has 3 to 16 {what} of nodes, not {count}."));
            }
        }
        let (first, second) = match self.masses {
            Masses::Equal { mass, gravity } => (mass, gravity),
            Masses::ByArea {
                grammage,
                air,
                gravity,
            } => (grammage, air + gravity),
        };
        for (what, value) in [
            ("width", self.width),
            ("height", self.height),
            ("mass", first),
            ("time step", self.time_step),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return reject(format!(
                    "A leaf's {what} is above 0 and finite, not {value}."
                ));
            }
        }
        let springs = &self.springs;
        let others = [
            ("gravity or air", second),
            ("structural stiffness", springs.structural),
            ("shear stiffness", springs.shear),
            ("bend stiffness", springs.bend),
            ("spring damping", springs.damping),
            (
                "bending stiffness",
                self.plate.u.min(self.plate.v).min(self.plate.twist),
            ),
            ("bending loss", self.plate.loss),
            ("drag", self.drag.min(self.air_drag)),
        ];
        for (what, value) in others {
            if !(value >= 0.0 && value.is_finite()) {
                return reject(format!(
                    "A leaf's {what} is 0 or above and finite, not {value}."
                ));
            }
        }
        for substeps in [self.substeps, self.stable_substeps()] {
            if !(0..=1000).contains(&substeps) || self.substeps == 0 {
                return reject(format!("A step has 1 to 1000 substeps, not {substeps}."));
            }
        }
        Ok(())
    }
}
