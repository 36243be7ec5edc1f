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
  pen.clearRect(isRight ? 0 : foldAt * page.width, 0, (1 - foldAt) * page.width, page.height);
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
  backPen.fillRect(0, place.y * back.height, back.width, place.height * back.height);
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
  { x, y, width, height }: PageBox,
  across = pen.canvas.width,
  down = pen.canvas.height,
): void {
  const [left, top] = [Math.round(x * across), Math.round(y * down)];
  const isThatLarge = (length: number, wanted: number) => Math.abs(length - wanted) <= 1;
  // One that was drawn for this place is copied as it is.
  if (isThatLarge(picture.width, width * across) && isThatLarge(picture.height, height * down)) {
    pen.drawImage(picture, left, top);
  } else pen.drawImage(picture, x * across, y * down, width * across, height * down);
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
  const [free, fold] = [(foldAt - across) * width, foldAt * width];
  const [top, tall] = [place.y * height, place.height * height];
  pen.clearRect(fold, 0, width - fold, height);
  const shadow = pen.createLinearGradient(free - 0.03 * width, 0, free, 0);
  shadow.addColorStop(0, "rgb(60 45 25 / 0)");
  shadow.addColorStop(1, "rgb(60 45 25 / 0.3)");
  pen.fillStyle = shadow;
  pen.fillRect(free - 0.03 * width, top, 0.03 * width, tall);
  pen.fillStyle = paper;
  pen.fillRect(free, top, fold - free, tall);
  if (isFace) drawLastPanel(pen, picture, place, fold - free);
  // The round of the fold that the uppermost panel hangs on receives less light.
  const [round, away] = isFace ? [free, free + 0.03 * width] : [fold, fold - 0.03 * width];
  const bend = pen.createLinearGradient(away, 0, round, 0);
  bend.addColorStop(0, "rgb(60 45 25 / 0)");
  bend.addColorStop(1, "rgb(60 45 25 / 0.14)");
  pen.fillStyle = bend;
  pen.fillRect(Math.min(away, round), top, 0.03 * width, tall);
  pen.restore();
}

/** Draws the last panel of a picture, `wide` pixels across, beside a fold-out's fold. */
function drawLastPanel(
  pen: CanvasRenderingContext2D,
  picture: PagePicture,
  place: PageBox,
  wide: number,
): void {
  const { width, height } = pen.canvas;
  const from = (wide / (place.width * width)) * picture.width;
  const isRight = place.x < 0;
  const at = (isRight ? 1 - foldAt : foldAt) * width - (isRight ? 0 : wide);
  pen.save();
  pen.resetTransform();
  pen.drawImage(
    picture,
    isRight ? 0 : picture.width - from,
    0,
    from,
    picture.height,
    at,
    place.y * height,
    wide,
    place.height * height,
  );
  pen.restore();
}
