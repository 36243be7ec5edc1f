//! `lab fold`: a page on a table is folded by its creases, whose rest angles grow; as a
//! picture.
//!
//! No hand takes part: a crease that is given a rest angle turns the paper beside it, whose
//! weight, stiffness and air are those of the stock.

use clap::{Args, ValueEnum};
use serde::Serialize;
use tiny_skia::Pixmap;
use turnleaf_engine::book::Paper;
use turnleaf_engine::trials::PAGE;
use turnleaf_engine::{Contact, Root, Sheet, SheetCrease, SheetSettings, TurnModel};

use crate::options::{between, make_folder};
use crate::picture::{Camera, Moment, PictureOptions, on_one, paint, save};
use crate::report::Lines;

/// What is folded.
#[derive(Clone, Copy, ValueEnum)]
enum Fold {
    /// The corner of foot and fore-edge.
    DogEar,
    /// The page in three, along lines across the spine.
    Letter,
    /// The page in three and in two, along lines that cross.
    Map,
}

/// Stiffness of a crease along its whole length over that of a page's paper: k L / D.
const PRESSED: f64 = 6.0;

/// Angle off their rest from which creases that creep yield, degrees.
const YIELDS: f64 = 30.0;

/// Options of the experiment.
#[derive(Args)]
pub struct Options {
    /// What is folded.
    #[arg(long, value_enum, default_value = "dog-ear")]
    fold: Fold,
    /// Rest angle that the creases come to, degrees [default: 150 of a dog-ear, else 110]
    #[arg(long, allow_negative_numbers = true, value_parser = between(-180.0, 180.0))]
    rest: Option<f64>,
    /// Angle by which they creep in a time that grows e-fold, degrees; they yield from 30 on then.
    #[arg(long, default_value_t = 0.0, value_parser = between(0.0, 30.0))]
    creep: f64,
    /// Seconds until they have, and as long again.
    #[arg(long, default_value_t = 1.0, value_parser = between(0.1, 60.0))]
    seconds: f64,
    #[command(flatten)]
    pictures: PictureOptions,
}

/// What was folded, and where its picture is.
#[derive(Serialize)]
pub struct Folded {
    file: String,
    crease_angles_deg: Vec<f32>,
    crease_rests_deg: Vec<f32>,
    max_edge_strain: f32,
}

/// Creases of a page, and whether each is folded toward the recto.
fn lines(fold: Fold) -> Vec<([[f64; 2]; 2], f64)> {
    let across = |v: f64| [[0.0, v], [1.0, v]];
    let along = |u: f64| [[u, 0.0], [u, 1.0]];
    let size = 0.05;
    match fold {
        Fold::DogEar => {
            let ear = [[1.0 - size / PAGE[0], 0.0], [1.0, size / PAGE[1]]];
            vec![(ear, 1.0)]
        }
        Fold::Letter => vec![(across(1.0 / 3.0), 1.0), (across(2.0 / 3.0), 1.0)],
        Fold::Map => vec![
            (along(1.0 / 3.0), 1.0),
            (along(2.0 / 3.0), -1.0),
            (across(0.5), 0.4),
        ],
    }
}

/// Runs the experiment.
///
/// # Errors
/// Where the page cannot be creased so or a picture cannot be written, in a sentence.
pub fn run(options: &Options) -> Result<Lines<Folded>, String> {
    let PictureOptions { out, frames, size } = &options.pictures;
    make_folder(out)?;
    let settings = SheetSettings {
        root: match options.fold {
            Fold::DogEar => Root::Clamped,
            Fold::Letter | Fold::Map => Root::Free,
        },
        ..Paper::default().sheet(PAGE)
    };
    let stock = settings.stock;
    let (yields, creep) = match options.creep {
        0.0 => (f64::INFINITY, 0.0),
        creep => (YIELDS.to_radians(), creep.to_radians()),
    };
    let rest = options.rest.unwrap_or(match options.fold {
        Fold::DogEar => 150.0,
        Fold::Letter | Fold::Map => 110.0,
    });
    let mut sheet = Sheet::new(settings).map_err(|error| error.to_string())?;
    let creases = lines(options.fold);
    let lines: Vec<SheetCrease> = creases
        .iter()
        .map(|(through, _)| SheetCrease {
            through: *through,
            rest: 0.0,
            stiffness: PRESSED * stock.stiffness_across / PAGE[0],
            yields,
            creep,
        })
        .collect();
    sheet.crease(&lines).map_err(|error| error.to_string())?;
    for contacts in sheet.contacts_mut() {
        contacts[0] = Contact {
            normal: [0.0, 0.0, 1.0],
            offset: 0.0,
            velocity: [0.0; 3],
            friction: stock.friction as f32,
            firmness: 1.0,
        };
    }
    let step = f64::from(sheet.time_step());
    let steps = (2.0 * options.seconds / step) as usize;
    let mut moments = Vec::new();
    let mut is_pressed = false;
    for k in 0..=steps {
        if k * (frames - 1) >= moments.len() * steps {
            moments.push(Moment::of_sheet(&mut sheet));
        }
        let t = (k as f64 * step / options.seconds).min(1.0);
        let part = t * t * (3.0 - 2.0 * t);
        // Once pressed they are left to themselves.
        if !is_pressed {
            for (crease, (_, toward)) in creases.iter().enumerate() {
                sheet.press(crease, (part * toward * rest).to_radians() as f32);
            }
        }
        is_pressed = t >= 1.0;
        sheet.step();
    }
    let page = (PAGE[1] / PAGE[0]) as f32;
    let camera = Camera::around(&moments, page, *size);
    let pictures: Vec<Pixmap> = moments
        .iter()
        .map(|moment| paint(moment, page, &camera))
        .collect();
    let name = options.fold.to_possible_value();
    let name = name.map_or_else(String::new, |value| {
        format!("fold-{}.png", value.get_name())
    });
    let file = save(&on_one(&pictures), out, &name)?;
    let angles = (0..creases.len()).filter_map(|crease| sheet.crease_angle(crease));
    let [angles, rests] = [0, 1].map(|of| {
        let all = angles.clone().map(|angles| angles[of].to_degrees());
        all.collect()
    });
    Ok(Lines(Folded {
        file,
        crease_angles_deg: angles,
        crease_rests_deg: rests,
        max_edge_strain: sheet.max_edge_strain(),
    }))
}
