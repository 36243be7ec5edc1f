//! The resting pile of pages on one side of an open book.
//!
//! A page that is bound at the spine and lies on a pile rises steeply out of
//! the gutter, bends over and lies down. Its tangent's angle over the arc
//! length s from the spine is
//!
//! ```text
//! theta(s) = theta0 exp(-(s/a)^1.25) - c (s/b)^2 exp(2 - 2 s/b)
//! ```
//!
//! The first term is the rise out of the gutter, over a length `a` in
//! proportion to the pile's thickness; the second lets the page sink behind the
//! hump, with `c` found so that the fore-edge lands at its height in the pile.
//! In a pile about as thick as its pages are wide no fore-edge reaches its height:
//! there theta is limited to the angle at which pages leave the gutter, so that a
//! curve always has one height at each distance from it, as contact requires.
//! The shape is a fit to photographs of open books, not a solution of
//! elasticity. Pages deeper in the pile are bound farther from the gutter and
//! rise less, so the pile fans out as leaves glued to a flat spine do.

#[cfg(test)]
mod tests;

use std::borrow::Cow;

use crate::grid::Side;

/// Curves in a pile, from the uppermost page to the board.
pub const LAYERS: usize = 6;

/// Steps of the quadrature between two columns; with 4 the fore-edge lands
/// within 0.1 mm of its height, as a test holds.
const SUBSTEPS: usize = 4;

/// Length over which a page sinks behind the hump, metres.
const SINK_LENGTH: f64 = 0.030;

/// Angle at which the uppermost page of a thick pile leaves the gutter, radians.
const STEEPEST: f64 = 76.0 * core::f64::consts::PI / 180.0;

/// Angle at which the lowest page leaves the gutter, radians.
const FLATTEST: f64 = 6.0 * core::f64::consts::PI / 180.0;

/// Where the columns of pages and leaves lie: u from 0 at the spine to 1 at the
/// fore-edge, crowded toward the spine, where pages bend most.
///
/// `columns` is the number of columns, at least 2.
pub fn crowded_columns(columns: usize) -> Vec<f32> {
    let last = (columns - 1) as f64;
    (0..columns)
        .map(|i| power(i as f64 / last, 1.7) as f32)
        .collect()
}

/// A power of what is not negative, in less machine code than any base and exponent take.
fn power(base: f64, exponent: f64) -> f64 {
    if base > 0.0 {
        libm::exp(exponent * libm::log(base))
    } else {
        0.0
    }
}

/// The resting pages of one side as curves in the plane across the spine.
#[derive(Clone, Debug)]
pub struct Pile {
    columns: usize,
    /// x, z of each point, layer by layer from the top: 2 * columns * LAYERS.
    curves: Vec<f32>,
    /// Angle of the uppermost page's tangent, radians, midway between columns.
    angles: Vec<f32>,
    /// How straight it lies, 0 to 1: see [`straighten`](Self::straighten).
    straightness: f32,
}

impl Pile {
    /// The pile of `thickness` metres on `side`, of pages `width` metres wide,
    /// at the columns `u` (see [`crowded_columns`]).
    ///
    /// A thickness of 0 gives pages flat on the board.
    pub fn new(side: Side, width: f64, thickness: f64, u: &[f32]) -> Pile {
        let columns = u.len();
        let mut curves = vec![0.0; 2 * columns * LAYERS];
        let mut angles = vec![0.0; columns - 1];
        for (layer, curve) in curves.chunks_exact_mut(2 * columns).enumerate() {
            let depth = layer as f64 / (LAYERS - 1) as f64;
            let page = PageCurve::in_pile(thickness, depth, width);
            page.trace(u, width, side, curve);
            if layer == 0 {
                for (k, angle) in angles.iter_mut().enumerate() {
                    let s = 0.5 * (u[k] as f64 + u[k + 1] as f64) * width;
                    *angle = page.angle(s) as f32;
                }
            }
        }
        Pile {
            columns,
            curves,
            angles,
            straightness: 0.0,
        }
    }

    /// The pile of a closed book: pages flat upon each other, `thickness` metres
    /// high.
    pub fn closed(side: Side, width: f64, thickness: f64, u: &[f32]) -> Pile {
        let columns = u.len();
        let mut curves = vec![0.0; 2 * columns * LAYERS];
        for (layer, curve) in curves.chunks_exact_mut(2 * columns).enumerate() {
            let depth = layer as f64 / (LAYERS - 1) as f64;
            for (point, u) in curve.chunks_exact_mut(2).zip(u) {
                point[0] = side.sign() * u * width as f32;
                point[1] = (thickness * (1.0 - depth)) as f32;
            }
        }
        Pile {
            columns,
            curves,
            angles: vec![0.0; columns - 1],
            straightness: 0.0,
        }
    }

