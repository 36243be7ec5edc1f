//! A way of turning a page, measured on the three turns and under wild hands.

use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

use serde_json::{Value, json};
use turnleaf_engine::{LooseLeaf, Surface, TurnBy, TurnModel};

use super::rows::{Source, Way};
use super::shape::{self, Faults, POINTS};

use super::timing::{AFTER, FRAME, TURN};
use crate::memory;
use crate::simulate::median;
use crate::specimen::LENGTH;

/// The turn that is drawn, among the three.
pub const CORNER: usize = 1;

/// Frames of a turn and what is watched after it.
pub const FRAMES: usize = ((TURN + AFTER) / FRAME + 0.5) as usize;

/// Where the reference's surface was in each frame of each turn.
pub type Tracks = Vec<Vec<Vec<[f64; 3]>>>;

/// What was seen of a way.
#[derive(Default)]
pub struct Seen {
    /// Its places in each frame of each turn.
    pub tracks: Tracks,
    /// Those of the drawn mesh and of the nodes; none where pictures are drawn.
    pub faults: Option<Faults>,
    /// Microseconds of every frame.
    pub times: Vec<f64>,
    pub bytes: usize,
    /// How far the corner is from a hand that draws it, over the width.
    pub misses: Option<Vec<f64>>,
}

/// Looks at a way on all turns, `again` more times for the clock alone.
pub fn look(way: &Way, again: usize) -> Result<Seen, String> {
    let (mut seen, mut faults) = (Seen::default(), Faults::default());
    for by in TurnBy::ALL {
        for round in 0..=again {
            let before = memory::held();
            let mut model = way.begin(by)?;
            let mut surface = Surface::new(2, 2);
            model.write_surface(&mut surface);
            seen.bytes = seen.bytes.max(memory::held().saturating_sub(before));
            let (columns, rows) = model.grid_size();
            let mut nodes = Surface::new(columns, rows);
            let mut velocities = vec![0.0; nodes.positions.len()];
            let mut track = Vec::new();
            for frame in 1..=FRAMES {
                let clock = Instant::now();
                step_to(&mut *model, frame as f64 * FRAME);
                black_box(&mut *model).write_surface(&mut surface);
                seen.times.push(clock.elapsed().as_secs_f64() * 1e6);
                if round == 0 {
                    faults.include(&surface);
                    model.read_nodes(&mut nodes.positions, &mut velocities);
                    faults.include_nodes(&nodes);
                    track.push(shape::places(&surface));
                }
            }
            if round == 0 {
                seen.tracks.push(track);
            }
        }
    }
    seen.faults = Some(faults);
    seen.misses = Some(if way.source == Source::Live {
        drag(way)?
    } else {
        follow(seen.tracks[CORNER].iter().map(|places| &places[..]))
    });
    Ok(seen)
}

fn step_to(model: &mut dyn TurnModel, time: f64) {
    let half = 0.5 * f64::from(model.time_step());
    while f64::from(model.time()) < time - half {
        model.step();
    }
}

/// Places to which a hand draws the foot corner, over the page's width: in reach
/// of the paper.
const DRAGS: [[f64; 3]; 8] = [
    [0.8, 0.1, 0.3],
    [0.5, 0.3, 0.5],
    [0.6, -0.2, 0.4],
    [0.2, 0.5, 0.6],
    [0.0, 0.1, 0.9],
    [-0.3, 0.4, 0.5],
    [-0.6, -0.1, 0.4],
    [-0.8, 0.2, 0.3],
];

/// How far the corner is from the hand when it has held still for a while, over
/// the width.
fn drag(way: &Way) -> Result<Vec<f64>, String> {
    let mut leaf: LooseLeaf = way.leaf(TurnBy::Corner, way.settings.interpolate)?;
    let mut surface = Surface::new(2, 2);
    let mut misses = Vec::new();
    leaf.grab(1.0, 0.0);
    let mut from = [LENGTH, 0.0, 0.0];
    for place in DRAGS {
        let to = place.map(|x| x * LENGTH);
        for frame in 1..=60 {
            let part = (frame as f64 / 30.0).min(1.0);
            leaf.pull(std::array::from_fn(|axis| {
                (from[axis] + part * (to[axis] - from[axis])) as f32
            }));
            leaf.advance(FRAME);
        }
        leaf.write_surface(&mut surface);
        let corner = surface.position(surface.columns - 1, 0).map(f64::from);
        let square: f64 = (0..3).map(|axis| (corner[axis] - to[axis]).powi(2)).sum();
        misses.push(square.sqrt() / LENGTH);
        from = to;
    }
    Ok(misses)
}

