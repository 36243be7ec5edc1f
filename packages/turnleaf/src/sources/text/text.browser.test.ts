import { expect, test } from "vitest";
import { commands } from "vitest/browser";
import { expectConformance } from "../../for_tests/source_conformance.ts";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";
import { Footnotes, listOf } from "./footnotes.ts";
import { htmlOf, readMarkdown } from "./markdown.ts";

const never = new AbortController().signal;
const paragraph = (k: number): string => `Paragraph ${k}. ${"Call me Ishmael. ".repeat(20)}`;
const plain = Array.from({ length: 30 }, (_, k) => paragraph(k)).join("\n\n");

/** Opens a file all of whose pages are known. */
async function open(text: BlobPart, name: string, type = ""): Promise<PageSource> {
  const source = await openSource(new File([text], name, { type }));
  await new Promise<void>((resolve) =>
    source.watchPages?.((change) => {
      change();
      resolve();
    }),
  );
  return source;
}

async function textOf(source: PageSource): Promise<string> {
  let text = "";
  for (let index = 0; index < source.pageCount; index++) {
    text += ((await source.text?.(index, never)) ?? [])
      .map((run) => run.text + (run.end ? "\n" : ""))
      .join("");
  }
  return text;
}

test.each([
  ["text", "a.txt", plain],
  ["Markdown", "a.md", `# One\n\n${plain}\n\n# Two\n\n[there](#one)`],
])("%s fulfils the contract of a source", async (_, name, text) => {
  await expectConformance(() => openSource(new File([text], name)));
});

test("text is set in paragraphs, lines joined unless they are indented", async () => {
  const source = await open(
    "One\ntwo.\n\n    a verse\n    of two\n\nThree <b> & four.",
    "poem.txt",
  );
  expect(source.title).toBe("poem.txt");
  const lines = (await textOf(source)).split("\n").map((line) => line.trim());
  expect(lines).toEqual(["One two.", "a verse", "of two", "Three <b> & four.", ""]);
  source.close();
});

test.each([
  ["UTF-8", new TextEncoder().encode("Café")],
  ["UTF-16", Uint8Array.of(0xff, 0xfe, 67, 0, 97, 0, 102, 0, 0xe9, 0)],
  ["UTF-32", Uint8Array.of(0xff, 0xfe, 0, 0, ...[67, 97, 102, 0xe9].flatMap((c) => [c, 0, 0, 0]))],
  [
    "UTF-32, the largest byte first",
    Uint8Array.of(0, 0, 0xfe, 0xff, ...[67, 97, 102, 0xe9].flatMap((c) => [0, 0, 0, c])),
  ],
  ["Latin-1", Uint8Array.of(67, 97, 102, 0xe9)],
])("text in %s is read", async (_, bytes) => {
  const source = await open(bytes, "a.txt", "text/plain");
  expect((await textOf(source)).trim()).toBe("Café");
  source.close();
});

test("a page of text ends at the mark for it, within a paragraph too", async () => {
  const source = await open(
    new TextEncoder().encode("One\n\nTwo\ftwo\n\fThree"),
    "a.txt",
    "text/plain",
  );
  const pages = await Promise.all([0, 1, 2].map((k) => source.text?.(k, never) ?? []));
  expect(source.pageCount).toBe(3);
  expect(pages.map((runs) => runs.map(({ text }) => text))).toEqual([
    ["One", "Two"],
    ["two"],
    ["Three"],
  ]);
  source.close();
});

