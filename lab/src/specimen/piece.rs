//! A piece of paper to order, and what any model of it can do.

use std::f64::consts::FRAC_PI_2;

use turnleaf_engine::{GRAVITY, Stock};

/// Length of a piece from its clamp unless set otherwise: the width of a page, m.
pub const LENGTH: f64 = 0.148;

/// Its breadth along the clamp: the height of a page, m.
pub const BREADTH: f64 = 0.210;

/// Its mass, kg/m^2: that of book paper.
const GRAMMAGE: f64 = Stock::BOOK.grammage;

/// What holds a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Held {
    /// A clamp at one end, at an angle upward from level, radians.
    Clamp(f64),
    /// The same, and another at the far end, which [`Specimen::carry_end`] moves.
    TwoClamps(f64),
    /// Nothing.
    Nothing,
}

/// A piece of isotropic paper to order.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Columns of nodes from the clamp to the far end; the model's own number
    /// where None.
    pub columns: Option<usize>,
    /// Rows of nodes; the model's own number where None.
    pub rows: Option<usize>,
    /// From clamp to far end, m.
    pub length: f64,
    /// Along the clamp, m.
    pub breadth: f64,
    /// Mass, kg/m^2.
    pub grammage: f64,
    /// Bending stiffness D, N m.
    pub stiffness: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Loss tangent of bending; the model's own for paper where None.
    pub loss: Option<f64>,
    /// Acceleration of gravity, m/s^2.
    pub gravity: [f64; 3],
    /// Whether there is air.
    pub air: bool,
    /// What holds it.
    pub held: Held,
    /// Length of a step, s; the model's own where None.
    pub time_step: Option<f64>,
}

impl Piece {
    /// A page of the heaviness Gamma = weight x length^3 / D at its real weight,
    /// in air, clamped level, without Poisson's effect: bent about its clamp it
    /// is a strip.
    pub fn of_gamma(gamma: f64) -> Piece {
        Piece {
            columns: None,
            rows: None,
            length: LENGTH,
            breadth: BREADTH,
            grammage: GRAMMAGE,
            stiffness: GRAMMAGE * GRAVITY * LENGTH.powi(3) / gamma,
            poisson: 0.0,
            loss: None,
            gravity: [0.0, 0.0, -GRAVITY],
            air: true,
            held: Held::Clamp(0.0),
            time_step: None,
        }
    }

    /// The same without weight, as stiff as book paper.
    pub fn weightless() -> Piece {
        Piece {
            gravity: [0.0; 3],
            stiffness: Stock::BOOK.stiffness_across,
            ..Piece::of_gamma(1.0)
        }
    }

    /// Where each node lies when the piece is straight along its clamp, m.
    pub fn straight(&self, (columns, rows): (usize, usize)) -> Vec<[f64; 3]> {
        let angle = match self.held {
            Held::Clamp(angle) | Held::TwoClamps(angle) => angle,
            Held::Nothing => 0.0,
        };
        // Exactly upright it would not know to which side to fall.
        let lean = if angle == FRAC_PI_2 { 1e-3 } else { 0.0 };
        let (sin, cos) = (angle - lean).sin_cos();
        let place = |node: usize| {
            let along = (node % columns) as f64 / (columns - 1) as f64 * self.length;
            let across = (node / columns) as f64 / (rows - 1) as f64 * self.breadth;
            [along * cos, across, along * sin]
        };
        (0..columns * rows).map(place).collect()
    }
}

/// A piece of paper under experiment.
pub trait Specimen {
    /// Columns of nodes from the clamp to the far end, and rows.
    fn grid(&self) -> (usize, usize);

    /// Where a node is, m.
    fn place(&self, column: usize, row: usize) -> [f64; 3];

    /// Puts a constant force on a node, N.
    ///
    /// # Errors
    /// Where the model knows no such thing, in a sentence.
    fn load(&mut self, column: usize, row: usize, force: [f64; 3]) -> Result<(), String>;

    /// Moves a clamp at the far end to x and z, m, where the paper arrives in a
    /// direction `angle` radians upward from level.
    ///
    /// # Errors
    /// Where the model knows no such thing, in a sentence.
    fn carry_end(&mut self, x: f64, z: f64, angle: f64) -> Result<(), String>;

    /// Puts the nodes at places, m, column by column of each row, not moving.
    ///
    /// # Errors
    /// Where the model knows no such thing, in a sentence.
    fn put(&mut self, _places: &[[f64; 3]]) -> Result<(), String> {
        Err("This model's nodes cannot be put anywhere.".into())
    }