/// The same of a way that follows only how far over the hand is: it shows, of its
/// moments, that at which as much of the turn was done.
pub fn follow<'a>(moments: impl Iterator<Item = &'a [[f64; 3]]>) -> Vec<f64> {
    let moments: Vec<_> = moments
        .map(|places| (shape::share(places), places[POINTS - 1]))
        .collect();
    let miss = |place: [f64; 3]| {
        let wanted = place[2].max(0.0).atan2(place[0]) / PI;
        let off = |share: f64| (share - wanted).abs();
        let nearest = moments.iter().min_by(|a, b| off(a.0).total_cmp(&off(b.0)));
        let (_, corner) = nearest.expect("a turn has moments");
        let square = |axis: usize| (corner[axis] / LENGTH - place[axis]).powi(2);
        (0..3).map(square).sum::<f64>().sqrt()
    };
    DRAGS.map(miss).into()
}

/// How far a track is from another, over the width.
#[derive(Default)]
struct Apart {
    rms_by_frame: Vec<f64>,
    worst_by_frame: Vec<f64>,
}

impl Apart {
    fn new(a: &[Vec<[f64; 3]>], b: &[Vec<[f64; 3]>]) -> Self {
        let mut apart = Self::default();
        for (a, b) in a.iter().zip(b) {
            let (mut square, mut worst) = (0.0, 0.0f64);
            for distance in shape::distances(a, b) {
                square += distance * distance;
                worst = worst.max(distance);
            }
            apart.rms_by_frame.push((square / a.len() as f64).sqrt());
            apart.worst_by_frame.push(worst);
        }
        apart
    }

    fn rms(&self) -> f64 {
        let squares: f64 = self.rms_by_frame.iter().map(|rms| rms * rms).sum();
        (squares / self.rms_by_frame.len() as f64).sqrt()
    }

    fn worst(&self) -> f64 {
        self.worst_by_frame.iter().copied().fold(0.0, f64::max)
    }

    /// The worst at whole tenths of a second, as `lab agree` looks.
    fn worst_at_tenths(&self) -> f64 {
        let frames = (0.1 / FRAME).round() as usize;
        let tenths = self.worst_by_frame.iter().skip(frames - 1).step_by(frames);
        tenths.copied().fold(0.0, f64::max)
    }
}

/// The figures of a way, beside the reference and, for a replay, the live leaf.
pub fn figures(way: &Way, seen: &Seen, reference: &Tracks, live: Option<&Seen>) -> Value {
    let (mut by_turn, mut square, mut worst) = (serde_json::Map::new(), 0.0, 0.0f64);
    let mut at_tenths = 0.0f64;
    for (k, by) in TurnBy::ALL.into_iter().enumerate() {
        let apart = Apart::new(&seen.tracks[k], &reference[k]);
        square += apart.rms().powi(2) / 3.0;
        worst = worst.max(apart.worst());
        if by != TurnBy::LetGo {
            at_tenths = at_tenths.max(apart.worst_at_tenths());
        }
        by_turn.insert(
            by.name().into(),
            json!({
                "rms": apart.rms(),
                "worst": apart.worst(),
                "worst_at_tenths": apart.worst_at_tenths(),
                "rms_by_frame": apart.rms_by_frame,
                "worst_by_frame": apart.worst_by_frame,
            }),
        );
    }
    let cost = median(seen.times.clone());
    let follows = seen.misses.as_ref().map(|misses| median(misses.clone()));
    let mut figures = json!({
        "name": way.name,
        "reference": way.is_reference(),
        "us_per_frame": cost,
        "bytes": seen.bytes,
        "rms": square.sqrt(),
        "worst": worst,
        "worst_as_agree": at_tenths,
        "turns": by_turn,
        "stretch": seen.faults.map(|faults| faults.strain.max),
        "compression": seen.faults.map(|faults| faults.strain.min),
        "area_change": seen.faults.map(|faults| faults.area),
        "angle_defect_degrees": seen.faults.map(|faults| faults.angle),
        "facet_angle_degrees": seen.faults.map(|faults| faults.crease),
        "shear_degrees": seen.faults.map(|faults| faults.shear),
        "diagonal_stretch": seen.faults.map(|faults| faults.diagonal),
        "spine_off": seen.faults.map(|faults| faults.spine),
        "keeps_spine": seen.faults.map(|faults| faults.spine < 1e-4),
        "drag_misses": seen.misses,
        "drag_miss": follows,
    });
    if let Some(live) = live {
        let (mut rms, mut worst) = (0.0f64, 0.0f64);
        for (a, b) in seen.tracks.iter().zip(&live.tracks) {
            let apart = Apart::new(a, b);
            (rms, worst) = (rms.max(apart.rms()), worst.max(apart.worst()));
        }
        figures["of_live"] = json!({
            "rms": rms,
            "worst": worst,
            "times_cheaper": median(live.times.clone()) / cost,
        });
    }
    figures
}
