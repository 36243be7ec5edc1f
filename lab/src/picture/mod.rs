//! `lab picture`: a turn as PNG pictures, with masses, springs and the drawn
//! mesh, after figures 6 and 7 of the paper; with `--figures` the counterparts of
//! its figures 1 to 5.

mod camera;
mod draw;
mod figures;
mod label;
mod moment;

use std::path::PathBuf;

use serde_json::json;
use tiny_skia::{Pixmap, PixmapPaint, Transform};
use turnleaf_engine::TurnModel;

use crate::options::{self, Scene};
use crate::simulate;
pub use camera::Camera;
pub use draw::moment as paint;
pub use moment::Moment;

/// Runs the experiment.
pub fn run(parser: &mut lexopt::Parser) -> Result<(), String> {
    let mut scene = Scene::default();
    let (mut out, mut frames, mut size) = (PathBuf::from("pictures"), 6usize, 960u32);
    let mut of_paper = false;
    let json = options::read(parser, |option, parser| {
        match option {
            "out" => out = options::text(parser, option)?.into(),
            "frames" => frames = options::number(parser, option, 2, 600)?,
            "size" => size = options::number(parser, option, 120, 4096)?,
            "figures" => of_paper = true,
            _ => return scene.take(option, parser),
        }
        Ok(true)
    })?;
    if of_paper {
        return figures::write(&out, size, json);
    }
    let moments = moments(&scene, frames)?;
    let page = scene.settings().height / scene.settings().width;
    let camera = Camera::around(&moments, page, size);
    std::fs::create_dir_all(&out)
        .map_err(|error| format!("The folder {} cannot be made: {error}.", out.display()))?;
    let pictures: Vec<Pixmap> = moments
        .iter()
        .map(|moment| draw::moment(moment, page, &camera))
        .collect();
    let stem = format!("{}-{}", scene.preset.name(), scene.gesture);
    let mut written = Vec::new();
    for (index, picture) in pictures.iter().enumerate() {
        written.push((format!("{stem}-{index:02}.png"), picture.clone()));
    }
    written.push((format!("{stem}.png"), sheet(&pictures)));
    for (name, picture) in &written {
        let path = out.join(name);
        picture
            .save_png(&path)
            .map_err(|error| format!("{} cannot be written: {error}.", path.display()))?;
        if !json {
            println!("{}", path.display());
        }
    }
    if json {
        let files: Vec<String> = written
            .iter()
            .map(|(name, _)| out.join(name).display().to_string())
            .collect();
        println!(
            "{:#}",
            json!({ "files": files, "times": moments.iter().map(|moment| moment.time).collect::<Vec<_>>() })
        );
    }
    Ok(())
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
fn sheet(pictures: &[Pixmap]) -> Pixmap {
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
