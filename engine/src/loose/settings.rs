//! What a loose leaf is, whichever model moves it.

use crate::grid::Side;
use crate::models::ModelKind;
use crate::models::kinematic::InvalidKinematic;
use crate::models::mass_spring::{InvalidSettings, Preset};
use crate::models::sheet::InvalidSheet;
use crate::models::shell::{Discretisation, InvalidShell};
use crate::stock::{GRAVITY, Stock};
use crate::synchronise::Synchronise;

/// Everything that makes a [`LooseLeaf`](super::LooseLeaf). SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct LooseSettings {
    /// The model that moves it.
    pub kind: ModelKind,
    /// Width and height, metres.
    pub size: [f64; 2],
    /// The paper.
    pub stock: Stock,
    /// Side on which it rests at first.
    pub side: Side,
    /// Acceleration of gravity, m/s^2, downward.
    pub gravity: f64,
    /// Density of the air over the real one's: 0 is a vacuum.
    pub air: f64,
    /// Columns and rows of nodes; none for the model's own number. Of no
    /// consequence for a kinematic leaf.
    pub nodes: Option<[usize; 2]>,
    /// Length of a step, seconds; none for the model's own.
    pub time_step: Option<f64>,
    /// Columns and rows of the drawn points, spread evenly.
    pub samples: [usize; 2],
    /// Of a mass-spring leaf: the paper's own constants, or paper's weight and
    /// stiffness ([`Preset::Book`]).
    pub preset: Preset,
    /// Of a mass-spring leaf and a sheet: which lines are kept parallel.
    pub synchronise: Synchronise,
    /// Of a mass-spring leaf: whether the drawn points are interpolated between
    /// its nodes, or are its nodes.
    pub interpolate: bool,
    /// Of a shell: how its bending follows from its nodes.
    pub discretisation: Discretisation,
}

impl LooseSettings {
    /// A leaf of a stock, `size` metres, on the right in still air, drawn by 26 x
    /// 26 points; a mass-spring leaf with the paper's constants and without its
    /// improvements.
    pub fn leaf(kind: ModelKind, size: [f64; 2], stock: Stock) -> Self {
        Self {
            kind,
            size,
            stock,
            side: Side::Right,
            gravity: GRAVITY,
            air: 1.0,
            nodes: None,
            time_step: None,
            samples: [26, 26],
            preset: Preset::Paper2014,
            synchronise: Synchronise::Off,
            interpolate: false,
            discretisation: Discretisation::Grid,
        }
    }
}

/// Bytes of the matrix of a shell's step, at most.
const LARGEST_MATRIX: usize = 64 << 20;

impl LooseSettings {
    /// Whether they are a leaf's, as far as this does not depend on the model. Each model
    /// has bounds of its own within these.
    ///
    /// # Errors
    /// Where a figure is no number or out of bounds, in a sentence.
    pub(super) fn check(&self) -> Result<(), InvalidLoose> {
        for count in self.samples {
            if !(2..=1024).contains(&count) {
                let sentence = format!("A leaf is drawn by 2 to 1024 points a side, not {count}.");
                return Err(InvalidLoose(sentence));
            }
        }
        let [width, height] = self.size;
        let step = self.time_step.unwrap_or(0.01);
        for (what, value, least, most) in [
            ("width in metres", width, 1e-3, 100.0),
            ("height in metres", height, 1e-3, 100.0),
            ("step in seconds", step, 1e-6, 0.1),
            ("gravity in m/s^2", self.gravity, -1e3, 1e3),
            ("air, in the real one's density,", self.air, 0.0, 1e3),
        ] {
            if !(least..=most).contains(&value) {
                let sentence =
                    format!("A leaf's {what} lies between {least} and {most}, not at {value}.");
                return Err(InvalidLoose(sentence));
            }
        }
        if let Synchronise::DogEar { angle } = self.synchronise
            && !angle.is_finite()
        {
            let sentence = format!("The angle of a dog-ear is a number, not {angle}.");
            return Err(InvalidLoose(sentence));
        }
        if let Err(error) = self.stock.check() {
            return Err(InvalidLoose(error.to_string()));
        }
        if let (ModelKind::Shell, Some([columns, rows])) = (self.kind, self.nodes) {
            // Three rows a node, each as wide as two of the leaf's shorter rows.
            let wide = columns.min(rows).saturating_mul(6).saturating_add(8);
            let high = columns.saturating_mul(rows).saturating_mul(3);
            if wide.saturating_mul(high).saturating_mul(8) > LARGEST_MATRIX {
                let sentence = format!("A shell of {columns} x {rows} nodes is too large.");
                return Err(InvalidLoose(sentence));
            }
        }
        Ok(())
    }
}

/// Why settings make no loose leaf, in one sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidLoose(
    /// The sentence.
    pub String,
);

impl core::fmt::Display for InvalidLoose {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for InvalidLoose {}

macro_rules! from {
    ($($error:ty),*) => {$(
        impl From<$error> for InvalidLoose {
            fn from(error: $error) -> Self {
                Self(error.to_string())
            }
        }
    )*};
}

from!(
    InvalidKinematic,
    InvalidSettings,
    InvalidSheet,
    InvalidShell
);
