//! A random gesture: a book, pointers on its leaves, what they do, and afterwards.

use cpu_time::ThreadTime;
use turnleaf_engine::book::{Phase, TICK};
use turnleaf_engine::{Side, Surface};

use super::creasing::{CreaseOutcome, Creasing, in_flight};
use super::overlap::{Overlap, measure};
use super::pointer::{self, Pointer, Style, any_style};
use super::random::Random;
use super::world::{Kind, Opened, Pace, USUAL, World};

/// Ticks for which pointers are at work, at most, and where frames are long.
const LONGEST: u32 = 130;
const LONGEST_SLOW: u32 = 480;

/// Ticks of half a second, after which a leaf let go keeps its lengths.
const HALF_A_SECOND: u32 = (0.5 / TICK) as u32;

/// Ticks looked at beyond that.
const BEYOND: u32 = 20;

/// Ticks in which all leaves come to rest once they are let go, at most, on a page 140 mm wide; on a
/// wider one as many more as its falls take longer.
const MOST_TO_REST: f32 = 1200.0;

/// Where more leaves fly than this, every fourth picture is looked at.
const FEW: usize = 6;

/// What a gesture did to the leaves. Lengths are in metres on a page 140 mm wide.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Largest edge strain after any tick of a leaf that is not being eased flat.
    pub strain: f32,
    /// The same while one is.
    pub strain_eased: f32,
    /// The same, of leaves that no pointer has held for half a second and that are not
    /// being eased flat.
    pub strain_after: f32,
    /// Largest shear of a cell of any leaf, radians.
    pub shear: f32,
    /// Largest stretch of a diagonal of a cell of any leaf, as part of it.
    pub diagonal: f32,
    /// Largest shear of a cell of leaves that no pointer has touched, radians.
    pub shear_played: f32,
    /// Largest stretch of a diagonal of these, as part of it.
    pub diagonal_played: f32,
    /// Drawn penetration.
    pub drawn: Overlap,
    /// Deepest contact of a node in the solver.
    pub depth: f32,
    /// Whether all that is drawn was a number.
    pub finite: bool,
    /// Leaves in flight and seconds of CPU of each frame of two ticks and an update.
    pub frames: Vec<(usize, f64)>,
    /// Most seconds of CPU of an update.
    pub update: f64,
    /// Most seconds of CPU of a frame.
    pub frame: f64,
    /// Most seconds of CPU of a tick.
    pub tick: f64,
    /// Most work of an update, as it is counted.
    pub update_work: u32,
    /// Most work of a frame's ticks and update, as it is counted.
    pub frame_work: u32,
    /// Most leaves in flight at once.
    pub leaves: usize,
    /// How far what is drawn is behind the paper in each frame, at most.
    pub lags: Vec<f32>,
    /// Seconds from when all were let go until all lay still.
    pub rest: f32,
    /// Seconds from the first tick until all lay still.
    pub rest_from_start: f32,
    /// Whether all came to lie still.
    pub at_rest: bool,
    /// Leaves that came to rest.
    pub landed: u32,
    /// Those of them that were put down.
    pub put_down: u32,
    /// What folds and tears did; None where leaves are whole.
    pub creases: Option<CreaseOutcome>,
}

/// What is known of a flight.
struct Known {
    id: u32,
    /// Ticks since anything held it.
    free: u32,
    /// Whether a pointer has held it.
    was_held: bool,
}

struct Scene<'a> {
    opened: Opened,
    random: Random,
    world: &'a World,
    /// Folds and tears; None where leaves are whole.
    creasing: Option<Creasing>,
    /// Width and height of a page, metres.
    page: [f32; 2],
    pointers: Vec<Pointer>,
    known: Vec<Known>,
    pictures: u32,
    outcome: Outcome,
}