    /// Sets this pile to a fraction `t` (0 to 1) of the way from `a` to `b`, which
    /// have the same columns.
    pub fn blend(&mut self, a: &Pile, b: &Pile, t: f32) {
        let mix = |out: &mut [f32], a: &[f32], b: &[f32]| {
            for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
                *out = a + (b - a) * t;
            }
        };
        mix(&mut self.curves, &a.curves, &b.curves);
        mix(&mut self.angles, &a.angles, &b.angles);
        self.straightness = 0.0;
    }

    /// Moves this pile a fraction `t` (0 to 1) of the way toward `other`, which has
    /// the same columns.
    pub fn blend_toward(&mut self, other: &Pile, t: f32) {
        let mix = |own: &mut [f32], other: &[f32]| {
            for (own, other) in own.iter_mut().zip(other) {
                *own += (other - *own) * t;
            }
        };
        mix(&mut self.curves, &other.curves);
        mix(&mut self.angles, &other.angles);
    }

    /// Turns every part of this pile a `part` (0 to 1) of the way toward its chord, from the
    /// gutter to the height of the fore-edge: leaves keep their lengths.
    pub fn straighten(&mut self, part: f32) {
        self.straightness = part;
        for (layer, curve) in self.curves.chunks_exact_mut(2 * self.columns).enumerate() {
            let points = curve.as_chunks_mut::<2>().0;
            let last = points[points.len() - 1];
            let sign = if last[0] < 0.0 { -1.0 } else { 1.0 };
            let step = |a: [f32; 2], b: [f32; 2]| [sign * (b[0] - a[0]), b[1] - a[1]];
            let length_of = |[x, z]: [f32; 2]| (x * x + z * z).sqrt();
            let steps = points.windows(2).map(|pair| step(pair[0], pair[1]));
            let length: f32 = steps.map(length_of).sum();
            let rise = last[1] - points[0][1];
            let level = libm::atan2f(rise, (length * length - rise * rise).max(0.0).sqrt());
            let mut before = points[0];
            let [mut x, mut z] = before;
            for point in &mut points[1..] {
                let [dx, dz] = step(before, *point);
                before = *point;
                let angle = libm::atan2f(dz, dx);
                let (sin, cos) = libm::sincosf(angle + part * (level - angle));
                let length = length_of([dx, dz]);
                x += sign * length * cos;
                z += length * sin;
                *point = [x, z];
            }
            if layer == 0 {
                for angle in &mut self.angles {
                    *angle += part * (level - *angle);
                }
            }
        }
    }

    /// Makes this pile the same as `other`, which has the same columns.
    pub fn copy(&mut self, other: &Pile) {
        self.curves.copy_from_slice(&other.curves);
        self.angles.copy_from_slice(&other.angles);
        self.straightness = other.straightness;
    }

    /// Turns a pile of one side into the same pile on the other.
    pub fn mirror(&mut self) {
        for point in self.curves.chunks_exact_mut(2) {
            point[0] = -point[0];
        }
    }

    /// How far along the uppermost page each column is from the spine, metres.
    pub fn distances(&self) -> Vec<f32> {
        let curve = self.curves.as_chunks::<2>().0[..self.columns].windows(2);
        let mut far = 0.0;
        let lengths = curve.map(|ends| {
            let [dx, dz] = [0, 1].map(|axis| ends[1][axis] - ends[0][axis]);
            far += (dx * dx + dz * dz).sqrt();
            far
        });
        [0.0].into_iter().chain(lengths).collect()
    }

    /// Points along each curve.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// x, z in metres of each point, layer by layer from the uppermost page to
    /// the board: 2 * columns * [`LAYERS`].
    pub fn curves(&self) -> &[f32] {
        &self.curves
    }

    /// Angle of the uppermost page's tangent above the table, radians, midway
    /// between column k and k + 1: columns - 1 of them. Counted upward on both
    /// sides.
    pub fn angles(&self) -> &[f32] {
        &self.angles
    }

    /// The [angles](Self::angles) by which a leaf of some straightness (0 to 1) is bent: as the
    /// pile is, and where it is straighter than the pile as this would be under it.
    pub fn angles_for(&self, straightness: f32) -> Cow<'_, [f32]> {
        if straightness <= self.straightness {
            return Cow::Borrowed(&self.angles);
        }
        let bent = (1.0 - straightness) / (1.0 - self.straightness);
        let [[x0, z0], [x1, z1]] = [0, self.columns - 1].map(|column| self.place(column));
        let level = libm::atan2f(z1 - z0, x1 - x0);
        let angles = self.angles.iter();
        Cow::Owned(angles.map(|angle| level + bent * (angle - level)).collect())
    }

    /// Greatest height of the uppermost page, metres.
    pub fn highest(&self) -> f32 {
        let top = self.curves[..2 * self.columns].chunks_exact(2);
        top.map(|point| point[1]).fold(0.0, f32::max)
    }

    /// The last column of the uppermost page that is nearer to the gutter than `x` >= 0,
    /// or the first. Sought from column `from`: what lies next to what was asked about
    /// before is found at once.
    pub fn column_before(&self, x: f32, from: usize) -> usize {
        // A page leaves the gutter at less than a right angle, so what is farther along
        // it is farther from the gutter.
        let mut k = from;
        while k > 0 && self.place(k)[0] >= x {
            k -= 1;
        }
        while k + 1 < self.columns && self.place(k + 1)[0] < x {
            k += 1;
        }
        k
    }

    /// The uppermost page's distance from the gutter and its height at a column, metres.
    pub fn place(&self, column: usize) -> [f32; 2] {
        let [x, z] = self.curves.as_chunks::<2>().0[column];
        [x.abs(), z]
    }

    /// Height in metres and slope away from the gutter of the uppermost page at a
    /// distance `x` >= 0 from it, which is next after [`column`](Self::column_before);
    /// beyond the fore-edge it is level, and as high as that.
    pub fn height_and_slope(&self, x: f32, column: usize) -> (f32, f32) {
        let [x0, z0] = self.place(column);
        if column + 1 == self.columns {
            return (z0, 0.0);
        }
        let [x1, z1] = self.place(column + 1);
        let slope = (z1 - z0) / (x1 - x0).max(1e-9);
        (z0 + slope * (x - x0).max(0.0), slope)
    }

    /// Height in metres of the uppermost page at a distance `x` >= 0 from the
    /// gutter; beyond the fore-edge, the fore-edge's.
    pub fn height(&self, x: f32) -> f32 {
        self.height_and_slope(x, self.column_before(x, 0)).0
    }
}

