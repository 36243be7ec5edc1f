import { describe, expect, it } from "vitest";
import { PageList } from "../sources/page_list.ts";
import type { PageSource, TextPage, TextRun } from "../sources/page_source.ts";
import { PageTexts } from "./page_texts.ts";
import { findIn, type SearchHit, searchBook } from "./searching.ts";

const never = new AbortController().signal;

/** Returns runs of lines, one per line; a line that ends in "+" continues in the next run. */
const lines = (...texts: string[]): TextRun[] =>
  texts.map((text) => ({
    text: text.replace(/\+$/, ""),
    x: 0,
    y: 0,
    width: 100,
    height: 10,
    angle: 0,
    end: !text.endsWith("+"),
  }));

/** Returns the hits, as the page writes them. */
const found = (query: string, ...texts: string[]): string[] => {
  const runs = lines(...texts);
  return findIn(runs, query).map((stretches) =>
    stretches.map(({ run, from, to }) => runs[run].text.slice(from, to)).join("|"),
  );
};

describe("what is found", () => {
  it.each([
    ["case", "ISHMAEL", ["Call me Ishmael."], ["Ishmael"]],
    ["accents of the page", "cafe", ["Un café, un cafe\u0301"], ["café", "cafe"]],
    ["accents of the query", "naïve", ["naive"], ["naive"]],
    ["ligatures", "office", ["o\ufb03ce"], ["o\ufb03ce"]],
    ["full width", "ABC", ["ＡＢＣ"], ["ＡＢＣ"]],
    ["a sharp s", "strasse", ["Straße"], ["Straße"]],
    ["a final sigma", "ΛΌΓΟΣ", ["λόγος"], ["λόγος"]],
    ["a dotted I", "istanbul", ["İstanbul"], ["İstanbul"]],
    ["quotes and dashes", "o'er the – sea", ["o’er the—sea"], ["o’er the—sea"]],
    ["a broken word", "shadiest", ["the dreamiest, shadi-", "est, quietest"], ["shadi|est"]],
    ["a hyphen", "hill-side", ["their hill-", "side blue"], ["hill|side"]],
    ["a hyphen left out", "hillside", ["their hill-side blue"], ["hill-side"]],
    ["a soft hyphen", "shadiest", ["shadi\u00adest"], ["shadi\u00adest"]],
    ["a line's end", "me ishmael", ["Call me", "Ishmael."], ["me|Ishmael"]],
    ["runs of one word", "ishmael", ["Ish+", "mael."], ["Ish|mael"]],
    ["many spaces", " call   me ", ["Call  me"], ["Call  me"]],
    ["Chinese over a line's end", "白鲸", ["看见白", "鲸了"], ["白|鲸"]],
    ["Japanese, voiced letters apart", "かき", ["がき、かき"], ["かき"]],
    ["Korean", "고래", ["흰 고래가"], ["고래"]],
    ["Hebrew without points", "שלום", ["שָׁלוֹם"], ["שָׁלוֹם"]],
    ["beyond the first plane", "\u{1d400}b", ["xABx"], ["AB"]],
    ["every place, none twice", "aa", ["aaaaa"], ["aa", "aa"]],
    ["nothing for nothing", " - ", ["a - b"], []],
    ["nothing where it is not", "whale", ["Call me Ishmael."], []],
  ] as const)("%s", (_, query, texts, expected) => {
    expect(found(query, ...texts)).toEqual(expected);
  });
});

/** Returns a source of pages of text, and a record of its requests. */
function sourceOf(pages: readonly (readonly TextRun[])[]): { source: PageSource; asked: number[] } {
  const asked: number[] = [];
  const text = async (index: number): Promise<readonly TextRun[]> => {
    asked.push(index + 1);
    if (pages[index].length === 0) throw new Error("damaged");
    return pages[index];
  };
  return { source: { pageCount: pages.length, text } as unknown as PageSource, asked };
}

/** Returns runs of lines, of which the last one's paragraph goes on on the next page. */
const wrapped = (...texts: string[]): TextRun[] =>
  lines(...texts).map((run, k) => (k === texts.length - 1 ? { ...run, wraps: true } : run));

/** Searches the pages of a source. */
const search = (
  source: PageSource,
  query: string,
  { texts = new PageTexts(), signal = never } = {},
): Promise<readonly SearchHit[]> =>
  searchBook(new PageList(source).textPages(signal), texts, query, signal);

/** What finds the places of a query in a source: page, number on it, words before and words found. */
const placesIn =
  (source: PageSource) =>
  async (query: string): Promise<unknown[]> =>
    (await search(source, query)).map((hit) => [hit.page, hit.index, hit.before, hit.text]);

