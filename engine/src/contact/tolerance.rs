//! The one length by which it is decided whether leaves lie upon each other, and its multiples.
//!
//! Metres. What is simulated takes them as they are; what is drawn, for a page 0.14 m wide and
//! in proportion for others.

/// Distance at which two drawn leaves lie upon each other: seen as none, and enough for the
/// depth buffer.
pub const SLIVER: f32 = slivers(1.0);

/// So many times the distance, rounded once.
const fn slivers(count: f64) -> f32 {
    (count * 5e-5) as f32
}

// What is drawn.

/// Nearer to a facet of its leaf than this the end of an edge goes through it: nearer, rounding
/// decides whether it does.
pub const AT_FACET: f32 = slivers(0.0006);

/// Depth that comes of rounding: in a pile, and of crumpled leaves in each other.
pub const ROUNDING: f32 = slivers(0.02);

/// Leaves that no grab has crumpled touch where they go through each other by less, where few
/// fly: there is room to separate them thoroughly. Leaves at a small angle to each other are
/// deeper in than their edges are past facets.
pub const GRAZING: f32 = slivers(0.4);

/// The same in a riffle, where they lie so closely that else one would always be held back.
pub const TOUCHING: f32 = slivers(1.0);

/// Part of the distance that may be missing: the surfaces still do not meet.
pub const SLACK: f32 = slivers(0.6);

/// Where a leaf bends by less than this, what holds for its points holds for the edges between
/// them.
pub const BENT: f32 = slivers(0.8);

/// How far a leaf may be on the wrong side of the next at the spine.
pub const PAST_AT_SPINE: f32 = slivers(1.0);

/// Farther than this from the plane through the nearest point of the other leaf nothing
/// overlaps its facets where neither bends.
pub const WELL_CLEAR: f32 = slivers(2.0);

/// How far over a pile what flies is drawn, and over what flies under it: a leaf that is picked
/// up from under others lies on the pile, where those that lie crumpled upon it were drawn.
pub const OVER_PILE: f32 = slivers(2.0);

/// How far from the spine there is room for the distance between any two leaves. Nearer there
/// is the less: all that fly meet in one line.
pub const ROOM_FROM_SPINE: f32 = slivers(60.0);

/// What overlaps by more than this was not lying upon the other there.
pub const NOT_UPON: f32 = slivers(120.0);

// What is simulated.

/// Depth in a tick from which a leaf may be drawn through another.
pub const NEEDS_TEST: f32 = slivers(3.0);

/// Distance that leaves keep: a node stands for a cell around it.
pub const GAP: f32 = slivers(4.0);

/// Depth in a tick from which a leaf may have come through another: the distance kept.
pub const TUNNELLED: f32 = GAP;

/// What is farther than this from the rim of a leaf lies beyond it, and not over or under it.
pub const BEYOND_RIM: f32 = GAP;

/// Depth from which a node beyond a neighbour's rim has passed it there.
pub const PAST_RIM: f32 = slivers(20.0);

/// Depth after a tick from which a leaf is brought out of what it met; and by which facets
/// between nodes may go through each other, as arcs on either side of them do not.
pub const DEEP: f32 = slivers(30.0);

/// Depth to which a tick may lead. A node that was not next to a neighbour before and is deeper
/// in it has come round its rim.
pub const DEEPEST: f32 = slivers(50.0);

/// Nodes of a cell nearer than this to another leaf keep the whole cell clear of it.
pub const CLOSE: f32 = slivers(60.0);

/// Between nodes that are nearer than this to a neighbour contact is looked for.
pub const BETWEEN_NODES: f32 = slivers(160.0);

/// Distance at which parts of one leaf are looked at for contact.
pub const CURLED: f32 = slivers(240.0);

/// Deepest that contact pushes from at once: what is deeper comes out over several ticks.
pub const PUSHED_AT_ONCE: f32 = slivers(400.0);

/// By how much a node may come nearer to a neighbour between two looks.
pub const LEAP: f32 = slivers(500.0);

/// Places of a leaf closer than this along it do not meet each other.
pub const APART: f32 = slivers(900.0);

/// Farther than this from each other nothing meets within a tick.
pub const FAR: f32 = slivers(1400.0);
