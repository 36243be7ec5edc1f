//! What a shell is made of.

use core::f64::consts::PI;

use super::crease::Crease;
use crate::air::Air;
use crate::rigidity::Rigidity;
use crate::stock::{GRAVITY, Grain, Stock};

/// Why settings make no shell, or a shell finds no equilibrium, in one sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidShell(
    /// The sentence.
    pub String,
);

impl core::fmt::Display for InvalidShell {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for InvalidShell {}

/// How an edge of a leaf is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edge {
    /// Not at all.
    Free,
    /// Its nodes only, and the direction of the leaf by a hinge in between.
    Hinged {
        /// Direction in which the hinge is at rest, as that of a clamp.
        angle: f64,
        /// Moment per width and radian of the hinge, N: 0 turns freely.
        stiffness: f64,
    },
    /// Its nodes and the direction of the leaf there: `angle` is that of the
    /// direction of rising u over the x axis, in radians, positive upward.
    Clamped {
        /// Radians.
        angle: f64,
    },
}

/// How bending energy follows from the nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Discretisation {
    /// Second differences over the grid (after Bergou et al. 2006).
    #[default]
    Grid,
    /// The shape operators of triangles by the angles of their hinges, over both
    /// diagonals of each cell (after Grinspun et al. 2006).
    Triangles,
}

/// How a leaf moves on in time. All three solve their equations to the end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scheme {
    /// First order; damps fast motion.
    ImplicitEuler,
    /// The second-order backward differentiation formula; damps what is faster
    /// than the step. Its first step is one of implicit Euler.
    #[default]
    Bdf2,
    /// Second order, and keeps the energy of an undamped leaf but for a bounded
    /// swing.
    ImplicitMidpoint,
}

/// A table at z = 0 on which a leaf may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table {
    /// Coefficient of friction.
    pub friction: f64,
}

/// Everything that makes a [`super::Shell`], in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellSettings {
    /// Columns of nodes from the spine to the fore-edge, 6 to 513.
    pub columns: usize,
    /// Rows of nodes from the foot to the head, 2 to 513.
    pub rows: usize,
    /// From the spine to the fore-edge, m.
    pub width: f64,
    /// From the foot to the head, m.
    pub height: f64,
    /// Bending stiffness.
    pub rigidity: Rigidity,
    /// Mass of a square metre, kg/m^2.
    pub areal_mass: f64,
    /// Stiffness against stretch, N/m: Young's modulus times caliper. Shear is
    /// 0.4 of it. Paper has about 2e5; anything that keeps strain below some
    /// 1e-4 gives the same shapes.
    pub membrane: f64,
    /// Acceleration of gravity, m/s^2.
    pub gravity: [f64; 3],
    /// The air around it.
    pub air: Air,
    /// The edge at u = 0, on the y axis.
    pub spine: Edge,
    /// The edge at u = 1.
    pub fore_edge: Edge,
    /// Whether there is a table.
    pub table: Option<Table>,
    /// Its creases, each in a column of its own. They need [`Discretisation::Triangles`].
    pub creases: Vec<Crease>,
    /// Length of a step, s.
    pub time_step: f64,
    /// How it moves on in time.
    pub scheme: Scheme,
    /// How bending follows from the nodes.
    pub discretisation: Discretisation,
    /// Loss tangent of bending at the first frequency of the clamped leaf; the
    /// damping is proportional to stiffness. 0 is undamped.
    pub loss: f64,
    /// A step is solved when no node moves further than this in a Newton step, m.
    pub tolerance: f64,
}

impl ShellSettings {
    /// A leaf of a stock, `width` x `height` metres, clamped level at the spine
    /// in still air, of 33 x 45 nodes and steps of 1/240 s.
    pub fn leaf(stock: &Stock, grain: Grain, width: f64, height: f64) -> Self {
        Self {
            columns: 33,
            rows: 45,
            width,
            height,
            rigidity: Rigidity::of(stock, grain),
            areal_mass: stock.grammage,
            membrane: 1e5,
            gravity: [0.0, 0.0, -GRAVITY],
            air: Air::still(width),
            spine: Edge::Clamped { angle: 0.0 },
            fore_edge: Edge::Free,
            table: None,
            creases: Vec::new(),
            time_step: 1.0 / 240.0,
            scheme: Scheme::Bdf2,
            discretisation: Discretisation::Grid,
            loss: stock.loss,
            tolerance: 1e-8,
        }
    }

