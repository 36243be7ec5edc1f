/** Pages are drawn in their own colours, or the reader's, whatever colours the system forces upon its windows. */

import { afterEach, expect, test } from "vitest";
import { pixels } from "../for_tests/picture_measures.ts";
import { toolSession } from "../for_tests/real_mouse.ts";
import { fonts, line } from "../for_tests/text_books.ts";
import { coloursOf } from "../themes.ts";
import { prose, tinyEpub } from "./epub/tiny_epub.ts";
import { openSource } from "./open.ts";
import type { PageColours, PageSource } from "./page_source.ts";
import { tinyPdf } from "./tiny_pdf.ts";

const never = new AbortController().signal;

/** Has the system force colours, of a scheme; null for none. */
const force = (scheme: "light" | "dark" | null) =>
  toolSession().send("Emulation.setEmulatedMedia", {
    features: [
      { name: "forced-colors", value: scheme ? "active" : "none" },
      { name: "prefers-contrast", value: scheme ? "more" : "" },
      { name: "prefers-color-scheme", value: scheme ?? "" },
    ],
  });

afterEach(() => force(null));

/** Books, each with some words of its own: a browser draws no picture anew that it has drawn. */
const books: Record<string, (words: string) => File> = {
  "an e-book": (words) => {
    const chapters = [`<p style="color: #000; background: #fff">${words}</p>${prose(6)}`];
    return new File([tinyEpub({ chapters })], "book.epub");
  },
  text: (words) => new File([`${words}\n\n${"Words of a text. ".repeat(60)}`], "book.txt"),
  "a PDF": (words) => {
    const pages = [line(words, 200) + line("Some years ago", 170)];
    return new File([tinyPdf({ pages, resources: fonts })], "book.pdf");
  },
};

/** Returns the lightness of paper, 0 to 255, of the darkest and lightest places of a book's first page, and its foot. */
async function tones(
  source: PageSource,
  colours: PageColours | null,
): Promise<[paper: number, darkest: number, lightest: number, foot: readonly number[]]> {
  const { data } = pixels(await source.draw(0, 400, never, undefined, colours));
  const greens = data.filter((_, k) => k % 4 === 1);
  // The paper is what most of a page is.
  const sorted = [...greens].toSorted((a, b) => a - b);
  const foot = greens.slice(0.92 * greens.length);
  return [sorted[sorted.length >> 1] ?? 0, sorted[0] ?? 0, sorted.at(-1) ?? 0, [...foot]];
}

test.each(Object.keys(books))("%s has its own paper and ink in contrast themes", async (name) => {
  for (const theme of ["light", "night"] as const) {
    for (const scheme of [null, "light", "dark"] as const) {
      await force(scheme);
      expect(matchMedia("(forced-colors: active)").matches).toBe(scheme !== null);
      const source = await openSource(books[name]?.(`${theme} ${scheme}`) as File);
      const [paper, darkest, lightest, foot] = await tones(source, coloursOf(theme, ""));
      // A PDF is darkened once it is drawn.
      const isDark = theme === "night" && name !== "a PDF";
      expect(paper).toBe(isDark ? 0x1b : 255);
      if (isDark) expect(lightest).toBeGreaterThan(180);
      else expect(darkest).toBeLessThan(60);
      // Its number.
      if (isDark) expect(Math.max(...foot)).toBeGreaterThan(90);
      else if (name !== "a PDF") expect(Math.min(...foot)).toBeLessThan(150);
      source.close();
    }
  }
});
