/** JPEGs in the colours of print that do not bear Adobe's mark: browsers take their colours for inverted, as Adobe writes them. */

import UTIF from "utif2";
import { checkSize, type Pixels } from "./pixels.ts";

/** Returns a picture's pixels. Throws if it is damaged. */
export function decodeCmykJpeg(file: ArrayBuffer, mostPixels: number): Pixels {
  const decoder = new UTIF.JpegDecoder();
  decoder.parse(new Uint8Array(file));
  const { width, height } = decoder;
  checkSize({ width, height }, mostPixels);
  const inks = decoder.getData({ width, height, forceRGB: false, isSourcePDF: true });
  const data = new Uint8ClampedArray(4 * width * height);
  for (let k = 0; k < data.length; k += 4) {
    const light = 255 - (inks[k + 3] as number);
    for (let channel = 0; channel < 3; channel++) {
      data[k + channel] = ((255 - (inks[k + channel] as number)) * light) / 255;
    }
    data[k + 3] = 255;
  }
  return { width, height, data };
}
