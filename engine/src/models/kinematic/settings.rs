//! What a kinematic leaf is.

use super::shapes::Shape;
use crate::air::Air;
use crate::grid::Side;
use crate::stock::{GRAVITY, InvalidStock, Stock};

/// Everything that makes a [`Kinematic`](super::Kinematic) leaf, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct KinematicSettings {
    /// The shape on the way.
    pub shape: Shape,
    /// From the spine to the fore-edge, metres.
    pub width: f64,
    /// From the foot to the head, metres.
    pub height: f64,
    /// Side on which it rests at first.
    pub side: Side,
    /// Paper whose weight it falls with; it bends by rule, not by stiffness.
    pub stock: Stock,
    /// The air in which it falls.
    pub air: Air,
    /// Acceleration of gravity, m/s^2, downward.
    pub gravity: f64,
    /// Length of a step, seconds.
    pub time_step: f64,
    /// Points along a drawn row, at least 2.
    pub columns: usize,
    /// Drawn rows, at least 2.
    pub rows: usize,
}

impl KinematicSettings {
    /// A leaf of a shape and stock, `width` x `height` metres, on the right, drawn
    /// by 26 x 26 points, in steps of 1/120 s.
    pub fn leaf(shape: Shape, width: f64, height: f64, stock: Stock) -> Self {
        Self {
            shape,
            width,
            height,
            side: Side::Right,
            stock,
            air: Air::still(width),
            gravity: GRAVITY,
            time_step: 1.0 / 120.0,
            columns: 26,
            rows: 26,
        }
    }

    /// Whether the settings make a leaf. Fails with the first that does not.
    pub(super) fn check(&self) -> Result<(), InvalidKinematic> {
        self.stock.check().map_err(InvalidKinematic::Stock)?;
        for (what, value) in [("columns", self.columns), ("rows", self.rows)] {
            if !(2..=1024).contains(&value) {
                let (value, least, most) = (value as f64, 2.0, 1024.0);
                return Err(InvalidKinematic::Figure {
                    what,
                    value,
                    least,
                    most,
                });
            }
        }
        for (what, value, least, most) in [
            ("width in metres", self.width, 1e-4, 100.0),
            ("height in metres", self.height, 1e-4, 100.0),
            ("step in seconds", self.time_step, 1e-7, 0.1),
            ("gravity", self.gravity, 0.0, 1e4),
            ("density of the air", self.air.density, 0.0, 1e4),
            ("drag coefficient", self.air.drag, 0.0, 100.0),
            ("added mass", self.air.added_mass, 0.0, 1e4),
        ] {
            if !(least..=most).contains(&value) {
                return Err(InvalidKinematic::Figure {
                    what,
                    value,
                    least,
                    most,
                });
            }
        }
        Ok(())
    }
}

/// Settings that make no leaf; displayed as one sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum InvalidKinematic {
    /// The paper is none.
    Stock(InvalidStock),
    /// A figure is out of bounds.
    Figure {
        /// Which figure.
        what: &'static str,
        /// What it is.
        value: f64,
        /// The least that it may be.
        least: f64,
        /// The most that it may be.
        most: f64,
    },
}

impl core::fmt::Display for InvalidKinematic {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Stock(error) => error.fmt(f),
            Self::Figure {
                what,
                value,
                least,
                most,
            } => write!(
                f,
                "A leaf's {what} lies between {least} and {most}, not at {value}."
            ),
        }
    }
}

impl core::error::Error for InvalidKinematic {}
