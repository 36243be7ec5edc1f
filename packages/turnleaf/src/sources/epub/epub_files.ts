import type { Archive } from "../archive/archive.ts";
import { FilePaths } from "../archive/file_paths.ts";
import { dataUrl } from "../data_url.ts";
import { decodeText } from "../decode_text.ts";
import { fontType } from "../font_type.ts";
import { limits } from "../limits.ts";
import { loadPart } from "../load_part.ts";
import { type CleanSheet, cleanCss, inMedia, lengthOf, readSheets } from "../markup/clean_css.ts";
import type { MarkupFiles } from "../markup/clean_markup.ts";
import { checkedData } from "../markup/data_address.ts";
import type { TiffPage } from "../rare_images/tiff_pages.ts";
import { pictureData } from "../showable_image.ts";
import { KeptValues } from "./kept_values.ts";

/** Characters that are kept between chapters, of pictures and fonts and of style sheets each. */
const keptLength = 24_000_000;

/** Style sheets that may import each other. */
const importDepth = 4;

/** An import's address and media. These have no "@": each is searched for only as far as the next one, in linear time. */
const importRule =
  /@import\s+(?:url\(\s*)?(?:(?:"([^"]*)"|'([^']*)')([^;{}@]*)|([^"'()\s;]+)([\s)][^;{}@]*)?)(?:;|$)/gi;

/** What stands before the media of an import: its layer, and what the browser is to support. */
const importCondition = /^[\s)]*(?:layer(?:\([^()]*\))?(?![\w-]))?\s*(?:supports\([^()]*\))?/i;

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
  readonly #paths: FilePaths;
  /** Undoes what obfuscates a font. */
  readonly #decode: (path: string, bytes: Uint8Array<ArrayBuffer>) => Promise<void>;
  readonly #manifest: ManifestOfFiles;
  readonly #keptData = new KeptValues<string | null>(keptLength, (data) => data?.length ?? 0);
  readonly #keptStyles = new KeptValues<readonly CleanSheet[]>(keptLength, (sheets) =>
    sheets.reduce((sum, sheet) => sum + lengthOf(sheet), 0),
  );

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
    this.#paths = new FilePaths(archive.names);
    this.#decode = decode;
  }

  /** Returns a file's text. Rejects with a `BookError`. */
  async text(path: string): Promise<string> {
    const bytes = await this.#archive.read(path, limits.markupBytes);
    return await decodeText(bytes);
  }

  /** Returns the files that one file names, by addresses relative to it. */
  about(path: string): MarkupFiles {
    let left: number = limits.chapterBytes;
    return {
      path,
      data: async (address) => {
        const target = this.resolve(address, path);
        if (/^data:/i.test(address)) return await checkedData(address);
        if (target === null || left < 0) return null;
        left -= this.#archive.size(target);
        return left < 0 ? null : await this.#data(this.#manifest.shownFor(target));
      },
      style: async (address) => {
        const target = this.resolve(address, path);
        return target === null
          ? [unreadable(this.#paths.nameOf(address, path))]
          : await this.#styles(target, importDepth);
      },
      nameOf: (address) => this.#paths.nameOf(address, path),
    };
  }

  /** Returns the path of an address in a file; null if the book lists no such file. */
  resolve(address: string, from: string): string | null {
    const path = this.#paths.resolve(address, from);
    return path !== null && this.#manifest.isListed(path) ? path : null;
  }

  /** Returns a file's media type as the manifest has it; "" if it is not listed. */
  typeOf(path: string): string {
    return this.#manifest.typeOf(path);
  }

  /**
   * Returns how many pages the picture is that a chapter consists of: those of a TIFF, otherwise one.
   * What cannot be read counts as one.
   */
  async pagesOf(path: string): Promise<number> {
    return Math.max((await this.#tiffPages(path).catch(() => [])).length, 1);
  }

  /**
   * Returns the picture that a chapter consists of, as `data:`; null if it is none. Rejects with a
   * `BookError` if its format is not shown.
   *
   * @param page which page of its file it is, from 0
   * @param place the picture in sentences
   */
  async picture(path: string, page: number, place: string): Promise<string | null> {
    const image = (page > 0 ? await this.#tiffPages(path) : [])[page]?.image;
    const whole = image ? await image.arrayBuffer() : this.#archive.read(path, limits.imageBytes);
    return await pictureData(new Uint8Array(await whole), place);
  }

  async #tiffPages(path: string): Promise<readonly TiffPage[]> {
    const { pagesOfTiff } = await loadPart(import("../rare_images/tiff_pages.ts"));
    return await pagesOfTiff(new Blob([await this.#archive.read(path, limits.imageBytes)]));
  }

  #data(path: string): Promise<string | null> {
    return this.#keptData.get(path, () => this.#readData(path).catch(() => null));
  }

  async #readData(path: string): Promise<string | null> {
    const bytes = await this.#archive.read(path, limits.imageBytes);
    await this.#decode(path, bytes);
    const font = fontType(bytes);
    return font ? await dataUrl(bytes, font) : await pictureData(bytes, path);
  }

  /** Returns a style sheet after those that it imports. */
  #styles(path: string, depth: number): Promise<readonly CleanSheet[]> {
    return this.#keptStyles.get(`${path} ${depth}`, async () => {
      if (depth === 0) return [];
      const css = await this.text(path).catch(() => null);
      if (css === null) return [unreadable(path)];
      const imports = new Map<string, string>();
      const missing: CleanSheet[] = [];
      for (const [, double, single, behind, bare, after] of css.matchAll(importRule)) {
        const target = this.resolve(double ?? single ?? bare ?? "", path);
        if (target === null) {
          if (missing.length < limits.warnings)
            missing.push(unreadable(this.#paths.nameOf(double ?? single ?? bare ?? "", path)));
          continue;
        }
        // Of several imports of one sheet the last one counts.
        imports.delete(target);
        imports.set(target, (behind ?? after ?? "").replace(importCondition, "").trim());
      }
      const files = this.about(path);
      return await readSheets([
        ...[...imports].map(
          ([target, media]) =>
            async () =>
              inMedia(await this.#styles(target, depth - 1), media),
        ),
        async () => missing,
        async () => [await cleanCss(css, (address) => files.data(address), files.nameOf)],
      ]);
    });
  }
}

/** Returns what stands for a style sheet that cannot be read. */
function unreadable(source: string): CleanSheet {
  return { namespaces: "", rules: "", lost: [{ code: "style", source }] };
}