test.each([
  ["windows-1251", [0xcf, 0xf0, 0xe8, 0xe2, 0xe5, 0xf2, 0x20, 0xec, 0xe8, 0xf0], "Привет мир"],
  [
    "DOS's Cyrillic",
    // Its small letters are of two ranges.
    Array.from("Мороз и солнце; день чудесный! Ещё", (letter) => {
      const code = (letter === "ё" ? "е" : letter).charCodeAt(0);
      return code < 0x80 ? code : code - (code < 0x440 ? 0x410 - 0x80 : 0x440 - 0xe0);
    }),
    "Мороз и солнце; день чудесный! Еще",
  ],
  ["KOI8-R", [0xf0, 0xd2, 0xc9, 0xd7, 0xc5, 0xd4, 0x20, 0xcd, 0xc9, 0xd2], "Привет мир"],
  [
    "Windows' Arabic",
    // In ISO 8859-6 some of these bytes are no letters.
    [
      ...[0xdd, 0xed, 0x20, 0xde, 0xcf, 0xed, 0xe3, 0x20, 0xc7, 0xe1, 0xd2, 0xe3, 0xc7, 0xe4, 0x20],
      ...[0xdf, 0xc7, 0xe4, 0x20, 0xe5, 0xe4, 0xc7, 0xdf, 0x20, 0xe3, 0xe1, 0xdf, 0x20, 0xda, 0xd9],
      ...[0xed, 0xe3],
    ],
    "في قديم الزمان كان هناك ملك عظيم",
  ],
  ["GBK", [0xc4, 0xe3, 0xba, 0xc3, 0xca, 0xc0, 0xbd, 0xe7], "你好世界"],
  ["Shift_JIS", [0x93, 0xfa, 0x96, 0x7b, 0x8c, 0xea, 0x82, 0xcc], "日本語の"],
  [
    "Windows' of Western Europe",
    [0x49, 0x74, 0x92, 0x73, 0x20, 0x64, 0x6f, 0x6e, 0x92, 0x74],
    "It’s don’t",
  ],
  ["UTF-16 without its mark", [0x43, 0, 0x61, 0, 0x66, 0, 0xe9, 0], "Café"],
  ["UTF-32 without its mark", [0x43, 0x61, 0x66, 0xe9].flatMap((c) => [c, 0, 0, 0]), "Café"],
])("text in %s, which it does not say, is read", async (_, bytes, text) => {
  const source = await open(Uint8Array.from(bytes), "a.txt", "text/plain");
  expect((await textOf(source)).trim()).toBe(text);
  source.close();
});

test("text of a million characters is read whole, in parts", async () => {
  const source = await open(plain.repeat(90).slice(0, 1_000_000), "long.txt");
  expect(source.pageCount).toBeGreaterThan(300);
  source.close();
});

test("Markdown has headings, contents, lists, tables, code and links", async () => {
  const text =
    "---\ntitle: x\n---\n# The *Book*\n\nIntro with `code` and [two](#part-two).\n\n# Part Two\n\n## Inner & more\n\n- one\n- two\n\n| a | b |\n|---|---|\n| c | d |\n\n```\nlet x;\n```\n";
  const source = await open(text, "book", "text/markdown");
  expect(source.title).toBe("x");
  expect(await source.outline?.(never)).toEqual([
    { title: "The Book", page: 1, children: [] },
    { title: "Part Two", page: 2, children: [{ title: "Inner & more", page: 2, children: [] }] },
  ]);
  const [link] = (await source.links?.(0, never)) ?? [];
  expect(link?.to).toEqual({ page: 2 });
  const all = await textOf(source);
  for (const word of ["The Book", "Intro with code", "one", "d", "let x;"])
    expect(all).toContain(word);
  expect(all).not.toContain("title: x");
  source.close();
});

test.each([
  ["YAML", "---\ntitle: x\n---\n# Text", "Text"],
  ["YAML that ends by dots", "---\ntitle: x\n...\n# Text", "Text"],
  ["TOML", '+++\ntitle = "x"\n[extra]\nb = 1\n+++\n# Text', "Text"],
  ["lines about words", "---\n\nThe words.\n\n---\n\nText", "The words.Text"],
])("settings before the text of Markdown are no part of it: %s", async (_, text, shown) => {
  const source = await open(text, "a.md", "text/markdown");
  expect((await textOf(source)).replaceAll("\n", "").trim()).toBe(shown);
  source.close();
});

