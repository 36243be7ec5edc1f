/** The 3D stage: a book drawn by three.js. It owns everything of the book that is on the GPU. */

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
import type { PagePicture } from "../sources/page_source.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import type {
  BookStage,
  DrawOptions,
  FaceDetail,
  LeafSide,
  PageFace,
  Place,
} from "../stage/book_stage.ts";
import { overheadAt, type Zoom, ZoomState } from "../stage/zoom.ts";
import { lookOf } from "../themes.ts";
import { BeyondSpine } from "./beyond_spine.ts";
import {
  type Framing,
  fieldOfView,
  frameBook,
  openFraming,
  sightOf,
  type View,
  widestLens,
} from "./camera.ts";
import { compiledAhead } from "./compiled_ahead.ts";
import { ContextWatch, openContext } from "./context.ts";
import { DrawnBook } from "./drawn_book.ts";
import { dropFromCard } from "./drop_from_gpu.ts";
import { BookGrains } from "./grains.ts";
import { layOnGrid } from "./ink.ts";
import { BookMaterials } from "./materials.ts";
import { layPrint, type PrintGrid, placeOfPrint } from "./print_grid.ts";
import { drawsInSoftware } from "./software_gl.ts";
import { PictureTextures } from "./textures.ts";

/** Maximum of pixels of a frame at rest. */
const mostPixels = 16e6;

/** Sides of the open book. */
const sides = ["left", "right"] as const;

/** A face of the book, or a side of a leaf in flight or of a loose sheet. */
type BitmapTarget =
  | Face
  | `${LeafSide} ${number}`
  | `loose ${LeafSide} ${number}`
  | `${"behind" | "beneath"} ${PageFace}`;

/** Shows a texture on a face; `none` says that it stands for no picture. */
type ShowTexture = (texture: Texture, none: boolean) => void;

/** One book on one canvas, drawn by three.js. */
export class WebGLStage implements BookStage {
  onRestored: (() => void) | null = null;
  onContextLost: (() => void) | null = null;
  readonly isSoftware: boolean;
  readonly #canvas: HTMLCanvasElement;
  #shape: BookShape;
  readonly #renderer: WebGLRenderer;
  readonly #context: ContextWatch;
  readonly #scene = new Scene();
  readonly #camera: PerspectiveCamera;
  readonly #beyond = new BeyondSpine();
  readonly #pictures: PictureTextures;
  readonly #grains: BookGrains;
  #materials: BookMaterials;
  #book: DrawnBook;
  /**
   * What another book, or one of another shape, has taken the place of. It is disposed of after the next
   * frame: three.js keeps a compiled program while a material uses it, and the new materials use the same.
   */
  readonly #replaced: { dispose(): void }[];
  readonly #faces = new Map<BitmapTarget, { shown: PagePicture | null; show: ShowTexture }>();
  #width = 1;
  #height = 1;
  /** Pixels for each CSS pixel: those of the screen that shows it. */
  #ratio = 1;
  /** Of the canvas as it is seen, by transformations around it. */
  #scale = 1;
  /** Pixels of the screen across an open page; 0 if it is seen aslant. */
  #texels = 0;
  /** The print of the open pages, as it was drawn last: on the pixels of the screen, or null. */
  readonly #grids: Record<PageFace, PrintGrid | null> = { left: null, right: null };
  readonly #zooming = new ZoomState((level) =>
    sightOf(this.#shape, this.#book.framing, this.#aspect, this.#shape.rim, level),
  );

  /** @throws Error if the browser has no WebGL 2. */
  constructor(canvas: HTMLCanvasElement, shape: BookShape) {
    this.#canvas = canvas;
    this.#shape = shape;
    const { renderer, replaced } = openRenderer(canvas);
    this.#renderer = renderer;
    this.#replaced = replaced;
    this.isSoftware = drawsInSoftware(this.#renderer.getContext());
    this.#pictures = new PictureTextures(this.#renderer, lookOf(shape).paper);
    this.#grains = new BookGrains(this.#pictures.anisotropy);
    this.#materials = new BookMaterials(shape, this.#pictures.paper, this.#grains);
    this.#book = new DrawnBook(shape, this.#materials);
    this.#scene.add(this.#book.group, this.#beyond.mesh);
    this.#camera = new PerspectiveCamera(fieldOfView(widestLens), 1, 0.05, 10);
    this.#camera.matrixAutoUpdate = false;
    this.#context = new ContextWatch(canvas, {
      lost: () => {
        dropFromCard(this.#scene);
        this.#pictures.drop();
      },
      restored: () => this.onRestored?.(),
      lostForGood: () => this.onContextLost?.(),
    });
  }

