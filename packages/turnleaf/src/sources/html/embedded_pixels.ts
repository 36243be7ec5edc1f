/** Pictures of a page as data, which is all that an SVG may show when it is drawn as an image. */

import type { PageSize } from "../page_source.ts";

/** A picture of no colour, in place of one that may not be read. */
export const clearPixel =
  "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";

/** Pixels of a copied picture for each CSS pixel of its width: enough for a page zoomed in. */
const mostRatio = 3;

/** How many pictures are kept. */
const mostKept = 200;

/** Returns what is drawn, as data; null if it may not be read, or has no size. */
export function drawnPixels(
  source: CanvasImageSource,
  { width, height }: PageSize,
  scale = 1,
): string | null {
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  if (canvas.width === 0 || canvas.height === 0) return null;
  try {
    canvas.getContext("2d")?.drawImage(source, 0, 0, canvas.width, canvas.height);
    return canvas.toDataURL();
  } catch {
    // Of another site, which does not let this one read it.
    return null;
  }
}

/** Pictures by their addresses: each is read once. */
export class PixelCache {
  readonly #data = new Map<string, string>();
  readonly #changed: () => void;

  /** @param changed called when a picture that `known` lacked is there */
  constructor(changed: () => void) {
    this.#changed = changed;
  }

  /** Returns an image that is loaded, shown `width` CSS pixels wide. */
  ofImage(image: HTMLImageElement, width: number): string {
    const { naturalWidth, naturalHeight, currentSrc } = image;
    const address = currentSrc || image.src;
    if (naturalWidth === 0) return clearPixel;
    const isVector = /^data:image\/svg|\.svg([?#]|$)/i.test(address);
    if (isVector && address.startsWith("data:")) return address;
    const wanted = (mostRatio * (width || naturalWidth)) / naturalWidth;
    const scale = isVector ? wanted : Math.min(wanted, 1);
    const key = `${scale} ${address}`;
    const size = { width: naturalWidth, height: naturalHeight };
    const data = this.#data.get(key) ?? drawnPixels(image, size, scale) ?? clearPixel;
    this.#keep(key, data);
    return data;
  }

  /** Returns the picture at an address if it was read before; otherwise reads it for the next time. */
  known(address: string): string {
    if (address === "") return clearPixel;
    const data = this.#data.get(address);
    if (data === undefined) void this.ofAddress(address).then(this.#changed);
    return data ?? clearPixel;
  }

  /** Reads the picture at an address, as the page itself may; never rejects. */
  async ofAddress(address: string): Promise<string> {
    if (address.startsWith("data:")) return address;
    const known = this.#data.get(address);
    if (known !== undefined) return known;
    const image = new Image();
    image.crossOrigin = "anonymous";
    image.src = address;
    const size = await image.decode().then(
      () => ({ width: image.naturalWidth, height: image.naturalHeight }),
      () => ({ width: 0, height: 0 }),
    );
    const data = drawnPixels(image, size) ?? clearPixel;
    this.#keep(address, data);
    return data;
  }

  #keep(key: string, data: string): void {
    this.#data.delete(key);
    this.#data.set(key, data);
    const [oldest] = this.#data.keys();
    if (this.#data.size > mostKept && oldest !== undefined) this.#data.delete(oldest);
  }
}
