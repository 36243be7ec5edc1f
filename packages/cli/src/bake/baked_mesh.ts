/**
 * The mesh of a baked leaf: the points of the model's surface, and the vertices that are drawn of
 * them. On a crease a point has a vertex for each side, with a normal of its own.
 */

import { type PaperMesh, splitMesh, writeMeshNormals } from "turnleaf/keyframes";
import { normalsOf, type Points } from "./baked_turn.ts";

/** A mesh, the same in every frame. */
export interface BakedMesh {
  /** The point of each vertex. */
  readonly points: Uint32Array;
  /** u and v of each vertex. */
  readonly places: Float32Array;
  /** The vertices of each face, three or four, counterclockwise as seen from the recto. */
  readonly faces: readonly (readonly number[])[];
  /** Returns the unit normal of each vertex of a frame, up where the leaf lies on the right. */
  normals(positions: Float32Array): Float32Array;
}

/** Returns the mesh of a leaf drawn at columns and rows, or moved onto its creases. */
export function meshOf(points: Points, creased: PaperMesh | undefined): BakedMesh {
  return creased ? creasedMesh(creased) : gridMesh(points);
}

/** Returns x, y, z of each vertex of a frame. */
export function placed({ points }: BakedMesh, positions: Float32Array): Float32Array {
  const placed = new Float32Array(3 * points.length);
  for (const [vertex, point] of points.entries()) {
    placed.set(positions.subarray(3 * point, 3 * point + 3), 3 * vertex);
  }
  return placed;
}

function gridMesh(grid: Points): BakedMesh {
  const { u, v } = grid;
  const faces: number[][] = [];
  for (let row = 0; row + 1 < v.length; row++) {
    for (let column = 0; column + 1 < u.length; column++) {
      const a = row * u.length + column;
      faces.push([a, a + 1, a + u.length + 1, a + u.length]);
    }
  }
  return {
    points: Uint32Array.from({ length: u.length * v.length }, (_, point) => point),
    places: Float32Array.from([...v].flatMap((y) => [...u].flatMap((x) => [x, y]))),
    faces,
    normals: (positions) => normalsOf(grid, positions),
  };
}

function creasedMesh(mesh: PaperMesh): BakedMesh {
  const { points, index } = splitMesh(mesh);
  const faces: number[][] = [];
  for (let at = 0; at < index.length; at += 3) faces.push([...index.subarray(at, at + 3)]);
  const places = [...points].flatMap((point) => [
    ...mesh.places.subarray(2 * point, 2 * point + 2),
  ]);
  const baked = { points, places: Float32Array.from(places), faces };
  return {
    ...baked,
    normals(positions) {
      const normals = new Float32Array(3 * points.length);
      writeMeshNormals(index, placed(this, positions), normals);
      return normals;
    },
  };
}
