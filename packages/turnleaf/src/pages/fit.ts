/** Fits pictures of other proportions onto the book's leaf. */

import type { PagePicture } from "../sources/page_source.ts";

/** Difference of proportions that nobody sees, so that a picture may just be stretched. */
const unseen = 0.015;

/**
 * The picture itself where its proportions are the leaf's; else one of the
 * leaf's proportions with the whole picture centred on paper.
 *
 * @param aspect the leaf's width over its height
 */
export function fitToLeaf(picture: PagePicture, aspect: number): PagePicture {
  const own = picture.width / picture.height;
  if (Math.abs(own / aspect - 1) <= unseen) return picture;
  const canvas = document.createElement("canvas");
  canvas.width = own > aspect ? picture.width : Math.round(picture.height * aspect);
  canvas.height = own > aspect ? Math.round(picture.width / aspect) : picture.height;
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#fbf5e8";
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.drawImage(picture, (canvas.width - picture.width) / 2, (canvas.height - picture.height) / 2);
  return canvas;
}
