/**
 * The type and size of an image, read from its first bytes: no decoding, and no
 * <img>, which a page's policy may forbid.
 */

import { GIF } from "image-size/types/gif";
import { JPG } from "image-size/types/jpg";
import { PNG } from "image-size/types/png";
import { WEBP } from "image-size/types/webp";
import type { PageSize } from "./page_source.ts";
import { imageType, type Kind, sniff, sniffLength } from "./sniff.ts";

/**
 * Bytes in which a header is searched for: a JPEG's may come after a large
 * profile and a preview.
 */
const headerLength = 1 << 20;

const readers: Readonly<Record<string, typeof JPG>> = {
  "image/png": PNG,
  "image/jpeg": JPG,
  "image/gif": GIF,
  "image/webp": WEBP,
};

const startOf = async (file: Blob): Promise<Uint8Array> =>
  new Uint8Array(await file.slice(0, sniffLength).arrayBuffer());

/** Returns the kind of a file, from its first bytes. */
export async function kindOfFile(file: Blob): Promise<Kind> {
  return sniff({ start: await startOf(file), type: file.type });
}

/**
 * Returns an image with the type found in its first bytes, whatever its server
 * or its file's name says.
 */
export async function typedImage(image: Blob): Promise<Blob> {
  const type = imageType(await startOf(image));
  return type === null || type === image.type ? image : new Blob([image], { type });
}

/**
 * Returns the size of a typed image in pixels, upright by its EXIF data; null
 * if its header is not understood, as that of an AVIF.
 */
export async function sizeFromHeader(image: Blob): Promise<PageSize | null> {
  const reader = readers[image.type];
  if (!reader) return null;
  try {
    const start = new Uint8Array(await image.slice(0, headerLength).arrayBuffer());
    const { width, height, orientation = 1 } = reader.calculate(start);
    // From 5 on the image is turned by a quarter.
    return orientation >= 5 ? { width: height, height: width } : { width, height };
  } catch {
    return null;
  }
}
