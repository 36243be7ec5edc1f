/** The mesh of a creased leaf, and its vertices: each side of a crease has a normal of its own. */

/**
 * How the drawn points of a leaf that is creased, crumpled or torn across lie on its flat paper: they
 * are moved onto its creases, or lie along its tear.
 */
export interface PaperMesh {
  /** u and v of each point, 0 to 1. */
  readonly places: Float32Array;
  /** The points of each triangle, three by three; no triangle reaches over a crease. */
  readonly triangles: Uint32Array;
  /** The part of the leaf between creases that each triangle belongs to; of a crumpled one, its facet. */
  readonly parts: Uint16Array;
  /**
   * Of a sheet that is torn across, for each point how far it lies on its own side of the tear,
   * and how far along that from where it begins, metres; then 1 for the piece on the left, and -1.
   */
  readonly tears?: Float32Array | undefined;
}

/**
 * The vertices of a mesh: its points in their order, and after them a further one for each part
 * of the leaf but the first that a point on a crease belongs to.
 */
export interface SplitMesh {
  /** The point of each vertex. */
  readonly points: Uint32Array;
  /** The vertices of each triangle, three by three. */
  readonly index: Uint32Array;
  /**
   * The vertex of a point and a part, by `vertexKey`.
   *
   * @internal
   */
  readonly vertices: ReadonlyMap<number, number>;
}

/** Returns the key of a point and a part in `SplitMesh.vertices`. */
const vertexKey = (point: number, part: number): number => point * 0x10000 + part;

/** Splits the points on creases, so that no vertex belongs to two parts of the leaf. */
export function splitMesh({ places, triangles, parts }: PaperMesh): SplitMesh {
  const points = Array.from({ length: places.length / 2 }, (_, point) => point);
  const vertices = new Map<number, number>();
  const taken = new Uint8Array(points.length);
  const index = triangles.map((point, corner) => {
    const key = vertexKey(point, parts[Math.floor(corner / 3)]);
    let vertex = vertices.get(key);
    if (vertex === undefined) {
      vertex = taken[point] === 0 ? point : points.push(point) - 1;
      taken[point] = 1;
      vertices.set(key, vertex);
    }
    return vertex;
  });
  return { points: Uint32Array.from(points), index, vertices };
}

/**
 * Writes the unit normal of each vertex of a mesh: the mean of its triangles', by their areas,
 * which is smooth within a part of the leaf and differs from the next part's.
 *
 * @param index the vertices of each triangle
 * @param positions x, y, z of each vertex
 */
export function writeMeshNormals(
  index: Uint32Array | Uint16Array,
  positions: Float32Array,
  normals: Float32Array,
): void {
  const [p, n] = [positions, normals.fill(0)];
  for (let at = 0; at < index.length; at += 3) {
    const [a, b, c] = [3 * index[at], 3 * index[at + 1], 3 * index[at + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) {
      n[corner] += x;
      n[corner + 1] += y;
      n[corner + 2] += z;
    }
  }
  for (let at = 0; at < n.length; at += 3) {
    const length = Math.hypot(n[at], n[at + 1], n[at + 2]) || 1;
    for (let axis = 0; axis < 3; axis++) n[at + axis] /= length;
  }
}
