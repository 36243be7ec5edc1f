/**
 * Media overlays of an EPUB: which part of which recording is the sound of which
 * element (https://www.w3.org/TR/epub-33/#sec-media-overlays). The code is
 * loaded when such a book is first read aloud.
 */

import { limits } from "../limits.ts";
import { readMarkup } from "../markup/read_markup.ts";
import { BookError } from "../page_source.ts";
import type { FlowClip, FlowTarget } from "../typeset/flow_book.ts";
import { checkPackage } from "./package_document.ts";

/** Seconds of each unit of a clock value. */
const units: Readonly<Record<string, number>> = { h: 3600, min: 60, s: 1, ms: 0.001, "": 1 };

/** What is needed of the book that overlays belong to. */
export interface OverlaidBook {
  /** The book's name in sentences. */
  readonly name: string;
  /** Returns the text of an overlay. Rejects with a `BookError`. */
  text(path: string): Promise<string>;
  /** Returns the path of an address in an overlay; null if the book lists no such file. */
  resolve(address: string, from: string): string | null;
  /** Returns where an address in an overlay leads; null if that is in no chapter. */
  target(address: string, from: string): FlowTarget | null;
}

/**
 * Returns what overlays have read aloud, in order. Rejects with a `BookError`
 * if one is no XML or has too many elements.
 *
 * @param paths of the overlays, in the order in which their chapters are read
 */
export async function clipsOf(
  book: OverlaidBook,
  paths: readonly string[],
): Promise<readonly FlowClip[]> {
  const clips: FlowClip[] = [];
  for (const path of new Set(paths)) {
    const { document, damagedLine } = await readMarkup(await book.text(path), "application/xml");
    if (damagedLine !== undefined) {
      throw new BookError(`${path} in ${book.name} is damaged; get the book again.`, {
        code: "damaged",
        source: path,
      });
    }
    checkPackage(document, `${path} in ${book.name}`);
    // Sequences are of structure alone: their parts are read in the document's order.
    for (const part of document.getElementsByTagNameNS("*", "par")) {
      const clip = clipOf(book, part, path);
      if (clip && clips.length < limits.clips) clips.push(clip);
    }
  }
  return clips;
}

/** Returns what a part of an overlay has read; null if nothing. */
function clipOf(book: OverlaidBook, part: Element, path: string): FlowClip | null {
  const child = (name: string): Element | undefined =>
    [...part.children].find(({ localName }) => localName === name);
  const target = book.target(child("text")?.getAttribute("src") ?? "", path);
  if (target === null) return null;
  const audio = child("audio");
  const begin = secondsOf(audio?.getAttribute("clipBegin")) ?? 0;
  const end = secondsOf(audio?.getAttribute("clipEnd")) ?? Number.POSITIVE_INFINITY;
  // A part of no length says that nothing is read.
  if (end <= begin) return null;
  const recording = audio ? book.resolve(audio.getAttribute("src") ?? "", path) : null;
  return audio && recording === null ? null : { target, recording, begin, end };
}

/**
 * Returns the seconds of a SMIL clock value, such as "0:01:24.3", "01:24.3",
 * "84.3s" or "1.4min"; null if it is none.
 */
export function secondsOf(value: string | null | undefined): number | null {
  const text = value?.trim() ?? "";
  const clock = /^(?:(\d{1,6}):)?(\d{1,2}):(\d{1,2}(?:\.\d{1,9})?)$/.exec(text);
  if (clock) return 3600 * Number(clock[1] ?? 0) + 60 * Number(clock[2]) + Number(clock[3]);
  const [, count, unit = ""] = /^(\d{1,9}(?:\.\d{1,9})?)(h|min|s|ms)?$/.exec(text) ?? [];
  return count === undefined ? null : Number(count) * (units[unit] ?? 1);
}
