/** Pictures and fonts that are written into markup and style as `data:` addresses. */

import { claimedSize, typedImage } from "../image_header.ts";
import { limits } from "../limits.ts";

/** Bytes in which a picture's size is searched for. */
const headLength = 1 << 20;

/** Returns an address of data if it is a font, or a picture that is not too large; null otherwise. */
export async function checkedData(address: string): Promise<string | null> {
  if (/^data:font\//i.test(address)) return address;
  const [, flags = "", data = ""] = /^data:(image\/[^,]*),([\s\S]*)$/i.exec(address) ?? [];
  if (flags === "") return null;
  try {
    const head = /;\s*base64\s*$/i.test(flags) ? fromBase64(data) : fromEscapes(data);
    const size = await claimedSize(await typedImage(new Blob([head])));
    return size && size.width * size.height > limits.imagePixels ? null : address;
  } catch {
    return null;
  }
}

function fromBase64(data: string): Uint8Array<ArrayBuffer> {
  const letters = decodeURIComponent(data.slice(0, 2 * headLength)).replace(/\s+/g, "");
  // Whole groups of four letters.
  const head = atob(letters.slice(0, Math.min(letters.length & ~3, headLength)));
  return Uint8Array.from(head, (letter) => letter.charCodeAt(0));
}

function fromEscapes(data: string): Uint8Array<ArrayBuffer> {
  const bytes = data
    .slice(0, headLength)
    .replace(/%([0-9a-f]{2})/gi, (_, digits) => String.fromCharCode(Number.parseInt(digits, 16)));
  return Uint8Array.from(bytes, (letter) => letter.charCodeAt(0));
}
