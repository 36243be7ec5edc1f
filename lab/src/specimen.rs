//! A piece of paper to experiment on, whichever model computes it.

mod mass_spring;
mod piece;
mod settings;
mod sheet;
mod shell;

use lexopt::Parser;

use crate::options;
pub use piece::{BREADTH, Held, LENGTH, Piece, Specimen};
pub use settings::Settings;

/// Which model computes a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// The interactive sheet.
    Sheet(Settings),
    /// The offline reference.
    Shell,
    /// The paper's masses and springs, by the preset `book`.
    MassSpring,
}

impl Model {
    /// Its name as in commands and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sheet(_) => "sheet",
            Self::Shell => "shell",
            Self::MassSpring => "mass-spring",
        }
    }

    /// The model that the option `--model` names.
    pub fn read(parser: &mut Parser) -> Result<Model, String> {
        let all = [
            Self::Sheet(Settings::default()),
            Self::Shell,
            Self::MassSpring,
        ];
        Ok(all[options::choice(parser, "model", &all.map(Self::name))?])
    }

    /// The settings of a sheet; None of any other model.
    pub fn settings(self) -> Option<&'static str> {
        match self {
            Self::Sheet(settings) => Some(settings.name()),
            _ => None,
        }
    }

    /// Numbers of columns by which it is refined.
    pub fn refinement(self) -> &'static [usize] {
        match self {
            Self::Sheet(_) => &[6, 8, 12, 16, 24],
            Self::Shell => &[17, 33, 65, 129],
            Self::MassSpring => &[4, 6, 8, 12, 16],
        }
    }

    /// Whether it is as good at any step; else it is measured at its own.
    pub fn takes_any_step(self) -> bool {
        self == Self::Shell
    }

    /// A piece as ordered, lying straight.
    pub fn make(self, piece: &Piece) -> Result<Box<dyn Specimen>, String> {
        match self {
            Self::Sheet(settings) => sheet::make(piece, settings),
            Self::Shell => shell::make(piece),
            Self::MassSpring => mass_spring::make(piece),
        }
    }
}
