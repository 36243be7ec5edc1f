//! The way of the grab that turns a leaf.

/// The way of the grab that turns a leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// Where it is on its way from the right, 0, to the left, 1: the time of a
    /// smooth start and stop.
    pub time: f32,
    /// Its change a second; negative to the right.
    pub rate: f32,
}
