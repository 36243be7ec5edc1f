//! Which frames a blend reads at a time, and the weight of each.

/// How frames are blended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blend {
    /// In straight lines between two frames: the paper's.
    Linear,
    /// By cubic Hermite pieces through four frames, whose tangents are those of
    /// the parabola through three: for even times the central differences of
    /// Catmull and Rom (1974).
    Hermite,
}

/// Frames that a blend reads, and the weight of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mix {
    /// Their indices.
    pub frame: [usize; 4],
    /// Their weights, in the same order.
    pub weight: [f32; 4],
}

/// The mix for the positions at a time, and the one for their velocities: the
/// blend's own derivative. `after` is the number of frames up to that time.
pub(super) fn mix(times: &[f32], after: usize, time: f32, blend: Blend) -> (Mix, Mix) {
    let last = times.len() - 1;
    if after == 0 || after > last {
        let frame = if after == 0 { 0 } else { last };
        let still = Mix {
            frame: [frame; 4],
            weight: [0.0; 4],
        };
        return (
            Mix {
                weight: [0.0, 1.0, 0.0, 0.0],
                ..still
            },
            still,
        );
    }
    let before = after - 1;
    let length = times[after] - times[before];
    let t = (time - times[before]) / length;
    let frame = [
        before.saturating_sub(1),
        before,
        after,
        (after + 1).min(last),
    ];
    let (here, rate) = match blend {
        Blend::Linear => (
            [0.0, 1.0 - t, t, 0.0],
            [0.0, -1.0 / length, 1.0 / length, 0.0],
        ),
        Blend::Hermite => {
            let [left, right] = [
                times[before] - times[frame[0]],
                times[frame[3]] - times[after],
            ]
            .map(|length_beside| length_beside / length);
            let (t2, t3) = (t * t, t * t * t);
            let here = [
                2.0 * t3 - 3.0 * t2 + 1.0,
                t3 - 2.0 * t2 + t,
                3.0 * t2 - 2.0 * t3,
                t3 - t2,
            ];
            let rate = [
                6.0 * t2 - 6.0 * t,
                3.0 * t2 - 4.0 * t + 1.0,
                6.0 * t - 6.0 * t2,
                3.0 * t2 - 2.0 * t,
            ];
            let rate = rate.map(|rate| rate / length);
            (hermite(here, left, right), hermite(rate, left, right))
        }
    };
    (
        Mix {
            frame,
            weight: here,
        },
        Mix {
            frame,
            weight: rate,
        },
    )
}

/// Weights of four frames from those of two values and two tangents. A tangent
/// is that of the parabola through its frame and both neighbours, `left` and
/// `right` their distances beyond the two frames, over the distance of these; a
/// frame without a neighbour (0) has that of the parabola at its other end.
fn hermite([mut h00, h10, mut h01, h11]: [f32; 4], left: f32, right: f32) -> [f32; 4] {
    let (mut a, mut b) = (h10, h11);
    if left == 0.0 && right > 0.0 {
        (h00, h01, b) = (h00 - 2.0 * a, h01 + 2.0 * a, b - a);
        a = 0.0;
    } else if right == 0.0 && left > 0.0 {
        (h00, h01, a) = (h00 - 2.0 * b, h01 + 2.0 * b, a - b);
        b = 0.0;
    } else if left == 0.0 {
        // Two frames alone: a straight line.
        return [0.0, h00 - a - b, h01 + a + b, 0.0];
    }
    let mut weight = [0.0, h00, h01, 0.0];
    if left > 0.0 {
        weight[0] -= a / (left * (left + 1.0));
        weight[1] += a * (1.0 - left) / left;
        weight[2] += a * left / (left + 1.0);
    }
    if right > 0.0 {
        weight[1] -= b * right / (right + 1.0);
        weight[2] -= b * (1.0 - right) / right;
        weight[3] += b / (right * (right + 1.0));
    }
    weight
}
