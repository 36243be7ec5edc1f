import { describe, expect, it } from "vitest";
import { clue, fuzzed, type Random } from "../for_tests/random_numbers.ts";
import { limits } from "./limits.ts";
import { parseManifest } from "./manifest.ts";
import { BookError } from "./page_source.ts";

const base = "https://library.example/atlas/book.json";
const parse = (value: unknown, from = base): ReturnType<typeof parseManifest> =>
  parseManifest(value, from, "book.json");

describe("a good manifest", () => {
  it("takes images themselves from a script", () => {
    const [one, two] = [new Blob(["1"]), new Blob(["2"])];
    expect(parse([one, { src: two, label: "ii" }]).pages).toEqual([
      { src: one },
      { src: two, label: "ii" },
    ]);
  });

  it("resolves its addresses against its own", () => {
    const book = parse({
      title: "Atlas",
      language: "EN-gb",
      direction: "rtl",
      pages: ["1.jpg", { src: "../2.jpg", width: 900, height: 1200, label: "iv" }],
    });
    expect(book).toEqual({
      name: "book.json",
      title: "Atlas",
      language: "en-GB",
      direction: "rtl",
      kind: "scan",
      pages: [
        { src: "https://library.example/atlas/1.jpg" },
        { src: "https://library.example/2.jpg", size: { width: 900, height: 1200 }, label: "iv" },
      ],
    });
  });

  it("says how wide a page is on paper", () => {
    expect(parse({ pageWidth: "210 mm", pages: ["1.jpg"] }).pageWidth).toBeCloseTo(0.21);
    expect(parse(["1.jpg"]).pageWidth).toBeUndefined();
    expect(() => parse({ pageWidth: "21", pages: ["1.jpg"] })).toThrow(/write "210mm"\.$/);
  });

  it("may be the list of its pages alone", () => {
    expect(parse(["1.jpg", "2.jpg"])).toMatchObject({ title: "book.json", direction: "ltr" });
  });

  it("may hold other servers' addresses, blobs and images as data", () => {
    const pages = ["http://other.example/1.png", "data:image/png;base64,AAAA", "//x.example/2.png"];
    expect(parse({ pages }).pages.map(({ src }) => src)).toEqual([
      "http://other.example/1.png",
      "data:image/png;base64,AAAA",
      "https://x.example/2.png",
    ]);
  });

  it("ignores what it does not know, and cleans what is shown", () => {
    const book = parse({ title: " A\u0000\u202e  title\n", future: 1, pages: ["1.jpg"] });
    expect(book.title).toBe("A title");
  });

  it("bounds the length of titles and labels", () => {
    const book = parse({
      title: "t".repeat(10_000),
      pages: [{ src: "1", label: "l".repeat(999) }],
    });
    expect(book.title.length).toBe(limits.titleLength);
    expect(book.pages[0]?.label?.length).toBe(limits.labelLength);
  });
});

describe("what a manifest says of text, links and contents", () => {
  const box = { x: 10, y: 20, width: 300, height: 40 };

  it("is taken over, cleaned", () => {
    const { pages, outline } = parse({
      outline: [{ title: "One", page: 1, children: [{ title: "Web", href: "https://x.example" }] }],
      pages: [
        {
          src: "1.jpg",
          alt: "A\u0000 whale",
          text: [
            { ...box, text: "Call\u202e me" },
            { ...box, text: "Ishmael", angle: 90, end: false },
          ],
          links: [
            { ...box, page: 1, title: "Back" },
            { ...box, href: "mailto:ahab@pequod.example" },
          ],
        },
      ],
    });
    expect(outline).toEqual([
      {
        title: "One",
        page: 1,
        children: [{ title: "Web", page: null, href: "https://x.example/", children: [] }],
      },
    ]);
    expect(pages[0]?.alt).toBe("A whale");
    expect(pages[0]?.text).toEqual([
      { ...box, text: "Call me", angle: 0, end: true },
      { ...box, text: "Ishmael", angle: Math.PI / 2, end: false },
    ]);
    expect(pages[0]?.links).toEqual([
      { ...box, title: "Back", to: { page: 1 } },
      { ...box, title: "", to: { href: "mailto:ahab@pequod.example" } },
    ]);
  });

  const page = (members: object): object => ({ pages: [{ src: "1.jpg", ...members }] });
  const deep = (levels: number): object[] => [
    { title: "x", ...(levels > 1 ? { children: deep(levels - 1) } : {}) },
  ];
  const faults: readonly (readonly [string, unknown, RegExp])[] = [
    ["text that is none", page({ text: "Call" }), /page 1 has a "text" that is no list; /],
    [
      "contents that are none",
      { pages: ["1.jpg"], outline: 5 },
      /json has an "outline" that is no list; /,
    ],
    ["a description that is none", page({ alt: 5 }), /page 1 has an alt that is no text; /],
    ["an empty text", page({ text: [{ ...box }] }), /page 1: text 1 has no "text"; /],
    ["a text nowhere", page({ text: [{ text: "a" }] }), /page 1: text 1 has no usable place; /],
    [
      "an endless text",
      page({ text: Array(60).fill({ ...box, text: "x".repeat(9999) }) }),
      /makes the text of the page too long/,
    ],
    ["too many", page({ text: Array(8001).fill(0) }), /has a "text" of 8001; write at most 8000/],
    [
      "a link to a script",
      page({ links: [{ ...box, href: "javascript:x" }] }),
      /address that is none/,
    ],
    [
      "a link out of the book",
      page({ links: [{ ...box, page: 2 }] }),
      /that the book does not have/,
    ],
    ["a link to nothing", page({ links: [box] }), /page 1: link 1 leads nowhere; /],
    ["contents too deep", { outline: deep(9), pages: ["1"] }, /contents deeper than 8; /],
    ["contents without a title", { outline: [{ page: 1 }], pages: ["1"] }, /without a title/],
  ];
  it.each(faults)("is rejected where it is %s", (_, value, sentence) => {
    expect(() => parse(value)).toThrow(BookError);
    expect(() => parse(value)).toThrow(sentence);
  });
});

