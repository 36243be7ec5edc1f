/**
 * Draws a book. A stage holds everything that is on the GPU; it knows where
 * the book's parts are from the poses it is told, and draws when it is told to:
 * no timer and no animation frame is ever asked for here.
 */

import {
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  type Texture,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Face } from "../book/faces.ts";
import type { Ray, Vec3 } from "../engine/shapes.ts";
import type { PageBox, PagePicture } from "../sources/page_source.ts";
import { BeyondSpine } from "./beyond_spine.ts";
import { fieldOfView, frameBook, sightOf } from "./camera.ts";
import { ContextWatch, openContext } from "./context.ts";
import { DrawnBook } from "./drawn_book.ts";
import { dropFromCard } from "./drop_from_card.ts";
import { BookMaterials, type LeafSide, type PageFace } from "./materials.ts";
import type { BookPose, BookShape } from "./pose.ts";
import { PictureTextures } from "./textures.ts";
import { overheadAt, type Zoom, Zooming } from "./zoom.ts";

/** Most pixels of a frame at rest. */
const mostPixels = 16e6;

/** A place on the canvas, CSS pixels from its upper left corner. */
export interface Place {
  readonly x: number;
  readonly y: number;
}

/** A sharper picture of a part of a face's own; the part in shares of that from its upper left corner. */
export interface FaceDetail {
  readonly picture: PagePicture;
  readonly box: PageBox;
}

/** How a frame is drawn. */
export interface DrawOptions {
  /** Nothing moves: the frame is drawn at twice the CSS resolution at least, for sharp text. */
  readonly resting?: boolean;
  /** Of a frame that is not at rest: share of the screen's pixel ratio; all of it where none is given. */
  readonly pixels?: number;
}

/** A face of the book, or a side of a leaf in flight. */
type Printed = Face | `${LeafSide} ${number}` | `${"behind" | "beneath"} ${PageFace}`;

/** Shows a texture on a face; `none` says that it stands for no picture. */
type Show = (texture: Texture, none: boolean) => void;

/** What draws a book, whether in space or on the flat. */
export type BookStage = Pick<Stage, keyof Stage>;

/** One book on one canvas. */
export class Stage {
  /** Called when the GPU's context came back after a loss and a frame should be drawn again. */
  onRestored: (() => void) | null = null;
  /** Called when it is lost and did not come back in time: this stage shows nothing any more. */
  onGone: (() => void) | null = null;
  readonly #canvas: HTMLCanvasElement;
  #shape: BookShape;
  readonly #renderer: WebGLRenderer;
  readonly #context: ContextWatch;
  readonly #scene = new Scene();
  readonly #camera: PerspectiveCamera;
  readonly #beyond = new BeyondSpine();
  readonly #pictures: PictureTextures;
  #materials: BookMaterials;
  #book: DrawnBook;
  readonly #faces = new Map<Printed, { shown: PagePicture | null; show: Show }>();
  #width = 1;
  #height = 1;
  #ratio = 1;
  readonly #zooming = new Zooming((level) =>
    sightOf(this.#shape, this.#book.framing, this.#aspect, this.#shape.rim, level),
  );

