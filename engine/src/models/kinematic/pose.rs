//! The shape of a leaf, whichever it is.

use super::lead::Lead;
use super::settings::{KinematicSettings, Shape};
use super::{Cone, Cylinder, Peel, Rigid};

/// The shape of a leaf at a moment: where each place of the flat leaf is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pose {
    /// A board.
    Rigid(Rigid),
    /// A fold.
    Peel(Peel),
    /// A roll.
    Cylinder(Cylinder),
    /// A cone.
    Cone(Cone),
}

impl Pose {
    /// Where the place of the flat leaf is that lies x metres from the spine and
    /// y from the foot, for a turn from right to left.
    pub fn place(&self, at: [f64; 2]) -> [f64; 3] {
        match self {
            Self::Rigid(pose) => pose.place(at),
            Self::Peel(pose) => pose.place(at),
            Self::Cylinder(pose) => pose.place(at),
            Self::Cone(pose) => pose.place(at),
        }
    }
}

/// The pose that leads where it is to lead.
pub(super) fn pose(settings: &KinematicSettings, lead: &Lead) -> Pose {
    let (size, place) = ([settings.width, settings.height], lead.place);
    let at = lead.at();
    match settings.shape {
        Shape::Rigid => Pose::Rigid(Rigid::at(lead.angle)),
        Shape::Peel => Pose::Peel(Peel::toward(size, place, [at[0], at[1]])),
        Shape::Cylinder => Pose::Cylinder(Cylinder::toward(size, place, at)),
        Shape::Cone => Pose::Cone(Cone::toward(size, place, at, lead.conical)),
    }
}
