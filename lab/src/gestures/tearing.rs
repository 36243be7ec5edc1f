//! A leaf that a random pointer tears out of a book, carries and drops, and how it fares.

use turnleaf_engine::Side;
use turnleaf_engine::book::{Book, TableAround, TearLine, TornLeaf};

use super::facets::Facets;
use super::overlap::{inside_itself, within};
use super::random::Random;
use super::triangle::Point;

/// The table under a book with boards, and how far these reach beyond the pages, metres.
const AROUND: TableAround = TableAround {
    table: -0.004,
    rim: 0.003,
};

/// Rows of nodes of a leaf.
const ROWS: usize = 14;

/// The grab of the book that holds the leaf meanwhile.
pub const GRAB: u32 = 3;

/// What the work of tearing follows from: J/m^2, the part of a perforated line that is paper, and
/// how much paper two staples hold, metres. Typical of paper: docs/reports/folding.md.
const FRACTURE: f64 = 1e4;
const TIES: f64 = 0.3;
const STAPLES: f64 = 0.024;

/// Ticks for which a pointer pulls, at most; then what holds is cut or let go.
const LONGEST_PULL: u32 = 240;

/// Ticks of a sheet in a frame, at most, as of the viewer.
const MOST_TICKS: u32 = 12;

/// Ticks after which a sheet that was let go is left as it lies.
const LEFT: u32 = 480;

/// What was done to torn leaves and what they did. Lengths are in metres on a page 140 mm wide.
#[derive(Clone, Copy, Debug, Default)]
pub struct Torn {
    /// Leaves that came off by the pull.
    pub off: u32,
    /// Leaves that were cut.
    pub cut: u32,
    /// Largest edge strain after any tick.
    pub strain: f32,
    /// Deepest drawn inside pages, boards or the table.
    pub pile: f32,
    /// Deepest drawn inside itself.
    pub itself: f32,
    /// Pictures of a loose sheet.
    pub pictures: u32,
    /// Those of them in which it goes through a leaf.
    pub through: u32,
    /// How far the work of tearing was from that of the paper which held, at most, as a part
    /// of it.
    pub work_off: f64,
    /// Sheets that lay still by themselves.
    pub still: u32,
    /// Sheets that were left as they lay.
    pub left: u32,
}

/// What the pointer does to the sheet.
enum Motion {
    /// It pulls the leaf of a flight away, so far a tick, metres.
    Tears { flight: u32, away: Point },
    /// It carries the loose sheet to a place, by at most so much a tick, metres.
    Carries { to: Point, speed: f32 },
    /// It has let go.
    Released,
}

/// What a frame did to a leaf that is being torn.
pub enum Event {
    /// It holds, or is loose.
    None,
    /// It is off: the leaf of this flight is no longer the book's.
    Off(u32),
    /// The pointer gave up: it is bound as before.
    GivenUp(u32),
}

/// A leaf that a pointer tears out.
pub struct Tear {
    leaf: TornLeaf,
    line: TearLine,
    motion: Motion,
    at: Point,
    /// Ticks of what the pointer does now, and those for which it does.
    ticks: u32,
    lasting: u32,
    scale: f32,
}

impl Tear {
    /// Begins to tear the leaf of a flight that lay on a side; None where it is folded, or is none.
    pub fn begin(book: &mut Book, flight: u32, side: Side, random: &mut Random) -> Option<Tear> {
        let index = (0..book.drawn_leaves()).find(|k| book.flight_id(*k) == Some(flight))?;
        if book.paper_mesh(index).is_some() || book.leaves(index) != Some(1) {
            return None;
        }
        let lines = [TearLine::Sewn, TearLine::Stapled, TearLine::Perforated];
        let line = lines[random.below(3) as usize];
        let (u, v) = (random.between(0.3, 1.0), random.between(0.0, 1.0));
        book.grab(flight, GRAB, u, v);
        let mut leaf = TornLeaf::tear(book, flight, line, 0..ROWS, AROUND)?;
        leaf.grab(0, u, v);
        let [width, height] = book.size().map(|side| side as f32);
        let pile = book.pile(side);
        let floor = pile.height_and_slope(u * width, pile.column_before(u * width, 0));
        let speed = random.spread(0.2, 3.0) * width / 120.0;
        let way = [
            side.sign() * random.between(0.3, 1.0),
            random.between(-0.7, 0.7),
            random.between(0.1, 1.0),
        ];
        Some(Tear {
            leaf,
            line,
            motion: Motion::Tears {
                flight,
                away: way.map(|x| speed * x),
            },
            at: [side.sign() * u * width, v * height, floor.0],
            ticks: 0,
            lasting: LONGEST_PULL,
            scale: 0.14 / width,
        })
    }