describe("a search", () => {
  it("tells the page, the place and what stands about it", async () => {
    const { source } = sourceOf([
      lines("Loomings."),
      [],
      lines(
        "Call me Ishmael. Some years ago—never mind how",
        "long precisely—having lit-",
        "tle money",
      ),
    ]);
    const hits = await search(source, "some");
    expect(hits).toEqual([
      {
        page: 3,
        before: "Call me Ishmael. ",
        text: "Some",
        after: " years ago—never mind how long precisely—having …",
        query: "some",
        index: 0,
      },
    ]);
    const [broken] = await search(source, "little");
    expect(broken).toMatchObject({ text: "little", after: " money" });
    expect(broken.before).toMatch(/^… .*having $/);
  });

  it("finds what crosses a page where a paragraph goes on, once, on the page where it begins", async () => {
    const { source } = sourceOf([
      wrapped("To Sherlock Holmes", "she is always the"),
      wrapped("woman. I have seldom, in Bo\u00ad"),
      wrapped("hemia, heard", "see \u767d"),
      lines("\u9cb8 there."),
      lines("The end"),
    ]);
    const places = placesIn(source);
    const before = "To Sherlock Holmes she is ";
    expect(await places("always the woman")).toEqual([[1, 0, before, "always the woman"]]);
    expect(await places("Bohemia")).toEqual([[2, 0, "woman. I have seldom, in ", "Bohemia"]]);
    expect(await places("\u767d\u9cb8")).toHaveLength(1);
    // What is on the next page alone is that page's, and a paragraph that ends is not joined.
    expect(await places("heard")).toHaveLength(1);
    expect(await places("there the end")).toEqual([]);
    const [hit] = await search(source, "always");
    expect(hit?.after).toBe(" the woman. I have seldom, in Bohemia, heard …");
  });

  it("finds what crosses several pages, where those between have few words", async () => {
    const { source } = sourceOf([
      wrapped("I had seen"),
      wrapped("little of"),
      wrapped("Holmes"),
      lines("lately.", "My marriage"),
      lines("little of"),
      lines("Holmes lately"),
    ]);
    const places = placesIn(source);
    const phrase = "seen little of Holmes lately";
    expect(await places(phrase)).toEqual([[1, 0, "I had ", phrase]]);
    expect(await places("of holmes lately")).toEqual([[2, 0, "little ", "of Holmes lately"]]);
    const [hit] = await search(source, "I had");
    expect(hit?.after).toBe(" seen little of Holmes lately. My marriage");
  });

  it("joins no page with one that does not lie next to it", async () => {
    const { source } = sourceOf([wrapped("one"), lines("two"), lines("three")]);
    const list = new PageList(source);
    const pages = list.textPages(never);
    async function* changing(): AsyncGenerator<TextPage> {
      for await (const page of pages) {
        yield page;
        if (page.index() === 0) list.splice(1, 1, null);
      }
    }
    expect(await searchBook(changing(), new PageTexts(), "one three", never)).toHaveLength(1);
    expect(await search(source, "one three")).toEqual([]);
  });

  it("ends when aborted, and at its bounds", async () => {
    const { source, asked } = sourceOf(Array.from({ length: 90 }, () => lines("a ".repeat(60))));
    const controller = new AbortController();
    const searching = search(source, "a", { signal: controller.signal });
    controller.abort(new Error("another query"));
    await expect(searching).rejects.toThrow("another query");
    expect(asked.length).toBeLessThan(3);
    const hits = await search(source, "a");
    expect(hits.length).toBe(2000);
    expect(await search(source, "")).toEqual([]);
    expect((await search(source, "a".repeat(1e6))).length).toBe(0);
  });

  it("reads a page once, and keeps no more than its bound", async () => {
    const few = sourceOf([lines("whale"), lines("whale")]);
    const texts = new PageTexts();
    const list = new PageList(few.source);
    for (const query of ["whale", "ship"]) {
      await searchBook(list.textPages(never), texts, query, never);
    }
    expect(few.asked).toEqual([1, 2]);
    const many = sourceOf(Array.from({ length: 5 }, () => lines("x".repeat(700_000))));
    const pages = new PageList(many.source);
    const bounded = new PageTexts();
    await searchBook(pages.textPages(never), bounded, "y", never);
    const read: TextPage[] = [];
    for await (const page of pages.textPages(never)) read.push(page);
    for (const page of [read[4], read[0]]) if (page) await bounded.of(page, never);
    expect(many.asked).toEqual([1, 2, 3, 4, 5, 1]);
  });

  it("goes on while pages are added and removed, and its places follow theirs", async () => {
    const { source } = sourceOf(["one", "whale", "two", "whale"].map((word) => lines(word)));
    const list = new PageList(source);
    const added = sourceOf([lines("whale")]).source;
    const found: SearchHit[] = [];
    const hits = await searchBook(
      list.textPages(never),
      new PageTexts(),
      "whale",
      never,
      (hits) => {
        found.push(...hits);
        if (found.length === 1) list.splice(0, 1, null);
        else if (found.length === 2) list.splice(0, 0, added);
      },
    );
    expect(hits.map(({ page }) => page)).toEqual([2, 4]);
    expect(found.map(({ page }) => page)).toEqual([2, 4]);
  });
});
