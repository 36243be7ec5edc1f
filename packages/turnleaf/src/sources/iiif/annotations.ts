/** What annotations of a canvas say: its text, links on it and notes about it. */

import { cleanRun } from "../book_text.ts";
import { isPageBox, limits } from "../limits.ts";
import type { PageBox, PageLink, TextRun } from "../page_source.ts";
import { type CanvasPage, canvasOf, targetBox } from "./presentation.ts";
import {
  addressOf,
  idOf,
  objectsIn,
  plain,
  referencesIn,
  stringsIn,
  textIn,
  typeOf,
  type Value,
} from "./values.ts";

/** Lines that a page has at least where a text is of all of it, and letters of its longest. */
const leastLines = 30;
const longestLine = 90;

/** Types of bodies that hold a text. */
const textual = /^(TextualBody|ContentAsText)$/;

/** Returns the annotations in a page of them; undefined if it is known by its address alone. */
export function annotationsIn(list: Value): unknown {
  return list.items ?? list.resources;
}

/**
 * Returns the runs of text that pages of annotations have on a page, in their order. A text of all of the
 * page stands on it line by line, if nothing says where its lines are.
 */
export function textOn(page: CanvasPage, lists: readonly Value[]): TextRun[] {
  const runs: TextRun[] = [];
  const ofAll: string[] = [];
  let letters = 0;
  for (const annotation of annotationsOf(lists).filter(isTranscript)) {
    const lines = linesOf(annotation);
    const box = boxOn(page, annotation);
    if (box === "all") ofAll.push(...lines);
    const text = lines.join(" ");
    if (typeof box === "string" || text === "") continue;
    letters += text.length;
    if (runs.length >= limits.runs || letters > limits.textLength) break;
    runs.push({ ...box, text, angle: 0, end: true });
  }
  return runs.length > 0 ? runs : overPage(page, ofAll);
}

/** Returns the links and notes that pages of annotations have on a page, and the notes about all of it. */
export function linksOn(
  page: CanvasPage,
  lists: readonly Value[],
  number: number,
  numbers: ReadonlyMap<string, number>,
  base: string,
): { readonly links: readonly PageLink[]; readonly aboutAll: readonly string[] } {
  const links: PageLink[] = [];
  const aboutAll: string[] = [];
  for (const annotation of annotationsOf(lists).slice(0, limits.annotations)) {
    if (isTranscript(annotation)) continue;
    const box = boxOn(page, annotation);
    if (box === "elsewhere") continue;
    const note = linesOf(annotation).join("\n").slice(0, limits.noteLength);
    const to = targetOf(annotation, numbers, base);
    if (box === "all") {
      if (note !== "") aboutAll.push(note);
    } else if (to !== null) links.push({ ...box, title: note || textIn(annotation.label, []), to });
    else if (note !== "") links.push({ ...box, title: "", to: { page: number }, note });
  }
  return { links, aboutAll };
}

/** Returns transcripts in lists whose texts are at addresses of their own. */
export function farTexts(lists: readonly Value[]): Value[] {
  return annotationsOf(lists).filter((one) => isTranscript(one) && farText(one) !== null);
}

/** Returns the address of an annotation's text and its media type, if it is not in it. */
export function farText(
  annotation: Value,
): { readonly body: Value; readonly format: string } | null {
  const bodies = bodiesOf(annotation);
  const body = bodies.find((one) => /^(Text|Dataset)$/.test(typeOf(one)) && idOf(one) !== "");
  if (body === undefined || bodies.some((one) => textual.test(typeOf(one)))) return null;
  return { body, format: stringsIn(body.format)[0] ?? "" };
}

function annotationsOf(lists: readonly Value[]): Value[] {
  return lists.flatMap((list) => objectsIn(annotationsIn(list) ?? []));
}

function bodiesOf(annotation: Value): Value[] {
  return referencesIn(annotation.body ?? annotation.resource ?? [], 5);
}

/** Returns the page or address to which an annotation links; null if it is no link. */
function targetOf(
  annotation: Value,
  numbers: ReadonlyMap<string, number>,
  base: string,
): PageLink["to"] | null {
  if (!stringsIn(annotation.motivation).some((one) => /^(oa:)?linking$/.test(one))) return null;
  for (const body of bodiesOf(annotation)) {
    const page = numbers.get(canvasOf(body));
    if (page !== undefined) return { page };
    const href = addressOf(body, base);
    if (href !== "" && !textual.test(typeOf(body))) return { href };
  }
  return null;
}

/** Returns where on a page an annotation is: in a box, on all of its canvas, or not on it. */
function boxOn({ canvas, part, inSpread }: CanvasPage, one: Value): PageBox | "all" | "elsewhere" {
  const target = one.target ?? one.on;
  const box = targetBox(target, canvas);
  // Of two halves the first has what is said of both.
  if (!box) return isWhole(target) && inSpread !== "second" ? "all" : "elsewhere";
  const middle = box.x + box.width / 2;
  if (middle < part.x || middle >= part.x + part.width) return "elsewhere";
  const on = { ...box, x: box.x - part.x, y: box.y - part.y };
  return isPageBox(on) ? on : "elsewhere";
}

/** Returns whether a target is a canvas, and no part of one. */
function isWhole(target: unknown): boolean {
  const [whole] = referencesIn(target ?? [], 1);
  if (whole === undefined || "selector" in whole) return false;
  return !idOf(whole.source ?? whole.full ?? whole).includes("#");
}

/** Returns lines that stand one beneath the other on a page. */
function overPage({ part }: CanvasPage, texts: readonly string[]): TextRun[] {
  const lines = texts.flatMap(broken).slice(0, limits.runs);
  const height = part.height / Math.max(lines.length, leastLines);
  const [x, width] = [0.05 * part.width, 0.9 * part.width];
  return lines.map((text, k) => ({
    ...{ x, y: k * height, height },
    width: width * Math.min(text.length / longestLine, 1),
    ...{ text, angle: 0, end: true },
  }));
}

/** Breaks a line between words. */
function broken(line: string): string[] {
  const lines: string[] = [];
  for (const word of line.split(/\s+/)) {
    const last = lines.at(-1);
    const longer = `${last} ${word}`;
    if (last !== undefined && longer.length <= longestLine) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

/** Returns whether an annotation says what stands on the canvas, rather than something about it. */
function isTranscript(annotation: Value): boolean {
  return stringsIn(annotation.motivation).some((one) =>
    /^(sc:)?(supplementing|painting)$/.test(one),
  );
}

/** Returns the lines of an annotation's text. */
function linesOf(annotation: Value): string[] {
  const body = objectsIn(bodiesOf(annotation)).find((one) => textual.test(typeOf(one)));
  const [text = ""] = stringsIn(body?.value ?? body?.chars);
  const [format = ""] = stringsIn(body?.format);
  return linesIn(text.slice(0, limits.textLength), format);
}

/** Returns the lines of a text that have words. */
function linesIn(text: string, format: string): string[] {
  const isHtml = format === "text/html";
  const ended = isHtml ? text.replace(/<\/?(?:br|p|div|li|h\d)\b[^<>]*>/gi, "\n") : text;
  return ended
    .split(/[\r\n]+/)
    .map((line) => cleanRun(isHtml ? plain(line) : line).trim())
    .filter((line) => line !== "");
}