    /// Whether it moves or is held.
    pub fn moves(&self) -> bool {
        !matches!(self.motion, Motion::Released) || !self.leaf.is_asleep()
    }

    /// The flight that it still is; None once it is off.
    pub fn flight(&self) -> Option<u32> {
        match self.motion {
            Motion::Tears { flight, .. } => Some(flight),
            _ => None,
        }
    }

    /// Whether it is loose and over the pages, where the viewer would put it aside.
    pub fn lies_over(&self, book: &Book) -> bool {
        let [width, height] = book.size().map(|side| side as f32);
        let points = self.leaf.surface().positions.as_chunks::<3>().0;
        let reach = |axis: usize| {
            let all = points.iter().map(|point| point[axis]);
            all.fold([f32::MAX, f32::MIN], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        };
        let ([left, right], [foot, head]) = (reach(0), reach(1));
        let meets = left < width && right > -width && foot < height && head > 0.0;
        self.flight().is_none() && meets
    }

    /// The pointer lets go, of a leaf that is not off too.
    pub fn release(&mut self) -> Event {
        self.leaf.release();
        let event = match self.motion {
            Motion::Tears { flight, .. } => Event::GivenUp(flight),
            _ => Event::None,
        };
        (self.motion, self.ticks) = (Motion::Released, 0);
        event
    }

    /// Moves the pointer, steps and draws what it holds by a frame of `ticks`.
    pub fn step(
        &mut self,
        book: &mut Book,
        ticks: u32,
        random: &mut Random,
        torn: &mut Torn,
    ) -> Event {
        let was_falling = self.moves();
        for _ in 0..ticks.min(MOST_TICKS) {
            self.ticks += 1;
            self.move_pointer(book);
            self.leaf.step(book, 1);
            torn.strain = torn.strain.max(self.leaf.sheet().max_edge_strain());
            if self.flight().is_some() && self.leaf.bound().is_empty() {
                break;
            }
        }
        let event = self.go_on(book, random, torn);
        self.leaf.update(book);
        if was_falling && !self.moves() {
            let left = u32::from(self.ticks >= LEFT);
            torn.left += left;
            torn.still += 1 - left;
        }
        event
    }

    fn move_pointer(&mut self, book: &mut Book) {
        match self.motion {
            Motion::Tears { flight, away } => {
                self.at = core::array::from_fn(|axis| self.at[axis] + away[axis]);
                book.hold(flight, GRAB, self.at);
            }
            Motion::Carries { to, speed } => {
                let way: Point = core::array::from_fn(|axis| to[axis] - self.at[axis]);
                let far = way.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-9);
                let part = (speed / far).min(1.0);
                self.at = core::array::from_fn(|axis| self.at[axis] + part * way[axis]);
            }
            Motion::Released => return,
        }
        self.leaf.pull(0, self.at);
    }

