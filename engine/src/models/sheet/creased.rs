//! What a creased sheet has beside any other.

use super::crease::SheetCrease;
use super::hinges::Hinges;
use super::patches::Patches;
use super::torn::Torn;

/// The creases of a sheet, and what bends and draws it once it has some.
#[derive(Clone, Debug)]
pub(super) struct Creased {
    /// The creases as they were made; the hinges have their rests of now.
    pub lines: Vec<SheetCrease>,
    /// What bends in the place of second differences.
    pub hinges: Hinges,
    /// What draws it in the place of splines; None where it is crumpled, and drawn as facets.
    pub patches: Option<Patches>,
    /// How it is torn across, if it is.
    pub torn: Option<Torn>,
}
