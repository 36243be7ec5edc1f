/** Images as browsers show them, whatever their format. */

import { dataUrl } from "./data_url.ts";
import { unshownFormat } from "./formats.ts";
import { claimedSize, headerOf, typedImage } from "./image_header.ts";
import { limits } from "./limits.ts";
import { loadPart } from "./load_part.ts";
import type { BookErrorDetail } from "./page_source.ts";
import { turnedImage, uprightWebp } from "./upright_image.ts";

/**
 * Returns an image with the type found in its first bytes, whatever its server or its file's name says:
 * as PNG, if it is of a format that few browsers show. Rejects with a `BookError` if that cannot be made,
 * or with the browser's error if the image cannot be read.
 *
 * @param place the image in sentences
 * @param about what errors are about
 */
export async function showableImage(
  image: Blob,
  place: string,
  about: BookErrorDetail = {},
): Promise<Blob> {
  const typed = await typedImage(image);
  if (typed.type === "image/webp") return await uprightWebp(typed);
  const isInInks = typed.type === "image/jpeg" && (await isPlainCmyk(typed));
  if (unshownFormat(typed.type) === undefined && !isInInks) return typed;
  const { asPng } = await loadPart(import("./rare_images/rare_images.ts"));
  const png = await asPng(typed, place, about);
  const { orientation } = isInInks ? ((await headerOf(typed)) ?? {}) : {};
  return orientation && orientation > 1
    ? await turnedImage(await createImageBitmap(png), orientation)
    : png;
}

/** Segments of a JPEG that are looked at, bytes of one's beginning, and those that are read at once. */
const [mostSegments, segmentStart, readAtOnce] = [200, 12, 1 << 16];

/** Returns whether a JPEG is in four colours and does not bear Adobe's mark, by which browsers know how these are written. */
async function isPlainCmyk(image: Blob): Promise<boolean> {
  let [from, view] = [0, new DataView(new ArrayBuffer(0))];
  let at = 2;
  for (let count = 0; count < mostSegments && at + segmentStart <= image.size; count++) {
    if (at + segmentStart > from + view.byteLength) {
      from = at;
      view = new DataView(await image.slice(at, at + readAtOnce).arrayBuffer());
    }
    const here = at - from;
    const marker = view.getUint8(here + 1);
    // "Adobe".
    if (marker === 0xee && view.getUint32(here + 4) === 0x41646f62) return false;
    // A frame's header; 0xC4, 0xC8 and 0xCC are others.
    const isFrame = marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker);
    if (isFrame) return view.getUint8(here + 9) === 4;
    if (view.getUint8(here) !== 0xff || marker === 0xda) return false;
    at += 2 + view.getUint16(here + 2);
  }
  return false;
}

/**
 * Returns a picture as a `data:` address; null if it is none, or has too many pixels. Rejects as
 * `showableImage` does.
 *
 * @param place the picture in sentences
 */
export async function pictureData(
  bytes: Uint8Array<ArrayBuffer>,
  place: string,
): Promise<string | null> {
  const picture = await showableImage(new Blob([bytes]), place);
  if (picture.type === "") return null;
  const size = await claimedSize(picture);
  if (size && size.width * size.height > limits.imagePixels) return null;
  return await dataUrl(picture, picture.type);
}
