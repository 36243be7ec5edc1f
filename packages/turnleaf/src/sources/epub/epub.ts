/** EPUB 2 and 3: a package of chapters, read by foliate-js and set by `FlowSource`. */

import { EPUB, type ManifestItem, type TocItem } from "foliate-js/epub.js";
import type { Archive } from "../archive/archive.ts";
import { cleanLanguage, cleanText, decodeEscapes } from "../book_text.ts";
import { unknownFailure } from "../failures.ts";
import { isPageSize, limits } from "../limits.ts";
import { cleanMarkup } from "../markup/clean_markup.ts";
import { isBroken, type MarkupType, parseMarkup } from "../markup/parse_markup.ts";
import { BookError, type PageSize, type PageSource, type Typography } from "../page_source.ts";
import type {
  FlowBook,
  FlowContent,
  FlowOutline,
  FlowSection,
  FlowTarget,
} from "../typeset/flow_book.ts";
import { FlowSource } from "../typeset/flow_source.ts";
import { EpubFiles } from "./epub_files.ts";
import { fontDecoder } from "./obfuscated_fonts.ts";
import { checkPackage } from "./package_document.ts";

/** Types of chapters. */
const readableTypes =
  /^(application\/(xhtml\+xml|xml|x-dtbook\+xml)|text\/(html|x-oeb1-document)|image\/(svg\+xml|png|jpeg|gif|webp|avif))$/;

/** Fallbacks of a chapter, each of another. */
const mostFallbacks = 10;

/** The size of a page of fixed layout that does not say it. */
const usualSize: PageSize = { width: 768, height: 1024 };

/** Opens an EPUB. Rejects with a `BookError`. */
export async function openEpub(
  archive: Archive,
  file: Blob,
  name: string,
  typography?: Typography,
): Promise<PageSource> {
  try {
    return await FlowSource.open(await readEpub(archive, file, name), typography);
  } catch (error) {
    archive.close();
    throw unknownFailure(`${name} is damaged or no EPUB`, error, "repair it or get it again");
  }
}

async function readEpub(archive: Archive, file: Blob, name: string): Promise<FlowBook> {
  const names = new Set(archive.names);
  const plain = new EpubFiles(archive, async () => {});
  const epub = new EPUB({
    loadText: async (path) => (names.has(path) ? await plain.text(path) : null),
    loadBlob: async (path) => new Blob([await archive.read(path)]),
    getSize: (path) => archive.size(path),
  });
  epub.parser = {
    parseFromString: (text, type) => checkPackage(parseMarkup(text, type as MarkupType), name),
  };
  await epub.init();
  const { resources, rendition, metadata, toc } = epub;
  // Of several of one name the first counts.
  const items = new Map(resources.manifest.map((item) => [item.id, item] as const).reverse());
  const fallbacks = new Map(
    [...resources.opf.getElementsByTagNameNS("*", "item")]
      .map((element) => [element.id, element.getAttribute("fallback")] as const)
      .reverse(),
  );
  const protection = names.has("META-INF/encryption.xml")
    ? parseMarkup(await plain.text("META-INF/encryption.xml"), "application/xml")
    : null;
  const decoder = await fontDecoder(protection, epub);
  if (decoder.isProtected(resources.spine.map(({ idref }) => items.get(idref)?.href ?? ""))) {
    throw new BookError(
      `${name} is protected against copying (DRM); open it in its shop's reader.`,
    );
  }
  const listed = new Set(resources.manifest.map(({ href }) => href));
  const files = new EpubFiles(archive, decoder.decode, (path) => listed.has(path));
  const isFixedBook = rendition.layout === "pre-paginated";
  const direction = epub.dir === "rtl" ? "rtl" : "ltr";
  const chapters = resources.spine
    .slice(0, limits.pages)
    .flatMap(({ idref, linear, properties = [] }) => {
      const item = readableItem(items, fallbacks, idref);
      if (!item || !names.has(item.href)) return [];
      const has = (word: string): boolean =>
        properties.some((one) => one === word || one === `rendition:${word}`);
      const isFixed = has("layout-pre-paginated") || (isFixedBook && !has("layout-reflowable"));
      return [{ ...item, isFixed, isAside: linear === "no", side: sideOf(has) }];
    });
  // What is beside the way of reading comes last.
  const ordered = [
    ...chapters.filter((one) => !one.isAside),
    ...chapters.filter((one) => one.isAside),
  ];
  if (ordered.length === 0) throw new BookError(`${name} has no chapters; get it again.`);
  const sections = ordered.map((chapter): FlowSection => {
    const { href, isFixed, side, mediaType } = chapter;
    const load = (): Promise<FlowContent> => loadChapter(files, href, mediaType, isFixed, name);
    return { length: archive.size(href), isFixed, load, ...(side ? { side } : {}) };
  });
  const indices = new Map<string, number>();
  // A chapter that comes twice is the first one for links.
  ordered.forEach(({ href }, index) => {
    if (!indices.has(href)) indices.set(href, index);
  });
  const targetOf = (address: string, from: string): FlowTarget | null => {
    const [path = "", id = ""] = address.split("#", 2);
    const target = path === "" ? from : files.resolve(path, from);
    const section = indices.get(target ?? "");
    return section === undefined ? null : { section, id: decodeEscapes(id) };
  };
  const outline = (items: readonly TocItem[] | null | undefined): FlowOutline[] =>
    (items ?? []).map(({ label, href, subitems }) => ({
      title: cleanText(label) || "–",
      // foliate-js gives paths from the archive's root.
      target: href ? targetOf(encodeURI(href), "") : null,
      children: outline(subitems),
    }));
  return {
    name,
    title: cleanText(textOf(metadata.title)) || name,
    language: cleanLanguage([metadata.language].flat()[0]),
    direction,
    sections,
    outline: outline(toc),
    resolve: (section, href) => targetOf(href, ordered[section]?.href ?? ""),
    file: async () => new Blob([file], { type: "application/epub+zip" }),
    close: () => archive.close(),
  };
}