describe("a bad manifest fails in one sentence that names it and the place", () => {
  const cases: readonly (readonly [string, unknown, RegExp])[] = [
    ["null", null, /^book\.json is not a manifest; /],
    ["a text", "pages", /^book\.json is not a manifest; /],
    ["no pages", { title: "x" }, /^book\.json has no list of "pages"; /],
    ["pages of another type", { pages: { 0: "1.jpg" } }, /^book\.json has no list of "pages"; /],
    ["an empty list", { pages: [] }, /^book\.json lists no pages; /],
    ["too many pages", { pages: Array(20_001).fill("1") }, /^book\.json lists 20001 pages; /],
    ["a number for a page", { pages: ["1.jpg", 7] }, /^book\.json: page 2 has no "src"; /],
    ["an empty src", { pages: [""] }, /^book\.json: page 1 has no "src"; /],
    ["null for a page", { pages: [null] }, /^book\.json: page 1 has no "src"; /],
    [
      "a script",
      { pages: ["javascript:alert(1)"] },
      /page 1 has an address that is not of the web/,
    ],
    ["a file", { pages: ["file:///etc/passwd"] }, /page 1 has an address that is not of the web/],
    ["a broken address", { pages: ["http://"] }, /page 1 has an address that is none: http:/],
    ["a page as data", { pages: ["data:text/html,x"] }, /page 1 holds data that is no image; /],
    ["a long address", { pages: ["x".repeat(5000)] }, /page 1 has an address of 5000 characters; /],
    ["a width alone", { pages: [{ src: "1", width: 3 }] }, /page 1 has no usable width and height/],
    ["no height", { pages: [{ src: "1", width: 3, height: 0 }] }, /page 1 has no usable width/],
    ["an endless side", { pages: [{ src: "1", width: 1e300, height: 2 }] }, /page 1 has no usable/],
    [
      "a width in words",
      { pages: [{ src: "1", width: "3", height: "4" }] },
      /page 1 has no usable/,
    ],
    [
      "a title that is none",
      { title: {}, pages: ["1"] },
      /^book\.json has a title that is no text; /,
    ],
    [
      "a label that is none",
      { pages: [{ src: "1", label: 4 }] },
      /page 1 has a label that is no text/,
    ],
    ["no language", { language: "?", pages: ["1"] }, /^book\.json has a language that is no tag; /],
    [
      "a direction",
      { direction: "up", pages: ["1"] },
      /unknown direction; write "ltr" or "rtl"\.$/,
    ],
    ["a kind", { kind: "x", pages: ["1"] }, /unknown kind; write "scan" or "typeset"\.$/],
  ];
  it.each(cases)("%s", (_, value, sentence) => {
    expect(() => parse(value)).toThrow(BookError);
    expect(() => parse(value)).toThrow(sentence);
  });

  it("a relative address in a manifest that has none itself", () => {
    expect(() => parse(["1.jpg"], "data:application/json,x")).toThrow(/page 1 has an address that/);
  });
});

describe("random JSON", () => {
  const leaves = [null, 0, -1, 1e308, "", "1.jpg", "\ud800", "data:,", true, "__proto__"];
  const keys =
    "pages src width height label title direction text links outline children href page x y __proto__".split(
      " ",
    );
  const grow = (random: Random, depth: number): unknown => {
    const kind = depth > 4 ? 0 : random.below(3);
    if (kind === 0) return random.among(leaves);
    const parts = Array.from({ length: random.below(5) }, () => grow(random, depth + 1));
    if (kind === 1) return parts;
    return Object.fromEntries(parts.map((part) => [random.among(keys), part]));
  };
  fuzzed("has no other failure than a BookError", 3000, (random) => {
    const value = { ...(grow(random, 0) as object), pages: grow(random, 1) };
    try {
      parse(value);
    } catch (error) {
      expect(error, clue(value)).toBeInstanceOf(BookError);
    }
  });
});
