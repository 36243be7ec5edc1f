/** Every material of a book. */

import { Color, type Material, type Texture } from "three";
import type { Face } from "../book/faces.ts";
import type { PageBox } from "../sources/page_source.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { LeafSide, PageFace } from "../stage/book_stage.ts";
import { stapleColour } from "../stage/staples.ts";
import { lookOf } from "../themes.ts";
import type { BookGrains } from "./grains.ts";
import { layDetail } from "./ink.ts";
import { PaperMaterial } from "./paper_material.ts";
import { type SolidLook, SolidMaterial } from "./solid_material.ts";

/** A face of a board. */
export type BoardFace = Exclude<Face, PageFace>;

/** The materials of one book. */
export class BookMaterials {
  readonly pages: Record<PageFace, PaperMaterial>;
  readonly boards: Record<BoardFace, SolidMaterial>;
  readonly spine: SolidMaterial;
  readonly leafEdges: SolidMaterial;
  /**
   * The folds by the front and by the back board, which continue the picture of
   * their pastedown.
   */
  readonly endpapers: Record<"frontInside" | "backInside", SolidMaterial>;
  readonly headband: SolidMaterial;
  readonly staples: SolidMaterial;
  /** Size of a CSS pixel on the book, metres. */
  readonly pixel = { value: 0 };
  readonly #materials: Material[] = [];
  readonly #leaves: Record<LeafSide, PaperMaterial>[] = [];
  readonly #loose: Record<LeafSide, PaperMaterial>[] = [];
  readonly #sheet: (recto: boolean, thin: boolean, torn?: boolean) => PaperMaterial;

  /**
   * @param blank what a face shows while it has no picture
   * @param grains outlive the materials
   */
  constructor(shape: BookShape, blank: Texture, grains: BookGrains) {
    this.#sheet = (recto, thin, torn = false) => {
      const side = { recto, thin, torn, ownNormals: !thin };
      return this.#keep(new PaperMaterial(side, shape, blank, this.pixel));
    };
    this.pages = { left: this.#sheet(false, false), right: this.#sheet(true, false) };
    const { paper, edges, cloth: bright } = lookOf(shape);
    const solid = (
      colour: string,
      look: Omit<SolidLook, "base" | "quarterTurned">,
      brightness = 1,
    ): SolidMaterial => {
      const base = new Color(colour).multiplyScalar(brightness);
      return this.#keep(new SolidMaterial({ base, quarterTurned: shape.quarterTurned, ...look }));
    };
    const cloth = (): SolidMaterial =>
      solid(shape.cloth, { grain: grains.cloth, grainDepth: 1, paperiness: 0 }, bright);
    this.boards = {
      frontOutside: cloth(),
      frontInside: cloth(),
      backOutside: cloth(),
      backInside: cloth(),
    };
    this.boards.frontInside.setPicture(blank);
    this.boards.backInside.setPicture(blank);
    this.spine = cloth();
    this.leafEdges = solid(edges, {
      grain: grains.leafEdges,
      grainDepth: 1,
      paperiness: 0.35,
      twoSided: true,
    });
    // Seen on edge it is so steep that its depth is known to a pixel only, and would be seen through sheets that
    // lie over its upper end: it lies as far back as that.
    Object.assign(this.leafEdges, { polygonOffset: true, polygonOffsetFactor: 1 });
    const fold = (): SolidMaterial =>
      solid(paper, { grain: grains.cloth, grainDepth: 0, paperiness: 1, twoSided: true });
    this.endpapers = { frontInside: fold(), backInside: fold() };
    this.endpapers.frontInside.setPicture(blank);
    this.endpapers.backInside.setPicture(blank);
    const headband = { grain: grains.headband, grainDepth: 1, paperiness: 0, twoSided: true };
    this.headband = solid("#b9a37e", headband, bright);
    this.staples = solid(stapleColour, { ...headband, grainDepth: 0 }, bright);
  }

  /** Shows a picture on a face; `blank` stands for no picture, and outside the boards null does. */
  show(face: Face, texture: Texture, none: boolean): void {
    if (face === "frontOutside" || face === "backOutside") {
      this.boards[face].setPicture(none ? null : texture);
    } else if (face === "frontInside" || face === "backInside") {
      this.boards[face].setPicture(texture);
      this.endpapers[face].setPicture(texture);
    } else {
      this.pages[face].picture = texture;
    }
  }

  /** Lays a sharper picture over a part of a face's; null for the part removes it. */
  showDetail(face: Face, texture: Texture, box: PageBox | null): void {
    const isPage = face === "left" || face === "right";
    layDetail((isPage ? this.pages[face] : this.boards[face]).uniforms, texture, box);
  }

  /** Returns the materials of a leaf in flight by its index; creates them on first use. */
  leaf(index: number): Record<LeafSide, PaperMaterial> {
    while (this.#leaves.length <= index) {
      this.#leaves.push({ recto: this.#sheet(true, true), verso: this.#sheet(false, true) });
    }
    return this.#leaves[index];
  }

  /** Shows a picture on one side of a leaf in flight, and through it on the other. */
  showLeaf(index: number, side: LeafSide, texture: Texture): void {
    showOn(this.leaf(index), side, texture);
  }

  /** Returns the materials of a loose sheet by its index; creates them on first use. */
  loose(index: number): Record<LeafSide, PaperMaterial> {
    while (this.#loose.length <= index) {
      const [recto, verso] = [this.#sheet(true, true, true), this.#sheet(false, true, true)];
      this.#loose.push({ recto, verso });
    }
    return this.#loose[index];
  }

  /** Shows a picture on one side of a loose sheet, and through it on the other. */
  showLoose(index: number, side: LeafSide, texture: Texture): void {
    showOn(this.loose(index), side, texture);
  }

  /**
   * Returns one material for each program that draws pages under folds and loose sheets, and these
   * themselves. Those of the other materials are compiled once there is something to draw.
   */
  forSheets(): readonly PaperMaterial[] {
    const { recto, verso } = this.loose(0);
    const shaded = [false, true].flatMap((torn) => [
      this.#sheet(true, false, torn),
      this.#sheet(false, false, torn),
    ]);
    for (const material of shaded) material.shade();
    return [recto, verso, ...shaded];
  }

  dispose(): void {
    for (const material of this.#materials) material.dispose();
  }

  #keep<M extends Material>(material: M): M {
    this.#materials.push(material);
    return material;
  }
}

function showOn(sheet: Record<LeafSide, PaperMaterial>, side: LeafSide, texture: Texture): void {
  const { recto, verso } = sheet;
  const [seen, other] = side === "recto" ? [recto, verso] : [verso, recto];
  seen.picture = texture;
  other.pictureBehind = texture;
}
