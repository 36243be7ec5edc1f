/** Pictures as the browser shows them in a page, where its decoder for bitmaps is stricter. */

import { dataUrl } from "./data_url.ts";
import { limits } from "./limits.ts";

/** Bytes in which a picture of PNG or WebP says how it lies. */
const orientationLength = 1 << 16;

/** Pixels along each side of the sample in which anything is looked for. */
const sampleSize = 64;

/** Data of a camera, in PNG and in WebP. */
const cameraData = /eXIf|EXIF/;

/**
 * Returns a picture drawn as an element shows it: one that breaks off as far as it goes. Rejects if the
 * browser shows none of it, it is too large, or the page's policy allows no images as data.
 */
export async function shownImage(image: Blob): Promise<OffscreenCanvas> {
  const address = await dataUrl(image, image.type);
  const element = new Image();
  const loaded = new Promise((resolve, reject) => {
    element.onload = resolve;
    element.onerror = () => reject(new Error("The browser does not show it."));
  });
  element.src = address;
  await loaded;
  const { naturalWidth: width, naturalHeight: height } = element;
  if (width * height > limits.imagePixels) throw new Error("It is too large.");
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d")?.drawImage(element, 0, 0);
  if (isEmpty(canvas)) throw new Error("There is nothing of it.");
  return canvas;
}

/** Returns whether nothing is drawn on a canvas, as of a picture that breaks off before its first line. */
function isEmpty(canvas: OffscreenCanvas): boolean {
  const pen = new OffscreenCanvas(sampleSize, sampleSize).getContext("2d");
  pen?.drawImage(canvas, 0, 0, sampleSize, sampleSize);
  const { data } = pen?.getImageData(0, 0, sampleSize, sampleSize) ?? { data: [] };
  return data.every((value) => value === 0);
}

/** Returns whether a picture may lie turned in a way that its header's size does not say. */
export async function mayLieTurned(image: Blob): Promise<boolean> {
  if (!/^image\/(png|webp)$/.test(image.type)) return false;
  const start = await image.slice(0, orientationLength).arrayBuffer();
  return cameraData.test(new TextDecoder("latin1").decode(start));
}
