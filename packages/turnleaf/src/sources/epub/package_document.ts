/** A package as foliate-js takes it: what is missing in one item must not fail the book. */

import { limits } from "../limits.ts";
import { BookError } from "../page_source.ts";
import { modernPackage } from "./legacy_package.ts";

/** Elements of a package: foliate-js goes through the manifest for every line of the spine. */
const mostElements = 50_000;

/** Characters of an attribute `prefix`, which foliate-js searches in quadratic time. */
const longestPrefix = 4000;

/** Types of documents that are chapters. */
const chapterTypes = /^(application\/xhtml\+xml|text\/html|text\/x-oeb1-document)$/;

/** The types of files whose media type says nothing of them, by the endings of their names. */
const typesByEnding: readonly (readonly [ending: RegExp, type: string, said: RegExp])[] = [
  [/\.x?html?$/i, "application/xhtml+xml", /html|dtbook|oeb1|svg/],
  [/\.svg$/i, "image/svg+xml", /^image\//],
  [/\.jpe?g$/i, "image/jpeg", /^image\//],
  [/\.(?:png|gif|webp|avif)$/i, "image/", /^image\//],
  [/\.css$/i, "text/css", /css/],
  [/\.ncx$/i, "application/x-dtbncx+xml", /ncx/],
];

/**
 * Checks an XML document of an EPUB, takes out of a package what cannot be read
 * and adds what is missing. Throws a `BookError` if it has too many elements, or no chapter.
 *
 * @param name the book's name in sentences
 * @param names of the files of its archive
 */
export function checkPackage(
  document: Document,
  name: string,
  names: readonly string[] = [],
): Document {
  const most = document.documentElement?.localName === "package" ? mostElements : limits.elements;
  if (document.getElementsByTagName("*").length > most) {
    throw new BookError(`${name} has a list of more than ${most} elements; split it.`, {
      code: "tooLarge",
      source: name,
    });
  }
  if (document.documentElement?.localName !== "package") return document;
  const root = modernPackage(document);
  for (const attribute of [...root.attributes]) {
    if (attribute.localName === "prefix" && attribute.value.length > longestPrefix) {
      root.removeAttributeNode(attribute);
    }
  }
  const [, manifest, spine] = ["metadata", "manifest", "spine"].map((part) => partOf(root, part));
  gather(root, manifest as Element, "item");
  gather(root, spine as Element, "itemref");
  for (const item of (manifest as Element).children) complete(item);
  for (const element of [...document.getElementsByTagNameNS("*", "*")]) {
    const needed = neededAttributes[element.localName] ?? [];
    if (needed.some((attribute) => !element.getAttribute(attribute)?.trim())) element.remove();
  }
  nameApart(manifest as Element, spine as Element);
  listChapters(manifest as Element, spine as Element, names);
  if ((spine as Element).children.length > 0) return document;
  throw new BookError(`${name} has no chapters; get it again.`, { code: "empty", source: name });
}

/** Returns a part of a package, which is added where it is missing, and lies in another where that was not ended. */
function partOf(root: Element, name: string): Element {
  const parts = [...root.getElementsByTagNameNS(root.namespaceURI, name)];
  const part = parts.find((one) => !one.closest("collection"));
  if (part?.parentNode === root) return part;
  return root.appendChild(
    part ?? root.ownerDocument.createElementNS(root.namespaceURI, name),
  ) as Element;
}

/** Moves all lines of a kind into a list: one that was not ended has the next ones in it. */
function gather(root: Element, list: Element, name: string): void {
  const lines = [...root.getElementsByTagNameNS(root.namespaceURI, name)];
  const others = lines.filter((line) => line.parentNode !== list && !line.closest("collection"));
  if (others.length > 0) list.append(...lines.filter((line) => !line.closest("collection")));
}

/** Gives an item of the manifest what it says without need or not at all: blanks, capitals, its media type. */
function complete(item: Element): void {
  const type = item.getAttribute("media-type")?.split(";", 1)[0]?.trim().toLowerCase() ?? "";
  const [path = ""] = (item.getAttribute("href") ?? "").trim().split(/[?#]/, 1);
  const [ending, usual, said] = typesByEnding.find(([one]) => one.test(path)) ?? [];
  // What has a fallback is meant to be of another type.
  const isKnown = !ending || said?.test(type) || item.hasAttribute("fallback");
  const own = usual === "image/" ? `image/${path.split(".").pop()?.toLowerCase()}` : usual;
  item.setAttribute("media-type", isKnown ? type || "application/octet-stream" : (own as string));
  if (!item.getAttribute("id")?.trim()) item.setAttribute("id", `turnleaf-${path}`);
}

/** Gives items of one id ids of their own: of the lines that name it, each means the next of these. */
function nameApart(manifest: Element, spine: Element): void {
  const items = new Map<string, Element[]>();
  for (const item of manifest.children) {
    const id = item.getAttribute("id")?.trim() ?? "";
    const alike = items.get(id) ?? [];
    items.set(id, alike);
    item.setAttribute("id", alike.length === 0 ? id : `${id} ${alike.length}`);
    alike.push(item);
  }
  const named = new Map<string, number>();
  for (const line of spine.children) {
    const id = line.getAttribute("idref")?.trim() ?? "";
    const before = named.get(id) ?? 0;
    named.set(id, before + 1);
    line.setAttribute("idref", items.get(id)?.[before]?.id ?? id);
  }
}

/**
 * Adds the lines of a spine that names no chapter: all that the manifest lists, in its order, or else all
 * that the archive has.
 */
function listChapters(manifest: Element, spine: Element, names: readonly string[]): void {
  const items = [...manifest.children];
  const ids = new Set(items.map(({ id }) => id));
  if ([...spine.children].some((line) => ids.has(line.getAttribute("idref") ?? ""))) return;
  const { ownerDocument, namespaceURI } = manifest;
  const add = (list: Element, name: string, attributes: Readonly<Record<string, string>>) => {
    const element = list.appendChild(ownerDocument.createElementNS(namespaceURI, name));
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  };
  const isChapter = (item: Element): boolean =>
    !/\bnav\b/.test(item.getAttribute("properties") ?? "") &&
    chapterTypes.test(item.getAttribute("media-type") ?? "");
  let chapters = items.filter(isChapter);
  if (chapters.length === 0) {
    const files = names.filter((name) => /\.x?html?$/i.test(name) && !items.some(isChapter));
    chapters = files.slice(0, limits.pages).map((name, k) => {
      const href = `/${name.split("/").map(encodeURIComponent).join("/")}`;
      const type = "application/xhtml+xml";
      return add(manifest, "item", { id: `turnleaf-${k}`, href, "media-type": type });
    });
  }
  for (const { id } of chapters) add(spine, "itemref", { idref: id });
}

/** Attributes without which an element says nothing. */
const neededAttributes: Readonly<Record<string, readonly string[]>> = {
  item: ["id", "href"],
  itemref: ["idref"],
  reference: ["type", "href"],
};
