//! The figures of some runs of folded leaves.

use serde::Serialize;

use super::figures::Figures;
use super::watch::Watched;

/// Leaves that go through themselves by more than this are counted, metres: in flight, and at rest.
const IN_FLIGHT: f32 = 5e-4;
const AT_REST: f32 = 1e-4;

/// What was seen of a run.
pub struct Seen {
    /// On the way.
    pub watched: Watched,
    /// How deep a leaf is drawn in itself before and after, metres.
    pub at_rest: f32,
}

impl Seen {
    /// How deep a leaf is drawn in itself at any time, metres.
    pub fn deepest(&self) -> f32 {
        self.at_rest.max(self.watched.itself)
    }
}

/// What runs did to what is drawn.
#[derive(Serialize)]
pub struct FoldedFigures {
    /// Runs in which a leaf goes through itself in flight by more than half a millimetre, and the
    /// deepest, millimetres.
    through_in_flight: usize,
    in_flight_mm: f32,
    /// Those in which one does so at rest by more than a tenth, and the deepest, millimetres.
    through_at_rest: usize,
    at_rest_mm: f32,
    #[serde(flatten)]
    drawn: Figures,
}

impl FoldedFigures {
    /// Names of the table's columns.
    pub const HEADINGS: [&str; 11] = [
        "of",
        "runs",
        "through itself in flight, runs",
        "deepest, mm",
        "at rest, runs",
        "deepest at rest, mm",
        "frames",
        "behind by 5 mm, %",
        "at most, mm",
        "still, ms",
        "CPU of a frame, worst, ms",
    ];

    /// Those of some runs.
    pub fn of<'a>(runs: impl Iterator<Item = &'a Seen> + Clone) -> FoldedFigures {
        let deepest = |of: fn(&Seen) -> f32| runs.clone().map(of).fold(0.0, f32::max);
        let beyond =
            |of: fn(&Seen) -> f32, most: f32| runs.clone().filter(|seen| of(seen) > most).count();
        let (in_flight, at_rest) = (
            |seen: &Seen| seen.watched.itself,
            |seen: &Seen| seen.at_rest,
        );
        FoldedFigures {
            through_in_flight: beyond(in_flight, IN_FLIGHT),
            in_flight_mm: 1e3 * deepest(in_flight),
            through_at_rest: beyond(at_rest, AT_REST),
            at_rest_mm: 1e3 * deepest(at_rest),
            drawn: Figures::of(runs.map(|seen| &seen.watched)),
        }
    }

    /// How many runs these are.
    pub fn runs(&self) -> usize {
        self.drawn.runs
    }

    /// A row of the table.
    pub fn row(&self, name: &str) -> Vec<String> {
        let [_, runs, frames, behind, farthest, still, _, _, seconds, _] =
            <[String; 10]>::try_from(self.drawn.row(name)).expect("a cell a heading");
        vec![
            name.into(),
            runs,
            self.through_in_flight.to_string(),
            format!("{:.2}", self.in_flight_mm),
            self.through_at_rest.to_string(),
            format!("{:.2}", self.at_rest_mm),
            frames,
            behind,
            farthest,
            still,
            seconds,
        ]
    }
}