/// How strongly the sink bends a page at the arc length `s`, metres.
fn bell(s: f64) -> f64 {
    let t = s / SINK_LENGTH;
    t * t * libm::exp(2.0 - 2.0 * t)
}

/// Steps of the quadrature of a fore-edge's height.
const HEIGHT_STEPS: usize = 64;

/// A step of that quadrature: the rise and the sink's bell in its middle, and
/// its length in metres.
struct Step {
    rise: f64,
    bell: f64,
    ds: f64,
}

/// One page's curve: its place at the spine and the constants of its angle.
struct PageCurve {
    /// Distance of the page's binding from the gutter, metres.
    root: f64,
    rise_angle: f64,
    rise_length: f64,
    sink: f64,
}

impl PageCurve {
    /// The page at `depth` (0 uppermost, 1 on the board) in a pile of
    /// `thickness`, with the sink found by bisection so that the fore-edge
    /// lands at its height.
    fn in_pile(thickness: f64, depth: f64, width: f64) -> PageCurve {
        let height = thickness * (1.0 - depth);
        // A thin pile cannot rise steeply: its page would stand up as a ridge.
        let steepest = FLATTEST + (STEEPEST - FLATTEST) * thickness / (thickness + 0.0015);
        let mut page = PageCurve {
            root: thickness * depth,
            rise_angle: if thickness > 0.0 {
                FLATTEST + (steepest - FLATTEST) * power(1.0 - depth, 0.8)
            } else {
                0.0
            },
            rise_length: (0.9 * thickness).max(0.004),
            sink: 0.0,
        };
        let steps = page.steps(width);
        let (mut low, mut high) = (-1.5, 1.5);
        for _ in 0..30 {
            page.sink = 0.5 * (low + high);
            let landed: f64 = steps
                .iter()
                .map(|step| libm::sincos(page.bend(step.rise, step.bell)).0 * step.ds)
                .sum();
            // More sink, lower fore-edge.
            if landed > height {
                low = page.sink;
            } else {
                high = page.sink;
            }
        }
        page
    }

    fn angle(&self, s: f64) -> f64 {
        self.bend(self.rise(s), bell(s))
    }

    /// The tangent's angle where the page rises by `rise` and sinks by the `bell` there.
    fn bend(&self, rise: f64, bell: f64) -> f64 {
        (rise - self.sink * bell).min(STEEPEST)
    }

    fn rise(&self, s: f64) -> f64 {
        self.rise_angle * libm::exp(-power(s / self.rise_length, 1.25))
    }

    /// The quadrature of the fore-edge's height, all but the sink that is looked for.
    fn steps(&self, width: f64) -> [Step; HEIGHT_STEPS] {
        // Steps crowd toward the spine as the columns do.
        let place = |i: usize| width * power(i as f64 / HEIGHT_STEPS as f64, 1.7);
        core::array::from_fn(|i| {
            let (s0, s1) = (place(i), place(i + 1));
            let s = 0.5 * (s0 + s1);
            Step {
                rise: self.rise(s),
                bell: bell(s),
                ds: s1 - s0,
            }
        })
    }

    /// Writes x, z at the columns `u`.
    fn trace(&self, u: &[f32], width: f64, side: Side, curve: &mut [f32]) {
        let (mut x, mut z, mut s) = (self.root, 0.0, 0.0);
        for (k, point) in curve.chunks_exact_mut(2).enumerate() {
            let end = u[k] as f64 * width;
            let ds = (end - s) / SUBSTEPS as f64;
            for i in 0..SUBSTEPS {
                let angle = self.angle(s + (i as f64 + 0.5) * ds);
                let (sin, cos) = libm::sincos(angle);
                x += cos * ds;
                z += sin * ds;
            }
            s = end;
            point[0] = side.sign() * x as f32;
            point[1] = z as f32;
        }
    }
}
