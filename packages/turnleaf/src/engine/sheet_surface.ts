/** What is drawn of a sheet that the engine keeps beside its books' leaves in flight. */

import { leafPapers } from "./leaf_papers.ts";
import type { CreasedMesh, Surface } from "./shapes.ts";
import { visibleThickness } from "./wasm_book.ts";

/** Points along a row and along the spine. */
export interface SurfaceGrid {
  readonly columns: number;
  readonly rows: number;
}

/** The surface of one sheet, kept while it does not change. */
export class SheetSurface {
  readonly #memory: WebAssembly.Memory;
  readonly #grid: SurfaceGrid;
  readonly #creased: CreasedMesh | undefined;
  #surface: Surface | null = null;

  constructor(memory: WebAssembly.Memory, grid: SurfaceGrid, creased?: CreasedMesh) {
    this.#memory = memory;
    this.#grid = grid;
    this.#creased = creased;
  }

  /**
   * Returns the surface; valid until the next step.
   *
   * @param positions,normals their addresses
   * @param caliper thickness of the paper, metres
   * @param loose how far it is torn across, metres, if it is, and its place among loose sheets
   */
  at(
    positions: number,
    normals: number,
    version: number,
    caliper: number,
    { opened, layer }: Pick<Surface, "opened" | "layer"> = {},
  ): Surface {
    const { buffer } = this.#memory;
    const known = this.#surface;
    const isSame = known?.version === version && known.layer === layer;
    if (known?.positions.buffer === buffer && isSame) return known;
    const { columns, rows } = this.#grid;
    const view = (at: number) => new Float32Array(buffer, at, 3 * columns * rows);
    this.#surface = {
      columns,
      rows,
      positions: view(positions),
      normals: view(normals),
      version,
      thickness: caliper < visibleThickness ? 0 : caliper,
      creased: this.#creased,
      opened,
      layer,
      papers: leafPapers,
    };
    return this.#surface;
  }
}
