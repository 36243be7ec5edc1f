//! Leaves that are folded as people fold them, and what is done with them every day.

use std::fmt::{self, Display, Formatter};
use std::ops::Range;

use serde::Serialize;
use turnleaf_engine::{SheetCrease, Stock};

use super::act::{FLICK, carry};
use super::folded_figures::{FoldedFigures, Seen};
use super::open::{self, PAGES, STOCKS};
use super::reader::Reader;
use crate::gestures::random::Random;
use crate::table::Table;

/// Runs, unless another number is asked for.
pub const RUNS: usize = 300;

/// Every so many pictures it is measured how deep a leaf is drawn in itself.
const LOOKED_AT: usize = 3;

/// Frames between commands, and those in which a leaf that was folded comes down.
const SOON: u32 = 18;
const FOLDED: u32 = 60;

/// Sizes of a dog-ear, in page widths.
const EARS: [f32; 2] = [0.1, 0.35];

/// Angles at which folds rest that a finger has pressed, and a nail, degrees.
const PRESSED: f32 = 160.0;
const CREASED: f32 = 172.0;

/// What a leaf is folded as.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    /// With one corner, or both, turned in.
    DogEar,
    DogEars,
    /// In two, parallel to the spine.
    Half,
    /// In three, the outer part between the others.
    Letter,
    /// In two, and what is folded over once more, back.
    Quarter,
    /// To and fro, three times.
    Zigzag,
}

impl Shape {
    const ALL: [Shape; 6] = [
        Shape::DogEar,
        Shape::DogEars,
        Shape::Half,
        Shape::Letter,
        Shape::Quarter,
        Shape::Zigzag,
    ];

    fn name(self) -> &'static str {
        match self {
            Shape::DogEar => "dog-ear",
            Shape::DogEars => "two dog-ears",
            Shape::Half => "half",
            Shape::Letter => "letter",
            Shape::Quarter => "quarter",
            Shape::Zigzag => "zigzag",
        }
    }

    /// Its folds on a page of this width and height, metres, toward the recto (1) or the verso (-1).
    fn folds(
        self,
        random: &mut Random,
        stock: &Stock,
        page: [f64; 2],
        sign: f32,
    ) -> Vec<SheetCrease> {
        let line = |through: [[f32; 2]; 2], degrees: f32| {
            let rest = f64::from(sign * degrees).to_radians();
            SheetCrease::pressed(through.map(|at| at.map(f64::from)), rest, stock, page[0])
        };
        let along = |u: f32, degrees: f32| line([[u, 0.0], [u, 1.0]], degrees);
        let size = random.between(EARS[0], EARS[1]);
        let up = size * (page[0] / page[1]) as f32;
        let ear = |v: f32| line([[1.0 - size, v], [1.0, (v - up).abs()]], PRESSED);
        let off = random.between(-0.02, 0.02);
        match self {
            Shape::DogEar => vec![ear([0.0, 1.0][random.below(2) as usize])],
            Shape::DogEars => vec![ear(0.0), ear(1.0)],
            Shape::Half => vec![along(0.5 + off, PRESSED)],
            Shape::Letter => vec![along(0.37 + off, PRESSED), along(0.7 + off, CREASED)],
            Shape::Quarter => vec![along(0.5 + off, PRESSED), along(0.75 + off, -CREASED)],
            Shape::Zigzag => vec![
                along(0.34 + off, PRESSED),
                along(0.56 + off, -PRESSED),
                along(0.78 + off, PRESSED),
            ],
        }
    }
}

/// What is done with it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Deed {
    /// It is turned by command.
    Turn,
    /// It is turned, and back.
    TurnBack,
    /// A hand throws it over.
    Throw,
    /// The book is turned on by so many leaves.
    Jump(u32),
    /// It is folded in another way before the reader's eyes, and turned by command.
    FoldAgain,
}

impl Deed {
    const ALL: [Deed; 6] = [
        Deed::Turn,
        Deed::TurnBack,
        Deed::Throw,
        Deed::Jump(12),
        Deed::Jump(25),
        Deed::FoldAgain,
    ];

    fn name(self) -> &'static str {
        match self {
            Deed::Turn => "turned",
            Deed::TurnBack => "turned back",
            Deed::Throw => "thrown",
            Deed::Jump(12) => "jumped over by 12",
            Deed::Jump(_) => "jumped over by 25",
            Deed::FoldAgain => "folded again",
        }
    }

    /// Does what belongs before a frame, in a book that lay open at a spread. Returns whether it is
    /// not done yet.
    fn act(self, reader: &mut Reader, again: &[SheetCrease], spread: u32, frame: u32) -> bool {
        match self {
            Deed::Turn => reader.press(1),
            Deed::TurnBack => match frame {
                0 => reader.press(1),
                SOON => reader.press(-1),
                _ => {}
            },
            Deed::Throw => return carry(reader, frame, FLICK, 0.45),
            Deed::Jump(leaves) => reader.go_to(spread + leaves),
            Deed::FoldAgain => match frame {
                0 => reader.fold(again),
                FOLDED => reader.press(1),
                _ => {}
            },
        }
        let last = match self {
            Deed::TurnBack => SOON,
            Deed::FoldAgain => FOLDED,
            _ => 0,
        };
        frame < last
    }
}

/// A run, by its seed.
struct Run {
    seed: u64,
    shape: Shape,
    deed: Deed,
    stock: &'static str,
    page: (&'static str, [f64; 2]),
}

impl Run {
    fn names(&self) -> [&'static str; 4] {
        [self.shape.name(), self.deed.name(), self.stock, self.page.0]
    }

