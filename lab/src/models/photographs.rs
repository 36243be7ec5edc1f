//! Photographs of the reference's turns: what they cost, and how far what they
//! show is from the turn.
//!
//! Each shows the leaf when a fraction of its turn was first done, at even fractions.
//! Shown is always the one nearest to what is done, as the viewer does it.

use std::hint::black_box;
use std::time::Instant;

use tiny_skia::Pixmap;

use super::measure::{CORNER, Seen, Tracks};
use super::shape;
use super::strips;
use crate::memory;
use crate::picture::{Camera, Moment, paint};
use crate::specimen::{BREADTH, LENGTH};

/// Photographs of a turn, and pixels across one: as those of examples/12-models.html.
pub const COUNT: usize = 24;
const WIDTH: u32 = 800;

/// Takes photographs of every turn of the reference and shows them, `again` more
/// times for the clock alone. A frame costs the search for its photograph and the
/// copy of that.
pub fn look(reference: &Tracks, again: usize) -> Seen {
    let mut seen = Seen::default();
    for (turn, track) in reference.iter().enumerate() {
        let fractions: Vec<f64> = track.iter().map(|places| shape::progress(places)).collect();
        let shown = photographed(&fractions);
        let moments: Vec<Moment> = shown
            .iter()
            .map(|frame| strips::moment(track, *frame))
            .collect();
        let page = (BREADTH / LENGTH) as f32;
        let camera = Camera::around(&moments, page, WIDTH);
        let mut canvas = Pixmap::new(camera.size.0, camera.size.1).expect("a picture has a size");
        let before = memory::held();
        let pictures: Vec<Pixmap> = moments
            .iter()
            .map(|moment| paint(moment, page, &camera))
            .collect();
        seen.bytes = seen.bytes.max(memory::held().saturating_sub(before));
        for _ in 0..=again {
            for fraction in &fractions {
                let clock = Instant::now();
                let picture = &pictures[number(*fraction)];
                canvas.data_mut().copy_from_slice(black_box(picture).data());
                black_box(&mut canvas);
                seen.times.push(clock.elapsed().as_secs_f64() * 1e6);
            }
        }
        let frames = fractions.iter().map(|fraction| shown[number(*fraction)]);
        seen.tracks
            .push(frames.map(|frame| track[frame].clone()).collect());
        if turn == CORNER {
            let moments = shown.iter().map(|frame| &track[*frame][..]);
            seen.misses = Some(super::measure::follow(moments));
        }
    }
    seen
}

/// The photograph of a fraction of the turn, from 0.
fn number(fraction: f64) -> usize {
    (fraction * (COUNT - 1) as f64).round() as usize
}

/// The frame in which each photograph is taken: the first in which so much is
/// done, else the one in which most is.
fn photographed(fractions: &[f64]) -> Vec<usize> {
    let most = (0..fractions.len()).max_by(|a, b| fractions[*a].total_cmp(&fractions[*b]));
    let most = most.expect("a turn has frames");
    let taken = |number: usize| {
        let wanted = number as f64 / (COUNT - 1) as f64;
        fractions.iter().position(|fraction| *fraction >= wanted)
    };
    (0..COUNT)
        .map(|number| taken(number).unwrap_or(most))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A board at a fraction of its turn.
    fn board(fraction: f64) -> Vec<[f64; 3]> {
        let (sin, cos) = (std::f64::consts::PI * fraction).sin_cos();
        let places = (0..shape::POINTS * shape::POINTS).map(|k| {
            let (u, v) = (k % shape::POINTS, k / shape::POINTS);
            let [u, v] = [u, v].map(|at| at as f64 / (shape::POINTS - 1) as f64);
            [u * LENGTH * cos, v * BREADTH, u * LENGTH * sin]
        });
        places.collect()
    }

    #[test]
    fn photographs_are_the_turn_at_their_moments_and_step_between() {
        let track: Vec<_> = (0..=230).map(|k| board(f64::from(k) / 230.0)).collect();
        let seen = look(&vec![track.clone(); 2], 0);
        let apart = |frame: usize| {
            shape::distances(&seen.tracks[1][frame], &track[frame]).fold(0.0, f64::max)
        };
        // Taken in the frame of its moment, or the next one.
        let frame = std::f64::consts::PI / 230.0;
        assert!([0, 10, 230].map(apart).iter().all(|off| *off < 1.1 * frame));
        // Between two moments half of a 23rd of a half circle.
        let most = (0..=230).map(apart).fold(0.0, f64::max);
        let half = std::f64::consts::PI / 23.0 / 2.0;
        assert!(most < half + 1.1 * frame && most > 0.75 * half, "{most}");
        assert!(seen.bytes > COUNT * 4 * 800 * 100);
        // A board's corner is as far from the spine as ever: by so much it misses a hand.
        let misses = seen.misses.expect("they follow a hand");
        assert!(misses.iter().all(|miss| *miss > 0.05 && *miss < 1.0));
    }
}
