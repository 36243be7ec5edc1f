/** Parts of drawings that are in another file of the book (`<use href="icons.svg#star">`): copied, as nothing is fetched where a page is drawn. */

import { limits } from "../limits.ts";

const svg = "http://www.w3.org/2000/svg";
const xlink = "http://www.w3.org/1999/xlink";

/** The ids of parts of the same drawing in an address, and in any other attribute. */
const inAddress = /^\s*#(.+)/g;
const inValue = /url\(\s{0,9}["']?#([^"')]{1,200})/g;

/** Returns what finds ids in an attribute's value. */
const idsOf = ({ localName }: Attr): RegExp => (localName === "href" ? inAddress : inValue);

/** Files of which parts are used by one chapter, at most; and parts to which one refers, one after another. */
const mostFiles = 50;
const mostParts = 500;

/** Another file of a book, of which a chapter uses parts. */
interface UsedFile {
  /** Its markup; null if there is none. */
  readonly root: Element | null;
  /** What the ids of its parts begin with in the chapter. */
  readonly prefix: string;
  /** Parts with those to which they refer, as they are found. */
  readonly parts: Map<Element, readonly Element[]>;
}

/**
 * Copies what drawings use of other files into them.
 *
 * @param load returns the markup in the file at an address, clean; null if there is none
 * @param lose says that the part of another file that an element uses cannot be shown
 */
export async function copyUses(
  root: Element,
  load: (address: string) => Promise<Element | null>,
  lose: (use: Element, address: string) => void,
): Promise<void> {
  const files = new Map<string, UsedFile>();
  let left: number = limits.elements;
  for (const use of root.querySelectorAll("use")) {
    const address = (use.getAttribute("href") ?? use.getAttributeNS(xlink, "href") ?? "").trim();
    if (address === "" || address.startsWith("#")) continue;
    const [path = "", id = ""] = address.split("#");
    if (!files.has(path) && files.size < mostFiles) {
      const prefix = `turnleaf-use-${files.size}-`;
      files.set(path, { root: await load(path), prefix, parts: new Map() });
    }
    const file = files.get(path);
    const drawing = use.closest("svg");
    const part = file?.root ? partOf(file.root, decoded(id)) : null;
    const parts = file?.root && part ? (file.parts.get(part) ?? partsFor(part, file.root)) : [];
    if (part) file?.parts.set(part, parts);
    left -= parts.reduce((sum, one) => sum + one.getElementsByTagName("*").length + 1, 0);
    if (!file || !drawing || parts.length === 0 || left < 0) {
      lose(use, address);
      continue;
    }
    const definitions = root.ownerDocument.createElementNS(svg, "defs");
    for (const one of parts) definitions.append(copyOf(one, file.prefix, definitions));
    // The same parts may have been copied for another of its elements.
    const isThere = (one: Element): boolean =>
      drawing.querySelector(`[id="${CSS.escape(one.id)}"]`) !== null;
    for (const one of [...definitions.children]) if (isThere(one)) one.remove();
    drawing.prepend(definitions);
    use.removeAttributeNS(xlink, "href");
    use.setAttribute("href", `#${file.prefix}${part?.id}`);
  }
}

function decoded(id: string): string {
  try {
    return decodeURIComponent(id);
  } catch {
    return id;
  }
}

/** Returns the part of a file that has an id; without an id its drawing, which has one from then on. */
function partOf(root: Element, id: string): Element | null {
  if (id !== "")
    return root.querySelector(`svg [id="${CSS.escape(id)}"], svg[id="${CSS.escape(id)}"]`);
  const drawing = root.querySelector("svg");
  if (drawing && drawing.id === "") drawing.id = "turnleaf-whole";
  return drawing;
}

/** Returns a part of a file, and those to which it refers and that are not in it; none where those are too many. */
function partsFor(part: Element, root: Element): readonly Element[] {
  const parts = new Set([part]);
  for (const one of parts) {
    for (const id of idsIn(one)) {
      const other = root.querySelector(`[id="${CSS.escape(id)}"]`);
      const isWithin = other === null || [...parts].some((known) => known.contains(other));
      if (!isWithin && !other.contains(part)) parts.add(other);
      if (parts.size > mostParts) return [];
    }
  }
  return [...parts];
}

/** Returns the ids to which a part of a drawing refers. */
function idsIn(part: Element): readonly string[] {
  const all = [part, ...part.querySelectorAll("*")].flatMap(({ attributes }) => [...attributes]);
  return all.flatMap((attribute) =>
    [...attribute.value.matchAll(idsOf(attribute))].map(([, id = ""]) => id.trim()),
  );
}

/** Returns a copy of a part whose ids, and references to them, have a prefix. */
function copyOf(part: Element, prefix: string, { ownerDocument }: Element): Element {
  const copy = ownerDocument.importNode(part, true);
  for (const element of [copy, ...copy.querySelectorAll("*")]) {
    for (const attribute of element.attributes) {
      if (attribute.localName === "id") attribute.value = prefix + attribute.value;
      else if (attribute.value.includes("#")) {
        attribute.value = attribute.value.replace(idsOf(attribute), (found) =>
          found.replace("#", `#${prefix}`),
        );
      }
    }
  }
  return copy;
}