test("lines of the contents lead to their headings, whatever headings stand in its HTML", async () => {
  const text = `<h1 align="center">Tool</h1>\n\n## Install\n\n${plain}\n\n### Linux\n\n[there](#linux)`;
  const source = await open(text, "README.md");
  const [install] = (await source.outline?.(never)) ?? [];
  expect(install).toMatchObject({ title: "Install", page: 1 });
  const [linux] = install?.children ?? [];
  expect(linux).toEqual({ title: "Linux", page: source.pageCount, children: [] });
  source.close();
});

test("Markdown that begins with a link is Markdown, and no JSON", async () => {
  const source = await open("[Read this](https://example.org) first.\n\n# A", "a.md");
  expect(await textOf(source)).toContain("Read this first.");
  expect((await source.links?.(0, never))?.length).toBe(1);
  source.close();
});

test("Markdown runs no script, fetches nothing, and its HTML is cleaned", async () => {
  performance.clearResourceTimings();
  const source = await open(
    '# A\n\n<script>parent.ran = 1</script><img src="x" onerror="parent.ran = 1">\n\n![x](https://elsewhere.invalid/a.png)\n\n[run](javascript:parent.ran=1)\n\nHere.',
    "a.md",
  );
  await source.draw(0, 100, never);
  expect(await textOf(source)).toContain("Here.");
  expect(await source.links?.(0, never)).toEqual([]);
  const asked = performance.getEntriesByType("resource").map(({ name }) => name);
  expect(asked.filter((name) => name.includes("elsewhere"))).toEqual([]);
  expect("ran" in window).toBe(false);
  source.close();
});

test.each([
  ["quotations", ">".repeat(5000)],
  ["lists on a line", "1. ".repeat(5000)],
  ["lists", Array.from({ length: 150 }, (_, k) => `${" ".repeat(2 * k)}- a`).join("\n")],
  ["unpaired marks", "*a **a ".repeat(10_000)],
  ["brackets", "[".repeat(60_000)],
])("Markdown of many %s is read", async (_, text) => {
  const source = await openSource(new File([`# A\n\nHere.\n\n${text}`], "deep.md"));
  expect((await source.text?.(0, never))?.map((run) => run.text).join("")).toContain("Here.");
  source.close();
});

test("a paragraph of a million spaces, or of a million letters, is read", async () => {
  await commands.processUse();
  for (const text of [`a${" ".repeat(1_000_000)}b`, "a".repeat(300_000)]) {
    const source = await openSource(new File([text], "a.txt"));
    expect((await source.text?.(0, never))?.[0]?.text).toMatch(/^a/);
    source.close();
  }
  // A step for each space took 47 seconds, and all of it takes half a one.
  expect((await commands.processUse()).seconds).toBeLessThan(5);
});

test("a link whose escapes are none leads nowhere", async () => {
  const source = await openSource(new File(["# A\n\n[a](#%) [b](#%zz)"], "a.md"));
  expect(await source.links?.(0, never)).toEqual([]);
  source.close();
});

test("text with the control characters of old systems, terminals and printers is read without them", async () => {
  const old = "DOS file\r\nwith text\r\n\u001a";
  expect(await textOf(await open(old, "old.txt"))).toBe("DOS file\nwith text\n");
  const printed = "N\bNA\bAM\bM_\be\u001b[1m bold\u001b[0m\u0007 a\u001f b\u007f\u0085 c\u000bd";
  expect(await textOf(await open(printed, "man"))).toBe("NAMe bold a b cd\n");
  await expect(open("a\0b", "binary")).rejects.toThrow("unknown format");
});

