//! What bounds a book: numbers of leaves, grabs and nodes, and lengths of time.

/// Length of a tick, by which leaves and boards are stepped, seconds: half a
/// frame at 60 Hz.
pub const TICK: f32 = 1.0 / 120.0;

/// Width of the leaf for which times of falls and of turns are given, metres.
const USUAL_WIDTH: f64 = 0.14;

/// Times of falls and of turns on a leaf `width` metres wide over those on one of the usual width.
/// What weight moves is slower by the root of its size.
pub fn slowness(width: f64) -> f32 {
    (width / USUAL_WIDTH).sqrt() as f32
}

/// Longest turn of a leaf or a board, seconds.
pub const LONGEST_TURN: f32 = 600.0;

/// Nodes of a leaf across and along the spine. A page of them hangs within
/// 0.2 % of the exact shape at Gamma 10, and ten leaves fit into a frame.
pub const NODES: [usize; 2] = [10, 14];

/// Grabs that a leaf tells apart, numbered from 0.
pub const MAX_GRABS: usize = 4;

/// Leaves in flight at once, at most: what bounds a book's memory.
pub const MOST_FLIGHTS: usize = 16;

/// Farther than this from the spine, metres, no grab pulls and nothing is drawn.
pub const FARTHEST: f32 = 1e3;

/// Work of a frame's ticks after which it has no more, nanoseconds as counted: some
/// three times what a picture may take. The two and a tick more are meant to stay below 25 ms.
pub const MOST_STEPPING: u32 = 12_000_000;
