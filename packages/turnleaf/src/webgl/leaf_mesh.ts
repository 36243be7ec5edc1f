/** A leaf in flight: two sides over the engine's own memory. */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from "three";
import { columnPlace, type Paper, type PaperMesh, type Surface } from "../engine/shapes.ts";
import { CreasedVertices } from "./creased_vertices.ts";
import { LeafLight } from "./leaf_light.ts";
import { geometryOf, sheetGeometry } from "./page_mesh.ts";
import type { PaperMaterial } from "./paper_material.ts";
import type { PileShape } from "./pile_shape.ts";
import { RimMesh } from "./rim_mesh.ts";
import type { SolidMaterial } from "./solid_material.ts";

/** A leaf in flight. */
export class LeafMesh {
  readonly recto: Mesh<BufferGeometry, PaperMaterial>;
  readonly verso: Mesh<BufferGeometry, PaperMaterial>;
  readonly rim: RimMesh;
  #columns = 0;
  #rows = 0;
  #mesh: PaperMesh | undefined;
  #creased: CreasedVertices | undefined;
  /** Its own flaps, on its recto and its verso, and what else lies on it. */
  #flaps: readonly [recto: readonly Paper[], verso: readonly Paper[]] = [[], []];
  #over: readonly Paper[] = [];
  #position = new BufferAttribute(new Float32Array(0), 3);
  #normal = new BufferAttribute(new Float32Array(0), 3);
  #rectoGap = new BufferAttribute(new Float32Array(0), 2);
  #versoGap = new BufferAttribute(new Float32Array(0), 2);
  #light = new LeafLight(2, 2);

  readonly #place: typeof columnPlace;

  /** @param place u of each of the leaf's columns */
  constructor(
    recto: PaperMaterial,
    verso: PaperMaterial,
    edges: SolidMaterial,
    place: typeof columnPlace = columnPlace,
  ) {
    this.#place = place;
    this.rim = new RimMesh(edges);
    this.recto = new Mesh(new BufferGeometry(), recto);
    this.verso = new Mesh(new BufferGeometry(), verso);
    for (const mesh of [this.recto, this.verso]) {
      mesh.frustumCulled = false;
      mesh.visible = false;
    }
    this.rim.mesh.visible = false;
  }

  /**
   * Shows a leaf; the positions and normals stay where the engine keeps them.
   *
   * @param left,right the number of sheets under it on either side, itself
   * included
   */
  shape(leaf: Surface, left: number, right: number): void {
    const { columns, rows, creased } = leaf;
    if (columns !== this.#columns || rows !== this.#rows || creased !== this.#mesh) {
      this.#allot(leaf);
    }
    // The engine's memory moves when it grows; the arrays' size stays.
    this.#creased?.shape(leaf);
    const { positions, normals } = this.#creased ?? leaf;
    this.#position.array = positions;
    this.#normal.array = normals;
    this.#position.needsUpdate = true;
    this.#normal.needsUpdate = true;
    this.recto.material.lieOver(left, right);
    this.verso.material.lieOver(left, right);
    this.recto.material.thickness = this.verso.material.thickness = leaf.thickness ?? 0;
    for (const { material } of [this.recto, this.verso]) material.opened = leaf.opened ?? null;
    const { papers } = leaf;
    this.#flaps = [papers?.flapsOn(leaf, 1) ?? [], papers?.flapsOn(leaf, -1) ?? []];
    this.#lay();
    this.rim.shape(leaf);
  }

  /** Shades it by paper that lies on it, or close over it, beside its own flaps. */
  shadeBy(over: readonly Paper[]): void {
    if (over.length === 0 && this.#over.length === 0) return;
    this.#over = over;
    this.#lay();
  }

  /**
   * Computes the light on both sides of the leaf.
   *
   * @param before,after the next leaves in flight to the left and to the right
   */
  light(
    leaf: Surface,
    left: PileShape,
    right: PileShape,
    before: Surface | undefined,
    after: Surface | undefined,
  ): void {
    // The recto looks over the left pile; the verso, mirrored, over the right.
    for (const [gap, sign, pile, next] of [
      [this.#rectoGap, 1, left.obstacles, before],
      [this.#versoGap, -1, right.mirrored, after],
    ] as const) {
      const gaps = gap.array as Float32Array;
      this.#light.write(leaf, sign, pile, next, gaps);
      this.#creased?.repeat(gaps, 2);
      this.#creased?.lightFlaps(sign, gaps);
      gap.needsUpdate = true;
    }
  }

  /**
   * Lights it as lying on the pages: the recto sees all of the sky, the verso,
   * which bends up a little, less.
   */
  lieOpen(): void {
    this.#open(0.6);
  }

  /** Lights it as a loose sheet, either side of which may see all of the sky. */
  lieLoose(): void {
    this.#open(Math.PI / 2);
    // A facet of a crumpled one sees it as far as it faces it.
    this.#creased?.lightFlaps(1, this.#rectoGap.array as Float32Array);
    this.#creased?.lightFlaps(-1, this.#versoGap.array as Float32Array);
  }

  /** @param verso right end of the gap of the verso, radians */
  #open(verso: number): void {
    for (const [gap, right] of [
      [this.#rectoGap, Math.PI / 2],
      [this.#versoGap, verso],
    ] as const) {
      for (let k = 0; k < gap.array.length; k++) gap.array[k] = k % 2 ? right : -Math.PI / 2;
      gap.needsUpdate = true;
    }
  }

  dispose(): void {
    this.recto.geometry.dispose();
    this.verso.geometry.dispose();
    this.rim.dispose();
  }

  #lay(): void {
    const [recto, verso] = this.#flaps;
    this.recto.material.lay([...recto, ...this.#over]);
    this.verso.material.lay([...verso, ...this.#over]);
  }

  #allot(leaf: Surface): void {
    const { columns, rows } = leaf;
    this.#columns = columns;
    this.#rows = rows;
    this.#mesh = leaf.creased;
    this.#creased = leaf.creased && new CreasedVertices(leaf.creased);
    this.#light = new LeafLight(columns, rows);
    const dynamic = (array: Float32Array, size: number): BufferAttribute =>
      new BufferAttribute(array, size).setUsage(DynamicDrawUsage);
    const { positions, normals } = this.#creased ?? leaf;
    this.#position = dynamic(positions, 3);
    this.#normal = dynamic(normals, 3);
    this.#rectoGap = dynamic(new Float32Array((2 / 3) * positions.length), 2);
    this.#versoGap = dynamic(new Float32Array((2 / 3) * positions.length), 2);
    const grid = this.#creased
      ? geometryOf(this.#creased.uv, this.#creased.index)
      : sheetGeometry(columns, rows, this.#place);
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
      const tears = this.#creased?.tears;
      if (tears) geometry.setAttribute("tear", new BufferAttribute(tears, 3));
      const parts = this.#creased?.parts;
      if (parts) geometry.setAttribute("part", new BufferAttribute(parts, 1));
      mesh.geometry = geometry;
    }
  }
}