test("footnotes of Markdown stand at the end of their chapter, and are shown beside their marks", async () => {
  const text = `# One

See here[^a] and [^gone] and \`[^a]\`.
Again[^a], and more[^long].
[^long]: First.
    Still first.

    Second *paragraph*[^inner].

# Two

And there[^b].

[^b]: There.
[^a]: **Here**.
[^inner]: Within.
[^never]: Nothing leads here.
`;
  const source = await open(text, "notes.md");
  expect(source.pageCount).toBe(2);
  const pages = [];
  for (const index of [0, 1]) {
    const runs = (await source.text?.(index, never)) ?? [];
    pages.push(runs.map((run) => run.text + (run.end ? "\n" : "")).join(""));
  }
  expect(pages[0]).toMatch(
    /^One\n *See here1 and \[\^gone\] and \[\^a\]\. *\n? *Again1, and more2\.[\s\S]*Here\. ↩[\s\S]*First\. Still first\.[\s\S]*Second paragraph3\. ↩[\s\S]*Within\. ↩/,
  );
  expect(pages[1]).toMatch(/^Two\n *And there4\.[\s\S]*There\. ↩[\s\S]*Nothing leads here\./);
  const links = (await source.links?.(0, never)) ?? [];
  expect(links.slice(0, 3).map(({ note }) => note)).toEqual([
    "Here.",
    "Here.",
    "First. Still first.\nSecond paragraph3.",
  ]);
  expect(links.at(-1)).toMatchObject({ title: "↩", to: { page: 1 } });
  expect(source.warnings).toEqual([]);
});

test("notes that lead one to the next are numbered in their order, however many they are", async () => {
  const chain = (count: number): string => {
    const notes = Array.from({ length: count }, (_, k) => `[^${k}]: Note${k} [^${k + 1}]`);
    return `# One\n\nHere[^0].\n\n${notes.join("\n\n")}\n`;
  };
  // Without laying out hundreds of pages of them.
  const notes = new Footnotes();
  const text = notes.take(readMarkdown(chain(12_000)));
  const found = notes.of(text, true);
  const list = listOf(found, (tokens) => htmlOf(tokens, new Map(), notes));
  expect(found.length).toBe(12_000);
  const last = list.slice(list.lastIndexOf("<li "));
  expect(last).toContain('value="12000"');
  expect(last).toContain("Note11999 ");
  const source = await open(chain(100), "chain.md");
  const runs = (await source.text?.(0, never)) ?? [];
  expect(runs.map((run) => run.text).join("")).toContain("Here1.");
});

const wrapped = (word: string): string =>
  `The first line of ${word} is as wide as its paper, and goes on\nin this one, which is as wide, and whose end means nothing,\nand ends.`;

test("text whose paragraphs are indented, and not apart, has these", async () => {
  const prose = `    ${wrapped("one")}\n    ${wrapped("two")}\n    ${wrapped("three")}`;
  const source = await open(`Title\n\n${prose}\n`, "a.txt");
  const runs = (await source.text?.(0, never)) ?? [];
  const text = runs.map((run) => run.text + (run.end ? " " : "")).join("");
  expect(text).toMatch(/goes on in this one, .* nothing, and ends\. The first line of two/);
  expect(text).not.toContain("  The");
  source.close();
  const novel = "第一章\n\n　　话说天下大势。\n　　分久必合，\n合久必分。\n\n第二章";
  const chinese = await open(novel, "a.txt");
  expect(await textOf(chinese)).toBe("第一章\n话说天下大势。\n分久必合，合久必分。\n第二章\n");
});

test("a line longer than any that is wrapped by hand is a paragraph", async () => {
  const line = "A paragraph of one line that goes on, and on, and on. ".repeat(3).trim();
  const chapter = (name: string) => `${name}\n\n${Array(4).fill(line).join("\n")}`;
  const source = await open(`${chapter("One")}\n\n${chapter("Two")}`, "a.txt");
  const runs = (await source.text?.(0, never)) ?? [];
  expect(runs.filter(({ text }) => text.startsWith("A paragraph")).length).toBe(8);
});

