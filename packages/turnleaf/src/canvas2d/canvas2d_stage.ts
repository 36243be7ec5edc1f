/**
 * Draws a flat book on a 2D canvas: the stage for browsers without WebGL.
 * Lengths are metres; y runs down from the head.
 */

import type { Face } from "../book/faces.ts";
import { Side } from "../engine/phases.ts";
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
import { showsStaples } from "../stage/staples.ts";
import { fadeBeyondSpine as fade, type Zoom, ZoomState } from "../stage/zoom.ts";
import {
  type Layout,
  layOut,
  magnified,
  onPixels,
  panelOf,
  shutness,
  sightOf,
} from "./canvas_layout.ts";
import { drawBoard } from "./draw_board.ts";
import {
  type Brush,
  drawCase,
  drawPage,
  drawStack,
  drawStaples,
  thicknessOf,
} from "./draw_book.ts";
import { drawFlat, drawFolded } from "./draw_leaf.ts";
import { DrawnPage } from "./drawn_page.ts";
import { KeptDrawing } from "./kept_drawing.ts";
import type { PeeledSurface } from "./peeled_book.ts";

/**
 * Maximum of pixels of a frame at rest, and of device pixels per CSS pixel
 * while something moves.
 */
const mostPixels = 16e6;
const mostMovingRatio = 1.5;

/** An open book before its first pose. */
const lying: BookPose = {
  left: null,
  right: null,
  leaves: [],
  lean: 0,
  frontBoard: Math.PI,
  backBoard: 0,
};

/**
 * What shows a bitmap: a face, a side of a leaf, or the part visible beside a
 * page that is smaller.
 */
type BitmapTarget = Face | `${LeafSide} ${number}` | `beneath ${PageFace}`;

/** One flat book on one canvas. */
export class Canvas2DStage implements BookStage {
  // What a 2D canvas draws is not known, and its layers cost about the same at any size.
  readonly isSoftware = false;
  /** Never called: a 2D canvas loses no context. */
  onRestored: (() => void) | null = null;
  onContextLost: (() => void) | null = null;
  readonly isLost: boolean = false;
  readonly #canvas: HTMLCanvasElement;
  readonly #pen: CanvasRenderingContext2D;
  #shape: BookShape;
  readonly #shown = new Map<BitmapTarget, PagePicture | null>();
  readonly #details = new Map<Face, FaceDetail>();
  readonly #zooming = new ZoomState(() =>
    sightOf(this.#shape, this.#pose, this.#width, this.#height),
  );
  /** What lies under the leaves in flight, while something moves. */
  readonly #still: KeptDrawing;
  /** The two pages of each leaf in flight, by its number: the one that it lay with, and the other. */
  readonly #drawnPages = new Map<number, readonly [up: DrawnPage, under: DrawnPage]>();
  /** Changes when the content of a picture does. */
  #version = 0;
  #pose = lying;
  #layout: Layout = { scale: 1, x: 0, y: 0 };
  #width = 1;
  #height = 1;
  #ratio = 1;

  /** @throws Error if the canvas has no 2D context */
  constructor(canvas: HTMLCanvasElement, shape: BookShape) {
    const pen = canvas.getContext("2d");
    if (!pen) throw new Error("This book needs a canvas, which this browser does not offer.");
    this.#canvas = canvas;
    this.#pen = pen;
    this.#shape = shape;
    this.#still = new KeptDrawing(canvas.ownerDocument);
  }

  bind(shape: BookShape): void {
    this.#shape = shape;
    this.#shown.clear();
    this.#details.clear();
    this.#pose = lying;
    this.#aim();
  }

  resize(cssWidth: number, cssHeight: number, pixelRatio: number, scale = 1): void {
    this.#width = Math.max(1, cssWidth);
    this.#height = Math.max(1, cssHeight);
    this.#ratio = Math.max(0.25, pixelRatio * scale);
    this.#aim();
  }

