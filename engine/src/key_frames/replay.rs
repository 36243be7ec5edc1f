//! Repeating a recorded turn, itself a [`TurnModel`].

use super::mix::{Blend, Mix, mix};
use super::{FrameKind, KeyFrames};
use crate::interpolate::{Interpolation, uniform_samples};
use crate::surface::Surface;
use crate::turn::TurnModel;

/// A recorded turn, played again.
///
/// Interpolation from masses to the surface is linear in the masses. So the
/// surface of each key frame is interpolated once, when the replay comes near
/// it, and what is drawn is a blend of those surfaces: the same points, but for
/// rounding, as interpolating blended masses for every drawn frame
/// ([`Replay::interpolate_each_frame`] does that instead).
#[derive(Clone, Debug)]
pub struct Replay {
    frames: KeyFrames,
    blend: Blend,
    time_step: f32,
    steps: u64,
    /// On the average.
    frames_per_second: f32,
    /// From masses to the surface, and whether for every drawn frame anew.
    interpolation: Option<Interpolation>,
    each_frame: bool,
    /// Surfaces of the frames near the present time; frame i lies in slot i % 4.
    slots: [Slot; 4],
    /// Blended masses, one array an axis.
    masses: [Vec<f32>; 3],
}

/// One interpolated key frame.
#[derive(Clone, Debug)]
struct Slot {
    frame: usize,
    positions: Vec<f32>,
}

impl Replay {
    /// Plays frames in steps of `time_step` seconds. Frames of masses are drawn
    /// by 26 x 26 points unless set otherwise.
    ///
    /// # Panics
    /// If there are no frames, or if the step is not above 0.
    pub fn new(frames: KeyFrames, blend: Blend, time_step: f32) -> Self {
        assert!(!frames.is_empty(), "nothing was recorded");
        assert!(time_step > 0.0, "the time step is above 0");
        let last = frames.times[frames.len() - 1];
        let frames_per_second = if last > 0.0 {
            (frames.len() - 1) as f32 / last
        } else {
            0.0
        };
        let slot = Slot {
            frame: usize::MAX,
            positions: Vec::new(),
        };
        let slots = [slot.clone(), slot.clone(), slot.clone(), slot];
        let masses = [(); 3].map(|()| vec![0.0; frames.columns * frames.rows]);
        let each_frame = false;
        let mut replay = Self {
            frames,
            blend,
            time_step,
            steps: 0,
            frames_per_second,
            interpolation: None,
            each_frame,
            slots,
            masses,
        };
        if replay.frames.kind == FrameKind::Masses {
            let uniform = uniform_samples(26);
            replay.draw_samples(&uniform, &uniform);
        }
        replay
    }

    /// The frames that are played.
    pub fn frames(&self) -> &KeyFrames {
        &self.frames
    }

    /// When the last frame was taken, in seconds; afterwards it stands still.
    pub fn duration(&self) -> f32 {
        self.frames.times[self.frames.len() - 1]
    }

    /// Starts anew.
    pub fn rewind(&mut self) {
        self.steps = 0;
    }

    /// Draws frames of masses at every pair of `u` and `v`, rising and within
    /// 0..1. Frames of the surface are drawn as they were recorded.
    ///
    /// # Panics
    /// As [`Interpolation::lagrange`].
    pub fn draw_samples(&mut self, u: &[f32], v: &[f32]) {
        if self.frames.kind == FrameKind::Masses {
            self.interpolation = Some(Interpolation::lagrange(
                self.frames.columns,
                self.frames.rows,
                u,
                v,
            ));
            for slot in &mut self.slots {
                *slot = Slot {
                    frame: usize::MAX,
                    positions: vec![0.0; 3 * u.len() * v.len()],
                };
            }
        }
    }

    /// Draws the masses themselves, without interpolation.
    pub fn draw_nodes(&mut self) {
        self.interpolation = None;
    }

    /// Whether frames of masses are blended as masses and then interpolated for
    /// every drawn frame, as the paper does, at the cost of that interpolation.
    pub fn interpolate_each_frame(&mut self, each: bool) {
        self.each_frame = each;
    }

    /// Number of frames up to a time. Frames mostly come at equal intervals, so
    /// a division finds the place; where it does not, a search does.
    fn first_after(&self, time: f32) -> usize {
        let times = &self.frames.times;
        let guess = (time * self.frames_per_second) as usize;
        for after in guess..guess + 3 {
            if after > 0 && after < times.len() && times[after - 1] <= time && time < times[after] {
                return after;
            }
        }
        times.partition_point(|&t| t <= time)
    }

