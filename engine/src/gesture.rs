//! How a hand turns a leaf: paths of the held nodes over time.

use crate::grid::Side;

/// Which nodes a gesture holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grip {
    /// The whole fore-edge column, as in the paper.
    ForeEdge,
    /// The node at the fore-edge's foot alone: the rest follows by itself.
    FootCorner,
}

/// A turn of a leaf by hand: each held node of the fore-edge runs along a half
/// circle about the spine from one side to the other, its angle a smoothstep of
/// time (Shangguan and Zeng 2014 move the control column "continuously"; the
/// path is this project's reading).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gesture {
    /// Side on which the leaf rests at first.
    pub from: Side,
    /// Duration in seconds, above 0.
    pub seconds: f32,
    /// Which nodes are held.
    pub grip: Grip,
    /// Radius of the half circle: the leaf's width, in its unit of length (metres, but for the preset
    /// `paper-2014`).
    pub radius: f32,
    /// Part of the duration by which the head's node starts after the foot's,
    /// 0 (all together) to below 1; the rows between in proportion.
    pub lag: f32,
    /// How far the hand is pulled in toward the spine half-way, as part of the
    /// radius: with 0 the leaf is taut all the way, above 0 it bows up.
    pub pull: f32,
    /// The same in proportion to the hand's height, so that the leaf is slack from
    /// the beginning: `lab agree`'s hand.
    pub slack: f32,
    /// How far the held foot corner is drawn toward the head half-way, in units
    /// of length.
    pub rise: f32,
}

impl Gesture {
    /// The paper's: the whole fore-edge column on one half circle of a radius, in the leaf's unit of
    /// length, in so many seconds.
    pub fn column(from: Side, radius: f32, seconds: f32) -> Self {
        let (lag, pull, slack, rise) = (0.0, 0.0, 0.0, 0.0);
        Self {
            from,
            seconds,
            grip: Grip::ForeEdge,
            radius,
            lag,
            pull,
            slack,
            rise,
        }
    }

    /// The foot corner leads and the other rows of the column follow, the head
    /// last.
    pub fn corner(from: Side, radius: f32, seconds: f32) -> Self {
        Self {
            lag: 0.35,
            ..Self::column(from, radius, seconds)
        }
    }

    /// Whether the node of the fore-edge in `row` is held.
    pub fn holds(&self, row: usize) -> bool {
        self.grip == Grip::ForeEdge || row == 0
    }

    /// Where the fore-edge's node that rests at `v` (0 foot, 1 head) and `y` is
    /// held at a time in seconds: before the start and after the end, where it
    /// lies flat.
    pub fn position(&self, v: f32, y: f32, time: f32) -> [f32; 3] {
        let part = (time / self.seconds - self.lag * v) / (1.0 - self.lag);
        let s = part.clamp(0.0, 1.0);
        let angle = core::f32::consts::PI * (s * s * (3.0 - 2.0 * s));
        let (sin, cos) = if s == 1.0 {
            (0.0, -1.0)
        } else {
            libm::sincosf(angle)
        };
        let radius = self.radius * (1.0 - self.pull * (sin * sin) - self.slack * sin);
        [
            self.from.sign() * (radius * cos),
            y + self.rise * (sin * sin),
            radius * sin,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_and_ends_at_rest_on_either_side() {
        for from in [Side::Left, Side::Right] {
            let gesture = Gesture {
                pull: 0.1,
                rise: 0.2,
                ..Gesture::corner(from, 2.0, 1.5)
            };
            for v in [0.0, 0.5, 1.0] {
                assert_eq!(
                    gesture.position(v, 0.3, -1.0),
                    [2.0 * from.sign(), 0.3, 0.0]
                );
                assert_eq!(gesture.position(v, 0.3, 0.0), [2.0 * from.sign(), 0.3, 0.0]);
                assert_eq!(
                    gesture.position(v, 0.3, 1.5),
                    [-2.0 * from.sign(), 0.3, 0.0]
                );
                assert_eq!(
                    gesture.position(v, 0.3, 9.0),
                    [-2.0 * from.sign(), 0.3, 0.0]
                );
            }
        }
    }

    #[test]
    fn half_way_it_stands_over_the_spine_at_its_pulled_in_radius() {
        let gesture = Gesture {
            pull: 0.25,
            ..Gesture::column(Side::Right, 2.0, 1.0)
        };
        let [x, y, z] = gesture.position(0.7, 0.1, 0.5);
        assert!(x.abs() < 1e-6 && y == 0.1 && (z - 1.5).abs() < 1e-6);
    }

    #[test]
    fn the_head_lags() {
        let gesture = Gesture::corner(Side::Right, 1.0, 1.0);
        assert!(gesture.position(0.0, 0.0, 0.4)[0] < gesture.position(1.0, 0.0, 0.4)[0]);
    }
}
