/** The uppermost resting page of one side: its pile's top curve swept along the spine. */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from "three";
import { columnPlace } from "../engine/shapes.ts";
import type { LeafSection } from "./leaf_section.ts";
import { compassToRadians, gapsOfRow, keyAngle, leftEndUnder, penumbra } from "./light.ts";
import type { PaperMaterial } from "./paper_material.ts";
import { obstacleStride, type PileShape } from "./pile_shape.ts";
import { type VertexNumbers, vertexNumbers } from "./vertex_numbers.ts";

const noPoints = new Float32Array(0);

/** Rows of a resting page's mesh: how finely a leaf's shadow follows the leaf's shape. */
export const pageRows = 33;

/** What stands over a page: the leaf's sections for sky and key, and the tip of a board. */
export interface Overhead {
  readonly sky: LeafSection;
  /** One for each place on the key light. */
  readonly keys: readonly LeafSection[];
  /** x, z of points of the board, mirrored for the left; empty if it lies flat. */
  readonly board: Float32Array;
}

/** A resting page. */
export class PageMesh {
  readonly mesh: Mesh<BufferGeometry, PaperMaterial>;
  readonly #rows: number;
  readonly #height: number;
  #columns = 0;
  #positions = new Float32Array(0);
  #normals = new Float32Array(0);
  #gapSky = new Float32Array(0);
  #gapKey = new Float32Array(0);
  /** The gap of each column between the piles alone, radians, for the right side. */
  #gaps = new Float32Array(0);

  constructor(material: PaperMaterial, height: number, rows: number) {
    this.#rows = rows;
    this.#height = height;
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
  }

  /** Follows the pile. */
  shape(pile: PileShape): void {
    this.#allot(pile);
    const { sign, x, z, nx, nz, columns } = pile;
    for (let row = 0; row < this.#rows; row++) {
      const y = (row / (this.#rows - 1)) * this.#height;
      for (let i = 0; i < columns; i++) {
        const at = 3 * (row * columns + i);
        this.#positions[at] = sign * x[i];
        this.#positions[at + 1] = y;
        this.#positions[at + 2] = z[i];
        this.#normals[at] = sign * nx[i];
        this.#normals[at + 1] = 0;
        this.#normals[at + 2] = nz[i];
      }
    }
    this.#touch("position");
    this.#touch("normal");
  }

  /**
   * Computes the gaps between the piles.
   *
   * @param opposite points of the pile across the gutter, as seen from this
   * side on the right
   */
  open(pile: PileShape, opposite: Float32Array): void {
    const { x, z, nx, nz, columns } = pile;
    gapsOfRow(x, z, nx, nz, columns, obstacleStride, opposite, noPoints, this.#gaps);
    for (let k = 0; k < 2 * columns; k++) this.#gaps[k] = compassToRadians(this.#gaps[k]);
  }

  /** Computes the light on the page under what stands over it. */
  light(pile: PileShape, over: Overhead): void {
    const { x, z, columns, sign } = pile;
    const [gapSky, gapKey] = [this.#gapSky, this.#gapKey];
    // Wider than the soft edge, or an edge aslant of the rows would show steps;
    // not by much, or one along them would show three edges, as it does with
    // more rows.
    const keyLow = sign * keyAngle - 2.2 * penumbra;
    const keyHigh = sign * keyAngle + 2.2 * penumbra;
    for (let i = 0; i < columns; i++) {
      const right = this.#gaps[2 * i + 1];
      const board = compassToRadians(leftEndUnder(x[i], z[i], over.board, over.board.length));
      const left = Math.max(this.#gaps[2 * i], board);
      for (let row = 0; row < this.#rows; row++) {
        const point = row * columns + i;
        let sky = left;
        const skyPoints = over.sky.counts[row];
        if (skyPoints > 0) {
          const end = leftEndUnder(x[i], z[i], over.sky.row(row), skyPoints);
          sky = Math.max(left, compassToRadians(end));
        }
        gapSky[2 * point] = sign === 1 ? sky : -right;
        gapSky[2 * point + 1] = sign === 1 ? right : -sky;
        for (let k = 0; k < 3; k++) {
          const section = over.keys[k];
          const points = section.counts[row];
          let key = keyLow;
          if (points > 0) {
            const end = compassToRadians(leftEndUnder(x[i], z[i], section.row(row), points));
            key = Math.min(keyHigh, Math.max(keyLow, end));
          }
          gapKey[4 * point + k] = sign * Math.max(left, key);
        }
        gapKey[4 * point + 3] = sign * right;
      }
    }
    this.#touch("gapSky");
    this.#touch("gapKey");
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }

  /** x, y, z of its points, metres. */
  get positions(): Float32Array {
    return this.#positions;
  }

  #touch(name: string): void {
    this.mesh.geometry.getAttribute(name).needsUpdate = true;
  }

  #allot(pile: PileShape): void {
    if (pile.columns === this.#columns) return;
    this.#columns = pile.columns;
    const count = pile.columns * this.#rows;
    this.#positions = new Float32Array(3 * count);
    this.#normals = new Float32Array(3 * count);
    this.#gapSky = new Float32Array(2 * count);
    this.#gapKey = new Float32Array(4 * count);
    this.#gaps = new Float32Array(2 * pile.columns);
    this.mesh.geometry.dispose();
    const geometry = sheetGeometry(pile.columns, this.#rows);
    for (const [name, array, size] of [
      ["position", this.#positions, 3],
      ["normal", this.#normals, 3],
      ["gapSky", this.#gapSky, 2],
      ["gapKey", this.#gapKey, 4],
    ] as const) {
      geometry.setAttribute(name, new BufferAttribute(array, size).setUsage(DynamicDrawUsage));
    }
    this.mesh.geometry = geometry;
  }
}

/**
 * Returns the triangles and texture coordinates of a sheet whose points run row
 * by row from the foot.
 *
 * @param place u of each column
 */
export function sheetGeometry(
  columns: number,
  rows: number,
  place: typeof columnPlace = columnPlace,
): BufferGeometry {
  const uv = new Float32Array(2 * columns * rows);
  const index = vertexNumbers(columns * rows, 6 * (columns - 1) * (rows - 1));
  for (let row = 0, at = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const here = row * columns + column;
      uv[2 * here] = place(column, columns);
      // Pictures begin at the head.
      uv[2 * here + 1] = 1 - row / (rows - 1);
      if (row + 1 === rows || column + 1 === columns) continue;
      const above = here + columns;
      index.set([here, here + 1, above + 1, here, above + 1, above], at);
      at += 6;
    }
  }
  return geometryOf(uv, index);
}

/** Returns triangles of vertices that have such texture coordinates. */
export function geometryOf(uv: Float32Array, index: VertexNumbers): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("uv", new BufferAttribute(uv, 2));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}
