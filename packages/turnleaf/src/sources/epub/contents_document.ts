/**
 * Contents of an EPUB in the form that foliate-js reads: of a navigation document lists in `nav` alone,
 * directly within each other, and of an NCX lines that all lead somewhere.
 */

import { limits } from "../limits.ts";

const xhtml = "http://www.w3.org/1999/xhtml";
const semantics = "http://www.idpf.org/2007/ops";

/** Lists, and what a line of one leads by. */
const [lists, link] = ["ol, ul", "a[href]"];

/** Gives the contents in a document their form; a document of no contents stays as it is. Returns it. */
export function plainContents(document: Document): Document {
  for (const point of document.querySelectorAll("navPoint, pageTarget, navTarget")) {
    if ([...point.children].some(({ localName }) => localName === "content")) continue;
    point.append(document.createElementNS(point.namespaceURI, "content"));
  }
  const contents = contentsIn(document);
  const list = contents?.querySelector(lists);
  if (!contents || !list) return document;
  const nav = document.createElementNS(xhtml, "nav");
  nav.setAttributeNS(semantics, "epub:type", "toc");
  nav.append(plainList(list));
  contents.replaceWith(nav);
  return document;
}

/** Returns the element that is the contents: that which says so, or else the first that is for navigation. */
function contentsIn(document: Document): Element | undefined {
  const typed = [...document.querySelectorAll("nav, section, div, ol, ul")].filter((element) =>
    /(^|\s)toc(\s|$)/.test(typeOf(element)),
  );
  const isNav = ({ localName }: Element): boolean => localName === "nav";
  const navs = [...document.querySelectorAll("nav")].filter((nav) => typeOf(nav) === "");
  return typed.find(isNav) ?? typed[0] ?? navs[0];
}

function typeOf(element: Element): string {
  return element.getAttributeNS(semantics, "type") ?? element.getAttribute("epub:type") ?? "";
}

/** Returns a list of lines, whatever stands around and between these, with as many levels as contents have. */
function plainList(list: Element, level = 1): Element {
  const { ownerDocument } = list;
  const plain = ownerDocument.createElementNS(xhtml, "ol");
  const isOwn = (line: Element): boolean => line.parentElement?.closest(lists) === list;
  for (const line of [...list.querySelectorAll("li")].filter(isOwn)) {
    const inLine = (found: Element): boolean => found.parentElement?.closest("li") === line;
    const within = [...line.querySelectorAll(lists)].filter(inLine);
    const target = [...line.querySelectorAll(link)].find((one) => one.closest("li") === line);
    const item = plain.appendChild(ownerDocument.createElementNS(xhtml, "li"));
    const title = item.appendChild(ownerDocument.createElementNS(xhtml, target ? "a" : "span"));
    if (target) title.setAttribute("href", target.getAttribute("href") ?? "");
    if (level < limits.outlineDepth) item.append(...within.map((one) => plainList(one, level + 1)));
    for (const one of within) one.remove();
    title.textContent = wordsIn(target ?? line) || wordsIn(line);
  }
  return plain;
}

/** Returns the words of a line, with those that its pictures show, or its title if it has none. */
function wordsIn(line: Element): string {
  for (const image of line.querySelectorAll("img[alt]")) {
    image.replaceWith(image.getAttribute("alt") ?? "");
  }
  const words = line.textContent?.replace(/\s+/g, " ").trim();
  return words || (line.getAttribute("title") ?? "");
}
