//! A recorded turn as it is handed out: few key frames, where the motion needs
//! them, rounded, and packed into few bytes.
//!
//! Its file is version 2 of the key frames', or version 3 if the surface's mesh is
//! not a grid. All numbers are little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 0..4 | `TLKF` |
//! | 4..6 | u16 version: 2 or 3 |
//! | 6..36 | as in version 1 |
//! | 36..40 | f32 quantum: what every coefficient is a whole multiple of |
//! | 40..44 | f32 error: how far a Hermite blend is at most from the recording, over the width |
//! | 44..48 | u32 bytes of the packed coefficients |
//! | 48..56 | in version 3 alone: u32 triangles of the mesh, u32 bytes of the packed mesh |
//! | then | f32 u of each column, f32 v of each row, rising from 0 to 1 |
//! | then | f32 time of each frame |
//! | then | in version 3 alone: the packed mesh (`mesh.rs`) |
//! | then | the packed coefficients |
//! | last 8 | u64 FNV-1a of all bytes before |
//!
//! x, y and z of a frame are each a sum of polynomials (`polynomial_basis.rs`),
//! whose coefficients are packed frame by frame: two bits say whether they are kept as they are (0),
//! less those of the frame before (1), or less those to which the two frames
//! before lead in a straight line (2); then follow the multiples, the smoothest
//! first, in Rice's code (`bits.rs`).

use super::bits::{BitReader, BitWriter};
use super::choose::{choose, farthest};
use super::header::{CHECKSUM, HEADER, Header, rising, sealed, unsealed, version};
use super::polynomial_basis::{PolynomialBasis, order};
use super::{KeyFrameError, KeyFrames, mesh};
use crate::paper_mesh::PaperMesh;

/// The version of a grid, and that of another mesh.
const GRID: u16 = 2;
const MESH: u16 = 3;
const OWN_HEADER: usize = 48;
const MESH_HEADER: usize = 56;

/// Points of all frames together: what is packed into nothing unpacks to no more
/// than this.
const MOST_POINTS: u64 = 1 << 22;

/// Points along a side.
const MOST_ALONG: u32 = 256;

/// A quantum is below this, metres.
const MOST_QUANTUM: f32 = 1e6;

/// The largest multiple of the quantum.
const MOST: f64 = (1 << 24) as f64;

/// The part of the tolerance that rounding may take; the rest is the blend's.
const ROUNDING: f32 = 0.4;

/// Bytes that a frame takes at least when packed: for each axis 2 bits say the way
/// and 22 begin a run.
const LEAST_PACKED: u64 = 9;

/// A recorded turn of a surface, condensed.
#[derive(Clone, Debug, PartialEq)]
pub struct Condensed {
    /// The key frames, to be blended by [`Blend::Hermite`](super::Blend).
    pub frames: KeyFrames,
    /// u of each column of points, rising from 0 to 1.
    pub u: Vec<f32>,
    /// v of each row, likewise.
    pub v: Vec<f32>,
    /// How far the blend is at most from the recording, over the width.
    pub error: f32,
    /// How the points lie on the flat paper and hang together, if not as a grid's at `u` and
    /// `v`: see [`Condensed::with_mesh`].
    pub mesh: Option<PaperMesh>,
    quantum: f32,
    /// Multiples of the quantum: of x, of y and of z of each frame, frame after frame.
    multiples: Vec<i32>,
}

impl Condensed {
    /// Condenses a recording of frames as close as they are to be compared,
    /// every step's or every drawn one's. The replay is nowhere farther from it
    /// than `tolerance`, over the width. `u` and `v` are the places of its columns
    /// and rows, rising from 0 to 1.
    ///
    /// # Errors
    /// Where there is nothing recorded, more than a file may hold, or what cannot
    /// be stated so finely or so coarsely.
    ///
    /// # Panics
    /// If `u` and `v` are not as many as columns and rows, or the tolerance is
    /// not above 0.
    pub fn of(
        recording: &KeyFrames,
        u: &[f32],
        v: &[f32],
        tolerance: f32,
    ) -> Result<Self, KeyFrameError> {
        let reject = |field: &'static str, value: f64| KeyFrameError::BadHeader { field, value };
        assert!(u.len() == recording.columns && v.len() == recording.rows);
        assert!(tolerance > 0.0, "the tolerance is above 0");
        let all = recording.positions.len() / 3;
        if all == 0 || all as u64 > MOST_POINTS {
            return Err(reject("number of points", all as f64));
        }
        for (field, count) in [("columns", recording.columns), ("rows", recording.rows)] {
            if count > MOST_ALONG as usize {
                return Err(reject(field, count as f64));
            }
        }
        let points = recording.columns * recording.rows;
        let basis = basis(u, v)?;
        let tolerance = tolerance * recording.size[0];
        let coefficients: Vec<Vec<f64>> = (0..3 * recording.len())
            .map(|at| {
                let values = recording.frame(at / 3).iter().skip(at % 3).step_by(3);
                basis.coefficients(&values.map(|x| f64::from(*x)).collect::<Vec<_>>())
            })
            .collect();
        let mut quantum = 4.0 * tolerance;
        if quantum.is_nan() || quantum >= MOST_QUANTUM {
            return Err(reject("tolerance", f64::from(tolerance)));
        }
        let (multiples, rounded) = loop {
            let multiples = round(&coefficients, quantum);
            let multiples = multiples.ok_or(reject("tolerance", f64::from(tolerance)))?;
            let rounded = positions(&basis, points, &multiples, quantum);
            if farthest(&rounded, &recording.positions) <= ROUNDING * tolerance {
                break (multiples, rounded);
            }
            quantum *= 0.8;
        };
        let (keys, error) = choose(recording, &rounded, tolerance);
        let length = recording.frame_length();
        let frame = |key: &usize| &rounded[key * length..(key + 1) * length];
        Ok(Self {
            frames: KeyFrames {
                times: keys.iter().map(|key| recording.times[*key]).collect(),
                positions: keys.iter().flat_map(frame).copied().collect(),
                ..recording.clone()
            },
            u: u.to_vec(),
            v: v.to_vec(),
            error: error / recording.size[0],
            mesh: None,
            quantum,
            multiples: keys
                .iter()
                .flat_map(|key| &multiples[key * length..(key + 1) * length])
                .copied()
                .collect(),
        })
    }

