//! A piece of paper to experiment on, whichever model computes it.

mod mass_spring;
mod piece;
mod settings;
mod sheet;
mod shell;

use clap::{Args, ValueEnum};
use serde::Serialize;

pub use piece::{BREADTH, Held, LENGTH, Piece, Specimen};
pub use settings::Settings;
pub use sheet::stock;

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

/// The options that name one.
#[derive(Args)]
pub struct ModelOptions {
    /// The model.
    #[arg(long, value_enum, default_value = "sheet")]
    model: Name,
    /// Of the sheet: a book's leaf, or one on its own [default: book]
    #[arg(long, value_enum)]
    settings: Option<Settings>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Name {
    Sheet,
    Shell,
    MassSpring,
}

impl ModelOptions {
    /// The model that they name.
    ///
    /// # Errors
    /// Where settings are given for another model than the sheet, in a sentence.
    pub fn model(&self) -> Result<Model, String> {
        match (self.model, self.settings) {
            (Name::Sheet, settings) => Ok(Model::Sheet(settings.unwrap_or_default())),
            (_, Some(_)) => Err("--settings is for the sheet alone.".into()),
            (Name::Shell, None) => Ok(Model::Shell),
            (Name::MassSpring, None) => Ok(Model::MassSpring),
        }
    }
}

/// A model as reports name it.
#[derive(Serialize)]
pub struct Label {
    model: &'static str,
    /// The settings of a sheet; none of any other model.
    settings: Option<Settings>,
}

impl Model {
    /// As reports name it.
    pub fn label(self) -> Label {
        let (model, settings) = match self {
            Self::Sheet(settings) => ("sheet", Some(settings)),
            Self::Shell => ("shell", None),
            Self::MassSpring => ("mass-spring", None),
        };
        Label { model, settings }
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
    ///
    /// # Errors
    /// Where the model makes no such piece, in a sentence.
    pub fn make(self, piece: &Piece) -> Result<Box<dyn Specimen>, String> {
        match self {
            Self::Sheet(settings) => sheet::make(piece, settings),
            Self::Shell => shell::make(piece),
            Self::MassSpring => mass_spring::make(piece),
        }
    }
}