  /**
   * @throws Error in one sentence where the browser has no WebGL 2.
   */
  constructor(canvas: HTMLCanvasElement, shape: BookShape) {
    this.#canvas = canvas;
    this.#shape = shape;
    this.#renderer = openRenderer(canvas);
    this.#pictures = new PictureTextures(this.#renderer);
    this.#materials = new BookMaterials(shape, this.#pictures.paper, this.#pictures.anisotropy);
    this.#book = new DrawnBook(shape, this.#materials);
    this.#scene.add(this.#book.group, this.#beyond.mesh);
    this.#camera = new PerspectiveCamera(fieldOfView, 1, 0.05, 10);
    this.#camera.matrixAutoUpdate = false;
    this.#context = new ContextWatch(canvas, {
      lost: () => {
        dropFromCard(this.#scene);
        this.#pictures.drop();
      },
      restored: () => this.onRestored?.(),
      gone: () => this.onGone?.(),
    });
  }

  /** Shows a book of another shape in place of the one before, at first with nothing on its faces. */
  bind(shape: BookShape): void {
    this.#scene.remove(this.#book.group);
    this.#book.dispose();
    this.#materials.dispose();
    this.#faces.clear();
    this.#shape = shape;
    this.#materials = new BookMaterials(shape, this.#pictures.paper, this.#pictures.anisotropy);
    this.#book = new DrawnBook(shape, this.#materials);
    this.#scene.add(this.#book.group);
  }

  /** The canvas's place is `cssWidth` by `cssHeight` CSS pixels, each `pixelRatio` device pixels. */
  resize(cssWidth: number, cssHeight: number, pixelRatio: number): void {
    this.#width = Math.max(1, cssWidth);
    this.#height = Math.max(1, cssHeight);
    this.#ratio = Math.max(0.25, pixelRatio);
    this.#aim();
  }

  /** Whether fold-outs can lie open. */
  get unfolds(): boolean {
    return true;
  }

  /** How near the book is seen, and what of it. What is set is kept to the book. */
  get zoom(): Zoom {
    return this.#zooming.zoom;
  }

  set zoom(zoom: Zoom) {
    this.#aim(zoom);
  }

  /**
   * The zoom at `level` in which what is seen at `from` now is seen at `to`, as
   * far as the book reaches; CSS pixels from the canvas's upper left corner.
   */
  zoomed(level: number, from: Place, to: Place): Zoom {
    const share = ({ x, y }: Place) => [x / this.#width, y / this.#height] as const;
    return this.#zooming.zoomed(level, share(from), share(to));
  }

  /** What a face shows from the next frame on; null a blank page, or plain cloth outside. */
  setFace(face: Face, picture: PagePicture | null): void {
    this.#print(face, picture, (texture, none) => this.#materials.show(face, texture, none));
  }

  /** What a side of a leaf in flight, counted from the left, shows from the next frame on; null is blank. */
  setLeaf(index: number, side: LeafSide, picture: PagePicture | null): void {
    this.#print(`${side} ${index}`, picture, (texture) =>
      this.#materials.showLeaf(index, side, texture),
    );
  }

  /**
   * What is seen beside the page on a side where its leaf is cut smaller: the
   * page printed on its other side bounds it too, and the one beneath shows.
   */
  setUnder(side: PageFace, behind: PagePicture | null, beneath: PagePicture | null): void {
    const page = this.#materials.pages[side];
    this.#print(`behind ${side}`, behind, (texture) => {
      page.pictureBehind = texture;
    });
    this.#print(`beneath ${side}`, beneath, (texture) => {
      page.beneath = texture;
    });
  }

  /**
   * Lays a sharper picture over a part of a face's own from the next frame on;
   * null takes it away. It stays the caller's, who says when to `forget` it.
   */
  setDetail(face: Face, detail: FaceDetail | null): void {
    const texture = this.#pictures.of(detail?.picture ?? null);
    this.#materials.showDetail(face, texture, detail?.box ?? null);
  }

  /** Canvas pixels for each CSS pixel in a frame at rest. */
  get restingRatio(): number {
    const ratio = Math.max(2, this.#ratio);
    // No canvas larger than the GPU takes.
    const most = this.#renderer.capabilities.maxTextureSize;
    const longest = Math.max(this.#width, this.#height);
    const fit = Math.min(most / longest, Math.sqrt(mostPixels / (this.#width * this.#height)));
    return Math.max(Math.min(this.#ratio, fit), Math.min(ratio, fit));
  }

  /** Frees a picture's texture. Faces that still show it go blank. */
  forget(picture: PagePicture): void {
    for (const [face, { shown, show }] of this.#faces) {
      if (shown === picture) this.#print(face, null, show);
    }
    this.#pictures.forget(picture);
  }

  /**
   * Where the book's parts are from the next frame on. What stays where it was costs nothing.
   *
   * @param roughly whether light between leaves is found in every other pose alone
   */
  pose(pose: BookPose, roughly = false): void {
    if (this.#book.pose(pose, roughly)) this.#aim();
  }

  /** Draws one frame, now. */
  draw(options?: DrawOptions): void {
    const ratio = options?.resting ? this.restingRatio : this.#ratio * (options?.pixels ?? 1);
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
    // Zoomed in, the middle of the canvas is not that of the lens.
    const right = ((2 * x) / this.#width - 1 + p[8]) / p[0];
    const up = (1 - (2 * y) / this.#height + p[9]) / p[5];
    const way = [0, 1, 2].map((k) => right * m[k] + up * m[4 + k] - m[8 + k]);
    const length = Math.hypot(way[0], way[1], way[2]);
    return {
      origin: [m[12], m[13], m[14]],
      direction: [way[0] / length, way[1] / length, way[2] / length],
    };
  }

  /** Whether the GPU's context is lost just now, so that nothing is seen. */
  get isLost(): boolean {
    return this.#context.isLost;
  }

  /** Where a point of book space is on the canvas, CSS pixels from its upper left corner. */
  project(point: Vec3): Place {
    const seen = new Vector3(...point).project(this.#camera);
    return { x: (0.5 + 0.5 * seen.x) * this.#width, y: (0.5 - 0.5 * seen.y) * this.#height };
  }

  /** Where a place on a face's picture, shares from its upper left corner, is on the canvas, likewise. */
  projectOn(face: Face, x: number, y: number): Place {
    return this.project(this.#book.placeOn(face, x, y));
  }

  /** What the projection follows from, as a key: where two are the same, so is what is projected. */
  get viewKey(): string {
    const { matrixWorld, projectionMatrix } = this.#camera;
    return [
      ...matrixWorld.elements,
      ...projectionMatrix.elements,
      this.#width,
      this.#height,
    ].join();
  }

  /** Frees everything on the GPU and gives its context back. The canvas cannot be drawn on again. */
  destroy(): void {
    this.#context.destroy();
    // Frees all of the GPU's memory at once; the rest lets go of what three.js keeps.
    if (!this.isLost) this.#renderer.forceContextLoss();
    this.#book.dispose();
    this.#beyond.dispose();
    this.#materials.dispose();
    this.#pictures.dispose();
    this.#scene.clear();
    this.#renderer.dispose();
  }

  #print(face: Printed, picture: PagePicture | null, show: Show): void {
    if (this.#faces.get(face)?.shown === picture) return;
    this.#faces.set(face, { shown: picture, show });
    show(this.#pictures.of(picture), picture === null);
  }

  get #aspect(): number {
    return this.#width / this.#height;
  }

  #aim(zoom: Zoom = this.#zooming.zoom): void {
    const { level } = zoom;
    const [aspect, overhead] = [this.#aspect, overheadAt(level)];
    const view = frameBook(this.#shape, this.#book.framing, aspect, this.#shape.rim, overhead);
    const camera = this.#camera;
    camera.matrix.makeBasis(
      new Vector3(...view.right),
      new Vector3(...view.up),
      new Vector3(...view.back),
    );
    camera.matrix.setPosition(...view.position);
    camera.matrixWorldNeedsUpdate = true;
    camera.updateMatrixWorld(true);
    const size = 2 * Math.max(this.#shape.width, this.#shape.height);
    camera.near = Math.max(0.02, view.distance - size);
    camera.far = view.distance + 2 * size;
    const [x, y] = this.#zooming.show(zoom);
    const [left, top] = [(x - 0.5 / level) * aspect, y - 0.5 / level];
    camera.setViewOffset(aspect, 1, left, top, aspect / level, 1 / level);
    const { closedRight, closedLeft } = this.#book.framing;
    this.#beyond.aim(this.#shape, Math.min(1, closedRight + closedLeft), camera);
  }
}

function openRenderer(canvas: HTMLCanvasElement): WebGLRenderer {
  const context = openContext(canvas);
  if (!context) throw new Error("The graphics card has no context to give.");
  const renderer = new WebGLRenderer({ canvas, context, alpha: true, antialias: true });
  renderer.outputColorSpace = SRGBColorSpace;
  renderer.setClearColor(0, 0);
  return renderer;
}
