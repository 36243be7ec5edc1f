//! When a sheet that the book does not time lies still.

use crate::vector::dot;

/// Speed of the nodes, root of the mean square, m/s, below which a sheet lies still, and the
/// ticks for which it does.
pub(super) const STILL: f32 = 1e-3;
const STILL_TICKS: u32 = 24;

/// Ticks after which a sheet that was let go has come down, if nothing trembles.
const DOWN: u32 = 120;

/// Ticks after which it is left as it lies, or as grabs that do not move hold it.
pub(super) const LONGEST_FALL: u32 = 480;

/// For how many ticks a sheet lies still, falls, and is held by grabs that do not move.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stillness {
    still: u32,
    fallen: u32,
    held: u32,
}

impl Stillness {
    /// Counts from now on anew.
    pub fn wake(&mut self) {
        *self = Self::default();
    }

    /// Counts a tick after which the nodes move at `velocities`, x, y, z of each, m/s: still where
    /// that is below the speed of `slowest`.
    pub fn count(&mut self, velocities: &[f32], is_held: bool, slowest: f32) {
        let nodes = velocities.as_chunks::<3>().0;
        let square = nodes.iter().map(|v| dot(*v, *v)).sum::<f32>() / nodes.len() as f32;
        self.still = if square < slowest * slowest {
            self.still + 1
        } else {
            0
        };
        self.fallen += u32::from(!is_held);
        self.held += u32::from(is_held);
    }

    /// Whether it lies or is held still.
    #[cfg(test)]
    pub fn is_still(self) -> bool {
        self.still >= STILL_TICKS
    }

    /// Whether it was let go for so long that what still moves only trembles.
    pub fn is_down(self) -> bool {
        self.fallen >= DOWN
    }

    /// Whether it does not move until the next command: it lies or is held still, or has been let
    /// go or held by grabs that do not move for so long that it is left as it is.
    pub fn is_asleep(self) -> bool {
        self.still >= STILL_TICKS || self.fallen.max(self.held) >= LONGEST_FALL
    }
}
