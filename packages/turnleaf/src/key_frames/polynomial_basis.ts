/**
 * A frame as a sum of smooth surfaces: polynomials along u times polynomials
 * along v, orthonormal over the points. Paper bends smoothly, so a few of them
 * describe nearly all of it, and the rest rounds to nothing.
 */

/**
 * Returns orthonormal polynomials over places: the value of the k-th at place i
 * is at k * n + i.
 */
function polynomials(places: Float32Array): Float64Array {
  const n = places.length;
  const basis = new Float64Array(n * n);
  const next = new Float64Array(n).fill(1);
  for (let k = 0; k < n; k++) {
    // Subtracted twice: once leaves a rounding error that grows with the degree.
    for (let time = 0; time < 2; time++) {
      for (let lower = 0; lower < k; lower++) {
        let coefficient = 0;
        for (let i = 0; i < n; i++) coefficient += next[i] * basis[lower * n + i];
        for (let i = 0; i < n; i++) next[i] -= coefficient * basis[lower * n + i];
      }
    }
    let square = 0;
    for (let i = 0; i < n; i++) square += next[i] * next[i];
    const length = Math.sqrt(square);
    for (let i = 0; i < n; i++) {
      const value = next[i] / length;
      basis[k * n + i] = value;
      next[i] = value * (2 * places[i] - 1);
    }
  }
  return basis;
}

/**
 * Multiplies two matrices, row by row, each element summed in the order of its
 * terms. Four terms at a time, because a large file has thousands of millions
 * of them.
 *
 * @param a of `rows` rows, each `stride` long, of which the first `terms` count
 * @param b of `terms` rows and `columns` columns
 */
function multiply(
  a: Float64Array,
  stride: number,
  b: Float64Array,
  rows: number,
  terms: number,
  columns: number,
  product: Float64Array,
): void {
  product.fill(0, 0, rows * columns);
  for (let row = 0; row < rows; row++) {
    const to = row * columns;
    let k = 0;
    for (; k + 4 <= terms; k += 4) {
      const at = row * stride + k;
      const [a0, a1, a2, a3] = [a[at], a[at + 1], a[at + 2], a[at + 3]];
      if (a0 === 0 && a1 === 0 && a2 === 0 && a3 === 0) continue;
      const [b0, b1, b2, b3] = [0, 1, 2, 3].map((i) => (k + i) * columns);
      for (let c = 0; c < columns; c++) {
        product[to + c] =
          product[to + c] + a0 * b[b0 + c] + a1 * b[b1 + c] + a2 * b[b2 + c] + a3 * b[b3 + c];
      }
    }
    for (; k < terms; k++) {
      const factor = a[row * stride + k];
      for (let c = 0; c < columns; c++) product[to + c] += factor * b[k * columns + c];
    }
  }
}

/** Converts frames of a size to coefficients, and back. */
export class PolynomialBasis {
  private readonly columns: number;
  private readonly rows: number;
  private readonly alongU: Float64Array;
  private readonly alongV: Float64Array;
  /** The same values as along v, those of one place side by side. */
  private readonly acrossV: Float64Array;
  private readonly half: Float64Array;
  private readonly sums: Float64Array;
  /** Indices of the coefficients in the order of the file, the smoothest first. */
  readonly order: Uint32Array;

  /** Throws a RangeError if places are too close to each other. */
  constructor(u: Float32Array, v: Float32Array) {
    const [columns, rows] = [u.length, v.length];
    this.columns = columns;
    this.rows = rows;
    this.alongU = polynomials(u);
    this.alongV = polynomials(v);
    if (!this.alongU.every(Number.isFinite) || !this.alongV.every(Number.isFinite)) {
      throw new RangeError("The columns or rows are too near each other.");
    }
    this.acrossV = this.alongV.map(
      (_, at) => this.alongV[(at % rows) * rows + Math.floor(at / rows)],
    );
    this.half = new Float64Array(columns * rows);
    this.sums = new Float64Array(columns * rows);
    const rank = (at: number) => (at % columns) * rows + Math.floor(at / columns) * columns;
    this.order = Uint32Array.from({ length: columns * rows }, (_, at) => at).sort(
      (a, b) => rank(a) - rank(b) || a - b,
    );
  }

  /**
   * Writes the values of the sums with some coefficients, into every third
   * place from `first` on.
   */
  write(coefficients: Float64Array, values: Float32Array, first: number): void {
    const [columns, rows, half, sums] = [this.columns, this.rows, this.half, this.sums];
    // High degrees along v are mostly 0 throughout.
    let degrees = coefficients.length;
    while (degrees > 0 && coefficients[degrees - 1] === 0) degrees--;
    degrees = Math.ceil(degrees / columns);
    multiply(coefficients, columns, this.alongU, degrees, columns, columns, half);
    multiply(this.acrossV, rows, half, rows, degrees, columns, sums);
    for (let at = 0; at < sums.length; at++) values[first + 3 * at] = sums[at];
  }

  /** Returns the coefficients of values, every third from `axis` on. */
  coefficients(values: Float32Array, axis: number): Float64Array {
    const [columns, rows, half] = [this.columns, this.rows, this.half];
    for (let row = 0; row < rows; row++) {
      for (let k = 0; k < columns; k++) {
        let coefficient = 0;
        for (let column = 0; column < columns; column++) {
          const value = values[3 * (row * columns + column) + axis];
          coefficient += value * this.alongU[k * columns + column];
        }
        half[row * columns + k] = coefficient;
      }
    }
    const coefficients = new Float64Array(columns * rows);
    for (let k = 0; k < rows; k++) {
      for (let row = 0; row < rows; row++) {
        const alongV = this.alongV[k * rows + row];
        for (let column = 0; column < columns; column++) {
          coefficients[k * columns + column] += half[row * columns + column] * alongV;
        }
      }
    }
    return coefficients;
  }
}