/// Plays the gesture of a seed in a world.
pub fn play(seed: u64, world: &World) -> Outcome {
    let mut random = Random::new(seed);
    let mut opened = world.open(&mut random);
    let begin = |fold| Creasing::begin(seed, fold, &mut opened, world.page);
    let mut scene = Scene {
        creasing: world.fold.map(begin),
        opened,
        random,
        world,
        page: world.page.map(|side| side as f32),
        pointers: Vec::new(),
        known: Vec::new(),
        pictures: 0,
        outcome: Outcome {
            finite: true,
            ..Outcome::default()
        },
    };
    let mut ticks = 0;
    let steady = scene.random.once_in(2);
    let busy = match world.kind {
        Kind::Riffle => 1 + scene.random.below(6),
        _ => 1 + scene.random.below(30),
    };
    let longest = match world.pace {
        Pace::Slow | Pace::Halting => LONGEST_SLOW,
        _ => LONGEST,
    };
    while ticks < longest {
        if scene.random.once_in(busy) || scene.opened.book.flights() == 0 {
            scene.begin();
        }
        let now = match world.pace {
            Pace::Usual if steady => 2,
            Pace::Usual => scene.random.below(13),
            Pace::Quick => 1,
            Pace::Halting if !scene.random.once_in(10) => 2,
            Pace::Halting | Pace::Slow => scene.random.below(121),
        };
        scene.frame(now);
        ticks += now.max(1);
    }
    for pointer in std::mem::take(&mut scene.pointers) {
        scene.opened.book.release(pointer.flight, pointer.number);
    }
    if let Some(creasing) = &mut scene.creasing {
        creasing.let_go(&mut scene.opened.book);
    }
    let mut let_go = 0;
    for _ in 0..(HALF_A_SECOND + BEYOND) / 2 {
        let_go += 2;
        scene.frame(2);
    }
    let longest = (MOST_TO_REST * (scene.page[0] / 0.14).sqrt().max(1.0)) as u32;
    while scene.moves() && let_go < longest {
        scene.press();
        scene.opened.book.step(1);
        let_go += 1;
        scene.look();
        scene.step_torn(1);
    }
    scene.outcome.rest = let_go as f32 * TICK;
    scene.outcome.rest_from_start = (ticks + let_go) as f32 * TICK;
    scene.outcome.at_rest = !scene.moves();
    scene.count_landed();
    scene.look_at_rest();
    scene.outcome
}

