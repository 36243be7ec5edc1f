//! A way of turning a page, measured on the three turns and by drags.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

use cpu_time::ThreadTime;
use serde::Serialize;
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
    /// Bytes that it holds in memory.
    pub bytes: usize,
    /// How far the corner is from a hand that draws it, over the width.
    pub misses: Option<Vec<f64>>,
}

/// Looks at a way on all turns, `again` more times for the clock alone.
///
/// # Errors
/// Where the way makes no leaf, in a sentence.
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
                let (processor, clock) = (ThreadTime::now(), Instant::now());
                step_to(&mut *model, frame as f64 * FRAME);
                black_box(&mut *model).write_surface(&mut surface);
                let (clock, processor) = (clock.elapsed(), processor.elapsed());
                // The clock counts other work of the machine; the thread's own time costs
                // more to ask for than a short frame takes.
                seen.times.push(clock.min(processor).as_secs_f64() * 1e6);
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
        .map(|places| (shape::progress(places), places[POINTS - 1]))
        .collect();
    let miss = |place: [f64; 3]| {
        let wanted = place[2].max(0.0).atan2(place[0]) / PI;
        let off = |progress: f64| (progress - wanted).abs();
        let nearest = moments.iter().min_by(|a, b| off(a.0).total_cmp(&off(b.0)));
        let (_, corner) = nearest.expect("a turn has moments");
        let square = |axis: usize| (corner[axis] / LENGTH - place[axis]).powi(2);
        (0..3).map(square).sum::<f64>().sqrt()
    };
    DRAGS.map(miss).into()
}

/// How far a track is from another, over the width.
#[derive(Serialize)]
pub struct Apart {
    /// Root mean square of the distances, over all frames and places.
    pub rms: f64,
    /// The longest.
    pub worst: f64,
    /// The worst at whole tenths of a second, as `lab agree` looks.
    pub worst_at_tenths: f64,
    rms_by_frame: Vec<f64>,
    worst_by_frame: Vec<f64>,
}

impl Apart {
    fn new(a: &[Vec<[f64; 3]>], b: &[Vec<[f64; 3]>]) -> Self {
        let (mut rms_by_frame, mut worst_by_frame) = (Vec::new(), Vec::new());
        for (a, b) in a.iter().zip(b) {
            let (mut square, mut worst) = (0.0, 0.0f64);
            for distance in shape::distances(a, b) {
                square += distance * distance;
                worst = worst.max(distance);
            }
            rms_by_frame.push((square / a.len() as f64).sqrt());
            worst_by_frame.push(worst);
        }
        let squares: f64 = rms_by_frame.iter().map(|rms| rms * rms).sum();
        let frames = (0.1 / FRAME).round() as usize;
        let tenths = worst_by_frame.iter().skip(frames - 1).step_by(frames);
        Apart {
            rms: (squares / rms_by_frame.len() as f64).sqrt(),
            worst: worst_by_frame.iter().copied().fold(0.0, f64::max),
            worst_at_tenths: tenths.copied().fold(0.0, f64::max),
            rms_by_frame,
            worst_by_frame,
        }
    }
}

/// The figures of a way, beside the reference and, for a replay, the live leaf. Lengths
/// are over the width, angles in degrees; what photographs have none of is none.
#[derive(Serialize)]
pub struct Figures {
    /// The name of the way.
    pub name: &'static str,
    /// Whether it is the one that the others are measured from.
    pub reference: bool,
    /// Median microseconds of a frame.
    pub us_per_frame: f64,
    /// Bytes that it holds in memory.
    pub bytes: usize,
    /// Root mean square distance from the reference, over all turns.
    pub rms: f64,
    /// Longest distance from it.
    pub worst: f64,
    /// The worst of the two carried turns at tenths of a second.
    pub worst_as_agree: f64,
    /// How far it is from the reference in each turn.
    pub turns: BTreeMap<&'static str, Apart>,
    #[serde(flatten)]
    pub faults: FaultFigures,
    /// How far the corner is from a hand that draws it, in each frame.
    pub drag_misses: Option<Vec<f64>>,
    /// The median of these.
    pub drag_miss: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub of_live: Option<OfLive>,
}

