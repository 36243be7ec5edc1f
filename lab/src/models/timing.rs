//! When a turn is looked at.

/// Seconds of a turn, of what is watched after it, and of a frame.
pub const TURN: f64 = 1.2;
pub const AFTER: f64 = 0.6;
pub const FRAME: f64 = 1.0 / 60.0;
