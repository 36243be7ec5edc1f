//! `lab picture`: a turn as PNG pictures, with masses, springs and the drawn
//! mesh, after figures 6 and 7 of the paper; with `--figures` the counterparts of
//! its figures 1 to 5.

mod camera;
mod draw;
mod figures;
mod label;
mod moment;

use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use tiny_skia::{Pixmap, PixmapPaint, Transform};
use turnleaf_engine::TurnModel;

use crate::options::{Scene, between, make_folder};
use crate::simulate;
pub use camera::Camera;
pub use draw::{moment as paint, save};
pub use moment::Moment;

/// Where pictures go, how many moments are drawn and how large.
#[derive(Args)]
pub struct PictureOptions {
    /// Folder for the pictures.
    #[arg(long, default_value = "pictures")]
    pub out: PathBuf,
    /// Number of moments that are drawn.
    #[arg(long, default_value_t = 6, value_parser = between(2usize, 600))]
    pub frames: usize,
    /// Width at which a moment is drawn, pixels; half of it where one picture has them all.
    #[arg(long, default_value_t = 960, value_parser = between(120u32, 4096))]
    pub size: u32,
}

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    #[command(flatten)]
    scene: Scene,
    #[command(flatten)]
    pictures: PictureOptions,
    /// Draw counterparts of the paper's figures 1 to 5 instead.
    #[arg(long)]
    figures: bool,
}

/// The files that were written, and the times that pictures of a turn show.
#[derive(Serialize)]
pub struct Written {
    files: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    times: Option<Vec<f32>>,
}

impl Display for Written {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        self.files
            .iter()
            .try_for_each(|file| writeln!(out, "{file}"))
    }
}

/// Runs the experiment.
///
/// # Errors
/// Where a leaf cannot be made or a picture cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Written, String> {
    let Options { scene, .. } = options;
    let PictureOptions { out, frames, size } = &options.pictures;
    make_folder(out)?;
    if options.figures {
        let files = figures::write(out, *size)?;
        return Ok(Written { files, times: None });
    }
    let moments = moments(scene, *frames)?;
    let page = scene.settings().height / scene.settings().width;
    let camera = Camera::around(&moments, page, *size);
    let pictures: Vec<Pixmap> = moments
        .iter()
        .map(|moment| draw::moment(moment, page, &camera))
        .collect();
    let stem = format!("{}-{}", scene.preset.name(), scene.gesture);
    let mut files = Vec::new();
    for (index, picture) in pictures.iter().enumerate() {
        files.push(save(picture, out, &format!("{stem}-{index:02}.png"))?);
    }
    files.push(save(&on_one(&pictures), out, &format!("{stem}.png"))?);
    let times = moments.iter().map(|moment| moment.time).collect();
    Ok(Written {
        files,
        times: Some(times),
    })
}

/// Moments evenly over the gesture; the last one after all has settled.
fn moments(scene: &Scene, count: usize) -> Result<Vec<Moment>, String> {
    let mut leaf = scene.leaf()?;
    let all = simulate::step_count(scene, &leaf);
    let gesture = f64::from(scene.seconds()) / f64::from(leaf.time_step());
    let mut moments = Vec::new();
    let mut steps = 0;
    for index in 0..count {
        let part = index as f64 / (count - 1) as f64;
        let wanted = if index + 1 == count {
            all
        } else {
            (part * gesture).round() as usize
        };
        while steps < wanted {
            leaf.step();
            steps += 1;
        }
        moments.push(Moment::of(&mut leaf));
    }
    Ok(moments)
}

/// All pictures on one, at half their size, three in a row.
pub fn on_one(pictures: &[Pixmap]) -> Pixmap {
    let across = if pictures.len() > 4 { 3 } else { 2 };
    let (width, height) = (
        pictures[0].width().div_ceil(2),
        pictures[0].height().div_ceil(2),
    );
    let down = pictures.len().div_ceil(across) as u32;
    let mut sheet =
        Pixmap::new(width * across as u32, height * down).expect("a picture has a size");
    sheet.fill(draw::paper());
    for (index, picture) in pictures.iter().enumerate() {
        let (column, row) = (index % across, index / across);
        let place = Transform::from_scale(0.5, 0.5)
            .post_translate((column as u32 * width) as f32, (row as u32 * height) as f32);
        let paint = PixmapPaint {
            quality: tiny_skia::FilterQuality::Bilinear,
            ..PixmapPaint::default()
        };
        sheet.draw_pixmap(0, 0, picture.as_ref(), &paint, place, None);
    }
    sheet
}
