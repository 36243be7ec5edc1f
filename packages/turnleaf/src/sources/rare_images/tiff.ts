/** TIFF, by UTIF: scans of one bit packed as faxes are, of grey and of colour. */

import UTIF, { type Ifd } from "utif2";
import { checkSize, type Pixels, upright } from "./pixels.ts";
import { smallerOrMask } from "./tiff_pages.ts";

/** Bits of a pixel: four samples of 32. */
const mostBits = 128;

/** A file's first byte if its numbers begin with their lowest, and the version of files beyond four gigabytes. */
const [littleEndian, bigTiff] = [0x49, 43];

/** Tags of a directory. */
const [subfile, bits, packing, samples, planes, turned] = [254, 258, 259, 277, 284, 274] as const;

/** The packings that UTIF unpacks: of all others it makes an empty picture. */
const unpacked: readonly number[] = [
  1, 2, 3, 4, 5, 6, 7, 8, 9, 32767, 32773, 32809, 32946, 34316, 34676, 34713, 34892,
];

/** Returns the first picture of a file that is no thumbnail or mask. Throws if it is damaged or of an unknown kind. */
export function decodeTiff(file: ArrayBuffer, mostPixels: number): Pixels {
  const isBig =
    new DataView(file).getUint16(2, new Uint8Array(file)[0] === littleEndian) === bigTiff;
  if (isBig) throw new Error("it is a BigTIFF");
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
  UTIF.decodeImage(file, page);
  if (!page.data) throw new Error("its pixels are missing");
  const { buffer } = UTIF.toRGBA8(page);
  return upright({ ...size, data: new Uint8ClampedArray(buffer) }, value(page, turned, 1));
}

function value(directory: Ifd, tag: number, otherwise: number): number {
  return directory[`t${tag}`]?.[0] ?? otherwise;
}
