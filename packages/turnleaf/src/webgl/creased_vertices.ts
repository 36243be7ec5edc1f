/** The vertices of a creased leaf: a point on a crease has one for each part of the leaf beside it. */

import { type CreasedMesh, splitMesh, vertexKey, writeMeshNormals } from "../creased_mesh.ts";
import type { Surface } from "../engine/shapes.ts";
import { type VertexNumbers, vertexNumbers } from "./vertex_numbers.ts";

/**
 * What throws the shadow of a flap: an end of its crease, as a vertex of the rest of the leaf, the
 * vertex that is farthest from the crease, and the four corners of the flap in turn: a triangle
 * repeats the last.
 */
interface FlapOutline {
  readonly from: number;
  readonly tip: number;
  readonly corners: readonly number[];
}

/** Steps along a row by which its direction is known. */
const stepsBack = 5;

/** A point beyond a crease or on one, and the last before it on its row that is neither. */
type BeyondCrease = readonly [point: number, from: number];

/** Those of each mesh, by the parts beyond the creases. */
const beyondCreases = new WeakMap<CreasedMesh, Map<string, readonly BeyondCrease[]>>();

/** A part of a leaf, the one that it is creased to on the way to the spine, and triangles on both sides of the crease. */
interface Hinge {
  readonly part: number;
  readonly parent: number;
  readonly sides: readonly (readonly [own: number, parents: number])[];
}

/** The hinges of each mesh, each after that of its parent. */
const hinges = new WeakMap<CreasedMesh, readonly Hinge[]>();

/** The length to which `cutOff` shortens what is folded over: seen as none. */
const sliver = 1e-3;

/**
 * Returns a leaf as if what is folded over were not there, for the shadow on what lies under it.
 * What is beyond a crease that stands open by more than a right angle stays.
 */
export function cutOff(leaf: Surface): Surface {
  return leaf.creased ? laidOn(leaf, leaf.creased, foldedParts(leaf, leaf.creased), sliver) : leaf;
}

/**
 * Returns a leaf with what is beyond its creases laid straight on from its rows, which light knows how
 * to go by: they never come back over themselves.
 */
export function straightened(leaf: Surface): Surface {
  const { creased } = leaf;
  if (!creased) return leaf;
  return laidOn(
    leaf,
    creased,
    [...new Set(creased.parts)].filter((part) => part !== 0),
    1,
  );
}

/** Returns a leaf with parts laid straight on from its rows, each to a length over its own. */
function laidOn(
  leaf: Surface,
  creased: CreasedMesh,
  parts: readonly number[],
  length: number,
): Surface {
  if (parts.length === 0) return leaf;
  const { columns } = leaf;
  const positions = leaf.positions.slice();
  const normals = leaf.normals.slice();
  for (const [point, from] of beyondCrease(creased, columns, parts)) {
    // On in the direction of several steps: points next to a crease may lie close together.
    const back = Math.max(from - (from % columns), from - stepsBack);
    const u = (k: number) => creased.places[2 * k];
    const steps = (u(point) - u(from)) / Math.max(u(from) - u(back), Number.EPSILON);
    for (let axis = 0; axis < 3; axis++) {
      const [last, before] = [leaf.positions[3 * from + axis], leaf.positions[3 * back + axis]];
      positions[3 * point + axis] = last + length * steps * (last - before);
      normals[3 * point + axis] = leaf.normals[3 * back + axis];
    }
  }
  return { ...leaf, positions, normals };
}

/** Returns the points of some parts of a mesh. */
function beyondCrease(
  creased: CreasedMesh,
  columns: number,
  parts: readonly number[],
): readonly BeyondCrease[] {
  const known = beyondCreases.get(creased) ?? new Map<string, readonly BeyondCrease[]>();
  beyondCreases.set(creased, known);
  const key = parts.join();
  let points = known.get(key);
  if (points === undefined) {
    // Points on a crease too: their normals are the means of both parts'.
    const ofParts = (_: number, corner: number) =>
      parts.includes(creased.parts[Math.floor(corner / 3)]);
    const beyond = new Set(creased.triangles.filter(ofParts));
    points = [...Array(creased.places.length / 2).keys()].flatMap((point) => {
      let from = point;
      while (from % columns > 1 && beyond.has(from)) from--;
      return from < point ? [[point, from] as const] : [];
    });
    known.set(key, points);
  }
  return points;
}

