//! The settings of a sheet under experiment.

use clap::ValueEnum;
use serde::Serialize;
use turnleaf_engine::book::Paper;
use turnleaf_engine::{SheetSettings, Stock};

/// Which settings a sheet has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Settings {
    /// Those of a leaf of a viewer's book.
    #[default]
    Book,
    /// Those of a sheet on its own.
    Lab,
}

impl Settings {
    /// Its name as in commands and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Book => "book",
            Self::Lab => "lab",
        }
    }

    /// A sheet of a stock, `size` metres, with its grain along the spine.
    pub fn sheet(self, size: [f64; 2], stock: Stock) -> SheetSettings {
        match self {
            Self::Book => {
                let paper = Paper {
                    stock,
                    ..Paper::default()
                };
                paper.sheet(size)
            }
            Self::Lab => SheetSettings::leaf(size[0], size[1], stock),
        }
    }
}
