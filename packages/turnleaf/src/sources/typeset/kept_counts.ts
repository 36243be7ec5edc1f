/**
 * The numbers of pages of a book's sections as text, to be kept until the book is opened again: set alike,
 * it has the same ones. The text begins with a hash of what they depend on.
 */

import type { Typography } from "../page_source.ts";
import type { FlowSection } from "./flow_book.ts";

/** Letters of a text that is kept: those of some 500 sections. */
const longest = 2000;

/** Returns the text that keeps each section's number of pages; undefined if it is too long to be kept. */
export function keptCounts(
  sections: readonly FlowSection[],
  typography: Typography,
  counts: readonly number[],
): string | undefined {
  const text = [hashOf(sections, typography), ...counts].join(".");
  return text.length > longest ? undefined : text;
}

/** Returns the numbers that a text keeps, at least 1; null if it is not of these sections, set so. */
export function readCounts(
  text: string,
  sections: readonly FlowSection[],
  typography: Typography,
): number[] | null {
  if (text.length > longest || !/^\w+(?:\.[1-9]\d{0,5})+$/.test(text)) return null;
  const [hash, ...counts] = text.split(".");
  const isOwn = hash === hashOf(sections, typography) && counts.length === sections.length;
  return isOwn ? counts.map(Number) : null;
}

/** Returns a hash (FNV-1a) of the lengths of sections and of how they are set. */
function hashOf(sections: readonly FlowSection[], typography: Typography): string {
  const what = JSON.stringify([sections.map(({ length }) => length), typography]);
  let hash = 0x811c9dc5;
  for (let at = 0; at < what.length; at++) {
    hash = Math.imul(hash ^ what.charCodeAt(at), 0x01000193);
  }
  return (hash >>> 0).toString(36);
}
