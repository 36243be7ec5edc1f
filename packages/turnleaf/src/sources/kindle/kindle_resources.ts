/** Pictures and fonts of a Kindle book, each in a record. */

import { dataUrl } from "../data_url.ts";
import { fontType } from "../font_type.ts";
import { imageType, sniffLength } from "../formats.ts";
import { joinBytes } from "../join_bytes.ts";
import { limits } from "../limits.ts";
import { pictureData } from "../showable_image.ts";
import { mark } from "./kindle_header.ts";

/** Returns a resource by its number, from 0. Rejects if there is none, or it has more than `most` bytes. */
type ReadResource = (index: number, most: number) => Promise<Uint8Array<ArrayBuffer>>;

/** Bytes of a font that its key hides. */
const hiddenBytes = 1040;

/** The pictures and fonts of one book. */
export class KindleResources {
  readonly #read: ReadResource;

  constructor(read: ReadResource) {
    this.#read = read;
  }

  /** Returns a picture or a font as `data:`, by its number from 0; null if there is none. */
  async data(index: number): Promise<string | null> {
    try {
      const bytes = await this.#bytes(index);
      const font = fontType(bytes);
      if (font) return await dataUrl(bytes, font);
      // A drawing would have addresses of its own; it is never a record.
      if (imageType(bytes.subarray(0, sniffLength)) === "image/svg+xml") return null;
      return await pictureData(bytes, `Picture ${index + 1}`);
    } catch {
      return null;
    }
  }

  async #bytes(index: number): Promise<Uint8Array<ArrayBuffer>> {
    const bytes = await this.#read(index, limits.imageBytes);
    const view = new DataView(bytes.buffer);
    if (bytes.length < 24 || view.getUint32(0) !== mark("FONT")) return bytes;
    const [flags, from] = [view.getUint32(8), view.getUint32(12)];
    const [keyLength, keyFrom] = [view.getUint32(16), view.getUint32(20)];
    const font = bytes.slice(from);
    const key = bytes.subarray(keyFrom, keyFrom + keyLength);
    if (flags & 2 && key.length > 0) {
      const hidden = Math.min(font.length, key.length === 16 ? 1024 : hiddenBytes);
      for (let k = 0; k < hidden; k++) font[k] = (font[k] ?? 0) ^ (key[k % key.length] ?? 0);
    }
    return flags & 1 ? await inflated(font) : font;
  }
}

/** Returns bytes unpacked from zlib's format. Rejects if they are more than `limits.imageBytes`. */
async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const reader = new Blob([bytes])
    .stream()
    .pipeThrough(new DecompressionStream("deflate"))
    .getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return joinBytes(parts, length);
    length += value.length;
    if (length > limits.imageBytes) {
      await reader.cancel();
      throw new Error("The font is too large.");
    }
    parts.push(value as Uint8Array<ArrayBuffer>);
  }
}