    /// The same recording, of a surface that is not a grid: a creased leaf's. The places of its
    /// points are rounded to 65535 parts of the leaf.
    ///
    /// # Errors
    /// Where it is no mesh of the recorded points.
    pub fn with_mesh(mut self, mesh: &PaperMesh) -> Result<Self, KeyFrameError> {
        let mesh = mesh::rounded(mesh, self.frames.columns, self.frames.rows);
        self.mesh = Some(mesh.ok_or(KeyFrameError::BadMesh)?);
        Ok(self)
    }

    /// The file's bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let packed = self.pack();
        let packed_mesh = self
            .mesh
            .as_ref()
            .map_or_else(Vec::new, |mesh| mesh::pack(mesh, &self.u, &self.v));
        let version = if self.mesh.is_some() { MESH } else { GRID };
        let mut bytes = self.frames.header(version);
        for value in [self.quantum, self.error] {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend((packed.len() as u32).to_le_bytes());
        if let Some(mesh) = &self.mesh {
            for count in [mesh.triangles.len(), packed_mesh.len()] {
                bytes.extend((count as u32).to_le_bytes());
            }
        }
        for value in self.u.iter().chain(&self.v).chain(&self.frames.times) {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend(packed_mesh);
        bytes.extend(packed);
        sealed(bytes)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// If they are anything but a whole and unchanged file of versions 2 or 3 whose
    /// every number makes sense.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, KeyFrameError> {
        let reject = |field: &'static str, value: f64| KeyFrameError::BadHeader { field, value };
        let version = version(bytes)?;
        let own_header = match version {
            GRID => OWN_HEADER,
            MESH => MESH_HEADER,
            _ => return Err(reject("version", f64::from(version))),
        };
        let header = Header::read(bytes, version, own_header)?;
        for (field, count) in [
            ("number of columns", header.columns),
            ("number of rows", header.rows),
        ] {
            if count > MOST_ALONG {
                return Err(reject(field, f64::from(count)));
            }
        }
        let all = u64::from(header.columns * header.rows) * u64::from(header.frames);
        if all > MOST_POINTS {
            return Err(reject("number of points", all as f64));
        }
        let [columns, rows, count] =
            [header.columns, header.rows, header.frames].map(|count| count as usize);
        let points = columns * rows;
        let mesh_at = own_header + 4 * (columns + rows + count);
        let (words, _) = bytes[HEADER..].as_chunks::<4>();
        let number = |at: usize| u32::from_le_bytes(words[at]);
        let packed = u64::from(number(2));
        let [triangles, packed_mesh] = if version == MESH {
            [number(3), number(4)]
        } else {
            [0; 2]
        };
        let expected = (mesh_at + CHECKSUM) as u64 + u64::from(packed_mesh) + packed;
        let content = unsealed(bytes, expected)?;
        let packed_at = mesh_at + packed_mesh as usize;
        if packed < LEAST_PACKED * u64::from(header.frames) {
            let frame = (packed / LEAST_PACKED) as usize;
            return Err(KeyFrameError::BadPosition { frame });
        }
        let real = |at: usize| f32::from_le_bytes(words[at]);
        let reals = |from: usize, count: usize| (from..from + count).map(real).collect();
        let (quantum, error) = (real(0), real(1));
        if !(quantum > 0.0 && quantum < MOST_QUANTUM) {
            return Err(reject("quantum", f64::from(quantum)));
        }
        if !(0.0..=1e6).contains(&error) {
            return Err(reject("error", f64::from(error)));
        }
        let first = (own_header - HEADER) / 4;
        let (u, v): (Vec<f32>, Vec<f32>) = (reals(first, columns), reals(first + columns, rows));
        let times: Vec<f32> = reals(first + columns + rows, count);
        rising(&times)?;
        let basis = basis(&u, &v)?;
        let mesh = if version == MESH {
            let packed = &content[mesh_at..packed_at];
            let mesh = mesh::unpack(packed, &u, &v, triangles as usize);
            Some(mesh.ok_or(KeyFrameError::BadMesh)?)
        } else {
            None
        };
        let multiples = unpack(&content[packed_at..], &times, &order(columns, rows))?;
        Ok(Self {
            frames: KeyFrames {
                kind: header.kind,
                model: header.model,
                preset: header.preset,
                size: header.size,
                columns,
                rows,
                positions: positions(&basis, points, &multiples, quantum),
                times,
            },
            u,
            v,
            error,
            mesh,
            quantum,
            multiples,
        })
    }

    fn pack(&self) -> Vec<u8> {
        let order = order(self.frames.columns, self.frames.rows);
        let times = &self.frames.times;
        let mut writer = BitWriter::default();
        for (at, multiples) in self.multiples.chunks_exact(order.len()).enumerate() {
            let before = &self.multiples[..at * order.len()];
            let ways = (0..=(at / 3).min(2)).map(|way| {
                let rest = order.iter().map(|place| {
                    multiples[*place] - expected(before, order.len(), times, way, *place)
                });
                let mut trial = writer.clone();
                trial.bits(way as u32, 2);
                trial.run(&rest.collect::<Vec<_>>());
                trial
            });
            writer = ways.min_by_key(BitWriter::length).unwrap_or_default();
        }
        writer.finish()
    }
}

/// The basis over places, which rise from 0 to 1.
fn basis(u: &[f32], v: &[f32]) -> Result<PolynomialBasis, KeyFrameError> {
    for (field, places) in [("place of columns", u), ("place of rows", v)] {
        let rise = places.windows(2).all(|pair| pair[0] < pair[1]);
        if !(rise && places[0] == 0.0 && places[places.len() - 1] == 1.0) {
            return Err(KeyFrameError::BadHeader {
                field,
                value: f64::from(places[0]),
            });
        }
    }
    PolynomialBasis::new(u, v).ok_or(KeyFrameError::BadHeader {
        field: "distance of columns or rows",
        value: 0.0,
    })
}

/// The nearest multiples; None where one is too large.
fn round(coefficients: &[Vec<f64>], quantum: f32) -> Option<Vec<i32>> {
    let round = |coefficient: &f64| {
        let multiple = (coefficient / f64::from(quantum)).round();
        (multiple.abs() <= MOST).then_some(multiple as i32)
    };
    coefficients.iter().flatten().map(round).collect()
}

/// Positions of all frames, of so many points each, from the multiples of their axes.
fn positions(basis: &PolynomialBasis, points: usize, multiples: &[i32], quantum: f32) -> Vec<f32> {
    let mut positions = Vec::with_capacity(multiples.len());
    for axes in multiples.chunks_exact(3 * points) {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let coefficients = axes[axis * points..(axis + 1) * points].iter();
            let coefficients: Vec<f64> = coefficients
                .map(|m| f64::from(*m) * f64::from(quantum))
                .collect();
            basis.values(&coefficients)
        });
        for ((x, y), z) in x.iter().zip(&y).zip(&z) {
            positions.extend([*x as f32, *y as f32, *z as f32]);
        }
    }
    positions
}

