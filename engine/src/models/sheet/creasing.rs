//! How a sheet is creased, and what can be asked of its creases.

use super::Sheet;
use super::crease::SheetCrease;
use super::creased::Creased;
use super::facets;
use super::hinges::Hinges;
use super::laid_folded::{triangles, turns};
use super::material::Material;
use super::membrane::Membrane;
use super::patches::Patches;
use super::settings::{CAN_CREASE, InvalidSheet};
use super::sweep::{Sweep, TOLERANCE};
use super::system::System;
use super::touching::Touching;
use crate::creased_only::CreasedOnly;
use crate::paper_mesh::PaperMesh;
use core::f64::consts::PI;

impl Sheet {
    /// Creases the sheet along lines, in place of those along which it was creased before:
    /// it stays where it is, its nodes moved along it onto the lines. Edges that reach over a
    /// fold which is none any more would be its chords, and too short: they get their lengths.
    ///
    /// # Errors
    /// Where a line is none, or its nodes are too few for so many or so near lines; the
    /// sheet is then as it was.
    pub fn crease(&mut self, lines: &[SheetCrease]) -> Result<(), InvalidSheet> {
        if !CAN_CREASE || !lines.iter().all(SheetCrease::is_valid) {
            return Err(InvalidSheet::Crease);
        }
        let crowded = || InvalidSheet::Creases(lines.len());
        let material = Material::even(&self.settings).creased(lines);
        let material = material.ok_or_else(crowded)?;
        self.creased = if lines.is_empty() {
            CreasedOnly::NONE
        } else {
            let patches = self
                .patches(self.drawn_at(), &material, lines)
                .ok_or_else(crowded)?;
            CreasedOnly::some(Box::new(Creased {
                lines: lines.to_vec(),
                hinges: Hinges::new(&self.settings, &material, lines),
                patches: Some(patches),
                torn: None,
            }))
        };
        self.take(material);
        self.restore_lengths();
        Ok(())
    }

    /// Moves the nodes until every edge has its length, where one has not.
    pub(crate) fn restore_lengths(&mut self) {
        if self.max_edge_strain() > TOLERANCE {
            self.sweep.run(&mut self.positions, &[]);
        }
    }

    /// Goes on with its nodes at other places of the paper, on which they are moved.
    pub(super) fn take(&mut self, material: Material) {
        for values in [&mut self.positions, &mut self.velocities] {
            self.material.carry(&material, values);
        }
        self.lie_on(material);
    }

    /// Computes what depends on where its nodes lie on the paper, for others to which they have
    /// been moved.
    pub(super) fn lie_on(&mut self, material: Material) {
        let (columns, rows, first) = (
            self.settings.columns,
            self.settings.rows,
            self.settings.first(),
        );
        let reach = if self.is_creased() { 2 } else { 0 };
        self.system = System::new(columns, rows, first, reach);
        self.constant = System::new(columns, rows, first, reach).matrix;
        if let Some(creased) = self.creased.as_mut() {
            creased.hinges.find_places(&self.system);
        }
        self.membrane = Membrane::new(&self.settings, &material);
        self.sweep = Sweep::new(&self.settings, &material);
        for (node, pin) in self.pins.iter().enumerate() {
            if pin.is_some() {
                self.sweep.hold(node);
            }
        }
        for grab in &mut self.grabs {
            grab.take_anew(&self.settings, &material, &self.positions);
        }
        self.material = material;
        self.weigh();
        self.prepare();
    }

    /// Whether the sheet is creased.
    pub fn is_creased(&self) -> bool {
        self.creased().is_some()
    }

    /// The creases of the sheet, each with the angle at which it rests now.
    pub fn creases(&self) -> Vec<SheetCrease> {
        let Some(Creased { lines, hinges, .. }) = self.creased() else {
            return Vec::new();
        };
        let lines = lines.iter().enumerate();
        let rests = lines.map(|(crease, line)| SheetCrease {
            rest: hinges
                .crease(crease)
                .map_or(line.rest, |[_, rest]| f64::from(rest).clamp(-PI, PI)),
            ..*line
        });
        rests.collect()
    }

    /// Sets which nodes are kept off other parts of the sheet from the next step on.
    pub(crate) fn touch(&mut self, touching: Vec<Touching>) {
        self.sweep.touching = touching;
    }

    /// Says whether creases turned further than they yield keep the difference, as they do
    /// at first; if not they spring back.
    pub(crate) fn let_yield(&mut self, may_yield: bool) {
        if let Some(Creased { hinges, .. }) = self.creased_mut() {
            hinges.may_yield = may_yield;
        }
    }

