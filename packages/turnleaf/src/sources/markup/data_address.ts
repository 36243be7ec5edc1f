/** Pictures and fonts that are written into markup and style as `data:` addresses. */

import { claimedSize, typedImage } from "../image_header.ts";
import { limits } from "../limits.ts";

/** Bytes in which a picture's size is searched for. */
const headLength = 1 << 20;

/** Returns whether a picture with a type is of a kind whose size is known before it is decoded. */
export function isKnownPicture({ type }: Blob): boolean {
  return /^image\/(png|jpeg|gif|webp|avif|svg\+xml)$/.test(type);
}

/**
 * Returns an address of data if it is a font, or a picture of a known kind that is
 * not too large; null otherwise.
 */
export async function checkedData(address: string): Promise<string | null> {
  if (/^data:font\//i.test(address)) return address;
  const head = /^data:image\//i.test(address) ? dataBytes(address, headLength) : null;
  if (head === null) return null;
  const image = await typedImage(new Blob([head]));
  if (!isKnownPicture(image)) return null;
  const size = await claimedSize(image);
  return size && size.width * size.height > limits.imagePixels ? null : address;
}

/** Returns the first bytes of an address of data; null if they cannot be read. */
export function dataBytes(
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
  return Uint8Array.from(head, (letter) => letter.charCodeAt(0));
}

function fromEscapes(data: string, most: number): Uint8Array<ArrayBuffer> {
  const bytes = data
    .slice(0, most)
    .replace(/%([0-9a-f]{2})/gi, (_, digits) => String.fromCharCode(Number.parseInt(digits, 16)));
  return Uint8Array.from(bytes, (letter) => letter.charCodeAt(0));
}
