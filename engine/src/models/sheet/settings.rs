//! What a sheet is made of and how it is bound.

use crate::air::Air;
use crate::rigidity::Rigidity;
use crate::stock::{GRAVITY, Grain, InvalidStock, SOFTEST, Stock};
use crate::synchronise::Synchronise;

/// How a sheet is held at u = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Root {
    /// It leaves a straight spine at the clamp's angle.
    Clamped,
    /// As clamped, through a hinge of a stiffness in newtons (moment per width
    /// and radian): 0 turns freely, a tight binding has about 0.01.
    Hinged(f64),
    /// Not held at all.
    Free,
}

/// A sheet's settings. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetSettings {
    /// Nodes across the spine, 4 to 64.
    pub columns: usize,
    /// Nodes along the spine, 4 to 64.
    pub rows: usize,
    /// Width across the spine, metres.
    pub width: f64,
    /// Height along the spine, metres.
    pub height: f64,
    /// The paper.
    pub stock: Stock,
    /// Which way it is bound.
    pub grain: Grain,
    /// Acceleration of gravity, m/s^2.
    pub gravity: [f64; 3],
    /// The air around it.
    pub air: Air,
    /// Strength of grabs on it over what they have for its area and weight.
    pub grab_strength: f64,
    /// How it is held at the spine.
    pub root: Root,
    /// Length of a step, seconds.
    pub time_step: f64,
    /// Stiffness against stretch, N/m. Real paper's, about 1.8e5, makes the
    /// solver jitter in single precision; what this leaves of stretch the length
    /// sweeps remove.
    pub stretch: f64,
    /// Stiffness against shear, N/m.
    pub shear: f64,
    /// Which lines are kept parallel (the paper's synchronisation), as a
    /// projection after each step.
    pub synchronise: Synchronise,
}

/// Whether sheets can be synchronised.
pub(super) const CAN_SYNCHRONISE: bool = cfg!(feature = "synchronise");

/// Whether sheets can be creased.
pub(super) const CAN_CREASE: bool = cfg!(feature = "creases");

/// Whether sheets can be tied by springs that may be torn off: in the same builds as creases.
pub(super) const CAN_TEAR: bool = CAN_CREASE;

/// Of a leaf that is as near to the shell as it can be: seconds of a step, and the shell's
/// stiffness in its plane, N/m.
const FINE_STEP: f64 = 1.0 / 360.0;
const FINE_STRETCH: f64 = 1e5;

/// Stiffness against shear over that against stretch, as the shell's.
const SHEAR: f64 = 0.4;

/// Stiffness against stretch, in units of a node's mass over the step's square, beyond which
/// rounding shakes a leaf of 12 columns: found by turns at many stiffnesses. With more
/// columns it is less, by the square.
const STIFFEST: f64 = 6e4;

/// Stiffness against bending, in units of a node's areal mass times the fourth power of a
/// cell over the square of a step, that single precision bears: without a bound rounding
/// throws the stiffest leaves about, with one of 1e2 to 1e8 none. At this a level leaf 0.14 m
/// wide sags by less than a thousandth.
const RIGID: f64 = 1e4;

impl SheetSettings {
    /// The interactive sheet: a leaf of 12 x 16 nodes in still air over which
    /// gravity acts, clamped at the spine, three steps a frame at 60 Hz.
    pub fn leaf(width: f64, height: f64, stock: Stock) -> SheetSettings {
        SheetSettings {
            columns: 12,
            rows: 16,
            width,
            height,
            stock,
            grain: Grain::AlongSpine,
            gravity: [0.0, 0.0, -GRAVITY],
            air: Air::still(width),
            grab_strength: 1.0,
            root: Root::Clamped,
            time_step: 1.0 / 180.0,
            stretch: 8000.0,
            shear: 3200.0,
            synchronise: Synchronise::Off,
        }
    }

    /// The same leaf as near to the [`Shell`](crate::Shell) as single precision bears: six
    /// steps a frame where no step is given, and as stiff in its plane as the shell, or as
    /// nodes and step allow. How a leaf that is bent two ways snaps depends on that.
    pub(crate) fn fine(mut self, time_step: Option<f64>) -> SheetSettings {
        self.time_step = time_step.unwrap_or(FINE_STEP);
        let columns = (self.columns as f64 / 12.0).max(1.0);
        self.stiffened(STIFFEST / (columns * columns), FINE_STRETCH)
    }

    /// The same leaf, its stiffness in its plane so many times a node's mass over the
    /// square of the step, but at most `most` N/m.
    pub(crate) fn stiffened(mut self, times: f64, most: f64) -> SheetSettings {
        let cell = self.cell()[0] * self.cell()[1];
        let node = self.stock.grammage * cell / (self.time_step * self.time_step);
        self.stretch = (times * node).min(most);
        self.shear = SHEAR * self.stretch;
        self
    }

    /// The same leaf, no stiffer than single precision bears at steps of `seconds`: one
    /// that is stiffer does not bend to be seen, and is as stiff as that. Damping in
    /// proportion to stiffness counts as stiffness over the time for which it lasts.
    pub(crate) fn bearable(mut self, seconds: f64) -> SheetSettings {
        let lasting = seconds * self.damping_time().max(seconds);
        let [across, along] = self.cell().map(|cell| {
            let square = cell * cell;
            (RIGID * self.stock.grammage * square * square / lasting).max(SOFTEST)
        });
        let stock = &mut self.stock;
        let (turning, standing) = match self.grain {
            Grain::AlongSpine => (&mut stock.stiffness_across, &mut stock.stiffness_along),
            Grain::AcrossSpine => (&mut stock.stiffness_along, &mut stock.stiffness_across),
        };
        *turning = turning.min(across);
        *standing = standing.min(along);
        self
    }

