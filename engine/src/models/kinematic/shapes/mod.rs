//! The shapes of kinematic leaves: one file each, and the list of them. A new one
//! is a file like `rigid.rs`, a row here and a row in `models/kind.rs`.

mod cone;
mod cylinder;
mod peel;
mod rigid;
mod root;

pub use cone::Cone;
pub use cylinder::Cylinder;
pub use peel::Peel;
pub use rigid::Rigid;

use super::lead::Lead;

/// Declares the shapes: of each its type, its name, and how it is made of a leaf's
/// size and what leads it.
macro_rules! shapes {
    ($($(#[$doc:meta])* $Shape:ident $name:literal ($size:pat, $lead:pat) => $pose:expr;)*) => {
        /// The shape that a kinematic leaf takes on its way.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Shape { $($(#[$doc])* $Shape,)* }

        impl Shape {
            /// Every shape.
            pub const ALL: &[Self] = &[$(Self::$Shape),*];

            /// Its name as in commands and reports.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$Shape => $name,)* }
            }
        }

        /// The shape of a leaf at a moment: where each place of the flat leaf is.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Pose { $($(#[$doc])* $Shape($Shape),)* }

        impl Pose {
            /// The pose of a leaf of `size` metres that leads where it is to lead.
            pub(super) fn toward(shape: Shape, size: [f64; 2], lead: &Lead) -> Self {
                match shape { $(Shape::$Shape => {
                    let ($size, $lead) = (size, lead);
                    Self::$Shape($pose)
                })* }
            }

            /// Where the place of the flat leaf is that lies x metres from the spine
            /// and y from the foot, for a turn from right to left.
            pub fn place(&self, at: [f64; 2]) -> [f64; 3] {
                match self { $(Self::$Shape(pose) => pose.place(at),)* }
            }

            /// Writes where the places of the columns `x` of each row `y` are, row by
            /// row, their x times `mirror`. Which shape it is, is decided once and not
            /// at every point.
            pub(super) fn write(&self, x: &[f64], y: &[f64], mirror: f64, points: &mut [[f32; 3]]) {
                match self { $(Self::$Shape(pose) => {
                    for (row, &y) in points.chunks_exact_mut(x.len()).zip(y) {
                        for (point, &x) in row.iter_mut().zip(x) {
                            let [x, y, z] = pose.place([x, y]);
                            *point = [(mirror * x) as f32, y as f32, z as f32];
                        }
                    }
                })* }
            }
        }
    };
}

shapes! {
    /// A board that swings.
    Rigid "rigid" (_, lead) => Rigid::at(lead.angle);
    /// Folded flat along a line.
    Peel "peel" (size, lead) => {
        let [x, y, _] = lead.at();
        Peel::toward(size, lead.place, [x, y])
    };
    /// Rolled around a cylinder.
    Cylinder "cylinder" (size, lead) => Cylinder::toward(size, lead.place, lead.at());
    /// Bent around a cone.
    Cone "cone" (size, lead) => Cone::toward(size, lead.place, lead.at(), lead.conical);
}
