//! The file format of key frames, version 1: every float as it is. Versions 2 and 3
//! are those of [`Condensed`]. All numbers are little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 0..4 | `TLKF` |
//! | 4..6 | u16 version: 1 |
//! | 6..8 | u16 kind of frame: 0 masses, 1 surface |
//! | 8..12 | u32 model: [`ModelKind::id`](crate::ModelKind::id) |
//! | 12..16 | u32 preset: 0 custom, 1 paper-2014, 2 book |
//! | 16..24 | f32 width, f32 height of the leaf |
//! | 24..36 | u32 columns, u32 rows, u32 number of frames |
//! | then | f32 time of each frame |
//! | then | f32 x, y, z of each point, frame after frame |
//! | last 8 | u64 FNV-1a of all bytes before |
//!
//! A reader accepts nothing but a whole, unchanged file of a version it knows.

use super::header::{HEADER, Header, sealed, unsealed, version};
use super::{Condensed, KeyFrameError, KeyFrames};

/// The version of frames that are written whole.
const WHOLE: u16 = 1;

impl KeyFrames {
    /// The bytes of a file of version 1: every float as it is.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = self.header(WHOLE);
        for value in self.times.iter().chain(&self.positions) {
            bytes.extend(value.to_le_bytes());
        }
        sealed(bytes)
    }

    /// Reads a file's bytes, of any version; the mesh of version 3 is [`Condensed::mesh`].
    ///
    /// # Errors
    /// If they are anything but a whole and unchanged file of a known version
    /// whose every number makes sense.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, KeyFrameError> {
        let version = version(bytes)?;
        if version > WHOLE {
            return Condensed::from_bytes(bytes).map(|condensed| condensed.frames);
        }
        let header = Header::read(bytes, version, HEADER)?;
        let content = unsealed(bytes, header.file_length())?;
        header.content(&content[HEADER..])
    }
}
