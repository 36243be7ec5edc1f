/** Numbers of vertices, of no more bytes than their mesh needs. */

/** Numbers of vertices, three by three for each triangle. */
export type VertexNumbers = Uint16Array | Uint32Array;

/** Most vertices whose numbers fit into 16 bits: of those the highest begins a new strip in WebGL 2. */
const mostShort = 0xffff;

/**
 * Returns the numbers of vertices as a mesh needs them.
 *
 * @param vertices how many the mesh has
 * @param index these numbers, or how many there is to be room for
 */
export function vertexNumbers(vertices: number, index: number | ArrayLike<number>): VertexNumbers {
  const Numbers = vertices <= mostShort ? Uint16Array : Uint32Array;
  return typeof index === "number" ? new Numbers(index) : Numbers.from(index);
}
