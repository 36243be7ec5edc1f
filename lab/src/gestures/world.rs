//! The book that a gesture is played on: its page, its paper, its air, and how its
//! frames come.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::Serialize;
use turnleaf_engine::book::{Board, Book, Paper};
use turnleaf_engine::{Grain, Side, Stock};

use super::folding::{Fold, Folds};
use super::random::Random;

/// The page of most tests, metres. Distances are reported as if every page were as wide.
pub const USUAL: [f64; 2] = [0.14, 0.21];

/// Least and greatest side of a page, metres, and the greatest ratio of its sides.
const SIDES: [f32; 2] = [0.02, 2.0];
const RATIO: f32 = 4.0;

/// One gesture of so many is a riffle, as it takes the time of twenty others.
const RIFFLES: u32 = 30;

/// Names of what leaves are made of: the presets; custom figures as of paper that
/// is made; and any figures that a book takes.
pub const STOCKS: [&str; Stock::NAMES.len() + 1] = {
    let mut names = ["extreme"; Stock::NAMES.len() + 1];
    let mut k = 0;
    // All but board.
    while k + 1 < Stock::NAMES.len() {
        names[k] = Stock::NAMES[k];
        k += 1;
    }
    names[k] = "custom";
    names
};

/// What pointers do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// One or two pointers drag, throw and tear; turns are played between.
    Hands,
    /// Up to 16 leaves are let go one after another, and now and then one is caught.
    Riffle,
    /// Pointers that are elsewhere in every frame.
    Teleport,
    /// Pointers that go round in circles.
    Circle,
    /// A pointer holds a place still while another pulls.
    Pin,
    /// Pointers pull one leaf apart.
    Apart,
    /// Any of these beside each other.
    Mixed,
}

impl Kind {
    /// All of them.
    pub const ALL: [Kind; 7] = [
        Kind::Hands,
        Kind::Riffle,
        Kind::Teleport,
        Kind::Circle,
        Kind::Pin,
        Kind::Apart,
        Kind::Mixed,
    ];

    /// Their names, in the same order.
    pub const NAMES: [&str; 7] = [
        "hands", "riffle", "teleport", "circle", "pin", "apart", "mixed",
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Kind::NAMES[self as usize]
    }
}

/// How frames come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// Two ticks each, or, as the gesture has it, 0 to 12.
    Usual,
    /// One tick each.
    Quick,
    /// Up to a second each, in one of ten.
    Halting,
    /// Up to a second each.
    Slow,
}

/// Where a gesture takes place.
pub struct World {
    /// What its pointers do.
    pub kind: Kind,
    /// Width and height of the page, metres.
    pub page: [f64; 2],
    /// How its frames come.
    pub pace: Pace,
    /// How its leaves are folded; None where they are whole.
    pub fold: Option<Fold>,
    paper: Paper,
}

/// Stocks by their place among [`STOCKS`]. clap takes no `Vec` itself for a value.
pub type Stocks = Vec<usize>;

/// A parser of stocks: one, `presets` or `all`.
pub fn stocks() -> impl TypedValueParser<Value = Stocks> {
    let names = STOCKS.into_iter().chain(["presets", "all"]);
    PossibleValuesParser::new(names).map(|name| match &name[..] {
        "all" => (0..STOCKS.len()).collect(),
        "presets" => (0..STOCKS.len() - 2).collect(),
        name => { STOCKS.iter().position(|one| *one == name) }
            .into_iter()
            .collect(),
    })
}

/// Kinds of gestures.
pub type Kinds = Vec<Kind>;

/// A parser of kinds: one or `all`.
pub fn kinds() -> impl TypedValueParser<Value = Kinds> {
    PossibleValuesParser::new(Kind::NAMES.into_iter().chain(["all"])).map(|name| {
        let is_chosen = |kind: &Kind| name == "all" || name == kind.name();
        Kind::ALL.into_iter().filter(is_chosen).collect()
    })
}

