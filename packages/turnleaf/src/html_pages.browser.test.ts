import { afterEach, expect, test, vi } from "vitest";
import "./index.ts";
import { userEvent } from "vitest/browser";
import type { TurnleafBook } from "./element.ts";
import { clock } from "./for_tests/clock.ts";
import { book, happens, settled } from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { HtmlPages } from "./sources/html/html_pages.ts";
import type { TextRun } from "./sources/page_source.ts";

afterEach(() => {
  for (const element of document.querySelectorAll("turnleaf-book, section")) element.remove();
});

/** Returns sections, each with some markup. */
function sections(...markup: readonly string[]): HTMLElement[] {
  return markup.map((html, index) => {
    const section = document.createElement("section");
    section.style.cssText = "width: 200px; height: 300px; font: 20px serif";
    section.innerHTML = html;
    section.id = `page-${index + 1}`;
    return section;
  });
}

/** Adds a book of sections to the document, and waits until it lies still. */
async function bookOf(
  pages: readonly HTMLElement[],
  attributes: Record<string, string> = {},
): Promise<TurnleafBook> {
  const element = book(null, { cover: "none", duration: "0", ...attributes });
  element.append(...pages);
  await happens(element, "load");
  await laidOut(element);
  return element;
}

/** The pages that are laid over the book and can be used. */
const usable = (element: TurnleafBook): string[] =>
  [...(element.shadowRoot as ShadowRoot).querySelectorAll<HTMLElement>(".elements.seen > div")]
    .filter((box) => !box.inert)
    .map((box) => (box.firstElementChild as HTMLSlotElement).assignedElements()[0]?.id ?? "");

/** Waits until the open pages lie over the book. */
async function laidOut(element: TurnleafBook): Promise<void> {
  const pages = [element.spread.left, element.spread.right].filter((page) => page !== null);
  await settled(element);
  await eventually(() => usable(element).length).toBe(pages.length);
}

async function goTo(element: TurnleafBook, page: number): Promise<void> {
  await element.goTo(page);
  await laidOut(element);
}

/** Returns the fraction of dark pixels of a drawn page. */
async function inkOf(source: HtmlPages, index: number, width = 200): Promise<number> {
  const picture = await source.draw(index, width, new AbortController().signal);
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.drawImage(picture, 0, 0);
  const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
  let dark = 0;
  for (let k = 0; k < data.length; k += 4) if (data[k] < 128) dark++;
  return dark / (data.length / 4);
}

const plain = ["<h2>One</h2>", "<h2>Two</h2>", "<h2>Three</h2>", "<h2>Four</h2>", "<p>Five</p>"];

test("the children of the element are its pages; those that are open can be used, no others", async () => {
  const pages = sections(...plain);
  const element = await bookOf(pages);
  expect(element.pageCount).toBe(5);
  await goTo(element, 2);
  expect(usable(element)).toEqual(["page-2", "page-3"]);
  expect(pages[1].getBoundingClientRect().width).toBeGreaterThan(20);
  const titles = (await element.outline()).map(({ title, page }) => [title, page]);
  expect(titles).toEqual([
    ["One", 1],
    ["Two", 2],
    ["Three", 3],
    ["Four", 4],
  ]);
  expect((await element.search("Five")).map(({ page }) => page)).toEqual([5]);
});

test.each(["0", "800"])("a field keeps its value over a turn of %s ms", async (duration) => {
  const pages = sections("<input>", "<textarea></textarea>", "<p>3</p>", "<p>4</p>", "<p>5</p>");
  const element = await bookOf(pages, { duration });
  await goTo(element, 2);
  const field = pages[1].querySelector("textarea") as HTMLTextAreaElement;
  await userEvent.click(field);
  await userEvent.keyboard("Ishmael");
  await goTo(element, 4);
  expect(usable(element)).not.toContain("page-2");
  await goTo(element, 2);
  expect(field.value).toBe("Ishmael");
  expect(element.page).toBe(2);
});

