/** A book as IIIF's Presentation API 3 and Image API 3 (level 0) have it. */

import type { BookView } from "./book_pages.ts";
import { bookAddress } from "./book_pages.ts";
import { parseLicence, rightsAddress } from "./licence.ts";
import { linesOf } from "./page_text.ts";
import {
  halved,
  halvings,
  pictureAddress,
  type SiteBook,
  type SiteOutlineEntry,
  type SitePage,
  type SiteText,
} from "./site_book.ts";

type Json = Record<string, unknown>;

const types = { jpeg: "image/jpeg", webp: "image/webp" } as const;

/** Returns the description of a page's picture: its sizes, and no server that computes others. */
export function imageInfo(base: string, index: number, { pixels }: SitePage): Json | null {
  if (!pixels) return null;
  const [width, height] = pixels;
  return {
    "@context": "http://iiif.io/api/image/3/context.json",
    id: `${base}iiif/${index + 1}`,
    type: "ImageService3",
    protocol: "http://iiif.io/api/image",
    profile: "level0",
    ...{ width, height },
    sizes: Array.from({ length: halvings + 1 }, (_, times) => {
      const [width, height] = halved(pixels, halvings - times);
      return { width, height };
    }),
    // One tile is the whole picture, at each size: what a viewer asks for is what there is.
    tiles: [
      { width, height, scaleFactors: Array.from({ length: halvings + 1 }, (_, k) => 2 ** k) },
    ],
  };
}

/** Returns the text of a page as annotations of its canvas, one a line. */
export function textAnnotations(base: string, view: BookView, index: number, text: SiteText): Json {
  const language = view.details.language;
  const page = view.book.pages[index];
  const scale = page?.pixels ? page.pixels[0] / page.width : 1;
  const canvas = `${base}canvas/${index + 1}`;
  const lines = linesOf(text.runs).filter((line) => line.text.trim() !== "");
  return {
    "@context": "http://iiif.io/api/presentation/3/context.json",
    id: `${base}iiif/${index + 1}/text.json`,
    type: "AnnotationPage",
    items: lines.map(({ text, box }, k) => {
      const [left = 0, upper = 0, right = 0, lower = 0] = box.map((side) =>
        Math.max(0, Math.round(scale * side)),
      );
      const size = [Math.max(1, right - left), Math.max(1, lower - upper)];
      return {
        id: `${canvas}/text/${k + 1}`,
        type: "Annotation",
        motivation: "supplementing",
        body: {
          type: "TextualBody",
          value: text.trim(),
          format: "text/plain",
          ...(language === "" ? {} : { language }),
        },
        target: `${canvas}#xywh=${[left, upper, ...size].join(",")}`,
      };
    }),
  };
}

/** Returns the manifest of a book at an address. */
export function manifest(url: string, view: BookView, hasText: (index: number) => boolean): Json {
  const { book, details, id } = view;
  const base = url + bookAddress(id);
  const label = (text: string): Json => ({ [details.language || "none"]: [text] });
  const english = (text: string): Json => ({ en: [text] });
  const licence = details.licence === undefined ? null : parseLicence(details.licence);
  const rights = licence && rightsAddress(licence);
  const row = (name: string, values: readonly string[]): Json[] =>
    values.length > 0 ? [{ label: english(name), value: { none: values } }] : [];
  const cover = details.cover;
  return {
    "@context": "http://iiif.io/api/presentation/3/context.json",
    id: `${base}manifest.json`,
    type: "Manifest",
    label: label(details.title),
    ...(details.description ? { summary: label(details.description) } : {}),
    metadata: [
      ...row("Author", details.authors ?? []),
      ...row("Publisher", details.publisher ? [details.publisher] : []),
      ...row("Date", details.date ? [details.date] : []),
      ...row("Language", details.language ? [details.language] : []),
      ...row("Licence", licence ? [licence.href ?? licence.name] : []),
    ],
    ...(rights ? { rights } : {}),
    ...(licence && !rights
      ? { requiredStatement: { label: english("Licence"), value: { none: [licence.name] } } }
      : {}),
    viewingDirection: details.direction === "rtl" ? "right-to-left" : "left-to-right",
    behavior: ["paged"],
    ...(cover
      ? { thumbnail: [image(base + cover.src, book.format, cover.width, cover.height)] }
      : {}),
    homepage: [{ id: base, type: "Text", label: label(details.title), format: "text/html" }],
    items: book.pages.map((page, index) => canvas(base, book, page, index, hasText(index))),
    ...(book.outline.length > 0 ? { structures: ranges(base, book.outline, label) } : {}),
  };
}

function canvas(
  base: string,
  book: SiteBook,
  page: SitePage,
  index: number,
  hasText: boolean,
): Json {
  const id = `${base}canvas/${index + 1}`;
  const [width, height] = page.pixels ?? [Math.ceil(page.width), Math.ceil(page.height)];
  return {
    id,
    type: "Canvas",
    label: { none: [page.label ?? String(index + 1)] },
    ...{ width, height },
    items: [
      {
        id: `${id}/page`,
        type: "AnnotationPage",
        items: page.pixels ? [painting(base, book, page.pixels, index)] : [],
      },
    ],
    ...(hasText
      ? { annotations: [{ id: `${base}iiif/${index + 1}/text.json`, type: "AnnotationPage" }] }
      : {}),
  };
}

function painting(
  base: string,
  book: SiteBook,
  pixels: readonly [number, number],
  index: number,
): Json {
  const service = { id: `${base}iiif/${index + 1}`, type: "ImageService3", profile: "level0" };
  return {
    id: `${base}canvas/${index + 1}/picture`,
    type: "Annotation",
    motivation: "painting",
    body: {
      ...image(base + pictureAddress(index, pixels, 0, book.format), book.format, ...pixels),
      // A service has JPEG at least.
      ...(book.format === "jpeg" ? { service: [service] } : {}),
    },
    target: `${base}canvas/${index + 1}`,
  };
}

function image(id: string, format: SiteBook["format"], width: number, height: number): Json {
  return { id, type: "Image", format: types[format], width, height };
}

function ranges(
  base: string,
  entries: readonly SiteOutlineEntry[],
  label: (text: string) => Json,
  path = "",
): Json[] {
  return entries.map((entry, k) => {
    const here = path === "" ? `${k + 1}` : `${path}.${k + 1}`;
    const target =
      entry.page === null ? [] : [{ id: `${base}canvas/${entry.page}`, type: "Canvas" }];
    return {
      id: `${base}range/${here}`,
      type: "Range",
      label: label(entry.title),
      items: [...target, ...ranges(base, entry.children, label, here)],
    };
  });
}
