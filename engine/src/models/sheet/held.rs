//! What holds a sheet: pins, [grabs](super::grabs) and [tethers](Tether).

use super::grabs::Grab;
use super::{Sheet, Tether};

impl Sheet {
    /// Holds a node at a place, metres, or lets it go (None).
    ///
    /// # Panics
    /// If there is no such node.
    pub fn pin(&mut self, column: usize, row: usize, place: Option<[f32; 3]>) {
        let node = row * self.settings.columns + column;
        self.pins[node] = place;
        self.sweep.release(&self.settings, &self.material, node);
        if place.is_some() {
            self.sweep.hold(node);
        }
    }

    /// A grab takes hold at (`u`, `v`), each 0 to 1 or the nearer of these; one of the same number
    /// lets go of what it held.
    pub fn grab(&mut self, grab: u32, u: f32, v: f32) {
        self.release(grab);
        if u.is_finite() && v.is_finite() {
            let at = self.in_frame([u, v]);
            let (settings, material) = (&self.settings, &self.material);
            let grab = Grab::new(grab, at, settings, material, &self.positions);
            self.grabs.push(grab);
        }
    }

    /// Lets a grab that has just taken hold move at its full speed at once: one whose way is smooth
    /// jerks at nothing.
    pub(crate) fn hasten(&mut self, grab: u32) {
        if let Some(grab) = self.grabs.iter_mut().find(|own| own.id == grab) {
            grab.hasten();
        }
    }

    /// As [`grab`](Self::grab), with so much stiffness, N/m, and at most such a force, N: what
    /// is tied by [tethers](Tether) may be torn from them.
    pub(crate) fn grab_firmly(
        &mut self,
        grab: u32,
        [u, v]: [f32; 2],
        [stiffness, strength]: [f32; 2],
    ) {
        self.grab(grab, u, v);
        if let Some(at) = self.grabs.iter().position(|known| known.id == grab) {
            let firm = self.grabs.remove(at).pulling(stiffness, strength);
            self.grabs.push(firm);
        }
    }

    /// The springs that tie nodes to places, to be added and removed.
    pub(crate) fn tethers_mut(&mut self) -> &mut Vec<Tether> {
        &mut self.tethers
    }

    /// A grab pulls what it holds to a place, metres. Nothing happens where it
    /// holds nothing or the place is no number.
    pub fn pull(&mut self, grab: u32, to: [f32; 3]) {
        if let Some(grab) = self.grabs.iter_mut().find(|known| known.id == grab) {
            grab.pull(to);
        }
    }

    /// A grab lets go.
    pub fn release(&mut self, grab: u32) {
        self.grabs.retain(|known| known.id != grab);
    }

    /// Where the place that a grab holds is now, metres; None where it holds
    /// nothing.
    pub fn held_place(&self, grab: u32) -> Option<[f32; 3]> {
        let grab = self.grabs.iter().find(|known| known.id == grab)?;
        Some(grab.held_place(&self.positions))
    }
}