test("a button is pressed and a link to an element leads to its page", async () => {
  let pressed = 0;
  const pages = sections("<p>1</p>", "<button>Press</button> <a href='#deep'>Deep</a>", ...plain);
  pages[1].insertAdjacentHTML("beforeend", "<a id='odd' href='#%'>Of no element</a>");
  pages[5].innerHTML = "<h3 id='deep'>Deep</h3>";
  const element = await bookOf(pages);
  await goTo(element, 2);
  const button = pages[1].querySelector("button") as HTMLElement;
  button.addEventListener("click", () => pressed++);
  await userEvent.click(button);
  expect(pressed).toBe(1);
  expect(element.page).toBe(2);
  const failures: unknown[] = [];
  const onFailure = (event: ErrorEvent) => failures.push(event.error);
  window.addEventListener("error", onFailure);
  await userEvent.click(pages[1].querySelector("#odd") as HTMLElement);
  window.removeEventListener("error", onFailure);
  expect(failures).toEqual([]);
  expect(element.page).toBe(2);
  await userEvent.click(pages[1].querySelector("a") as HTMLElement);
  await eventually(() => element.page).toBe(6);
});

test("the keyboard reaches what is on the open pages, in their order, and nothing else", async () => {
  const markup = [1, 2, 3, 4, 5].map((page) => `<button id="b${page}">Press</button>`);
  const element = await bookOf(sections(...markup));
  await goTo(element, 2);
  element.focus();
  await userEvent.keyboard("{Tab}");
  expect(document.activeElement?.id).toBe("b2");
  await userEvent.keyboard("{Tab}");
  expect(document.activeElement?.id).toBe("b3");
  await userEvent.keyboard("{Tab}");
  expect(document.activeElement?.id).not.toMatch(/^b/);
});

test("a field that has the focus as its page turns gives it to the book, whose keys go on", async () => {
  const element = await bookOf(sections(...plain.map((text) => `${text}<input>`)), { page: "2" });
  const page = element.children[1] as HTMLElement;
  page.querySelector("input")?.focus();
  expect(document.activeElement).toBe(page.querySelector("input"));
  await goTo(element, 4);
  expect(document.activeElement).toBe(element);
  await userEvent.keyboard("{ArrowLeft}");
  await eventually(() => element.page).toBe(2);
});

test("a film stops while its page is closed, and goes on when it is open again", async () => {
  const pages = sections("<p>1</p>", "<video muted></video>", "<p>3</p>", "<p>4</p>", "<p>5</p>");
  const film = document.createElement("canvas");
  film.getContext("2d")?.fillRect(0, 0, 10, 10);
  const video = pages[1].querySelector("video") as HTMLVideoElement;
  video.muted = true;
  video.srcObject = film.captureStream();
  const element = await bookOf(pages);
  await goTo(element, 2);
  await video.play();
  await goTo(element, 4);
  expect(video.paused).toBe(true);
  await goTo(element, 2);
  expect(video.paused).toBe(false);
});

test("pages that are added, removed and moved are followed", async () => {
  const pages = sections(...plain);
  const element = await bookOf(pages);
  const changed = happens<{ pageCount: number }>(element, "pageschange");
  const [more] = sections("<h2>More</h2>");
  more.id = "more";
  pages[0].after(more);
  expect((await changed).pageCount).toBe(6);
  await goTo(element, 2);
  expect(usable(element)[0]).toBe("more");
  const fewer = happens<{ pageCount: number }>(element, "pageschange");
  more.remove();
  expect((await fewer).pageCount).toBe(5);
});

