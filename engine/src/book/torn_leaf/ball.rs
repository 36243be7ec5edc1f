//! A crumpled sheet that has come to its shape: one rigid body.
//!
//! Its own weight bends a ball of paper by nothing that is seen. And the sheet's solver, which is
//! made for paper that gives way, does not hold it: where a ball stands on a few nodes, sweeps
//! for lengths and contacts undo each other, and what is left of that rolls it on for ever.

use crate::book::limits::TICK;
use crate::book::surroundings::Surroundings;
use crate::models::sheet::{CONTACTS, Contact, Sheet};
use crate::vector::{cross, dot, sub};

/// Rounds in which contacts find the impulses that stop them together.
const ROUNDS: usize = 10;

/// Part of its spin that a ball keeps for a tick in which it touches something, as its paper gives
/// way where it rolls: half is gone in a tenth of a second.
const ROLLING: f32 = 0.944;

/// Seconds in which a hand brings the place that it holds to where it pulls, and its greatest
/// speed, m/s.
const FOLLOWING: f32 = 0.05;
const FASTEST: f32 = 3.0;

/// Drag coefficient of a rough ball.
const DRAG: f32 = 0.5;

type Matrix = [[f32; 3]; 3];

/// A ball of paper.
#[derive(Clone, Debug)]
pub(super) struct Ball {
    columns: usize,
    /// Where the nodes are about the centre of mass as long as it is not turned, metres.
    shape: Vec<[f32; 3]>,
    /// Kilograms, and the inverse of its moments of inertia as long as it is not turned, 1/(kg m^2).
    pub(super) mass: f32,
    lightness: Matrix,
    /// Drag over mass and the square of the speed, 1/m.
    drag: f32,
    friction: f32,
    gravity: [f32; 3],
    /// The centre of mass, metres; by columns where its axes point.
    at: [f32; 3],
    axes: Matrix,
    /// Of its centre, m/s.
    pub(super) velocity: [f32; 3],
    /// Radians a second.
    pub(super) spin: [f32; 3],
    /// The place about the centre that a hand holds, metres, as long as it is not turned.
    held: Option<[f32; 3]>,
    contacts: Vec<[Contact; CONTACTS]>,
    nodes: Vec<f32>,
}

/// A node that touches something: where it is about the centre, the normal there, and the impulse
/// by which it is pressed, N s.
struct Touch {
    arm: [f32; 3],
    normal: [f32; 3],
    friction: f32,
    pressed: f32,
}

impl Ball {
    /// The sheet as a ball, at rest.
    pub fn of(sheet: &Sheet) -> Ball {
        let x = sheet.positions().as_chunks::<3>().0;
        let settings = sheet.settings();
        let masses: Vec<f32> = (0..x.len())
            .map(|node| {
                let area = settings.area(node % settings.columns, node / settings.columns);
                (settings.stock.grammage * area) as f32
            })
            .collect();
        let mass: f32 = masses.iter().sum();
        let at = core::array::from_fn(|axis| {
            let weighed = x.iter().zip(&masses).map(|(x, mass)| mass * x[axis]);
            weighed.sum::<f32>() / mass
        });
        let shape: Vec<[f32; 3]> = x.iter().map(|x| sub(*x, at)).collect();
        let mut inertia = [[0.0; 3]; 3];
        for (arm, mass) in shape.iter().zip(&masses) {
            for (i, row) in inertia.iter_mut().enumerate() {
                for (k, entry) in row.iter_mut().enumerate() {
                    let round = if i == k { dot(*arm, *arm) } else { 0.0 };
                    *entry += mass * (round - arm[i] * arm[k]);
                }
            }
        }
        let radius = shape
            .iter()
            .fold(0.0f32, |most, arm| most.max(dot(*arm, *arm)))
            .sqrt();
        let air = settings.air.density as f32;
        Ball {
            columns: settings.columns,
            mass,
            lightness: inverse(&inertia),
            drag: 0.5 * air * DRAG * core::f32::consts::PI * radius * radius / mass,
            friction: settings.stock.friction as f32,
            gravity: settings.gravity.map(|g| g as f32),
            at,
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            velocity: [0.0; 3],
            spin: [0.0; 3],
            held: None,
            contacts: vec![[Contact::default(); CONTACTS]; x.len()],
            nodes: sheet.positions().to_vec(),
            shape,
        }
    }