/// Which gestures are played.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Stocks, in turn.
    pub stocks: Stocks,
    /// Kinds, at random; a riffle is rare.
    pub kinds: Kinds,
    /// Whether pages, air, binding and frames are the usual ones.
    pub is_usual: bool,
    /// How leaves are folded, in turn; None where they are whole.
    pub folds: Option<Folds>,
}

/// A world in figures.
#[derive(Serialize)]
pub struct Description {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    folds: Option<&'static str>,
    page_mm: [f64; 2],
    frames: String,
    grammage: f64,
    caliper: f64,
    stiffness_along: f64,
    stiffness_across: f64,
    grain: String,
    binding: f64,
    wind: [f64; 3],
}

impl World {
    /// The world of a seed with leaves of a stock.
    pub fn new(seed: u64, stock: usize, choice: &Choice) -> World {
        // Numbers of its own, so that the pointers of a seed are the same in any world.
        let mut random = Random::new(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x9e6c_63d0);
        let kind = kind(
            &choice.kinds,
            random.below(RIFFLES * Kind::ALL.len() as u32),
        );
        let stock = stock_of(stock, &mut random);
        let paper = Paper {
            stock,
            ..Paper::default()
        };
        // In turn with the stocks, so that each is folded in every way.
        let turn = (seed / choice.stocks.len() as u64) as usize;
        let fold = { choice.folds.as_ref() }.map(|folds| folds[turn % folds.len()]);
        if choice.is_usual {
            return World {
                kind,
                page: USUAL,
                pace: Pace::Usual,
                fold,
                paper,
            };
        }
        World {
            kind,
            page: page(&mut random),
            pace: match random.below(6) {
                0 => Pace::Quick,
                1 => Pace::Halting,
                2 => Pace::Slow,
                _ => Pace::Usual,
            },
            fold,
            paper: Paper {
                grain: match random.below(4) {
                    0 => Grain::AcrossSpine,
                    _ => Grain::AlongSpine,
                },
                binding: match random.below(3) {
                    0 => paper.binding,
                    1 => [0.0, 1.0][random.below(2) as usize],
                    _ => f64::from(random.spread(1e-4, 1.0)),
                },
                wind: wind(&mut random),
                ..paper
            },
        }
    }

    /// What it is, for people.
    pub fn describe(&self) -> Description {
        let Paper {
            stock,
            grain,
            binding,
            wind,
            ..
        } = self.paper;
        Description {
            kind: self.kind.name(),
            folds: self.fold.map(Fold::name),
            page_mm: self.page.map(|side| 1e3 * side),
            frames: format!("{:?}", self.pace).to_lowercase(),
            grammage: stock.grammage,
            caliper: stock.caliper,
            stiffness_along: stock.stiffness_along,
            stiffness_across: stock.stiffness_across,
            grain: format!("{grain:?}"),
            binding,
            wind,
        }
    }

    /// Opens the book somewhere, also at its first and its last leaf.
    pub fn open(&self, random: &mut Random) -> Opened {
        let leaves = match self.kind {
            Kind::Riffle => [24, 40, 100, 300][random.below(4) as usize],
            _ => [1, 2, 8, 40, 100, 300][random.below(6) as usize],
        };
        let thickness = random.between(0.5e-4, 1.2e-4) * leaves as f32;
        let paper = Paper {
            assist: !random.once_in(8),
            ..self.paper
        };
        let mut opened = Opened {
            book: self.bind(leaves, f64::from(thickness), &paper),
            leaves,
            thickness: f64::from(thickness),
        };
        opened.book.lay(match random.below(4) {
            0 => 0,
            1 => leaves,
            _ => random.below(leaves + 1),
        });
        opened
    }

