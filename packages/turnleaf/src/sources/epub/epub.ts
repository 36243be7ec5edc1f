/** EPUB 2 and 3: a package of chapters, read by foliate-js and set by `FlowSource`. */

import { EPUB, type ManifestItem, type TocItem } from "foliate-js/epub.js";
import type { Archive } from "../archive/archive.ts";
import { FilePaths } from "../archive/file_paths.ts";
import { folderOf } from "../archive/folder_archive.ts";
import { cleanLanguage, cleanText, decodeEscapes } from "../book_text.ts";
import { unknownFailure } from "../failures.ts";
import { limits } from "../limits.ts";
import { loadPart } from "../load_part.ts";
import { type MarkupType, parseMarkup } from "../markup/parse_markup.ts";
import { readMarkup } from "../markup/read_markup.ts";
import {
  type BookDetail,
  BookError,
  type BookWarning,
  type BookWarningCode,
  type PageSize,
  type PageSource,
  type Typography,
} from "../page_source.ts";
import type {
  FlowBook,
  FlowContent,
  FlowNarration,
  FlowOutline,
  FlowSection,
  FlowTarget,
} from "../typeset/flow_book.ts";
import { FlowSource } from "../typeset/flow_source.ts";
import { coverSection } from "../typeset/lone_picture.ts";
import { linesIn } from "../typeset/page_estimate.ts";
import { isRightToLeft } from "../typeset/writing_direction.ts";
import { warningOf } from "../warnings.ts";
import { type Chapter, loadChapter, sizeIn } from "./chapter.ts";
import { folderOfEpub, packageOf } from "./container.ts";
import { plainContents } from "./contents_document.ts";
import { coverOf } from "./cover.ts";
import { EpubFiles } from "./epub_files.ts";
import { dublinCore } from "./legacy_package.ts";
import { NamedFiles } from "./named_files.ts";
import { fontDecoder } from "./obfuscated_fonts.ts";
import { checkPackage } from "./package_document.ts";

/** Types of chapters. */
const readableTypes =
  /^(application\/(xhtml\+xml|x-dtbook\+xml)|text\/(html|x-oeb1-document)|image\/(svg\+xml|png|jpeg|gif|webp|avif))$/;

/** Types that are read where there is nothing better: pictures that few browsers show, and XML of any kind as a web page. */
const otherTypes = /^(image\/.+|application\/xml)$/;

/** Types of pictures that may have several pages. */
const pagedType = /^image\/(x-)?tiff?$/;

/** Fallbacks of a chapter, each of another. */
const mostFallbacks = 10;

/** Names of authors that are shown. */
const mostCreators = 20;

/** Opens an EPUB. Rejects with a `BookError`. */
export async function openEpub(
  archive: Archive,
  file: Blob,
  name: string,
  typography?: Typography,
): Promise<PageSource> {
  try {
    const book = folderOf(archive, folderOfEpub(archive.names));
    return await FlowSource.open(await readEpub(book, file, name), typography);
  } catch (error) {
    archive.close();
    throw unknownFailure(`${name} is damaged or no EPUB`, error, "repair it or get it again", {
      code: "damaged",
      source: name,
    });
  }
}

