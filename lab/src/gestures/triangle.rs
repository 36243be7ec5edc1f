//! Points, edges and triangles in space: where they meet, and how near they are.

/// x, y, z in metres.
pub type Point = [f32; 3];

/// Where an edge goes through a facet.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Where along the edge, 0 to 1.
    pub at: f32,
    /// Whether the edge begins on the side of the facet's recto.
    pub from_recto: bool,
}

/// Where along p q it goes through the inside of a triangle (Moeller and
/// Trumbore 1997).
pub fn crossing(p: Point, q: Point, [a, b, c]: [Point; 3]) -> Option<Crossing> {
    let (direction, u, v) = (sub(q, p), sub(b, a), sub(c, a));
    let h = cross(direction, v);
    let determinant = dot(u, h);
    if determinant.abs() < 1e-16 {
        return None;
    }
    let s = sub(p, a);
    let x = dot(s, h) / determinant;
    let k = cross(s, u);
    let y = dot(direction, k) / determinant;
    let at = dot(v, k) / determinant;
    // The determinant is that of the direction against the facet's normal.
    (x >= 0.0 && y >= 0.0 && x + y <= 1.0 && at > 0.0 && at < 1.0).then_some(Crossing {
        at,
        from_recto: determinant > 0.0,
    })
}

/// The place of a triangle nearest to a point, and its parts of the corners
/// (Ericson, Real-Time Collision Detection, 5.1.5).
pub fn nearest_of_triangle(p: Point, a: Point, b: Point, c: Point) -> (Point, [f32; 3]) {
    let parts = nearest_parts(p, a, b, c);
    let place = core::array::from_fn(|i| parts[0] * a[i] + parts[1] * b[i] + parts[2] * c[i]);
    (place, parts)
}

fn nearest_parts(p: Point, a: Point, b: Point, c: Point) -> [f32; 3] {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3).max(1e-30);
        return [1.0 - v, v, 0.0];
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6).max(1e-30);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    let (e, f) = (d4 - d3, d5 - d6);
    if va <= 0.0 && e >= 0.0 && f >= 0.0 {
        let w = e / (e + f).max(1e-30);
        return [0.0, 1.0 - w, w];
    }
    let whole = 1.0 / (va + vb + vc).max(1e-30);
    let (v, w) = (vb * whole, vc * whole);
    [1.0 - v - w, v, w]
}

/// Dot product.
pub fn dot(a: Point, b: Point) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Difference.
pub fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Cross product.
pub fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
