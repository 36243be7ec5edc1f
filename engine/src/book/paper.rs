//! What a book's leaves are made of, and how finely each is simulated.

use super::limits::{NODES, TICK, slowness};
use crate::air::Air;
use crate::grab::strongest;
use crate::models::sheet::{Root, SheetSettings};
use crate::rigidity::Rigidity;
use crate::stock::{Grain, SOFTEST, STIFFEST as STIFFEST_STOCK, Stock};

/// Leaves that fly at once in short steps, at most, so that they move as the shell does;
/// where there are more each has one step in a tick, and ten fit into a frame.
pub(super) const FEW: usize = 3;

/// Steps in a tick of one of a few leaves, and of one of stiff paper that is alone.
const STEPS: u32 = 2;
const STEPS_STIFF: u32 = 3;

/// Angle, radians, by which the first mode of a leaf of stiff paper goes on in a tick: its
/// corner snaps within a few steps.
const STIFF: f64 = 0.12;

/// Sweeps of a step after which the shear of one of a few leaves, and of one of many, yields
/// to lengths: with twice as many three of card, and ten, cost half as much again and more.
const SHEAR_SWEEPS_OF_FEW: usize = 20;
const SHEAR_SWEEPS_OF_MANY: usize = 6;

/// Stiffness in its plane of one of a few leaves, in units of a node's mass over the
/// square of a step, and the greatest, N/m: a stiffer card snaps farther from where the
/// shell does.
const STIFFNESS: f64 = 2e4;
const STIFFEST: f64 = 4.4e4;

/// Stiffness in its plane of one of many leaves, N/m: with their longer steps stiffer
/// ones crossed in a riffle of twelve, and were drawn as much as 0.13 m behind.
const STIFFNESS_OF_MANY: f64 = 2000.0;

/// Stiffness of the binding against turning, N: weak against the paper of a
/// cell, so that the leaf leaves the gutter without a crease and turns freely.
const BINDING: f64 = 0.02;

/// What the leaves of a book are made of, how they are bound, and what moves
/// them beside grabs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    /// The stock of every leaf.
    pub stock: Stock,
    /// Which way it is bound.
    pub grain: Grain,
    /// Stiffness of the binding against a leaf that leaves the gutter in another
    /// direction than its neighbours in the same leaf, N (moment per width and
    /// radian), 0 to 1.
    pub binding: f64,
    /// Velocity of the air, m/s, each component within 20.
    pub wind: [f64; 3],
    /// Whether a leaf let go is helped over to its side. Without it, it goes
    /// where its own motion and gravity take it.
    pub assist: bool,
    /// Lengths of the book that is shown over those of book space, 0.02 to 50: leaves move as in a
    /// book so many times as large. Thickness and the speed of grabs are those of book space.
    pub scale: f64,
}

impl Default for Paper {
    fn default() -> Paper {
        Paper {
            stock: Stock::BOOK,
            grain: Grain::AlongSpine,
            binding: BINDING,
            wind: [0.0; 3],
            assist: true,
            scale: 1.0,
        }
    }
}

impl Paper {
    /// The settings of a leaf of it in a book, `width` x `height` metres, while `flying`
    /// leaves are in the air.
    pub fn sheet(&self, size: [f64; 2], flying: usize) -> SheetSettings {
        self.sheet_of(NODES, size, flying)
    }

    /// As [`sheet`](Self::sheet), of so many columns and rows of nodes.
    pub(super) fn sheet_of(
        &self,
        [columns, rows]: [usize; 2],
        [width, height]: [f64; 2],
        flying: usize,
    ) -> SheetSettings {
        let steps = self.steps(width, flying);
        // Against a narrow leaf, which weighs less, the binding is as weak as against the usual one.
        let narrowness = f64::from(self.slowness(width)).powi(4).min(1.0);
        let sheet = SheetSettings::leaf(width, height, self.model_stock());
        // As much of the air as the large leaf meets for its weight, and grabs as strong for it.
        let air = Air::still(width);
        let [area, square] = [width * height, self.scale * self.scale];
        let strength = |area: f64| strongest(self.stock.grammage, area);
        let grab_strength = strength(area * square) / (square * self.scale * strength(area));
        let (shear_sweeps, stiffest) = match flying {
            _ if flying > FEW => (SHEAR_SWEEPS_OF_MANY, STIFFNESS_OF_MANY),
            2.. => (SHEAR_SWEEPS_OF_FEW, STIFFEST),
            _ => (sheet.shear_sweeps, STIFFEST),
        };
        let settings = SheetSettings {
            columns,
            rows,
            time_step: f64::from(TICK) / f64::from(steps),
            shear_sweeps,
            grain: self.grain,
            gravity: sheet.gravity.map(|g| g / self.scale),
            grab_strength,
            root: Root::Hinged(self.binding * narrowness / (square * self.scale)),
            air: Air {
                wind: self.wind.map(|w| w / self.scale),
                density: air.density * self.scale,
                added_mass: air.added_mass * self.scale,
                ..air
            },
            ..sheet
        };
        settings
            .bearable(f64::from(TICK))
            .stiffened(STIFFNESS, stiffest)
    }

    /// The stock of which a leaf in book space, on which everything acts so many times as little as
    /// it is smaller, bends as the large one does.
    fn model_stock(&self) -> Stock {
        let square = self.scale * self.scale;
        let bent = |stiffness: f64| (stiffness / (square * square)).clamp(SOFTEST, STIFFEST_STOCK);
        Stock {
            stiffness_along: bent(self.stock.stiffness_along),
            stiffness_across: bent(self.stock.stiffness_across),
            ..self.stock
        }
    }

    /// Times of falls and of turns on a leaf `width` metres wide in book space over those on one of
    /// the usual width.
    pub(super) fn slowness(&self, width: f64) -> f32 {
        slowness(width * self.scale)
    }

    /// Steps in a tick of a leaf of it, `width` metres wide, while so many are in the air.
    pub(super) fn steps(&self, width: f64, flying: usize) -> u32 {
        let rate = Rigidity::of(&self.stock, self.grain)
            .first_frequency(self.stock.grammage, width * self.scale);
        match flying {
            _ if flying > FEW => 1,
            2.. => STEPS,
            _ if rate * f64::from(TICK) > STIFF => STEPS_STIFF,
            _ => STEPS,
        }
    }

    /// Whether leaves can be made of it.
    pub(super) fn is_sound(&self) -> bool {
        self.stock.check().is_ok()
            && (0.0..=1.0).contains(&self.binding)
            && (0.02..=50.0).contains(&self.scale)
            && self.wind.iter().all(|w| (-20.0..=20.0).contains(w))
    }
}
