/** Whatever a text, an attribute or a file from outside says, its parser rejects it or stays within its bounds. */
import { afterEach, describe, expect, vi } from "vitest";
import { pagesNamed } from "./book/layout.ts";
import { turnSecondsOf } from "./element/attribute_options.ts";
import { pageNumber } from "./element/page_numbers.ts";
import { loadPlace, savePlace } from "./element/place_keeper.ts";
import { clue, fuzzed, wildPieces } from "./for_tests/random_numbers.ts";
import { photographRow } from "./leaf_models/photograph_row.ts";
import { sizeFromHeader, typedImage } from "./sources/image_header.ts";
import { limits } from "./sources/limits.ts";
import { parseManifest } from "./sources/manifest.ts";
import { pageOfHash } from "./sources/page_hash.ts";
import { BookError } from "./sources/page_source.ts";

afterEach(() => vi.unstubAllGlobals());

describe("a mutated manifest", () => {
  const sound = JSON.stringify({
    title: "Atlas",
    language: "en",
    direction: "rtl",
    kind: "scan",
    outline: [{ title: "One", page: 1, children: [{ title: "Web", href: "https://x.example" }] }],
    pages: [
      "1.jpg",
      {
        src: "2.jpg",
        width: 900,
        height: 1200,
        label: "iv",
        alt: "A whale",
        text: [{ x: 1, y: 2, width: 3, height: 4, text: "Call", angle: 90, end: false }],
        links: [{ x: 1, y: 2, width: 3, height: 4, page: 1, title: "Back" }],
      },
    ],
  });
  fuzzed("is rejected in one sentence or within its bounds", 3000, (random) => {
    const text = random.mutate(sound, wildPieces);
    let value: unknown;
    try {
      value = JSON.parse(text);
    } catch {
      return;
    }
    try {
      const book = parseManifest(value, "https://library.example/book.json", "book.json");
      expect(book.pages.length, clue(text)).toBeLessThanOrEqual(limits.pages);
      expect(book.title.length).toBeLessThanOrEqual(limits.titleLength);
      for (const { src, size } of book.pages) {
        expect(src, clue(text)).toMatch(/^(https?|blob|data):/);
        for (const side of size ? [size.width, size.height] : [1]) {
          expect(side > 0 && side <= limits.pageSide, clue(text)).toBe(true);
        }
      }
    } catch (error) {
      expect(error, clue(text)).toBeInstanceOf(BookError);
      expect((error as Error).message, clue(text)).toMatch(/^[^\n]+\.$/);
    }
  });
});

describe("mutated places in the browser's storage", () => {
  const sound =
    '[["a",7,1.5,[2,9],[],null,[[0,1,0.2]],[[5,0.4,0,0.5,1,160]],{"tilt":"6","theme":"night"}],["b",3,1,[]],["a",1,8,[1,2,3]]]';
  fuzzed(
    "are nothing or within their bounds, and give way to what is kept next",
    5000,
    (random) => {
      let text = random.mutate(sound, wildPieces);
      vi.stubGlobal("localStorage", {
        getItem: () => text,
        setItem: (_: string, value: string) => {
          text = value;
        },
      });
      const before = text;
      const kept = loadPlace("a");
      if (kept !== null) {
        expect(Number.isInteger(kept.page) && kept.page >= 1, clue(before)).toBe(true);
        expect(kept.zoom >= 1 && kept.zoom <= 8, clue(before)).toBe(true);
        expect(kept.bookmarks.length).toBeLessThanOrEqual(500);
        expect(kept.folds.length).toBeLessThanOrEqual(500);
        expect(kept.pageFolds.length).toBeLessThanOrEqual(500);
        for (const { page, from, to, angle } of kept.pageFolds) {
          const isSound = [from.x, from.y, to.x, to.y].every((at) => at >= 0 && at <= 1);
          expect(page >= 1 && isSound && Math.abs(angle) <= 180, clue(before)).toBe(true);
        }
        const known = ["tilt", "theme", "dark-pages"];
        for (const [name, value] of Object.entries(kept.seen)) {
          expect(known.includes(name) && value.length <= 20, clue(before)).toBe(true);
        }
        expect(kept.bookmarks.every((page) => Number.isInteger(page) && page >= 1)).toBe(true);
      }
      const place = { page: 5, zoom: 2, bookmarks: [1], shifts: [3] };
      const next = { ...place, folds: [], pageFolds: [], seen: { theme: "night" } };
      savePlace("a", next);
      expect(loadPlace("a"), clue(before)).toEqual(next);
    },
  );
});

