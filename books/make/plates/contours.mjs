/** Lines of equal distance from a coast, as charts draw the water: marching squares. */

/** Distance from a point to the nearest side of any polygon. */
export function coastDistance(polygons) {
  return (x, y) => {
    let best = Infinity;
    for (const polygon of polygons) {
      for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
        best = Math.min(best, toSegment(x, y, polygon[j], polygon[i]));
      }
    }
    return best;
  };
}

function toSegment(x, y, [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const len = dx * dx + dy * dy;
  const t = len ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / len)) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

/** A field sampled on a grid: { at(i, j), point(i, j), nx, ny }. */
export function sample(field, [x0, y0, x1, y1], step) {
  const nx = Math.ceil((x1 - x0) / step) + 1;
  const ny = Math.ceil((y1 - y0) / step) + 1;
  const values = new Float64Array(nx * ny);
  for (let j = 0; j < ny; j++) {
    for (let i = 0; i < nx; i++) values[j * nx + i] = field(x0 + i * step, y0 + j * step);
  }
  return {
    nx,
    ny,
    at: (i, j) => values[j * nx + i],
    point: (i, j) => [x0 + i * step, y0 + j * step],
  };
}

/** The lines where a sampled field has the value, each a list of points. */
export function isolines(grid, value) {
  const pieces = [];
  for (let j = 0; j + 1 < grid.ny; j++) {
    for (let i = 0; i + 1 < grid.nx; i++) cell(grid, i, j, value, pieces);
  }
  return join(pieces);
}

function cell(grid, i, j, value, pieces) {
  const corners = [
    [i, j],
    [i + 1, j],
    [i + 1, j + 1],
    [i, j + 1],
  ];
  const cuts = [];
  for (let k = 0; k < 4; k++) {
    const [a, b] = [corners[k], corners[(k + 1) % 4]];
    const [va, vb] = [grid.at(...a), grid.at(...b)];
    if (va < value === vb < value) continue;
    const t = (value - va) / (vb - va);
    const [p, q] = [grid.point(...a), grid.point(...b)];
    cuts.push([p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t]);
  }
  for (let k = 0; k + 1 < cuts.length; k += 2) pieces.push([cuts[k], cuts[k + 1]]);
}

const key = ([x, y]) => `${x.toFixed(4)},${y.toFixed(4)}`;

/** Chain two-point pieces end to end. */
function join(pieces) {
  const ends = new Map();
  const add = (point, piece) => {
    const k = key(point);
    if (!ends.has(k)) ends.set(k, []);
    ends.get(k).push(piece);
  };
  for (const piece of pieces) for (const point of piece) add(point, piece);
  const used = new Set();
  const lines = [];
  const grow = (line, first) => {
    for (;;) {
      const end = first ? line[0] : line[line.length - 1];
      const next = ends.get(key(end)).find((p) => !used.has(p));
      if (!next) return;
      used.add(next);
      const other = key(next[0]) === key(end) ? next[1] : next[0];
      if (first) line.unshift(other);
      else line.push(other);
    }
  };
  for (const piece of pieces) {
    if (used.has(piece)) continue;
    used.add(piece);
    const line = [...piece];
    grow(line, false);
    grow(line, true);
    if (line.length > 3) lines.push(line);
  }
  return lines;
}