    /// A strip 1 m long and a hundredth of a metre wide, of `columns` x 2 nodes, of unit
    /// mass per area and the given heaviness Gamma = weight x length^3 / D in a
    /// vacuum: Poisson's ratio 0, clamped level, undamped, hanging in gravity.
    pub fn strip(columns: usize, gamma: f64) -> Self {
        let d = GRAVITY / gamma;
        Self {
            columns,
            rows: 2,
            width: 1.0,
            height: 0.01,
            rigidity: Rigidity::isotropic(d, 0.0),
            areal_mass: 1.0,
            membrane: 1e6 * GRAVITY.max(d),
            gravity: [0.0, 0.0, -GRAVITY],
            air: Air::NONE,
            spine: Edge::Clamped { angle: 0.0 },
            fore_edge: Edge::Free,
            table: None,
            creases: Vec::new(),
            time_step: 1e-3,
            scheme: Scheme::Bdf2,
            discretisation: Discretisation::Grid,
            loss: 0.0,
            tolerance: 1e-9,
        }
    }

    /// Seconds of stiffness-proportional damping that give the loss tangent at
    /// the first frequency of a clamped strip, 3.516 sqrt(D / m) / width^2.
    pub(super) fn damping_time(&self) -> f64 {
        self.loss / self.rigidity.first_frequency(self.areal_mass, self.width)
    }

    /// Whether the settings make a leaf.
    ///
    /// # Errors
    /// Where a setting is no number or out of bounds, or creases are not where the mesh can have
    /// them, in a sentence.
    pub(super) fn check(&self) -> Result<(), InvalidShell> {
        let counts = [("columns", self.columns, 6), ("rows", self.rows, 2)];
        for (what, count, least) in counts {
            if !(least..=513).contains(&count) {
                return Err(InvalidShell(format!(
                    "A shell has {least} to 513 {what} of nodes, not {count}."
                )));
            }
        }
        let above_zero = [
            ("width", self.width),
            ("height", self.height),
            ("bending stiffness across the spine", self.rigidity.d11),
            ("bending stiffness along the spine", self.rigidity.d22),
            ("stiffness against twist", self.rigidity.d66),
            ("mass", self.areal_mass),
            ("membrane stiffness", self.membrane),
            ("time step", self.time_step),
            ("tolerance", self.tolerance),
        ];
        for (what, value) in above_zero {
            if !(value > 0.0 && value.is_finite()) {
                return Err(InvalidShell(format!(
                    "A shell's {what} is above 0 and finite, not {value}."
                )));
            }
        }
        let hinge = |edge: Edge| match edge {
            Edge::Hinged { stiffness, .. } => stiffness,
            Edge::Free | Edge::Clamped { .. } => 0.0,
        };
        let friction = self.table.map_or(0.0, |table| table.friction);
        let not_below_zero = [
            ("hinge at the spine", hinge(self.spine)),
            ("hinge at the fore-edge", hinge(self.fore_edge)),
            ("loss", self.loss),
            ("friction", friction),
            ("coupling of bending", self.rigidity.d12),
            ("density of the air", self.air.density),
            ("drag coefficient", self.air.drag),
            ("added mass", self.air.added_mass),
        ];
        for (what, value) in not_below_zero {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(InvalidShell(format!(
                    "A shell's {what} is 0 or above and finite, not {value}."
                )));
            }
        }
        self.check_creases()?;
        if self.rigidity.d12 * self.rigidity.d12 >= 0.8 * self.rigidity.d11 * self.rigidity.d22 {
            return Err(InvalidShell(
                "A shell's D12 squared is below 0.8 D11 D22.".to_owned(),
            ));
        }
        Ok(())
    }

    fn check_creases(&self) -> Result<(), InvalidShell> {
        let inside = 1..self.columns - 1;
        for (k, crease) in self.creases.iter().enumerate() {
            let sentence = if self.discretisation == Discretisation::Grid {
                "A shell has creases where it is of triangles.".to_owned()
            } else if !inside.contains(&crease.column) {
                format!(
                    "A crease is in a column from 1 to {}, not {}.",
                    inside.end - 1,
                    crease.column
                )
            } else if self.creases[..k].iter().any(|c| c.column == crease.column) {
                format!("Column {} has one crease, not two.", crease.column)
            } else if crease.rest.is_nan() || crease.rest.abs() > PI {
                format!(
                    "A crease rests at -pi to pi radians, not at {}.",
                    crease.rest
                )
            } else if crease.stiffness.is_nan() || crease.stiffness <= 0.0 {
                format!("A crease's stiffness is above 0, not {}.", crease.stiffness)
            } else if crease.yields.is_nan() || crease.yields <= 0.0 {
                format!("A crease yields beyond more than 0, not {}.", crease.yields)
            } else if !(crease.creep == 0.0 || (crease.creep > 0.0 && crease.yields.is_finite())) {
                format!(
                    "A crease creeps by 0 or more, and from its yield, not by {}.",
                    crease.creep
                )
            } else {
                continue;
            };
            return Err(InvalidShell(sentence));
        }
        Ok(())
    }
}
