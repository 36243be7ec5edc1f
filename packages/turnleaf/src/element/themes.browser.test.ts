import { afterEach, expect, test } from "vitest";
import { book, happens, scans } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { pixels } from "../for_tests/picture_measures.ts";
import { toolSession } from "../for_tests/real_mouse.ts";
import { prose, tinyEpub } from "../sources/epub/tiny_epub.ts";
import type { PagePicture } from "../sources/page_source.ts";
import { tinyPdf } from "../sources/tiny_pdf.ts";
import { themeLooks } from "../themes.ts";

afterEach(() => document.querySelector("turnleaf-book")?.remove());

type Book = ReturnType<typeof book>;

/** Returns the colour of a page at fractions of its width and height. */
async function colourAt(element: Book, page: number, x: number, y: number): Promise<string> {
  const picture: PagePicture = await element.drawPage(page, 100);
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
  pen?.drawImage(picture, 0, 0);
  const at = [Math.floor(x * picture.width), Math.floor(y * picture.height)] as const;
  return [...(pen?.getImageData(...at, 1, 1).data ?? [])].slice(0, 3).join();
}

/** Returns how dark and how bright a page is at its darkest and at its brightest, 0 to 255. */
async function extremesOf(element: Book, page: number): Promise<[number, number]> {
  const picture = await element.drawPage(page, 400);
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
  pen?.drawImage(picture, 0, 0);
  const { data } = pen?.getImageData(0, 0, picture.width, picture.height) ?? { data: [] };
  const greens = Array.from({ length: data.length / 4 }, (_, k) => data[4 * k + 1] ?? 0);
  return [greens.reduce((a, b) => Math.min(a, b), 255), greens.reduce((a, b) => Math.max(a, b), 0)];
}

/** Returns the colours of all pixels of a page. */
async function coloursOn(element: Book, page: number): Promise<Set<string>> {
  const { data } = pixels(await element.drawPage(page, 400));
  const hex = (at: number): string => (data[at] ?? 0).toString(16).padStart(2, "0");
  const places = Array.from({ length: data.length / 4 }, (_, k) => 4 * k);
  return new Set(places.map((at) => `#${hex(at)}${hex(at + 1)}${hex(at + 2)}`));
}

async function opened(pages: Book["pages"], attributes: Record<string, string>): Promise<Book> {
  const element = book(pages, { duration: "0", ...attributes });
  await happens(element, "load");
  return element;
}

test("text is set in the colours of the theme, at once and when it changes, whatever the book's own are", async () => {
  const css = "html { background: #ff0 } p { color: #222; background: #eee } ";
  const element = await opened(tinyEpub({ chapters: [prose(8)], css }), { theme: "night" });
  const before = element.pageCount;
  expect(await colourAt(element, 1, 0.01, 0.01)).toBe("28,27,26");
  expect((await extremesOf(element, 1))[0]).toBeGreaterThanOrEqual(26);
  expect((await extremesOf(element, 1))[1]).toBeGreaterThan(150);
  element.theme = "sepia";
  expect(await colourAt(element, 1, 0.01, 0.01)).toBe("244,236,216");
  element.theme = "light";
  expect(await colourAt(element, 1, 0.01, 0.01)).toBe("255,255,0");
  // Nothing is laid out anew for it.
  expect(element.pageCount).toBe(before);
});

test("links in text have a colour of the theme that other words have not", async () => {
  const css = "p { font: bold 60px sans-serif } a { color: #a00; text-decoration: none }";
  const chapters = ['<p><a href="https://example.org/"><i>HI</i></a> HI</p>'];
  const element = await opened(tinyEpub({ chapters, css }), {});
  for (const theme of ["sepia", "grey", "night"] as const) {
    element.theme = theme;
    const colours = await coloursOn(element, 1);
    const { ink, link } = themeLooks[theme];
    expect([colours.has(ink), colours.has(link)], theme).toEqual([true, true]);
  }
});

test("pictures in text keep their colours, and lie on white where they are clear", async () => {
  const svg =
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2 1"><rect width="1" height="1" fill="#f00"/></svg>';
  const chapters = ['<p>x</p><img src="p.svg" alt="" style="display: block; width: 100%"/>'];
  const element = await opened(tinyEpub({ chapters, files: { "p.svg": svg } }), { theme: "night" });
  expect(await colourAt(element, 1, 0.3, 0.3)).toBe("255,0,0");
  expect(await colourAt(element, 1, 0.7, 0.3)).toBe("255,255,255");
});

