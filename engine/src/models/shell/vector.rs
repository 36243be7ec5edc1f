//! Vectors of space, in double precision.

/// x, y, z.
pub(super) type Vector = [f64; 3];

/// A block of a matrix that couples two nodes, row by row.
pub(super) type Block = [[f64; 3]; 3];

/// The dot product.
pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product.
pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// `a` less `b`.
pub(super) fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + s b.
pub(super) fn advance(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

/// `a`, `s` times as long.
pub(super) fn scale(s: f64, a: Vector) -> Vector {
    [s * a[0], s * a[1], s * a[2]]
}

/// The length.
pub(super) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The largest distance of corresponding places.
pub(super) fn furthest(a: &[Vector], b: &[Vector]) -> f64 {
    let distances = a.iter().zip(b).map(|(a, b)| length(difference(*a, *b)));
    distances.fold(0.0, f64::max)
}

/// s a bᵀ.
pub(super) fn outer(s: f64, a: Vector, b: Vector) -> Block {
    a.map(|a| scale(s * a, b))
}

/// a I + b n nᵀ.
pub(super) fn along(a: f64, b: f64, n: Vector) -> Block {
    let mut block = outer(b, n, n);
    for axis in 0..3 {
        block[axis][axis] += a;
    }
    block
}
