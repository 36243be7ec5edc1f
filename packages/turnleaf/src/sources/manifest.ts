import { metresIn } from "../metres.ts";
import { cleanLanguage, cleanText } from "./book_text.ts";
import { type Bytes, blobOf } from "./input_values.ts";
import { limits } from "./limits.ts";
import { fault, isRecord, isSide, textOf } from "./manifest_checks.ts";
import {
  type ManifestLink,
  type ManifestOutline,
  type ManifestText,
  parseLinks,
  parseOutline,
  parseText,
} from "./manifest_text.ts";
import type {
  BookWarning,
  OutlineEntry,
  PageBox,
  PageLink,
  PageSize,
  PageSource,
  TextRun,
} from "./page_source.ts";

/** An image that is read when it is needed, as from an archive. */
export interface StoredImage {
  /** Its file's name in sentences. */
  readonly name: string;
  /** Returns its bytes. Rejects with a `BookError`. */
  read(): Promise<Blob>;
}

/** One page of a book of images. */
export interface ImagePage {
  /** Absolute URL, the image's own bytes, or how to read them. */
  readonly src: string | Blob | StoredImage;
  /** The part of the image that is this page, in fractions of it. The default is all of it. */
  readonly part?: PageBox;
  /** If the image is a strip that goes over several pages, which of them this is: then it has no `part`. */
  readonly strip?: StripPage;
  /** Where it has to lie in a spread, as `PageSource.inSpread` returns it. */
  readonly inSpread?: "first" | "second" | "alone";
  /** Pixels of the page, if they are known before the image is fetched. */
  readonly size?: PageSize;
  readonly label?: string;
  /** What the image shows, in words. */
  readonly alt?: string;
  /** Text and links; their boxes in the unit of `size`, or in the image's own pixels. */
  readonly text?: readonly TextRun[];
  readonly links?: readonly PageLink[];
}

/** A page of a strip. */
export interface StripPage {
  /** Which of the strip's pages it is, from 0, and how many there are. */
  readonly index: number;
  readonly count: number;
  /** Its height over its width. */
  readonly ratio: number;
  /** The strip from its top to its bottom, where it is several images of one width. */
  readonly slices?: readonly StripSlice[];
}

/** An image that is a part of a strip. */
export interface StripSlice {
  readonly src: ImagePage["src"];
  /** Its size in pixels. */
  readonly size: PageSize;
}

/** A book made of images, checked and with every URL resolved. */
export interface ImageBook {
  /** The book's name in sentences: its file's name. */
  readonly name: string;
  readonly title: string;
  readonly authors?: readonly string[];
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly kind: "typeset" | "scan";
  /** Width of a page on paper, metres, if it is known. */
  readonly pageWidth?: number;
  /** How it is covered, as `PageSource` has it. */
  readonly cover?: PageSource["cover"];
  readonly pages: readonly ImagePage[];
  readonly outline?: readonly OutlineEntry[];
  /** What of it cannot be shown, as far as that is known. */
  readonly warnings?: readonly BookWarning[];
  /** The file that they are all in. */
  readonly file?: Blob;
  /** Frees what the images are read from. */
  close?(): void;
}

/**
 * A page as a manifest writes it: its address, or the address with its
 * properties. A script may give the image itself.
 */
export type ManifestPage = string | Bytes | ManifestImage;

/** The properties of a page in a manifest. */
export interface ManifestImage {
  /** Address of its image, relative to the manifest; a script may give the image itself. */
  readonly src: string | Bytes;
  /** Width in pixels: with it and `height` the image can be placed before it is fetched. */
  readonly width?: number;
  /** Height in pixels. */
  readonly height?: number;
  /** The page's label, such as "iv". */
  readonly label?: string;
  /** What the image shows, in words. */
  readonly alt?: string;
  /** Its text, which can be selected, found and read aloud. */
  readonly text?: readonly ManifestText[];
  /** Its links. */
  readonly links?: readonly ManifestLink[];
}

/** A book of images; every property but `pages` is optional. */
export interface Manifest {
  /** The book's title. The default is its file's name. */
  readonly title?: string;
  /** BCP 47 tag. */
  readonly language?: string;
  /** Reading direction. The default is "ltr". */
  readonly direction?: "ltr" | "rtl";
  /** The default is "scan"; "typeset" pages have pure white paper. */
  readonly kind?: "typeset" | "scan";
  /** Width of a page on paper, such as "210mm", "21 cm", "8.5in": its leaves move as so large ones. */
  readonly pageWidth?: string;
  /** The table of contents. */
  readonly outline?: readonly ManifestOutline[];
  /**
   * What is on the boards: the picture of the first page on the front and no other page (`picture`), or
   * the title (`stamped`); `none` for a document without boards. The default is that pages lie on the
   * boards too, the first on the front.
   */
  readonly cover?: "picture" | "stamped" | "none";
  /** The pages in order. */
  readonly pages: readonly ManifestPage[];
}

const dataImage = /^data:image\/[\w.+-]+[;,]/i;

