//! Turnleaf's engine: simulated paper, and pages that turn.
//!
//! The engine knows no screen, clock, file, network, thread or random number.
//! It speaks SI units in book space: x across the spine to the right, y along
//! the spine to the head, z up from the table. Over a leaf u runs from 0 at the
//! spine to 1 at the fore-edge and v from 0 at the foot to 1 at the head.
//!
//! The same commands give the same bits in native code and in WASM: steps are
//! of fixed length, operations of fixed order and never fused, and sines come
//! from `libm`.
//!
//! # The public list
//! - [`TurnModel`], which every way of turning a page implements, and
//!   [`Surface`], which every one yields
//! - [`MassSpring`] with its [`Settings`]: the paper's model and its improvements
//! - [`Shell`] with its [`ShellSettings`]: the offline reference; [`MeshShell`]: the same
//!   on a mesh of any flat cells
//! - [`Kinematic`] with its [`KinematicSettings`]: the [`shapes`] of
//!   earlier page turners
//! - [`Stock`], its [`Rigidity`], and the [`Air`] around it: what the paper is
//! - [`LooseLeaf`]: a leaf over a table, by any model, turned by the same grabs
//! - [`Gesture`]: how a hand turns a leaf
//! - [`Interpolation`]: from few nodes to many points
//! - [`book`]: the bound book, in which a leaf is held, falls and is played
//! - [`trials`]: scenes that benches, golden tests and the lab share
//! - [`KeyFrames`], [`Recorder`] and [`Replay`]: a turn recorded and played again;
//!   [`Condensed`]: in few bytes, to be handed out

mod air;
#[cfg(test)]
mod anchors;
mod band;
pub mod book;
mod contact;
mod creased_only;
mod gesture;
mod grab;
mod grid;
mod hash;
mod interpolate;
mod key_frames;
mod lanes;
mod loose;
mod models;
mod paper_mesh;
#[cfg(test)]
mod random;
mod real;
mod rigidity;
mod stock;
mod surface;
mod synchronise;
pub mod trials;
mod triangle;
mod turn;
mod vector;

pub use air::Air;
pub use gesture::{Gesture, Grip};
pub use grid::Side;
pub use hash::BitHash;
#[cfg(feature = "interpolations")]
pub use interpolate::lobatto_nodes;
pub use interpolate::{Interpolation, lagrange_weights, uniform_samples};
pub use key_frames::{
    Blend, Condensed, FORMAT_VERSION, FrameKind, KeyFrameError, KeyFrames, PAPER_INTERVAL,
    Recorder, Replay,
};
pub use loose::{CreaseState, InvalidLoose, LeafEnergies, LooseLeaf, LooseSettings, TurnBy};
pub use models::ModelKind;
pub use models::kinematic::{InvalidKinematic, Kinematic, KinematicSettings, Pose, Shape, shapes};
pub use models::mass_spring::{
    Integrator, InvalidSettings, MassSpring, Masses, Plate, Preset, Settings, Springs, StrainLimit,
};
pub use models::sheet::{CONTACTS, Contact, InvalidSheet, Root, Sheet, SheetCrease, SheetSettings};
pub use models::shell::{
    Crease, Discretisation, Edge, Energies, HalfSpace, InvalidShell, MeshEnergies, MeshSettings,
    MeshShell, Scheme, Shell, ShellSettings, Table,
};
pub use paper_mesh::PaperMesh;
pub use rigidity::Rigidity;
pub use stock::{GRAVITY, Grain, InvalidStock, Stock};
pub use surface::{StrainRange, Surface};
pub use synchronise::Synchronise;
pub use turn::{TurnModel, turn_hash};
