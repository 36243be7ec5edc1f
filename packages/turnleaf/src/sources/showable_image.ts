/** Images as browsers show them, whatever their format. */

import { dataUrl } from "./data_url.ts";
import { unshownFormat } from "./formats.ts";
import { claimedSize, typedImage } from "./image_header.ts";
import { limits } from "./limits.ts";
import { loadPart } from "./load_part.ts";
import type { BookErrorDetail } from "./page_source.ts";

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
  if (unshownFormat(typed.type) === undefined) return typed;
  const { asPng } = await loadPart(import("./rare_images/rare_images.ts"));
  return await asPng(typed, place, about);
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