    /// Plays it until all lies at rest.
    fn play(&self, random: &mut Random) -> Seen {
        let page = self.page.1;
        let stock = Stock::named(self.stock).expect("it is a preset");
        let mut folds = |sign| self.shape.folds(random, &stock, page, sign);
        let right = folds(1.0);
        let left = folds(-1.0);
        let again = folds(1.0);
        let is_alone = random.once_in(2);
        let left = if is_alone { Vec::new() } else { left };
        let (book, leaves, first) = open::open(&[left, right], stock, page);
        let sides = page.map(|side| side as f32);
        let mut reader = Reader::new((book, leaves), sides, LOOKED_AT);
        let before = reader.in_itself_at_rest();
        let mut frame = 0;
        while self.deed.act(&mut reader, &again, first, frame) {
            reader.frame();
            frame += 1;
        }
        reader.come_to_rest();
        Seen {
            at_rest: before.max(reader.in_itself_at_rest()),
            watched: reader.into_watched(),
        }
    }
}

/// What was found: all, and by what runs are of.
#[derive(Serialize)]
pub struct Report {
    all: FoldedFigures,
    parts: Vec<(&'static str, FoldedFigures)>,
    /// Seeds of the runs that go deepest through themselves, what they are, and how deep in flight
    /// and at rest, millimetres.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    worst: Vec<(u64, String, [f32; 2])>,
}

impl Report {
    /// Plays the runs of seeds that are called so, and lists so many of the worst.
    ///
    /// # Errors
    /// Where no run is called so, in a sentence.
    pub fn of(seeds: Range<u64>, only: &[String], worst: usize) -> Result<Report, String> {
        let mut played: Vec<(Run, Seen)> = Vec::new();
        for seed in seeds {
            let random = &mut Random::new(seed);
            let mut below = |count: usize| random.below(count as u32) as usize;
            let run = Run {
                seed,
                shape: Shape::ALL[below(Shape::ALL.len())],
                deed: Deed::ALL[below(Deed::ALL.len())],
                stock: STOCKS[below(STOCKS.len())],
                page: PAGES[below(PAGES.len())],
            };
            if only.iter().all(|only| run.names().contains(&&only[..])) {
                let seen = run.play(random);
                played.push((run, seen));
            }
        }
        if played.is_empty() {
            return Err("No run is called so.".into());
        }
        let of = |is: &dyn Fn(&Run) -> bool| {
            FoldedFigures::of(played.iter().filter(|one| is(&one.0)).map(|one| &one.1))
        };
        let shapes = Shape::ALL.iter().map(|shape| shape.name());
        let deeds = Deed::ALL.iter().map(|deed| deed.name());
        let pages = PAGES.iter().map(|(name, _)| *name);
        let part = |name| (name, of(&|run| run.names().contains(&name)));
        let parts = shapes.chain(deeds).chain(STOCKS).chain(pages).map(part);
        let parts = parts.filter(|(_, figures)| figures.runs() > 0).collect();
        let all = of(&|_| true);
        played.sort_by(|a, b| b.1.deepest().total_cmp(&a.1.deepest()));
        let worst = played.iter().take(worst).map(|(run, seen)| {
            let depths = [seen.watched.itself, seen.at_rest].map(|depth| 1e3 * depth);
            (run.seed, run.names().join(", "), depths)
        });
        Ok(Report {
            all,
            parts,
            worst: worst.collect(),
        })
    }

    /// The table of them.
    pub fn table(&self) -> Table {
        let mut table = Table::new(&FoldedFigures::HEADINGS);
        table.push(self.all.row("all"));
        for (name, figures) in &self.parts {
            table.push(figures.row(name));
        }
        table
    }
}

impl Display for Report {
    fn fmt(&self, out: &mut Formatter) -> fmt::Result {
        self.table().fmt(out)?;
        for (seed, name, [flight, rest]) in &self.worst {
            writeln!(out, "  {seed:>8}  {flight:6.2}  {rest:6.2}  {name}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Plays the run of a seed, which is called so, and finds that it is not drawn through itself.
    fn is_clear(seed: u64, called: &str) {
        let report = Report::of(seed..seed + 1, &[], 1).expect("it is played");
        let (_, name, [in_flight, at_rest]) = &report.worst[0];
        assert_eq!(name, called);
        assert!(*in_flight < 0.5 && *at_rest < 0.1, "{in_flight} {at_rest}");
    }

    /// A page of bible paper, folded in two and turned by command, whose flap's end curls under it in
    /// the gutter.
    #[test]
    fn a_half_whose_end_curls_is_not_drawn_through_itself() {
        is_clear(14, "half, turned, bible, 140 x 210 mm");
    }

    /// A letter that is folded in other places, whose paper goes through itself as its end comes down: it
    /// is drawn as it was before that.
    #[test]
    fn a_letter_that_is_folded_again_is_not_drawn_through_itself() {
        is_clear(50, "letter, folded again, coated, 140 x 210 mm");
    }

    /// A jump over pages folded three times, which come to lie upon each other as packets. To move their
    /// layers apart took the work that the leaves over them needed, and two of three pictures were behind.
    #[test]
    fn leaves_that_fly_over_packets_are_drawn_where_their_paper_is() {
        let report = Report::of(36..37, &[], 1).expect("it is played");
        assert_eq!(
            report.worst[0].1,
            "zigzag, jumped over by 12, board, 210 x 297 mm"
        );
        let all = serde_json::to_value(&report.all).expect("they are figures");
        let behind = all["behind_percent"].as_f64().expect("it is a number");
        assert!(behind < 20.0, "{behind} % of the pictures are behind");
    }
}
