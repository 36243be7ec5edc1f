//! When a turn is looked at.

/// Seconds of a turn.
pub const TURN: f64 = 1.2;
/// Seconds that are watched after it.
pub const AFTER: f64 = 0.6;
/// Seconds of a frame.
pub const FRAME: f64 = 1.0 / 60.0;
