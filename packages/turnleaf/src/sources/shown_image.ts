/** Pictures as the browser shows them in a page, where its decoder for bitmaps is stricter. */

import { dataUrl } from "./data_url.ts";
import { limits } from "./limits.ts";

/** Pixels along each side of the sample in which anything is looked for. */
const sampleSize = 64;

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
