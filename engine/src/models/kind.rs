//! The list of turn models.

use super::kinematic::Shape;

/// A model of turning a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelKind {
    /// [`MassSpring`](crate::MassSpring).
    MassSpring,
    /// [`Sheet`](crate::Sheet).
    Sheet,
    /// [`Shell`](crate::Shell).
    Shell,
    /// [`Kinematic`](crate::Kinematic), of a shape.
    Kinematic(Shape),
}

impl ModelKind {
    /// Every model, each at the place before its number in files. Numbers are for
    /// ever: a new model is the last. `packages/turnleaf/src/model_names.ts` lists
    /// them in the same order; its test compares the two.
    pub const ALL: &'static [Self] = &[
        Self::MassSpring,
        Self::Sheet,
        Self::Shell,
        Self::Kinematic(Shape::Rigid),
        Self::Kinematic(Shape::Peel),
        Self::Kinematic(Shape::Cylinder),
        Self::Kinematic(Shape::Cone),
    ];

    /// Its name as in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::MassSpring => "mass-spring",
            Self::Sheet => "sheet",
            Self::Shell => "shell",
            Self::Kinematic(shape) => shape.name(),
        }
    }

    /// Its number in key-frame files, from 1. A test holds that none is missing in
    /// the list, which would give 0.
    pub fn id(self) -> u32 {
        let place = Self::ALL.iter().position(|&kind| kind == self);
        place.map_or(0, |place| place as u32 + 1)
    }

    /// The model with a number, if there is one.
    pub fn from_id(id: u32) -> Option<Self> {
        let index = usize::try_from(id).ok()?.checked_sub(1)?;
        Self::ALL.get(index).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_is_in_the_list() {
        for &shape in Shape::ALL {
            let kind = ModelKind::Kinematic(shape);
            let listed = ModelKind::ALL.contains(&kind);
            assert!(listed, "{shape:?} is no row of models/kind.rs");
        }
    }

    #[test]
    fn every_model_has_a_number_and_a_name_of_its_own() {
        for (index, &model) in ModelKind::ALL.iter().enumerate() {
            assert_eq!(model.id() as usize, index + 1);
            assert_eq!(ModelKind::from_id(model.id()), Some(model));
            let named = |other: &&ModelKind| other.name() == model.name();
            assert_eq!(ModelKind::ALL.iter().filter(named).count(), 1);
        }
        assert_eq!(ModelKind::from_id(0), None);
        assert_eq!(ModelKind::from_id(ModelKind::ALL.len() as u32 + 1), None);
    }
}