  bind(shape: BookShape, expectsSheets = false): void {
    this.#scene.remove(this.#book.group);
    this.#replaced.push(this.#book, this.#materials);
    this.#faces.clear();
    for (const side of sides) this.#grids[side] = null;
    if (shape.theme !== this.#shape.theme) {
      this.#replaced.push(this.#pictures.setPaper(lookOf(shape).paper));
    }
    this.#shape = shape;
    this.#materials = new BookMaterials(shape, this.#pictures.paper, this.#grains);
    this.#book = new DrawnBook(shape, this.#materials);
    this.#scene.add(this.#book.group);
    if (!expectsSheets) return;
    this.#book.group.add(compiledAhead(this.#materials.forSheets()));
    this.#book.expectSheets();
  }

  resize(cssWidth: number, cssHeight: number, pixelRatio: number, scale = 1): void {
    this.#width = Math.max(1, cssWidth);
    this.#height = Math.max(1, cssHeight);
    this.#ratio = Math.max(0.25, pixelRatio * scale);
    this.#scale = scale;
    this.#aim();
  }

  get unfolds(): boolean {
    return true;
  }

  get zoom(): Zoom {
    return this.#zooming.zoom;
  }

  set zoom(zoom: Zoom) {
    this.#aim(zoom);
  }

  zoomed(level: number, from: Place, to: Place): Zoom {
    const fraction = ({ x, y }: Place) => [x / this.#width, y / this.#height] as const;
    return this.#zooming.zoomed(level, fraction(from), fraction(to));
  }

  setFace(face: Face, picture: PagePicture | null): void {
    this.#print(face, picture, (texture, none) => this.#materials.show(face, texture, none));
  }

  setLeaf(index: number, side: LeafSide, picture: PagePicture | null): void {
    this.#print(`${side} ${index}`, picture, (texture) =>
      this.#materials.showLeaf(index, side, texture),
    );
  }

