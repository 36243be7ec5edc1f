/** Every material of a book, and the grains that they share. */

import { Color, type Material, type Texture } from "three";
import type { Face } from "../book/faces.ts";
import { PaperMaterial } from "./paper.ts";
import type { BookShape } from "./pose.ts";
import { type SolidLook, SolidMaterial } from "./solid.ts";
import { clothTexture, headbandTexture, leafEdgeTexture } from "./textures.ts";

/** A face of paper, resting or in flight. */
export type PaperFace = "left" | "right" | "recto" | "verso";

/** A face of a board. */
export type BoardFace = Exclude<Face, PaperFace>;

/** The materials of one book. */
export class BookMaterials {
  readonly paper: Record<PaperFace, PaperMaterial>;
  readonly boards: Record<BoardFace, SolidMaterial>;
  readonly spine: SolidMaterial;
  readonly leafEdges: SolidMaterial;
  /** The folds by the front and by the back board, which carry their pastedown's picture on. */
  readonly endpapers: Record<"frontInside" | "backInside", SolidMaterial>;
  readonly headband: SolidMaterial;
  readonly #materials: Material[] = [];
  readonly #grains: Texture[];

  /** @param blank what a face shows while it has no picture */
  constructor(shape: BookShape, blank: Texture) {
    const { kind, width, height } = shape;
    const sheet = (recto: boolean, thin: boolean): PaperMaterial => {
      const side = { recto, thin, ownNormals: !thin };
      return this.#keep(new PaperMaterial(side, kind, width, height, blank));
    };
    this.paper = {
      left: sheet(false, false),
      right: sheet(true, false),
      recto: sheet(true, true),
      verso: sheet(false, true),
    };
    const [edges, weave, stripes] = [leafEdgeTexture(), clothTexture(), headbandTexture()];
    this.#grains = [edges, weave, stripes];
    const solid = (colour: string, look: Omit<SolidLook, "base">): SolidMaterial =>
      this.#keep(new SolidMaterial({ base: new Color(colour), ...look }));
    const cloth = (): SolidMaterial =>
      solid(shape.cloth, { grain: weave, grainDepth: 1, paperiness: 0 });
    this.boards = {
      frontOutside: cloth(),
      frontInside: cloth(),
      backOutside: cloth(),
      backInside: cloth(),
    };
    this.boards.frontInside.setPicture(blank);
    this.boards.backInside.setPicture(blank);
    this.spine = cloth();
    this.leafEdges = solid("#efe4cf", {
      grain: edges,
      grainDepth: 1,
      paperiness: 0.35,
      twoSided: true,
    });
    const fold = (): SolidMaterial =>
      solid("#fbf5e8", { grain: weave, grainDepth: 0, paperiness: 1, twoSided: true });
    this.endpapers = { frontInside: fold(), backInside: fold() };
    this.endpapers.frontInside.setPicture(blank);
    this.endpapers.backInside.setPicture(blank);
    this.headband = solid("#b9a37e", {
      grain: stripes,
      grainDepth: 1,
      paperiness: 0,
      twoSided: true,
    });
  }

  /** Shows a picture on a face; `blank` stands for none, outside the boards null does. */
  show(face: Face, texture: Texture, none: boolean): void {
    if (face === "frontOutside" || face === "backOutside") {
      this.boards[face].setPicture(none ? null : texture);
    } else if (face === "frontInside" || face === "backInside") {
      this.boards[face].setPicture(texture);
      this.endpapers[face].setPicture(texture);
    } else {
      this.paper[face].picture = texture;
      if (face === "recto") this.paper.verso.pictureBehind = texture;
      if (face === "verso") this.paper.recto.pictureBehind = texture;
    }
  }

  dispose(): void {
    for (const material of this.#materials) material.dispose();
    for (const grain of this.#grains) grain.dispose();
  }

  #keep<M extends Material>(material: M): M {
    this.#materials.push(material);
    return material;
  }
}