/** Returns the parts of a leaf that come back over the rest of it, and all that are beyond them. */
function foldedParts({ positions }: Surface, creased: CreasedMesh): readonly number[] {
  let known = hinges.get(creased);
  if (known === undefined) {
    known = hingesOf(creased);
    hinges.set(creased, known);
  }
  const folded: number[] = [];
  for (const { part, parent, sides } of known) {
    let facing = 0;
    for (const [own, parents] of sides) {
      const [a, b] = [own, parents].map((triangle) => normalOf(creased, positions, triangle));
      facing +=
        (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / Math.hypot(...a) / Math.hypot(...b) || 0;
    }
    if (facing <= 0 || folded.includes(parent)) folded.push(part);
  }
  return folded;
}

/** Returns the normal of a triangle, of no particular length. */
function normalOf(
  { triangles }: CreasedMesh,
  positions: Float32Array,
  triangle: number,
): readonly [number, number, number] {
  const [a, b, c] = triangles.subarray(3 * triangle, 3 * triangle + 3);
  const side = (to: number, axis: number) => positions[3 * to + axis] - positions[3 * a + axis];
  const [bx, by, bz] = [side(b, 0), side(b, 1), side(b, 2)];
  const [cx, cy, cz] = [side(c, 0), side(c, 1), side(c, 2)];
  return [by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx];
}

/** Finds the hinges between the parts of a mesh, from the part at the spine outward. */
function hingesOf({ triangles, parts }: CreasedMesh): readonly Hinge[] {
  const edges = new Map<string, number>();
  const sides = new Map<string, [number, number][]>();
  for (let triangle = 0; triangle < parts.length; triangle++) {
    for (let k = 0; k < 3; k++) {
      const [a, b] = [triangles[3 * triangle + k], triangles[3 * triangle + ((k + 1) % 3)]];
      const edge = `${Math.min(a, b)} ${Math.max(a, b)}`;
      const other = edges.get(edge);
      edges.set(edge, triangle);
      if (other === undefined || parts[other] === parts[triangle]) continue;
      for (const [own, parents] of [
        [triangle, other],
        [other, triangle],
      ] as const) {
        const between = `${parts[own]} ${parts[parents]}`;
        sides.set(between, [...(sides.get(between) ?? []), [own, parents]]);
      }
    }
  }
  const found: Hinge[] = [];
  const reached = [0];
  for (const parent of reached) {
    for (const part of new Set(parts)) {
      const between = sides.get(`${part} ${parent}`);
      if (between === undefined || reached.includes(part)) continue;
      reached.push(part);
      found.push({ part, parent, sides: between });
    }
  }
  return found;
}

/** The vertices of a creased leaf's mesh: its points in their order, and after them the further ones of those on creases. */
export class CreasedVertices {
  /** u and v of each vertex, as textures have them: v begins at the head. */
  readonly uv: Float32Array;
  /** Where each vertex lies by a tear, as `CreasedMesh.tears`. */
  readonly tears: Float32Array | undefined;
  /** 1 for each vertex of what is folded over, 0 for the others. */
  readonly folded: Float32Array;
  /** The vertices of each triangle. */
  readonly index: VertexNumbers;
  readonly positions: Float32Array;
  /** Each is smooth within its part of the leaf, and differs from the next part's. */
  readonly normals: Float32Array;
  /** The point of each vertex after the points. */
  readonly #further: Uint32Array;
  /** The vertices of what is folded over. */
  readonly #flaps: readonly number[];
  readonly #outlines: readonly FlapOutline[];

  constructor(mesh: CreasedMesh) {
    const { places } = mesh;
    const { points, index, vertices } = splitMesh(mesh);
    this.index = vertexNumbers(points.length, index);
    this.#further = points.subarray(places.length / 2);
    this.#flaps = [...vertices].flatMap(([key, vertex]) => (key % 0x10000 === 0 ? [] : [vertex]));
    this.#outlines = flapOutlines(places, vertices);
    this.folded = new Float32Array(points.length);
    for (const vertex of this.#flaps) this.folded[vertex] = 1;
    const uv = [...points].flatMap((k) => [places[2 * k], 1 - places[2 * k + 1]]);
    this.uv = Float32Array.from(uv);
    const { tears } = mesh;
    this.tears =
      tears && Float32Array.from([...points].flatMap((k) => [...tears.subarray(3 * k, 3 * k + 3)]));
    this.positions = new Float32Array(3 * points.length);
    this.normals = new Float32Array(3 * points.length);
  }

  /** Number of vertices. */
  get count(): number {
    return this.uv.length / 2;
  }

  /** Follows the leaf. */
  shape({ positions }: Surface): void {
    this.positions.set(positions);
    this.repeat(this.positions, 3);
    writeMeshNormals(this.index, this.positions, this.normals);
  }

  /** Repeats the numbers of each point, so many, for its further vertices. */
  repeat(numbers: Float32Array, size: number): void {
    let to = numbers.length - size * this.#further.length;
    for (const point of this.#further) {
      numbers.copyWithin(to, size * point, size * (point + 1));
      to += size;
    }
  }

  /**
   * Writes the gaps through which what is folded over sees the sky: as far as it faces it. The
   * gaps of a leaf's rows know nothing of what comes back over them.
   *
   * @param sign 1 for the recto, -1 for the verso
   * @param out left and right end for each vertex, radians
   */
  lightFlaps(sign: 1 | -1, out: Float32Array): void {
    const { normals } = this;
    const open = Math.PI / 2;
    for (const vertex of this.#flaps) {
      const facing = Math.atan2(sign * normals[3 * vertex], sign * normals[3 * vertex + 2]);
      out[2 * vertex] = Math.max(-open, facing - open);
      out[2 * vertex + 1] = Math.min(open, facing + open);
    }
  }

  /**
   * Writes the corners of what is folded over onto a side of the leaf, metres, book space, for
   * the shadows that it throws there. Returns how many flaps there are.
   *
   * @param sign 1 for the recto, -1 for the verso
   * @param out x, y, z of four corners each
   */
  writeFlaps(sign: 1 | -1, out: Float32Array): number {
    const { positions, normals } = this;
    let count = 0;
    for (const { from, tip, corners } of this.#outlines) {
      let [rise, facing] = [0, 0];
      for (let axis = 0; axis < 3; axis++) {
        const normal = normals[3 * from + axis];
        rise += (positions[3 * tip + axis] - positions[3 * from + axis]) * normal;
        facing += normals[3 * tip + axis] * normal;
      }
      // One that stands open is on the side that it would shade: bent, it would shade itself.
      if (facing >= 0 || rise * sign <= 0 || 12 * count === out.length) continue;
      for (const [k, vertex] of corners.entries()) {
        out.set(positions.subarray(3 * vertex, 3 * vertex + 3), 12 * count + 3 * k);
      }
      count++;
    }
    return count;
  }
}

/**
 * Returns the outline of each flap of a leaf that is creased to the part at its spine.
 *
 * @param vertices by point and part, as the constructor numbers them
 */
function flapOutlines(
  places: Float32Array,
  vertices: ReadonlyMap<number, number>,
): readonly FlapOutline[] {
  const parts = new Map<number, number[]>();
  for (const key of vertices.keys()) {
    const points = parts.get(key % 0x10000) ?? [];
    points.push(Math.floor(key / 0x10000));
    parts.set(key % 0x10000, points);
  }
  const away = (a: number, b: number): number =>
    Math.hypot(places[2 * a] - places[2 * b], places[2 * a + 1] - places[2 * b + 1]);
  const farthest = (from: number, points: readonly number[]): number =>
    points.reduce((best, one) => (away(from, one) > away(from, best) ? one : best));
  return [...parts].flatMap(([part, points]): FlapOutline[] => {
    const crease = points.filter((point) => vertices.has(vertexKey(point, 0)));
    if (part === 0 || crease.length < 2) return [];
    const from = farthest(crease[0], crease);
    const to = farthest(from, crease);
    const ofCrease = (one: number): number => Math.min(away(one, from), away(one, to));
    const tip = points.reduce((best, one) => (ofCrease(one) > ofCrease(best) ? one : best));
    const vertex = (point: number, of: number): number =>
      vertices.get(vertexKey(point, of)) as number;
    const [x, y] = [0, 1].map((axis) => places[2 * to + axis] - places[2 * from + axis]);
    // The corner beyond either end: what is far from the crease, and on that side.
    const beyond = (side: 1 | -1): number => {
      const far = (one: number): number => {
        const [dx, dy] = [0, 1].map((axis) => places[2 * one + axis] - places[2 * from + axis]);
        return Math.abs(x * dy - y * dx) + (side / 2) * (x * dx + y * dy);
      };
      return points.reduce((best, one) => (far(one) > far(best) ? one : best));
    };
    const corners = [from, to, beyond(1), beyond(-1)].map((point) => vertex(point, part));
    return [{ from: vertex(from, 0), tip: vertex(tip, part), corners }];
  });
}
