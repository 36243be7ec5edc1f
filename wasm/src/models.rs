//! The face of loose leaves, for what compares models, plays with them and bakes
//! them: every model of the engine, one leaf a handle. No book uses it; it is in
//! a WASM of its own.
//!
//! A leaf is the address of a boxed [`Loose`], 0 where none could be made; then
//! [`tl_leaf_error`] says why. The typed wrapper is the viewer's
//! `models/models.ts`; its comments say what each does. Arrays that a function
//! returns the address of stay there until the next [`tl_leaf_update`] that
//! changes their length. Handles and numbers that are none are rejected as those
//! of a book are.

use turnleaf_engine::{
    Discretisation, InvalidLoose, LooseLeaf, LooseSettings, ModelKind, PaperMesh, Preset, Stock,
    Surface, Synchronise, TurnBy, TurnModel,
};

use crate::drawn::{Drawn, drawn};
use crate::live::{Live, Nothing};
use crate::side;

/// The leaves that are alive, and the rooms for figures that no leaf was made of yet.
static LEAVES: Live<Loose> = Live::new();
static ROOMS: Live<[f64; FIGURES]> = Live::new();

/// Places of columns, or of rows, at which a leaf is drawn at most.
const MOST_SAMPLES: usize = 1024;

/// Creases of a leaf at most, and the numbers of each: two places on it (u and v, 0 to 1) and its
/// rest angle, radians.
const MOST_CREASES: usize = 16;
const CREASE_NUMBERS: usize = 5;

/// A leaf, and what of it is read.
pub struct Loose {
    leaf: LooseLeaf,
    surface: Surface,
    positions: Vec<f32>,
    velocities: Vec<f32>,
    /// Kinetic, bending and gravity energy, J; largest stretch and compression.
    figures: [f64; 5],
    record: Vec<u8>,
    /// Places of columns, then of rows.
    samples: Vec<f32>,
    /// Creases that it is to get, and one as it is.
    creases: [[f64; CREASE_NUMBERS]; MOST_CREASES],
    crease: [f64; 3],
    /// How it is drawn if it is creased.
    mesh: Option<PaperMesh>,
}

/// Why the last leaf could not be made, drawn or creased.
static ERROR: std::sync::Mutex<String> = std::sync::Mutex::new(String::new());

/// Numbers of [`tl_leaf_new`], in their order.
const FIGURES: usize = 21;

fn settings(figures: &[f64; FIGURES]) -> Result<LooseSettings, InvalidLoose> {
    let [
        kind,
        width,
        height,
        grammage,
        caliper,
        along,
        across,
        from,
        gravity,
        air,
        node_columns,
        node_rows,
        time_step,
        columns,
        rows,
        preset,
        parallel,
        angle,
        interpolate,
        triangles,
        friction,
    ] = *figures;
    let kind = ModelKind::from_id(kind as u32)
        .ok_or_else(|| InvalidLoose(format!("There is no model number {kind}.")))?;
    let mut stock = Stock::new(grammage, caliper, along, across)
        .map_err(|error| InvalidLoose(error.to_string()))?;
    stock.friction = friction;
    Ok(LooseSettings {
        side: side(from as u32),
        gravity,
        air,
        nodes: (node_columns > 0.0).then_some([node_columns as usize, node_rows as usize]),
        time_step: (time_step != 0.0).then_some(time_step),
        samples: [columns as usize, rows as usize],
        preset: if preset == 0.0 {
            Preset::Paper2014
        } else {
            Preset::Book
        },
        synchronise: match parallel as u32 {
            0 => Synchronise::Off,
            1 => Synchronise::Columns,
            _ => Synchronise::DogEar {
                angle: angle as f32,
            },
        },
        interpolate: interpolate != 0.0,
        discretisation: if triangles == 0.0 {
            Discretisation::Grid
        } else {
            Discretisation::Triangles
        },
        ..LooseSettings::leaf(kind, [width, height], stock)
    })
}

/// Room for the figures of one call of [`tl_leaf_new`].
#[unsafe(no_mangle)]
pub extern "C" fn tl_leaf_figures() -> *mut [f64; FIGURES] {
    ROOMS.keep([0.0; FIGURES])
}

