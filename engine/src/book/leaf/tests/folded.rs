//! Folded leaves as they are put down.

use super::*;

#[test]
fn a_leaf_folded_upon_its_folds_that_stays_upright_is_put_down_on_its_side() {
    use crate::models::sheet::SheetCrease;
    for side in [Side::Right, Side::Left] {
        let drawn = crate::interpolate::uniform_samples(27);
        let size = [f64::from(WIDTH), 0.21];
        let mut leaf = Leaf::new(size, &crate::book::Paper::default(), 0.0, (&drawn, 27));
        let along = |u: f64, degrees: f64| {
            let through = [[u, 0.0], [u, 1.0]];
            SheetCrease::pressed(through, degrees.to_radians(), &Stock::BOOK, size[0])
        };
        assert!(leaf.crease(&[along(0.7, 175.0), along(0.4, 160.0)]));
        leaf.sheet.lay_folded(side);
        leaf.lie(side);
        let laid = leaf.measure_fraction();
        let sign = side.sign();
        let nodes = leaf.sheet.positions().as_chunks::<3>().0;
        let upright: Vec<f32> = nodes
            .iter()
            .flat_map(|[x, y, z]| [-sign * z, *y, sign * x])
            .collect();
        leaf.sheet.put_back(&upright);
        leaf.clamp = core::f32::consts::FRAC_PI_2;
        leaf.turned = leaf.measure_fraction();
        leaf.wake();
        leaf.fallen = 1000;
        let mut strain = 0.0f32;
        for _ in 0..60 {
            leaf.step(true, false, false);
            strain = strain.max(leaf.sheet.max_edge_strain());
        }
        assert_eq!(leaf.phase(), Phase::Resting(side));
        // As it lay folded, which is not flat.
        let off = (leaf.fraction_turned() - laid).abs();
        assert!(off < 0.01, "{off} of the half turn off");
        assert!(strain < 0.01, "{strain}");
    }
}

/// How far a creased leaf that lies uppermost is drawn through itself at most, metres.
fn drawn_through_itself(
    book: &Book,
    index: usize,
    creases: &[crate::models::sheet::SheetCrease],
) -> f32 {
    let (surface, mesh) = (
        book.surface(index).unwrap(),
        book.paper_mesh(index).unwrap(),
    );
    crate::book::parts_depth::depth_of_parts(surface, mesh, creases)
}

/// Half of its flap lies under its page and half over it, as no paper can: put down so it is
/// pressed flat, and opens to where its crease rests. In one that lies as it is folded nothing is
/// opened.
#[test]
fn a_folded_leaf_that_comes_to_lie_through_itself_is_opened_anew() {
    use crate::contact::mesh::find_beyond;
    use crate::models::sheet::SheetCrease;
    let through = [[0.6, 0.0], [0.6, 1.0]];
    let crease = SheetCrease::pressed(through, 160f64.to_radians(), &Stock::BOOK, f64::from(WIDTH));
    for tilt in [0.0, 0.2] {
        let mut book = book();
        assert!(book.crease(40, &[crease]));
        while !book.is_asleep() {
            book.step(1);
        }
        let id = book.pick_up(Side::Right, 40, 41).unwrap();
        let leaf = book.flights.get_mut(id).unwrap().leaf_mut();
        let nodes = leaf.sheet.positions().as_chunks::<3>().0.iter();
        let beyond = find_beyond(leaf.sheet.node_triangles().into_iter(), nodes.len());
        let tilted: Vec<f32> = nodes
            .zip(&beyond)
            .flat_map(|([x, y, z], is_beyond)| {
                let up = if *is_beyond { tilt * (y - 0.105) } else { 0.02 };
                [*x, *y, z + up]
            })
            .collect();
        leaf.sheet.put_back(&tilted);
        leaf.wake();
        leaf.fallen = 1000;
        let (mut is_opened, mut strain) = (false, 0.0f32);
        let mut before: Option<Vec<[f32; 3]>> = None;
        let mut fastest = 0.0f32;
        for _ in 0..400 {
            book.step(1);
            let leaf = book.flights.order()[0].leaf();
            is_opened |= !leaf.opening.is_none();
            strain = strain.max(leaf.sheet.max_edge_strain());
            let now = leaf.sheet.positions().as_chunks::<3>().0.to_vec();
            for (p, q) in before.iter().flatten().zip(&now) {
                fastest = fastest.max(
                    (0..3)
                        .map(|axis| (p[axis] - q[axis]).abs())
                        .fold(0.0, f32::max),
                );
            }
            before = Some(now);
        }
        book.update();
        assert!(book.is_asleep(), "{tilt}");
        assert_eq!(is_opened, tilt > 0.0);
        assert!(strain < 1e-3, "{strain}, {tilt}");
        // At most 42 mm are eased in 18 ticks, half as fast again midway: nothing leaps.
        assert!(fastest < 4e-3, "{fastest} m in a tick, {tilt}");
        assert!(drawn_through_itself(&book, 0, &[crease]) < 1e-4, "{tilt}");
    }
}
