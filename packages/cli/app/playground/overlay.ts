/**
 * The overlay of a leaf, as in the paper's figures: its masses, its springs,
 * lines parallel to the dog-ear line.
 */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  LineBasicMaterial,
  LineSegments,
  Points,
  PointsMaterial,
  type Scene,
} from "three";
import { type LeafGrid, springsOf } from "turnleaf/models";
import type { Settings } from "./settings.ts";
import { hasSprings, leafSize, type Variant } from "./variants.ts";

const springColours = { structural: "#2b5f8a", shear: "#7a9a3a", bend: "#c0792a" } as const;
const lineColour = "#a8322a";
const massColour = "#1d1a17";

/** Lines parallel to the dog-ear line across the width, and points along each. */
const linesAcross = 8;
const pointsAlong = 25;

/** Drawn over the paper, not hidden by it: the far side of a bend is part of the figure. */
const over = { depthTest: false, depthWrite: false, transparent: true } as const;

/** Returns a round sprite for masses. */
function disc(): DataTexture {
  const size = 32;
  const pixels = new Uint8Array(4 * size * size).fill(255);
  for (let k = 0; k < size * size; k++) {
    const off = Math.hypot((k % size) - (size - 1) / 2, Math.floor(k / size) - (size - 1) / 2);
    pixels[4 * k + 3] = Math.round(255 * Math.min(1, Math.max(0, (size / 2 - off) / 4)));
  }
  const texture = new DataTexture(pixels, size, size);
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}

/** A part of the overlay: as many points as it currently needs. */
class Marks<Mesh extends Points | LineSegments> {
  readonly mesh: Mesh;
  #room = 0;

  constructor(mesh: Mesh, order: number) {
    this.mesh = mesh;
    mesh.frustumCulled = false;
    mesh.renderOrder = order;
    mesh.visible = false;
  }

  /** Returns the positions to write to, reallocated if their number changed. */
  positions(count: number): Float32Array {
    if (count !== this.#room) {
      this.#room = count;
      this.mesh.geometry.dispose();
      this.mesh.geometry = new BufferGeometry();
      this.mesh.geometry.setAttribute(
        "position",
        new BufferAttribute(new Float32Array(3 * count), 3),
      );
    }
    const attribute = this.mesh.geometry.getAttribute("position");
    attribute.needsUpdate = true;
    return attribute.array as Float32Array;
  }
}

/** The overlay of one leaf. */
export class Overlay {
  readonly #masses = new Marks(
    new Points(
      new BufferGeometry(),
      new PointsMaterial({
        map: disc(),
        color: massColour,
        size: 7,
        sizeAttenuation: false,
        ...over,
      }),
    ),
    12,
  );
  readonly #springs = Object.entries(springColours).map(([kind, color]) => ({
    kind,
    marks: new Marks(
      new LineSegments(
        new BufferGeometry(),
        new LineBasicMaterial({ color: new Color(color), opacity: 0.75, ...over }),
      ),
      10,
    ),
  }));
  readonly #lines = new Marks(
    new LineSegments(
      new BufferGeometry(),
      new LineBasicMaterial({ color: lineColour, opacity: 0.9, ...over }),
    ),
    11,
  );

  constructor(scene: Scene) {
    scene.add(this.#masses.mesh, this.#lines.mesh, ...this.#springs.map(({ marks }) => marks.mesh));
  }

  /** Follows a leaf; parts that are switched off are hidden. */
  show(variant: Variant, nodes: LeafGrid, surface: LeafGrid, settings: Settings): void {
    this.#masses.mesh.visible = settings.masses;
    if (settings.masses) {
      this.#masses.positions(nodes.columns * nodes.rows).set(nodes.positions);
    }
    this.#showSprings(settings.springs, hasSprings(variant), nodes);
    this.#lines.mesh.visible = settings.lines;
    if (settings.lines) this.#showLines(surface, (settings.angle * Math.PI) / 180);
  }

  /** Shows the springs of a leaf that has them; of another the edges between its nodes. */
  #showSprings(
    isShown: boolean,
    areSprings: boolean,
    { columns, rows, positions }: LeafGrid,
  ): void {
    const all = isShown ? springsOf(columns, rows) : [];
    for (const { kind, marks } of this.#springs) {
      const own = all.filter((spring) => spring.kind === kind);
      marks.mesh.visible = own.length > 0 && (areSprings || kind === "structural");
      if (!marks.mesh.visible) continue;
      const to = marks.positions(2 * own.length);
      for (const [k, spring] of own.entries()) {
        copyPoint(positions, spring.from, to, 2 * k);
        copyPoint(positions, spring.to, to, 2 * k + 1);
      }
    }
  }

  #showLines(surface: LeafGrid, angle: number): void {
    const lines = linesAt(angle);
    const to = this.#lines.positions(2 * (pointsAlong - 1) * lines.length);
    let at = 0;
    for (const [from, end] of lines) {
      for (let k = 0; k + 1 < pointsAlong; k++) {
        for (const t of [k / (pointsAlong - 1), (k + 1) / (pointsAlong - 1)]) {
          const u = from[0] + (end[0] - from[0]) * t;
          const v = from[1] + (end[1] - from[1]) * t;
          writePlace(surface, u, v, to, at++);
        }
      }
    }
  }
}

type Place = readonly [u: number, v: number];

/** Returns the ends of lines across a flat leaf, each at `angle` radians with the spine. */
function linesAt(angle: number): (readonly [Place, Place])[] {
  const { width, height } = leafSize;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const far = width * c + height * s;
  const lines: (readonly [Place, Place])[] = [];
  for (let k = 1; k * (width / linesAcross) < far - 1e-9; k++) {
    const distance = (k * width) / linesAcross;
    // Where x c + y s = distance meets the four edges.
    const ends: [number, number][] = [];
    const add = (x: number, y: number) => {
      const inside = x > -1e-9 && x < width + 1e-9 && y > -1e-9 && y < height + 1e-9;
      const isNew = ends.every(([a, b]) => Math.hypot(a - x, b - y) > 1e-6);
      if (inside && isNew) ends.push([x, y]);
    };
    if (s > 1e-9) for (const x of [0, width]) add(x, (distance - x * c) / s);
    if (c > 1e-9) for (const y of [0, height]) add((distance - y * s) / c, y);
    const [a, b] = ends.map(([x, y]): Place => [clamp(x / width), clamp(y / height)]);
    if (a && b) lines.push([a, b]);
  }
  return lines;
}

const clamp = (fraction: number): number => Math.min(1, Math.max(0, fraction));

function copyPoint(from: Float32Array, point: number, to: Float32Array, place: number): void {
  for (let axis = 0; axis < 3; axis++) to[3 * place + axis] = from[3 * point + axis];
}

/** Interpolates the place (u, v) of a surface between its four nearest points. */
function writePlace(
  { columns, rows, positions }: LeafGrid,
  u: number,
  v: number,
  to: Float32Array,
  place: number,
): void {
  const [x, y] = [u * (columns - 1), v * (rows - 1)];
  const [i, j] = [Math.min(Math.floor(x), columns - 2), Math.min(Math.floor(y), rows - 2)];
  const [s, t] = [x - i, y - j];
  const here = j * columns + i;
  for (let axis = 0; axis < 3; axis++) {
    const at = (point: number) => positions[3 * point + axis];
    const low = at(here) + (at(here + 1) - at(here)) * s;
    const high = at(here + columns) + (at(here + columns + 1) - at(here + columns)) * s;
    to[3 * place + axis] = low + (high - low) * t;
  }
}
