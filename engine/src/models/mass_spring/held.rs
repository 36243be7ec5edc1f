//! A node that is held.

/// A node held at a place that moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held {
    /// Column of the node, from 0 at the spine.
    pub column: usize,
    /// Row of the node, from 0 at the foot.
    pub row: usize,
    /// Where it was at the end of the last step.
    pub from: [f32; 3],
    /// Where it is held at the end of the next one.
    pub to: [f32; 3],
    /// Whether the gesture under way moves it.
    pub by_gesture: bool,
}
