//! Random folds of a page: its corners, in two, along slanted lines, as a letter.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use turnleaf_engine::{SheetCrease, Stock};

use super::random::Random;

/// Sizes of a dog-ear, in page widths, and the angle at which it rests, degrees: the viewer's.
const CORNERS: [f32; 2] = [0.05, 0.5];
const CORNER_RESTS: f32 = 160.0;

/// Places that are tried for one that lies beyond a crease.
const TRIES: usize = 60;

/// How leaves are folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fold {
    /// One or both of the corners away from the spine.
    DogEar,
    /// Along a line parallel to the spine.
    InTwo,
    /// Along a line at any angle that does not meet the spine.
    Slanted,
    /// Along two lines parallel to the spine, the outer part between the others.
    Letter,
    /// Any of these, each leaf another.
    Mixed,
}

impl Fold {
    /// All of them.
    pub const ALL: [Fold; 5] = [
        Fold::DogEar,
        Fold::InTwo,
        Fold::Slanted,
        Fold::Letter,
        Fold::Mixed,
    ];

    /// Their names, in the same order.
    pub const NAMES: [&str; 5] = ["dog-ears", "in two", "slanted", "letter", "mixed"];

    /// Its name.
    pub fn name(self) -> &'static str {
        Fold::NAMES[self as usize]
    }

    /// Random creases of a leaf of a stock, whose pages have this width and height, metres.
    pub fn lines(self, random: &mut Random, stock: &Stock, page: [f64; 2]) -> Vec<SheetCrease> {
        let sign = [-1.0, 1.0][random.below(2) as usize];
        let line = |through: [[f32; 2]; 2], degrees: f32| {
            let through = through.map(|place| place.map(f64::from));
            SheetCrease::pressed(
                through,
                f64::from(sign * degrees).to_radians(),
                stock,
                page[0],
            )
        };
        match self {
            Fold::DogEar => {
                let corners = match random.below(5) {
                    0 => vec![0.0, 1.0],
                    1 | 2 => vec![0.0],
                    _ => vec![1.0],
                };
                let size = random.between(CORNERS[0], CORNERS[1]);
                let up = (size * (page[0] / page[1]) as f32).min(0.5);
                let corner = |v: f32| {
                    let to = if v > 0.5 { 1.0 - up } else { up };
                    line([[1.0 - size, v], [1.0, to]], CORNER_RESTS)
                };
                corners.into_iter().map(corner).collect()
            }
            Fold::InTwo => {
                let u = random.between(0.3, 0.85);
                vec![line([[u, 0.0], [u, 1.0]], angle(random))]
            }
            Fold::Slanted => {
                let u = random.between(0.3, 0.95);
                let through = if random.once_in(2) {
                    [[u, 0.0], [random.between(0.3, 0.95), 1.0]]
                } else {
                    let v = random.between(0.1, 0.9);
                    let end = [0.0, 1.0][random.below(2) as usize];
                    [[u, end], [1.0, v]]
                };
                vec![line(through, angle(random))]
            }
            Fold::Letter => {
                let inner = random.between(0.35, 0.45);
                // The outer part is no wider than the middle one.
                let outer = 0.5 * (1.0 + inner) + random.between(0.0, 0.08);
                let along = |u: f32, degrees: f32| line([[u, 0.0], [u, 1.0]], degrees);
                vec![along(inner, 160.0), along(outer, 175.0)]
            }
            Fold::Mixed => Fold::ALL[random.below(4) as usize].lines(random, stock, page),
        }
    }
}

/// An angle at which a fold rests, degrees: mostly shut, and shallow once in four times.
fn angle(random: &mut Random) -> f32 {
    if random.once_in(4) {
        random.between(20.0, 90.0)
    } else {
        random.between(120.0, 180.0)
    }
}

/// Folds. clap takes no `Vec` itself for a value.
pub type Folds = Vec<Fold>;

/// A parser of folds: one or `all`.
pub fn folds() -> impl TypedValueParser<Value = Folds> {
    PossibleValuesParser::new(Fold::NAMES.into_iter().chain(["all"])).map(|name| {
        let is_chosen = |fold: &Fold| name == "all" || name == fold.name();
        Fold::ALL.into_iter().filter(is_chosen).collect()
    })
}

/// A random place (u and v) beyond one of the creases as seen from the spine; None where none
/// is found, as beyond small corners.
pub fn place_beyond(
    creases: &[SheetCrease],
    random: &mut Random,
    page: [f64; 2],
) -> Option<[f32; 2]> {
    (0..TRIES).find_map(|_| {
        let place = [random.between(0.3, 1.0), random.between(0.0, 1.0)];
        let is_beyond = |crease: &SheetCrease| is_beyond(crease, place.map(f64::from), page);
        creases.iter().any(is_beyond).then_some(place)
    })
}

/// Whether a place (u and v) lies beyond a crease as seen from the middle of the spine.
fn is_beyond(crease: &SheetCrease, place: [f64; 2], [width, height]: [f64; 2]) -> bool {
    let [a, b] = crease.through.map(|[u, v]| [u * width, v * height]);
    let side =
        |[u, v]: [f64; 2]| (b[0] - a[0]) * (v * height - a[1]) - (b[1] - a[1]) * (u * width - a[0]);
    side(place) * side([0.0, 0.5]) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use turnleaf_engine::book::Book;

    const PAGE: [f64; 2] = [0.14, 0.21];

    /// Of a hundred folds of each kind of a page nearly all can be made, and whole is what lies
    /// next to the spine.
    #[test]
    fn folds_of_every_kind_are_made_of_a_page() {
        for fold in Fold::ALL {
            let mut random = Random::new(5);
            let mut book = Book::new(PAGE[0], PAGE[1], 1, 1e-4).expect("a book's figures");
            let made = (0..30).filter(|_| {
                let lines = fold.lines(&mut random, &Stock::BOOK, PAGE);
                let spine = |line: &SheetCrease| is_beyond(line, [0.01, 0.5], PAGE);
                assert!(!lines.iter().any(spine), "{lines:?}");
                if let Some(place) = place_beyond(&lines, &mut random, PAGE) {
                    assert!(
                        lines
                            .iter()
                            .any(|l| is_beyond(l, place.map(f64::from), PAGE))
                    );
                }
                book.crease(0, &lines)
            });
            let made = made.count();
            assert!(made >= 21, "{}: {made}", fold.name());
        }
    }
}
