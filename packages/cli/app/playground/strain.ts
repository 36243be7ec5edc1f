/** The strain of a leaf's cells, as colours on its paper. */

import { DataTexture, LinearFilter, SRGBColorSpace } from "three";
import type { LeafSurface, PaperMesh } from "turnleaf/models";
import { leafSize } from "./variants.ts";

/** What is read of a drawn leaf. */
type DrawnGrid = Pick<LeafSurface, "columns" | "rows" | "positions" | "creased">;

/** The strain that has the full colour: two per cent. */
export const fullStrain = 0.02;

const paper = [251, 245, 232] as const;
const stretched = [178, 40, 28] as const;
const pressed = [32, 82, 160] as const;

/** Returns the strain of each cell of a grid: that of its four edges with the largest magnitude. */
function strainOfCells({ columns, rows, positions, creased }: DrawnGrid): Float32Array {
  const [across, up] = [leafSize.width / (columns - 1), leafSize.height / (rows - 1)];
  // The points of a creased leaf are moved on the flat paper.
  const apart = ({ places }: PaperMesh, a: number, b: number): number =>
    Math.hypot(
      leafSize.width * (places[2 * b] - places[2 * a]),
      leafSize.height * (places[2 * b + 1] - places[2 * a + 1]),
    );
  const strain = (a: number, b: number, rest: number): number => {
    const [x, y, z] = [0, 1, 2].map((axis) => positions[3 * b + axis] - positions[3 * a + axis]);
    return Math.hypot(x, y, z) / (creased ? apart(creased, a, b) : rest) - 1;
  };
  const cells = new Float32Array((columns - 1) * (rows - 1));
  for (let row = 0, cell = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++, cell++) {
      const here = row * columns + column;
      const edges = [
        strain(here, here + 1, across),
        strain(here + columns, here + columns + 1, across),
        strain(here, here + columns, up),
        strain(here + 1, here + columns + 1, up),
      ];
      cells[cell] = edges.reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a));
    }
  }
  return cells;
}

/** The two sides of a leaf, coloured: red where stretched, blue where pressed together. */
export class StrainColours {
  recto: DataTexture = texture(1, 1);
  verso: DataTexture = texture(1, 1);
  #columns = 0;
  #rows = 0;

  /** Colours a leaf. Returns whether the textures have changed. */
  paint(grid: DrawnGrid): boolean {
    const isNew = grid.columns - 1 !== this.#columns || grid.rows - 1 !== this.#rows;
    if (isNew) {
      this.dispose();
      [this.#columns, this.#rows] = [grid.columns - 1, grid.rows - 1];
      this.recto = texture(this.#columns, this.#rows);
      this.verso = texture(this.#columns, this.#rows);
    }
    const cells = strainOfCells(grid);
    const [recto, verso] = [this.recto, this.verso].map(({ image }) => image.data as Uint8Array);
    for (let row = 0, cell = 0; row < this.#rows; row++) {
      // Pictures begin at the head.
      const line = (this.#rows - 1 - row) * this.#columns;
      for (let column = 0; column < this.#columns; column++, cell++) {
        const fraction = Math.min(1, Math.abs(cells[cell]) / fullStrain);
        const full = cells[cell] > 0 ? stretched : pressed;
        const colour = paper.map((from, k) => Math.round(from + (full[k] - from) * fraction));
        recto.set(colour, 4 * (line + column));
        verso.set(colour, 4 * (line + this.#columns - 1 - column));
      }
    }
    this.recto.needsUpdate = this.verso.needsUpdate = true;
    return isNew;
  }

  dispose(): void {
    this.recto.dispose();
    this.verso.dispose();
  }
}

function texture(columns: number, rows: number): DataTexture {
  const made = new DataTexture(new Uint8Array(4 * columns * rows).fill(255), columns, rows);
  made.colorSpace = SRGBColorSpace;
  made.minFilter = made.magFilter = LinearFilter;
  return made;
}