test("lines that end before they are full stay as they are, and no space stands between Chinese lines", async () => {
  const text = `A poem\nof lines\nthat are short\n\n${wrapped("one")}\n\n${wrapped("two")}`;
  const lines = (await textOf(await open(text, "a.txt"))).split("\n");
  expect(lines.slice(0, 3)).toEqual(["A poem", "of lines", "that are short"]);
  for (const name of ["a.txt", "a.md"]) {
    const chinese = await open(
      "话说天下大势分久必合\n合久必分周末七国分争\n并入于秦。\n\n完",
      name,
    );
    expect(await textOf(chinese)).toBe("话说天下大势分久必合合久必分周末七国分争并入于秦。\n完\n");
  }
});

test.each(["a.txt", "a.md"])("Hebrew and Arabic in %s go from right to left", async (name) => {
  const source = await open("בראשית ברא אלהים.\n\nPlain words.\n\nفي قديم الزمان.", name);
  expect(source.direction).toBe("rtl");
  const [first] = (await source.text?.(0, never)) ?? [];
  const { width } = await source.size(0);
  expect((first?.x ?? 0) + (first?.width ?? 0)).toBeGreaterThan(0.7 * width);
});

test("Markdown says its title, authors and language before its text", async () => {
  const yaml = `---\nlayout: post\ntitle: "Of \\"Whales\\""\nauthors:\n  - name: Ann A.\n    mail: a@b.org\n  - Ben B.\nlang: ar\ntags: [a, b]\n---\n# One\n\nText.\n`;
  const source = await open(`\ufeff${yaml}`, "a.md");
  expect(source).toMatchObject({ title: 'Of "Whales"', language: "ar", direction: "rtl" });
  expect(source.details?.map(({ value }) => value)).toEqual(["Ann A.", "Ben B."]);
  expect(await textOf(source)).toBe("One\nText.\n");
  const toml = await open('+++\ntitle = "Whales"\nauthor = "Ann"\n+++\n\nText.\n', "a.md");
  expect([toml.title, await textOf(toml)]).toEqual(["Whales", "Text.\n"]);
  expect(toml.details?.map(({ value }) => value)).toEqual(["Ann"]);
});

test.each([["---\n\nBetween rules.\n\n---\n\nAfter."], ["---\nBetween rules.\n\n---\n\nAfter."]])(
  "a text that begins with a rule has what stands before the next: %j",
  async (text) => {
    expect(await textOf(await open(text, "a.md"))).toMatch(/^Between rules\.\s+After\./);
  },
);

test("links lead to every heading and to what is named by HTML, or by what stands behind a heading", async () => {
  const links = ["#deep", "#anchor", "#span", "#same-1", "#same-1-1", "#own"];
  const text = `# Start\n\n${links.map((to, k) => `[${k}](${to})`).join(" ")}\n\n# One\n\n#### Deep\n\n<a name="anchor"></a>Here\n\n# Two\n\n<span id="span">Here</span>\n\n# Same\n\n# Same\n\n# Same 1\n\n# Four {#own .class}\n`;
  const source = await open(text, "a.md");
  const found = (await source.links?.(0, never)) ?? [];
  expect(found.map(({ to }) => to && "page" in to && to.page)).toEqual([2, 2, 3, 5, 6, 7]);
  expect((await source.outline?.(never))?.map(({ title }) => title)).toEqual([
    ...["Start", "One", "Two", "Same", "Same", "Same 1", "Four"],
  ]);
});

test("a heading without words names no book", async () => {
  const source = await open("# ![](a.png)\n\nText\n\n# B\n", "a.md");
  expect(source.title).toBe("a.md");
});

test.each([
  "---\ntitle: x\n---\n\n",
  "\n\n",
  "<!-- of the licence -->\n\n[a]: https://example.org/\n\n",
])("no empty page stands before the first heading: %j", async (start) => {
  const source = await open(`${start}# One\n\nText.\n\n# Two\n`, "a.md");
  expect((await source.outline?.(never))?.map(({ page }) => page)).toEqual([1, 2]);
});
