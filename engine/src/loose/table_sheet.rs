//! A sheet over a table, which may be creased.
//!
//! What holds for a book's creased leaves holds here: creases are pressed by hand, yield in a
//! hand alone, and the parts between them keep off each other.

use core::f32::consts::PI;

use super::settings::{InvalidLoose, LooseSettings};
use crate::air::Air;
use crate::contact::flaps::Flaps;
use crate::grid::Side;
use crate::models::sheet::{Contact, Root, Sheet, SheetCrease, SheetSettings};
use crate::turn::TurnModel;

/// Creases of a leaf, at most, as in a book.
const MOST_CREASES: usize = 16;

/// Places along a row at which a played turn may take a folded leaf.
const GRIPS: usize = 16;

/// A crease of a loose leaf as it is now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CreaseState {
    /// Its angle, radians as [`SheetCrease::rest`]: the mean over its length.
    pub angle: f32,
    /// The angle at which it bears no moment, likewise.
    pub rest: f32,
    /// Moment a length, N: its stiffness times the angle less the rest.
    pub moment: f32,
}

/// A sheet hinged at the spine over a table.
#[derive(Debug)]
pub(super) struct TableSheet {
    /// The sheet that moves.
    pub sheet: Sheet,
    /// What keeps its parts apart once it is creased.
    pub(super) flaps: Option<Flaps>,
    /// Whether a hand holds it, in which alone creases yield.
    may_yield: bool,
}

impl TableSheet {
    /// A leaf's sheet in such air, drawn at every pair of `u` and `v`.
    ///
    /// # Errors
    /// Where the settings make no sheet, in a sentence.
    pub fn new(
        settings: &LooseSettings,
        air: Air,
        [u, v]: [&[f32]; 2],
    ) -> Result<Self, InvalidLoose> {
        let [width, height] = settings.size;
        let mut own = SheetSettings {
            gravity: [0.0, 0.0, -settings.gravity],
            air,
            root: Root::Hinged(0.0),
            synchronise: settings.synchronise,
            ..SheetSettings::leaf(width, height, settings.stock)
        };
        if let Some([columns, rows]) = settings.nodes {
            (own.columns, own.rows) = (columns, rows);
        }
        let mut sheet = Sheet::new(own.fine(settings.time_step))?;
        sheet.draw_samples(u, v);
        for contacts in sheet.contacts_mut() {
            contacts[0] = Contact {
                normal: [0.0, 0.0, 1.0],
                friction: settings.stock.friction as f32,
                firmness: 1.0,
                ..Contact::default()
            };
        }
        Ok(Self {
            sheet,
            flaps: None,
            may_yield: false,
        })
    }

    /// Creases it along lines in place of those that it has, where it is.
    ///
    /// # Errors
    /// Where a line is none or meets the spine, there are more than 16 or too many for its
    /// nodes, or it is synchronised; it is then as it was.
    pub fn crease(&mut self, lines: &[SheetCrease]) -> Result<(), InvalidLoose> {
        let reject = |sentence: &str| Err(InvalidLoose(sentence.into()));
        let settings = self.sheet.settings();
        let size = [settings.width, settings.height];
        if lines.len() > MOST_CREASES {
            return reject("A leaf has 16 creases at most.");
        }
        if settings.synchronise != crate::Synchronise::Off {
            return reject("A sheet whose lines are kept parallel cannot be creased.");
        }
        if lines
            .iter()
            .any(|line| line.is_valid() && !line.leaves_spine(size))
        {
            return reject("A crease does not meet the spine, where the leaf is bound.");
        }
        self.sheet.crease(lines)?;
        self.flaps = Flaps::of(&self.sheet);
        self.sheet.touch(Vec::new());
        self.sheet.let_yield(self.may_yield);
        Ok(())
    }

    /// Draws it at every pair of `u` and `v`.
    ///
    /// # Errors
    /// Where its creases cannot be drawn by so few points; it is then drawn as before.
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) -> Result<(), InvalidLoose> {
        if !self.sheet.can_draw(u, v) {
            let sentence = "A creased leaf is drawn from edge to edge, by more points.";
            return Err(InvalidLoose(sentence.into()));
        }
        self.sheet.draw_samples(u, v);
        Ok(())
    }

    /// Turns the rest of a crease to an angle, radians. Nothing happens where there is no such
    /// crease.
    pub fn press(&mut self, crease: usize, rest: f32) {
        self.sheet.press(crease, rest);
        if let Some(flaps) = &mut self.flaps {
            flaps.press(crease, rest);
        }
    }

    /// A crease as it is now; None where there is none of that number.
    pub fn crease_state(&self, crease: usize) -> Option<CreaseState> {
        let [angle, rest] = self.sheet.crease_angle(crease)?;
        let rest = rest.clamp(-PI, PI);
        let stiffness = self.sheet.creases().get(crease)?.stiffness as f32;
        Some(CreaseState {
            angle,
            rest,
            moment: stiffness * (angle - rest),
        })
    }

    /// Lays it still on a side, flat but for its creases, nothing holding it.
    pub fn lay(&mut self, side: Side) {
        self.sheet.lay_folded(side);
        self.let_yield(false);
    }

    /// Says whether creases yield, as in a hand; those made later too.
    pub fn let_yield(&mut self, may_yield: bool) {
        self.may_yield = may_yield;
        self.sheet.let_yield(may_yield);
    }

    /// The u at which a played turn takes the row at `v`: at the fore-edge, or before what is
    /// folded over there, which a hand that held it would open.
    pub fn grip_u(&self, v: f32) -> f32 {
        let along = (1..=GRIPS).rev().map(|k| k as f32 / GRIPS as f32);
        let mut whole = along.filter(|u| !self.sheet.is_beyond_crease([*u, v]));
        whole.next().unwrap_or(1.0 / GRIPS as f32)
    }

    /// Advances by a step.
    pub fn step(&mut self) {
        if self.flaps.is_some() {
            self.keep_apart();
        }
        self.sheet.step();
        if self.may_yield {
            self.follow_rests();
        }
    }

    /// Notes how creases rest that a hand has opened: what is folded over lies on that side from
    /// then on.
    fn follow_rests(&mut self) {
        let Some(flaps) = &mut self.flaps else { return };
        let mut number = 0;
        while let Some([_, rest]) = self.sheet.crease_angle(number) {
            flaps.press(number, rest);
            number += 1;
        }
    }

    /// Finds what parts of it touch of each other.
    fn keep_apart(&mut self) {
        let Some(flaps) = &self.flaps else { return };
        flaps.touch(&mut self.sheet, 1);
    }
}