/// The multiples that [`Condensed::pack`] packed.
fn unpack(packed: &[u8], times: &[f32], order: &[usize]) -> Result<Vec<i32>, KeyFrameError> {
    let points = order.len();
    let mut reader = BitReader::new(packed);
    let mut rest = vec![0; points];
    let mut all = vec![0; 3 * points * times.len()];
    for at in 0..3 * times.len() {
        let frame = at / 3;
        let bad = KeyFrameError::BadPosition { frame };
        let way = reader.bits(2).ok_or(bad.clone())? as usize;
        if way > frame.min(2) {
            return Err(bad);
        }
        reader.run(&mut rest).ok_or(bad.clone())?;
        let (before, own) = all.split_at_mut(at * points);
        for (place, rest) in order.iter().zip(&rest) {
            let multiple = rest + expected(before, points, times, way, *place);
            if f64::from(multiple).abs() > MOST {
                return Err(bad);
            }
            own[*place] = multiple;
        }
    }
    if !reader.is_at_end() {
        return Err(KeyFrameError::BadPosition {
            frame: times.len() - 1,
        });
    }
    Ok(all)
}

/// What the frames before let expect of a multiple. `before` holds all axes before,
/// of so many points each.
fn expected(before: &[i32], points: usize, times: &[f32], way: usize, place: usize) -> i32 {
    let back = |axes: usize| before[before.len() - axes * points + place];
    match way {
        0 => 0,
        1 => back(3),
        _ => {
            let frame = before.len() / points / 3;
            let [t0, t1, t2] = [2, 1, 0].map(|back| f64::from(times[frame - back]));
            let [a, b] = [6, 3].map(|axes| f64::from(back(axes)));
            let line = b + (b - a) * ((t2 - t1) / (t1 - t0));
            // Half up, as browsers round.
            (line + 0.5).floor().clamp(-MOST, MOST) as i32
        }
    }
}
