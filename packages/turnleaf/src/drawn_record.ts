/** What is drawn of a leaf in the engine's memory: the record that `wasm/src/drawn.rs` writes. */

import type { PaperMesh } from "./paper_mesh.ts";

/** Numbers of a record, and where the thickness of the paper is among them. */
const numbers = 12;
const caliperAt = 6;

/** A record as it is read: views of the engine's memory, which moves when it grows. */
export interface DrawnRecord {
  /** Points along a row. */
  readonly columns: number;
  /** Points along the spine. */
  readonly rows: number;
  /** x, y, z of each point in metres: 3 * columns * rows. */
  readonly positions: Float32Array;
  /** Unit normal of each point, likewise. */
  readonly normals: Float32Array;
  /** Rises whenever positions change. */
  readonly version: number;
  /** Changes whenever the mesh does. */
  readonly topology: number;
  /** Thickness of the paper, metres. */
  readonly caliper: number;
  /** Number of triangles of the mesh; 0 of a plain grid. */
  readonly triangles: number;
  /** Returns a copy of the mesh, if the points are no plain grid. */
  mesh(): PaperMesh | undefined;
}

/**
 * Reads a record.
 *
 * @param at its address; 0 is read as a leaf without points
 */
export function readDrawn({ buffer }: WebAssembly.Memory, at: number): DrawnRecord {
  const [columns, rows, positions, normals, version, topology, , triangles, ...mesh] =
    at === 0 ? new Uint32Array(numbers) : new Uint32Array(buffer, at, numbers);
  const points = columns * rows;
  const floats = (from: number, each: number) => new Float32Array(buffer, from, each * points);
  return {
    columns,
    rows,
    positions: floats(positions, 3),
    normals: floats(normals, 3),
    version,
    topology,
    caliper: at === 0 ? 0 : new Float32Array(buffer, at, numbers)[caliperAt],
    triangles,
    mesh: () => {
      if (triangles === 0) return undefined;
      const [places, corners, parts, tears] = mesh;
      return {
        places: floats(places, 2).slice(),
        triangles: new Uint32Array(buffer, corners, 3 * triangles).slice(),
        parts: new Uint16Array(buffer, parts, triangles).slice(),
        ...(tears > 0 && { tears: floats(tears, 3).slice() }),
      };
    },
  };
}
