//! A pointer that holds a leaf, and the ways in which it moves.

use super::random::Random;
use super::world::USUAL;

/// A pointer that holds a flight.
pub struct Pointer {
    /// The number of the flight.
    pub flight: u32,
    /// The number of its grab on that.
    pub number: u32,
    style: Style,
    at: [f32; 3],
    to: [f32; 3],
    /// Ticks until it lets go.
    left: u32,
}

/// How a pointer moves.
#[derive(Clone, Copy, Debug)]
pub enum Style {
    /// Slowly, to near places.
    Drag,
    /// Fast, over the spine.
    Throw,
    /// It jumps to anywhere, up to three widths off.
    Wild,
    /// It is elsewhere in every frame.
    Teleport,
    /// It goes round `radius` widths from where it is headed for, so many radians a tick;
    /// about the spine's direction, or upright.
    Circle {
        radius: f32,
        rate: f32,
        angle: f32,
        upright: bool,
    },
    /// It stays where it took hold.
    Pin,
    /// Away from the middle of the leaf, so far a tick, widths.
    Away { direction: [f32; 3], speed: f32 },
}

/// A pointer of a style that takes hold of (u, v) of a flight on a page of this size, for
/// so many ticks.
pub fn pointer(
    (flight, number): (u32, u32),
    style: Style,
    [_, v]: [f32; 2],
    page: [f32; 2],
    ticks: u32,
) -> Pointer {
    let at = [0.0, v * page[1], 0.12 * (page[0] / USUAL[0] as f32)];
    Pointer {
        flight,
        number,
        style,
        at,
        to: at,
        left: ticks,
    }
}

/// Any style.
pub fn any_style(random: &mut Random) -> Style {
    match random.below(8) {
        0 => Style::Drag,
        1 => Style::Throw,
        2 => Style::Wild,
        3 => Style::Teleport,
        4 => Style::Pin,
        5 => away(random),
        _ => circle(random),
    }
}

/// A circle of any size and speed.
pub fn circle(random: &mut Random) -> Style {
    let turns = random.spread(0.2, 15.0);
    let sign = [-1.0, 1.0][random.below(2) as usize];
    Style::Circle {
        radius: random.between(0.1, 1.6),
        rate: sign * turns * core::f32::consts::TAU / 120.0,
        angle: random.between(0.0, core::f32::consts::TAU),
        upright: random.once_in(4),
    }
}

/// Away to any direction.
pub fn away(random: &mut Random) -> Style {
    let direction = core::array::from_fn(|_| random.between(-1.0, 1.0));
    let speed = random.spread(0.002, 0.5);
    Style::Away { direction, speed }
}

impl Pointer {
    /// Lets ticks pass. Returns whether it still holds.
    pub fn holds(&mut self, ticks: u32) -> bool {
        self.left = self.left.saturating_sub(ticks);
        self.left > 0
    }

    /// Moves on by so many ticks. Returns where it pulls, metres; None where it stays.
    pub fn pull(&mut self, random: &mut Random, ticks: u32, page: [f32; 2]) -> Option<[f32; 3]> {
        // Places along the spine are in proportion to the height.
        let scale = [
            page[0],
            page[1] / USUAL[1] as f32 * USUAL[0] as f32,
            page[0],
        ];
        let mut place = match self.style {
            Style::Pin => return None,
            Style::Drag => self.follow(random, ticks, scale, (20, 1.0, 0.04)),
            Style::Throw => self.follow(random, ticks, scale, (8, 1.2, 0.25)),
            Style::Wild => self.follow(random, ticks, scale, (4, 3.0, 1.0)),
            Style::Teleport => {
                let far = [1.0, 3.0, 3.0, 1000.0][random.below(4) as usize];
                self.at =
                    core::array::from_fn(|axis| far * scale[axis] * random.between(-1.0, 1.0));
                self.at
            }
            Style::Circle {
                radius,
                rate,
                ref mut angle,
                upright,
            } => {
                *angle += rate * ticks as f32;
                let (sin, cos) = angle.sin_cos();
                let other = if upright { 1 } else { 2 };
                let mut place = [0.0, self.at[1], 0.3 * scale[2]];
                place[0] = radius * scale[0] * cos;
                place[other] += radius * scale[other] * sin;
                place
            }
            Style::Away { direction, speed } => {
                for axis in 0..3 {
                    self.at[axis] += direction[axis] * speed * ticks as f32 * scale[axis];
                }
                self.at
            }
        };
        if random.once_in(50) {
            let strange = match self.style {
                Style::Drag | Style::Throw | Style::Wild => f32::NAN,
                _ => [f32::NAN, f32::INFINITY, f32::MIN, f32::MAX][(self.left % 4) as usize],
            };
            place[random.below(3) as usize] = strange;
        }
        Some(place)
    }

    /// Goes toward a place: a new one `often`, so `far`, by a part of the way a tick.
    fn follow(
        &mut self,
        random: &mut Random,
        ticks: u32,
        scale: [f32; 3],
        (often, far, follow): (u32, f32, f32),
    ) -> [f32; 3] {
        if random.once_in(often) {
            let mut at =
                |axis: usize, low: f32, high: f32| random.between(low, high) * far * scale[axis];
            self.to = [at(0, -1.0, 1.0), at(1, -0.3, 1.8), at(2, -0.2, 1.0)];
        }
        for axis in 0..3 {
            let part = (follow * ticks as f32).min(1.0);
            self.at[axis] += part * (self.to[axis] - self.at[axis]);
        }
        self.at
    }
}
