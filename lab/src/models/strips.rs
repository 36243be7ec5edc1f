//! Each way at the same five moments of the turn by the corner, side by side.

use std::path::Path;

use tiny_skia::{Pixmap, PixmapPaint, Transform};
use turnleaf_engine::Surface;

use super::measure::{CORNER, Seen};
use super::rows::Way;
use super::shape::POINTS;
use super::timing::FRAME;
use crate::picture::{Camera, Moment, paint, save};
use crate::specimen::{BREADTH, LENGTH};

/// Frames that are drawn: a fifth of a second after the start, and so on.
const FRAMES: [usize; 5] = [15, 27, 36, 45, 57];

/// Width of one moment, pixels. It is drawn twice as large.
const WIDTH: u32 = 230;

/// Name of the file of a way's strip.
pub fn file(name: &str) -> String {
    format!("{}.png", name.replace(',', "").replace(' ', "-"))
}

/// Writes a strip for each way.
///
/// # Errors
/// Where there is no reference among the ways, or a picture cannot be written, in a sentence.
pub fn write(folder: &Path, ways: &[Way], seen: &[Seen]) -> Result<(), String> {
    let page = (BREADTH / LENGTH) as f32;
    let moments: Vec<Vec<Moment>> = seen.iter().map(moments).collect();
    let reference = ways.iter().position(Way::is_reference);
    let Some(reference) = reference else {
        return Err("There is no reference among the ways.".into());
    };
    // One camera for all: a leaf that flies apart leaves the picture.
    let camera = Camera::around(&moments[reference], page, 2 * WIDTH);
    for (way, moments) in ways.iter().zip(&moments) {
        save(&strip(moments, page, &camera), folder, &file(way.name))?;
    }
    Ok(())
}

fn moments(seen: &Seen) -> Vec<Moment> {
    FRAMES
        .map(|frame| moment(&seen.tracks[CORNER], frame - 1))
        .into()
}

/// What is to be painted of a frame of a track, from 0.
pub fn moment(track: &[Vec<[f64; 3]>], frame: usize) -> Moment {
    let mut surface = Surface::new(POINTS, POINTS);
    let places = track[frame].as_flattened();
    for (x, place) in surface.positions.iter_mut().zip(places) {
        *x = (place / LENGTH) as f32;
    }
    surface.update_normals();
    Moment {
        time: ((frame + 1) as f64 * FRAME) as f32,
        grid: (0, 0),
        masses: Vec::new(),
        mesh: (POINTS, POINTS),
        points: surface.positions.as_chunks::<3>().0.to_vec(),
        normals: surface.normals.as_chunks::<3>().0.to_vec(),
        triangles: Vec::new(),
    }
}

fn strip(moments: &[Moment], page: f32, camera: &Camera) -> Pixmap {
    let (width, height) = (camera.size.0 / 2, camera.size.1 / 2);
    let count = moments.len() as u32;
    let mut strip = Pixmap::new(width * count, height).expect("a picture has a size");
    for (k, moment) in moments.iter().enumerate() {
        let place = Transform::from_scale(0.5, 0.5).post_translate((k as u32 * width) as f32, 0.0);
        let paint_as = PixmapPaint {
            quality: tiny_skia::FilterQuality::Bilinear,
            ..PixmapPaint::default()
        };
        let picture = paint(moment, page, camera);
        strip.draw_pixmap(0, 0, picture.as_ref(), &paint_as, place, None);
    }
    strip
}