/// Makes a leaf, flat and still, of the figures in the room, which is freed: number
/// of its [`ModelKind`], width, height, grammage, caliper, stiffness along and
/// across, side (0 right), gravity, air (1 the real one), columns and rows of nodes
/// (0 the model's own), time step (0 the model's own), columns and rows of points,
/// preset of springs (0 the paper's), lines kept parallel (0 none, 1 columns, 2 at
/// the angle that follows), interpolation of springs, triangles of a shell,
/// friction. 0 where these make no leaf, or there is no such room.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_leaf_new(figures: *mut [f64; FIGURES]) -> *mut Loose {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let Some(figures) = (unsafe { ROOMS.take(figures) }) else {
        return core::ptr::null_mut();
    };
    match settings(&figures).and_then(LooseLeaf::new) {
        Ok(leaf) => {
            let mut loose = Loose {
                leaf,
                surface: Surface::new(2, 2),
                positions: Vec::new(),
                velocities: Vec::new(),
                figures: [0.0; 5],
                record: Vec::new(),
                samples: Vec::new(),
                creases: [[0.0; CREASE_NUMBERS]; MOST_CREASES],
                crease: [0.0; 3],
                mesh: None,
            };
            update(&mut loose);
            LEAVES.keep(loose)
        }
        Err(error) => {
            note(&error);
            core::ptr::null_mut()
        }
    }
}

/// Keeps the sentence of an error.
fn note(error: &InvalidLoose) {
    if let Ok(mut last) = ERROR.lock() {
        *last = error.to_string();
    }
}

/// Creases a leaf along the first lines in its room. Returns whether it could be.
fn crease(loose: &mut Loose, count: usize) -> bool {
    let line = |[a, b, c, d, rest]: &[f64; CREASE_NUMBERS]| ([[*a, *b], [*c, *d]], *rest);
    let lines: Vec<_> = loose.creases.iter().take(count).map(line).collect();
    if count > MOST_CREASES {
        note(&InvalidLoose("A leaf has 16 creases at most.".into()));
        return false;
    }
    if let Err(error) = loose.leaf.crease(&lines) {
        note(&error);
        return false;
    }
    loose.mesh = loose.leaf.paper_mesh();
    true
}

/// Frees a leaf.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_leaf_drop(leaf: *mut Loose) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    drop(unsafe { LEAVES.take(leaf) });
}

/// Address of the sentence that says why the last leaf could not be made, drawn or creased, UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn tl_leaf_error() -> *const u8 {
    ERROR.lock().map_or(core::ptr::null(), |last| last.as_ptr())
}

/// Length of that sentence in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn tl_leaf_error_length() -> usize {
    ERROR.lock().map_or(0, |last| last.len())
}

/// Hash of the exact bits of a second of a turn by the corner of a model's
/// leaf, for the golden test.
#[unsafe(no_mangle)]
pub extern "C" fn tl_leaf_hash(kind: u32) -> u64 {
    ModelKind::from_id(kind).map_or(0, turnleaf_engine::trials::loose_hash)
}

fn update(loose: &mut Loose) {
    loose.leaf.write_surface(&mut loose.surface);
    loose.surface.update_normals();
    let (columns, rows) = loose.leaf.grid_size();
    loose.positions.resize(3 * columns * rows, 0.0);
    loose.velocities.resize(3 * columns * rows, 0.0);
    loose
        .leaf
        .read_nodes(&mut loose.positions, &mut loose.velocities);
}

fn turn(number: u32) -> TurnBy {
    *TurnBy::ALL.get(number as usize).unwrap_or(&TurnBy::Corner)
}

/// Declares exported functions on a leaf, each a call to the engine.
macro_rules! leaf_functions {
    ($($(#[$doc:meta])* fn $name:ident($leaf:ident $(, $arg:ident: $type:ty)*) $(-> $result:ty)? $body:block)*) => {$(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($leaf: *mut Loose $(, $arg: $type)*) $(-> $result)? {
            // SAFETY: from one thread by the crate's contract, so that no other call uses it.
            let Some($leaf) = (unsafe { LEAVES.get($leaf) }) else {
                return Nothing::NOTHING;
            };
            $body
        }
    )*};
}