    /// Lets the piece come to rest.
    ///
    /// # Errors
    /// Where it does not, in a sentence.
    fn rest(&mut self) -> Result<(), String>;

    /// Length of a step, s.
    fn time_step(&self) -> f64;

    /// Advances by a step.
    fn step(&mut self);

    /// Largest strain of an edge between neighbouring nodes.
    fn edge_strain(&self) -> f64;

    /// Its energy, of motion, bending, stretch and weight, J; None where the
    /// model keeps no account of it.
    fn energy(&self) -> Option<f64>;

    /// Angular frequencies of its first modes about the present equilibrium,
    /// rad/s; None where the model has no way of its own to find them.
    fn frequencies(&mut self, _count: usize) -> Option<Vec<f64>> {
        None
    }

    /// Whether the present equilibrium is stable; None where the model cannot
    /// tell.
    fn is_stable(&mut self) -> Option<bool> {
        None
    }
}

impl dyn Specimen + '_ {
    /// The middle of a column of nodes, m.
    pub fn middle(&self, column: usize) -> [f64; 3] {
        let rows = self.grid().1;
        let mut sum = [0.0; 3];
        for row in 0..rows {
            let place = self.place(column, row);
            for axis in 0..3 {
                sum[axis] += place[axis] / rows as f64;
            }
        }
        sum
    }

    /// The middle of the far end, m.
    pub fn tip(&self) -> [f64; 3] {
        self.middle(self.grid().0 - 1)
    }

    /// Spreads a force evenly along a column of nodes, N.
    ///
    /// # Errors
    /// Where the model takes no loads, in a sentence.
    pub fn load_column(&mut self, column: usize, force: [f64; 3]) -> Result<(), String> {
        let rows = self.grid().1;
        for row in 0..rows {
            let ends = row == 0 || row + 1 == rows;
            let part = if ends { 0.5 } else { 1.0 } / (rows - 1) as f64;
            self.load(column, row, force.map(|f| f * part))?;
        }
        Ok(())
    }
}

/// How long a piece may swing before it is said not to come to rest, s.
const PATIENCE: usize = 120;

/// How long it swings before it is stopped in the middle of its swing, s: where
/// it comes to rest does not depend on that, but air alone stops the last small
/// swings of a heavy page only after minutes.
const SWINGING: usize = 10;

/// Steps a piece until in a whole second no node has moved further than a
/// ten-thousandth of its length, nor moves faster than ten of these a second.
/// `stop` puts it at places, not moving.
///
/// # Errors
/// Where it flies apart, or still moves when patience ends, in a sentence.
pub fn swing_to_rest<S: Specimen>(
    piece: &mut S,
    length: f64,
    stop: impl Fn(&mut S, &[[f64; 3]]),
) -> Result<(), String> {
    let second = (1.0 / piece.time_step()).round() as usize;
    let mut before = places(piece);
    let mut middle = vec![[0.0; 3]; before.len()];
    for seconds in 1..=PATIENCE {
        let mut last = before.clone();
        for _ in 0..second {
            last = places(piece);
            piece.step();
            if seconds % SWINGING > SWINGING / 2 {
                add(&mut middle, &places(piece));
            }
        }
        let now = places(piece);
        if !now.as_flattened().iter().all(|x| x.is_finite()) {
            return Err("The piece flew apart.".into());
        }
        let speed = farthest(&now, &last) / piece.time_step();
        if farthest(&now, &before) < 1e-4 * length && speed < 1e-3 * length {
            return Ok(());
        }
        before = now;
        if seconds % SWINGING == SWINGING - 1 {
            let part = 1.0 / ((SWINGING - 1 - SWINGING / 2) * second) as f64;
            for place in &mut middle {
                *place = place.map(|x| x * part);
            }
            stop(piece, &middle);
            middle.fill([0.0; 3]);
        }
    }
    Err(format!("The piece still moves after {PATIENCE} s."))
}

/// Where all nodes are, m.
fn places(piece: &dyn Specimen) -> Vec<[f64; 3]> {
    let (columns, rows) = piece.grid();
    let nodes = 0..columns * rows;
    nodes
        .map(|node| piece.place(node % columns, node / columns))
        .collect()
}

fn add(sum: &mut [[f64; 3]], places: &[[f64; 3]]) {
    for (sum, place) in sum.as_flattened_mut().iter_mut().zip(places.as_flattened()) {
        *sum += place;
    }
}

/// The longest way, along an axis, between places of a node.
fn farthest(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
