/** What is folded over a leaf, for light and shadow. */

import { expect, test } from "vitest";
import { leafPapers } from "../engine/leaf_papers.ts";
import type { Surface } from "../engine/shapes.ts";
import type { PaperMesh } from "../paper_mesh.ts";
import { CreasedVertices, cutOff } from "./creased_vertices.ts";
import { vertexNumbers } from "./vertex_numbers.ts";

/** A square whose corner at (1, 0) can be folded along the line from (0.7, 0) to (1, 0.3). */
const mesh = {
  places: Float32Array.from([0, 0, 0.7, 0, 1, 0, 1, 0.3, 1, 1, 0, 1]),
  triangles: Uint32Array.from([0, 1, 3, 0, 3, 4, 0, 4, 5, 1, 2, 3]),
  parts: Uint16Array.from([0, 0, 0, 1]),
};

/** Returns the vertices with the corner turned up by an angle, radians, toward the recto. */
function folded(angle: number): CreasedVertices {
  const vertices = new CreasedVertices(mesh);
  const positions = new Float32Array(18);
  for (let k = 0; k < 6; k++) positions.set(mesh.places.subarray(2 * k, 2 * k + 2), 3 * k);
  const away = 0.3 / Math.SQRT2;
  const [along, up] = [away * Math.cos(angle), away * Math.sin(angle)];
  // The middle of the crease, and from there outward.
  positions.set([0.85 + along / Math.SQRT2, 0.15 - along / Math.SQRT2, up], 6);
  vertices.shape({ positions } as Surface);
  return vertices;
}

test("points on the crease have a vertex for each part, with a normal of its own", () => {
  const vertices = folded(Math.PI / 2);
  expect(vertices.count).toBe(8);
  const heights = Array.from({ length: 8 }, (_, k) => Math.round(vertices.normals[3 * k + 2]));
  // The tip, and the second vertices of the crease's ends, look along the page.
  expect(heights).toEqual([1, 1, 0, 1, 1, 1, 0, 0]);
});

/** A strip of four columns and two rows, creased at its second and third, that rises by angles there. */
function strip(...degrees: readonly [number, number]): Surface {
  const places: number[] = [];
  const positions: number[] = [];
  const normals: number[] = [];
  for (const v of [0, 1]) {
    let [x, z] = [0, 0];
    for (let column = 0; column < 4; column++) {
      const turned = degrees.slice(0, column).reduce((sum, angle) => sum + angle, 0);
      places.push(column / 3, v);
      positions.push(x, v, z);
      normals.push(0, 0, 1);
      x += Math.cos((turned / 180) * Math.PI) / 3;
      z += Math.sin((turned / 180) * Math.PI) / 3;
    }
  }
  const cells = [0, 1, 2].flatMap((k) => [k, k + 1, k + 5, k, k + 5, k + 4]);
  const creased = {
    places: Float32Array.from(places),
    triangles: Uint32Array.from(cells),
    parts: Uint16Array.from([0, 0, 1, 1, 2, 2]),
  };
  const at = { positions: Float32Array.from(positions), normals: Float32Array.from(normals) };
  return { ...at, columns: 4, rows: 2, creased, version: 1, papers: leafPapers } as Surface;
}

/** Returns how far the columns of a strip are seen from above, to hundredths. */
const reach = ({ positions }: Surface): number[] =>
  [0, 1, 2, 3].map((column) => Math.round(100 * positions[3 * column]));

test("what is beyond a crease is cut off for shadows where it comes back over the rest alone", () => {
  // Opened, both creases hide nothing of what is beyond them.
  expect(reach(cutOff(strip(0, 0)))).toEqual([0, 33, 67, 100]);
  expect(reach(cutOff(strip(60, -60)))).toEqual([0, 33, 50, 83]);
  // Folded shut, what is beyond the last column before the crease is a sliver.
  expect(reach(cutOff(strip(0, 170)))).toEqual([0, 33, 33, 33]);
  // A part beyond one that is folded lies on it, however it faces.
  expect(reach(cutOff(strip(170, -170)))).toEqual([0, 33, 33, 33]);
});

test("each vertex knows the part of the leaf that it is of", () => {
  const leaf = strip(170, -170);
  const { parts } = new CreasedVertices(leaf.creased as PaperMesh);
  // Two columns of each part, of two rows.
  for (const part of [0, 1, 2]) expect(parts.filter((one) => one === part)).toHaveLength(4);
  expect([0, 1, 4, 5].map((point) => parts[point])).toEqual([0, 0, 0, 0]);
});

test("vertices beyond those of 16 bits have numbers of their own", () => {
  expect(vertexNumbers(65535, [65534])).toEqual(Uint16Array.of(65534));
  expect(vertexNumbers(65536, [65535])).toEqual(Uint32Array.of(65535));
  expect(vertexNumbers(90000, 6)).toEqual(new Uint32Array(6));
});
