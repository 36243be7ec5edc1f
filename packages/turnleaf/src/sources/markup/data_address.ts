/** Pictures and fonts that are written into markup and style as `data:` addresses. */

import { isShownType, sniffLength, unshownFormat } from "../formats.ts";
import { claimedSize, typedImage } from "../image_header.ts";
import { limits } from "../limits.ts";
import { pictureData } from "../showable_image.ts";

/** Bytes in which a picture's size is searched for. */
const headLength = 1 << 20;

/**
 * Returns an address of data if it is a font, or a picture of a known kind that is
 * not too large: as PNG, if few browsers show its kind. Null otherwise.
 */
export async function checkedData(address: string): Promise<string | null> {
  if (/^data:font\//i.test(address)) return address;
  const image = /^data:image\//i.test(address) ? await typedData(address, headLength) : null;
  if (image && unshownFormat(image.type) !== undefined) return await rarePicture(address);
  if (image === null || !isShownType(image.type)) return null;
  const size = await claimedSize(image);
  return size && size.width * size.height > limits.imagePixels ? null : address;
}

/** Bytes that say whether data is a picture, in letters of base64: twice as many, as each is less than a byte. */
const shown = 2 * sniffLength;
const base64Start = /^data:[^,]*;base64,/i;
const plainLetters = /^[A-Za-z0-9+/]*$/;

/** Returns whether data is no picture by its first bytes: false where more of it would have to be read to tell. */
export async function isNoPicture(address: string): Promise<boolean> {
  const start = base64Start.exec(address)?.[0].length ?? address.length;
  const letters = address.slice(start, start + shown);
  const isPlain = letters.length === shown && plainLetters.test(letters);
  return isPlain && (await dataPicture(address, shown)) === null;
}

/**
 * Returns the first bytes of a picture, of the kind that they are, as the browser has it;
 * null if that is none whose size would be known.
 */
export async function dataPicture(address: string, most?: number): Promise<Blob | null> {
  const image = await typedData(address, most);
  return image && isShownType(image.type) ? image : null;
}

/** Returns the first bytes of data with the type that they are of; null if they cannot be read. */
async function typedData(address: string, most?: number): Promise<Blob | null> {
  const bytes = dataBytes(address, most);
  if (bytes === null) return null;
  // What calls itself a drawing is read as one, whatever it begins with.
  const type = /^\s*data:image\/svg\+xml\s*[;,]/i.test(address) ? "image/svg+xml" : "";
  return await typedImage(new Blob([bytes], { type }));
}

/** Returns a picture of a kind that few browsers show as PNG; null if it cannot be shown. */
async function rarePicture(address: string): Promise<string | null> {
  const bytes = dataBytes(address);
  return bytes && (await pictureData(bytes, "A picture written as data").catch(() => null));
}

/** Returns the first bytes of an address of data; null if they cannot be read. */
function dataBytes(
  address: string,
  most: number = Number.POSITIVE_INFINITY,
): Uint8Array<ArrayBuffer> | null {
  const comma = address.indexOf(",");
  const data = address.slice(comma + 1);
  try {
    const isBase64 = /;\s*base64\s*$/i.test(address.slice(0, comma));
    return isBase64 ? fromBase64(data, most) : fromEscapes(data, most);
  } catch {
    return null;
  }
}

function fromBase64(data: string, most: number): Uint8Array<ArrayBuffer> {
  const letters = decodeURIComponent(data.slice(0, 2 * most)).replace(/\s+/g, "");
  // Whole groups of four letters.
  const head = atob(letters.length > most ? letters.slice(0, most & ~3) : letters);
  return bytesOf(head);
}

function fromEscapes(data: string, most: number): Uint8Array<ArrayBuffer> {
  const bytes = data
    .slice(0, most)
    .replace(/%([0-9a-f]{2})/gi, (_, digits) => String.fromCharCode(Number.parseInt(digits, 16)));
  return bytesOf(bytes);
}

/** Returns the bytes of which each is a letter. Fonts of megabytes are: without an iterator, which takes ten times as long. */
function bytesOf(letters: string): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; k++) bytes[k] = letters.charCodeAt(k);
  return bytes;
}