    /// The mixes for the positions and for the velocities at a time in seconds.
    fn mix(&self, time: f32) -> (Mix, Mix) {
        mix(&self.frames.times, self.first_after(time), time, self.blend)
    }

    /// The nodes at any time in seconds, whatever the replay's own: for playing
    /// backward and at other paces. Laid out as by [`TurnModel::read_nodes`].
    ///
    /// # Panics
    /// If a slice is not as long as a frame.
    pub fn read_nodes_at(&self, time: f32, positions: &mut [f32], velocities: &mut [f32]) {
        let (here, rate) = self.mix(time);
        self.blend_frames(here, positions);
        self.blend_frames(rate, velocities);
    }

    fn blend_frames(&self, mix: Mix, out: &mut [f32]) {
        blend(mix, mix.frame.map(|frame| self.frames.frame(frame)), out);
    }

    /// Interpolates a key frame into its slot, unless it is there.
    fn prepare(&mut self, frame: usize) {
        let slot = &mut self.slots[frame % 4];
        if let (Some(lagrange), true) = (&mut self.interpolation, slot.frame != frame) {
            deinterleave(self.frames.frame(frame), &mut self.masses);
            let axes = self.masses.each_ref().map(|axis| &axis[..]);
            lagrange.apply(axes, self.frames.columns, &mut slot.positions);
            slot.frame = frame;
        }
    }
}

impl TurnModel for Replay {
    fn time_step(&self) -> f32 {
        self.time_step
    }

    fn time(&self) -> f32 {
        (self.steps as f64 * f64::from(self.time_step)) as f32
    }

    fn step(&mut self) {
        self.steps += 1;
    }

    fn write_surface(&mut self, surface: &mut Surface) {
        let (mix, _) = self.mix(self.time());
        let samples = self.interpolation.as_ref().map(Interpolation::samples);
        let (columns, rows) = samples.unwrap_or((self.frames.columns, self.frames.rows));
        surface.resize(columns, rows);
        if samples.is_none() {
            self.blend_frames(mix, &mut surface.positions);
        } else if self.each_frame {
            let mut blended = vec![0.0; self.frames.frame_length()];
            self.blend_frames(mix, &mut blended);
            deinterleave(&blended, &mut self.masses);
            if let Some(lagrange) = &mut self.interpolation {
                let axes = self.masses.each_ref().map(|axis| &axis[..]);
                lagrange.apply(axes, self.frames.columns, &mut surface.positions);
            }
        } else {
            for (&frame, &weight) in mix.frame.iter().zip(&mix.weight) {
                if weight != 0.0 {
                    self.prepare(frame);
                }
            }
            let surfaces = mix.frame.map(|frame| &self.slots[frame % 4].positions[..]);
            blend(mix, surfaces, &mut surface.positions);
        }
        surface.touch();
    }

    fn grid_size(&self) -> (usize, usize) {
        (self.frames.columns, self.frames.rows)
    }

    /// As recorded: for frames of the surface, its points.
    fn read_nodes(&self, positions: &mut [f32], velocities: &mut [f32]) {
        self.read_nodes_at(self.time(), positions, velocities);
    }
}

fn deinterleave(from: &[f32], axes: &mut [Vec<f32>; 3]) {
    for (i, point) in from.chunks_exact(3).enumerate() {
        for axis in 0..3 {
            axes[axis][i] = point[axis];
        }
    }
}

/// The weighted sum of two or four arrays.
pub(super) fn blend(mix: Mix, from: [&[f32]; 4], out: &mut [f32]) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx") {
        // SAFETY: the processor has AVX, as just found.
        unsafe { blend_eight_lanes(mix, from, out) };
        return;
    }
    blend_lanes(mix, from, out);
}

/// The same by eight lanes. Every float has its own sum, of the same operations
/// in the same order, none of them fused: the same bits.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx")]
fn blend_eight_lanes(mix: Mix, from: [&[f32]; 4], out: &mut [f32]) {
    blend_lanes(mix, from, out);
}

#[inline(always)]
fn blend_lanes(mix: Mix, from: [&[f32]; 4], out: &mut [f32]) {
    let w = mix.weight;
    let n = out.len();
    if w[0] == 0.0 && w[3] == 0.0 {
        let (b, c) = (&from[1][..n], &from[2][..n]);
        for i in 0..n {
            out[i] = w[1] * b[i] + w[2] * c[i];
        }
    } else {
        let [a, b, c, d] = from.map(|array| &array[..n]);
        for i in 0..n {
            out[i] = (w[0] * a[i] + w[1] * b[i]) + (w[2] * c[i] + w[3] * d[i]);
        }
    }
}
