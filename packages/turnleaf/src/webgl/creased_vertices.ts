/** The vertices of a creased leaf: a point on a crease has one for each part of the leaf beside it. */

import type { Surface } from "../engine/shapes.ts";
import { type PaperMesh, splitMesh, writeMeshNormals } from "../paper_mesh.ts";
import { type VertexNumbers, vertexNumbers } from "./vertex_numbers.ts";

/** Steps along a row by which its direction is known. */
const stepsBack = 5;

/** A point beyond a crease or on one, and the last before it on its row that is neither. */
type BeyondCrease = readonly [point: number, from: number];

/** Those of each mesh, by the parts beyond the creases. */
const beyondCreases = new WeakMap<PaperMesh, Map<string, readonly BeyondCrease[]>>();

/** The length to which `cutOff` shortens what is folded over: seen as none. */
const sliver = 1e-3;

/**
 * Returns a leaf as if what is folded over were not there, for the shadow on what lies under it.
 * What is beyond a crease that stands open by more than a right angle stays.
 */
export function cutOff(leaf: Surface): Surface {
  const folded = leaf.papers?.foldedParts(leaf) ?? [];
  return leaf.creased ? laidOn(leaf, leaf.creased, folded, sliver) : leaf;
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
  creased: PaperMesh,
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
  creased: PaperMesh,
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

/** The vertices of a creased leaf's mesh: its points in their order, and after them the further ones of those on creases. */
export class CreasedVertices {
  /** u and v of each vertex, as textures have them: v begins at the head. */
  readonly uv: Float32Array;
  /** Where each vertex lies by a tear, as `PaperMesh.tears`. */
  readonly tears: Float32Array | undefined;
  /** The part of the leaf, by number, that each vertex belongs to. */
  readonly parts: Float32Array;
  /** The vertices of each triangle. */
  readonly index: VertexNumbers;
  readonly positions: Float32Array;
  /** Each is smooth within its part of the leaf, and differs from the next part's. */
  readonly normals: Float32Array;
  /** The point of each vertex after the points. */
  readonly #further: Uint32Array;
  /** The vertices of what is folded over. */
  readonly #flaps: readonly number[];

  constructor(mesh: PaperMesh) {
    const { places } = mesh;
    const { points, index, vertices } = splitMesh(mesh);
    this.index = vertexNumbers(points.length, index);
    this.#further = points.subarray(places.length / 2);
    this.parts = new Float32Array(points.length);
    for (const [key, vertex] of vertices) this.parts[vertex] = key % 0x10000;
    this.#flaps = [...this.parts.keys()].filter((vertex) => this.parts[vertex] > 0);
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
}
