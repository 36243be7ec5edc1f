//! A turn played from key frames, recorded once (Shangguan and Zeng 2014,
//! section 2.2.3).

use super::{Leaf, Phase, TICK};
use crate::grid::Side;
use crate::key_frames::{Blend, FrameKind, Recorder, Replay};
use crate::turn::TurnModel;

/// Duration of the hand's part of the recorded turn, seconds; the leaf comes to
/// rest a little later.
const GESTURE_SECONDS: f32 = 0.70;

/// Longest recording, ticks: a leaf that has not come to rest by then is laid down.
const LONGEST_RECORDING: u32 = 480;

/// Time between key frames, seconds: half the paper's, as a book's turn is
/// fifteen times as fast as the paper's.
const KEY_INTERVAL: f32 = 0.05;

impl Leaf {
    pub(super) fn step_playing(&mut self, side: Side) {
        let Some(mut course) = self.course else {
            return;
        };
        course.time += TICK * course.rate;
        self.course = Some(course);
        let recording = self
            .recording
            .as_ref()
            .expect("recorded before it is played");
        if course.time <= 0.0 || course.time >= recording.duration() {
            self.lay(side);
            return;
        }
        recording.read_nodes_at(course.time, &mut self.positions, &mut self.velocities);
        // Recorded from the right; from the left it is the mirror image.
        let mirror = course.from.sign();
        for (p, v) in self
            .positions
            .chunks_exact_mut(3)
            .zip(self.velocities.chunks_exact_mut(3))
        {
            p[0] *= mirror;
            v[0] *= mirror * course.rate;
            v[1] *= course.rate;
            v[2] *= course.rate;
        }
        self.model.write_nodes(&self.positions, &self.velocities);
    }

    /// Recorded seconds a second that make a whole turn `seconds` long.
    pub(super) fn rate(&self, seconds: f32) -> f32 {
        let seconds = if seconds.is_finite() {
            seconds.max(0.05)
        } else {
            1.0
        };
        let recording = self
            .recording
            .as_ref()
            .expect("recorded before it is played");
        recording.duration() / seconds
    }

    /// Simulates a whole turn from the right and records it.
    pub(super) fn record(&self) -> Replay {
        let mut leaf = Leaf::of(self.model.clone());
        let mut recorder = Recorder::new(&mut leaf.model, FrameKind::Masses, KEY_INTERVAL);
        let gesture = leaf.model.settings().corner_gesture(GESTURE_SECONDS);
        leaf.model.play(gesture);
        let mut time = 0.0;
        let gesture_ticks = libm::ceilf(GESTURE_SECONDS / TICK) as u32;
        for tick in 1..=LONGEST_RECORDING {
            if tick <= gesture_ticks {
                leaf.model.step();
                leaf.share = leaf.measure_share();
            } else {
                if tick == gesture_ticks + 1 {
                    leaf.fall(Side::Left);
                }
                leaf.step(1);
            }
            time = tick as f32 * TICK;
            recorder.observe_at(&mut leaf.model, time);
            if let Phase::Resting(_) = leaf.phase
                && tick > gesture_ticks
            {
                break;
            }
        }
        leaf.lay(Side::Left);
        let frames = recorder.finish_at(&mut leaf.model, time + TICK);
        Replay::new(frames, Blend::Hermite, TICK)
    }
}
