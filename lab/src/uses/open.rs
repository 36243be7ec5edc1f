//! The books that are read.

use turnleaf_engine::book::{Board, Book, Paper};
use turnleaf_engine::{SheetCrease, Side, Stock};

/// What leaves are made of.
pub const STOCKS: [&str; Stock::NAMES.len()] = Stock::NAMES;

/// Width and height of a page, metres: of a paperback, of a usual book, of a magazine.
pub const PAGES: [(&str, [f64; 2]); 3] = [
    ("105 x 148 mm", [0.105, 0.148]),
    ("140 x 210 mm", [0.140, 0.210]),
    ("210 x 297 mm", [0.210, 0.297]),
];

/// Leaves of a book, and the thickness that no book exceeds, metres.
const LEAVES: u32 = 120;
const THICKEST: f64 = 0.04;

/// How far a dog-ear's fold is from its corner along both edges, in page widths, and where a leaf is
/// folded in two.
const EAR: f64 = 0.2;
const HALF: f64 = 0.5;

/// Angle at which a fold rests that a finger has pressed, degrees.
const PRESSED: f64 = 160.0;

/// Ticks in which folds open to where they rest, at most.
const MOST_TO_OPEN: u32 = 600;

/// How the two leaves that lie open are folded; all others are whole.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Folded {
    /// Not at all.
    Whole,
    /// At the corner at the head, away from the spine.
    DogEared,
    /// In two, parallel to the spine.
    InTwo,
}

impl Folded {
    /// All of them.
    pub const ALL: [Folded; 3] = [Folded::Whole, Folded::DogEared, Folded::InTwo];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Folded::Whole => "whole",
            Folded::DogEared => "dog-eared",
            Folded::InTwo => "folded in two",
        }
    }

    /// Folds of the two leaves that lie open, left and right, onto the pages that are seen.
    pub fn folds(self, stock: &Stock, page: [f64; 2]) -> [Vec<SheetCrease>; 2] {
        [-1.0, 1.0].map(|sign| {
            let rest = sign * PRESSED.to_radians();
            let fold = |through| SheetCrease::pressed(through, rest, stock, page[0]);
            self.line(page).map(fold).into_iter().collect()
        })
    }

    /// Where its fold runs, by u and v.
    fn line(self, [width, height]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        match self {
            Folded::Whole => None,
            Folded::DogEared => Some([[1.0 - EAR, 1.0], [1.0, 1.0 - EAR * width / height]]),
            Folded::InTwo => Some([[HALF, 0.0], [HALF, 1.0]]),
        }
    }
}

/// Opens a book at its first quarter, whose two leaves that lie open, left and right, are folded.
/// Returns it, how many leaves it has, and how many of them are on the left.
pub fn open(folds: &[Vec<SheetCrease>; 2], stock: Stock, page: [f64; 2]) -> (Book, u32, u32) {
    let leaves = LEAVES.min((THICKEST / stock.caliper) as u32);
    let thickness = stock.caliper * f64::from(leaves);
    let mut book = Book::new(page[0], page[1], leaves, thickness).expect("these are a book's");
    *book.board_mut(0) = Board::new(Side::Left);
    let paper = Paper {
        stock,
        ..Paper::default()
    };
    assert!(book.set_paper(&paper), "these are a paper's figures");
    let first = leaves / 4;
    for (leaf, folds) in [first - 1, first].into_iter().zip(folds) {
        let is_folded = folds.is_empty() || book.crease(leaf, folds);
        assert!(is_folded, "the leaf is large enough");
    }
    book.lay(first);
    for _ in 0..MOST_TO_OPEN {
        if book.is_asleep() {
            break;
        }
        book.step(1);
    }
    book.update();
    (book, leaves, first)
}