test("by night the web page's own print has the open pages by day: white paper, pictures in their colours", async () => {
  const svg =
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2 1"><rect width="2" height="1" fill="#f00"/></svg>';
  const chapters = ['<p>x</p><img src="p.svg" alt="" style="display: block; width: 100%"/>'];
  const epub = tinyEpub({ chapters, files: { "p.svg": svg } });
  const cover = "0.8 0.1 0.1 rg 0 0 2000 2000 re f";
  const kinds: readonly (readonly [string, Book["pages"], string])[] = [
    ["an EPUB", epub, "255,0,0"],
    ["a PDF's cover", tinyPdf({ pages: [cover, "", "", "", "", ""] }), "204,26,26"],
  ];
  for (const [name, pages, colour] of kinds) {
    const element = await opened(pages, { theme: "night" });
    const root = element.shadowRoot as ShadowRoot;
    const stage = root.querySelector("[part=stage]") as HTMLElement;
    const bookCanvas = root.querySelector("[part=canvas]") as HTMLElement;
    const drawn = () => [...root.querySelectorAll<HTMLCanvasElement>(".by-day canvas")];
    await eventually(() => drawn().length).toBe(1);
    const [page] = drawn();
    const at = (x: number, y: number): string => {
      const pen = (page as HTMLCanvasElement).getContext("2d");
      const [left, top] = [x * (page?.width ?? 0), y * (page?.height ?? 0)].map(Math.floor);
      return [...(pen?.getImageData(left as number, top as number, 1, 1).data ?? [])].join();
    };
    expect(at(0.3, 0.25), name).toBe(`${colour},255`);
    if (pages === epub) expect(at(0.3, 0.9)).toBe("255,255,255,255");
    window.dispatchEvent(new Event("beforeprint"));
    await toolSession().send("Emulation.setEmulatedMedia", { media: "print" });
    const printed = [page?.checkVisibility(), getComputedStyle(bookCanvas).visibility];
    const { filter } = getComputedStyle(stage);
    const box = page?.getBoundingClientRect() as DOMRect;
    await toolSession().send("Emulation.setEmulatedMedia", { media: "" });
    expect([...printed, filter], name).toEqual([true, "hidden", "none"]);
    expect(box.width, name).toBeGreaterThan(50);
    expect(page?.checkVisibility(), name).toBe(false);
    // By day the book itself is printed.
    element.theme = "light";
    await eventually(() => drawn().length).toBe(0);
    element.remove();
  }
});

test("a document is inverted by lightness and keeps hues, or dimmed if its reader says so", async () => {
  const page = "1 0 0 rg 20 20 60 60 re f 0 0 0 rg 100 100 60 60 re f";
  const element = await opened(tinyPdf({ pages: [page, page] }), { theme: "night" });
  expect(element.darkPagesNow).toBe("invert");
  expect(await colourAt(element, 1, 0.02, 0.02)).toBe("28,27,26");
  expect(await colourAt(element, 1, 0.6, 0.6)).toBe("201,197,189");
  const [red = 0, green = 0, blue = 0] = (await colourAt(element, 1, 0.2, 0.85))
    .split(",")
    .map(Number);
  expect(red).toBeGreaterThan(green + 30);
  expect(Math.abs(green - blue)).toBeLessThan(12);
  element.darkPages = "dim";
  expect(await colourAt(element, 1, 0.02, 0.02)).toBe("204,204,204");
  element.theme = "sepia";
  expect(await colourAt(element, 1, 0.02, 0.02)).toBe("244,236,216");
});

test("scans are dimmed by night, inverted if their reader says so, and else as they are", async () => {
  const element = await opened(scans(4), { theme: "night" });
  expect(element.darkPagesNow).toBe("dim");
  expect(await colourAt(element, 2, 0.9, 0.1)).toBe("195,187,168");
  element.darkPages = "invert";
  const [red = 255] = (await colourAt(element, 2, 0.9, 0.1)).split(",").map(Number);
  expect(red).toBeLessThan(60);
  element.theme = "sepia";
  expect(await colourAt(element, 2, 0.9, 0.1)).toBe("244,234,210");
});

test("the reader chooses in the menu, where dark pages have a choice of their own", async () => {
  const element = await opened(scans(4), { controls: "", theme: "light" });
  const root = element.shadowRoot as ShadowRoot;
  await eventually(() => root.querySelector(".menu") !== null).toBe(true);
  root.querySelector<HTMLButtonElement>('[aria-haspopup="menu"]')?.click();
  const pages = root.querySelector<HTMLElement>(".menu .dark-pages") as HTMLElement;
  const items = [...root.querySelectorAll<HTMLButtonElement>(".menu .swatches button")];
  expect(items.map(({ textContent }) => textContent)).toEqual([
    "Auto",
    "Light",
    "Sepia",
    "Grey",
    "Night",
  ]);
  expect(pages.hidden).toBe(true);
  items[4]?.click();
  expect(element.theme).toBe("night");
  expect(pages.hidden).toBe(false);
  pages.querySelector("button")?.click();
  expect(element.darkPages).toBe("invert");
});

test("a book without controls and a theme is light, whatever the system has", async () => {
  const element = await opened(tinyPdf({ pages: [""] }), {});
  expect(await colourAt(element, 1, 0.5, 0.5)).toBe("255,255,255");
});
