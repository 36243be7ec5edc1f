/**
 * Draws a book. A stage holds everything that is on the GPU; it knows where
 * the book's parts are from the poses it is told, and draws when it is told to:
 * no timer and no animation frame is ever asked for here.
 */

import {
  Color,
  type Material,
  type Mesh,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  type Texture,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Ray, Vec3 } from "../engine/shapes.ts";
import type { PagePicture } from "../sources/page_source.ts";
import { BlockMesh } from "./block_mesh.ts";
import { BoardMesh } from "./board_mesh.ts";
import { type Framing, fieldOfView, frameBook } from "./camera.ts";
import { caseSizes, placeCase, restingCase } from "./case_shape.ts";
import { EndpaperMesh } from "./endpaper_mesh.ts";
import { Ground } from "./ground.ts";
import { LeafMesh } from "./leaf_mesh.ts";
import { LeafSection } from "./leaf_section.ts";
import { shadowSlopes } from "./light.ts";
import { type Overhead, PageMesh } from "./page_mesh.ts";
import { PaperMaterial } from "./paper.ts";
import { obstacleStride, PileShape } from "./pile_shape.ts";
import { type BookPose, type BookShape, type Face, pageRows } from "./pose.ts";
import { SolidMaterial } from "./solid.ts";
import { HeadbandMesh, SpineMesh } from "./spine_mesh.ts";
import { clothTexture, headbandTexture, leafEdgeTexture, PictureTextures } from "./textures.ts";

/** How a frame is drawn. */
export interface DrawOptions {
  /** Nothing moves: the frame is drawn at twice the CSS resolution at least, for sharp text. */
  readonly resting?: boolean;
}

