/**
 * A frame as a sum of smooth surfaces: polynomials along u times polynomials
 * along v, orthonormal over the points. Paper bends smoothly, so a few of them
 * say nearly all of it, and the rest rounds to nothing.
 */

/** Orthonormal polynomials over places: the value of the k-th at place i lies at k * n + i. */
function polynomials(places: Float32Array): Float64Array {
  const n = places.length;
  const basis = new Float64Array(n * n);
  const next = new Float64Array(n).fill(1);
  for (let k = 0; k < n; k++) {
    // Taken away twice: once leaves a rounding error that grows with the degree.
    for (let time = 0; time < 2; time++) {
      for (let lower = 0; lower < k; lower++) {
        let share = 0;
        for (let i = 0; i < n; i++) share += next[i] * basis[lower * n + i];
        for (let i = 0; i < n; i++) next[i] -= share * basis[lower * n + i];
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

/** Frames of a size as sums, and back. */
export class Waves {
  readonly #columns: number;
  readonly #rows: number;
  readonly #alongU: Float64Array;
  readonly #alongV: Float64Array;
  readonly #half: Float64Array;
  /** Places of the shares in the order in which they are kept, the smoothest first. */
  readonly order: Uint32Array;

  /** Throws a RangeError where places are too near each other. */
  constructor(u: Float32Array, v: Float32Array) {
    const [columns, rows] = [u.length, v.length];
    this.#columns = columns;
    this.#rows = rows;
    this.#alongU = polynomials(u);
    this.#alongV = polynomials(v);
    if (!this.#alongU.every(Number.isFinite) || !this.#alongV.every(Number.isFinite)) {
      throw new RangeError("The columns or rows are too near each other.");
    }
    this.#half = new Float64Array(columns * rows);
    const rank = (at: number) => (at % columns) * rows + Math.floor(at / columns) * columns;
    this.order = Uint32Array.from({ length: columns * rows }, (_, at) => at).sort(
      (a, b) => rank(a) - rank(b) || a - b,
    );
  }

  /** Writes the values of the sums with shares, every third from `axis` on. */
  write(shares: Float64Array, values: Float32Array, axis: number): void {
    const [columns, rows, half] = [this.#columns, this.#rows, this.#half];
    half.fill(0);
    for (let at = 0; at < shares.length; at++) {
      const share = shares[at];
      if (share === 0) continue;
      const [k, row] = [at % columns, at - (at % columns)];
      for (let column = 0; column < columns; column++) {
        half[row + column] += share * this.#alongU[k * columns + column];
      }
    }
    for (let row = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++) {
        let value = 0;
        for (let k = 0; k < rows; k++) {
          value += half[k * columns + column] * this.#alongV[k * rows + row];
        }
        values[3 * (row * columns + column) + axis] = value;
      }
    }
  }

  /** The shares of the sums in values, every third from `axis` on. */
  shares(values: Float32Array, axis: number): Float64Array {
    const [columns, rows, half] = [this.#columns, this.#rows, this.#half];
    for (let row = 0; row < rows; row++) {
      for (let k = 0; k < columns; k++) {
        let share = 0;
        for (let column = 0; column < columns; column++) {
          const value = values[3 * (row * columns + column) + axis];
          share += value * this.#alongU[k * columns + column];
        }
        half[row * columns + k] = share;
      }
    }
    const shares = new Float64Array(columns * rows);
    for (let k = 0; k < rows; k++) {
      for (let row = 0; row < rows; row++) {
        const wave = this.#alongV[k * rows + row];
        for (let column = 0; column < columns; column++) {
          shares[k * columns + column] += half[row * columns + column] * wave;
        }
      }
    }
    return shares;
  }
}
