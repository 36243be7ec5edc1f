/** Fits pictures of other proportions onto the book's leaf. */

import type { PagePicture } from "../sources/page_source.ts";

/** Difference of proportions that nobody sees, so that a picture may just be stretched. */
const unseen = 0.015;

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
