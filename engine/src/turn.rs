//! The one interface that every way of turning a page has.

use crate::surface::Surface;

/// A way of turning a page: advance by fixed steps, and write down the drawn
/// surface whenever it is wanted.
pub trait TurnModel {
    /// Length of one step in seconds; the same for the whole life of a model.
    fn time_step(&self) -> f32;

    /// Time since the start, in seconds.
    fn time(&self) -> f32;

    /// Advances by one time step.
    fn step(&mut self);

    /// Writes the present positions into `surface`, resized if need be, and
    /// raises its version. Normals are left to [`Surface::update_normals`], as
    /// not everyone needs them.
    fn write_surface(&mut self, surface: &mut Surface);

    /// Columns and rows of the model's grid of nodes.
    fn grid_size(&self) -> (usize, usize);

    /// Copies the nodes' positions and velocities (metres, metres a second) into
    /// `positions` and `velocities`: x, y, z of each node, row by row from the
    /// foot, each row from the spine to the fore-edge. With these a replay can
    /// be caught by a hand and go on live.
    ///
    /// # Panics
    /// If a slice is not `3 * columns * rows` long.
    fn read_nodes(&self, positions: &mut [f32], velocities: &mut [f32]);
}
