//! The ways of turning a page that are compared.

use std::f32::consts::FRAC_PI_4;

use clap::builder::PossibleValuesParser;
use turnleaf_engine::{
    Blend, Condensed, Discretisation, FrameKind, KeyFrames, LooseLeaf, LooseSettings, ModelKind,
    PAPER_INTERVAL, Preset, Replay, Shape, Side, Stock, Synchronise, TurnBy, TurnModel,
    uniform_samples,
};

use super::timing::{AFTER, FRAME, TURN};
use crate::specimen::{BREADTH, LENGTH};

/// Columns and rows of nodes of the reference. Its two discretisations tell how fine that is.
pub const NODES: [usize; 2] = [17, 23];
/// Length of its step, seconds.
pub const STEP: f64 = 1.0 / 240.0;

/// How far a sheet's key frames may lead from its turn, over the width.
pub const SHEET_TOLERANCE: f64 = 0.005;

/// How a way comes by its surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// By its model, step by step.
    Live,
    /// From a record of its model: what a frame holds, seconds between frames,
    /// and how they are blended.
    Record(FrameKind, f64, Blend),
    /// From key frames of its surface, chosen so that their blend is nowhere
    /// farther from the turn than a tolerance, over the width.
    Condensed(f64),
    /// From pictures of its model's turn.
    Photographs,
}

/// A way of turning a page.
#[derive(Clone, Debug)]
pub struct Way {
    /// Its name in reports.
    pub name: &'static str,
    /// How it comes by its surface.
    pub source: Source,
    /// The leaf that it turns.
    pub settings: LooseSettings,
}

/// All ways, in the order of the table. `nodes` are the reference's.
pub fn all(stock: Stock, nodes: [usize; 2]) -> Vec<Way> {
    let leaf = |kind| LooseSettings::leaf(kind, [LENGTH, BREADTH], stock);
    let live = |name, settings| Way {
        name,
        source: Source::Live,
        settings,
    };
    let springs = |name, synchronised: bool, interpolate| {
        let settings = LooseSettings {
            synchronise: if synchronised {
                Synchronise::Columns
            } else {
                Synchronise::Off
            },
            interpolate,
            ..leaf(ModelKind::MassSpring)
        };
        live(name, settings)
    };
    let interval = f64::from(PAPER_INTERVAL);
    let of_masses = Source::Record(FrameKind::Masses, interval, Blend::Linear);
    let shell = |name, discretisation| {
        let settings = LooseSettings {
            nodes: Some(nodes),
            time_step: Some(STEP),
            discretisation,
            ..leaf(ModelKind::Shell)
        };
        live(name, settings)
    };
    let book = LooseSettings {
        preset: Preset::Book,
        interpolate: true,
        ..leaf(ModelKind::MassSpring)
    };
    // As many as that whose cost is measured beside other engines'.
    let three_steps = LooseSettings {
        time_step: Some(1.0 / 180.0),
        ..leaf(ModelKind::Sheet)
    };
    let kinematic = Shape::ALL.iter().map(|&shape| {
        let settings = leaf(ModelKind::Kinematic(shape));
        live(shape.name(), settings)
    });
    let others = [
        springs("mass-spring, classic", false, false),
        springs("mass-spring, synchronised", true, false),
        springs("mass-spring, interpolated", false, true),
        Way {
            source: of_masses,
            ..springs("mass-spring, key frames", false, false)
        },
        Way {
            source: of_masses,
            ..springs("mass-spring, all three", true, true)
        },
        live("mass-spring, of paper", book),
        live("sheet", leaf(ModelKind::Sheet)),
        live("sheet, three steps a frame", three_steps),
        Way {
            name: "replay of sheet",
            source: Source::Condensed(SHEET_TOLERANCE),
            settings: leaf(ModelKind::Sheet),
        },
        shell("shell", Discretisation::Grid),
        shell("shell, triangles", Discretisation::Triangles),
        Way {
            name: "photographs",
            source: Source::Photographs,
            ..shell("", Discretisation::Grid)
        },
    ];
    kinematic.chain(others).collect()
}

/// A parser of the name of a way.
pub fn name() -> PossibleValuesParser {
    let ways = all(Stock::BOOK, NODES);
    PossibleValuesParser::new(ways.into_iter().map(|way| way.name))
}