    /// Binds a book of leaves of a paper, that are so thick together, metres.
    fn bind(&self, leaves: u32, thickness: f64, paper: &Paper) -> Book {
        let [width, height] = self.page;
        let mut book = Book::new(width, height, leaves, thickness).expect("these are a book's");
        *book.board_mut(0) = Board::new(Side::Left);
        assert!(book.set_paper(paper), "these are a paper's figures");
        book
    }
}

/// An open book.
pub struct Opened {
    /// The book, as the engine has it.
    pub book: Book,
    /// Its leaves of paper, and how thick these are together, metres.
    pub leaves: u32,
    thickness: f64,
}

impl Opened {
    /// Binds the book anew without a leaf, and lays it open where that was.
    pub fn bind_without(&mut self, leaf: u32, world: &World) {
        let left = self.leaves - 1;
        self.thickness *= f64::from(left) / f64::from(self.leaves);
        self.leaves = left;
        let paper = *self.book.paper();
        self.book = world.bind(self.leaves, self.thickness, &paper);
        self.book.lay(leaf);
    }
}

/// One of some kinds by a random number; where others may be played a riffle is rare.
fn kind(kinds: &[Kind], number: u32) -> Kind {
    let others: Vec<Kind> = { kinds.iter().copied() }
        .filter(|kind| *kind != Kind::Riffle)
        .collect();
    let is_riffle = number.is_multiple_of(RIFFLES) && kinds.contains(&Kind::Riffle);
    if others.is_empty() || is_riffle {
        return Kind::Riffle;
    }
    others[number as usize % others.len()]
}

/// Half of the pages are about as large as pages are; the others have any size.
fn page(random: &mut Random) -> [f64; 2] {
    if random.once_in(6) {
        return USUAL;
    }
    let (low, high, most) = if random.once_in(3) {
        (0.1, 0.3, 1.6)
    } else {
        (SIDES[0], SIDES[1], RATIO)
    };
    let size = random.spread(low, high);
    let ratio = random.spread(1.0 / most, most).sqrt();
    [size * ratio, size / ratio].map(|side| f64::from(side.clamp(SIDES[0], SIDES[1])))
}

/// Half of all books lie in still air; a gust may have any speed that a book takes.
fn wind(random: &mut Random) -> [f64; 3] {
    let most = match random.below(6) {
        0 => 1.0,
        1 => 4.0,
        2 => 20.0,
        _ => return [0.0; 3],
    };
    core::array::from_fn(|_| f64::from(random.between(-most, most)))
}

fn stock_of(name: usize, random: &mut Random) -> Stock {
    match STOCKS[name] {
        // Of 25 to 400 g/m^2, 0.5 to 1.3 g/cm^3 and 1 to 6 GPa across the grain.
        "custom" => {
            let grammage = f64::from(random.spread(0.025, 0.4));
            let caliper = grammage / f64::from(random.between(500.0, 1300.0));
            let across = f64::from(random.spread(1e9, 6e9)) * caliper * caliper * caliper / 12.0;
            let ratio = f64::from(random.between(1.0, 3.5));
            let stock = Stock::new(grammage, caliper, ratio * across, across);
            stock.expect("these are figures of paper")
        }
        // The bounds of each figure are those of `Stock::check`.
        "extreme" => {
            let mut figure = |low: f32, high: f32| match random.below(6) {
                0 => f64::from(low),
                1 => f64::from(high),
                _ => f64::from(random.spread(low, high)),
            };
            let [grammage, caliper] = [figure(1e-3, 5.0), figure(1e-6, 0.01)];
            let [along, across] = [figure(1e-8, 10.0), figure(1e-8, 10.0)];
            Stock {
                grammage: grammage.clamp(1e-3, 5.0),
                caliper: caliper.clamp(1e-6, 0.01),
                stiffness_along: along.clamp(1e-8, 10.0),
                stiffness_across: across.clamp(1e-8, 10.0),
                ..Stock::BOOK
            }
        }
        name => Stock::named(name).expect("the name is a preset's"),
    }
}
