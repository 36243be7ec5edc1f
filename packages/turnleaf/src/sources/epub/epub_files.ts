import type { Archive } from "../archive/archive.ts";
import { dataUrl } from "../data_url.ts";
import { fontType } from "../font_type.ts";
import { claimedSize } from "../image_header.ts";
import { limits } from "../limits.ts";
import { cleanCss, joinSheets } from "../markup/clean_css.ts";
import type { MarkupFiles } from "../markup/clean_markup.ts";
import { checkedData } from "../markup/data_address.ts";
import { imageType, sniffLength } from "../sniff.ts";
import { decodeXml } from "../xml_text.ts";

/** Characters of pictures, fonts and style sheets that are kept between chapters. */
const keptLength = 48_000_000;

/** Style sheets that may import each other. */
const importDepth = 4;

/** Media of an import have no "@": each is searched for only as far as the next one, in linear time. */
const importRule =
  /@import\s+(?:url\(\s*)?(?:(?:"([^"]*)"|'([^']*)')[^;{}@]*|([^"'()\s;]+)(?:[\s)][^;{}@]*)?)(?:;|$)/gi;

/** What a book's manifest says of its files, by their paths. */
export interface ManifestOfFiles {
  isListed(path: string): boolean;
  /** Returns a file's media type; "" if it is not listed. */
  typeOf(path: string): string;
  /** Returns the file that is shown in place of another of a foreign type; the same for others. */
  shownFor(path: string): string;
}

/** The files of an EPUB, by their paths in the archive. */
export class EpubFiles {
  readonly #archive: Archive;
  readonly #names: ReadonlySet<string>;
  /** Undoes what obfuscates a font. */
  readonly #decode: (path: string, bytes: Uint8Array<ArrayBuffer>) => Promise<void>;
  readonly #manifest: ManifestOfFiles;
  #kept = new Map<string, Promise<string | null>>();
  #keptLength = 0;

  constructor(
    archive: Archive,
    decode: (path: string, bytes: Uint8Array<ArrayBuffer>) => Promise<void>,
    manifest: ManifestOfFiles = {
      isListed: () => true,
      typeOf: () => "",
      shownFor: (path) => path,
    },
  ) {
    this.#manifest = manifest;
    this.#archive = archive;
    this.#names = new Set(archive.names);
    this.#decode = decode;
  }

  /** Returns a file's text. Rejects with a `BookError`. */
  async text(path: string): Promise<string> {
    const bytes = await this.#archive.read(path, limits.markupBytes);
    return decodeXml(bytes);
  }

  /** Returns the files that one file names, by addresses relative to it. */
  about(path: string): MarkupFiles {
    let left: number = limits.chapterBytes;
    return {
      data: async (address) => {
        const target = this.resolve(address, path);
        if (/^data:/i.test(address)) return await checkedData(address);
        if (target === null || left < 0) return null;
        left -= this.#archive.size(target);
        return left < 0 ? null : await this.#data(this.#manifest.shownFor(target));
      },
      style: async (address) => {
        const target = this.resolve(address, path);
        return target === null ? "" : ((await this.#style(target, importDepth)) ?? "");
      },
    };
  }

  /** Returns the path of an address in a file; null if the book lists no such file. */
  resolve(address: string, from: string): string | null {
    if (/^[a-z][a-z\d+.-]*:/i.test(address) || address.startsWith("//")) return null;
    try {
      const base = new URL(from.split("/").map(encodeURIComponent).join("/"), "https://x.invalid/");
      const path = decodeURIComponent(new URL(address, base).pathname.slice(1));
      return this.#names.has(path) && this.#manifest.isListed(path) ? path : null;
    } catch {
      return null;
    }
  }

  /** Returns a file's media type as the manifest has it; "" if it is not listed. */
  typeOf(path: string): string {
    return this.#manifest.typeOf(path);
  }

  #data(path: string): Promise<string | null> {
    return this.#keep(path, () => this.#readData(path).catch(() => null));
  }

  async #readData(path: string): Promise<string | null> {
    const bytes = await this.#archive.read(path, limits.imageBytes);
    await this.#decode(path, bytes);
    const start = bytes.subarray(0, sniffLength);
    const image = imageType(start);
    if (image !== null) {
      const size = await claimedSize(new Blob([bytes], { type: image }));
      if (size && size.width * size.height > limits.imagePixels) return null;
      return await dataUrl(bytes, image);
    }
    const font = fontType(start);
    return font && (await dataUrl(bytes, font));
  }

  #style(path: string, depth: number): Promise<string | null> {
    return this.#keep(`${path} ${depth}`, async () => {
      if (depth === 0) return "";
      const css = await this.text(path).catch(() => "");
      const targets = new Set<string>();
      for (const [, double, single, bare] of css.matchAll(importRule)) {
        const target = this.resolve(double ?? single ?? bare ?? "", path);
        if (target === null) continue;
        // Of several imports of one sheet the last one counts.
        targets.delete(target);
        targets.add(target);
      }
      const files = this.about(path);
      return await joinSheets([
        ...[...targets].map((target) => async () => (await this.#style(target, depth - 1)) ?? ""),
        () => cleanCss(css, (address) => files.data(address)),
      ]);
    });
  }

  /** Returns what `read` returned before, or now; keeps a bounded part. */
  #keep(key: string, read: () => Promise<string | null>): Promise<string | null> {
    const kept = this.#kept.get(key);
    if (kept) return kept;
    const reading = read();
    this.#kept.set(key, reading);
    reading.then((text) => {
      this.#keptLength += text?.length ?? 0;
      if (this.#keptLength <= keptLength) return;
      this.#kept = new Map();
      this.#keptLength = 0;
    });
    return reading;
  }
}
