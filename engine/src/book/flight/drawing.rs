//! What is drawn of a flight: its leaf as it is now or, where that cannot be shown, as it was drawn
//! last.

use super::Flight;
use crate::book::bend_into_gutter::bend_into_gutter;
use crate::book::limits::FARTHEST;
use crate::book::phase::Phase;
use crate::book::pile::Pile;
use crate::contact::flaps::is_turned_over;
use crate::contact::separate::find_bends;
use crate::contact::separate_parts::ROUNDS;
use crate::contact::work::Work;
use crate::creased_only::CreasedOnly;
use crate::grid::Side;
use crate::vector::{dot, sub};

impl Flight {
    /// The leaf's points over a flat table as it is now, for another model to write over:
    /// what they hold then is drawn next in place of the leaf itself.
    pub fn override_surface(&mut self) -> &mut [f32] {
        self.leaf.write_surface(&mut self.surface);
        self.overridden = true;
        &mut self.surface.positions
    }

    /// Draws the leaf as it is now, or as it is [overridden](Self::override_surface), between the piles
    /// (right and left), so far over each where it is a packet, metres for a page 0.14 m wide;
    /// `needs_crossing_test` says that it may be drawn through a neighbour. `last` are the piles that were
    /// drawn last.
    pub fn draw(
        &mut self,
        piles: [&Pile; 2],
        over: [f32; 2],
        last: [&Pile; 2],
        needs_crossing_test: bool,
    ) {
        let [right, left] = piles;
        self.clear_of = [None; 2];
        self.rounds = 0;
        self.parts.forget();
        let is_crumpled = self.is_crumpled();
        self.needs_crossing_test |= core::mem::take(&mut self.held_back);
        // What else was written would be drawn as nothing, or as nothing but itself.
        let is_place = |x: &f32| x.abs() <= FARTHEST;
        let is_overridden =
            core::mem::take(&mut self.overridden) && self.surface.positions.iter().all(is_place);
        self.needs_crossing_test |=
            is_crumpled || is_overridden || needs_crossing_test || self.had_crossing;
        self.is_bent_back = is_overridden
            || ((is_crumpled || self.was_driven) && self.leaf.in_book_space().is_bent_back());
        // A large page folds by its own weight, or by the wind. What is folded over may come through
        // the rest wherever its folds are not held shut; but held back under a hand it would stand still.
        let is_curled = self.leaf.in_book_space().is_curled();
        self.may_be_folded = if self.is_creased() {
            let is_held = self.phase() == Phase::Held;
            !is_held && self.packet().is_none() && !self.leaf.is_down()
        } else {
            is_crumpled || self.is_bent_back || is_curled
        };
        if !is_overridden {
            self.leaf.write_surface(&mut self.surface);
        }
        let straightness = self.leaf.straightness();
        let creased = self.creased.as_ref();
        let beyond = creased.map(|creased| &creased.beyond[..]);
        let how = (straightness, beyond.into());
        bend_into_gutter(&mut self.surface.positions, right, left, how);
        let scale = self.scale();
        if let Some((layers, part)) = self.leaf.drawn_shut() {
            let points = self.surface.positions.as_chunks_mut::<3>().0;
            // Once it rests so does its paper.
            if !self.leaf.is_down() {
                layers.raise(points, part, self.leaf.fraction_turned(), scale);
            }
            layers.lay(points, part, scale);
        }
        self.surface.update_normals();
        self.find_turned_over();
        self.lift_packet(piles, over);
        if self.shown.is_empty() || self.packet().is_some() {
            // What is drawn of others next to it may have it drawn so for as long as they move; and the
            // layers of a packet lie off each other before they move as one.
            self.separate_own_parts(ROUNDS, &mut Work::new(u32::MAX));
        }
        self.wanted.clone_from(&self.surface.positions);
        if self.shown.is_empty() {
            self.show_at_rest(last);
        }
        if core::mem::take(&mut self.full_precision) {
            self.bends.fill(0.0);
        }
        if is_crumpled {
            self.use_full_precision();
        }
    }

    /// How high the layers of folds that are held shut are drawn over and under what they lie upon,
    /// metres for a page 0.14 m wide.
    pub fn height_of_layers(&self) -> f32 {
        let shut = self.leaf.drawn_shut();
        shut.map_or(0.0, |(layers, part)| part * layers.height())
    }

    /// Finds which of its points are folded over. Those on creases are not.
    fn find_turned_over(&mut self) {
        self.turned_over.clear();
        let shut = self.leaf.shut_creases();
        self.shut = shut;
        let Some(mesh) = self.creased.as_ref().filter(|_| shut != 0) else {
            return;
        };
        self.turned_over.resize(mesh.paper.places.len(), true);
        for (corners, part) in mesh.paper.parted_triangles() {
            if !is_turned_over(part, shut) {
                for corner in corners {
                    self.turned_over[corner] = false;
                }
            }
        }
    }