    /// Goes on to what the pointer does next.
    fn go_on(&mut self, book: &Book, random: &mut Random, torn: &mut Torn) -> Event {
        let [width, height] = book.size().map(|side| side as f32);
        let is_over = self.ticks >= self.lasting;
        match self.motion {
            Motion::Tears { flight, .. } if self.leaf.bound().is_empty() => {
                let work = f64::from(self.leaf.take_work());
                let wanted = self.work(book);
                torn.work_off = torn.work_off.max((work / wanted - 1.0).abs());
                torn.off += 1;
                self.carry([width, height], random);
                Event::Off(flight)
            }
            Motion::Tears { flight, .. } if is_over && random.once_in(2) => {
                self.leaf.cut();
                torn.cut += 1;
                self.carry([width, height], random);
                Event::Off(flight)
            }
            Motion::Tears { .. } if is_over => self.release(),
            Motion::Carries { .. } if is_over => {
                self.release();
                // Now and then it is taken up again as it falls or lies.
                self.lasting = if random.once_in(3) {
                    20 + random.below(200)
                } else {
                    u32::MAX
                };
                Event::None
            }
            Motion::Released if is_over => {
                let (u, v) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
                self.leaf.grab(0, u, v);
                let columns = book.columns();
                let column = columns
                    .partition_point(|own| *own < u)
                    .min(columns.len() - 1);
                let row = (v * (book.rows() - 1) as f32) as usize;
                self.at = self.leaf.surface().position(column, row);
                self.carry([width, height], random);
                Event::None
            }
            _ => Event::None,
        }
    }

    /// Carries the sheet to a place over or beside the book.
    fn carry(&mut self, [width, height]: [f32; 2], random: &mut Random) {
        let to = [
            width * random.between(-2.5, 2.5),
            height * random.between(-0.5, 1.5),
            width * random.between(0.1, 1.0),
        ];
        let speed = random.spread(0.5, 6.0) * width / 120.0;
        self.motion = Motion::Carries { to, speed };
        (self.ticks, self.lasting) = (0, 20 + random.below(100));
    }

    /// Work of tearing the paper that held the leaf, J.
    fn work(&self, book: &Book) -> f64 {
        let height = book.size()[1];
        let length = match self.line {
            TearLine::Sewn => height,
            TearLine::Perforated => TIES * height,
            TearLine::Stapled => STAPLES,
        };
        FRACTURE * f64::from(self.leaf.caliper()) * length
    }

    /// Looks at what is drawn. Returns whether all of it is a number.
    pub fn look(&self, book: &Book, torn: &mut Torn) -> bool {
        let surface = self.leaf.surface();
        if !surface
            .positions
            .iter()
            .chain(&surface.normals)
            .all(|x| x.is_finite())
        {
            return false;
        }
        let facets = Facets::new(surface);
        let [width, height] = book.size().map(|side| side as f32);
        torn.pile = torn.pile.max(self.scale * inside_block(book, &facets));
        let itself = inside_itself(&facets, within(book, [width, height]));
        torn.itself = torn.itself.max(self.scale * itself);
        if self.flight().is_none() {
            let leaves = (0..book.drawn_leaves()).filter_map(|index| Facets::of(book, index));
            let through = leaves.filter(|leaf| facets.goes_through(leaf));
            torn.through += u32::from(through.count() > 0);
            torn.pictures += 1;
        }
        true
    }
}

/// The deepest that a drawn point of a free sheet, or the middle of an edge, is in the pages, the
/// boards or the table: by the shortest way out of them, metres.
fn inside_block(book: &Book, sheet: &Facets<'_>) -> f32 {
    let points = sheet.points();
    let middles = sheet
        .edges()
        .map(|[a, b]| core::array::from_fn(|axis| 0.5 * (points[a][axis] + points[b][axis])));
    let depth = |point: Point| depth(book, point);
    points
        .iter()
        .copied()
        .chain(middles)
        .map(depth)
        .fold(0.0, f32::max)
}

fn depth(book: &Book, [x, y, z]: Point) -> f32 {
    let [width, height] = book.size().map(|side| side as f32);
    let pile = book.pile(if x < 0.0 { Side::Left } else { Side::Right });
    let within = |rim: f32| (width + rim - x.abs()).min(y + rim).min(height + rim - y);
    let (top, slope) = pile.height_and_slope(x.abs(), pile.column_before(x.abs(), 0));
    let pages = ((top - z) / (1.0 + slope * slope).sqrt()).min(within(0.0));
    let boards = (-z).min(within(AROUND.rim));
    pages.max(boards).max(AROUND.table - z).max(0.0)
}
