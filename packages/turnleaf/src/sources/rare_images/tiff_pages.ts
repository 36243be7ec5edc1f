/** The pages of a TIFF, as of a fax or a scanner: its pictures, each listed in a directory that names the next one. */

import { isPageSize, limits } from "../limits.ts";
import type { PageSize } from "../page_source.ts";

const littleEndian = 0x49_49;
const version = 42;

/** Bytes of a header, and where in it the place of the first directory is. */
const [headerLength, firstAt] = [8, 4];

/** Bytes of the number of a directory's entries, of one of these, of what is before its value, and of where the next directory is. */
const [countLength, entryLength, valueAt, nextLength] = [2, 12, 8, 4];

/** The type of values of two bytes. */
const short = 3;

/** Tags of a directory. */
const [subfile, oldSubfile, across, down, turned] = [254, 255, 256, 257, 274] as const;

/** The bits of a picture that is a smaller copy of another, or a mask of it, and the old number of a smaller copy. */
export const smallerOrMask: number = 1 | 4;
const oldSmaller = 2;

/** A page of a TIFF. */
export interface TiffPage {
  /** It alone, as a TIFF. */
  readonly image: Blob;
  /** Its size in pixels, upright, as it claims. */
  readonly size: PageSize;
}

/**
 * Returns the pages of a TIFF, at most `limits.pages`: those that it lists before anything in it that is
 * damaged. None if it is of another kind.
 */
export async function pagesOfTiff(image: Blob): Promise<readonly TiffPage[]> {
  const file = await image.arrayBuffer();
  const view = new DataView(file);
  return [...directories(view)].map(({ at, end, isLittle, size }) => {
    const header = file.slice(0, headerLength);
    new DataView(header).setUint32(firstAt, at, isLittle);
    const rest = [
      image.slice(headerLength, end),
      new Uint8Array(nextLength),
      image.slice(end + nextLength),
    ];
    return { image: new Blob([header, ...rest], { type: "image/tiff" }), size };
  });
}

/** A directory of a picture that is a page. */
interface Directory {
  /** Where it is, and where it says where the next one is. */
  readonly at: number;
  readonly end: number;
  readonly isLittle: boolean;
  readonly size: PageSize;
}

/** Yields the directories of the pictures that are pages. */
function* directories(file: DataView): Generator<Directory> {
  if (file.byteLength < headerLength) return;
  const isLittle = file.getUint16(0) === littleEndian;
  if (file.getUint16(2, isLittle) !== version) return;
  const seen = new Set<number>();
  let at = file.getUint32(firstAt, isLittle);
  while (at >= headerLength && at + countLength <= file.byteLength && !seen.has(at)) {
    if (seen.size === limits.pages) return;
    seen.add(at);
    const end = at + countLength + file.getUint16(at, isLittle) * entryLength;
    if (end > file.byteLength) return;
    const size = pageSize(
      new DataView(file.buffer, at + countLength, end - at - countLength),
      isLittle,
    );
    if (size) yield { at, end, isLittle, size };
    // The last one may be cut off behind its entries.
    at = end + nextLength <= file.byteLength ? file.getUint32(end, isLittle) : 0;
  }
}

/** Returns the size of the picture of a directory's entries; null if it is no page. */
function pageSize(entries: DataView, isLittle: boolean): PageSize | null {
  const values = new Map<number, number>();
  for (let at = 0; at < entries.byteLength; at += entryLength) {
    const isShort = entries.getUint16(at + 2, isLittle) === short;
    const place = at + valueAt;
    const value = isShort ? entries.getUint16(place, isLittle) : entries.getUint32(place, isLittle);
    values.set(entries.getUint16(at, isLittle), value);
  }
  const value = (tag: number): number => values.get(tag) ?? 0;
  if (value(subfile) & smallerOrMask || value(oldSubfile) === oldSmaller) return null;
  const [width, height] = [value(across), value(down)];
  if (!isPageSize({ width, height })) return null;
  return value(turned) >= 5 ? { width: height, height: width } : { width, height };
}
