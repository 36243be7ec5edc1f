//! What the files of key frames of any version have in common: the first
//! bytes, the checksum at the end, and what can be wrong with them.

use super::{FrameKind, KeyFrames};
use crate::hash::BitHash;
use crate::models::ModelKind;
use crate::models::mass_spring::Preset;

/// The newest version that is read; [`Condensed`](super::Condensed) writes it.
pub const FORMAT_VERSION: u16 = 3;

const MAGIC: [u8; 4] = *b"TLKF";
/// Bytes of the header that all versions begin with.
pub(super) const HEADER: usize = 36;
/// Bytes of the checksum that all files end with.
pub(super) const CHECKSUM: usize = 8;
/// More points along a side, or more frames, than any real record has.
const MOST_POINTS: u32 = 4096;
const MOST_FRAMES: u32 = 1 << 20;

/// Why bytes are no key frames. Displayed as one sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum KeyFrameError {
    /// The file does not begin as key frames do.
    NotKeyFrames,
    /// It was written by a newer program.
    FutureVersion(u16),
    /// It ends early, or goes on where it should end: bytes that it should have
    /// and has.
    WrongLength {
        /// Bytes by its own account.
        expected: u64,
        /// Bytes that are there.
        found: u64,
    },
    /// Its checksum does not fit its content.
    Damaged,
    /// A number of its header is impossible.
    BadHeader {
        /// Which.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// A time is no number, or not after the one before.
    BadTime {
        /// Counted from 0.
        frame: usize,
    },
    /// Its mesh, of another shape than a grid, cannot be read or is none.
    BadMesh,
    /// A coordinate is no finite number.
    BadPosition {
        /// Counted from 0.
        frame: usize,
    },
}

impl core::fmt::Display for KeyFrameError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotKeyFrames => write!(
                f,
                "This is not a file of key frames: it does not begin with \"TLKF\"."
            ),
            Self::FutureVersion(version) => write!(
                f,
                "These key frames are of version {version}, and this program reads versions up to {FORMAT_VERSION}."
            ),
            Self::WrongLength { expected, found } => {
                write!(
                    f,
                    "These key frames should be {expected} bytes long and are {found}."
                )
            }
            Self::Damaged => write!(
                f,
                "These key frames are damaged: their checksum does not fit."
            ),
            Self::BadHeader { field, value } => {
                write!(f, "The {field} of these key frames cannot be {value}.")
            }
            Self::BadTime { frame } => {
                write!(
                    f,
                    "The time of key frame {frame} is not a number after the one before."
                )
            }
            Self::BadMesh => write!(f, "The mesh of these key frames cannot be."),
            Self::BadPosition { frame } => {
                write!(
                    f,
                    "Key frame {frame} has a coordinate that is not a finite number."
                )
            }
        }
    }
}

impl core::error::Error for KeyFrameError {}

impl KeyFrames {
    /// The first bytes of a file.
    pub(super) fn header(&self, version: u16) -> Vec<u8> {
        let mut bytes = Vec::new();
        bytes.extend(MAGIC);
        bytes.extend(version.to_le_bytes());
        let kind: u16 = match self.kind {
            FrameKind::Masses => 0,
            FrameKind::Surface => 1,
        };
        bytes.extend(kind.to_le_bytes());
        bytes.extend(self.model.id().to_le_bytes());
        bytes.extend(self.preset.id().to_le_bytes());
        self.size
            .iter()
            .for_each(|side| bytes.extend(side.to_le_bytes()));
        for count in [self.columns, self.rows, self.times.len()] {
            bytes.extend((count as u32).to_le_bytes());
        }
        bytes
    }
}

/// The version that bytes say they are of.
///
/// # Errors
/// Where they are of no such file, or of a version newer than [`FORMAT_VERSION`].
pub(super) fn version(bytes: &[u8]) -> Result<u16, KeyFrameError> {
    if bytes.len() < 4 || bytes[..4] != MAGIC {
        return Err(KeyFrameError::NotKeyFrames);
    }
    let version = bytes.get(4..6).ok_or(KeyFrameError::WrongLength {
        expected: (HEADER + CHECKSUM) as u64,
        found: bytes.len() as u64,
    })?;
    let version = u16::from_le_bytes([version[0], version[1]]);
    if version > FORMAT_VERSION {
        return Err(KeyFrameError::FutureVersion(version));
    }
    Ok(version)
}

/// A file's bytes from all of them but the last.
pub(super) fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.extend(checksum(&bytes).to_le_bytes());
    bytes
}