/**
 * Checks a manifest, which may come from anyone. A list alone stands for its
 * pages. Unknown members are ignored.
 *
 * @param base absolute URL that the pages' own are relative to
 * @param name the manifest's name in sentences
 * @throws BookError naming the manifest and the member at fault
 */
export function parseManifest(value: unknown, base: string, name: string): ImageBook {
  const fields = Array.isArray(value) ? { pages: value as unknown[] } : value;
  if (!isRecord(fields)) throw fault(name, "is not a manifest", 'write {"pages": ["001.jpg"]}');
  const pages = fields.pages;
  if (!Array.isArray(pages)) {
    throw fault(name, 'has no list of "pages"', 'write {"pages": ["001.jpg"]}');
  }
  if (pages.length === 0) throw fault(name, "lists no pages", "add at least one");
  if (pages.length > limits.pages) {
    throw fault(
      name,
      `lists ${pages.length} pages`,
      `split it into books of at most ${limits.pages}`,
    );
  }
  const outline = parseOutline(fields, pages.length, name);
  const cover = choice(fields, "cover", ["", "picture", "stamped", "none"], name);
  const written = textOf(fields, "pageWidth", limits.labelLength, name);
  const pageWidth = written === "" ? undefined : metresIn(written);
  if (written !== "" && pageWidth === undefined) {
    throw fault(name, "has a pageWidth that is no length on paper", 'write "210mm"');
  }
  return {
    name,
    title: textOf(fields, "title", limits.titleLength, name) || name,
    language: language(fields.language, name),
    direction: choice(fields, "direction", ["ltr", "rtl"], name),
    kind: choice(fields, "kind", ["scan", "typeset"], name),
    ...(outline.length > 0 ? { outline } : {}),
    ...(cover === "" ? {} : { cover }),
    ...(pageWidth === undefined ? {} : { pageWidth }),
    pages: pages.map((page, index) =>
      parsePage(page, base, pages.length, `${name}: page ${index + 1}`),
    ),
  };
}

function parsePage(value: unknown, base: string, pages: number, place: string): ImagePage {
  const fields = typeof value === "string" || blobOf(value) ? { src: value } : value;
  const given = isRecord(fields) ? fields.src : "";
  const src = blobOf(given) ?? given;
  if (!isRecord(fields) || !(src instanceof Blob || (typeof src === "string" && src !== ""))) {
    throw fault(place, 'has no "src"', 'write "001.jpg" or {"src": "001.jpg"}');
  }
  const size = pageSize(fields, place);
  const label = textOf(fields, "label", limits.labelLength, place);
  const alt = textOf(fields, "alt", limits.altLength, place);
  const text = parseText(fields, place);
  const links = parseLinks(fields, pages, place);
  return {
    src: src instanceof Blob ? src : resolveImage(src, base, place),
    ...(size ? { size } : {}),
    ...(label ? { label } : {}),
    ...(alt ? { alt } : {}),
    ...(text.length > 0 ? { text } : {}),
    ...(links.length > 0 ? { links } : {}),
  };
}

/**
 * Returns the absolute URL of an image: http, https, blob, or an image as data.
 *
 * @throws BookError naming `place`
 */
function resolveImage(src: string, base: string, place: string): string {
  const isData = /^\s*data:/i.test(src);
  if (src.length > (isData ? limits.dataUrlLength : limits.urlLength)) {
    throw fault(place, `has an address of ${src.length} characters`, "use a shorter one");
  }
  if (isData) {
    if (dataImage.test(src.trim())) return src.trim();
    throw fault(place, "holds data that is no image", "write data:image/png or the like");
  }
  const url = parseUrl(src, base);
  if (url === null)
    throw fault(place, `has an address that is none: ${shorten(src)}`, "correct it");
  if (!/^(https?|blob):$/.test(url.protocol)) {
    throw fault(
      place,
      `has an address that is not of the web: ${shorten(src)}`,
      "use http or https",
    );
  }
  return url.href;
}

function parseUrl(src: string, base: string): URL | null {
  try {
    return new URL(src, base);
  } catch {
    return null;
  }
}

function pageSize(fields: Record<string, unknown>, place: string): PageSize | null {
  const { width, height } = fields;
  if (width === undefined && height === undefined) return null;
  if (isSide(width) && isSide(height)) return { width, height };
  throw fault(place, "has no usable width and height", "give both in pixels, or neither");
}

function language(value: unknown, name: string): string {
  if (value === undefined || value === null || value === "") return "";
  const tag = cleanLanguage(value);
  if (tag === "") throw fault(name, "has a language that is no tag", 'write one such as "en"');
  return tag;
}

/** Returns one of `options`; the first if the manifest has none. */
function choice<T extends string>(
  fields: Record<string, unknown>,
  key: string,
  options: readonly [T, ...T[]],
  name: string,
): T {
  const value = fields[key];
  if (value === undefined || value === null) return options[0];
  const found = options.find((option) => option === value);
  if (found === undefined) {
    throw fault(
      name,
      `has an unknown ${key}`,
      `write ${options.flatMap((o) => (o === "" ? [] : `"${o}"`)).join(" or ")}`,
    );
  }
  return found;
}

function shorten(text: string): string {
  return cleanText(text, 80);
}