    /// A hand takes hold of the node next to a place on the sheet, u and v within 0 to 1.
    pub fn grab(&mut self, [u, v]: [f32; 2]) {
        let next = |at: f32, nodes: usize| libm::roundf(at * (nodes - 1) as f32) as usize;
        let rows = self.shape.len() / self.columns;
        let node = next(v, rows) * self.columns + next(u, self.columns);
        self.held = Some(self.shape[node]);
    }

    /// The hand lets go: the ball flies on as it was moved.
    pub fn release(&mut self) {
        self.held = None;
    }

    /// The height to which a hand pulls that raises it by no more than `rise` in a tick, metres; None
    /// where none holds it.
    pub fn highest_pull(&self, rise: f32) -> Option<f32> {
        let place = turned(&self.axes, self.held?);
        Some(self.at[2] + place[2] + rise * FOLLOWING / TICK)
    }

    /// Advances by a tick of `h` seconds; a hand pulls to a place, metres.
    pub fn step(&mut self, h: f32, around: &Surroundings, pulled: [f32; 3]) {
        match self.held {
            Some(held) if pulled.iter().all(|x| x.is_finite()) => self.follow(held, pulled),
            _ => {
                let speed = dot(self.velocity, self.velocity).sqrt();
                let slower = 1.0 / (1.0 + h * self.drag * speed);
                self.velocity = core::array::from_fn(|axis| {
                    slower * (self.velocity[axis] + h * self.gravity[axis])
                });
            }
        }
        self.at = core::array::from_fn(|axis| self.at[axis] + h * self.velocity[axis]);
        self.turn(h);
        self.place_nodes();
        self.stop(around);
    }

    /// Where its nodes are, metres, and how fast, m/s: x, y, z of each.
    pub fn write_nodes(&self, sheet: &mut Sheet) {
        let x = self.nodes.as_chunks::<3>().0;
        let v = x.iter().flat_map(|x| {
            let round = cross(self.spin, sub(*x, self.at));
            core::array::from_fn::<f32, 3, _>(|axis| self.velocity[axis] + round[axis])
        });
        sheet.write_nodes(&self.nodes, &v.collect::<Vec<f32>>());
    }

    /// Moves so that the held place comes to where a hand pulls; the hand stops its spin.
    fn follow(&mut self, held: [f32; 3], pulled: [f32; 3]) {
        let place = turned(&self.axes, held);
        let way: [f32; 3] = core::array::from_fn(|axis| pulled[axis] - self.at[axis] - place[axis]);
        let speed = dot(way, way).sqrt() / FOLLOWING;
        let slower = FASTEST / speed.max(FASTEST);
        self.velocity = way.map(|way| slower * way / FOLLOWING);
        self.spin = self.spin.map(|spin| ROLLING * spin);
    }

    /// Turns by its spin for `h` seconds.
    fn turn(&mut self, h: f32) {
        for axis in &mut self.axes {
            let by = cross(self.spin, *axis);
            *axis = core::array::from_fn(|k| axis[k] + h * by[k]);
        }
        // Upright on each other, and of unit length, again.
        let first = crate::vector::unit(self.axes[0]);
        let third = crate::vector::unit(cross(first, self.axes[1]));
        self.axes = [first, cross(third, first), third];
    }

    fn place_nodes(&mut self) {
        let places = self.nodes.as_chunks_mut::<3>().0;
        for (place, arm) in places.iter_mut().zip(&self.shape) {
            let arm = turned(&self.axes, *arm);
            *place = core::array::from_fn(|axis| self.at[axis] + arm[axis]);
        }
    }

