//! What random gestures did to folded and torn leaves, in figures.

use serde::Serialize;

use super::creasing::CreaseOutcome;
use super::overlap::TOO_DEEP;
use super::scene::Outcome;

/// Figures of folds and tears. Lengths are those on a page 140 mm wide.
#[derive(Clone, Debug, Serialize)]
pub struct CreaseFigures {
    /// Folds that were made.
    pub folds_made: u32,
    /// Folds that leaves have too few nodes for.
    pub folds_rejected: u32,
    /// How far creases that no pointer held came off their rests, at most.
    pub rests_off_degrees: f32,
    /// The same of those that one held.
    pub rests_off_held_degrees: f32,
    /// The deepest that a leaf at rest is drawn in itself.
    pub at_rest_in_itself_mm: f32,
    /// The deepest that one is drawn in another.
    pub at_rest_in_leaves_mm: f32,
    /// The deepest that one is drawn in a pile or a board.
    pub at_rest_in_piles_mm: f32,
    /// Part of the gestures after which a leaf is drawn too deep in itself.
    pub at_rest_in_itself_fraction: f64,
    /// More than ten times as deep as [`TOO_DEEP`]: it is seen.
    pub at_rest_far_in_itself_fraction: f64,
    /// Part of the gestures in which one is drawn too deep in another or a pile.
    pub in_others_fraction: f64,
    /// Part of the gestures in which one is drawn too deep in itself.
    pub in_itself_fraction: f64,
    /// Leaves that came off by the pull.
    pub torn_off: u32,
    /// Leaves that were cut.
    pub torn_cut: u32,
    /// Largest edge strain of a torn leaf.
    pub torn_strain_worst: f32,
    /// The deepest that one is drawn in pages, boards or the table.
    pub torn_in_piles_mm: f32,
    /// The deepest that one is drawn in itself.
    pub torn_in_itself_mm: f32,
    /// Part of the pictures of loose sheets in which one goes through a leaf.
    pub torn_through_leaves_fraction: f64,
    /// How far the work of tearing was from that of the paper which held, at most, as a part of it.
    pub torn_work_off: f64,
    /// Part of the loose sheets that did not lie still by themselves.
    pub torn_left_fraction: f64,
}

impl CreaseFigures {
    /// Those of some gestures; None where leaves were whole.
    pub fn of<'a>(outcomes: impl Iterator<Item = &'a Outcome> + Clone) -> Option<CreaseFigures> {
        let all = || {
            outcomes
                .clone()
                .filter_map(|outcome| outcome.creases.as_ref())
        };
        let count = all().count();
        if count == 0 {
            return None;
        }
        let sum = |of: fn(&CreaseOutcome) -> u32| all().map(of).sum::<u32>();
        let most = |of: fn(&CreaseOutcome) -> f32| all().map(of).fold(0.0, f32::max);
        let part = |of: u32, whole: u32| f64::from(of) / f64::from(whole.max(1));
        let gestures = |is: &dyn Fn(&Outcome, &CreaseOutcome) -> bool| {
            let pairs = outcomes
                .clone()
                .filter_map(|one| Some((one, one.creases.as_ref()?)));
            pairs.filter(|(one, creases)| is(one, creases)).count() as f64 / count as f64
        };
        let deep = |metres: f32| 1e3 * metres > TOO_DEEP;
        let left = sum(|one| one.torn.left);
        Some(CreaseFigures {
            folds_made: sum(|one| one.made),
            folds_rejected: sum(|one| one.rejected),
            rests_off_degrees: most(|one| one.rests_off).to_degrees(),
            rests_off_held_degrees: most(|one| one.rests_off_held).to_degrees(),
            at_rest_in_itself_mm: 1e3 * most(|one| one.at_rest.itself),
            at_rest_in_leaves_mm: 1e3 * most(|one| one.at_rest.leaf),
            at_rest_in_piles_mm: 1e3 * most(|one| one.at_rest.pile),
            at_rest_in_itself_fraction: gestures(&|_, creases| deep(creases.at_rest.itself)),
            at_rest_far_in_itself_fraction: gestures(&|_, creases| {
                deep(0.1 * creases.at_rest.itself)
            }),
            in_others_fraction: gestures(&|one, _| deep(one.drawn.leaf.max(one.drawn.pile))),
            in_itself_fraction: gestures(&|one, _| deep(one.drawn.itself)),
            torn_off: sum(|one| one.torn.off),
            torn_cut: sum(|one| one.torn.cut),
            torn_strain_worst: most(|one| one.torn.strain),
            torn_in_piles_mm: 1e3 * most(|one| one.torn.pile),
            torn_in_itself_mm: 1e3 * most(|one| one.torn.itself),
            torn_through_leaves_fraction: part(
                sum(|one| one.torn.through),
                sum(|one| one.torn.pictures),
            ),
            torn_work_off: all().map(|one| one.torn.work_off).fold(0.0, f64::max),
            torn_left_fraction: part(left, left + sum(|one| one.torn.still)),
        })
    }
}
