//! Which frames of a recording are kept: few, and where the motion needs them.

use super::mix::mix;
use super::replay::blend;
use super::{Blend, KeyFrames};

/// The frames of `recording` to keep, rising, so that a Hermite blend of their
/// `rounded` positions is nowhere farther from the recording than `tolerance`,
/// in its unit of length; and how far it is at most. Where rounding alone is
/// farther, every frame may be kept.
pub(super) fn choose(recording: &KeyFrames, rounded: &[f32], tolerance: f32) -> (Vec<usize>, f32) {
    let last = recording.len() - 1;
    let mut search = Search {
        recording,
        rounded,
        keys: if last == 0 { vec![0] } else { vec![0, last] },
        errors: vec![0.0; last + 1],
        blended: vec![0.0; recording.frame_length()],
    };
    search.measure(0, last);
    search.add(tolerance);
    search.remove(tolerance);
    let worst = search.errors.iter().copied().fold(0.0, f32::max);
    (search.keys, worst)
}

struct Search<'a> {
    recording: &'a KeyFrames,
    rounded: &'a [f32],
    keys: Vec<usize>,
    /// Of every frame of the recording.
    errors: Vec<f32>,
    blended: Vec<f32>,
}

impl Search<'_> {
    /// Adds the frame that is farthest off, until none is too far.
    fn add(&mut self, tolerance: f32) {
        loop {
            let far =
                (0..self.errors.len()).filter(|frame| self.keys.binary_search(frame).is_err());
            let Some(worst) = far.max_by(|a, b| self.errors[*a].total_cmp(&self.errors[*b])) else {
                return;
            };
            if self.errors[worst] <= tolerance {
                return;
            }
            let at = self.keys.partition_point(|key| *key < worst);
            self.keys.insert(at, worst);
            self.measure_about(at);
        }
    }

    /// Takes out those that can be spared, the one that is missed least first.
    fn remove(&mut self, tolerance: f32) {
        let mut at = 1;
        while at + 1 < self.keys.len() {
            let (keys, errors) = (self.keys.clone(), self.errors.clone());
            self.keys.remove(at);
            self.measure_about(at);
            if self.errors.iter().any(|error| *error > tolerance) {
                (self.keys, self.errors) = (keys, errors);
                at += 1;
            }
        }
    }

    /// Measures what the key at a place has a part in: a tangent reaches two keys away.
    fn measure_about(&mut self, at: usize) {
        let from = self.keys[at.saturating_sub(2)];
        let to = self.keys[(at + 2).min(self.keys.len() - 1)];
        self.measure(from, to);
    }

    fn measure(&mut self, from: usize, to: usize) {
        let times: Vec<f32> = self
            .keys
            .iter()
            .map(|key| self.recording.times[*key])
            .collect();
        let length = self.blended.len();
        for frame in from..=to {
            let time = self.recording.times[frame];
            let after = times.partition_point(|t| *t <= time);
            let (here, _) = mix(&times, after, time, Blend::Hermite);
            let frames = here.frame.map(|key| {
                let start = self.keys[key] * length;
                &self.rounded[start..start + length]
            });
            blend(here, frames, &mut self.blended);
            self.errors[frame] = farthest(&self.blended, self.recording.frame(frame));
        }
    }
}

/// The longest distance between points of two frames, in their unit of length.
pub(super) fn farthest(a: &[f32], b: &[f32]) -> f32 {
    let (a, b) = (a.as_chunks::<3>().0, b.as_chunks::<3>().0);
    let square = |(a, b): (&[f32; 3], &[f32; 3])| -> f32 {
        (0..3)
            .map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis]))
            .sum()
    };
    a.iter().zip(b).map(square).fold(0.0, f32::max).sqrt()
}