    /// The same paper over another grid, as stiff in its plane for the mass of a node.
    pub(crate) fn over(mut self, columns: usize, rows: usize, cell: [f64; 2]) -> SheetSettings {
        let before = self.cell();
        (self.columns, self.rows) = (columns, rows);
        self.width = cell[0] * (columns - 1) as f64;
        self.height = cell[1] * (rows - 1) as f64;
        let more = (cell[0] * cell[1]) / (before[0] * before[1]);
        self.stretch *= more;
        self.shear *= more;
        self
    }

    /// Seconds of damping in proportion to stiffness that give the stock's loss at
    /// the first frequency of the leaf clamped at the spine.
    pub(super) fn damping_time(&self) -> f64 {
        let rigidity = Rigidity::of(&self.stock, self.grain);
        self.stock.loss / rigidity.first_frequency(self.stock.grammage, self.width)
    }

    /// Distance between columns and between rows, metres.
    pub(crate) fn cell(&self) -> [f64; 2] {
        [
            self.width / (self.columns - 1) as f64,
            self.height / (self.rows - 1) as f64,
        ]
    }

    /// The first column that moves.
    pub(super) fn first(&self) -> usize {
        usize::from(self.root != Root::Free)
    }

    /// Area of a node's part of the sheet, m^2.
    pub(crate) fn area(&self, column: usize, row: usize) -> f64 {
        let half = |i: usize, count: usize| if i == 0 || i + 1 == count { 0.5 } else { 1.0 };
        let cell = self.cell();
        half(column, self.columns) * half(row, self.rows) * cell[0] * cell[1]
    }

    /// Whether the settings make a sheet.
    ///
    /// # Errors
    /// Where a setting is no number, out of bounds, or beyond this build.
    pub(super) fn check(&self) -> Result<(), InvalidSheet> {
        self.stock.check().map_err(InvalidSheet::Stock)?;
        for (what, count) in [("columns", self.columns), ("rows", self.rows)] {
            if !(4..=64).contains(&count) {
                return Err(InvalidSheet::Nodes { what, count });
            }
        }
        // A sheet's spine holds its nodes for good, which the literal reading moves.
        match self.synchronise {
            Synchronise::Off => {}
            Synchronise::Literal => return Err(InvalidSheet::Literal),
            _ if !CAN_SYNCHRONISE => return Err(InvalidSheet::Synchronise),
            _ => {}
        }
        let hinge = match self.root {
            Root::Hinged(stiffness) => stiffness,
            Root::Clamped | Root::Free => 0.0,
        };
        let figures = [
            ("width in metres", self.width, 1e-4, 100.0),
            ("height in metres", self.height, 1e-4, 100.0),
            ("strength of grabs", self.grab_strength, 0.0, 1e6),
            ("step in seconds", self.time_step, 1e-7, 0.1),
            ("stiffness against stretch", self.stretch, 1e-3, 1e7),
            ("stiffness against shear", self.shear, 1e-3, 1e7),
            ("stiffness of the hinge", hinge, 0.0, 1e6),
            ("density of the air", self.air.density, 0.0, 1e4),
            ("drag coefficient", self.air.drag, 0.0, 100.0),
            ("added mass", self.air.added_mass, 0.0, 1e4),
        ];
        let forces = self.gravity.iter().chain(&self.air.wind);
        let fields = forces.map(|&value| ("gravity or wind", value, -1e4, 1e4));
        for (what, value, least, greatest) in figures.into_iter().chain(fields) {
            if !(least..=greatest).contains(&value) {
                return Err(InvalidSheet::Figure {
                    what,
                    value,
                    least,
                    greatest,
                });
            }
        }
        Ok(())
    }
}

/// Settings that make no sheet. Its sentence says what is wrong and what it may be.
#[derive(Clone, Debug, PartialEq)]
pub enum InvalidSheet {
    /// The paper is none.
    Stock(InvalidStock),
    /// Too few or too many nodes.
    Nodes {
        /// Columns or rows.
        what: &'static str,
        /// How many.
        count: usize,
    },
    /// A figure is out of bounds.
    Figure {
        /// Which figure.
        what: &'static str,
        /// What it is.
        value: f64,
        /// The least that it may be.
        least: f64,
        /// The greatest that it may be.
        greatest: f64,
    },
    /// Synchronisation, which this engine was built without.
    Synchronise,
    /// A crease that is none, or creases where this engine was built without.
    Crease,
    /// More creases than its nodes can carry, or too near each other.
    Creases(usize),
    /// The literal reading of synchronisation, which moves the spine.
    Literal,
}

impl core::fmt::Display for InvalidSheet {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            InvalidSheet::Stock(error) => error.fmt(f),
            InvalidSheet::Nodes { what, count } => {
                write!(f, "A sheet has 4 to 64 {what} of nodes, not {count}.")
            }
            InvalidSheet::Figure {
                what,
                value,
                least,
                greatest,
            } => write!(
                f,
                "A sheet's {what} lies between {least} and {greatest}, not at {value}."
            ),
            InvalidSheet::Literal => f.write_str(
                "A sheet is synchronised without its spine; the literal reading is for masses and springs.",
            ),
            InvalidSheet::Crease => f.write_str(
                "A crease goes through two places on the sheet, rests within half a turn and has a stiffness and a yield angle above 0; engines crease sheets that are built with the feature `creases`.",
            ),
            InvalidSheet::Creases(count) => write!(
                f,
                "A sheet of so few nodes cannot be creased along these {count} lines, which lie too near each other or its edges."
            ),
            InvalidSheet::Synchronise => f.write_str(
                "Sheets are synchronised where the engine is built with its feature `synchronise`.",
            ),
        }
    }
}

impl core::error::Error for InvalidSheet {}
