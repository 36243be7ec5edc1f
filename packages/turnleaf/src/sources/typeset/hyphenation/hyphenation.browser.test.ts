/** Words of flowing text are divided at the ends of lines, whether the browser knows their language or not. */

import { afterEach, expect, test } from "vitest";
import { tinyEpub } from "../../epub/tiny_epub.ts";
import { openSource } from "../../open.ts";
import type { FlowSource } from "../flow_source.ts";
import { ownTypography } from "../typography.ts";
import { patternsOf } from "./patterns.ts";

const never = new AbortController().signal;
const open: FlowSource[] = [];

afterEach(() => {
  for (const source of open.splice(0)) source.close();
});

const paragraph =
  "Extraordinary circumstances notwithstanding, international organisations characteristically overestimate administrative responsibilities.";

async function opened(hyphens: "" | "auto" | "none", css = ""): Promise<FlowSource> {
  const chapters = [`<p>${paragraph}</p>`.repeat(60)];
  const source = (await openSource(tinyEpub({ chapters, css }))) as FlowSource;
  open.push(source);
  await source.typeset?.({ ...ownTypography, hyphens, width: 300 });
  await source.settle();
  return source;
}

/** Returns the lines of a page that end within a word. */
async function divided(source: FlowSource): Promise<number> {
  const runs = await source.text(1, never);
  return runs.filter(({ text }) => text.endsWith("\u00ad")).length;
}

test("words are divided if the reader says so, or the book does", async () => {
  const [own, auto] = [await opened(""), await opened("auto")];
  expect(await divided(own)).toBe(0);
  expect(await divided(auto)).toBeGreaterThan(5);
  expect(await divided(await opened("", "p { hyphens: auto }"))).toBeGreaterThan(5);
  expect(await divided(await opened("none", "p { hyphens: auto }"))).toBe(0);
});

test("divided words are found, and anchors name the same text", async () => {
  const [own, auto] = [await opened("none"), await opened("auto")];
  const anchor = own.anchor(own.pageCount >> 1);
  const [page] = await auto.findAnchors([anchor]);
  const words = async (source: FlowSource, index: number): Promise<string> =>
    (await source.text(index, never))
      .map(({ text, end }) => (end && !text.endsWith("\u00ad") ? `${text} ` : text))
      .join("")
      .replaceAll("\u00ad", "");
  const wanted = (await words(own, own.pageCount >> 1)).trim().slice(0, 12);
  const [before, here, after] = await Promise.all(
    [-1, 0, 1].map((k) => words(auto, (page ?? 0) + k)),
  );
  expect(`${here}${after}`).toContain(wanted);
  expect(before).not.toBe("");
  const all = await Promise.all(Array.from({ length: 3 }, (_, k) => words(auto, k)));
  expect(all.join("")).toContain("administrative responsibilities");
});

test("a language has its patterns, whatever its country", () => {
  expect(["en", "en-US", "en-Latn-CA", "en-GB", "EN-au"].map(patternsOf)).toEqual([
    "en-us",
    "en-us",
    "en-us",
    "en-gb",
    "en-gb",
  ]);
  expect(["de-AT", "fr", "pt-BR", "ja", "", "constructor"].map(patternsOf)).toEqual([
    "de",
    "fr",
    "pt",
    null,
    null,
    null,
  ]);
});
