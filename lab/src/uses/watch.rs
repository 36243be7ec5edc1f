//! What is seen of a book while it is read.

use std::collections::HashMap;

use turnleaf_engine::book::Book;

use crate::gestures::overlap;

/// What is drawn farther than this from its paper is behind it, metres.
const BEHIND: f32 = 5e-3;

/// Paper that goes farther than this in a frame moves, metres; what is drawn of it stands still
/// where it goes less than such a part of that.
const MOVES: f32 = 5e-4;
const STILL: f32 = 0.1;

/// Part by which edges are stretched that are counted, and the least length of those looked at,
/// metres: next to the spine the distance that leaves are drawn apart is as much.
const STRETCHED: f32 = 0.2;
const LEAST_EDGE: f32 = 1e-3;

/// What a frame took.
#[derive(Default)]
pub struct Frame {
    /// Seconds of CPU.
    pub seconds: f64,
    /// Work as counted, about nanoseconds of native code.
    pub work: u32,
}

/// What was seen. Lengths are in metres.
#[derive(Default)]
pub struct Watched {
    /// Frames that were looked at.
    pub frames: usize,
    /// Frames in which some leaf is drawn more than 5 mm behind its paper.
    pub behind: usize,
    /// The farthest that a leaf is drawn behind its paper.
    pub farthest: f32,
    /// Most frames in a row in which one leaf stands still while its paper moves.
    pub still: u32,
    /// Frames in which an edge is drawn a fifth longer than it is.
    pub stretched: usize,
    /// How deep leaves are drawn in something.
    pub depth: f32,
    /// How deep one is drawn in itself.
    pub itself: f32,
    /// Most seconds of CPU of a frame.
    pub seconds: f64,
    /// Most work of a frame as counted, about nanoseconds.
    pub work: u32,
}

/// A leaf as it was in the last frame.
struct Before {
    drawn: Vec<f32>,
    paper: Vec<f32>,
    /// Frames for which it has stood still.
    still: u32,
}

/// Watches a book.
pub struct Watch {
    /// Every so many pictures it is measured how deep leaves are drawn in each other.
    looked_at: usize,
    before: HashMap<u32, Before>,
    /// What has been seen so far.
    pub watched: Watched,
}

impl Watch {
    /// Begins to watch; every so many pictures it is measured how deep leaves are drawn in each other.
    pub fn new(looked_at: usize) -> Watch {
        Watch {
            looked_at,
            before: HashMap::new(),
            watched: Watched::default(),
        }
    }

    /// Looks at a book whose pages have this width and height, metres, after a frame.
    pub fn look(&mut self, book: &Book, page: [f32; 2], frame: Frame) {
        let watched = &mut self.watched;
        watched.seconds = watched.seconds.max(frame.seconds);
        watched.work = watched.work.max(frame.work);
        watched.frames += 1;
        let leaves = || 0..book.drawn_leaves();
        let lags = leaves().filter_map(|index| book.lag(index));
        let lag = lags.fold(0.0, f32::max);
        watched.behind += usize::from(lag > BEHIND);
        watched.farthest = watched.farthest.max(lag);
        watched.stretched += usize::from(leaves().any(|index| is_stretched(book, index, page)));
        if watched.frames.is_multiple_of(self.looked_at) {
            let overlap = overlap::measure(book, page);
            watched.depth = watched.depth.max(overlap.deepest());
            watched.itself = watched.itself.max(overlap.itself);
        }
        let mut before = std::mem::take(&mut self.before);
        for index in leaves() {
            let (Some(id), Some(surface), Some(paper)) = (
                book.flight_id(index),
                book.surface(index),
                book.target(index),
            ) else {
                continue;
            };
            let known = before.remove(&id);
            let is_still = known.as_ref().is_some_and(|known| {
                let moved = farthest(&known.paper, paper);
                moved > MOVES && farthest(&known.drawn, &surface.positions) < STILL * moved
            });
            let still = known
                .filter(|_| is_still)
                .map_or(0, |known| known.still + 1);
            watched.still = watched.still.max(still);
            let now = Before {
                drawn: surface.positions.clone(),
                paper: paper.to_vec(),
                still,
            };
            self.before.insert(id, now);
        }
    }
}

/// How far the points of one are from those of the other, at most, metres.
fn farthest(from: &[f32], to: &[f32]) -> f32 {
    let pairs = from.as_chunks::<3>().0.iter().zip(to.as_chunks::<3>().0);
    pairs.map(|(a, b)| distance(*a, *b)).fold(0.0, f32::max)
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    let square: f32 = (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum();
    square.sqrt()
}

/// Whether an edge of what is drawn of a leaf is a fifth longer than it is on the paper.
fn is_stretched(book: &Book, index: usize, [width, height]: [f32; 2]) -> bool {
    let Some(surface) = book.surface(index) else {
        return false;
    };
    let (columns, rows) = (surface.columns, surface.rows);
    let points = surface.positions.as_chunks::<3>().0;
    let creased = book.paper_mesh(index);
    let flat = |node: usize| match creased {
        Some(mesh) => [
            mesh.places[node][0] * width,
            mesh.places[node][1] * height,
            0.0,
        ],
        None => {
            let v = (node / columns) as f32 / (rows - 1) as f32;
            [book.columns()[node % columns] * width, v * height, 0.0]
        }
    };
    (0..points.len()).any(|node| {
        let (is_last_column, is_last_row) =
            ((node + 1) % columns == 0, node + columns >= points.len());
        [(1, is_last_column), (columns, is_last_row)]
            .into_iter()
            .any(|(step, is_none)| {
                if is_none {
                    return false;
                }
                let length = distance(flat(node), flat(node + step));
                let drawn = distance(points[node], points[node + step]);
                length > LEAST_EDGE && drawn > (1.0 + STRETCHED) * length
            })
    })
}
