/** What is drawn of a leaf of the engine, as the viewer has it. */

import type { DrawnRecord } from "../drawn_record.ts";
import type { LeafPapers, Surface } from "./shapes.ts";

/** Thickness from which a leaf's edges are visible, metres: card's, not paper's. */
const visibleThickness = 0.0002;

/** What is drawn of one leaf, kept while it does not change. */
export class DrawnSurface {
  readonly #papers: LeafPapers | undefined;
  #surface: Surface | null = null;
  /** What tells its mesh from that before: a leaf may be given another's place in memory. */
  #mesh: readonly [topology: number, triangles: number] = [0, 0];

  /** @param papers finds what of it may lie on other paper; missing where nothing does */
  constructor(papers?: LeafPapers) {
    this.#papers = papers;
  }

  /**
   * Returns the surface; valid until the leaf is next stepped.
   *
   * @param record as the engine has it now
   * @param loose of a loose sheet how far it is torn across, metres, if it is, and its place among
   * loose sheets
   */
  at(record: DrawnRecord, { opened, layer }: Pick<Surface, "opened" | "layer"> = {}): Surface {
    const { columns, rows, version, topology, triangles, caliper } = record;
    const thickness = caliper < visibleThickness ? 0 : caliper;
    const known = this.#surface;
    const isSameMesh = known !== null && topology === this.#mesh[0] && triangles === this.#mesh[1];
    const isKnown = isSameMesh && known.version === version && known.thickness === thickness;
    if (isKnown && known.layer === layer && known.positions.buffer === record.buffer) {
      return known;
    }
    const creased = isSameMesh ? known.creased : record.mesh();
    this.#mesh = [topology, triangles];
    this.#surface = {
      columns,
      rows,
      positions: record.positions,
      normals: record.normals,
      version,
      thickness,
      creased,
      opened: creased?.tears && opened,
      layer,
      papers: this.#papers,
    };
    return this.#surface;
  }
}
