/** Chapters of strangers, made harmless: what the markup of a page may be, and nothing else. */

import createPurify from "dompurify";
import { cleanText } from "../book_text.ts";
import { checkBudget } from "../budget.ts";
import { limits } from "../limits.ts";
import { BookError } from "../page_source.ts";
import { trustPolicy } from "../trusted_script.ts";
import {
  type FlowContent,
  type LostPart,
  lostAttribute,
  mediumAttribute,
  mediumKindAttribute,
  sourceAttribute,
  styleAttribute,
} from "../typeset/flow_book.ts";
import {
  type CleanSheet,
  cleanAttribute,
  cleanCss,
  cleanStyleAttribute,
  cssOf,
  inMedia,
  mayLoad,
  type ResolveCss,
  readSheets,
} from "./clean_css.ts";
import { resolveExtensions, resolveSwitches } from "./content_switches.ts";
import { copyUses } from "./external_uses.ts";
import { prepareFormulas } from "./formulas.ts";
import { framePicture, frameSize } from "./frame_picture.ts";
import { styleStandIn } from "./parse_markup.ts";
import { takeContent } from "./take_content.ts";
import { isXmlAttribute } from "./xml.ts";

/** The files that a chapter names. */
export interface MarkupFiles {
  /** How a warning names the chapter's own file; absent if it has none. */
  readonly path?: string;
  /** Returns a picture or a font as `data:`; null if there is none. */
  data(address: string): Promise<string | null>;
  /** Returns a style sheet, already clean, after those that it imports; empty if there is none. */
  style(address: string): Promise<readonly CleanSheet[]>;
  /** Returns how a warning names the file at an address. The default is the address. */
  nameOf?(address: string): string;
  /** Returns whether the browser plays a sound or a film of the book. The default is false. */
  plays?(address: string): boolean;
  /** Returns the document in a frame, already clean; null if there is none. */
  framed?(address: string): Promise<FlowContent | null>;
}

const xhtml = "http://www.w3.org/1999/xhtml";
const svg = "http://www.w3.org/2000/svg";
const namespaces = [xhtml, svg, "http://www.w3.org/1998/Math/MathML"];
const xlink = "http://www.w3.org/1999/xlink";
const semantics = "http://www.idpf.org/2007/ops";

/** Frames of a chapter that are drawn. */
const mostFrames = 20;

/** What is shown in no page. */
const unshown =
  "script, noframes, link, meta, base, iframe, frame, embed, audio, track, source, template";