/** Returns an item of the manifest, or the first of its fallbacks that can be read. */
function readableItem(
  items: ReadonlyMap<string, ManifestItem>,
  fallbacks: ReadonlyMap<string, string | null>,
  id: string,
): ManifestItem | undefined {
  let next: string | null | undefined = id;
  for (let left = mostFallbacks; next && left > 0; left--) {
    const item = items.get(next);
    if (!item || readableTypes.test(item.mediaType)) return item;
    next = fallbacks.get(item.id);
  }
  return undefined;
}

async function loadChapter(
  files: EpubFiles,
  path: string,
  mediaType: string,
  isFixed: boolean,
  name: string,
): Promise<FlowContent> {
  const document = await parseChapter(files, path, mediaType);
  const size = isFixed ? fixedSize(document) : undefined;
  const content = await cleanMarkup(document, files.about(path), `A chapter of ${name}`);
  return size ? { ...content, size } : content;
}

/** Parses a chapter; one that is no XML is read as browsers read web pages. */
async function parseChapter(files: EpubFiles, path: string, mediaType: string): Promise<Document> {
  if (/^image\/(?!svg)/.test(mediaType)) {
    const picture = `<img src="${encodeURI(path.split("/").pop() ?? "")}" alt=""/>`;
    return parseMarkup(`<html><body>${picture}</body></html>`, "text/html");
  }
  const text = await files.text(path);
  const type = mediaType === "image/svg+xml" ? mediaType : "application/xhtml+xml";
  const document = parseMarkup(text, type);
  return isBroken(document) ? parseMarkup(text, "text/html") : document;
}

/** Returns the size of a page of fixed layout: by its viewport, or that of its drawing. */
function fixedSize(document: Document): PageSize {
  const viewport = document.querySelector('meta[name="viewport"]')?.getAttribute("content") ?? "";
  const number = (key: string): number =>
    Number.parseFloat(new RegExp(`\\b${key}\\s*=\\s*([\\d.]+)`).exec(viewport)?.[1] ?? "");
  const named = { width: number("width"), height: number("height") };
  if (isPageSize(named)) return named;
  const svg = document.querySelector("svg");
  const [, , width = 0, height = 0] = (svg?.getAttribute("viewBox") ?? "")
    .split(/[\s,]+/)
    .map(Number);
  if (isPageSize({ width, height })) return { width, height };
  const own = {
    width: Number.parseFloat(svg?.getAttribute("width") ?? ""),
    height: Number.parseFloat(svg?.getAttribute("height") ?? ""),
  };
  return isPageSize(own) ? own : usualSize;
}

function sideOf(has: (word: string) => boolean): "left" | "right" | undefined {
  if (has("page-spread-left")) return "left";
  return has("page-spread-right") ? "right" : undefined;
}

/** Returns a title's text: foliate-js gives it by languages if it has several. */
function textOf(title: unknown): string {
  if (typeof title === "string") return title;
  const first = typeof title === "object" && title !== null ? Object.values(title)[0] : "";
  return typeof first === "string" ? first : "";
}
