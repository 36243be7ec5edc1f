//! Recording a turn.

use super::{FrameKind, KeyFrames};
use crate::models::ModelKind;
use crate::models::mass_spring::MassSpring;
use crate::surface::Surface;
use crate::turn::TurnModel;

/// Takes a frame at every whole multiple of an interval.
#[derive(Clone, Debug)]
pub struct Recorder {
    frames: KeyFrames,
    interval: f32,
    surface: Surface,
    velocities: Vec<f32>,
    start: f32,
}

impl Recorder {
    /// Starts a record with the leaf as it is now, one frame every `interval`
    /// seconds.
    ///
    /// # Panics
    /// If the interval is not above 0.
    pub fn new(leaf: &mut MassSpring, kind: FrameKind, interval: f32) -> Self {
        assert!(interval > 0.0, "the interval is above 0");
        let mut surface = Surface::new(2, 2);
        leaf.write_surface(&mut surface);
        let (columns, rows) = match kind {
            FrameKind::Masses => leaf.grid_size(),
            FrameKind::Surface => (surface.columns, surface.rows),
        };
        let settings = leaf.settings();
        let frames = KeyFrames {
            kind,
            model: ModelKind::MassSpring,
            preset: settings.preset,
            size: [settings.width, settings.height],
            columns,
            rows,
            times: Vec::new(),
            positions: Vec::new(),
        };
        let (columns, rows) = leaf.grid_size();
        let velocities = vec![0.0; 3 * columns * rows];
        let start = leaf.time();
        let mut recorder = Self {
            frames,
            interval,
            surface,
            velocities,
            start,
        };
        recorder.take(leaf, 0.0);
        recorder
    }

    /// Looks at the leaf after a step, and takes a frame if one is due. Returns
    /// whether it did.
    pub fn observe(&mut self, leaf: &mut MassSpring) -> bool {
        self.observe_at(leaf, leaf.time() - self.start)
    }

    /// As [`Recorder::observe`], for a leaf that something else than its own
    /// steps has moved: `time` is in seconds since the start of the record.
    pub fn observe_at(&mut self, leaf: &mut MassSpring, time: f32) -> bool {
        let due = self.frames.len() as f32 * self.interval;
        // Steps rarely fall on the multiple exactly: half a step early is due.
        let take = time >= due - 0.5 * leaf.time_step();
        if take {
            self.take(leaf, time);
        }
        take
    }

    /// Ends the record with a frame of the leaf as it is now.
    pub fn finish(self, leaf: &mut MassSpring) -> KeyFrames {
        let time = leaf.time() - self.start;
        self.finish_at(leaf, time)
    }

    /// As [`Recorder::finish`], `time` seconds after the start of the record.
    pub fn finish_at(mut self, leaf: &mut MassSpring, time: f32) -> KeyFrames {
        if self.frames.times.last().is_none_or(|&last| last < time) {
            self.take(leaf, time);
        }
        self.frames
    }

    fn take(&mut self, leaf: &mut MassSpring, time: f32) {
        let length = self.frames.frame_length();
        let at = self.frames.positions.len();
        match self.frames.kind {
            FrameKind::Masses => {
                self.frames.positions.resize(at + length, 0.0);
                leaf.read_nodes(&mut self.frames.positions[at..], &mut self.velocities);
            }
            FrameKind::Surface => {
                leaf.write_surface(&mut self.surface);
                assert_eq!(
                    self.surface.positions.len(),
                    length,
                    "the mesh changed while recording"
                );
                self.frames
                    .positions
                    .extend_from_slice(&self.surface.positions);
            }
        }
        self.frames.times.push(time);
    }
}
