/** The parts of `turnleaf publish` that work on texts alone. */

import { describe, expect, it } from "vitest";
import { escapeText, html } from "../src/html.ts";
import { parseLicence, rightsAddress } from "../src/publish/licence.ts";
import { linesOf, paragraphsOf } from "../src/publish/page_text.ts";
import { searchWords } from "../src/publish/search_words.ts";
import type { SiteRun } from "../src/publish/site_book.ts";
import { parseTermFile, termFileOf, termFiles } from "../src/publish/term_lists.ts";

describe("words of a text", () => {
  it.each([
    ["Call me Ishmael.", ["call", "me", "ishmael"]],
    ["Don’t—it's CAFÉ, naïve STRASSE", ["dont", "its", "cafe", "naive", "strasse"]],
    ["Straße ﬁne ½", ["strasse", "fine", "1", "2"]],
    ["東京都 is 42", ["東京", "京都", "is", "42"]],
    ["本", ["本"]],
    ["Мёд и мед", ["мед", "и", "мед"]],
    [" — … ’ ", []],
  ])("%s", (text, words) => {
    expect(searchWords(text)).toEqual(words);
  });
});

describe("lists by terms", () => {
  const terms = Array.from({ length: 20_000 }, (_, k) => `word${(k * 7919) % 20_000}`);
  const lists = new Map(terms.map((term, k) => [term, [k, k + 3, k + 1000]]));
  const files = termFiles(lists);
  const index = JSON.parse(files.get("index.json") ?? "");

  it("are in files of bounded size, in which every term is found", () => {
    expect(files.size).toBeGreaterThan(5);
    for (const text of files.values()) expect(text.length).toBeLessThan(50_000);
    for (const [name, text] of files) {
      if (name === "index.json") continue;
      for (const [term, numbers] of parseTermFile(text)) {
        expect(`${termFileOf(index, term)}.json`).toBe(name);
        expect(numbers).toEqual(lists.get(term));
      }
    }
  });

  it("do not depend on the order in which they were made", () => {
    expect(termFiles(new Map([...lists].reverse()))).toEqual(files);
  });

  it("have no file for a term before the first, and none at all if empty", () => {
    expect(termFileOf(index, "a")).toBe(-1);
    expect([...termFiles(new Map())]).toEqual([["index.json", '{"first":[]}\n']]);
  });
});

describe("paragraphs of a page", () => {
  const line = (text: string, x: number, y: number, flags = 1): SiteRun => [
    text,
    x,
    y,
    200,
    10,
    0,
    flags,
  ];

  it("join lines and words that a line's end divides", () => {
    const runs = [
      line("a meadow of shadi-", 10, 10),
      line("est trees, well-", 10, 22),
      line("Known", 10, 34),
    ];
    expect(paragraphsOf(runs)).toEqual(["a meadow of shadiest trees, well-Known"]);
  });

  it("begin at an indent, a gap and another column", () => {
    const runs = [
      ...[line("one ", 10, 10, 0), line("line", 60, 10), line("more", 10, 22)],
      ...[line("indented", 20, 34), line("goes on", 10, 46), line("after a gap", 10, 70)],
      line("next column", 220, 10),
    ];
    expect(paragraphsOf(runs)).toEqual([
      ...["one line more", "indented goes on", "after a gap", "next column"],
    ]);
  });

  it("consist of lines in upright boxes, whatever way they run", () => {
    const down: SiteRun = ["down", 50, 10, 40, 10, Math.PI / 2, 1];
    const [across, turned] = linesOf([line("one ", 10, 10, 0), line("line", 60, 11), down]);
    expect(across).toMatchObject({ text: "one line", box: [10, 10, 260, 21] });
    expect(turned?.box.map(Math.round)).toEqual([40, 10, 50, 50]);
  });

  it("have no space between lines of Chinese and Japanese", () => {
    expect(paragraphsOf([line("我輩は", 10, 10), line("猫である", 10, 22)])).toEqual([
      "我輩は猫である",
    ]);
  });
});

describe("licences", () => {
  it.each([
    ["CC-BY-4.0", "CC BY 4.0", "http://creativecommons.org/licenses/by/4.0/"],
    ["cc-by-nc-sa-3.0", "CC BY-NC-SA 3.0", "http://creativecommons.org/licenses/by-nc-sa/3.0/"],
    ["CC0", "CC0 1.0", "http://creativecommons.org/publicdomain/zero/1.0/"],
    ["Public domain", "Public domain", "http://creativecommons.org/publicdomain/mark/1.0/"],
    [
      "https://creativecommons.org/licenses/by-sa/4.0/deed.de",
      "CC BY-SA 4.0",
      "http://creativecommons.org/licenses/by-sa/4.0/deed.de",
    ],
    [
      "http://rightsstatements.org/vocab/InC/1.0/",
      "rightsstatements.org/vocab/InC/1.0",
      "http://rightsstatements.org/vocab/InC/1.0/",
    ],
    ["https://example.org/terms", "example.org/terms", null],
    ["All rights reserved", "All rights reserved", null],
    ["javascript:alert(1)", "javascript:alert(1)", null],
  ])("%s", (given, name, rights) => {
    const licence = parseLicence(given);
    expect([licence.name, rightsAddress(licence)]).toEqual([name, rights]);
  });
});

it("markup escapes every value, in text and in attributes", () => {
  const evil = `"><script>'&`;
  const { text } = html`<a href="${evil}">${[evil, html`<b>${evil}</b>`]}${null}${false}${0}</a>`;
  const escaped = escapeText(evil);
  expect(escaped).not.toMatch(/[<>"']/);
  expect(text).toBe(`<a href="${escaped}">${escaped}<b>${escaped}</b>0</a>`);
});
