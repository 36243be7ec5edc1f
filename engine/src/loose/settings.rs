//! What a loose leaf is, whichever model moves it.

use crate::grid::Side;
use crate::key_frames::ModelKind;
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
