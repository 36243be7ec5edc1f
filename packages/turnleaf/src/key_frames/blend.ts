/** The frames that a blend reads at a time, and their weights: cubic Hermite pieces. */

/** Frames that a blend reads, and the weight of each. */
export interface Mix {
  readonly frame: readonly [number, number, number, number];
  readonly weight: readonly [number, number, number, number];
}

/**
 * Returns the mix at a time among increasing times. Before the first and after
 * the last the frames stand still.
 */
export function mixAt(times: ArrayLike<number>, time: number): Mix {
  const last = times.length - 1;
  const after = firstAfter(times, time);
  if (after === 0 || after > last) {
    const frame = after === 0 ? 0 : last;
    return { frame: [frame, frame, frame, frame], weight: [0, 1, 0, 0] };
  }
  const before = after - 1;
  const frame = [Math.max(before - 1, 0), before, after, Math.min(after + 1, last)] as const;
  const length = times[after] - times[before];
  const left = (times[before] - times[frame[0]]) / length;
  const right = (times[frame[3]] - times[after]) / length;
  return { frame, weight: weights((time - times[before]) / length, left, right) };
}

/** Returns the number of times up to a time. */
function firstAfter(times: ArrayLike<number>, time: number): number {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * Returns the weights of four frames. The tangent at a frame is that of the
 * parabola through it and both neighbours, `left` and `right` their distances
 * beyond the two frames, over the distance of these; a frame without a
 * neighbour (0) has that of the parabola at its other end.
 */
function weights(t: number, left: number, right: number): Mix["weight"] {
  let [from, to] = [(2 * t - 3) * t * t + 1, (3 - 2 * t) * t * t];
  let [a, b] = [((t - 2) * t + 1) * t, (t - 1) * t * t];
  if (left === 0 && right === 0) return [0, from - a - b, to + a + b, 0];
  if (left === 0) [from, to, a, b] = [from - 2 * a, to + 2 * a, 0, b - a];
  else if (right === 0) [from, to, a, b] = [from - 2 * b, to + 2 * b, a - b, 0];
  let [first, last] = [0, 0];
  if (left > 0) {
    first -= a / (left * (left + 1));
    from += (a * (1 - left)) / left;
    to += (a * left) / (left + 1);
  }
  if (right > 0) {
    from -= (b * right) / (right + 1);
    to -= (b * (1 - right)) / right;
    last += b / (right * (right + 1));
  }
  return [first, from, to, last];
}

/** Writes the blend of frames, each as long as `out`. */
export function blend({ frame, weight }: Mix, frames: Float32Array, out: Float32Array): void {
  const length = out.length;
  const [a, b, c, d] = frame.map((index) => frames.subarray(index * length, (index + 1) * length));
  const [wa, wb, wc, wd] = weight;
  for (let i = 0; i < length; i++) out[i] = wa * a[i] + wb * b[i] + (wc * c[i] + wd * d[i]);
}