    /// Whether a place (u and v) lies beyond a crease as seen from the middle of the spine.
    pub(crate) fn is_beyond_crease(&self, [u, v]: [f32; 2]) -> bool {
        let Some(creased) = self.creased() else {
            return false;
        };
        let [width, height] = self.material.size;
        let place = [f64::from(u) * width, f64::from(v) * height];
        let turns = turns(&self.material, &creased.lines);
        turns.iter().any(|turn| turn.reach(place) > 0.0)
    }

    /// What the sheet has once it is creased.
    pub(super) fn creased(&self) -> Option<&Creased> {
        self.creased.as_ref().map(Box::as_ref)
    }

    /// The same, to be changed.
    pub(super) fn creased_mut(&mut self) -> Option<&mut Creased> {
        self.creased.as_mut().map(Box::as_mut)
    }

    /// What draws the sheet at values of u and v once it is creased so. None where these are too
    /// few, or do not reach from edge to edge.
    fn patches(
        &self,
        samples: [&[f32]; 2],
        material: &Material,
        lines: &[SheetCrease],
    ) -> Option<Patches> {
        let reaches = |along: &&[f32]| along.first() == Some(&0.0) && along.last() == Some(&1.0);
        if !samples.iter().all(reaches) {
            return None;
        }
        let size = [self.settings.width, self.settings.height];
        let [columns, rows] = [0, 1].map(|axis| {
            let place = |sample: &f32| f64::from(*sample) * size[axis];
            samples[axis].iter().map(place).collect()
        });
        Patches::new(material, columns, rows, lines)
    }

    /// The values of u and v at which it is drawn.
    fn drawn_at(&self) -> [&[f32]; 2] {
        self.samples.each_ref().map(Vec::as_slice)
    }

    /// Columns at which it is drawn.
    pub(crate) fn drawn_columns(&self) -> usize {
        self.samples[0].len()
    }

    /// Whether its creases, if it has any, can be drawn at other values of u and v.
    pub(crate) fn can_draw(&self, u: &[f32], v: &[f32]) -> bool {
        let patches = |creased: &Creased| {
            self.patches([u, v], &self.material, &creased.lines)
                .is_some()
        };
        self.creased().is_none_or(patches)
    }

    /// Draws a creased sheet at other values of u and v.
    pub(super) fn redraw_creases(&mut self) {
        let Some(creased) = self.creased().filter(|creased| creased.patches.is_some()) else {
            return;
        };
        let patches = self.patches(self.drawn_at(), &self.material, &creased.lines);
        if let (Some(creased), Some(patches)) = (self.creased_mut(), patches) {
            creased.patches = Some(patches);
        }
    }

    /// How its drawn points lie on the flat paper. None of a sheet that is not creased, crumpled or
    /// torn across, whose points lie at the values that it is drawn at.
    pub fn paper_mesh(&self) -> Option<PaperMesh> {
        let creased = self.creased()?;
        let Some(Patches { drawn, .. }) = &creased.patches else {
            let (columns, rows) = self.interpolation.samples();
            return Some(facets::mesh(columns, rows));
        };
        let size = [self.settings.width, self.settings.height];
        let on_page = |at: &[f64; 2]| match &creased.torn {
            Some(torn) => torn.frame.on_page(*at),
            None => [0, 1].map(|axis| at[axis] / size[axis]),
        };
        let (triangles, parts) = triangles(drawn, &creased.lines)
            .into_iter()
            .map(|(corners, part)| (corners.map(|corner| corner as u32), part))
            .unzip();
        let points = drawn.places.len();
        Some(PaperMesh {
            places: drawn
                .places
                .iter()
                .map(on_page)
                .map(|at| at.map(|at| at as f32))
                .collect(),
            triangles,
            parts,
            tears: creased.torn.as_ref().map_or_else(Vec::new, |torn| {
                (0..points)
                    .map(|point| torn.tear_at(drawn, point))
                    .collect()
            }),
        })
    }

    /// The triangles of a creased sheet's nodes, as of its [points](Self::paper_mesh), and the part of the sheet that each belongs to.
    pub(crate) fn node_triangles(&self) -> Vec<([usize; 3], u16)> {
        let lines = self.creased().map(|creased| &creased.lines);
        lines.map_or_else(Vec::new, |lines| triangles(&self.material, lines))
    }

    /// Angle of a crease now and its rest, radians as [`SheetCrease::rest`]: means over its
    /// length. None where there is no such crease.
    pub fn crease_angle(&self, crease: usize) -> Option<[f32; 2]> {
        self.creased()?.hinges.crease(crease)
    }

    /// Gives a crease another rest angle, radians as [`SheetCrease::rest`]. Nothing happens
    /// where there is no such crease.
    pub fn press(&mut self, crease: usize, rest: f32) {
        if let Some(Creased { hinges, .. }) = self.creased_mut() {
            hinges.set_rest(crease, rest);
        }
    }
}