  /** A flat book keeps its fold-outs folded in. */
  get unfolds(): boolean {
    return false;
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

  setDetail(face: Face, detail: FaceDetail | null): void {
    if (detail) this.#details.set(face, detail);
    else this.#details.delete(face);
  }

  get restingRatio(): number {
    return Math.min(this.#ratio, Math.sqrt(mostPixels / (this.#width * this.#height)));
  }

  get pageTexels(): number {
    const { width, height, quarterTurned } = this.#shape;
    const { scale } = this.#layOut(opened(this.#pose), this.#zooming.zoom);
    return Math.round(scale * this.#ratio * (quarterTurned ? height : width));
  }

  setFace(face: Face, picture: PagePicture | null): void {
    this.#shown.set(face, picture);
  }

  setLeaf(index: number, side: LeafSide, picture: PagePicture | null): void {
    this.#shown.set(`${side} ${index}`, picture);
  }

  /** Nothing is torn out of a book on the flat. */
  setLoose(): void {}

  setUnder(side: PageFace, _behind: PagePicture | null, beneath: PagePicture | null): void {
    this.#shown.set(`beneath ${side}`, beneath);
  }

  refresh(): void {
    this.#version++;
  }

  forget(picture: PagePicture): void {
    for (const [face, shown] of this.#shown) if (shown === picture) this.#shown.set(face, null);
  }

  pose(pose: BookPose): void {
    this.#pose = pose;
    this.#aim();
  }

  draw(options?: DrawOptions): void {
    const ratio = options?.resting
      ? this.restingRatio
      : Math.min(this.#ratio, mostMovingRatio) * (options?.pixels ?? 1);
    const [width, height] = [Math.round(this.#width * ratio), Math.round(this.#height * ratio)];
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      this.#canvas.width = width;
      this.#canvas.height = height;
    }
    const { scale, x, y } = this.#layout;
    const unit = scale * ratio;
    const toCanvas = this.#shape.quarterTurned
      ? new DOMMatrix([0, unit, -unit, 0, x * ratio + unit * this.#shape.height, y * ratio])
      : new DOMMatrix([unit, 0, 0, unit, x * ratio, y * ratio]);
    const brush: Brush = { pen: this.#pen, shape: this.#shape, unit, toCanvas };
    this.#pen.setTransform(1, 0, 0, 1, 0, 0);
    this.#pen.clearRect(0, 0, width, height);
    if (options?.resting) this.#paintStill(brush);
    else this.#copyStill(brush);
    this.#pen.setTransform(toCanvas);
    this.#pen.imageSmoothingQuality = options?.resting ? "high" : "medium";
    this.#paintMoving(brush);
    this.#fadeBeyondSpine(ratio);
    if (options?.resting) this.#freeDrawings();
  }

  rayAt(x: number, y: number): Ray {
    const { scale } = this.#layout;
    const [right, down] = [(x - this.#layout.x) / scale, (y - this.#layout.y) / scale];
    const [across, along] = this.#shape.quarterTurned
      ? [down, right]
      : [right, this.#shape.height - down];
    return { origin: [across, along, 1], direction: [0, 0, -1] };
  }

  project(point: Vec3): Place {
    return this.#placeIn(this.#layout, point);
  }

  projectOpen(point: Vec3): Place {
    return this.#placeIn(this.#layOut(opened(this.#pose), this.#zooming.zoom), point);
  }

  #placeIn(layout: Layout, [x, y]: Vec3): Place {
    const [right, down] = this.#shape.quarterTurned ? [y, x] : [x, this.#shape.height - y];
    return { x: layout.x + layout.scale * right, y: layout.y + layout.scale * down };
  }

  projectOn(face: Face, x: number, y: number): Place {
    const { height } = this.#shape;
    const [left, top, right, bottom] = panelOf(this.#shape, face);
    const [u, v] = this.#shape.quarterTurned ? [y, 1 - x] : [x, y];
    return this.project([left + (right - left) * u, height - top - (bottom - top) * v, 0]);
  }

  get viewKey(): string {
    return [...Object.values(this.#layout), this.#width, this.#height].join();
  }

  destroy(): boolean {
    this.#shown.clear();
    this.#freeDrawings();
    // Frees the pixels at once.
    this.#canvas.width = this.#canvas.height = 0;
    // The next book may be one that the graphics card draws.
    return false;
  }

  #aim(zoom: Zoom = this.#zooming.zoom): void {
    this.#layout = this.#layOut(this.#pose, zoom);
  }

  #layOut(pose: BookPose, zoom: Zoom): Layout {
    const [width, height] = [this.#width, this.#height];
    const whole = layOut(this.#shape, pose, width, height);
    const shown = magnified(whole, zoom.level, this.#zooming.show(zoom), width, height);
    return onPixels(this.#shape, shown, this.#ratio);
  }

  /** Fades out what lies beyond the spine of a page that stands alone. */
  #fadeBeyondSpine(ratio: number): void {
    const { width, height, alone } = this.#shape;
    const [right, left] = shutness(this.#pose);
    const amount = alone === 0 ? 0 : 1 - Math.min(1, right + left);
    if (amount === 0) return;
    const [from, to] = [fade.from, fade.to].map((fraction) =>
      this.project([-alone * fraction * width, height / 2, 0]),
    );
    const pen = this.#pen;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const gradient = pen.createLinearGradient(from.x, from.y, to.x, to.y);
    gradient.addColorStop(0, "rgb(0 0 0 / 0)");
    gradient.addColorStop(1, `rgb(0 0 0 / ${amount})`);
    pen.globalCompositeOperation = "destination-out";
    pen.fillStyle = gradient;
    pen.fillRect(0, 0, this.#width, this.#height);
    pen.globalCompositeOperation = "source-over";
  }

  /** Copies what lies still, which is drawn anew only once it has changed. */
  #copyStill(brush: Brush): void {
    const { width, height } = this.#canvas;
    const { left, right, frontBoard, backBoard } = this.#pose;
    const sides = ["left", "right", "beneath left", "beneath right"] as const;
    const insides = ["frontInside", "backInside"] as const;
    const shows = [
      this.#shape,
      this.#version,
      ...Object.values(this.#layout),
      left && thicknessOf(this.#pose, "left"),
      right && thicknessOf(this.#pose, "right"),
      frontBoard >= Math.PI,
      backBoard <= 0,
      ...[...sides, ...insides].map((name) => this.#shown.get(name)),
      ...(["left", "right", ...insides] as const).map((face) => this.#details.get(face)),
    ];
    this.#still.update(width, height, shows, (pen) => this.#paintStill({ ...brush, pen }));
    this.#pen.drawImage(this.#still.canvas, 0, 0);
  }

  /** Draws what lies under the leaves in flight. */
  #paintStill(brush: Brush): void {
    const pose = this.#pose;
    const isHard = this.#shape.cover === "hard";
    const show = (name: BitmapTarget) => this.#shown.get(name) ?? null;
    const detail = (face: Face) => this.#details.get(face) ?? null;
    brush.pen.setTransform(brush.toCanvas);
    drawCase(brush, pose);
    for (const [sign, side, inside, lies] of [
      [-1, "left", "frontInside", pose.frontBoard >= Math.PI],
      [1, "right", "backInside", pose.backBoard <= 0],
    ] as const) {
      if (pose[side]) {
        drawStack(brush, sign, thicknessOf(pose, side));
        drawPage(brush, sign, show(`beneath ${side}`));
        drawPage(brush, sign, show(side), detail(side));
      } else if (isHard && lies) drawPage(brush, sign, show(inside), detail(inside));
    }
    if (showsStaples(this.#shape, pose)) drawStaples(brush);
  }

  #paintMoving(brush: Brush): void {
    const { frontBoard, backBoard } = this.#pose;
    const show = (name: BitmapTarget) => this.#shown.get(name) ?? null;
    const leaves = this.#pose.leaves as readonly PeeledSurface[];
    const order = leaves
      .map((leaf, index) => ({ leaf, index }))
      .sort((a, b) => a.leaf.id - b.leaf.id);
    for (const [id, pages] of this.#drawnPages) {
      if (leaves.some((leaf) => leaf.id === id)) continue;
      for (const page of pages) page.free();
      this.#drawnPages.delete(id);
    }
    for (const { leaf, index } of order) if (!isBoard(leaf)) this.#drawPages(brush, leaf, index);
    // The leaf picked up later lay beneath, and is folded over the earlier one.
    for (const { leaf } of order.toReversed()) {
      const pages = this.#drawnPages.get(leaf.id);
      if (pages) drawFlat(brush, leaf, pages[0]);
    }
    const isScan = this.#shape.kind === "scan";
    for (const { leaf, index } of order) {
      const pages = this.#drawnPages.get(leaf.id);
      if (pages) {
        const [up, under] = pages;
        drawFolded(brush, leaf, under, up.hasInk && !isScan ? up : null);
      } else {
        const angle = angleOf(leaf);
        const picture = show(angle < Math.PI / 2 ? `recto ${index}` : `verso ${index}`);
        drawBoard(brush, { side: "leaf", angle, picture, detail: null });
      }
    }
    if (this.#shape.cover === "hard") {
      if (frontBoard < Math.PI) this.#paintCover(brush, "front", frontBoard);
      if (backBoard > 0) this.#paintCover(brush, "back", backBoard);
    }
  }

  /**
   * Draws the pages of a leaf in flight as they lie: the one that it lay with, which is copied
   * pixel for pixel, and the other, which is turned and so keeps the pixels of its bitmap.
   */
  #drawPages(brush: Brush, { id, side }: PeeledSurface, index: number): void {
    let pages = this.#drawnPages.get(id);
    if (pages === undefined) {
      const document = this.#canvas.ownerDocument;
      pages = [new DrawnPage(document), new DrawnPage(document)];
      this.#drawnPages.set(id, pages);
    }
    const [sign, up, under] =
      side === Side.right
        ? ([1, `recto ${index}`, `verso ${index}`] as const)
        : ([-1, `verso ${index}`, `recto ${index}`] as const);
    pages[0].show(brush, sign, this.#shown.get(up) ?? null, this.#version, 1);
    const other = this.#shown.get(under) ?? null;
    const width = brush.unit * (this.#shape.quarterTurned ? this.#shape.height : this.#shape.width);
    const density = Math.max(1, (other?.width ?? 0) / width);
    pages[1].show(brush, sign === 1 ? -1 : 1, other, this.#version, density);
  }

  #freeDrawings(): void {
    this.#still.free();
    for (const pages of this.#drawnPages.values()) for (const page of pages) page.free();
    this.#drawnPages.clear();
  }

  #paintCover(brush: Brush, name: "front" | "back", angle: number): void {
    const isOutside = angle < Math.PI / 2 === (name === "front");
    const face = isOutside ? (`${name}Outside` as const) : (`${name}Inside` as const);
    const [picture, detail] = [this.#shown.get(face) ?? null, this.#details.get(face) ?? null];
    drawBoard(brush, { side: isOutside ? "outside" : "inside", angle, picture, detail });
  }
}

/** Returns a pose with its boards open. */
function opened(pose: BookPose): BookPose {
  return { ...pose, frontBoard: Math.PI, backBoard: 0 };
}

/** Minimum thickness at which a leaf is a board and turns without a fold, metres. */
const leastBoard = 0.001;

function isBoard({ thickness = 0 }: PeeledSurface): boolean {
  return thickness >= leastBoard;
}

/** Returns how far the held point of a leaf has turned about the spine, radians from the right. */
function angleOf({ rest, held }: PeeledSurface): number {
  return Math.acos(Math.min(Math.max(held[0] / Math.abs(rest[0]), -1), 1));
}