const purify = createPurify(globalThis.window);
purify.addHook("uponSanitizeAttribute", (element, attribute) => {
  const isAddress = /^(src|href|xlink:href)$/.test(attribute.attrName);
  // Only links lead out of a chapter.
  if (!isAddress || element.localName === "a") return;
  attribute.keepAttr = /^(#|data:)/.test(attribute.attrValue);
});

/**
 * Returns a chapter as clean content. It is parsed already, and changed here.
 * Rejects with a `BookError` if it is too large, or beyond the budget.
 *
 * @param name the chapter's name in sentences
 */
export async function cleanMarkup(
  document: Document,
  files: MarkupFiles,
  name: string,
): Promise<FlowContent> {
  checkElements(document, name);
  resolveSwitches(document, (element, language) => {
    element.before(placeOfLost(element, "embedded", language || "epub:switch", files));
  });
  const root = inHtml(document);
  resolveExtensions(root);
  const sheets = await stylesOf(document, files);
  const styles = sheets.map(cssOf);
  const lost = sheets.flatMap((sheet) => sheet.lost ?? []);
  const picture = async (address: string): Promise<string | null> => {
    const data = await files.data(address);
    const source = files.nameOf?.(address) ?? address;
    if (data === null && lost.length < limits.warnings) lost.push({ code: "image", source });
    return data;
  };
  // Nothing on paper opens them.
  for (const one of root.querySelectorAll("details")) one.setAttribute("open", "");
  for (const one of root.querySelectorAll('[hidden="until-found" i]'))
    one.removeAttribute("hidden");
  prepareFormulas(root);
  for (const medium of root.querySelectorAll("audio, video")) placeOf(medium, files);
  for (const object of root.querySelectorAll("object, embed")) await pictureOf(object, files);
  for (const frame of [...root.querySelectorAll("iframe")].slice(0, mostFrames)) {
    await drawFrame(frame, files);
  }
  for (const element of root.querySelectorAll("iframe, frame")) {
    const address = element.getAttribute("src") ?? "";
    if (address !== "") element.before(placeOfLost(element, "embedded", address, files));
  }
  await copyUses(
    root,
    async (address) => (await files.framed?.(address).catch(() => null))?.root ?? null,
    (use, address) => {
      const drawing = use.closest("svg") ?? use;
      drawing.before(placeOfLost(drawing, "image", address, files));
    },
  );
  placeScripted(root, files);
  await inlinePictures(root, files);
  for (const element of root.querySelectorAll(unshown)) element.remove();
  for (const element of [root, ...root.querySelectorAll("*")]) {
    if (!element.hasAttributes()) continue;
    const meaning = element.getAttribute("epub:type");
    if (meaning !== null) element.setAttributeNS(semantics, "epub:type", meaning);
    const language = element.getAttribute("xml:lang");
    if (language !== null && !element.hasAttribute("lang")) element.setAttribute("lang", language);
    element.removeAttribute("style");
    if (element.hasAttribute(styleAttribute)) await cleanStyle(element, picture);
    for (const attribute of [...element.attributes]) {
      if (!isXmlAttribute(attribute)) element.removeAttributeNode(attribute);
    }
    for (const attribute of [...element.attributes].filter(mayLoad)) {
      const clean = await cleanAttribute(attribute, picture);
      if (clean === null) element.removeAttributeNode(attribute);
      else attribute.value = clean;
    }
  }
  purify.sanitize(root, {
    IN_PLACE: true,
    WHOLE_DOCUMENT: true,
    ADD_TAGS: ["use", "foreignobject", "html", "body", "head"],
    ADD_ATTR: ["epub:type", "role", "xml:lang", "xlink:href"],
    HTML_INTEGRATION_POINTS: { "annotation-xml": true, foreignobject: true },
    FORBID_TAGS: ["style", "title"],
    // Addresses of pictures that are not looked up.
    FORBID_ATTR: ["background", "poster", "srcset"],
    SANITIZE_DOM: false,
    ...(trustPolicy() ? { TRUSTED_TYPES_POLICY: trustPolicy() as never } : {}),
  });
  await checkBudget(root, styles, name);
  return { root, styles, lost };
}

/**
 * Returns the root as an `<html>` with one `<body>`, its elements without prefixes and in small letters. Those
 * of other languages of markup among the text, whose text browsers show, become elements that mean nothing;
 * those of none are HTML's.
 */
function inHtml(document: Document): Element {
  let root = document.documentElement;
  for (const element of [...document.getElementsByTagName("*")]) {
    const { namespaceURI: own, prefix, parentElement } = element;
    const isKnown = namespaces.includes(own ?? "");
    const localName = own === xhtml ? element.localName.toLowerCase() : element.localName;
    const isPlain = prefix === null && localName === element.localName;
    if (isKnown ? isPlain : parentElement?.namespaceURI !== xhtml) continue;
    const plain = isKnown
      ? document.createElementNS(own, localName)
      : document.createElementNS(xhtml, own === null ? localName : "span");
    for (const { namespaceURI, name, value } of element.attributes) {
      const plainName = localName === element.localName ? name : name.toLowerCase();
      if (!name.startsWith("xmlns")) plain.setAttributeNS(namespaceURI, plainName, value);
    }
    plain.append(takeContent(element));
    element.replaceWith(plain);
    if (element === root) root = plain as HTMLElement;
  }
  keepText(root);
  if (root.localName === "html") {
    const head = root.querySelector(":scope > head");
    const body = root.querySelector(":scope > body") ?? document.createElementNS(xhtml, "body");
    const contents = document.createDocumentFragment();
    for (const node of [...root.childNodes]) {
      if (node !== head) contents.append(isBody(node) ? takeContent(node as Element) : node);
    }
    body.append(contents);
    root.replaceChildren(...(head ? [head] : []), body);
  } else {
    const html = document.createElementNS(xhtml, "html");
    const body = document.createElementNS(xhtml, "body");
    root.replaceWith(html);
    body.append(root);
    html.append(body);
    root = html as HTMLElement;
  }
  root.querySelector(":scope > head > title")?.remove();
  return root;
}

const isBody = ({ nodeName }: Node): boolean => nodeName === "body" || nodeName === "BODY";

/** Puts elements and text that are kept in place of those that mean the same and would be left out with their text. */
function keepText(root: Element): void {
  const { ownerDocument } = root;
  const data = ownerDocument.createTreeWalker(root, NodeFilter.SHOW_CDATA_SECTION);
  const sections: CharacterData[] = [];
  while (data.nextNode()) sections.push(data.currentNode as CharacterData);
  for (const section of sections) section.replaceWith(section.data);
  // No script runs.
  for (const other of root.querySelectorAll("noscript")) other.replaceWith(takeContent(other));
  // The text of a marquee would run.
  for (const old of root.querySelectorAll("xmp, plaintext, listing, marquee")) {
    const name = old.localName === "marquee" ? "div" : "pre";
    const kept = ownerDocument.createElementNS(xhtml, name);
    kept.append(takeContent(old));
    old.replaceWith(kept);
  }
}

/** Returns a document's style sheets in order, cleaned. */
async function stylesOf(document: Document, files: MarkupFiles): Promise<readonly CleanSheet[]> {
  const sheets: (() => Promise<readonly CleanSheet[]>)[] = [];
  for (const node of document.childNodes) {
    if (!(node instanceof ProcessingInstruction) || node.target !== "xml-stylesheet") continue;
    const href = /href\s*=\s*["']([^"']+)/.exec(node.data)?.[1];
    if (href) sheets.push(() => files.style(href));
  }
  let preferred = "";
  for (const element of document.querySelectorAll(`${styleStandIn}, link[rel][href]`)) {
    const [media = "", type = "", title = ""] = ["media", "type", "title"].map((name) =>
      element.getAttribute(name)?.trim(),
    );
    const relations = element.getAttribute("rel")?.toLowerCase().split(/\s+/) ?? [];
    const isOther = !relations.includes("stylesheet") || relations.includes("alternate");
    if (element.localName === "link" && (isOther || element.hasAttribute("disabled"))) continue;
    // Of sheets that have titles, those of the first are the document's; others are for readers to choose.
    preferred ||= title;
    if (!/^$|css/i.test(type) || (title !== "" && title !== preferred)) continue;
    if (element.localName !== "link") {
      sheets.push(async () => {
        const css = element.textContent ?? "";
        return inMedia([await cleanCss(css, (to) => files.data(to), files.nameOf)], media);
      });
      continue;
    }
    const href = element.getAttribute("href") ?? "";
    sheets.push(async () => inMedia(await files.style(href), media));
  }
  return await readSheets(sheets);
}

/** Returns an element that takes no place where something cannot be shown. */
function placeOfLost(
  element: Element,
  code: LostPart["code"],
  address: string,
  files: Pick<MarkupFiles, "nameOf">,
): Element {
  const place = element.ownerDocument.createElementNS(xhtml, "span");
  place.setAttribute(lostAttribute, code);
  place.setAttribute(sourceAttribute, files.nameOf?.(address) ?? address);
  return place;
}

/**
 * Puts in place of a sound or a film where it is played, or else a film's
 * poster, or what stands there without it.
 */
function placeOf(medium: Element, files: MarkupFiles): void {
  const isFilm = medium.localName === "video";
  const sources = [medium, ...medium.querySelectorAll(":scope > source")];
  const addresses = sources.map((source) => source.getAttribute("src") ?? "");
  const address = addresses.find((one) => one !== "" && files.plays?.(one));
  const poster = isFilm ? medium.getAttribute("poster") : null;
  const listed = addresses.find((one) => one !== "");
  if (!address && listed) medium.before(placeOfLost(medium, "medium", listed, files));
  if (!address && !poster) {
    if (isFilm) medium.replaceWith(...medium.querySelectorAll(":scope > :not(source, track)"));
    return;
  }
  // A sound without controls is not seen.
  if (!isFilm && !medium.hasAttribute("controls")) return;
  const place = medium.ownerDocument.createElementNS(xhtml, poster ? "img" : "span");
  for (const name of ["id", "title", "width", "height", styleAttribute]) {
    const value = medium.getAttribute(name);
    if (value !== null) place.setAttribute(name, value);
  }
  const own = poster ? "" : isFilm ? "turnleaf-film" : "turnleaf-sound";
  place.setAttribute("class", `${medium.getAttribute("class") ?? ""} ${own}`.trim());
  if (poster) place.setAttribute("src", poster);
  else if (isFilm) {
    const { width, height } = frameSize(medium);
    place.setAttribute(
      styleAttribute,
      `width: ${width}px; height: ${height}px; ${place.getAttribute(styleAttribute) ?? ""}`,
    );
  }
  if (address) {
    place.setAttribute(mediumAttribute, address);
    place.setAttribute(mediumKindAttribute, isFilm ? "video" : "audio");
  }
  medium.replaceWith(place);
}

/**
 * No script runs: puts what stands in a canvas in its place, and says what is not there of one in which nothing
 * stands, or of a chapter in which nothing else is.
 */
function placeScripted(root: Element, files: MarkupFiles): void {
  const scripts = [...root.querySelectorAll("script")];
  const address = scripts.findLast((one) => one.getAttribute("src"))?.getAttribute("src");
  const script = address ? (files.nameOf?.(address) ?? address) : "script";
  // By its chapter too: many draw by the same script.
  const source = files.path ? `${files.path} (${script})` : script;
  const lostIn = (element: Element): Element => placeOfLost(element, "embedded", source, {});
  for (const canvas of root.querySelectorAll("canvas")) {
    if (isBlank(canvas)) canvas.before(lostIn(canvas));
    canvas.replaceWith(takeContent(canvas));
  }
  const body = root.querySelector("body") ?? root;
  if (scripts.length > 0 && isBlank(body)) body.prepend(lostIn(body));
}

/** Returns whether an element shows neither text nor a picture, nor says what it cannot show. */
function isBlank(element: Element): boolean {
  if (element.querySelector(`img, image, svg, math, hr, audio, video, [${lostAttribute}]`)) {
    return false;
  }
  const texts = element.ownerDocument.createTreeWalker(element, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { nodeValue, parentElement } = texts.currentNode;
    if (nodeValue?.trim() && !parentElement?.matches("script, style, template")) return false;
  }
  return true;
}

/** Puts an embedded object's picture in its place, as large as it is, or what stands there without it. */
async function pictureOf(object: Element, files: MarkupFiles): Promise<void> {
  const address = object.getAttribute(object.localName === "embed" ? "src" : "data") ?? "";
  const data = await files.data(address);
  if (data?.startsWith("data:image/")) {
    const image = object.ownerDocument.createElementNS(xhtml, "img");
    for (const name of [
      "id",
      "class",
      "title",
      "width",
      "height",
      "hspace",
      "vspace",
      "align",
      styleAttribute,
    ]) {
      const value = object.getAttribute(name);
      if (value !== null) image.setAttribute(name, value);
    }
    const words = object.textContent?.trim() || object.getAttribute("aria-label");
    if (words) image.setAttribute("alt", cleanText(words, limits.altLength));
    image.setAttribute("src", data);
    object.replaceWith(image);
    return;
  }
  // What stands there in its place is what the book gives for it.
  const hasOther =
    object.querySelector("img, object, svg, audio, video, math") ?? object.textContent?.trim();
  if (address !== "" && !hasOther) object.before(placeOfLost(object, "embedded", address, files));
  object.replaceWith(takeContent(object));
}

/** Puts a picture of a frame in its place. */
async function drawFrame(frame: Element, files: MarkupFiles): Promise<void> {
  const content = await files.framed?.(frame.getAttribute("src") ?? "").catch(() => null);
  if (!content) return;
  const size = frameSize(frame);
  const image = frame.ownerDocument.createElementNS(xhtml, "img");
  for (const name of ["id", "class", styleAttribute]) {
    if (frame.hasAttribute(name)) image.setAttribute(name, frame.getAttribute(name) ?? "");
  }
  image.setAttribute("width", String(size.width));
  image.setAttribute("height", String(size.height));
  image.setAttribute(
    "alt",
    content.root.textContent?.trim() || (frame.getAttribute("title") ?? ""),
  );
  image.setAttribute("src", await framePicture(content, size));
  frame.replaceWith(image);
}

/** Addresses of one picture that are tried: as many as an author gives for screens of several kinds. */
const mostAddresses = 20;

/** Returns the addresses of a picture's file: its own, then those that are given for some screens, as they may be all there is. */
function addressesOf(image: Element): readonly string[] {
  const linked = image.getAttributeNS(xlink, "href");
  const own = image.getAttribute("src") ?? image.getAttribute("href") ?? linked ?? "";
  const { parentElement } = image;
  const others = parentElement?.localName === "picture" ? parentElement.children : [];
  const sets = [image, ...others].map((one) => one.getAttribute("srcset") ?? "");
  const addresses = [own, ...sets.flatMap(candidatesOf)].filter((address) => address.trim() !== "");
  return addresses.slice(0, mostAddresses);
}

/** Returns the addresses in a `srcset`, as browsers read it: after each there is a comma, or what it is for up to one. */
function candidatesOf(srcset: string): readonly string[] {
  const addresses: string[] = [];
  let rest = srcset.replace(/^[\s,]+/, "");
  while (rest !== "" && addresses.length < mostAddresses) {
    const length = rest.search(/\s/);
    let address = length < 0 ? rest : rest.slice(0, length);
    rest = rest.slice(address.length);
    if (!address.endsWith(",")) {
      const comma = rest.indexOf(",");
      rest = comma < 0 ? "" : rest.slice(comma);
    }
    while (address.endsWith(",")) address = address.slice(0, -1);
    addresses.push(address);
    rest = rest.replace(/^[\s,]+/, "");
  }
  return addresses;
}

async function inlinePictures(root: Element, files: MarkupFiles): Promise<void> {
  for (const image of root.querySelectorAll("img, image, input[src]")) {
    const addresses = addressesOf(image);
    for (const name of ["src", "srcset", "sizes", "href", "loading"]) image.removeAttribute(name);
    image.removeAttributeNS(xlink, "href");
    let [given = ""] = addresses;
    if (given === "") continue;
    let data = await files.data(given);
    for (const other of addresses.slice(1)) {
      if (data !== null) break;
      data = await files.data(other);
      if (data !== null) given = other;
    }
    // One that is there may still turn out to be damaged.
    image.setAttribute(sourceAttribute, files.nameOf?.(given) ?? given);
    if (data === null) image.setAttribute(lostAttribute, "image");
    else image.setAttribute(image.localName === "image" ? "href" : "src", data);
  }
}

/** Cleans a style attribute. */
async function cleanStyle(element: Element, picture: ResolveCss): Promise<void> {
  const own = element.getAttribute(styleAttribute) ?? "";
  const clean = own === "" ? "" : await cleanStyleAttribute(own, picture);
  if (clean === "") element.removeAttribute(styleAttribute);
  else element.setAttribute(styleAttribute, clean);
}

/**
 * Checks that a document does not have more elements than are read.
 *
 * @param name the document's name in sentences
 *
 * @throws BookError if it has
 */
export function checkElements(document: Document, name: string): void {
  if (document.getElementsByTagName("*").length <= limits.elements) return;
  throw new BookError(`${name} has more than ${limits.elements} elements; split it.`, {
    code: "tooLarge",
    source: name,
  });
}
