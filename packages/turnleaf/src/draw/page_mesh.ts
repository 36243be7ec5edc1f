/** The uppermost resting page of one side: its pile's top curve swept along the spine. */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from "three";
import { compassToRadians, gapsOfRow, leftEndUnder } from "./light.ts";
import type { LeafSection } from "./leaf_section.ts";
import type { PaperMaterial } from "./paper.ts";
import { obstacleStride, type PileShape } from "./pile_shape.ts";
import { columnPlace } from "./pose.ts";

/** What stands over a page: the leaf's sections for sky and key, and the tip of a board. */
export interface Overhead {
  readonly sky: LeafSection;
  readonly key: LeafSection;
  /** x, z of points of the board, mirrored for the left; empty where it lies flat. */
  readonly board: Float32Array;
}

/** A resting page. */
export class PageMesh {
  readonly mesh: Mesh<BufferGeometry, PaperMaterial>;
  readonly #rows: number;
  readonly #height: number;
  readonly #width: number;
  #columns = 0;
  #positions = new Float32Array(0);
  #normals = new Float32Array(0);
  #gapSky = new Float32Array(0);
  #gapKey = new Float32Array(0);
  /** The gap of each column as the piles alone leave it, compass numbers. */
  #gaps = new Float32Array(0);

  constructor(material: PaperMaterial, width: number, height: number, rows: number) {
    this.#rows = rows;
    this.#width = width;
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
   * Finds the light on the page.
   *
   * @param opposite points of the pile across the gutter, as seen from this side on the right
   * @param over null where nothing is in the air
   */
  light(pile: PileShape, opposite: Float32Array, over: Overhead | null): void {
    const { x, z, nx, nz, columns, sign } = pile;
    gapsOfRow(x, z, nx, nz, columns, obstacleStride, opposite, this.#gaps);
    for (let row = 0; row < this.#rows; row++) {
      for (let i = 0; i < columns; i++) {
        const left = this.#gaps[2 * i];
        const right = this.#gaps[2 * i + 1];
        let sky = left;
        let key = left;
        if (over) {
          const board = leftEndUnder(x[i], z[i], over.board, over.board.length);
          sky = Math.max(
            left,
            board,
            leftEndUnder(x[i], z[i], over.sky.row(row), over.sky.counts[row]),
          );
          key = Math.max(
            left,
            board,
            leftEndUnder(x[i], z[i], over.key.row(row), over.key.counts[row]),
          );
        }
        const at = 2 * (row * columns + i);
        writeGap(this.#gapSky, at, sky, right, sign);
        writeGap(this.#gapKey, at, key, right, sign);
      }
    }
    this.#touch("gapSky");
    this.#touch("gapKey");
  }

  dispose(): void {
    this.mesh.geometry.dispose();
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
    this.#gapKey = new Float32Array(2 * count);
    this.#gaps = new Float32Array(2 * pile.columns);
    this.mesh.geometry.dispose();
    const geometry = sheetGeometry(pile.columns, this.#rows);
    for (const [name, array, size] of [
      ["position", this.#positions, 3],
      ["normal", this.#normals, 3],
      ["gapSky", this.#gapSky, 2],
      ["gapKey", this.#gapKey, 2],
    ] as const) {
      geometry.setAttribute(name, new BufferAttribute(array, size).setUsage(DynamicDrawUsage));
    }
    this.mesh.geometry = geometry;
  }
}

/** Writes a gap told for the right side as angles in book space. */
export function writeGap(
  out: Float32Array,
  at: number,
  left: number,
  right: number,
  sign: 1 | -1,
): void {
  const a = compassToRadians(left);
  const b = compassToRadians(right);
  out[at] = sign === 1 ? a : -b;
  out[at + 1] = sign === 1 ? b : -a;
}

/** Triangles and texture places of a sheet whose points run row by row from the foot. */
export function sheetGeometry(columns: number, rows: number): BufferGeometry {
  const uv = new Float32Array(2 * columns * rows);
  const index = new Uint16Array(6 * (columns - 1) * (rows - 1));
  for (let row = 0, at = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const here = row * columns + column;
      uv[2 * here] = columnPlace(column, columns);
      // Pictures begin at the head.
      uv[2 * here + 1] = 1 - row / (rows - 1);
      if (row + 1 === rows || column + 1 === columns) continue;
      const above = here + columns;
      index.set([here, here + 1, above + 1, here, above + 1, above], at);
      at += 6;
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("uv", new BufferAttribute(uv, 2));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}
