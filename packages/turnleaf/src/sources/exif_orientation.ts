/** How an image lies, as a camera wrote it into a PNG or a WebP; of a JPEG the reader of its size tells. */

/** Bytes of a chunk before its data, in PNG and in WebP. */
const chunkStart = 8;

/** Bytes of a camera's data in which the orientation is searched for: it is in the first list. */
const exifLength = 1 << 16;

/** Chunks that are looked at, each in a read of its own: programs write some dozen before the pixels. */
const mostChunks = 500;

/** The tag of the orientation, and bytes of an entry of a list (TIFF 6.0, 2). */
const [orientationTag, entryLength] = [0x112, 12];

/** WebP's flag for a film, in the byte of its flags. */
const filmFlag = 0x02;

/** The place of that byte. */
export const flagsAt = 20;

/** WebP's flag for data of a camera, there. */
export const exifFlag = 0x08;

/**
 * Returns the orientation of an image from 1, upright, to 8, as EXIF numbers it: 1 if it says none. Null
 * where too much stands before the pixels.
 *
 * @param image a typed image
 */
export async function exifOrientation(image: Blob): Promise<number | null> {
  if (image.type === "image/png") return await orientationOfPng(image);
  return image.type === "image/webp" ? await orientationOfWebp(image) : 1;
}

async function orientationOfPng(image: Blob): Promise<number | null> {
  for (let at = chunkStart, count = 0; count < mostChunks; count++) {
    const chunk = await viewOf(image, at, chunkStart);
    if (chunk === null) return 1;
    const [length, type] = [chunk.getUint32(0), chunk.getUint32(4)];
    // "eXIf"; behind the pixels, "IDAT", browsers do not look for it.
    if (type === 0x65584966) return await orientationIn(image, at + chunkStart, length);
    if (type === 0x49444154) return 1;
    at += chunkStart + length + 4;
  }
  return null;
}

async function orientationOfWebp(image: Blob): Promise<number | null> {
  const flags = await viewOf(image, 12, flagsAt - 12 + 1);
  // "VP8X", without which there is no more than the picture.
  if (flags?.getUint32(0) !== 0x56503858 || !(flags.getUint8(8) & exifFlag)) return 1;
  if (flags.getUint8(8) & filmFlag) return 1;
  for (let at = 12, count = 0; count < mostChunks; count++) {
    const chunk = await viewOf(image, at, chunkStart);
    if (chunk === null) break;
    const length = chunk.getUint32(4, true);
    // "EXIF".
    if (chunk.getUint32(0) === 0x45584946) {
      return await orientationIn(image, at + chunkStart, length);
    }
    at += chunkStart + length + (length & 1);
  }
  return null;
}

/** Returns the orientation in a camera's data; 1 if there is none. */
async function orientationIn(image: Blob, at: number, length: number): Promise<number> {
  const data = await viewOf(image, at, Math.min(length, exifLength));
  if (data === null) return 1;
  try {
    // Some write JPEG's mark before it, "Exif" and two zeros.
    const start = data.getUint32(0) === 0x45786966 ? 6 : 0;
    const isLittle = data.getUint16(start) === 0x4949;
    const list = start + data.getUint32(start + 4, isLittle);
    for (let k = 0; k < data.getUint16(list, isLittle); k++) {
      const entry = list + 2 + k * entryLength;
      if (data.getUint16(entry, isLittle) !== orientationTag) continue;
      const orientation = data.getUint16(entry + 8, isLittle);
      return orientation >= 1 && orientation <= 8 ? orientation : 1;
    }
  } catch {
    // It breaks off.
  }
  return 1;
}

/** Returns some bytes of an image; null if it ends before them. */
async function viewOf(image: Blob, at: number, length: number): Promise<DataView | null> {
  if (at + length > image.size) return null;
  return new DataView(await image.slice(at, at + length).arrayBuffer());
}