    /// Stops what moves into what it must not pass through, by impulses at the nodes that touch
    /// (Guendelman, Bridson and Fedkiw 2003, without bounce), and moves it out as a whole.
    fn stop(&mut self, around: &Surroundings) {
        around.write_contacts(&self.nodes, &mut self.contacts);
        let (mut touches, mut deepest) = (Vec::new(), (0.0, [0.0; 3]));
        for (x, contacts) in self.nodes.as_chunks::<3>().0.iter().zip(&self.contacts) {
            for contact in contacts.iter().filter(|contact| contact.normal != [0.0; 3]) {
                let depth = contact.depth(*x);
                if depth <= 0.0 {
                    continue;
                }
                if depth > deepest.0 {
                    deepest = (depth, contact.normal);
                }
                touches.push(Touch {
                    arm: sub(*x, self.at),
                    normal: contact.normal,
                    friction: self.friction,
                    pressed: 0.0,
                });
            }
        }
        if touches.is_empty() {
            return;
        }
        for _ in 0..ROUNDS {
            for touch in &mut touches {
                self.push(touch);
            }
        }
        self.spin = self.spin.map(|spin| ROLLING * spin);
        self.at = core::array::from_fn(|axis| self.at[axis] + deepest.0 * deepest.1[axis]);
        self.place_nodes();
    }

    /// Pushes at a node that touches something until that does not move into it, and against what
    /// it slides by as far as friction goes.
    fn push(&mut self, touch: &mut Touch) {
        let normal = touch.normal;
        let into = -dot(self.velocity_at(touch.arm), normal);
        let before = touch.pressed;
        touch.pressed = (before + into * self.mass_at(touch.arm, normal)).max(0.0);
        self.kick(touch.arm, normal, touch.pressed - before);
        let v = self.velocity_at(touch.arm);
        let through = dot(v, normal);
        let along: [f32; 3] = core::array::from_fn(|axis| v[axis] - through * normal[axis]);
        let speed = dot(along, along).sqrt();
        if speed > f32::MIN_POSITIVE {
            let against = along.map(|along| -along / speed);
            let most = touch.friction * touch.pressed / ROUNDS as f32;
            let stops = speed * self.mass_at(touch.arm, against);
            self.kick(touch.arm, against, stops.min(most));
        }
    }

    /// Velocity of what is at a place about the centre, m/s.
    fn velocity_at(&self, arm: [f32; 3]) -> [f32; 3] {
        let round = cross(self.spin, arm);
        core::array::from_fn(|axis| self.velocity[axis] + round[axis])
    }

    /// The mass that a push at a place about the centre in a direction moves, kg.
    fn mass_at(&self, arm: [f32; 3], way: [f32; 3]) -> f32 {
        let lever = cross(arm, way);
        1.0 / (1.0 / self.mass + dot(lever, self.lighten(lever)))
    }

    /// An impulse at a place about the centre, N s.
    pub(super) fn kick(&mut self, arm: [f32; 3], way: [f32; 3], impulse: f32) {
        let spun = self.lighten(cross(arm, way));
        for axis in 0..3 {
            self.velocity[axis] += impulse / self.mass * way[axis];
            self.spin[axis] += impulse * spun[axis];
        }
    }

    /// The change of spin by an impulse about the centre.
    pub(super) fn lighten(&self, impulse: [f32; 3]) -> [f32; 3] {
        let own = self.axes.map(|axis| dot(axis, impulse));
        turned(&self.axes, self.lightness.map(|row| dot(row, own)))
    }
}

/// A place of a body whose axes point so.
fn turned(axes: &Matrix, place: [f32; 3]) -> [f32; 3] {
    core::array::from_fn(|k| (0..3).map(|axis| place[axis] * axes[axis][k]).sum())
}

/// The inverse of a symmetric matrix, by its adjugate.
fn inverse(matrix: &Matrix) -> Matrix {
    let [a, b, c] = *matrix;
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let scale = 1.0 / dot(a, columns[0]);
    core::array::from_fn(|i| core::array::from_fn(|k| scale * columns[k][i]))
}
