//! What bounds a book: numbers of leaves, hands and nodes, and lengths of time.

/// Length of a tick, by which leaves and boards are stepped, seconds: half a
/// frame at 60 Hz.
pub const TICK: f32 = 1.0 / 120.0;

/// Longest turn of a leaf or a board, seconds.
pub const LONGEST_TURN: f32 = 600.0;

/// Nodes of a leaf across and along the spine. A page of them hangs within
/// 0.2 % of the exact shape at Gamma 10, and ten leaves fit into a frame.
pub const NODES: [usize; 2] = [10, 14];

/// Hands that a leaf tells apart, numbered from 0.
pub const MAX_GRABS: usize = 4;

/// Leaves in flight at once, at most: what bounds a book's memory.
pub const MOST_FLIGHTS: usize = 16;
