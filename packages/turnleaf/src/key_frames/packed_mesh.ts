/**
 * A mesh over the points of a grid, in few bytes: what version 3 of the files adds.
 * docs/formats.md describes it.
 */

import type { PaperMesh } from "../paper_mesh.ts";
import { BitReader, BitWriter } from "./bits.ts";

/** Parts of the leaf's width or height of which the place of a point is a whole number. */
const partsOfSide = 65535;

/** Maximum of the part of a triangle. */
const mostPart = 65535;

type Places = ArrayLike<number>;

/** Returns the number of triangles of a grid whose cells are each cut in two. */
const mostTriangles = (columns: number, rows: number): number => 2 * (columns - 1) * (rows - 1);

/**
 * Checks the mesh of a recording.
 *
 * @throws RangeError if it is no mesh of so many columns and rows of points
 */
export function requireMesh(mesh: PaperMesh, columns: number, rows: number): void {
  const { places, triangles, parts } = mesh;
  const points = columns * rows;
  const isMesh =
    places.length === 2 * points &&
    triangles.length === 3 * parts.length &&
    parts.length >= 1 &&
    parts.length <= mostTriangles(columns, rows) &&
    triangles.every((point) => point < points) &&
    places.every((place) => place >= 0 && place <= 1);
  if (!isMesh) throw new RangeError("The mesh of a creased leaf is of its columns and rows.");
}

/** Packs a mesh of points in columns at `u` and rows at `v`. */
export function packMesh(
  { places, triangles, parts }: PaperMesh,
  u: Places,
  v: Places,
): Uint8Array<ArrayBuffer> {
  const writer = new BitWriter();
  for (const axis of [0, 1]) {
    const even = evens(u, v, axis);
    writer.run(even.map((place, point) => kept(places[2 * point + axis]) - place));
  }
  for (const corner of [0, 1, 2]) {
    const apart = (_: unknown, at: number) =>
      triangles[3 * at + corner] - cutCell(at, u.length)[corner];
    writer.run(Int32Array.from(parts, apart));
  }
  writer.run(Int32Array.from(parts, (part, at) => part - (at > 0 ? parts[at - 1] : 0)));
  return writer.bytes;
}

/**
 * Unpacks the mesh of so many triangles that `packMesh` packed.
 *
 * @throws RangeError if the bytes are none
 */
export function unpackMesh(packed: Uint8Array, u: Places, v: Places, count: number): PaperMesh {
  const [columns, points] = [u.length, u.length * v.length];
  if (count < 1 || count > mostTriangles(columns, v.length)) {
    throw new RangeError("There are more triangles than of a grid.");
  }
  const reader = new BitReader(packed);
  const places = new Float32Array(2 * points);
  const ofPoints = new Int32Array(points);
  for (const axis of [0, 1]) {
    reader.run(ofPoints);
    for (const [point, even] of evens(u, v, axis).entries()) {
      const place = within(ofPoints[point] + even, partsOfSide);
      places[2 * point + axis] = place / partsOfSide;
    }
  }
  const triangles = new Uint32Array(3 * count);
  const ofTriangles = new Int32Array(count);
  for (const corner of [0, 1, 2]) {
    reader.run(ofTriangles);
    for (const [at, apart] of ofTriangles.entries()) {
      triangles[3 * at + corner] = within(cutCell(at, columns)[corner] + apart, points - 1);
    }
  }
  reader.run(ofTriangles);
  let part = 0;
  const parts = Uint16Array.from(ofTriangles, (apart) => {
    part = within(part + apart, mostPart);
    return part;
  });
  if (!reader.isAtEnd) throw new RangeError("There is more than the header says.");
  return { places, triangles, parts };
}

function within(value: number, most: number): number {
  if (value < 0 || value > most) throw new RangeError("It is out of bounds.");
  return value;
}

/** Returns a place in whole parts of the leaf's side. */
const kept = (place: number): number => Math.round(place * partsOfSide);

/** Returns of each point the place of its column (axis 0) or of its row (1), in whole parts. */
function evens(u: Places, v: Places, axis: number): Int32Array {
  const place = (_: unknown, point: number) =>
    kept(axis === 0 ? u[point % u.length] : v[Math.floor(point / u.length)]);
  return Int32Array.from({ length: u.length * v.length }, place);
}

/** Returns the corners of a triangle of a grid whose cells are cut from their foot at the spine. */
function cutCell(number: number, columns: number): readonly [number, number, number] {
  const cell = number >> 1;
  const foot = cell + Math.floor(cell / (columns - 1));
  const head = foot + columns;
  return number % 2 === 0 ? [foot, foot + 1, head + 1] : [foot, head + 1, head];
}