/// The content of a file that should be so long, without its checksum.
///
/// # Errors
/// Where there are more or fewer bytes, or the checksum is not theirs.
pub(super) fn unsealed(bytes: &[u8], expected: u64) -> Result<&[u8], KeyFrameError> {
    let found = bytes.len() as u64;
    if found != expected {
        return Err(KeyFrameError::WrongLength { expected, found });
    }
    let (content, sum) = bytes.split_at(bytes.len() - CHECKSUM);
    if checksum(content).to_le_bytes() != sum {
        return Err(KeyFrameError::Damaged);
    }
    Ok(content)
}

/// Checks that times of frames, seconds, rise.
///
/// # Errors
/// Where one is not finite, or not after the one before.
pub(super) fn rising(times: &[f32]) -> Result<(), KeyFrameError> {
    let mut before = f32::NEG_INFINITY;
    for (frame, &time) in times.iter().enumerate() {
        if !(time.is_finite() && time > before) {
            return Err(KeyFrameError::BadTime { frame });
        }
        before = time;
    }
    Ok(())
}

/// What the first bytes say.
pub(super) struct Header {
    /// What a frame holds.
    pub kind: FrameKind,
    /// The model that was recorded.
    pub model: ModelKind,
    /// The preset of its settings.
    pub preset: Preset,
    /// Width and height of the leaf, both above 0: metres, or the preset's own unit of length.
    pub size: [f32; 2],
    /// Points along a row of a frame.
    pub columns: u32,
    /// Rows of a frame.
    pub rows: u32,
    /// How many frames follow.
    pub frames: u32,
}

impl Header {
    /// Reads and checks them; `length` is that of the whole header.
    ///
    /// # Errors
    /// Where there are too few bytes, or a field is out of its bounds.
    pub fn read(bytes: &[u8], version: u16, length: usize) -> Result<Self, KeyFrameError> {
        if bytes.len() < length + CHECKSUM {
            return Err(KeyFrameError::WrongLength {
                expected: (length + CHECKSUM) as u64,
                found: bytes.len() as u64,
            });
        }
        let word = |at: usize| [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
        let number = |at: usize| u32::from_le_bytes(word(at));
        let real = |at: usize| f32::from_le_bytes(word(at));
        let reject = |field: &'static str, value: f64| KeyFrameError::BadHeader { field, value };
        if version == 0 {
            return Err(reject("version", 0.0));
        }
        let kind = u16::from_le_bytes([bytes[6], bytes[7]]);
        let kind = match kind {
            0 => FrameKind::Masses,
            1 => FrameKind::Surface,
            _ => return Err(reject("kind of frame", f64::from(kind))),
        };
        let model = ModelKind::from_id(number(8)).ok_or(reject("model", f64::from(number(8))))?;
        let preset = Preset::from_id(number(12)).ok_or(reject("preset", f64::from(number(12))))?;
        let size = [real(16), real(20)];
        for (field, value) in ["width", "height"].into_iter().zip(size) {
            if !(value > 0.0 && value.is_finite()) {
                return Err(reject(field, f64::from(value)));
            }
        }
        let counts = [
            ("number of columns", number(24), 2, MOST_POINTS),
            ("number of rows", number(28), 2, MOST_POINTS),
            ("number of frames", number(32), 1, MOST_FRAMES),
        ];
        for (field, count, least, most) in counts {
            if !(least..=most).contains(&count) {
                return Err(reject(field, f64::from(count)));
            }
        }
        let (columns, rows, frames) = (number(24), number(28), number(32));
        Ok(Self {
            kind,
            model,
            preset,
            size,
            columns,
            rows,
            frames,
        })
    }

    /// Bytes of the whole file. The limits on the counts keep it from overflow.
    pub fn file_length(&self) -> u64 {
        let points = u64::from(self.columns) * u64::from(self.rows);
        let floats = u64::from(self.frames) * (1 + 3 * points);
        (HEADER + CHECKSUM) as u64 + 4 * floats
    }

    /// Reads the frames of version 1 from what follows the header. Fails if times do not rise or a
    /// position is not finite.
    pub fn content(self, bytes: &[u8]) -> Result<KeyFrames, KeyFrameError> {
        let (words, _) = bytes.as_chunks::<4>();
        let mut times: Vec<f32> = words.iter().map(|word| f32::from_le_bytes(*word)).collect();
        let positions = times.split_off(self.frames as usize);
        rising(&times)?;
        if let Some(at) = positions.iter().position(|value| !value.is_finite()) {
            let frame = at / (3 * self.columns as usize * self.rows as usize);
            return Err(KeyFrameError::BadPosition { frame });
        }
        Ok(KeyFrames {
            kind: self.kind,
            model: self.model,
            preset: self.preset,
            size: self.size,
            columns: self.columns as usize,
            rows: self.rows as usize,
            times,
            positions,
        })
    }
}

fn checksum(bytes: &[u8]) -> u64 {
    let mut hash = BitHash::new();
    hash.bytes(bytes);
    hash.value()
}
