/** Fits pictures of pages of other sizes onto the book's leaf. Loaded with the first such page. */

import type { PageBox, PagePicture } from "../sources/page_source.ts";
import { foldAt, isFoldOut, isTrimmed, panelsOf } from "./page_place.ts";

/**
 * Draws a page's picture on one of the leaf's proportions, no sharper than the
 * former and no wider than `width`. Where the leaf is trimmed to a smaller page
 * it is transparent, and so is a board beside its cover; a small margin is
 * paper. A fold-out is folded in.
 *
 * @param place the part of the leaf that the page covers
 * @param aspect the leaf's width over its height
 * @param width of the leaf in device pixels
 * @param paper CSS colour of bare paper
 */
export function fitToLeaf(
  picture: PagePicture,
  place: PageBox,
  aspect: number,
  width: number,
  paper: string,
): HTMLCanvasElement {
  const { canvas, pen } = leafFor(picture, place, aspect, width);
  if (!isTrimmed(place)) {
    pen.fillStyle = paper;
    pen.fillRect(0, 0, canvas.width, canvas.height);
  }
  drawOn(pen, picture, place);
  if (isFoldOut(place)) drawFolded(pen, picture, place, paper);
  return canvas;
}

/**
 * Returns the parts of an open fold-out, each as high as the leaf: what is on
 * it, what is beyond its fold, and the bare back of that.
 *
 * @param paper CSS colour of bare paper
 */
export function unfold(
  picture: PagePicture,
  place: PageBox,
  aspect: number,
  width: number,
  paper: string,
): { page: HTMLCanvasElement; flap: HTMLCanvasElement; back: HTMLCanvasElement } {
  const { canvas: page, pen } = leafFor(picture, place, aspect, width);
  drawOn(pen, picture, place);
  const isRight = place.x < 0;
  // A whole texel more than up to the fold, as the flap begins there within a pixel.
  const beyond = page.width - Math.ceil(foldAt * page.width) - 1;
  pen.clearRect(isRight ? 0 : page.width - beyond, 0, beyond, page.height);
  const flap = document.createElement("canvas");
  const fraction = place.width - foldAt;
  flap.width = Math.max(Math.round(fraction * page.width), 1);
  flap.height = page.height;
  const flapPen = flap.getContext("2d") as CanvasRenderingContext2D;
  flapPen.imageSmoothingQuality = "high";
  flapPen.translate((isRight ? fraction - (1 - foldAt) : -foldAt) * page.width, 0);
  drawOn(flapPen, picture, place, page.width, page.height);
  const back = document.createElement("canvas");
  [back.width, back.height] = [flap.width, flap.height];
  const backPen = back.getContext("2d") as CanvasRenderingContext2D;
  backPen.fillStyle = paper;
  const [, top, , tall] = wholePixels(place, back.width, back.height);
  backPen.fillRect(0, top, back.width, tall);
  return { page, flap, back };
}

/**
 * Returns a canvas of the leaf's proportions, as large as the picture fills it
 * and no wider than `width`.
 */
function leafFor(picture: PagePicture, place: PageBox, aspect: number, width: number) {
  const across = Math.min(picture.width / place.width, width);
  const canvas = document.createElement("canvas");
  canvas.width = Math.max(Math.round(across), 1);
  canvas.height = Math.max(Math.round(across / aspect), 1);
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.imageSmoothingQuality = "high";
  return { canvas, pen };
}

function drawOn(
  pen: CanvasRenderingContext2D,
  picture: PagePicture,
  place: PageBox,
  across = pen.canvas.width,
  down = pen.canvas.height,
): void {
  const [left, top, wide, tall] = wholePixels(place, across, down);
  const isThatLarge = (length: number, wanted: number) => Math.abs(length - wanted) <= 1;
  // One that was drawn for this place is copied as it is.
  if (isThatLarge(picture.width, wide) && isThatLarge(picture.height, tall)) {
    pen.drawImage(picture, left, top);
  } else pen.drawImage(picture, left, top, wide, tall);
}

/**
 * Returns the left, top, width and height of a place on a canvas, in whole pixels: one that were
 * covered in part would be seen as a light line at the edge.
 */
function wholePixels(
  { x, y, width, height }: PageBox,
  across: number,
  down: number,
): [number, number, number, number] {
  const [left, top] = [Math.round(x * across), Math.round(y * down)];
  return [
    left,
    top,
    Math.round((x + width) * across) - left,
    Math.round((y + height) * down) - top,
  ];
}

/**
 * Draws the uppermost panel of a shut fold-out over its page, with the shadow that the flap throws
 * there: the bare back of an odd one, the face of an even one.
 */
function drawFolded(
  pen: CanvasRenderingContext2D,
  picture: PagePicture,
  place: PageBox,
  paper: string,
): void {
  const { width, height } = pen.canvas;
  const { panels, across } = panelsOf(place);
  const isFace = panels % 2 === 0;
  const isRight = place.x < 0;
  pen.save();
  // Mirrored for a page whose spine is on its right.
  if (isRight) {
    pen.translate(width, 0);
    pen.scale(-1, 1);
  }
  const panel = { ...place, x: foldAt - across, width: across };
  const [free, top, wide, tall] = wholePixels(panel, width, height);
  const fold = free + wide;
  pen.clearRect(fold, 0, width - fold, height);
  const shadow = pen.createLinearGradient(free - 0.03 * width, 0, free, 0);
  shadow.addColorStop(0, "rgb(60 45 25 / 0)");
  shadow.addColorStop(1, "rgb(60 45 25 / 0.3)");
  pen.fillStyle = shadow;
  pen.fillRect(free - 0.03 * width, top, 0.03 * width, tall);
  pen.fillStyle = paper;
  pen.fillRect(free, top, wide, tall);
  if (isFace) {
    const at = isRight ? width - fold : free;
    drawLastPanel(pen, picture, place, [at, top, wide, tall]);
  }
  // The round of the fold that the uppermost panel hangs on receives less light.
  const [round, away] = isFace ? [free, free + 0.03 * width] : [fold, fold - 0.03 * width];
  const bend = pen.createLinearGradient(away, 0, round, 0);
  bend.addColorStop(0, "rgb(60 45 25 / 0)");
  bend.addColorStop(1, "rgb(60 45 25 / 0.14)");
  pen.fillStyle = bend;
  pen.fillRect(Math.min(away, round), top, 0.03 * width, tall);
  pen.restore();
}

/** Draws the last panel of a picture on a part of its canvas, which is as wide as the panel. */
function drawLastPanel(
  pen: CanvasRenderingContext2D,
  picture: PagePicture,
  place: PageBox,
  [left, top, wide, tall]: readonly [number, number, number, number],
): void {
  const across = (wide / (place.width * pen.canvas.width)) * picture.width;
  const from = place.x < 0 ? 0 : picture.width - across;
  pen.save();
  pen.resetTransform();
  pen.drawImage(picture, from, 0, across, picture.height, left, top, wide, tall);
  pen.restore();
}
