//! What a book's leaves are made of, and how finely each is simulated.

use super::limits::{NODES, TICK, slowness};
use crate::air::Air;
use crate::grab::strongest;
use crate::models::sheet::{Root, SheetSettings};
use crate::rigidity::Rigidity;
use crate::stock::{Grain, SOFTEST, STIFFEST as STIFFEST_STOCK, Stock};

/// Steps in a tick of a leaf, and of one of stiff paper. They are the same however many leaves are in
/// the air: with one, which is what ten cost in a frame that three with two do, leaves were two to four
/// times as far from the shell, and a board was too stiff for single precision and was not moved at all.
const STEPS: u32 = 2;
const STEPS_STIFF: u32 = 3;

/// Angle, radians, by which the first mode of a leaf of stiff paper goes on in a tick: its
/// corner snaps within a few steps.
const STIFF: f64 = 0.12;

/// Stiffness of a leaf in its plane, in units of a node's mass over the square of a step, and the
/// greatest, N/m: a stiffer card snaps farther from where the shell does.
const STIFFNESS: f64 = 2e4;
const STIFFEST: f64 = 4.4e4;

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
    /// The settings of a leaf of it in a book, `width` x `height` metres.
    pub fn sheet(&self, size: [f64; 2]) -> SheetSettings {
        self.sheet_of(NODES, size)
    }

    /// As [`sheet`](Self::sheet), of so many columns and rows of nodes.
    pub(super) fn sheet_of(
        &self,
        [columns, rows]: [usize; 2],
        [width, height]: [f64; 2],
    ) -> SheetSettings {
        let steps = self.steps(width);
        // Against a narrow leaf, which weighs less, the binding is as weak as against the usual one.
        let narrowness = f64::from(self.slowness(width)).powi(4).min(1.0);
        let sheet = SheetSettings::leaf(width, height, self.model_stock());
        // As much of the air as the large leaf meets for its weight, and grabs as strong for it.
        let air = Air::still(width);
        let [area, square] = [width * height, self.scale * self.scale];
        let strength = |area: f64| strongest(self.stock.grammage, area);
        let grab_strength = strength(area * square) / (square * self.scale * strength(area));
        let settings = SheetSettings {
            columns,
            rows,
            time_step: f64::from(TICK) / f64::from(steps),
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
            .stiffened(STIFFNESS, STIFFEST)
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

    /// Steps in a tick of a leaf of it, `width` metres wide.
    pub(super) fn steps(&self, width: f64) -> u32 {
        let rate = Rigidity::of(&self.stock, self.grain)
            .first_frequency(self.stock.grammage, width * self.scale);
        if rate * f64::from(TICK) > STIFF {
            STEPS_STIFF
        } else {
            STEPS
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
