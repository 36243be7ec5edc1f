//! A cover board: a rigid plate on a hinge, which a hand swings open or shut.

use super::limits::{LONGEST_TURN, TICK};
use super::phase::Phase;
use crate::grid::Side;

/// Gravity's pull on a plate of a page's size lying level, 3 g / (2 width) at
/// 0.14 m, in rad/s^2.
const FALL: f32 = 105.0;

/// The joint's and the air's damping, 1/s: a released board takes about half a
/// second to fall, as one let down by hand does.
const DAMPING: f32 = 14.0;

/// How fast a held board follows the hand, 1/s.
const FOLLOW: f32 = 30.0;

/// A held board nearer than this to the hand lies still, radians: a twentieth of a millimetre
/// at the fore-edge of a page 0.14 m wide.
const NEAR: f32 = 3.5e-4;

/// A cover board on its hinge.
#[derive(Clone, Debug)]
pub struct Board {
    angle: f32,
    speed: f32,
    phase: Phase,
    target: f32,
    /// Where a played turn began, its course in seconds and its length.
    from: f32,
    time: f32,
    seconds: f32,
}

impl Board {
    /// A board at rest on `side`.
    pub fn new(side: Side) -> Board {
        Board {
            angle: rest_angle(side),
            speed: 0.0,
            phase: Phase::Resting(side),
            target: 0.0,
            from: 0.0,
            time: 0.0,
            seconds: 1.0,
        }
    }

    /// Angle above the right-hand side in radians: 0 flat on the right, pi flat
    /// on the left.
    pub fn angle(&self) -> f32 {
        self.angle
    }

    /// What the board is doing.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Whether it does not move until the next command: it rests, or is where a hand holds it.
    pub fn is_still(&self) -> bool {
        match self.phase {
            Phase::Resting(_) => true,
            Phase::Held => (self.target - self.angle).abs() < NEAR,
            Phase::Falling(_) | Phase::Playing(_) => false,
        }
    }

    /// A hand holds the board at `angle` (radians, clamped to 0..pi); it
    /// follows within a few hundredths of a second.
    pub fn hold(&mut self, angle: f32) {
        if angle.is_finite() {
            self.target = angle.clamp(0.0, core::f32::consts::PI);
            self.phase = Phase::Held;
        }
    }

    /// The hand lets go; the board falls to the side that its swing takes it.
    pub fn release(&mut self) {
        if self.phase == Phase::Held {
            // Where the swing of the next 0.15 s would take it decides.
            let ahead = self.angle + 0.15 * self.speed;
            self.phase = Phase::Falling(if ahead > core::f32::consts::FRAC_PI_2 {
                Side::Left
            } else {
                Side::Right
            });
        }
    }

    /// Swings the board to `side` in `seconds` (0.05 to 600, 1 where they are not finite)
    /// for a whole half turn, in proportion less from where it is. A swing already under
    /// way to that side goes on at the new pace.
    pub fn play(&mut self, side: Side, seconds: f32) {
        let mut course = 0.0;
        if self.phase == Phase::Playing(side) {
            course = self.time / self.seconds;
        } else {
            self.from = self.angle;
        }
        let fraction = (rest_angle(side) - self.from).abs() / core::f32::consts::PI;
        let whole = if seconds.is_finite() { seconds } else { 1.0 };
        self.seconds = (whole.clamp(0.05, LONGEST_TURN) * fraction).max(TICK);
        self.time = course * self.seconds;
        self.phase = Phase::Playing(side);
    }

    /// Steps by `ticks` of [`TICK`] seconds.
    pub fn step(&mut self, ticks: u32) {
        for _ in 0..ticks {
            match self.phase {
                Phase::Resting(_) => return,
                Phase::Held => self.follow(),
                Phase::Falling(side) => self.fall(side),
                Phase::Playing(side) => self.swing(side),
            }
        }
    }

    fn follow(&mut self) {
        let before = self.angle;
        self.angle += (self.target - self.angle) * (FOLLOW * TICK);
        self.speed = (self.angle - before) / TICK;
    }

    fn fall(&mut self, side: Side) {
        // Toward its side even from beyond the top: the hand's last push.
        let lean = libm::sincosf(self.angle).1.abs().max(0.15);
        let toward = if side == Side::Left { 1.0 } else { -1.0 };
        self.speed += TICK * (toward * FALL * lean - DAMPING * self.speed);
        self.angle += TICK * self.speed;
        let beyond = match side {
            Side::Right => self.angle <= 0.0,
            Side::Left => self.angle >= core::f32::consts::PI,
        };
        if beyond {
            *self = Board::new(side);
        }
    }

    fn swing(&mut self, side: Side) {
        self.time += TICK;
        let t = (self.time / self.seconds).min(1.0);
        let before = self.angle;
        let eased = t * t * (3.0 - 2.0 * t);
        self.angle = self.from + (rest_angle(side) - self.from) * eased;
        self.speed = (self.angle - before) / TICK;
        if t >= 1.0 {
            *self = Board::new(side);
        }
    }
}

fn rest_angle(side: Side) -> f32 {
    match side {
        Side::Right => 0.0,
        Side::Left => core::f32::consts::PI,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ticks_to_rest(board: &mut Board) -> u32 {
        for ticks in 0..2000 {
            if let Phase::Resting(_) = board.phase() {
                return ticks;
            }
            board.step(1);
        }
        panic!("the board never came to rest: {board:?}");
    }

    #[test]
    fn a_played_turn_takes_its_time_and_lands_exactly() {
        let mut board = Board::new(Side::Right);
        board.play(Side::Left, 0.8);
        let ticks = ticks_to_rest(&mut board);
        let seconds = ticks as f32 * TICK;
        assert!((0.79..=0.81).contains(&seconds), "{seconds} s");
        assert_eq!(board.angle(), core::f32::consts::PI);
        assert_eq!(board.phase(), Phase::Resting(Side::Left));
    }

    #[test]
    fn a_released_board_falls_to_the_nearer_side() {
        for (angle, side) in [(0.5, Side::Right), (1.4, Side::Right), (1.8, Side::Left)] {
            let mut board = Board::new(Side::Right);
            board.hold(angle);
            board.step(240);
            board.release();
            assert!(ticks_to_rest(&mut board) < 360);
            assert_eq!(board.phase(), Phase::Resting(side));
        }
    }

    #[test]
    fn a_flick_carries_it_over() {
        let mut board = Board::new(Side::Right);
        board.hold(2.4);
        board.step(3);
        assert!(board.angle() < core::f32::consts::FRAC_PI_2);
        board.release();
        ticks_to_rest(&mut board);
        assert_eq!(board.phase(), Phase::Resting(Side::Left));
    }

    #[test]
    fn a_turn_of_no_length_ends_too() {
        for seconds in [f32::INFINITY, f32::NAN, 0.0, -1.0] {
            let mut board = Board::new(Side::Right);
            board.play(Side::Left, seconds);
            assert!(ticks_to_rest(&mut board) <= 122);
        }
    }

    #[test]
    fn a_board_lies_still_where_a_hand_holds_it() {
        let mut board = Board::new(Side::Right);
        assert!(board.is_still());
        board.hold(1.0);
        assert!(!board.is_still());
        board.step(120);
        assert!(board.is_still());
        board.release();
        assert!(!board.is_still());
    }

    #[test]
    fn a_hand_that_is_nowhere_changes_nothing() {
        let mut board = Board::new(Side::Left);
        board.hold(f32::NAN);
        assert_eq!(board.phase(), Phase::Resting(Side::Left));
    }
}
