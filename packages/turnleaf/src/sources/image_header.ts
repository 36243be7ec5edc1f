/**
 * The type and size of an image, read from its first bytes: no decoding, and no
 * <img>, which a page's policy may forbid.
 */

import { BMP } from "image-size/types/bmp";
import { GIF } from "image-size/types/gif";
import { JPG } from "image-size/types/jpg";
import { PNG } from "image-size/types/png";
import { WEBP } from "image-size/types/webp";
import { exifOrientation } from "./exif_orientation.ts";
import { imageType, type Kind, rareImageType, sniff, sniffLength } from "./formats.ts";
import { loadPart } from "./load_part.ts";
import type { PageSize } from "./page_source.ts";

/**
 * Bytes in which a header is searched for: a JPEG's may come after a large
 * profile and a preview.
 */
const headerLength = 1 << 20;

/** Bytes in which the sizes of an AVIF or a HEIC and its parts are searched for. */
const heifLength = 1 << 16;

/** Bytes of a JPEG in which its size is searched for at last: previews and profiles may come before. */
const longestHeader = 1 << 24;

/** Bytes of the header of a BMP as OS/2 wrote it, which has its size in two bytes a side. */
const os2Header = 12;

/** Returns the size that a BMP's header says. */
function calculateBmp(input: Uint8Array): ReturnType<typeof BMP.calculate> {
  const view = new DataView(input.buffer, input.byteOffset, input.byteLength);
  if (view.getUint32(14, true) !== os2Header) return BMP.calculate(input);
  return { width: view.getUint16(18, true), height: view.getUint16(20, true) };
}

const readers: Readonly<Record<string, Pick<typeof JPG, "calculate">>> = {
  "image/png": PNG,
  "image/jpeg": JPG,
  "image/gif": GIF,
  "image/bmp": { calculate: calculateBmp },
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
  const start = await startOf(image);
  const type = imageType(start) ?? rareImageType(start);
  return type === null || type === image.type ? image : new Blob([image], { type });
}

/** The size that an image claims, in pixels. */
export interface ClaimedSize extends PageSize {
  /** Whether the browser shows it so; otherwise it may turn it, or show a part. */
  readonly isShown: boolean;
}

/**
 * Returns the size of a typed image in pixels, upright by its EXIF data; null
 * if its header is not understood, as that of an AVIF, or does not tell how the
 * browser shows it.
 */
export async function sizeFromHeader(image: Blob): Promise<PageSize | null> {
  const header = await headerOf(image);
  return header?.orientation ? upright(header, header.orientation) : null;
}

/** From an orientation of 5 on an image is turned by a quarter. */
const upright = ({ width, height }: PageSize, orientation: number): PageSize =>
  orientation >= 5 ? { width: height, height: width } : { width, height };

/** Returns what a header says, with an orientation as `exifOrientation` returns it; null if it is not understood. */
export async function headerOf(
  image: Blob,
): Promise<(PageSize & { readonly orientation: number | null }) | null> {
  const reader = readers[image.type];
  if (!reader) return null;
  const lengths = image.type === "image/jpeg" ? [headerLength, longestHeader] : [headerLength];
  for (const length of lengths) {
    try {
      const start = new Uint8Array(await image.slice(0, length).arrayBuffer());
      const { width, height, orientation } = reader.calculate(start);
      return { width, height, orientation: orientation ?? (await exifOrientation(image)) };
    } catch {
      // There may be more of it.
      if (image.size <= length) return null;
    }
  }
  return null;
}

/**
 * Returns the size that a typed image claims before it is decoded: its own, or
 * of an AVIF or a HEIC that of its largest part. Null if its
 * header is not understood.
 */
export async function claimedSize(image: Blob): Promise<ClaimedSize | null> {
  if (/^image\/(tiff|jxl|jp2)$/.test(image.type)) {
    const { rareSize } = await loadPart(import("./rare_images/rare_size.ts"));
    const size = await rareSize(image);
    return size && { ...size, isShown: false };
  }
  if (!/^image\/(avif|heic)$/.test(image.type)) {
    const header = await headerOf(image);
    if (header === null) return null;
    return { ...upright(header, header.orientation ?? 1), isShown: Boolean(header.orientation) };
  }
  const start = new DataView(await image.slice(0, heifLength).arrayBuffer());
  let largest: PageSize | null = null;
  let isTurned = false;
  // Each picture in it, the whole and the tiles of a grid, has a box "ispe" (ISO/IEC 23008-12, 6.5.3).
  for (let at = 0; at + 16 <= start.byteLength; at++) {
    const type = start.getUint32(at);
    // "irot" turns what it is of by so many quarters (6.5.10).
    if (type === 0x69726f74) isTurned = (start.getUint8(at + 4) & 1) === 1;
    if (type !== 0x69737065) continue;
    const [width, height] = [start.getUint32(at + 8), start.getUint32(at + 12)];
    if (largest === null || width * height > largest.width * largest.height) {
      largest = { width, height };
    }
  }
  return largest && { ...upright(largest, isTurned ? 5 : 1), isShown: false };
}