async function readEpub(archive: Archive, file: Blob, name: string): Promise<FlowBook> {
  const names = new Set(archive.names);
  const paths = new FilePaths(archive.names);
  const plain = new EpubFiles(archive, async () => {});
  const packagePath = await packageOf(archive);
  if (packagePath === null)
    throw new BookError(`${name} has no package (.opf); get it again.`, {
      code: "damaged",
      source: name,
    });
  const named = new NamedFiles(paths);
  const wellFormed = async (path: string): Promise<string> => {
    const isNavigation = /\.x?html?$/i.test(path);
    const type = isNavigation ? "application/xhtml+xml" : "application/xml";
    return (await readMarkup(await plain.text(path), type)).text;
  };
  // foliate-js reads one document after the other, and parses each before the next.
  let reading = "";
  const epub = new EPUB({
    loadText: async (path) => {
      reading = named.nameOf(path);
      if (path === containerPath) return containerOf(named.markOf(packagePath));
      return names.has(reading) ? await wellFormed(reading) : null;
    },
    loadBlob: async (path) => new Blob([await archive.read(named.nameOf(path))]),
    getSize: (path) => archive.size(named.nameOf(path)),
  });
  epub.parser = {
    parseFromString: (text, type) => {
      const document = checkPackage(parseMarkup(text, type as MarkupType), name, archive.names);
      return plainContents(named.mark(document, reading));
    },
  };
  await epub.init();
  const { resources, rendition, metadata, toc } = epub;
  const listed = resources.manifest.map((item) => ({ ...item, href: named.nameOf(item.href) }));
  // Of several of one name the first counts.
  const items = new Map(listed.map((item) => [item.id, item] as const).reverse());
  const fallbacks = new Map(
    [...resources.opf.getElementsByTagNameNS("*", "item")]
      .map((element) => [element.id, element.getAttribute("fallback")] as const)
      .reverse(),
  );
  const protection = names.has("META-INF/encryption.xml")
    ? (await readMarkup(await plain.text("META-INF/encryption.xml"), "application/xml")).document
    : null;
  const decoder = await fontDecoder(protection, epub, paths);
  if (decoder.isProtected(resources.spine.map(({ idref }) => items.get(idref)?.href ?? ""))) {
    throw new BookError(
      `${name} is protected against copying (DRM); open it in its shop's reader.`,
      { code: "copyProtected", source: name },
    );
  }
  const manifest = { items, fallbacks };
  const byPath = new Map(listed.map((item) => [item.href, item]));
  const version = Number.parseFloat(resources.opf.documentElement.getAttribute("version") ?? "");
  const files = new EpubFiles(archive, decoder.decode, {
    // EPUB 3 forbids to show what is not listed; books from before it often list less than they have.
    isListed: (path) => byPath.has(path) || !(version >= 3),
    typeOf: (path) => byPath.get(path)?.mediaType ?? "",
    shownFor: (path) => {
      const item = byPath.get(path);
      return item ? pictureFor(manifest, item) : path;
    },
  });
  const isRoll = rendition.layout === "roll";
  const isFixedBook = isRoll || rendition.layout === "pre-paginated";
  const language = cleanLanguage([metadata.language].flat()[0]);
  const isOpen = epub.dir !== "ltr" && epub.dir !== "rtl";
  const direction = epub.dir === "rtl" || (isOpen && isRightToLeft(language)) ? "rtl" : "ltr";
  const listedChapters = resources.spine
    .slice(0, limits.pages)
    .flatMap(({ idref, linear, properties = [] }) => {
      const found = withFallbacks(manifest, idref);
      const readable = readableItem(found.filter(({ href }) => names.has(href)));
      const missing = readable ? "" : missingChapter(found[0], idref, names, name);
      const item = readable ?? found[0] ?? { id: idref, href: "", mediaType: "" };
      const has = (word: string): boolean =>
        properties.some((one) => one === word || one === `rendition:${word}`);
      // The first of several counts.
      const own = properties.find((one) => /^rendition:layout-/.test(one));
      const isFixed = own && !isRoll ? own === "rendition:layout-pre-paginated" : isFixedBook;
      const flow = isRoll ? "scrolled-continuous" : isFixed ? "" : flowOf(has, rendition.flow);
      const side = isRoll ? undefined : sideOf(has, isFixed);
      const listedAs = found[0]?.href ?? "";
      return [{ ...item, listedAs, missing, isFixed, isAside: linear === "no", side, flow }];
    });
  const chapters = await withPagesOfPictures(listedChapters, files);
  // What is beside the way of reading comes last; but a cover before all of it is the first page.
  const start = Math.max(
    chapters.findIndex((one) => !one.isAside),
    0,
  );
  const rest = chapters.slice(start);
  const ordered = [
    ...chapters.slice(0, start),
    ...rest.filter((one) => !one.isAside),
    ...rest.filter((one) => one.isAside),
  ];
  if (ordered.every(({ missing }) => missing !== "")) {
    const sentence = ordered[0]?.missing ?? `${name} has no chapters; get it again.`;
    throw new BookError(sentence, { code: "empty", source: name });
  }
  const first = rollsOf(ordered)[0] === undefined ? ordered[0] : undefined;
  const isReadable = first?.missing === "" && !first.isFixed;
  const title = cleanText(textOf(metadata.title)) || name;
  const picture = pictureNamed(manifest, resources.cover, names);
  const cover = isFixedBook
    ? null
    : await coverOf(title, isReadable ? first : null, picture, files, (path) => archive.size(path));
  if (cover && !cover.isFirst) {
    const about = { listedAs: "", missing: "", isAside: false, side: undefined, flow: "", page: 0 };
    ordered.unshift({ id: "", ...cover.chapter, ...about });
  }
  const rolls = rollsOf(ordered);
  const usualSize = usualSizeOf(resources.opf);
  const sections = ordered.map((chapter, index): FlowSection => {
    const { href, missing, isFixed, side } = chapter;
    const load = async (): Promise<FlowContent> => {
      if (missing !== "") {
        const code = names.has(href) ? "unsupported" : "damaged";
        throw new BookError(missing, { code, source: cleanText(href) || chapter.id });
      }
      return await loadChapter(files, chapter, name, usualSize);
    };
    if (cover && index === 0) {
      return coverSection(() => loadChapter(files, { ...cover.chapter, isFixed: false }, name));
    }
    const roll = rolls[index];
    const where = { ...(side ? { side } : {}), ...(roll === undefined ? {} : { roll }) };
    const lines = async (): Promise<number> =>
      /^image\/(?!svg)/.test(chapter.mediaType) ? 0 : linesIn(await plain.text(href));
    return { length: archive.size(href), isFixed, lines, load, ...where };
  });
  const indices = new Map<string, number>();
  // A chapter that comes twice is the first one for links.
  ordered.forEach(({ href, listedAs }, index) => {
    // So is one that is shown in place of another.
    for (const one of [href, listedAs]) if (!indices.has(one)) indices.set(one, index);
  });
  const targetOf = (address: string, from: string): FlowTarget | null => {
    const [path = "", id = ""] = address.split("#", 2);
    const target = path === "" ? from : files.resolve(path, from);
    const section = indices.get(target ?? "");
    return section === undefined ? null : { section, id: decodeEscapes(id) };
  };
  const targetOfMark = (address: string): FlowTarget | null => {
    const [mark = "", id = ""] = address.split("#", 2);
    const section = indices.get(named.nameOf(mark));
    return section === undefined ? null : { section, id: decodeEscapes(id) };
  };
  const overlays = ordered.flatMap(({ mediaOverlay }) => {
    const path = mediaOverlay ? items.get(mediaOverlay)?.href : undefined;
    return path !== undefined && names.has(path) ? [path] : [];
  });
  const readMedium = async (path: string, kind: RegExp): Promise<Blob> => {
    const type = byPath.get(path)?.mediaType ?? "";
    if (!kind.test(type)) {
      throw new BookError(`${path} in ${name} is no recording; get the book again.`, {
        code: "damaged",
        source: path,
      });
    }
    return new Blob([await archive.read(path)], { type });
  };
  const narration = (): FlowNarration => ({
    ...overlayClassesOf(resources.opf),
    clips: async () => {
      const { clipsOf } = await loadPart(import("./media_overlays.ts"));
      const book = {
        name,
        text: (path: string) => files.text(path),
        resolve: (address: string, from: string) => files.resolve(address, from),
        target: targetOf,
      };
      return await clipsOf(book, overlays);
    },
    recording: (path) => readMedium(path, /^audio\//),
  });
  const outline = (items: readonly TocItem[] | null | undefined): FlowOutline[] =>
    (items ?? []).map(({ label, href, subitems }) => {
      const target = href ? targetOfMark(href) : null;
      const isLost = Boolean(href) && target === null;
      return { title: cleanText(label) || "–", target, isLost, children: outline(subitems) };
    });
  return {
    name,
    title,
    titleDirection:
      directionOf(resources.opf.getElementsByTagNameNS(dublinCore, "title")[0], resources.opf) ??
      "auto",
    language,
    direction,
    ...layoutOf(rendition.spread, isFixedBook),
    ...(isFixedBook ? {} : { cover: cover ? "picture" : "stamped" }),
    details: creatorsOf(resources.opf),
    sections,
    outline: outline(toc),
    warnings: listed
      .filter(({ href }) => !names.has(href))
      .flatMap((item) => missingFile(item, paths.nameOf(item.href, packagePath), name)),
    // A book may be by anybody, and was not found by following links.
    asksToLeave: true,
    ...(overlays.length > 0 ? { narration: narration() } : {}),
    resolve: (section, href) => targetOf(href, ordered[section]?.href ?? ""),
    medium: async (section, address) => {
      const path = files.resolve(address, ordered[section]?.href ?? "");
      return await readMedium(path ?? address, /^(audio|video)\//);
    },
    file: async () => new Blob([file], { type: "application/epub+zip" }),
    close: () => archive.close(),
  };
}

/**
 * Returns chapters with a chapter for each page of those that are TIFFs of several pages, at most `limits.pages`.
 * Where one is to lie is where its first page does.
 */
async function withPagesOfPictures<T extends Pick<ManifestItem, "href" | "mediaType">>(
  chapters: readonly (T & Side)[],
  files: EpubFiles,
): Promise<(T & Side & { readonly page: number })[]> {
  const found: (T & Side & { readonly page: number })[] = [];
  for (const chapter of chapters) {
    const count = pagedType.test(chapter.mediaType) ? await files.pagesOf(chapter.href) : 1;
    for (let page = 0; page < count && found.length < limits.pages; page++) {
      found.push({ ...chapter, page, side: page === 0 ? chapter.side : undefined });
    }
  }
  return found;
}

/** Returns the picture that a package names as its cover, if the archive has it; null if not. */
function pictureNamed(
  manifest: Manifest,
  cover: ManifestItem | null | undefined,
  names: ReadonlySet<string>,
): Chapter | null {
  const found = cover ? withFallbacks(manifest, cover.id) : [];
  const picture = found.find(
    ({ href, mediaType }) =>
      readableTypes.test(mediaType) && /^image\//.test(mediaType) && names.has(href),
  );
  return picture ? { ...picture, isFixed: true } : null;
}

/** Where a chapter has to lie, as `FlowSection` says it. */
interface Side {
  readonly side: FlowSection["side"] | undefined;
}

/** The path of a container, and one that names a package. */
const containerPath = "META-INF/container.xml";
const containerOf = (path: string): string =>
  `<container xmlns="urn:oasis:names:tc:opendocument:xmlns:container"><rootfiles><rootfile full-path="${path}" media-type="application/oebps-package+xml"/></rootfiles></container>`;

/** Returns a sentence that says why a chapter of the spine cannot be shown. */
function missingChapter(
  item: ManifestItem | undefined,
  id: string,
  names: ReadonlySet<string>,
  name: string,
): string {
  const [what, about] = [cleanText(item?.href ?? id), "get the book again."];
  if (!item) return `${name} has a chapter “${what}” of which it names no file; ${about}`;
  if (!names.has(item.href)) return `${what}, a chapter of ${name}, is missing in it; ${about}`;
  return `${what}, a chapter of ${name}, is of a type that is not read (${cleanText(item.mediaType)}); ${about}`;
}

/** Returns a warning of a file that a manifest lists and the archive does not have, if it is to be seen or heard. */
function missingFile({ mediaType }: ManifestItem, path: string, name: string): BookWarning[] {
  const code = warningCodes.find(([type]) => type.test(mediaType))?.[1];
  return code === undefined ? [] : [warningOf(code, path, name)];
}

/** The codes of warnings by the media types of files. Chapters say themselves that they are missing. */
const warningCodes: readonly (readonly [type: RegExp, code: BookWarningCode])[] = [
  [/^image\//i, "image"],
  [/^(audio|video)\/|^application\/smil/i, "medium"],
  [/^text\/css$/i, "style"],
  [/^font\/|font|opentype/i, "font"],
];

/** A book's manifest by the ids of its items. */
interface Manifest {
  readonly items: ReadonlyMap<string, ManifestItem>;
  /** The ids of fallbacks. */
  readonly fallbacks: ReadonlyMap<string, string | null>;
}

/** Returns an item of the manifest and its fallbacks, in order. */
function withFallbacks({ items, fallbacks }: Manifest, id: string): ManifestItem[] {
  const found: ManifestItem[] = [];
  let next: string | null | undefined = id;
  while (next && found.length < mostFallbacks) {
    const item = items.get(next);
    if (!item) break;
    found.push(item);
    next = fallbacks.get(item.id);
  }
  return found;
}

/** Returns the first of an item of the spine and its fallbacks that can be read as it is meant. */
function readableItem(items: readonly ManifestItem[]): ManifestItem | undefined {
  const readable = items.filter(({ mediaType }) => readableTypes.test(mediaType));
  const needsNoScript = ({ properties = [] }: ManifestItem): boolean =>
    !properties.includes("scripted");
  return (
    readable.find(needsNoScript) ??
    readable[0] ??
    items.find(({ mediaType }) => otherTypes.test(mediaType))
  );
}

/** Returns the path of a picture, or of the first of its fallbacks that browsers show. */
function pictureFor(manifest: Manifest, item: ManifestItem): string {
  const isShown = /^image\/(svg\+xml|png|jpeg|gif|webp|avif)$/;
  const shown = withFallbacks(manifest, item.id).find(({ mediaType }) => isShown.test(mediaType));
  return shown?.href ?? item.href;
}

/** Returns the direction of an element of the metadata: its own, or else the package's. */
function directionOf(element: Element | undefined, opf: Document): "ltr" | "rtl" | undefined {
  const named = element?.getAttribute("dir") ?? opf.documentElement.getAttribute("dir");
  return named === "ltr" || named === "rtl" ? named : undefined;
}

/** Returns the classes of what is read aloud, by which a book styles it. */
function overlayClassesOf(opf: Document): Pick<FlowNarration, "activeClass" | "playbackClass"> {
  const named = (property: string): string => {
    const metas = [...opf.getElementsByTagNameNS("*", "meta")];
    const meta = metas.find((one) => one.getAttribute("property") === `media:${property}`);
    return /^\s*(\S{1,100})\s*$/.exec(meta?.textContent ?? "")?.[1] ?? "";
  };
  return { activeClass: named("active-class"), playbackClass: named("playback-active-class") };
}

/** Returns the size that a package gives pages of fixed layout that name none; null if it gives none. */
function usualSizeOf(opf: Document): PageSize | null {
  for (const meta of opf.getElementsByTagNameNS("*", "meta")) {
    const name = meta.getAttribute("property") ?? meta.getAttribute("name") ?? "";
    if (!/^(rendition:viewport|original-resolution)$/i.test(name)) continue;
    const size = sizeIn(meta.getAttribute("content") ?? meta.textContent ?? "");
    if (size) return size;
  }
  return null;
}

/** Returns who made a book, in the package's order. */
function creatorsOf(opf: Document): BookDetail[] {
  return [...opf.getElementsByTagNameNS(dublinCore, "creator")]
    .slice(0, mostCreators)
    .map((element) => {
      const direction = directionOf(element, opf);
      const value = cleanText(element.textContent);
      return { label: "", value, ...(direction ? { direction } : {}) };
    })
    .filter(({ value }) => value !== "");
}

/** Returns how what does not fit a page of a chapter is shown: as it says itself, or else as the book says. */
function flowOf(has: (word: string) => boolean, flow: string | undefined): string | undefined {
  const flows = ["auto", "paginated", "scrolled-doc", "scrolled-continuous"];
  return flows.find((one) => has(`flow-${one}`)) ?? flow;
}

/**
 * Returns the roll of each chapter that is scrolled: of its own, or, if it is to
 * be continuous, that of the chapter before it.
 */
function rollsOf(
  chapters: readonly { readonly flow: string | undefined; readonly isAside: boolean }[],
): (number | undefined)[] {
  let rolls = 0;
  return chapters.map(({ flow, isAside }, index) => {
    const before = chapters[index - 1];
    if (flow !== "scrolled-doc" && flow !== "scrolled-continuous") return undefined;
    const goesOn = flow === "scrolled-continuous" && before?.flow === flow;
    if (!goesOn || isAside !== before.isAside) rolls += 1;
    return rolls - 1;
  });
}

/** Returns where a chapter has to lie; of fixed layout it may be meant to be shown by itself. */
function sideOf(has: (word: string) => boolean, isFixed: boolean): FlowSection["side"] {
  if (has("page-spread-left")) return "left";
  if (has("page-spread-right")) return "right";
  return isFixed && (has("page-spread-center") || has("spread-none")) ? "center" : undefined;
}

/**
 * Returns the layout that a book asks for. In flowing text `both` leaves the
 * choice to the space there is, as the other values do: two columns of it in a
 * narrow window could not be read.
 */
function layoutOf(spread: unknown, isFixed: boolean): Pick<FlowBook, "layout"> {
  if (spread === "none") return { layout: "single" };
  return spread === "both" && isFixed ? { layout: "spread" } : {};
}

/** Returns a title's text: foliate-js gives it by languages if it has several. */
function textOf(title: unknown): string {
  if (typeof title === "string") return title;
  const first = typeof title === "object" && title !== null ? Object.values(title)[0] : "";
  return typeof first === "string" ? first : "";
}
