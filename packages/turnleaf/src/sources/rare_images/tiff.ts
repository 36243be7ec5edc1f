/** TIFF, by UTIF: scans of one bit packed as faxes are, of grey and of colour. */

import UTIF, { type Ifd } from "utif2";
import type { PageSize } from "../page_source.ts";
import { floatPixels } from "./float_samples.ts";
import { lumaPixels } from "./luma_samples.ts";
import { checkSize, type Pixels, upright } from "./pixels.ts";
import { smallerOrMask } from "./tiff_pages.ts";

/** Bits of a pixel: four samples of 64. */
const mostBits = 256;

/** A file's first byte if its numbers begin with their lowest, and the version of files beyond four gigabytes. */
const [littleEndian, bigTiff] = [0x49, 43];

/** Tags of a directory. */
const [subfile, bits, packing, colours, samples, planes, turned, sampleFormat] = [
  ...([254, 258, 259, 262] as const),
  ...([277, 284, 274, 339] as const),
] as const;
const [stripRows, predictor, tileWidth, weights, sampling, range] = [
  ...([278, 317, 322] as const),
  ...([529, 530, 532] as const),
] as const;

/** Colours of lightness and differences, which packings as JPEG make red, green and blue. */
const [luma, asJpeg]: readonly [number, readonly number[]] = [6, [6, 7, 34892]];

/** The predictor of floating-point numbers. */
const floatPredictor = 3;

/** Kinds of colours that UTIF does not know, and makes an empty picture of: three of Lab. */
const unknownColours: readonly number[] = [8, 9, 10];

/** The format of samples that are floating-point numbers. */
const floating = 3;

/** The packings that UTIF unpacks: of all others it makes an empty picture. */
const unpacked: readonly number[] = [
  1, 2, 3, 4, 5, 6, 7, 8, 9, 32767, 32773, 32809, 32946, 34316, 34676, 34713, 34892,
];

/** Bytes of a directory's number of entries, of one of these, and of the place of the next directory. */
const [countLength, entryLength, placeLength] = [2, 12, 4];

/** Bytes of a value by its type; 0 of those whose lists UTIF ends where the file does. */
const valueLength: readonly number[] = [0, 0, 0, 2, 4, 8, 0, 0, 2, 4, 8, 4, 8, 4];

/**
 * Empties the lists of directories that claim more values than the file has room for: UTIF reads as many
 * as are claimed, which takes seconds and gigabytes. A picture that needs none of them is read.
 */
function emptyOverlongLists(file: DataView): void {
  const isLittle = file.getUint8(0) === littleEndian;
  const seen = new Set<number>();
  for (let at = file.getUint32(4, isLittle); at > 0 && !seen.has(at); ) {
    seen.add(at);
    if (at + countLength > file.byteLength) return;
    const end = at + countLength + file.getUint16(at, isLittle) * entryLength;
    if (end > file.byteLength) return;
    for (let entry = at + countLength; entry < end; entry += entryLength) {
      const length = valueLength[file.getUint16(entry + 2, isLittle)] ?? 0;
      const count = file.getUint32(entry + 4, isLittle);
      if (count * length > file.byteLength) file.setUint32(entry + 4, 0);
    }
    if (end + placeLength > file.byteLength) return;
    at = file.getUint32(end, isLittle);
  }
}

/**
 * Returns the first picture of a file that is no thumbnail or mask. Throws if it is damaged or of an unknown
 * kind. The file is changed: what it claims and does not have is taken out.
 */
export function decodeTiff(file: ArrayBuffer, mostPixels: number): Pixels {
  const view = new DataView(file);
  const isBig = view.getUint16(2, view.getUint8(0) === littleEndian) === bigTiff;
  if (isBig) throw new Error("it is a BigTIFF");
  emptyOverlongLists(view);
  const directories = UTIF.decode(file).filter((one) => one.t256 && one.t257);
  const page =
    directories.find((one) => !(value(one, subfile, 0) & smallerOrMask)) ?? directories[0];
  if (!page) throw new Error("it has no picture");
  const size = { width: value(page, 256, 0), height: value(page, 257, 0) };
  checkSize(size, mostPixels);
  if (value(page, bits, 1) * value(page, samples, 1) > mostBits)
    throw new Error("too many samples");
  if (!unpacked.includes(value(page, packing, 1))) {
    throw new Error(`it is packed by method ${value(page, packing, 1)}`);
  }
  if (value(page, planes, 1) === 2 && value(page, samples, 1) > 1) {
    throw new Error("its colours are stored one after another");
  }
  if (unknownColours.includes(value(page, colours, 2))) throw new Error("its colours are of Lab");
  if (value(page, bits, 1) === 32 && value(page, sampleFormat, 1) !== floating) {
    throw new Error("its samples are whole numbers of 32 bits");
  }
  UTIF.decodeImage(file, page);
  if (!page.data) throw new Error("its pixels are missing");
  const data = pixelsOf(page, size, view.getUint8(0) === littleEndian);
  return upright({ ...size, data }, value(page, turned, 1));
}

/** Returns the pixels of a picture whose samples are unpacked. */
function pixelsOf(page: Ifd, size: PageSize, isLittle: boolean): Uint8ClampedArray<ArrayBuffer> {
  const data = page.data as Uint8Array;
  const kind = value(page, colours, 2);
  const isTiled = page[`t${tileWidth}`] !== undefined;
  if (value(page, sampleFormat, 1) === floating && kind <= 2) {
    const isPredicted = value(page, predictor, 1) === floatPredictor;
    if (isPredicted && isTiled) throw new Error("its numbers are predicted in tiles");
    // UTIF has exchanged the bytes of each, which are not those of one number.
    if (isPredicted && !isLittle && value(page, bits, 1) === 16) {
      throw new Error("its numbers of 16 bits are predicted");
    }
    const layout = { count: value(page, samples, 1), bits: value(page, bits, 1), isLittle };
    return floatPixels({ ...size, ...layout, data, isPredicted, isNegative: kind === 0 });
  }
  if (kind === luma && !asJpeg.includes(value(page, packing, 1))) {
    if (isTiled) throw new Error("its colours are stored in tiles");
    if (value(page, bits, 1) !== 8) throw new Error("its colours are of more than 8 bits");
    const [across = 2, down = 2] = page[`t${sampling}`] ?? [];
    return lumaPixels({
      ...{ ...size, data, across, down },
      rows: Math.min(value(page, stripRows, size.height), size.height),
      weights: fractions(page, weights) ?? [],
      range: fractions(page, range) ?? [0, 255, 128, 255, 128, 255],
    });
  }
  return new Uint8ClampedArray(UTIF.toRGBA8(page).buffer);
}

/** Returns the values of a tag whose values are fractions, which UTIF has as pairs. */
function fractions(directory: Ifd, tag: number): number[] | undefined {
  const pairs = directory[`t${tag}`] as unknown as readonly (readonly number[])[] | undefined;
  return pairs?.map(([over = 0, under = 1]) => over / (under || 1));
}

function value(directory: Ifd, tag: number, otherwise: number): number {
  return directory[`t${tag}`]?.[0] ?? otherwise;
}
