/** A loose leaf in three.js: the leaf, the pages under it, their shadow on the table. */

import { PerspectiveCamera, Scene, SRGBColorSpace, type Texture, WebGLRenderer } from "three";
import { leafPapers } from "../engine/leaf_papers.ts";
import { columnPlace, type Ray, type Surface } from "../engine/shapes.ts";
import type { PagePicture } from "../sources/page_source.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { LeafSide, PageFace } from "../stage/book_stage.ts";
import { lookOf } from "../themes.ts";
import { axesOf, fieldOfView, fitPoints, widestLens } from "./camera.ts";
import { restingCase } from "./case_shape.ts";
import { ContextWatch, openContext } from "./context.ts";
import { cutOff, straightened } from "./creased_vertices.ts";
import { dropFromCard } from "./drop_from_gpu.ts";
import { shadowOfLeaves } from "./footprint.ts";
import { BookGrains } from "./grains.ts";
import { Ground } from "./ground.ts";
import { LeafMesh } from "./leaf_mesh.ts";
import { BookMaterials } from "./materials.ts";
import { castOver, overheadOf } from "./overhead.ts";
import { type Overhead, PageMesh, pageRows } from "./page_mesh.ts";
import { obstacleStride, PileShape } from "./pile_shape.ts";
import { PictureTextures } from "./textures.ts";

/** Degrees above the table: lower than for a book, so that a leaf's bend is visible. */
const elevation = 50;

/** Fraction of the canvas that stays free at each edge. */
const margin = 0.05;

/** Depth of the pages under the resting leaf, metres: less than is visible. */
const gap = 0.0002;

/** Columns of a resting page's mesh. */
const pageColumns = 49;

/** A page on the table, and the part of the leaf over it. */
interface RestingPage {
  readonly pile: PileShape;
  readonly page: PageMesh;
  readonly over: Overhead;
}

/** A leaf, its pages and its camera on one canvas. */
export class LeafScene {
  readonly scene: Scene = new Scene();
  readonly #shape: BookShape;
  readonly #renderer: WebGLRenderer;
  readonly #context: ContextWatch;
  readonly #camera = new PerspectiveCamera(fieldOfView(widestLens), 1, 0.05, 10);
  readonly #textures: PictureTextures;
  readonly #grains: BookGrains;
  readonly #materials: BookMaterials;
  readonly #leaf: LeafMesh;
  readonly #ground: Ground;
  readonly #left: RestingPage;
  readonly #right: RestingPage;
  #pictures: Readonly<Record<LeafSide, PagePicture | null>> = { recto: null, verso: null };
  #version = 0;