test("a page that is taken away is followed no longer, and once when it comes back", async () => {
  const [page, other] = sections("<p>Here</p>", "<p>There</p>");
  const parent = document.createElement("section");
  parent.append(page, other);
  document.body.append(parent);
  const listening = vi.spyOn(page, "addEventListener");
  const source = new HtmlPages([page, other], parent);
  const changes: (() => unknown)[] = [];
  source.watchPages((change) => changes.push(change));
  const follow = async (): Promise<void> => {
    await eventually(() => changes.length).toBe(1);
    changes.pop()?.();
  };
  const open = (): number =>
    listening.mock.calls.filter(
      ([, , options]) => !(options as AddEventListenerOptions).signal?.aborted,
    ).length;
  source.close();
  expect(open()).toBe(0);
  const again = new HtmlPages([page, other], parent);
  again.watchPages((change) => changes.push(change));
  const once = open();
  page.remove();
  await follow();
  expect(open()).toBe(0);
  parent.append(page);
  await follow();
  expect(open()).toBe(once);
  again.close();
});

test("a picture that is given up while it is drawn is closed", async () => {
  const [page] = sections("<p>Quiet</p>");
  document.body.append(page);
  const source = new HtmlPages([page]);
  const giving = new AbortController();
  const bitmaps: ImageBitmap[] = [];
  const { transferToImageBitmap } = OffscreenCanvas.prototype;
  vi.spyOn(OffscreenCanvas.prototype, "transferToImageBitmap").mockImplementation(function (
    this: OffscreenCanvas,
  ) {
    giving.abort();
    const bitmap = transferToImageBitmap.call(this);
    bitmaps.push(bitmap);
    return bitmap;
  });
  await expect(source.draw(0, 100, giving.signal)).rejects.toThrow();
  expect(bitmaps.map(({ width }) => width)).toEqual([0]);
  vi.restoreAllMocks();
  source.close();
});

test("a page whose content changes is drawn again", async () => {
  const [page, other] = sections("<p>Quiet</p>", "");
  document.body.append(page, other);
  const source = new HtmlPages([page, other]);
  const drawn = new Promise<number>((resolve) => source.watchDrawings(resolve));
  expect(await inkOf(source, 1)).toBe(0);
  other.innerHTML = "<div style='height: 150px; background: #000'></div>";
  expect(await drawn).toBe(1);
  expect(await inkOf(source, 1)).toBeCloseTo(0.5, 1);
  source.close();
});

test("a picture has what the page shows: styles, values, what is before and after, drawings", async () => {
  const style = document.createElement("style");
  style.textContent =
    ".before::before { content: ''; display: block; height: 60px; background: #000 }";
  document.head.append(style);
  const [page] = sections(
    "<div class='before'></div><canvas width=100 height=60></canvas><svg width=100 height=60><rect width=100 height=60 /></svg>",
  );
  document.body.append(page);
  page.querySelector("canvas")?.getContext("2d")?.fillRect(0, 0, 100, 60);
  const source = new HtmlPages([page]);
  // A fifth of the page each: all of its width, and twice half of it.
  expect(await inkOf(source, 0)).toBeCloseTo(0.4, 1);
  source.close();
  style.remove();
});

test("a frame is plain paper while it turns", async () => {
  const [page] = sections(
    "<iframe srcdoc='<body style=&quot;background:#000&quot;>' width=200 height=300></iframe>",
  );
  document.body.append(page);
  const source = new HtmlPages([page]);
  expect(await inkOf(source, 0)).toBeLessThan(0.05);
  source.close();
});

test("elements given as pages become children of the book, and leave it with it", async () => {
  const pages = sections(...plain);
  const element = book(pages, { cover: "none", duration: "0" });
  await happens(element, "load");
  expect(pages[0].parentNode).toBe(element);
  element.pages = null;
  expect(pages[0].parentNode).toBe(null);
});

test("elements are inserted among other pages", async () => {
  const element = book([{ src: "data:image/svg+xml,<svg xmlns='http://www.w3.org/2000/svg'/>" }], {
    cover: "none",
    duration: "0",
  });
  await happens(element, "load");
  expect(await element.insertPages(2, sections("<p>In</p>"))).toBe(true);
  expect(element.pageCount).toBe(2);
  await goTo(element, 2);
  expect(usable(element)).toEqual(["page-1"]);
});