    /// Says that it was drawn last as the page upon one of the piles, which it was; a creased one
    /// too, as in a pile no folds are drawn.
    fn show_at_rest(&mut self, [right, left]: [&Pile; 2]) {
        let (pile, side) = if self.leaf.fraction_turned() < 0.5 {
            (right, Side::Right)
        } else {
            (left, Side::Left)
        };
        let columns = pile.columns();
        self.shown.clone_from(&self.surface.positions);
        let points = self.shown.as_chunks_mut::<3>().0;
        if let Some(creased) = self.creased.as_ref() {
            // Its columns are moved onto its creases.
            let settings = self.leaf.sheet().settings();
            let size = [settings.width, settings.height].map(|length| length as f32);
            for (point, [u, v]) in points.iter_mut().zip(&creased.paper.places) {
                *point = [side.sign() * u * size[0], v * size[1], 0.0];
            }
            bend_into_gutter(&mut self.shown, right, left, (0.0, CreasedOnly::NONE));
            return;
        }
        for row in points.chunks_exact_mut(columns) {
            let y = row[0][1];
            let curve = pile.curves().as_chunks::<2>().0;
            for (point, [x, z]) in row.iter_mut().zip(curve) {
                *point = [*x, y, *z];
            }
        }
    }

    /// Draws it once more as it was before others moved it, to be kept clear of them
    /// thoroughly if it `met` one or a grab has crumpled it.
    pub fn draw_again(&mut self, met: bool) {
        self.surface.positions.clone_from(&self.wanted);
        self.surface.update_normals();
        self.rounds = 0;
        self.revision += 1;
        self.had_crossing |= met;
        self.needs_crossing_test |= met;
        if met || self.is_crumpled() {
            self.use_full_precision();
        }
    }

    /// Has it kept clear of its neighbours thoroughly in this picture.
    fn use_full_precision(&mut self) {
        if !core::mem::replace(&mut self.full_precision, true) {
            find_bends(&self.surface, &mut self.bends);
        }
    }

    /// Keeps what is drawn now as what is wanted.
    pub fn want(&mut self) {
        self.wanted.clone_from(&self.surface.positions);
    }

    /// Draws what was drawn last, turned about the spine as far as its paper has turned since: to
    /// where it is nearest to what is wanted.
    pub fn draw_carried(&mut self) {
        let pairs = self.shown.as_chunks::<3>().0.iter();
        let pairs = pairs.zip(self.wanted.as_chunks::<3>().0);
        let [cos, sin] = pairs.fold([0.0f32; 2], |[cos, sin], ([x, _, z], [to_x, _, to_z])| {
            [cos + x * to_x + z * to_z, sin + x * to_z - z * to_x]
        });
        let length = (cos * cos + sin * sin).sqrt();
        self.draw_turned(if length > 0.0 {
            [cos / length, sin / length]
        } else {
            [1.0, 0.0]
        });
    }

    /// Draws what was drawn last.
    pub fn draw_last(&mut self) {
        self.draw_turned([1.0, 0.0]);
    }

    /// Draws what was drawn last turned about the spine, by the cosine and the sine of an angle.
    fn draw_turned(&mut self, [cos, sin]: [f32; 2]) {
        self.revision += 1;
        (self.held_back, self.needs_crossing_test) = (true, true);
        self.surface.positions.clone_from(&self.shown);
        for [x, _, z] in self.surface.positions.as_chunks_mut::<3>().0 {
            [*x, *z] = [cos * *x - sin * *z, cos * *z + sin * *x];
        }
        self.surface.update_normals();
    }

    /// Where its points would be drawn if it were not held back.
    pub fn target(&self) -> &[f32] {
        &self.wanted
    }

    /// How far what is drawn is from where it would be if it were not held back, metres.
    pub fn lag(&self) -> f32 {
        if !self.held_back {
            return 0.0;
        }
        let points = [&self.surface.positions, &self.wanted].map(|p| p.as_chunks::<3>().0);
        let apart = points[0].iter().zip(points[1]).map(|(p, q)| {
            let away = sub(*p, *q);
            dot(away, away)
        });
        apart.fold(0.0, f32::max).sqrt()
    }

    /// Keeps what is drawn now, as the way to the next begins there.
    pub fn show(&mut self) {
        self.was_drawn = true;
        self.was_drawn_folded = self.may_be_folded || self.held_back;
        self.shown.clone_from(&self.surface.positions);
        self.surface.touch();
    }
}
