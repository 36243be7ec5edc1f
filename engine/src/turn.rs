//! The one interface that every way of turning a page has.

use crate::hash::BitHash;
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

/// Hash of the exact bits of `steps` steps of a model: positions and velocities
/// of its nodes and positions of its surface, after each.
pub fn turn_hash(model: &mut dyn TurnModel, steps: usize) -> u64 {
    let (columns, rows) = model.grid_size();
    let mut positions = vec![0.0; 3 * columns * rows];
    let mut velocities = positions.clone();
    let mut surface = Surface::new(2, 2);
    let mut hash = BitHash::new();
    for _ in 0..steps {
        model.step();
        model.read_nodes(&mut positions, &mut velocities);
        model.write_surface(&mut surface);
        hash.floats(&positions);
        hash.floats(&velocities);
        hash.floats(&surface.positions);
    }
    hash.value()
}
