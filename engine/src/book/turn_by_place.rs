//! How the gutter turns what is folded over: by where it is, and not by how far along its row.
//!
//! A leaf that is not folded is as far from the spine as it is along its row, and the gutter
//! turns it by that (see [`bend_into_gutter`](super::bend_into_gutter())). A flap comes back toward
//! the spine: there it is to be turned as the page is that it lies upon, or is drawn, and meets
//! it, as if it went through that where the gutter is steep.

use super::fraction_turned::fraction_turned;

/// The mean turn, cosine and sine, on the way between two places over a flat table, x and z
/// each, metres. The gutter's turns are those of cells that end so far from the spine, the first
/// at 0, as `turn` gives them by the cell and by how far it has turned, 0 to 1; beyond the last
/// the last one's.
pub fn turn_between(
    from: [f32; 2],
    to: [f32; 2],
    ends: &[f32],
    turn: impl Fn(usize, f32) -> [f32; 2],
) -> [f32; 2] {
    if from[0] * to[0] >= 0.0 {
        return turn_on_one_side(from, to, ends, &turn);
    }
    // Over the spine: one part of the way on either side.
    let part = from[0] / (from[0] - to[0]);
    let middle = [0.0, from[1] + part * (to[1] - from[1])];
    let [before, after] =
        [[from, middle], [middle, to]].map(|[from, to]| turn_on_one_side(from, to, ends, &turn));
    [0, 1].map(|k| part * before[k] + (1.0 - part) * after[k])
}

fn turn_on_one_side(
    from: [f32; 2],
    to: [f32; 2],
    ends: &[f32],
    turn: &impl Fn(usize, f32) -> [f32; 2],
) -> [f32; 2] {
    let far = |[x, z]: [f32; 2]| (x * x + z * z).sqrt();
    let [low, high] = {
        let [a, b] = [far(from), far(to)];
        if a < b { [a, b] } else { [b, a] }
    };
    let turned = fraction_turned(from[0] + to[0], from[1] + to[1]);
    let last = ends.len() - 2;
    let cell_of = |far: f32| (ends.partition_point(|end| *end <= far).max(1) - 1).min(last);
    let [first, end] = [low, high].map(cell_of);
    // A way along which the distance does not change is in one cell.
    if first == end || high <= low {
        return turn(first, turned);
    }
    let mut sum = [0.0; 2];
    for cell in first..=end {
        let until = if cell == end { high } else { ends[cell + 1] };
        let part = (until - low.max(ends[cell])) / (high - low);
        let own = turn(cell, turned);
        sum = [0, 1].map(|k| sum[k] + part * own[k]);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::bend_into_gutter::bend_into_gutter;
    use super::super::pile::{Pile, crowded_columns};
    use crate::creased_only::CreasedOnly;
    use crate::grid::Side;

    /// What lies upon a page in the gutter is turned as that is, whichever way it was folded there.
    #[test]
    fn a_flap_lies_along_the_page_that_it_is_folded_onto() {
        let (width, columns) = (0.14f32, 49);
        let u = crowded_columns(columns);
        let right = Pile::new(Side::Right, f64::from(width), 0.012, &u);
        let left = Pile::new(Side::Left, f64::from(width), 0.006, &u);
        let crease = 24;
        let middle = u[crease] * width;
        let folded = u.iter().enumerate().flat_map(|(column, u)| {
            let far = u * width;
            let x = if column > crease {
                2.0 * middle - far
            } else {
                far
            };
            [x, 0.0, 0.0]
        });
        let mut row: Vec<f32> = folded.collect();
        let flat = row.clone();
        let beyond: Vec<bool> = (0..columns).map(|column| column > crease).collect();
        bend_into_gutter(&mut row, &right, &left, (0.0, CreasedOnly::some(&beyond)));
        let mut lowest = f32::MAX;
        for column in crease + 1..columns {
            let x = flat[3 * column];
            lowest = lowest.min(x);
            // Where the page is at the same distance from the spine, or the page on the left.
            let (pile, far) = if x < 0.0 { (&left, -x) } else { (&right, x) };
            let cell = u
                .partition_point(|u| u * width <= far)
                .clamp(1, columns - 1)
                - 1;
            let part = (far / width - u[cell]) / (u[cell + 1] - u[cell]);
            let [a, b] = [pile.place(cell), pile.place(cell + 1)];
            let on_page = [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis]));
            let away = [
                row[3 * column] - x.signum() * on_page[0],
                row[3 * column + 2] - on_page[1],
            ];
            let away = away[0].hypot(away[1]);
            assert!(away < 2e-4, "{away} m off the page at {x} m");
        }
        assert!(lowest < -0.01, "it reaches beyond the spine");
    }
}