  setLoose(index: number, side: LeafSide, picture: PagePicture | null): void {
    this.#print(`loose ${side} ${index}`, picture, (texture) =>
      this.#materials.showLoose(index, side, texture),
    );
  }

  setUnder(side: PageFace, behind: PagePicture | null, beneath: PagePicture | null): void {
    const page = this.#materials.pages[side];
    this.#print(`behind ${side}`, behind, (texture) => {
      page.pictureBehind = texture;
    });
    this.#print(`beneath ${side}`, beneath, (texture) => {
      page.beneath = texture;
    });
  }

  setDetail(face: Face, detail: FaceDetail | null): void {
    const texture = this.#pictures.of(detail?.picture ?? null);
    this.#materials.showDetail(face, texture, detail?.box ?? null);
  }

  get restingRatio(): number {
    return this.#ratio * this.restingDots;
  }

  /**
   * Pixels of the canvas across one of the screen at rest: as many as make edges smooth, and a whole
   * number, so that the mean of those of a texel is that texel.
   */
  get restingDots(): number {
    const [width, height] = [this.#width * this.#ratio, this.#height * this.#ratio];
    // The canvas is no larger than the GPU supports.
    const most = this.#renderer.capabilities.maxTextureSize;
    const fit = Math.min(most / Math.max(width, height), Math.sqrt(mostPixels / (width * height)));
    const dots = Math.ceil(((this.isSoftware ? 1.5 : 2) * this.#scale) / this.#ratio);
    return fit < 1 ? fit : Math.min(dots, Math.floor(fit));
  }

  get pageTexels(): number {
    const { level } = this.#zooming.zoom;
    const open = this.#frame(openFraming, level);
    return this.#texelsOf(open, level);
  }

  /** Returns the pixels of the screen across a page in a view of the book; 0 if it is seen aslant. */
  #texelsOf({ back, position, lens }: View, level: number): number {
    const away = position[2] - this.#shape.thickness / 2;
    const seen = (2 * lens * away) / (this.#height * this.#ratio * level);
    return back[2] === 1 ? Math.round(this.#paperSize[0] / seen) : 0;
  }

  /** Width and height of a page as it is read, metres. */
  get #paperSize(): readonly [width: number, height: number] {
    const { width, height, quarterTurned } = this.#shape;
    return quarterTurned ? [height, width] : [width, height];
  }

  refresh(canvas: HTMLCanvasElement): void {
    this.#pictures.refresh(canvas);
  }

  forget(picture: PagePicture): void {
    for (const [face, { shown, show }] of this.#faces) {
      if (shown === picture) this.#print(face, null, show);
    }
    this.#pictures.forget(picture);
  }

  pose(pose: BookPose, roughly = false): void {
    if (this.#book.pose(pose, roughly)) this.#aim();
  }

  draw(options?: DrawOptions): void {
    const most = this.restingDots;
    const dots = options?.resting ? most : Math.min(options?.pixels ?? 1, most);
    const ratio = this.#ratio * dots;
    const [width, height] = [Math.round(this.#width * ratio), Math.round(this.#height * ratio)];
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      // Clears the canvas; it is drawn again below before it can be seen.
      this.#renderer.setDrawingBufferSize(width, height, 1);
    }
    for (const side of sides) {
      this.#grids[side] = options?.steady ? this.#gridOf(side) : null;
      const { uniforms } = this.#materials.pages[side];
      layOnGrid(uniforms, this.#grids[side], height, dots);
    }
    this.#book.light();
    this.#renderer.render(this.#scene, this.#camera);
    for (const replaced of this.#replaced.splice(0)) replaced.dispose();
  }

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

  get isLost(): boolean {
    return this.#context.isLost;
  }

  project(point: Vec3): Place {
    return this.#seenBy(this.#camera, point);
  }

  projectOpen(point: Vec3): Place {
    const { framing } = this.#book;
    if (framing.closedRight === 0 && framing.closedLeft === 0) return this.project(point);
    const camera = this.#camera.clone();
    this.#place(camera, openFraming, this.#zooming.zoom);
    return this.#seenBy(camera, point);
  }

  #seenBy(camera: PerspectiveCamera, point: Vec3): Place {
    const seen = new Vector3(...point).project(camera);
    return { x: (0.5 + 0.5 * seen.x) * this.#width, y: (0.5 - 0.5 * seen.y) * this.#height };
  }

  projectOn(face: Face, x: number, y: number): Place {
    const grid = face === "left" || face === "right" ? this.#grids[face] : null;
    if (grid) {
      const [right, down] = placeOfPrint(grid, [x * grid.size[0], y * grid.size[1]]);
      return { x: right / this.#ratio, y: down / this.#ratio };
    }
    return this.project(this.#book.placeOn(face, x, y));
  }

  get viewKey(): string {
    const { matrixWorld, projectionMatrix } = this.#camera;
    return [
      ...matrixWorld.elements,
      ...projectionMatrix.elements,
      this.#width,
      this.#height,
      ...sides.flatMap((side) => this.#grids[side]?.corner ?? []),
    ].join();
  }

  /** Returns the print of a page on the pixels of the screen; null if it is seen aslant. */
  #gridOf(side: PageFace): PrintGrid | null {
    const { closedRight, closedLeft } = this.#book.framing;
    const { cover, fromAbove, quarterTurned, height, width, thickness } = this.#shape;
    // On its way between open and shut, and shut, a book in boards is seen aslant.
    const isAslant = cover === "hard" && !fromAbove && closedRight + closedLeft > 0;
    if (this.#texels === 0 || isAslant) return null;
    const texels = this.#texels;
    const onScreen = ({ x, y }: Place) => [x * this.#ratio, y * this.#ratio] as const;
    const [u, v] = [side === "left" ? 1 : 0, 0.5];
    const at = (x: number, y: number) => onScreen(this.project(this.#book.placeOn(side, x, y)));
    const middle = at(0.5, 0.5);
    // Along the spine both pages lie as if they were equally high.
    const level = onScreen(this.project([width / 2, height / 2, thickness / 2]));
    const sign = side === "left" ? -1 : 1;
    const [paperWidth, paperHeight] = this.#paperSize;
    return layPrint(
      texels,
      (texels * paperHeight) / paperWidth,
      quarterTurned ? [level[0], middle[1]] : [middle[0], level[1]],
      quarterTurned ? at(v, u) : at(u, v),
      quarterTurned ? [0, sign] : [sign, 0],
    );
  }

  destroy(keepCanvas = false): boolean {
    this.#context.destroy();
    const isKept = keepCanvas && !this.isLost;
    // Frees all of the GPU's memory at once; the rest releases what three.js keeps.
    if (!isKept && !this.isLost) this.#renderer.forceContextLoss();
    const replaced = [...this.#replaced.splice(0), this.#book, this.#beyond, this.#materials];
    this.#grains.dispose();
    this.#pictures.dispose();
    this.#scene.clear();
    if (isKept) {
      // Nothing is seen of the book, and its pixels are freed.
      this.#renderer.setDrawingBufferSize(1, 1, 1);
      spares.set(this.#canvas, { renderer: this.#renderer, replaced });
      return true;
    }
    for (const one of replaced) one.dispose();
    this.#renderer.dispose();
    return false;
  }

  #print(face: BitmapTarget, picture: PagePicture | null, show: ShowTexture): void {
    if (this.#faces.get(face)?.shown === picture) return;
    this.#faces.set(face, { shown: picture, show });
    show(this.#pictures.of(picture), picture === null);
  }

  get #aspect(): number {
    return this.#width / this.#height;
  }

  #aim(zoom: Zoom = this.#zooming.zoom): void {
    const { framing } = this.#book;
    const view = this.#place(this.#camera, framing, zoom);
    this.#texels = this.#texelsOf(view, zoom.level);
    this.#materials.pixel.value = (2 * view.lens * view.distance) / (zoom.level * this.#height);
    const { closedRight, closedLeft } = framing;
    this.#beyond.aim(this.#shape, Math.min(1, closedRight + closedLeft), this.#camera);
  }

  #frame(framing: Framing, level: number): View {
    return frameBook(this.#shape, framing, this.#aspect, this.#shape.rim, overheadAt(level));
  }

  /** Places a camera that frames the book. Returns its view of it. */
  #place(camera: PerspectiveCamera, framing: Framing, zoom: Zoom): View {
    const { level } = zoom;
    const aspect = this.#aspect;
    const view = this.#frame(framing, level);
    camera.matrix.makeBasis(
      new Vector3(...view.right),
      new Vector3(...view.up),
      new Vector3(...view.back),
    );
    camera.matrix.setPosition(...view.position);
    camera.matrixWorldNeedsUpdate = true;
    camera.updateMatrixWorld(true);
    const size = 2 * Math.max(this.#shape.width, this.#shape.height);
    camera.fov = fieldOfView(view.lens);
    camera.near = Math.max(0.02, view.distance - size);
    camera.far = view.distance + 2 * size;
    const [x, y] = this.#zooming.show(zoom);
    const [left, top] = [(x - 0.5 / level) * aspect, y - 0.5 / level];
    camera.setViewOffset(aspect, 1, left, top, aspect / level, 1 / level);
    return view;
  }
}

/** What draws on a canvas, and what of the book before was to be disposed of once the next is drawn. */
interface OpenRenderer {
  readonly renderer: WebGLRenderer;
  readonly replaced: { dispose(): void }[];
}

/** Renderers of the canvases that another stage will draw on. */
const spares = new WeakMap<HTMLCanvasElement, OpenRenderer>();

function openRenderer(canvas: HTMLCanvasElement): OpenRenderer {
  const spare = spares.get(canvas);
  if (spare) {
    spares.delete(canvas);
    return spare;
  }
  const context = openContext(canvas);
  if (!context) throw new Error("The graphics card has no context to give.");
  const renderer = new WebGLRenderer({ canvas, context, alpha: true, antialias: true });
  renderer.outputColorSpace = SRGBColorSpace;
  renderer.setClearColor(0, 0);
  return { renderer, replaced: [] };
}