/** One book on one canvas. */
export class Stage {
  /** Called when the GPU's context came back after a loss and a frame should be drawn again. */
  onRestored: (() => void) | null = null;
  readonly #canvas: HTMLCanvasElement;
  readonly #shape: BookShape;
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera: PerspectiveCamera;
  readonly #pictures: PictureTextures;
  readonly #grains: Texture[];
  readonly #materials: Material[] = [];
  readonly #faces = new Map<Face, PagePicture | null>();
  readonly #paper: Record<"left" | "right" | "recto" | "verso", PaperMaterial>;
  readonly #boardFaces: Record<Exclude<Face, "left" | "right" | "recto" | "verso">, SolidMaterial>;
  readonly #left = new PileShape(-1);
  readonly #right = new PileShape(1);
  readonly #leftPage: PageMesh;
  readonly #rightPage: PageMesh;
  readonly #leftBlock: BlockMesh;
  readonly #rightBlock: BlockMesh;
  readonly #leaf: LeafMesh;
  readonly #front: BoardMesh;
  readonly #back: BoardMesh;
  readonly #spine: SpineMesh;
  readonly #headbands: HeadbandMesh;
  readonly #leftFold: EndpaperMesh;
  readonly #rightFold: EndpaperMesh;
  readonly #ground: Ground;
  readonly #case = restingCase();
  readonly #framing: Framing = {
    closedRight: 0,
    closedLeft: 0,
    middle: 0,
    boardEdges: [],
    room: 1,
  };
  readonly #overLeft: Overhead;
  readonly #overRight: Overhead;
  readonly #boardLeft = new Float32Array(4);
  readonly #boardRight = new Float32Array(4);
  #leafVersion = -1;
  #shadowed = true;
  #boards = Number.NaN;
  #width = 1;
  #height = 1;
  #ratio = 1;

  /**
   * @throws Error in one sentence where the browser has no WebGL 2.
   */
  constructor(canvas: HTMLCanvasElement, shape: BookShape) {
    this.#canvas = canvas;
    this.#shape = shape;
    this.#renderer = openRenderer(canvas);
    this.#pictures = new PictureTextures(this.#renderer);
    this.#camera = new PerspectiveCamera(fieldOfView, 1, 0.05, 10);
    this.#camera.matrixAutoUpdate = false;
    const { width, height, thickness, kind } = shape;

    const sheet = (recto: boolean, thin: boolean): PaperMaterial =>
      this.#keep(
        new PaperMaterial(
          { recto, thin, ownNormals: !thin },
          kind,
          width,
          height,
          this.#pictures.paper,
        ),
      );
    this.#paper = {
      left: sheet(false, false),
      right: sheet(true, false),
      recto: sheet(true, true),
      verso: sheet(false, true),
    };
    const [edges, weave, stripes] = [leafEdgeTexture(), clothTexture(), headbandTexture()];
    this.#grains = [edges, weave, stripes];
    const clothColour = new Color(shape.cloth);
    const cloth = (): SolidMaterial =>
      this.#keep(
        new SolidMaterial({ base: clothColour, grain: weave, grainDepth: 1, paperiness: 0 }),
      );
    this.#boardFaces = {
      frontOutside: cloth(),
      frontInside: cloth(),
      backOutside: cloth(),
      backInside: cloth(),
    };
    const leafEdges = this.#keep(
      new SolidMaterial({
        base: new Color("#efe4cf"),
        grain: edges,
        grainDepth: 1,
        paperiness: 0.35,
        twoSided: true,
      }),
    );
    const bandCloth = this.#keep(
      new SolidMaterial({
        base: new Color("#b9a37e"),
        grain: stripes,
        grainDepth: 1,
        paperiness: 0,
        twoSided: true,
      }),
    );

    this.#leftPage = new PageMesh(this.#paper.left, height, pageRows);
    this.#rightPage = new PageMesh(this.#paper.right, height, pageRows);
    this.#leftBlock = new BlockMesh(leafEdges, -1, height, thickness);
    this.#rightBlock = new BlockMesh(leafEdges, 1, height, thickness);
    this.#leaf = new LeafMesh(this.#paper.recto, this.#paper.verso);
    const faces = this.#boardFaces;
    this.#front = new BoardMesh(true, width, height, faces.frontOutside, faces.frontInside);
    this.#back = new BoardMesh(false, width, height, faces.backOutside, faces.backInside);
    this.#spine = new SpineMesh(cloth(), height, thickness);
    this.#headbands = new HeadbandMesh(bandCloth, height);
    const endpaper = this.#keep(
      new SolidMaterial({
        base: new Color("#fbf5e8"),
        grain: weave,
        grainDepth: 0,
        paperiness: 1,
        twoSided: true,
      }),
    );
    this.#leftFold = new EndpaperMesh(endpaper, -1, height);
    this.#rightFold = new EndpaperMesh(endpaper, 1, height);
    const hard = shape.cover === "hard";
    this.#ground = new Ground(
      hard ? -caseSizes.board - caseSizes.sink : 0,
      12 * Math.max(width, height),
    );
    const section = (): LeafSection => new LeafSection(pageRows, height);
    const overhead = (board: Float32Array): Overhead => ({
      sky: section(),
      keys: shadowSlopes.map(section),
      board,
    });
    this.#overLeft = overhead(this.#boardLeft);
    this.#overRight = overhead(this.#boardRight);

    this.#scene.matrixAutoUpdate = false;
    this.#scene.add(
      this.#ground.mesh,
      this.#leftBlock.mesh,
      this.#rightBlock.mesh,
      this.#leftPage.mesh,
      this.#rightPage.mesh,
      this.#leaf.recto,
      this.#leaf.verso,
    );
    if (hard) {
      this.#scene.add(this.#front.group, this.#back.group, this.#spine.mesh);
      this.#scene.add(this.#leftFold.mesh, this.#rightFold.mesh);
      if (thickness > 0.004) this.#scene.add(this.#headbands.mesh);
    }
    for (const face of ["frontInside", "backInside"] as const) this.setFace(face, null);
    this.#pages(this.#leftPage.mesh, this.#leftBlock.mesh, false);
    this.#pages(this.#rightPage.mesh, this.#rightBlock.mesh, false);
    canvas.addEventListener("webglcontextlost", this.#lost);
    canvas.addEventListener("webglcontextrestored", this.#restored);
  }

  /** The canvas's place is `cssWidth` by `cssHeight` CSS pixels, each `pixelRatio` device pixels. */
  resize(cssWidth: number, cssHeight: number, pixelRatio: number): void {
    this.#width = Math.max(1, cssWidth);
    this.#height = Math.max(1, cssHeight);
    this.#ratio = Math.max(0.25, pixelRatio);
    this.#aim();
  }

  /** How much room is kept above the head: 0 none, 1 for a leaf standing upright. */
  set room(room: number) {
    this.#framing.room = Math.min(1, Math.max(0, room));
    this.#aim();
  }

  /** What a face shows from the next frame on; null a blank page, or plain cloth outside. */
  setFace(face: Face, picture: PagePicture | null): void {
    this.#faces.set(face, picture);
    const texture = this.#pictures.of(picture);
    if (face === "frontOutside" || face === "backOutside") {
      this.#boardFaces[face].setPicture(picture ? texture : null);
    } else if (face === "frontInside" || face === "backInside") {
      this.#boardFaces[face].setPicture(texture);
    } else {
      this.#paper[face].picture = texture;
      if (face === "recto") this.#paper.verso.pictureBehind = texture;
      if (face === "verso") this.#paper.recto.pictureBehind = texture;
    }
  }

  /** Sends a picture to the GPU ahead of the frame that shows it. */
  prepare(picture: PagePicture): void {
    this.#pictures.of(picture);
  }

  /** Frees a picture's texture. Faces that still show it go blank. */
  forget(picture: PagePicture): void {
    for (const [face, shown] of this.#faces) if (shown === picture) this.setFace(face, null);
    this.#pictures.forget(picture);
  }

  /** Where the book's parts are from the next frame on. Costs nothing for parts that stay. */
  pose(pose: BookPose): void {
    const { thickness, cover } = this.#shape;
    const hard = cover === "hard";
    const [left, right] = [this.#left, this.#right];
    const boards = pose.frontBoard + 10 * pose.backBoard;
    const boardsMoved = boards !== this.#boards;
    this.#boards = boards;
    // The first look at the piles tells where the gutter is in the block.
    const middle = this.#middleOf(pose);
    // Smaller steps than a sixtieth of a pixel are saved up.
    const middleMoved = Math.abs(middle - this.#framing.middle) > 5e-6;
    const joint = hard ? caseSizes.joint : 0;
    if (boardsMoved || middleMoved) {
      placeCase(this.#case, thickness, middle, pose.frontBoard, pose.backBoard, joint);
    }
    const leftMoved = left.update(pose.left, this.#case, hard);
    const rightMoved = right.update(pose.right, this.#case, hard);
    if (leftMoved) this.#pages(this.#leftPage.mesh, this.#leftBlock.mesh, left.present);
    if (rightMoved) this.#pages(this.#rightPage.mesh, this.#rightBlock.mesh, right.present);
    if (leftMoved && left.present) {
      this.#leftPage.shape(left);
      this.#leftBlock.shape(left);
    }
    if (rightMoved && right.present) {
      this.#rightPage.shape(right);
      this.#rightBlock.shape(right);
    }
    const still = !(leftMoved || rightMoved || boardsMoved || middleMoved);
    if (!still) this.#placeBoards(hard);
    this.#light(pose, leftMoved || rightMoved, still, hard);
    if (middleMoved) this.#framing.middle = middle;
    this.#framing.closedRight = this.#case.closedRight;
    this.#framing.closedLeft = this.#case.closedLeft;
    if (boardsMoved || middleMoved) this.#aim();
    this.#castShadow(pose, hard);
  }

  /** Draws one frame, now. */
  draw(options?: DrawOptions): void {
    const ratio = options?.resting ? this.#restingRatio() : this.#ratio;
    const [width, height] = [Math.floor(this.#width * ratio), Math.floor(this.#height * ratio)];
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      // Clears the canvas; it is filled again below before anyone can see.
      this.#renderer.setDrawingBufferSize(this.#width, this.#height, ratio);
    }
    this.#renderer.render(this.#scene, this.#camera);
  }

  /** The line of sight through a place on the canvas, CSS pixels from its upper left corner. */
  rayAt(x: number, y: number): Ray {
    const { elements: m } = this.#camera.matrixWorld;
    const { elements: p } = this.#camera.projectionMatrix;
    const right = ((2 * x) / this.#width - 1) / p[0];
    const up = (1 - (2 * y) / this.#height) / p[5];
    const way = [0, 1, 2].map((k) => right * m[k] + up * m[4 + k] - m[8 + k]);
    const length = Math.hypot(way[0], way[1], way[2]);
    return {
      origin: [m[12], m[13], m[14]],
      direction: [way[0] / length, way[1] / length, way[2] / length],
    };
  }

  /** Where a point of book space is on the canvas, CSS pixels from its upper left corner. */
  project(point: Vec3): { x: number; y: number } {
    const seen = new Vector3(...point).project(this.#camera);
    return { x: (0.5 + 0.5 * seen.x) * this.#width, y: (0.5 - 0.5 * seen.y) * this.#height };
  }

  /** Frees everything on the GPU and gives its context back. The canvas cannot be drawn on again. */
  destroy(): void {
    this.#canvas.removeEventListener("webglcontextlost", this.#lost);
    this.#canvas.removeEventListener("webglcontextrestored", this.#restored);
    this.onRestored = null;
    // Frees all of the GPU's memory at once; the rest lets go of what three.js keeps.
    this.#renderer.forceContextLoss();
    for (const part of [
      this.#leftPage,
      this.#rightPage,
      this.#leftBlock,
      this.#rightBlock,
      this.#leaf,
      this.#front,
      this.#back,
      this.#spine,
      this.#headbands,
      this.#leftFold,
      this.#rightFold,
      this.#ground,
      this.#pictures,
      ...this.#grains,
      ...this.#materials,
    ]) {
      part.dispose();
    }
    this.#scene.clear();
    this.#renderer.dispose();
  }

  readonly #lost = (event: Event): void => event.preventDefault();

  readonly #restored = (): void => {
    this.onRestored?.();
  };

  #keep<M extends Material>(material: M): M {
    this.#materials.push(material);
    return material;
  }

  #pages(page: Mesh, block: Mesh, present: boolean): void {
    page.visible = present;
    block.visible = present;
  }

  /**
   * Middle of the block's spine: the gutter wanders over it as leaves go from
   * side to side. The leaf in flight takes its share of the block along, so
   * that nothing jumps where it takes off and lands.
   */
  #middleOf(pose: BookPose): number {
    // A pile is as thick as its uppermost page is high at the fore-edge.
    const high = (pile: BookPose["left"]): number => pile?.curves[2 * pile.columns - 1] ?? 0;
    const [left, right] = [high(pose.left), high(pose.right)];
    let middle = right - left;
    if (pose.leaf) {
      const { positions, columns, rows } = pose.leaf;
      let over = 0;
      for (let row = 0; row < rows; row++) over += positions[3 * ((row + 1) * columns - 1)];
      const way = Math.min(1, Math.max(-1, over / (rows * 0.97 * this.#shape.width)));
      middle += Math.max(0, this.#shape.thickness - left - right) * way;
    }
    return middle / 2;
  }

  #placeBoards(hard: boolean): void {
    if (!hard) return;
    const shape = this.#case;
    this.#front.place(shape.frontHinge, shape.frontAngle);
    this.#back.place(shape.backHinge, shape.backAngle);
    this.#spine.shape(shape);
    this.#headbands.shape(shape);
    // Under a board that is nearly shut nobody sees the fold, and it would stick out at the hinge.
    this.#leftFold.mesh.visible = !this.#left.present && shape.frontAngle > 1.2;
    this.#rightFold.mesh.visible = !this.#right.present && shape.backAngle < Math.PI - 1.2;
    if (!this.#left.present) this.#leftFold.shape(shape, this.#left, this.#right);
    if (!this.#right.present) this.#rightFold.shape(shape, this.#left, this.#right);
    const reach = this.#shape.width + caseSizes.rim - caseSizes.joint;
    tipOf(this.#boardRight, shape.frontHinge, shape.frontAngle, reach, 1);
    tipOf(this.#boardLeft, shape.backHinge, shape.backAngle, reach, -1);
    const edges = this.#framing.boardEdges;
    [edges[0], edges[1]] = [this.#boardRight[2], this.#boardRight[3]];
    [edges[2], edges[3]] = [-this.#boardLeft[2], this.#boardLeft[3]];
  }

  #light(pose: BookPose, pilesMoved: boolean, still: boolean, hard: boolean): void {
    const [left, right] = [this.#left, this.#right];
    const { leaf } = pose;
    this.#leaf.recto.visible = this.#leaf.verso.visible = leaf !== null;
    const same = leaf ? leaf.version === this.#leafVersion : !this.#shadowed;
    if (still && same) return;
    if (leaf) {
      this.#leaf.shape(leaf);
      this.#leaf.light(leaf, left, right);
      for (const [over, pile] of [
        [this.#overLeft, left],
        [this.#overRight, right],
      ] as const) {
        over.sky.cut(leaf, pile.sign, 0, 0, obstacleStride);
        over.keys.forEach((key, k) => {
          key.cut(leaf, pile.sign, shadowSlopes[k], pile.top, obstacleStride);
        });
      }
    } else {
      for (const over of [this.#overLeft, this.#overRight]) {
        over.sky.counts.fill(0);
        for (const key of over.keys) key.counts.fill(0);
      }
    }
    this.#leafVersion = leaf ? leaf.version : -1;
    this.#shadowed = leaf !== null;
    if (left.present) {
      if (pilesMoved) this.#leftPage.open(left, right.mirrored);
      this.#leftPage.light(left, this.#overLeft);
    }
    if (right.present) {
      if (pilesMoved) this.#rightPage.open(right, left.obstacles);
      this.#rightPage.light(right, this.#overRight);
    }
    if (!hard) return;
    // A board under pages shows its rim alone, where no leaf's shadow is looked for.
    if (!still || !left.present) this.#front.light(this.#case, left, right, this.#overLeft);
    if (!still || !right.present) this.#back.light(this.#case, left, right, this.#overRight);
  }

  /** The book's footprint on the table. */
  #castShadow(pose: BookPose, hard: boolean): void {
    const { width, height } = this.#shape;
    const { rim, joint } = caseSizes;
    const shape = this.#case;
    const high = Math.max(this.#left.top, this.#right.top) + (hard ? caseSizes.board : 0);
    if (hard) {
      const reach = width + rim - joint;
      const ends = [
        [shape.frontHinge[0], shape.frontHinge[0] + reach * Math.cos(shape.frontAngle)],
        [shape.backHinge[0], shape.backHinge[0] + reach * Math.cos(shape.backAngle)],
      ];
      const lifts = [reach * Math.sin(shape.frontAngle), reach * Math.sin(shape.backAngle)];
      // A raised board leaves the table to the block alone, and throws a softer shadow.
      const lies = (k: number): number => {
        const down = Math.max(0, 1 - lifts[k] / 0.03);
        return ends[k][0] + (ends[k][1] - ends[k][0]) * down * down;
      };
      this.#ground.shadow(
        Math.min(lies(0), lies(1), shape.c[0], shape.d[0]) - 0.001,
        -rim,
        Math.max(lies(0), lies(1), shape.c[0], shape.d[0]) + 0.001,
        height + rim,
        high,
      );
      const up = lifts[0] > lifts[1] ? 0 : 1;
      const [from, to] = ends[up];
      const middle = lifts[up] / 2 + shape[up === 0 ? "frontHinge" : "backHinge"][1] * 0.5;
      const raised = lifts[up] > 1e-4 ? middle : 0;
      this.#ground.raise(Math.min(from, to), -rim, Math.max(from, to), height + rim, raised);
      return;
    }
    let [x0, x1] = [0, 0];
    for (const pile of [this.#left, this.#right]) {
      for (let k = 0; pile.present && k < pile.curves.length; k += 2 * pile.columns) {
        const end = pile.curves[k + 2 * pile.columns - 2];
        x0 = Math.min(x0, end);
        x1 = Math.max(x1, end);
      }
    }
    if (pose.leaf) {
      const { positions, columns, rows } = pose.leaf;
      for (let row = 0; row < rows; row += 4) {
        const at = 3 * (row * columns + columns - 1);
        // A leaf high above the table throws no shadow of its own.
        const low = Math.exp(-Math.max(0, positions[at + 2]) / 0.03);
        x0 = Math.min(x0, positions[at] * low);
        x1 = Math.max(x1, positions[at] * low);
      }
    }
    this.#ground.shadow(x0, 0, x1, height, high);
  }

  #aim(): void {
    const rim = this.#shape.cover === "hard" ? caseSizes.rim : 0;
    const aspect = this.#width / this.#height;
    const view = frameBook(this.#shape, this.#framing, aspect, rim);
    const camera = this.#camera;
    camera.matrix.makeBasis(
      new Vector3(...view.right),
      new Vector3(...view.up),
      new Vector3(...view.back),
    );
    camera.matrix.setPosition(...view.position);
    camera.matrixWorldNeedsUpdate = true;
    camera.updateMatrixWorld(true);
    camera.aspect = aspect;
    const size = 2 * Math.max(this.#shape.width, this.#shape.height);
    camera.near = Math.max(0.02, view.distance - size);
    camera.far = view.distance + 2 * size;
    camera.updateProjectionMatrix();
  }

  #restingRatio(): number {
    const ratio = Math.max(2, this.#ratio);
    // No canvas larger than the GPU takes, nor than 16 million pixels.
    const most = this.#renderer.capabilities.maxTextureSize;
    const longest = Math.max(this.#width, this.#height);
    const fit = Math.min(most / longest, Math.sqrt(16e6 / (this.#width * this.#height)));
    return Math.max(Math.min(this.#ratio, fit), Math.min(ratio, fit));
  }
}

/** Hinge and outer edge of a board that stands over the pages, as points that shut out light. */
function tipOf(
  out: Float32Array,
  hinge: readonly [number, number],
  angle: number,
  reach: number,
  sign: 1 | -1,
): void {
  out[0] = sign * hinge[0];
  out[1] = hinge[1];
  out[2] = sign * (hinge[0] + reach * Math.cos(angle));
  out[3] = hinge[1] + reach * Math.sin(angle);
}

function openRenderer(canvas: HTMLCanvasElement): WebGLRenderer {
  const context = canvas.getContext("webgl2", {
    alpha: true,
    antialias: true,
    depth: true,
    stencil: false,
    premultipliedAlpha: true,
  });
  if (!context) {
    throw new Error(
      "This book needs WebGL 2, which this browser does not offer or has switched off.",
    );
  }
  const renderer = new WebGLRenderer({ canvas, context, alpha: true, antialias: true });
  renderer.outputColorSpace = SRGBColorSpace;
  renderer.setClearColor(0, 0);
  return renderer;
}
