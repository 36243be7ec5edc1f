/** Fits pictures of other proportions onto the book's leaf. */

import type { PageBox, PagePicture } from "../sources/page_source.ts";

/** Difference of proportions that nobody sees, so that a picture may just be stretched. */
const unseen = 0.015;

/** The part of a leaf that a page of other proportions covers, shares from its upper left corner. */
export function placeOnLeaf(own: number, aspect: number): PageBox {
  if (Math.abs(own / aspect - 1) <= unseen) return { x: 0, y: 0, width: 1, height: 1 };
  const [width, height] = [Math.min(own / aspect, 1), Math.min(aspect / own, 1)];
  return { x: (1 - width) / 2, y: (1 - height) / 2, width, height };
}

/**
 * The picture itself where its proportions are the leaf's; else one of the
 * leaf's proportions with the whole picture centred on paper, no sharper than
 * the picture is and no wider than the leaf is wanted.
 *
 * @param aspect the leaf's width over its height
 * @param width of the leaf in device pixels
 */
export function fitToLeaf(picture: PagePicture, aspect: number, width: number): PagePicture {
  const own = picture.width / picture.height;
  if (Math.abs(own / aspect - 1) <= unseen) return picture;
  // A narrow picture of a wide leaf takes a part of it: at the leaf's width it
  // would make a canvas many times as large as what is asked for.
  const whole = own > aspect ? picture.width : picture.height * aspect;
  const scale = Math.min(width / whole, 1);
  const [w, h] = [picture.width * scale, picture.height * scale];
  const canvas = document.createElement("canvas");
  canvas.width = Math.max(Math.round(whole * scale), 1);
  canvas.height = Math.max(Math.round((whole * scale) / aspect), 1);
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#fbf5e8";
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.imageSmoothingQuality = "high";
  pen.drawImage(picture, (canvas.width - w) / 2, (canvas.height - h) / 2, w, h);
  return canvas;
}