test("while a leaf moves the book shows pictures", async () => {
  const element = await bookOf(sections(...plain), { duration: "800" });
  const turned = element.goTo(4);
  await happens(element, "turnstart");
  await eventually(() => usable(element).length).toBe(0);
  await turned;
  await laidOut(element);
});

test.each(["display: none", "a closed dialog"])(
  "pages that are hidden at first, by %s, are measured when they are seen, and kept while they are hidden again",
  async (way) => {
    const around = document.createElement(way === "a closed dialog" ? "dialog" : "div");
    const show = (isShown: boolean): void => {
      if (around instanceof HTMLDialogElement) {
        if (isShown) around.show();
        else around.close();
      } else around.style.display = isShown ? "" : "none";
    };
    show(false);
    const pages = sections("a", "b", "c", "d", "e", "f");
    for (const page of pages) page.style.cssText = "width: 300px; height: 150px; font: 20px serif";
    const element = book(null, { cover: "none", duration: "0", layout: "spread" });
    element.append(...pages);
    around.append(element);
    document.body.append(around);
    await happens(element, "load");
    const failures: unknown[] = [];
    element.addEventListener("pageerror", (event) => failures.push(event));
    const loads: unknown[] = [];
    element.addEventListener("load", (event) => loads.push(event));
    show(true);
    const shapeOf = (): number => {
      const { width, height } = element.bookBounds as DOMRect;
      return width / height;
    };
    await eventually(() => shapeOf() > 1.7).toBe(true);
    await laidOut(element);
    const upright = shapeOf();
    // Two pages of twice their height: wider than the standing ones that were guessed.
    expect(upright).toBeGreaterThan(3);
    const { width, height } = pages[0].getBoundingClientRect();
    expect(width / height).toBeCloseTo(2, 0);
    show(false);
    await clock.pass(500);
    show(true);
    await laidOut(element);
    expect(shapeOf()).toBeCloseTo(upright, 1);
    expect([failures.length, loads.length]).toEqual([0, 0]);
    around.remove();
  },
);

test("what is written on a page is found where it stands, however the book around it is transformed", async () => {
  const text =
    "<p style='margin: 40px 20px; line-height: 30px'>Call me Ishmael. Some <b>years</b> ago</p>";
  const runsIn = async (style: string): Promise<readonly TextRun[]> => {
    const around = document.createElement("div");
    around.style.cssText = `position: fixed; left: 200px; top: 150px; ${style}`;
    document.body.append(around);
    const element = book(null, { cover: "none", duration: "0" });
    const pages = sections(text, text, text, text);
    element.append(...pages);
    around.append(element);
    await happens(element, "load");
    await laidOut(element);
    const source = new HtmlPages([pages[0]]);
    const runs = await source.text(0, new AbortController().signal);
    source.close();
    around.remove();
    return runs;
  };
  const upright = await runsIn("");
  expect(upright.map((run) => run.text)).toEqual(["Call me Ishmael. ", "Some ", "years", "ago"]);
  expect([upright[0].x, upright[2].height]).toEqual([expect.closeTo(20, 0), expect.closeTo(22, 0)]);
  for (const style of [
    "rotate: 20deg",
    "rotate: 45deg",
    "rotate: 90deg",
    "scale: -0.7 0.7",
    "zoom: 1.4",
  ]) {
    const runs = await runsIn(style);
    expect(
      runs.map((run) => run.text),
      style,
    ).toEqual(upright.map((run) => run.text));
    for (const [k, run] of runs.entries()) {
      for (const at of ["x", "y", "width", "height"] as const) {
        expect(Math.abs(run[at] - upright[k][at]), `${style}: ${at} of ${run.text}`).toBeLessThan(
          1,
        );
      }
    }
  }
});
