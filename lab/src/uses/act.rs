//! What readers do.

use core::f32::consts::PI;

use turnleaf_engine::Side;

use super::reader::Reader;

/// Height of a pointer's arch over the spine, as a part of its reach: the viewer's.
const ARCH: f32 = 0.62;

/// Frames in which a hand takes a leaf over.
const OVER: u32 = 48;
/// Frames in which a hand flicks a leaf up.
pub const FLICK: u32 = 9;

/// Frames before a held key repeats, and until it is let go.
const REPEATS: u32 = 30;
const KEY_UP: u32 = 102;

/// The frame at which a riffle is caught, or turned back.
const MIDDLE: u32 = 30;

/// One way of turning pages.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// A page by a click.
    Turn,
    /// A hand carries a leaf over.
    Drag,
    /// A hand flicks one up and lets it go.
    Flick,
    /// A key is held down.
    Key,
    /// The book is turned so many leaves on.
    Jump(u32),
    /// One leaf of a riffle is caught and waved.
    Catch,
    /// A riffle is sent back to where it began.
    RiffleBack,
    /// A page is turned, turned back in the air and turned once more.
    TurnBack,
    /// Two fingers carry a leaf over by both its corners.
    TwoFingers,
    /// One hand holds a leaf up while the other takes the next.
    TwoHands,
}

impl Use {
    /// All of them.
    pub const ALL: [Use; 12] = [
        Use::Turn,
        Use::Drag,
        Use::Flick,
        Use::Key,
        Use::Jump(12),
        Use::Jump(25),
        Use::Jump(50),
        Use::Catch,
        Use::RiffleBack,
        Use::TurnBack,
        Use::TwoFingers,
        Use::TwoHands,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Use::Turn => "turn",
            Use::Drag => "drag",
            Use::Flick => "flick",
            Use::Key => "key held",
            Use::Jump(12) => "jump 12",
            Use::Jump(25) => "jump 25",
            Use::Jump(_) => "jump 50",
            Use::Catch => "catch one of a riffle",
            Use::RiffleBack => "turn a riffle back",
            Use::TurnBack => "turn back",
            Use::TwoFingers => "two fingers",
            Use::TwoHands => "two grabs",
        }
    }

    /// Does what belongs before a frame, in a book that lay open at a spread. Returns whether it is
    /// not done yet.
    pub fn act(self, reader: &mut Reader, spread: u32, frame: u32) -> bool {
        match self {
            Use::Turn => {
                reader.press(1);
                false
            }
            Use::Drag => carry(reader, frame, OVER, 1.0),
            Use::Flick => carry(reader, frame, FLICK, 0.45),
            Use::Key => {
                if frame == 0 || (frame >= REPEATS && frame.is_multiple_of(2)) {
                    reader.press(1);
                }
                frame < KEY_UP
            }
            Use::Jump(leaves) => {
                reader.go_to(spread + leaves);
                false
            }
            Use::Catch => {
                if frame == 0 {
                    reader.go_to(spread + 25);
                }
                match frame.checked_sub(MIDDLE) {
                    Some(0) => reader.catch(0, [1.0, 0.2]),
                    Some(since) if since < OVER => {
                        let angle = 0.5 * PI * (1.0 + 0.6 * (0.2 * since as f32).sin());
                        reader.hold(0, on_arch(reader, angle, 0.2));
                    }
                    Some(_) => reader.release(0),
                    None => {}
                }
                frame < MIDDLE + OVER
            }
            Use::RiffleBack => {
                match frame {
                    0 => reader.go_to(spread + 12),
                    MIDDLE => reader.go_to(spread),
                    _ => {}
                }
                frame < MIDDLE
            }
            Use::TurnBack => {
                match frame {
                    0 | 36 => reader.press(1),
                    18 => reader.press(-1),
                    _ => {}
                }
                frame < 36
            }
            Use::TwoFingers => {
                let late = 10;
                if frame == 0 {
                    reader.take(Side::Right);
                    reader.grab(0, [1.0, 0.0]);
                    reader.grab(1, [1.0, 1.0]);
                }
                for (finger, after) in [(0, 0), (1, late)] {
                    let part = frame.saturating_sub(after).min(OVER) as f32 / OVER as f32;
                    reader.hold(finger, on_arch(reader, PI * part, finger as f32));
                }
                if frame == OVER + late {
                    reader.release(0);
                    reader.release(1);
                }
                frame < OVER + late
            }
            Use::TwoHands => {
                let begins = 24;
                if frame < begins {
                    carry(reader, frame, OVER, 1.0);
                    return true;
                }
                if frame == begins {
                    reader.take(Side::Right);
                    reader.grab(1, [1.0, 0.15]);
                }
                let since = frame - begins;
                let angle = PI * since.min(OVER) as f32 / OVER as f32;
                reader.hold(1, on_arch(reader, angle, 0.15));
                if since == OVER {
                    reader.release(1);
                    reader.release(0);
                }
                since < OVER
            }
        }
    }
}

/// A hand takes the leaf on the right by its edge, carries it by a part of the half turn in so many
/// frames, and lets go. Returns whether it still holds it.
pub fn carry(reader: &mut Reader, frame: u32, frames: u32, part: f32) -> bool {
    if frame == 0 {
        reader.take(Side::Right);
        reader.grab(0, [1.0, 0.15]);
    }
    reader.hold(
        0,
        on_arch(reader, PI * part * frame as f32 / frames as f32, 0.15),
    );
    if frame == frames {
        reader.release(0);
    }
    frame < frames
}

/// Where a pointer is that carries a leaf over the spine, by its angle around that and by v, metres.
fn on_arch(reader: &Reader, angle: f32, v: f32) -> [f32; 3] {
    let [width, height] = reader.page();
    let (x, z) = (width * angle.cos(), ARCH * width * angle.sin());
    [x, v * height, z.max(reader.floor(x))]
}