/// The ways of some names and those that they are compared with; all ways where no name
/// is given.
pub fn with_references(ways: Vec<Way>, names: &[String]) -> Vec<Way> {
    let is_named = |way: &Way| names.is_empty() || names.iter().any(|name| name == way.name);
    let is_needed = |way: &&Way| {
        let is_repeated = |other: &Way| is_named(other) && other.repeats(way);
        way.is_reference() || is_named(way) || ways.iter().any(is_repeated)
    };
    ways.iter().filter(is_needed).cloned().collect()
}

impl Way {
    /// Whether it repeats a turn of another way, which is computed live.
    pub fn repeats(&self, live: &Way) -> bool {
        matches!(self.source, Source::Record(..) | Source::Condensed(_))
            && live.source == Source::Live
            && live.settings == self.settings
    }

    /// Whether it is the one that the others are measured from.
    pub fn is_reference(&self) -> bool {
        self.source == Source::Live
            && self.settings.kind == ModelKind::Shell
            && self.settings.discretisation == Discretisation::Grid
    }

    /// A leaf whose turn is about to begin.
    ///
    /// # Panics
    /// Where it is photographs, which have no leaf.
    ///
    /// # Errors
    /// Where its settings make no leaf, or its turn cannot be recorded so, in a sentence.
    pub fn begin(&self, by: TurnBy) -> Result<Box<dyn TurnModel>, String> {
        let model: Box<dyn TurnModel> = match self.source {
            Source::Photographs => unreachable!("photographs have no leaf"),
            Source::Live => {
                let mut leaf = self.leaf(by, self.settings.interpolate)?;
                leaf.play(by, Side::Right, TURN as f32);
                Box::new(leaf)
            }
            Source::Condensed(tolerance) => {
                // As close as the model's own steps.
                let step = f64::from(self.leaf(by, true)?.time_step());
                let frames = self.record(by, FrameKind::Surface, step)?;
                let (u, v) = (
                    uniform_samples(frames.columns),
                    uniform_samples(frames.rows),
                );
                let condensed = Condensed::of(&frames, &u, &v, tolerance as f32)
                    .map_err(|error| error.to_string())?;
                let mut frames = condensed.frames;
                frames.positions.shrink_to_fit();
                Box::new(Replay::new(frames, Blend::Hermite, FRAME as f32))
            }
            Source::Record(kind, interval, blend) => {
                let frames = self.record(by, kind, interval)?;
                let mut replay = Replay::new(frames, blend, FRAME as f32);
                if kind == FrameKind::Masses && !self.settings.interpolate {
                    replay.draw_nodes();
                }
                Box::new(replay)
            }
        };
        Ok(model)
    }

    /// The leaf itself. A turn by a corner is synchronised along the dog-ear line
    /// that cuts it off.
    ///
    /// # Errors
    /// Where its settings make none, in a sentence.
    pub fn leaf(&self, by: TurnBy, interpolate: bool) -> Result<LooseLeaf, String> {
        let mut settings = LooseSettings {
            interpolate,
            ..self.settings.clone()
        };
        if settings.synchronise != Synchronise::Off && by != TurnBy::Edge {
            settings.synchronise = Synchronise::DogEar { angle: FRAC_PI_4 };
        }
        LooseLeaf::new(settings).map_err(|error| error.to_string())
    }

    fn record(&self, by: TurnBy, kind: FrameKind, interval: f64) -> Result<KeyFrames, String> {
        let mut leaf = self.leaf(by, kind == FrameKind::Surface)?;
        leaf.play(by, Side::Right, TURN as f32);
        leaf.record(interval);
        leaf.advance(TURN + AFTER);
        let frames = leaf.finish_record().ok_or("Nothing was recorded.")?;
        Ok(KeyFrames { kind, ..frames })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_alone_comes_with_those_that_it_is_compared_with() {
        let names = |only: &[&str]| -> Vec<&str> {
            let only: Vec<String> = only.iter().map(|name| (*name).into()).collect();
            let ways = with_references(all(Stock::BOOK, NODES), &only);
            ways.iter().map(|way| way.name).collect()
        };
        assert_eq!(names(&["cone"]), ["cone", "shell"]);
        assert_eq!(names(&["shell"]), ["shell"]);
        assert_eq!(
            names(&["replay of sheet", "rigid"]),
            ["rigid", "sheet", "replay of sheet", "shell"]
        );
        let classic = "mass-spring, classic";
        assert_eq!(
            names(&["mass-spring, key frames"]),
            [classic, "mass-spring, key frames", "shell"]
        );
        assert_eq!(names(&["photographs"]), ["shell", "photographs"]);
        assert_eq!(names(&[]).len(), all(Stock::BOOK, NODES).len());
    }
}