/// What is wrong with a drawn surface.
#[derive(Default, Serialize)]
pub struct FaultFigures {
    /// Largest stretch of the mesh's edges.
    pub stretch: Option<f32>,
    /// Largest compression of them, below 0.
    pub compression: Option<f32>,
    /// Largest change of the whole area, as part of it.
    pub area_change: Option<f64>,
    /// Largest change of a cell's angle.
    pub angle_defect_degrees: Option<f64>,
    /// Largest angle between the normals of neighbouring facets.
    pub facet_angle_degrees: Option<f64>,
    /// Largest shear of a cell of nodes.
    pub shear_degrees: Option<f64>,
    /// Largest stretch of a diagonal of a cell of nodes, as part of it.
    pub diagonal_stretch: Option<f64>,
    /// Longest distance of a point of the spine from where it is bound.
    pub spine_off: Option<f64>,
    /// Whether the spine stays where it is bound, within a ten-thousandth of the width.
    pub keeps_spine: Option<bool>,
}

impl FaultFigures {
    fn of(faults: &Faults) -> Self {
        FaultFigures {
            stretch: Some(faults.strain.max),
            compression: Some(faults.strain.min),
            area_change: Some(faults.area),
            angle_defect_degrees: Some(faults.angle),
            facet_angle_degrees: Some(faults.crease),
            shear_degrees: Some(faults.shear),
            diagonal_stretch: Some(faults.diagonal),
            spine_off: Some(faults.spine),
            keeps_spine: Some(faults.spine < 1e-4),
        }
    }
}

/// A replay beside the live leaf that it repeats.
#[derive(Serialize)]
pub struct OfLive {
    /// Root mean square distance, the worst turn's, over the width.
    pub rms: f64,
    /// Longest distance, likewise.
    pub worst: f64,
    /// How many times cheaper a frame of it is.
    pub times_cheaper: f64,
}

impl OfLive {
    fn new(seen: &Seen, live: &Seen) -> Self {
        let pairs = seen.tracks.iter().zip(&live.tracks);
        let apart: Vec<Apart> = pairs.map(|(a, b)| Apart::new(a, b)).collect();
        OfLive {
            rms: apart.iter().map(|turn| turn.rms).fold(0.0, f64::max),
            worst: apart.iter().map(|turn| turn.worst).fold(0.0, f64::max),
            times_cheaper: median(live.times.clone()) / median(seen.times.clone()),
        }
    }
}

impl Figures {
    /// Those of what was seen of a way.
    pub fn new(way: &Way, seen: &Seen, reference: &Tracks, live: Option<&Seen>) -> Self {
        let pairs = seen.tracks.iter().zip(reference);
        let apart: Vec<Apart> = pairs.map(|(a, b)| Apart::new(a, b)).collect();
        let carried = { TurnBy::ALL.iter().zip(&apart) }.filter(|(by, _)| **by != TurnBy::LetGo);
        Figures {
            name: way.name,
            reference: way.is_reference(),
            us_per_frame: median(seen.times.clone()),
            bytes: seen.bytes,
            rms: (apart.iter().map(|turn| turn.rms.powi(2) / 3.0).sum::<f64>()).sqrt(),
            worst: apart.iter().map(|turn| turn.worst).fold(0.0, f64::max),
            worst_as_agree: carried
                .map(|(_, turn)| turn.worst_at_tenths)
                .fold(0.0, f64::max),
            faults: seen
                .faults
                .as_ref()
                .map(FaultFigures::of)
                .unwrap_or_default(),
            drag_miss: seen.misses.clone().map(median),
            drag_misses: seen.misses.clone(),
            of_live: live.map(|live| OfLive::new(seen, live)),
            turns: TurnBy::ALL
                .map(TurnBy::name)
                .into_iter()
                .zip(apart)
                .collect(),
        }
    }
}