impl Scene<'_> {
    /// Whether leaves are in flight, or what is torn out has not come to rest.
    fn moves(&self) -> bool {
        self.opened.book.flights() > 0 || self.creasing.as_ref().is_some_and(Creasing::moves)
    }

    /// Begins something: a pointer takes a leaf, or a turn is played.
    fn begin(&mut self) {
        let side = [Side::Right, Side::Left][self.random.below(2) as usize];
        if let Some(creasing) = &mut self.creasing {
            if !creasing.lets_turn(&self.opened.book) {
                return;
            }
            if self.random.once_in(4) {
                return creasing.act(&mut self.opened, side);
            }
        }
        if self.world.kind == Kind::Riffle {
            return self.riffle(side);
        }
        let drawn = self.opened.book.drawn_leaves();
        let known = self.random.below(drawn as u32 + 1) as usize;
        // What lies folded upon a pile has no number.
        let known = self.opened.book.flight_id(known).filter(|id| *id != 0);
        let picked = if self.random.once_in(2) || known.is_none() {
            self.pick_up(side)
        } else {
            known
        };
        let Some(flight) = picked else { return };
        let kind = match self.world.kind {
            Kind::Mixed => Kind::ALL[self.random.below(6) as usize],
            kind => kind,
        };
        match (self.random.below(4), kind) {
            (_, Kind::Pin) => {
                let pulls = any_style(&mut self.random);
                self.grab(flight, 4, |_| Style::Pin);
                self.grab(flight, 4, |_| pulls);
            }
            (_, Kind::Apart) => {
                let away = pointer::away(&mut self.random);
                self.grab(flight, 4, |_| away);
                self.grab(flight, 4, |_| opposite(away));
                if self.random.once_in(3) {
                    self.grab(flight, 4, pointer::away);
                    self.grab(flight, 4, pointer::away);
                }
            }
            (0, _) => self.play(flight),
            (one_or_two, kind) => {
                for _ in 0..if one_or_two == 1 { 2 } else { 1 } {
                    self.grab(flight, 2, |random| match kind {
                        Kind::Teleport => Style::Teleport,
                        Kind::Circle => pointer::circle(random),
                        _ => [Style::Drag, Style::Throw, Style::Wild][random.below(3) as usize],
                    });
                }
            }
        }
    }

    /// Lets go of leaves, mostly to one side; now and then one is caught.
    fn riffle(&mut self, side: Side) {
        let (from, to) = match self.random.below(8) {
            0 => (side, side),
            1 => (Side::Left, Side::Right),
            _ => (Side::Right, Side::Left),
        };
        for _ in 0..1 + self.random.below(3) {
            if let Some(flight) = self.pick_up(from) {
                let seconds = self.random.between(0.2, 1.5);
                self.opened.book.play(flight, to, seconds);
            }
        }
        let drawn = self.opened.book.drawn_leaves() as u32;
        if self.random.once_in(6)
            && drawn > 0
            && let Some(flight) = self
                .opened
                .book
                .flight_id(self.random.below(drawn) as usize)
            && flight != 0
        {
            self.grab(flight, 2, any_style);
        }
    }

    fn pick_up(&mut self, side: Side) -> Option<u32> {
        let read = self.opened.book.read();
        let many = if self.random.once_in(6) { 3 } else { 1 };
        match side {
            Side::Right => {
                let low = read + in_flight(&self.opened.book);
                self.opened.book.pick_up(side, low, low + many)
            }
            Side::Left => self
                .opened
                .book
                .pick_up(side, read.checked_sub(many)?, read),
        }
    }

    fn play(&mut self, flight: u32) {
        let side = [Side::Right, Side::Left][self.random.below(2) as usize];
        let seconds = [0.8, 0.5, 0.3, f32::NAN, self.random.between(0.1, 2.0)];
        let seconds = seconds[self.random.below(5) as usize];
        self.pointers.retain(|pointer| pointer.flight != flight);
        self.opened.book.play(flight, side, seconds);
    }

    /// A pointer takes hold somewhere, where at most so many are at work.
    fn grab(&mut self, flight: u32, most: usize, style: impl FnOnce(&mut Random) -> Style) {
        let number = self.random.below(4);
        let is_same = |pointer: &Pointer| (pointer.flight, pointer.number) == (flight, number);
        if self.pointers.len() >= most || self.pointers.iter().any(is_same) {
            return;
        }
        let edge = self.random.once_in(2);
        let u = if edge {
            1.0
        } else {
            self.random.between(0.2, 1.0)
        };
        let v = if self.random.once_in(3) {
            0.0
        } else {
            self.random.between(0.0, 1.0)
        };
        let [u, v] = self.flap_of(flight).unwrap_or([u, v]);
        self.opened.book.grab(flight, number, u, v);
        let style = style(&mut self.random);
        let ticks = 10 + self.random.below(LONGEST);
        let held = [u, v];
        self.pointers.push(pointer::pointer(
            (flight, number),
            style,
            held,
            self.page,
            ticks,
        ));
    }

    /// A place of a flight that is folded over, if a pointer is to take hold there, and notes that
    /// one does.
    fn flap_of(&mut self, flight: u32) -> Option<[f32; 2]> {
        let creasing = self.creasing.as_mut()?;
        creasing.hold(&self.opened.book, flight);
        creasing.flap_of(&self.opened.book, flight)
    }

    /// A frame of `ticks`, or as many of them as the work of a frame allows, and an update.
    fn frame(&mut self, ticks: u32) {
        for index in (0..self.pointers.len()).rev() {
            self.work(index, ticks);
        }
        let leaves = self.opened.book.flights();
        let (mut seconds, mut work) = (0.0, 0);
        self.opened.book.begin_frame();
        for _ in 0..ticks {
            self.press();
            let start = ThreadTime::now();
            if self.opened.book.step_frame(1) == 0 {
                break;
            }
            let tick = start.elapsed().as_secs_f64();
            self.outcome.tick = self.outcome.tick.max(tick);
            seconds += tick;
            work += self.opened.book.tick_work();
            self.look();
        }
        let start = ThreadTime::now();
        self.opened.book.update();
        let update = start.elapsed().as_secs_f64();
        seconds += self.step_torn(ticks);
        self.outcome.update = self.outcome.update.max(update);
        self.outcome.update_work = self.outcome.update_work.max(self.opened.book.update_work());
        seconds += update;
        if ticks == 2 && leaves > 0 {
            self.outcome.frames.push((leaves, seconds));
        }
        self.outcome.frame = self.outcome.frame.max(seconds);
        let work = work + self.opened.book.update_work();
        self.outcome.frame_work = self.outcome.frame_work.max(work);
        self.outcome.leaves = self.outcome.leaves.max(leaves);
        self.look_at_picture();
    }

    /// A pointer's work of a frame: it moves, or lets go.
    fn work(&mut self, index: usize, ticks: u32) {
        let pointer = &mut self.pointers[index];
        if !pointer.holds(ticks) {
            self.opened.book.release(pointer.flight, pointer.number);
            self.pointers.swap_remove(index);
            return;
        }
        if let Some(place) = pointer.pull(&mut self.random, ticks, self.page) {
            self.opened.book.hold(pointer.flight, pointer.number, place);
        }
    }

    /// Looks at the leaves after a tick.
    fn look(&mut self) {
        let before = std::mem::take(&mut self.known);
        for index in 0..self.opened.book.drawn_leaves() {
            let Some(id) = self.opened.book.flight_id(index) else {
                continue;
            };
            let known = before.iter().find(|known| known.id == id);
            let phase = self.opened.book.phase(id);
            let free = match phase {
                Some(Phase::Held | Phase::Playing(_)) => 0,
                _ => known.map_or(0, |known| known.free) + 1,
            };
            let was_held = phase == Some(Phase::Held) || known.is_some_and(|known| known.was_held);
            self.known.push(Known { id, free, was_held });
            let of = |figure: Option<f32>| figure.unwrap_or(0.0);
            let strain = of(self.opened.book.strain(index));
            let depth = of(self.opened.book.depth(index));
            let shear = of(self.opened.book.shear(index));
            let diagonal = of(self.opened.book.diagonal_stretch(index));
            let outcome = &mut self.outcome;
            // No maximum of what is no number would show it.
            outcome.finite &= [strain, depth, shear, diagonal]
                .iter()
                .all(|x| x.is_finite());
            outcome.depth = outcome.depth.max(depth * USUAL[0] as f32 / self.page[0]);
            if self.opened.book.is_settling(index) == Some(true) {
                outcome.strain_eased = outcome.strain_eased.max(strain);
                continue;
            }
            outcome.strain = outcome.strain.max(strain);
            outcome.shear = outcome.shear.max(shear);
            outcome.diagonal = outcome.diagonal.max(diagonal);
            if !was_held {
                outcome.shear_played = outcome.shear_played.max(shear);
                outcome.diagonal_played = outcome.diagonal_played.max(diagonal);
            }
            if free > HALF_A_SECOND {
                outcome.strain_after = outcome.strain_after.max(strain);
            }
        }
    }

    /// Looks at what is drawn.
    fn look_at_picture(&mut self) {
        let drawn_leaves = self.opened.book.drawn_leaves();
        let drawn = (0..drawn_leaves).filter_map(|index| self.opened.book.surface(index));
        let finite = |surface: &Surface| {
            let all = surface.positions.iter().chain(&surface.normals);
            { all }.all(|x| x.is_finite())
        };
        self.outcome.finite &= { drawn }.all(finite);
        let lag = |index: usize| self.opened.book.lag(index).unwrap_or(0.0);
        let lag = (0..drawn_leaves).map(lag).fold(0.0, f32::max);
        let scale = USUAL[0] as f32 / self.page[0];
        self.outcome.lags.push(lag * scale);
        self.pictures += 1;
        if drawn_leaves <= FEW || self.pictures.is_multiple_of(4) {
            let overlap = measure(&self.opened.book, self.page).scaled(scale);
            self.outcome.drawn = self.outcome.drawn.worse(overlap);
            if let Some(creasing) = &mut self.creasing {
                self.outcome.finite &= creasing.look(&self.opened.book);
            }
        }
    }

    /// Presses what is being folded by a tick.
    fn press(&mut self) {
        if let Some(creasing) = &mut self.creasing {
            creasing.press(&mut self.opened.book);
        }
    }

    /// Steps and draws what is torn by `ticks`. Returns the seconds of CPU that took.
    fn step_torn(&mut self, ticks: u32) -> f64 {
        let Some(creasing) = &mut self.creasing else {
            return 0.0;
        };
        let start = ThreadTime::now();
        let landed = self.opened.book.landed();
        let is_bound_anew = creasing.step(&mut self.opened, ticks, self.world);
        let seconds = start.elapsed().as_secs_f64();
        if !is_bound_anew {
            return seconds;
        }
        // A new book counts anew, and its leaves have other numbers.
        self.outcome.landed += landed[0];
        self.outcome.put_down += landed[1];
        self.pointers.clear();
        self.known.clear();
        // Binding is not part of a frame: the viewer does it between two.
        0.0
    }

    fn count_landed(&mut self) {
        let [landed, put_down] = self.opened.book.landed();
        self.outcome.landed += landed;
        self.outcome.put_down += put_down;
    }

    /// Looks at folds and what is drawn of them once all lies at rest.
    fn look_at_rest(&mut self) {
        let Some(mut creasing) = self.creasing.take() else {
            return;
        };
        self.opened.book.update();
        self.look_at_picture();
        creasing.look_at_rest(&self.opened.book);
        creasing.compare_rests(&self.opened.book);
        self.outcome.finite &= creasing.look(&self.opened.book);
        self.outcome.creases = Some(creasing.outcome);
    }
}

fn opposite(style: Style) -> Style {
    match style {
        Style::Away { direction, speed } => Style::Away {
            direction: direction.map(|x| -x),
            speed,
        },
        other => other,
    }
}