describe("mutated attributes and addresses", () => {
  fuzzed("hard-pages names pages of the book alone", 5000, (random) => {
    const list = random.mutate("1-2,9, 4 - 7", wildPieces);
    const pages = pagesNamed(list, 12);
    const isInBook = (page: number) => Number.isInteger(page) && page >= 1 && page <= 12;
    expect(pages.every(isInBook), clue(list)).toBe(true);
    expect(new Set(pages).size).toBe(pages.length);
  });

  fuzzed("duration is 0 to a minute", 5000, (random) => {
    const text = random.mutate("800", wildPieces);
    const seconds = turnSecondsOf({ getAttribute: () => text } as unknown as Element);
    expect(seconds >= 0 && seconds <= 60, clue(text)).toBe(true);
  });

  fuzzed("page is a number or none", 5000, (random) => {
    const text = random.mutate("23", wildPieces);
    const page = pageNumber(text);
    expect(page === null || !Number.isNaN(page), clue(text)).toBe(true);
  });

  fuzzed("the fragment names a page from 1 or none", 5000, (random) => {
    const hash = random.mutate("#a=b&page=12", wildPieces);
    const page = pageOfHash(hash);
    const isPage = page !== null && Number.isInteger(page) && page >= 1 && page < 1e6;
    expect(page === null || isPage, clue(hash)).toBe(true);
  });

  fuzzed("model-src names 2 to 120 photographs or is rejected in one sentence", 5000, (random) => {
    const address = random.mutate("turn-{01-24}.webp#ratio=2:3", wildPieces);
    try {
      const { addresses, ratio } = photographRow(address, "https://library.example/");
      expect(addresses.length >= 2 && addresses.length <= 120, clue(address)).toBe(true);
      expect(ratio === null || (ratio >= 0.1 && ratio <= 10), clue(address)).toBe(true);
    } catch (error) {
      expect(error, clue(address)).toBeInstanceOf(BookError);
    }
  });
});

describe("a mutated image's header", () => {
  const hex = (bytes: string) => Uint8Array.from(bytes.match(/../g) ?? [], (b) => parseInt(b, 16));
  const exif = "ffe100224578696600004d4d002a00000008000101120003000000010006000000000000";
  const images = [
    hex("89504e470d0a1a0a0000000d4948445200000003000000040800000000000000004944415400000000"),
    hex("524946461600000057454250565038580a00000010000000020000030000"),
    hex("524946461a000000574542505650382030000000d001009d012a03000400"),
    hex("524946461a000000574542505650384c0d0000002f02c00000"),
    hex(`ffd8${exif}ffc0001108000200030301220002110103110100ffd9`),
    hex("47494638396103000200800000ffffff00000021f90400000000002c0000000003000200000202447e003b"),
  ];
  fuzzed("tells a size in numbers or none", 4000, async (random) => {
    const bytes = Uint8Array.from(random.among(images));
    for (let k = random.below(6); k > 0; k--) {
      const at = random.below(bytes.length);
      bytes[at] = random.among([0, 255, 1, random.below(256)]);
    }
    const cut = random.below(4) === 0 ? bytes.subarray(0, random.below(bytes.length)) : bytes;
    const size = await sizeFromHeader(await typedImage(new Blob([cut])));
    if (size === null) return;
    const sides = [size.width, size.height];
    expect(
      sides.every((side) => Number.isFinite(side) && side >= 0),
      clue([...cut]),
    ).toBe(true);
  });
});
