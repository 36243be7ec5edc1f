//! Scenes that benches, golden tests and the lab share, so that what is timed
//! in the browser, timed in native code and compared bit by bit is the same.

use crate::book::{Board, Book};
use crate::grid::Side;
use crate::hash::BitHash;
use crate::loose::{LooseLeaf, LooseSettings, TurnBy};
use crate::models::ModelKind;
#[cfg(feature = "creases")]
use crate::models::sheet::SheetCrease;
use crate::models::sheet::{Sheet, SheetSettings};
use crate::stock::{GRAVITY, Stock};
use crate::surface::Surface;
use crate::turn::{TurnModel, turn_hash};

/// Size of the page in all of them, metres: A5.
pub const PAGE: [f64; 2] = [0.148, 0.210];

/// A sheet clamped level, about to hang under its own weight, whose weight over
/// stiffness is `gamma` and whose Poisson ratio is 0, as the exact solutions of
/// a heavy strip want it.
///
/// # Panics
/// If the nodes or `gamma` are beyond what a sheet may have.
pub fn hanging(columns: usize, rows: usize, gamma: f64) -> Sheet {
    let d = Stock::BOOK.grammage * GRAVITY * PAGE[0] * PAGE[0] * PAGE[0] / gamma;
    let stock = Stock {
        stiffness_along: d,
        stiffness_across: d,
        poisson: 0.0,
        ..Stock::BOOK
    };
    let settings = SheetSettings {
        columns,
        rows,
        ..SheetSettings::leaf(PAGE[0], PAGE[1], stock)
    };
    Sheet::new(settings).expect("nodes and gamma make a sheet")
}

/// Lets a sheet come to rest, slowed by more than air would, in which it swings
/// for half a minute. Its shape at rest is as it is without.
pub fn settle(sheet: &mut Sheet) {
    let h = sheet.time_step();
    let mut quiet = 0;
    for _ in 0..(20.0 / h) as usize {
        sheet.step();
        sheet.slow(1.0 - 4.0 * h);
        quiet = if sheet.greatest_speed() < 1e-4 {
            quiet + 1
        } else {
            0
        };
        if quiet == 100 {
            break;
        }
    }
}

/// Reach and drop of the middle of a sheet's fore-edge over its width.
pub fn tip(sheet: &Sheet) -> [f64; 2] {
    let (columns, rows) = sheet.grid_size();
    let width = sheet.settings().width;
    let at = 3 * (rows / 2 * columns + columns - 1);
    let x = &sheet.positions()[at..at + 3];
    [f64::from(x[0]) / width, -f64::from(x[2]) / width]
}

/// A leaf of book paper whose corner a hand has drawn to the middle of its way
/// over, drawn at 49 x 25 points as a viewer's is.
///
/// # Panics
/// If the nodes are beyond what a sheet may have.
pub fn mid_turn(columns: usize, rows: usize) -> Sheet {
    let settings = SheetSettings {
        columns,
        rows,
        ..SheetSettings::leaf(PAGE[0], PAGE[1], Stock::BOOK)
    };
    carried(Sheet::new(settings).expect("the nodes make a sheet"))
}

/// The same of a leaf as a book has it, creased across two corners and once from edge to
/// edge, or as many of these as `creases` says.
///
/// # Panics
/// Never: a book's leaf can be creased so.
#[cfg(feature = "creases")]
pub fn creased(creases: usize) -> Sheet {
    let settings = crate::book::Paper::default().sheet(PAGE);
    let mut sheet = Sheet::new(settings).expect("a book's paper makes a sheet");
    let line = |through, rest| SheetCrease {
        through,
        rest,
        stiffness: 6.0 * Stock::BOOK.stiffness_across / PAGE[0],
        yields: 0.2,
        creep: 0.0,
    };
    let lines = [
        line([[0.7, 0.0], [1.0, 0.2]], 2.5),
        line([[0.75, 1.0], [1.0, 0.85]], -1.0),
        line([[0.0, 0.45], [1.0, 0.6]], 0.3),
    ];
    sheet
        .crease(&lines[..creases.min(lines.len())])
        .expect("there is room for these creases");
    carried(sheet)
}