leaf_functions! {
    /// Lays the leaf flat and still on a side.
    fn tl_leaf_lay(loose, on: u32) { loose.leaf.lay_flat(side(on)) }
    /// Room for the places of `columns` and `rows` of points, f32: first those. 0 where
    /// there are more than 1024 of either.
    fn tl_leaf_samples(loose, columns: usize, rows: usize) -> *mut f32 {
        if columns > MOST_SAMPLES || rows > MOST_SAMPLES {
            loose.samples.clear();
            return core::ptr::null_mut();
        }
        loose.samples.resize(columns + rows, 0.0);
        loose.samples.as_mut_ptr()
    }
    /// Draws at the places in that room, of which `columns` are those of columns;
    /// 0 where they are fewer than 2, do not rise or are not within 0 to 1, or where those of a
    /// creased leaf do not reach from 0 to 1 or are too few for its creases.
    fn tl_leaf_draw(loose, columns: usize) -> u32 {
        let (u, v) = loose.samples.split_at(columns.min(loose.samples.len()));
        if let Err(error) = loose.leaf.draw_samples(u, v) {
            note(&error);
            return 0;
        }
        loose.mesh = loose.leaf.paper_mesh();
        1
    }
    /// Room for creases of a sheet: for each u, v, u, v of two places on it, 0 to 1, and its rest
    /// angle, radians, f64; 16 at most.
    fn tl_leaf_creases(loose) -> *mut f64 { loose.creases.as_mut_ptr().cast() }
    /// Creases the leaf along so many of those, pressed by hand, in place of those it has; 0
    /// where it cannot be, and `tl_leaf_error` says why.
    fn tl_leaf_crease(loose, count: usize) -> u32 { crease(loose, count).into() }
    /// Turns the rest of a crease to an angle, radians, -pi to pi or the nearer of these. Nothing
    /// happens where it is no number or there is no such crease.
    fn tl_leaf_press(loose, crease: usize, rest: f32) { loose.leaf.press(crease, rest) }
    /// Three figures of a crease now, f64: its angle and its rest in radians, and its moment a
    /// length in N. 0 where there is no such crease.
    fn tl_leaf_crease_state(loose, crease: usize) -> *const f64 {
        let Some(state) = loose.leaf.crease_state(crease) else {
            return core::ptr::null();
        };
        loose.crease = [state.angle, state.rest, state.moment].map(f64::from);
        loose.crease.as_ptr()
    }
    /// Starts a turn (0 edge, 2 corner let go half-way, any other corner) from a side, of
    /// 0.01 to 3600 seconds or the nearer of these; of 0.01 where they are no number.
    fn tl_leaf_play(loose, by: u32, from: u32, seconds: f32) {
        let seconds = if seconds > 0.01 { seconds.min(3600.0) } else { 0.01 };
        loose.leaf.play(turn(by), side(from), seconds)
    }
    /// Whether such a turn is under way.
    fn tl_leaf_playing(loose) -> u32 { loose.leaf.is_playing().into() }
    /// A hand takes hold at (u, v), each 0 to 1 or the nearer of these. Nothing happens
    /// where one is not finite.
    fn tl_leaf_grab(loose, u: f32, v: f32) { loose.leaf.grab(u, v) }
    /// The hand pulls to a place, metres. Nothing happens where it is not finite.
    fn tl_leaf_hold(loose, x: f32, y: f32, z: f32) { loose.leaf.pull([x, y, z]) }
    /// The hand lets go.
    fn tl_leaf_release(loose) { loose.leaf.release() }
    /// Moves on by seconds: 0 to 60 or the nearer of these, none where they are not
    /// finite; at most 36,000 steps.
    fn tl_leaf_advance(loose, seconds: f64) { loose.leaf.advance(seconds) }
    /// Length of a step, seconds.
    fn tl_leaf_step(loose) -> f32 { loose.leaf.time_step() }
    /// Seconds since it was made.
    fn tl_leaf_time(loose) -> f32 { loose.leaf.time() }
    /// Brings surface, normals and nodes up to date.
    fn tl_leaf_update(loose) { update(loose) }
    /// What is drawn of it; its paper is drawn as if it had no thickness.
    fn tl_leaf_surface(loose) -> *const Drawn { drawn(&loose.surface, loose.mesh.as_ref(), 0.0) }
    /// Columns of nodes.
    fn tl_leaf_node_columns(loose) -> usize { loose.leaf.grid_size().0 }
    /// Rows of nodes.
    fn tl_leaf_node_rows(loose) -> usize { loose.leaf.grid_size().1 }
    /// Nodes, f32 x, y, z in metres, row by row from the foot.
    fn tl_leaf_nodes(loose) -> *const f32 { loose.positions.as_ptr() }
    /// Their velocities, f32 x, y, z in m/s.
    fn tl_leaf_velocities(loose) -> *const f32 { loose.velocities.as_ptr() }
    /// Five figures now, f64: kinetic, bending and gravity energy in J, largest
    /// stretch and compression.
    fn tl_leaf_measure(loose) -> *const f64 {
        let (energies, strain) = (loose.leaf.energies(), loose.leaf.strain());
        loose.figures = [
            energies.kinetic,
            energies.bending,
            energies.gravity,
            f64::from(strain.max),
            f64::from(strain.min),
        ];
        loose.figures.as_ptr()
    }
    /// Records the surface from now on, a frame every `interval` seconds (0.0001 at least),
    /// up to 64 MB of them.
    fn tl_leaf_record(loose, interval: f64) { loose.leaf.record(interval.max(1e-4)) }
    /// Ends the record and returns its length in bytes as a file of key frames; 0
    /// where none was begun.
    fn tl_leaf_finish_record(loose) -> usize {
        loose.record = loose.leaf.finish_record().map_or(Vec::new(), |frames| frames.to_bytes());
        loose.record.len()
    }
    /// The bytes of that file.
    fn tl_leaf_record_bytes(loose) -> *const u8 { loose.record.as_ptr() }
}
