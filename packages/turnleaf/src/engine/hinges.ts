/** How the parts of a creased leaf hang together: each is creased to one that is nearer to the spine. */

import type { PaperMesh } from "../paper_mesh.ts";
import type { Surface } from "./shapes.ts";

/** A part of a leaf, the one that it is creased to on the way to the spine, and triangles on both sides of the crease. */
export interface Hinge {
  readonly part: number;
  readonly parent: number;
  readonly sides: readonly (readonly [own: number, parents: number])[];
}

/** The hinges of each mesh. */
const known = new WeakMap<PaperMesh, readonly Hinge[]>();

/** Returns the hinges of a mesh, each after that of its parent. */
export function hingesIn(creased: PaperMesh): readonly Hinge[] {
  let hinges = known.get(creased);
  if (hinges === undefined) {
    hinges = hingesOf(creased);
    known.set(creased, hinges);
  }
  return hinges;
}

/** Returns the parts of a creased leaf that come back over the rest of it, and all that are beyond them. */
export function foldedParts({ positions, creased }: Surface): readonly number[] {
  const folded: number[] = [];
  if (creased === undefined) return folded;
  for (const hinge of hingesIn(creased)) {
    const shut = isShut(hinge, creased, positions);
    if (shut || folded.includes(hinge.parent)) folded.push(hinge.part);
  }
  return folded;
}

/** Returns whether a part comes back over the one that it is creased to: by more than a right angle. */
export function isShut({ sides }: Hinge, creased: PaperMesh, positions: Float32Array): boolean {
  let facing = 0;
  for (const [own, parents] of sides) {
    const [a, b] = [own, parents].map((triangle) => normalOf(creased, positions, triangle));
    facing += (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / Math.hypot(...a) / Math.hypot(...b) || 0;
  }
  return facing <= 0;
}

/** Returns the normal of a triangle on the recto's side, of no particular length. */
export function normalOf(
  { triangles }: PaperMesh,
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
function hingesOf({ triangles, parts }: PaperMesh): readonly Hinge[] {
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