  /** @throws Error if the browser has no WebGL 2 */
  constructor(
    canvas: HTMLCanvasElement,
    { width, height }: { width: number; height: number },
    onRestored?: () => void,
  ) {
    const context = openContext(canvas);
    if (!context) throw new Error("This browser has no WebGL 2, so nothing can be drawn.");
    this.#renderer = new WebGLRenderer({ canvas, context, alpha: true, antialias: true });
    this.#renderer.outputColorSpace = SRGBColorSpace;
    this.#renderer.setClearColor(0, 0);
    this.#context = new ContextWatch(canvas, {
      lost: () => {
        dropFromCard(this.scene);
        this.#textures.drop();
      },
      restored: () => onRestored?.(),
      lostForGood: () => undefined,
    });
    this.#shape = {
      width,
      height,
      thickness: 0,
      leaves: 3,
      cover: "none",
      rim: 0,
      quarterTurned: false,
      alone: 0,
      cloth: "#6a2a26",
      shadows: 1,
      fromAbove: false,
      tilt: 0,
      margin: 0.03,
      kind: "typeset",
    };
    this.#textures = new PictureTextures(this.#renderer, lookOf({}).paper);
    const { paper, anisotropy } = this.#textures;
    this.#grains = new BookGrains(anisotropy);
    this.#materials = new BookMaterials(this.#shape, paper, this.#grains);
    this.#ground = new Ground(-3 * gap, 12 * Math.max(width, height), this.#materials.pixel);
    this.#left = restingPage(-1, this.#shape, this.#materials);
    this.#right = restingPage(1, this.#shape, this.#materials);
    const { recto, verso } = this.#materials.leaf(0);
    const even = (column: number, columns: number) => column / (columns - 1);
    this.#leaf = new LeafMesh(recto, verso, this.#materials.leafEdges, even);
    this.#leaf.recto.visible = this.#leaf.verso.visible = true;
    this.scene.add(this.#ground.mesh, this.#left.page.mesh, this.#right.page.mesh);
    this.scene.add(this.#leaf.recto, this.#leaf.verso);
    this.#camera.matrixAutoUpdate = false;
  }

  resize(width: number, height: number, ratio: number): void {
    this.#renderer.setDrawingBufferSize(width, height, ratio);
    const { width: w, height: h } = this.#shape;
    const points: number[] = [];
    for (let k = 0; k <= 12; k++) {
      const angle = (k * Math.PI) / 12;
      for (const y of [0, h]) points.push(w * Math.cos(angle), y, 0.9 * w * Math.sin(angle));
    }
    const camera = this.#camera;
    const { right, up, back } = axesOf((elevation * Math.PI) / 180, 0);
    const [across, along, distance] = fitPoints(
      [{ points, margin }],
      { right, up, back },
      width / height,
      widestLens,
    );
    const place = [0, 1, 2].map((k) => across * right[k] + along * up[k] + distance * back[k]);
    camera.matrix.fromArray([...right, 0, ...up, 0, ...back, 0, ...place, 1]);
    camera.matrixWorldNeedsUpdate = true;
    camera.updateMatrixWorld(true);
    this.#materials.pixel.value = (2 * widestLens * distance) / height;
    camera.aspect = width / height;
    camera.near = Math.max(0.02, distance - 2 * Math.max(w, h));
    camera.far = distance + 4 * Math.max(w, h);
    camera.updateProjectionMatrix();
  }

  print(pictures: Readonly<Record<LeafSide | PageFace, PagePicture | null>>): void {
    for (const face of ["left", "right"] as const) {
      const picture = pictures[face];
      this.#materials.show(face, this.#textures.of(picture), picture === null);
    }
    this.#pictures = pictures;
    this.cover(null);
  }

  cover(textures: Readonly<Record<LeafSide, Texture>> | null): void {
    for (const side of ["recto", "verso"] as const) {
      const texture = textures?.[side] ?? this.#textures.of(this.#pictures[side]);
      this.#materials.showLeaf(0, side, texture);
    }
  }

  show(leaf: Omit<Surface, "version">): void {
    const surface: Surface = { ...leaf, version: ++this.#version, papers: leafPapers };
    const stride = strideOf(leaf.columns);
    const [left, right] = [this.#left, this.#right];
    this.#leaf.shape(surface, 1, 1);
    this.#leaf.light(straightened(surface), left.pile, right.pile, undefined, undefined);
    const shading = cutOff(surface);
    for (const { over, pile, page } of [left, right]) {
      castOver(over, pile, shading, stride);
      page.light(pile, over);
    }
    shadowOfLeaves(this.#ground, this.#shape, [surface], left.pile, right.pile);
  }

  draw(): void {
    if (!this.#context.isLost) this.#renderer.render(this.scene, this.#camera);
  }

  /** Returns the line of sight through a place, -1 to 1 across to the right and up. */
  rayAt(right: number, up: number): Ray {
    const { elements: m } = this.#camera.matrixWorld;
    const { elements: p } = this.#camera.projectionMatrix;
    const [x, y] = [right / p[0], up / p[5]];
    const way = [0, 1, 2].map((k) => x * m[k] + y * m[4 + k] - m[8 + k]);
    return { origin: [m[12], m[13], m[14]], direction: [way[0], way[1], way[2]] };
  }

  destroy(): void {
    this.#context.destroy();
    if (!this.#context.isLost) this.#renderer.forceContextLoss();
    this.#leaf.dispose();
    this.#left.page.dispose();
    this.#right.page.dispose();
    this.#ground.dispose();
    this.#materials.dispose();
    this.#grains.dispose();
    this.#textures.dispose();
    this.scene.clear();
    this.#renderer.dispose();
  }
}

/** Returns a page at rest, flat on the table. */
function restingPage(
  sign: 1 | -1,
  { width, height }: BookShape,
  materials: BookMaterials,
): RestingPage {
  const pile = new PileShape(sign);
  const curves = new Float32Array(2 * pageColumns);
  for (let k = 0; k < pageColumns; k++) {
    curves.set([sign * width * columnPlace(k, pageColumns), -gap], 2 * k);
  }
  pile.update({ columns: pageColumns, layers: 1, curves }, restingCase(), false);
  const page = new PageMesh(materials.pages[sign === 1 ? "right" : "left"], height, pageRows);
  page.shape(pile);
  page.open(pile, new Float32Array(0));
  return { pile, page, over: overheadOf(height, new Float32Array(0)) };
}

/** Returns the widest step over columns that ends at the last one. */
function strideOf(columns: number): number {
  for (let stride = obstacleStride; stride > 1; stride--) {
    if ((columns - 1) % stride === 0) return stride;
  }
  return 1;
}
