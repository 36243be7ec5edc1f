/** The leaf in flight: two sides over the engine's own memory. */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from "three";
import type { Surface } from "../engine/shapes.ts";
import { gapsOfRow } from "./light.ts";
import { sheetGeometry, writeGap } from "./page_mesh.ts";
import type { PaperMaterial } from "./paper.ts";
import { obstacleStride, type PileShape } from "./pile_shape.ts";

/** The leaf in flight. */
export class LeafMesh {
  readonly recto: Mesh<BufferGeometry, PaperMaterial>;
  readonly verso: Mesh<BufferGeometry, PaperMaterial>;
  #columns = 0;
  #rows = 0;
  #position = new BufferAttribute(new Float32Array(0), 3);
  #normal = new BufferAttribute(new Float32Array(0), 3);
  #rectoGap = new BufferAttribute(new Float32Array(0), 2);
  #versoGap = new BufferAttribute(new Float32Array(0), 2);
  /** One row seen as if it lay on the right: x, z, normal's x and z, and its gaps. */
  #x = new Float32Array(0);
  #z = new Float32Array(0);
  #nx = new Float32Array(0);
  #nz = new Float32Array(0);
  #gaps = new Float32Array(0);

  constructor(recto: PaperMaterial, verso: PaperMaterial) {
    this.recto = new Mesh(new BufferGeometry(), recto);
    this.verso = new Mesh(new BufferGeometry(), verso);
    for (const mesh of [this.recto, this.verso]) {
      mesh.frustumCulled = false;
      mesh.visible = false;
    }
  }

  /** Shows the leaf; the positions and normals stay where the engine keeps them. */
  shape(leaf: Surface): void {
    if (leaf.columns !== this.#columns || leaf.rows !== this.#rows) this.#allot(leaf);
    // The engine's memory moves when it grows; the arrays' size stays.
    this.#position.array = leaf.positions;
    this.#normal.array = leaf.normals;
    this.#position.needsUpdate = true;
    this.#normal.needsUpdate = true;
  }

  /** Finds the light on both sides of the leaf. */
  light(leaf: Surface, left: PileShape, right: PileShape): void {
    // The recto looks over the left pile; the verso, mirrored, over the right.
    this.#lightSide(leaf, 1, left.obstacles, this.#rectoGap);
    this.#lightSide(leaf, -1, right.mirrored, this.#versoGap);
  }

  dispose(): void {
    this.recto.geometry.dispose();
    this.verso.geometry.dispose();
  }

  #lightSide(leaf: Surface, sign: 1 | -1, opposite: Float32Array, gap: BufferAttribute): void {
    const { positions, normals, columns, rows } = leaf;
    const out = gap.array as Float32Array;
    for (let row = 0; row < rows; row++) {
      for (let i = 0; i < columns; i++) {
        const at = 3 * (row * columns + i);
        this.#x[i] = sign * positions[at];
        this.#z[i] = positions[at + 2];
        // The verso's normal is the recto's turned round, then mirrored.
        this.#nx[i] = normals[at];
        this.#nz[i] = sign * normals[at + 2];
      }
      gapsOfRow(
        this.#x,
        this.#z,
        this.#nx,
        this.#nz,
        columns,
        obstacleStride,
        opposite,
        this.#gaps,
      );
      for (let i = 0; i < columns; i++) {
        const at = 2 * (row * columns + i);
        writeGap(out, at, this.#gaps[2 * i], this.#gaps[2 * i + 1], sign);
      }
    }
    gap.needsUpdate = true;
  }

  #allot(leaf: Surface): void {
    const { columns, rows } = leaf;
    this.#columns = columns;
    this.#rows = rows;
    this.#x = new Float32Array(columns);
    this.#z = new Float32Array(columns);
    this.#nx = new Float32Array(columns);
    this.#nz = new Float32Array(columns);
    this.#gaps = new Float32Array(2 * columns);
    const dynamic = (array: Float32Array, size: number): BufferAttribute =>
      new BufferAttribute(array, size).setUsage(DynamicDrawUsage);
    this.#position = dynamic(leaf.positions, 3);
    this.#normal = dynamic(leaf.normals, 3);
    this.#rectoGap = dynamic(new Float32Array(2 * columns * rows), 2);
    this.#versoGap = dynamic(new Float32Array(2 * columns * rows), 2);
    const grid = sheetGeometry(columns, rows);
    for (const [mesh, near, far] of [
      [this.recto, this.#rectoGap, this.#versoGap],
      [this.verso, this.#versoGap, this.#rectoGap],
    ] as const) {
      mesh.geometry.dispose();
      const geometry = new BufferGeometry();
      geometry.setIndex(grid.getIndex());
      geometry.setAttribute("uv", grid.getAttribute("uv"));
      geometry.setAttribute("position", this.#position);
      geometry.setAttribute("normal", this.#normal);
      geometry.setAttribute("gapSky", near);
      geometry.setAttribute("gapKey", near);
      geometry.setAttribute("gapBehind", far);
      mesh.geometry = geometry;
    }
  }
}
