//! Key frames, the paper's third improvement (Shangguan and Zeng 2014, section
//! 2.2.3): a turn is recorded every 0.1 s, and repeated from the record.

mod bits;
mod choose;
mod condensed;
mod format;
mod header;
mod mesh;
mod mix;
mod polynomial_basis;
mod record;
mod replay;
#[cfg(test)]
mod tests;

pub use condensed::Condensed;
pub use header::{FORMAT_VERSION, KeyFrameError};
pub use mix::Blend;
pub use record::Recorder;
pub use replay::Replay;

use crate::models::ModelKind;
use crate::models::mass_spring::Preset;
use crate::surface::Surface;

/// Seconds between key frames in the paper.
pub const PAPER_INTERVAL: f32 = 0.1;

/// What a key frame holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameKind {
    /// The model's nodes, as in the paper; a replay has the surface to
    /// interpolate.
    Masses,
    /// The drawn surface: more to keep, nothing to interpolate.
    Surface,
}

/// A recorded turn.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyFrames {
    /// What a frame holds.
    pub kind: FrameKind,
    /// The model that was recorded.
    pub model: ModelKind,
    /// The preset of its settings.
    pub preset: Preset,
    /// Width and height of the leaf, metres, or the preset's own unit of length.
    pub size: [f32; 2],
    /// Points along a row of a frame.
    pub columns: usize,
    /// Rows of a frame.
    pub rows: usize,
    /// When each frame was taken: seconds since the start, rising.
    pub times: Vec<f32>,
    /// Frame after frame, x, y, z of each point in that unit, row by row from the foot.
    pub positions: Vec<f32>,
}

impl KeyFrames {
    /// A record without frames of what a model yields, which `take` fills.
    /// `size` is the leaf's width and height, as [`size`](Self::size).
    pub fn of_surface(model: ModelKind, size: [f32; 2], surface: &Surface) -> Self {
        Self {
            kind: FrameKind::Surface,
            model,
            preset: Preset::Custom,
            size,
            columns: surface.columns,
            rows: surface.rows,
            times: Vec::new(),
            positions: Vec::new(),
        }
    }

    /// Adds a frame of the surface, `time` seconds after the start.
    ///
    /// # Panics
    /// If the surface is of another size than the frames, or the time is not
    /// after the last one's.
    pub fn take(&mut self, time: f32, surface: &Surface) {
        assert!((surface.columns, surface.rows) == (self.columns, self.rows));
        assert!(self.times.last().is_none_or(|last| *last < time));
        self.times.push(time);
        self.positions.extend_from_slice(&surface.positions);
    }

    /// Floats of one frame.
    pub fn frame_length(&self) -> usize {
        3 * self.columns * self.rows
    }

    /// Positions of one frame.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn frame(&self, index: usize) -> &[f32] {
        let length = self.frame_length();
        &self.positions[index * length..(index + 1) * length]
    }

    /// Number of frames.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether nothing was recorded.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }
}
