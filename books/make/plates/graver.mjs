/**
 * A graver: cuts lines that swell and thin, as a burin does in boxwood. Tone is
 * made by the width of the lines alone; there are no greys. What stands in front
 * is cut later: `clear` takes its ground back to paper first, which hides the
 * lines behind it.
 *
 * A shape is a list of points [x, y] in points, y down. Everything is written in
 * twentieths of a point, so that most numbers are short integers.
 */
import { COLOUR } from "../measures.mjs";
import { simplify } from "./curves.mjs";

const UNIT = 0.05;
const int = (v) => Math.round(v / UNIT);

export class Graver {
  constructor({ ink = COLOUR.ink, ground = COLOUR.paper } = {}) {
    this.ink = ink;
    this.ground = ground;
    this.ops = [];
  }

  /** The operators, to be placed with the given offset. */
  at(x, y) {
    const head = `q ${UNIT} 0 0 ${UNIT} ${x.toFixed(2)} ${y.toFixed(2)} cm`;
    return [
      head,
      `${operands(this.ink)} rg ${operands(this.ink)} RG 1 J 1 j`,
      ...this.ops,
      "Q",
    ].join("\n");
  }

  path(points, closed = true) {
    const out = [];
    let px;
    let py;
    for (const [x, y] of points) {
      const ix = int(x);
      const iy = int(y);
      if (ix === px && iy === py) continue;
      out.push(`${ix} ${iy} ${out.length ? "l" : "m"}`);
      px = ix;
      py = iy;
    }
    return out.join(" ") + (closed ? " h" : "");
  }

  /** Change the ink from here on. */
  dip(colour) {
    this.ops.push(`${operands(colour)} rg ${operands(colour)} RG`);
  }

  /** Solid ink, or another colour for what is printed in one. */
  fill(shape, colour) {
    const path = this.path(shape);
    this.ops.push(colour ? `q ${operands(colour)} rg ${path} f Q` : `${path} f`);
  }

  /** Back to bare paper. */
  clear(shape) {
    this.fill(shape, this.ground);
  }

  /** A plain line of even width. */
  line(points, width = 0.6, closed = false) {
    this.ops.push(`${int(width)} w ${this.path(points, closed)} S`);
  }

  /** Work only within a shape. */
  within(shape, work) {
    this.ops.push(`q ${this.path(shape)} W n`);
    work();
    this.ops.push("Q");
  }

  /**
   * One swelling line. `width(t, x, y)` is its width in points along it, t from 0
   * to 1; the line is lifted where it falls under `least`.
   */
  swell(points, width, least = 0.1) {
    const n = points.length - 1;
    let run = [];
    const flush = () => {
      if (run.length > 1) this.ribbon(simplify(run, 0.09));
      run = [];
    };
    points.forEach(([x, y], i) => {
      const w = width(n ? i / n : 0, x, y);
      if (w >= least) run.push([x, y, w]);
      else {
        // Taper out instead of ending square.
        if (run.length) run.push([x, y, 0.02]);
        flush();
        if (i < n && width((i + 1) / n, ...points[i + 1]) >= least) run.push([x, y, 0.02]);
      }
    });
    flush();
  }

  /** A filled ribbon along [x, y, width] triples. */
  ribbon(line) {
    const left = [];
    const right = [];
    line.forEach(([x, y, w], i) => {
      const [ax, ay] = line[Math.max(i - 1, 0)];
      const [bx, by] = line[Math.min(i + 1, line.length - 1)];
      const len = Math.hypot(bx - ax, by - ay) || 1;
      const nx = (-(by - ay) / len) * w * 0.5;
      const ny = ((bx - ax) / len) * w * 0.5;
      left.push([x + nx, y + ny]);
      right.unshift([x - nx, y - ny]);
    });
    this.ops.push(`${this.path([...left, ...right])} f`);
  }

  /**
   * Cut a family of lines whose width follows a tone: `tone(x, y)` from 0, bare
   * paper, to 1, black; `pitch` is the distance between the lines.
   */
  hatch(lines, tone, pitch, { least = 0.12, most = 0.92 } = {}) {
    const width = (_, x, y) => Math.min(most, tone(x, y)) * pitch;
    for (const line of lines) this.swell(line, width, least);
  }
}

function operands(hex) {
  return [1, 3, 5]
    .map((i) => Math.round((Number.parseInt(hex.slice(i, i + 2), 16) / 255) * 1000) / 1000)
    .join(" ");
}