/// A leaf whose corner a hand has drawn to the middle of its way over.
fn carried(mut sheet: Sheet) -> Sheet {
    let samples =
        |count: usize| -> Vec<f32> { (0..count).map(|i| i as f32 / (count - 1) as f32).collect() };
    sheet.draw_samples(&samples(49), &samples(25));
    sheet.grab(0, 1.0, 0.0);
    let steps = (0.5 / sheet.time_step()) as usize;
    for step in 0..steps {
        let (sin, cos) = libm::sincosf(1.8 * step as f32 / steps as f32);
        sheet.pull(0, [0.14 * cos, 0.02, 0.14 * sin]);
        sheet.step();
    }
    sheet
}

/// Hash of all bits of a second of a model's leaf of book paper, which a hand
/// turns by the corner; a shell of few nodes.
///
/// # Panics
/// Never: every model makes a leaf of these settings.
pub fn loose_hash(kind: ModelKind) -> u64 {
    let mut settings = LooseSettings::leaf(kind, PAGE, Stock::BOOK);
    if kind == ModelKind::Shell {
        settings.nodes = Some([7, 5]);
        settings.time_step = Some(1.0 / 120.0);
    }
    settings.interpolate = true;
    let mut leaf = LooseLeaf::new(settings).expect("these are a leaf's settings");
    leaf.play(TurnBy::Corner, Side::Right, 0.8);
    let steps = libm::round(1.0 / f64::from(leaf.time_step()));
    turn_hash(&mut leaf, steps as usize)
}

/// A frame at 60 Hz of a sheet: as many steps as it has, its surface and normals.
pub fn frame(sheet: &mut Sheet, surface: &mut Surface) {
    let steps = libm::roundf(1.0 / (60.0 * sheet.time_step())) as usize;
    for _ in 0..steps {
        sheet.step();
    }
    sheet.write_surface(surface);
    surface.update_normals();
}

/// A thumb that lets the leaves of a book go, one after another.
pub struct Riffle {
    book: Book,
    next: u32,
    most: usize,
}

impl Riffle {
    /// A book of `stock` with as many leaves in flight as there will be from
    /// then on, `most`.
    ///
    /// # Panics
    /// If the stock is none.
    pub fn new(stock: Stock, most: usize) -> Riffle {
        let mut book = Book::new(PAGE[0], PAGE[1], 4000, 0.016).expect("these are a book's sizes");
        book.set_paper(&crate::book::Paper {
            stock,
            ..Default::default()
        });
        *book.board_mut(0) = Board::new(Side::Left);
        book.lay(1000);
        let next = 1000;
        let mut riffle = Riffle { book, next, most };
        for _ in 0..120 {
            riffle.frame();
        }
        riffle
    }

    /// A frame at 60 Hz: leaves are let go so that the same number flies, and
    /// all are stepped and drawn.
    pub fn frame(&mut self) {
        if self.book.flights() < self.most
            && let Some(id) = self.book.pick_up(Side::Right, self.next, self.next + 1)
        {
            self.book.play(id, Side::Left, 0.6);
            self.next += 1;
        }
        if self.next > 3900 {
            self.next = 1000;
            self.book.lay(self.next);
        }
        self.book.step(2);
        self.book.update();
    }

    /// The book.
    pub fn book(&self) -> &Book {
        &self.book
    }
}

/// Hash of all bits drawn in a second of a riffle of six leaves, the first of
/// which is caught and pulled about by two grabs.
///
/// None where there is no stock of that name.
pub fn riffle_hash(stock: &str) -> Option<u64> {
    let mut riffle = Riffle::new(Stock::named(stock)?, 6);
    let mut hash = BitHash::new();
    for frame in 0..60 {
        if frame == 10
            && let Some(id) = riffle.book.flight_id(3)
        {
            riffle.book.grab(id, 0, 1.0, 0.1);
            riffle.book.grab(id, 1, 0.8, 0.9);
            riffle.book.hold(id, 0, [0.3, -0.2, 0.2]);
            riffle.book.hold(id, 1, [-0.1, 0.3, 0.05]);
        }
        riffle.frame();
        for index in 0..riffle.book.flights() {
            if let Some(surface) = riffle.book.surface(index) {
                hash.floats(&surface.positions);
                hash.floats(&surface.normals);
            }
        }
    }
    Some(hash.value())
}
