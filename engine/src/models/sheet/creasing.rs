//! How a sheet is creased, and what can be asked of its creases.

use super::Sheet;
use super::crease::FoldLine;
use super::creased::Creased;
use super::hinges::Hinges;
use super::material::Material;
use super::membrane::Membrane;
use super::patches::Patches;
use super::settings::{CAN_CREASE, InvalidSheet};
use super::sweep::Sweep;
use super::system::System;

impl Sheet {
    /// Creases the sheet along lines, in place of those along which it was creased before:
    /// it stays where it is, its nodes moved along it onto the lines.
    ///
    /// # Errors
    /// Where a line is none, or its nodes are too few for so many or so near lines; the
    /// sheet is then as it was.
    pub fn crease(&mut self, lines: &[FoldLine]) -> Result<(), InvalidSheet> {
        if !CAN_CREASE || !lines.iter().all(FoldLine::is_valid) {
            return Err(InvalidSheet::Crease);
        }
        let crowded = || InvalidSheet::Creases(lines.len());
        let material = Material::even(&self.settings).creased(lines);
        let material = material.ok_or_else(crowded)?;
        self.creased = if lines.is_empty() {
            None
        } else {
            let patches = self.patches(&material, lines).ok_or_else(crowded)?;
            Some(Box::new(Creased {
                lines: lines.to_vec(),
                hinges: Hinges::new(&self.settings, &material, lines),
                patches,
            }))
        };
        let (columns, rows, first) = (
            self.settings.columns,
            self.settings.rows,
            self.settings.first(),
        );
        for values in [&mut self.positions, &mut self.velocities] {
            self.material.carry(&material, values);
        }
        let reach = if lines.is_empty() { 0 } else { 2 };
        self.system = System::new(columns, rows, first, reach);
        self.constant = System::new(columns, rows, first, reach).matrix;
        self.membrane = Membrane::new(&self.settings, &material);
        self.sweep = Sweep::new(&self.settings, &material);
        for (node, pin) in self.pins.iter().enumerate() {
            if pin.is_some() {
                self.sweep.mobility[node] = 0.0;
            }
        }
        for grab in &mut self.grabs {
            grab.take_anew(&self.settings, &material, &self.positions);
        }
        self.material = material;
        self.weigh();
        self.prepare();
        Ok(())
    }

    /// What the sheet has once it is creased. Engines that crease none are built without
    /// what follows from it.
    pub(super) fn creased(&self) -> Option<&Creased> {
        if CAN_CREASE {
            self.creased.as_deref()
        } else {
            None
        }
    }

    fn creased_mut(&mut self) -> Option<&mut Creased> {
        if CAN_CREASE {
            self.creased.as_deref_mut()
        } else {
            None
        }
    }

    /// What draws the sheet once it is creased so.
    fn patches(&self, material: &Material, lines: &[FoldLine]) -> Option<Patches> {
        let size = [self.settings.width, self.settings.height];
        let [columns, rows] = [0, 1].map(|axis| {
            let place = |sample: &f32| f64::from(*sample) * size[axis];
            self.samples[axis].iter().map(place).collect()
        });
        Patches::new(material, columns, rows, lines)
    }

    /// Draws a creased sheet at other values of u and v.
    pub(super) fn redraw_creases(&mut self) {
        let lines = self.creased().map(|creased| creased.lines.clone());
        let patches = lines.and_then(|lines| self.patches(&self.material, &lines));
        if let (Some(creased), Some(patches)) = (self.creased_mut(), patches) {
            creased.patches = patches;
        }
    }

    /// Where the drawn points of a creased sheet lie on the flat paper, u and v of each,
    /// 0 to 1: some are moved onto creases. None of a sheet without creases, whose points
    /// lie at the values that it is drawn at.
    pub fn drawn_places(&self) -> Option<Vec<[f32; 2]>> {
        let places = &self.creased()?.patches.drawn.places;
        let size = [self.settings.width, self.settings.height];
        let part = |place: &[f64; 2]| [0, 1].map(|axis| (place[axis] / size[axis]) as f32);
        Some(places.iter().map(part).collect())
    }

    /// The cells of the drawn surface that are folded along their rising diagonal, from foot
    /// and spine to head and fore-edge, as numbers of the points at their foot by the spine;
    /// others are to be cut along the falling one where they are folded at all.
    pub fn rising_folds(&self) -> Vec<usize> {
        let Some(Creased { patches, .. }) = self.creased() else {
            return Vec::new();
        };
        let rises = |foot: &usize| {
            let edge = patches.drawn.folded_diagonal(*foot);
            edge.is_some_and(|edge| edge[0] == *foot)
        };
        patches.drawn.cells().filter(rises).collect()
    }

    /// Angle of a crease now and its rest, radians as [`FoldLine::rest`]: means over its
    /// length. None where there is no such crease.
    pub fn crease_angle(&self, crease: usize) -> Option<[f32; 2]> {
        self.creased()?.hinges.crease(crease)
    }

    /// Gives a crease another rest angle, radians as [`FoldLine::rest`]. Nothing happens
    /// where there is no such crease.
    pub fn press(&mut self, crease: usize, rest: f32) {
        if let Some(Creased { hinges, .. }) = self.creased_mut() {
            hinges.set_rest(crease, rest);
        }
    }
}
