//! Paper that crumples: it keeps a sharp bend wherever it gets one.
//!
//! Crumpled paper is flat facets between ridges and cones, where its curvature has passed the
//! yield (Witten 2007, "Stress focusing in elastic sheets"). On a grid these can run along
//! edges and diagonals of cells: each of them is a plastic hinge as a crease is, and a cell
//! may fold along either diagonal.

use super::Sheet;
use super::creased::Creased;
use super::facets;
use super::hinges::Hinges;
use super::material::Material;
use super::sweep::Apart;
use crate::creased_only::CreasedOnly;
use crate::interpolate::uniform_samples;

impl Sheet {
    /// Lets the sheet crumple from now on, in place of the creases that it had: it stays where
    /// it is, bends at every edge and diagonal of its cells, keeps what bends beyond its yield, and
    /// is drawn as facets, at its nodes and half-way between them.
    pub fn crumple(&mut self) {
        let (columns, rows) = (self.settings.columns, self.settings.rows);
        self.creased = CreasedOnly::NONE;
        let samples = [columns, rows].map(|nodes| uniform_samples(facets::points(nodes)));
        self.draw_samples(&samples[0], &samples[1]);
        let material = Material::crumpled(&self.settings);
        self.creased = CreasedOnly::some(Box::new(Creased {
            lines: Vec::new(),
            hinges: Hinges::new(&self.settings, &material, &[]),
            patches: None,
            torn: None,
        }));
        self.take(material);
    }

    /// Positions, x, y, z of each node in metres, with the pairs of nodes to be kept apart in the
    /// next step according to them.
    pub(crate) fn apart_state(&mut self) -> (&[f32], &mut Apart) {
        (&self.positions, &mut self.sweep.apart)
    }

    /// Returns the work done in bending creases beyond their yield since it was last asked
    /// for, J.
    pub(crate) fn take_yielded(&mut self) -> f32 {
        let creased = self.creased_mut();
        creased.map_or(0.0, |creased| core::mem::take(&mut creased.hinges.yielded))
    }
}
