/** Runs in a Chromium that draws elements on canvases: see vitest.config.ts. */

import { afterEach, beforeEach, expect, test } from "vitest";
import "../index.ts";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import {
  book,
  drawRoughly,
  happens,
  keepWhatIsDrawn,
  settled,
} from "../for_tests/element_books.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";

const isThere = "drawElementImage" in CanvasRenderingContext2D.prototype;

keepWhatIsDrawn();
drawRoughly();

beforeEach(({ skip }) => skip(!isThere, "This Chromium draws no elements on canvases."));

afterEach(() => {
  for (const element of document.querySelectorAll("turnleaf-book")) element.remove();
});

/** Opens a book of sections at page 2. */
async function openBook(markup: readonly string[]): Promise<[TurnleafBook, HTMLElement[]]> {
  const pages = markup.map((html) => {
    const section = document.createElement("section");
    section.style.cssText = "width: 200px; height: 300px; font: 20px serif";
    section.innerHTML = html;
    return section;
  });
  const element = book(null, { cover: "none" });
  element.append(...pages);
  await happens(element, "load");
  await element.goTo(2, { motion: false });
  await settled(element);
  await clock.until(() => root(element).querySelector(".drawings") !== null);
  return [element, pages];
}

/** Takes the leaf on the right and holds it in the air. Returns what lets it go. */
async function holdLeaf(element: TurnleafBook): Promise<() => Promise<void>> {
  const pointer = new TestPointer(element);
  pointer.point("pointerdown", 240, 110);
  await pointer.move([240, 110], [150, 90]);
  await clock.until(() => element.state === "dragged");
  await clock.until(() => drawings(element).length === 4);
  return async () => {
    pointer.point("pointerup", 150, 90);
    await settled(element);
    await clock.until(() => drawings(element).length === 0);
  };
}

const root = (element: TurnleafBook): ShadowRoot => element.shadowRoot as ShadowRoot;

/** The canvases that contain elements now. */
const drawings = (element: TurnleafBook): HTMLCanvasElement[] => [
  ...root(element).querySelectorAll<HTMLCanvasElement>(".drawings > canvas"),
];

/** Returns the fraction of the book's canvas on which red, green or blue (0 to 2) stands out. */
function colored(element: TurnleafBook, color: number): number {
  const shown = root(element).querySelector('[part="stage"] > canvas') as HTMLCanvasElement;
  const copy = new OffscreenCanvas(150, 110);
  const pen = copy.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.drawImage(shown, 0, 0, copy.width, copy.height);
  const { data } = pen.getImageData(0, 0, copy.width, copy.height);
  let found = 0;
  for (let k = 0; k < data.length; k += 4) {
    const others = [0, 1, 2].filter((c) => c !== color).map((c) => data[k + c]);
    if (data[k + color] > 2 * Math.max(...others) && data[k + color] > 60) found++;
  }
  return found / (copy.width * copy.height);
}

const plain = ["<p>1</p>", "<p>2</p>", "<p>3</p>", "<p>4</p>", "<p>5</p>", "<p>6</p>"];

test("a page that changes in the air is seen to change", async () => {
  const [element, pages] = await openBook(plain);
  const letGo = await holdLeaf(element);
  expect(colored(element, 0)).toBeLessThan(0.01);
  pages[3].style.background = "#f00";
  await clock.until(() => colored(element, 0) > 0.02);
  pages[3].style.background = "#00f";
  await clock.until(() => colored(element, 2) > 0.02);
  expect(colored(element, 0)).toBeLessThan(0.01);
  expect(element.state).toBe("dragged");
  await letGo();
});

test("what moves by CSS, on a canvas or in a film moves in the air", async () => {
  const [element, pages] = await openBook([
    "<p>1</p>",
    "<div style='height: 300px; background: #0f0; animation: 1s steps(2, jump-none) infinite alternate slide'></div>",
    "<p>3</p>",
    "<canvas width=200 height=300></canvas>",
    "<video muted style='width: 200px; height: 300px'></video>",
  ]);
  const sheet = new CSSStyleSheet();
  sheet.replaceSync("@keyframes slide { to { transform: translateY(300px) } }");
  document.adoptedStyleSheets.push(sheet);
  const film = document.createElement("canvas");
  const pens = [film, pages[3].querySelector("canvas")].map((canvas) => canvas?.getContext("2d"));
  const video = pages[4].querySelector("video") as HTMLVideoElement;
  video.muted = true;
  video.srcObject = film.captureStream();
  /** Paints the canvas and the film, white or in their colors. */
  const paint = (isWhite: boolean): void => {
    for (const [k, pen] of pens.entries()) {
      if (!pen) continue;
      pen.fillStyle = isWhite ? "#fff" : ["#f00", "#00f"][k];
      pen.fillRect(0, 0, 200, 300);
    }
  };
  paint(true);
  await video.play();
  const letGo = await holdLeaf(element);
  for (let twice = 0; twice < 2; twice++) {
    for (const isWhite of [false, true]) {
      await clock.until(() => {
        // Each time: a film may miss a picture.
        paint(isWhite);
        return [0, 2].every((color) =>
          isWhite ? colored(element, color) < 0.01 : colored(element, color) > 0.02,
        );
      });
    }
    // What slides goes by the browser's own clock.
    await clock.until(() => colored(element, 1) > 0.02);
    await clock.until(() => colored(element, 1) < 0.01);
  }
  await letGo();
  document.adoptedStyleSheets = document.adoptedStyleSheets.filter((other) => other !== sheet);
});

test("a turn leaves focus, scrolling, motion and frames of a page as they are", async () => {
  const [element, [, page]] = await openBook([
    "<p>1</p>",
    "<input><div style='height: 40px; overflow: auto'><p style='height: 200px'>Long</div><iframe srcdoc='<p>In</p>'></iframe><i></i>",
    ...plain,
  ]);
  const field = page.querySelector("input") as HTMLInputElement;
  const scrolled = page.querySelector("div") as HTMLElement;
  const frame = page.querySelector("iframe") as HTMLIFrameElement;
  const moving = page.querySelector("i")?.animate({ opacity: [0, 1] }, 60_000) as Animation;
  (frame.contentWindow as Window & { mark?: string }).mark = "kept";
  field.focus();
  scrolled.scrollTop = 30;
  const letGo = await holdLeaf(element);
  expect(document.activeElement).toBe(field);
  await letGo();
  expect([scrolled.scrollTop, moving.playState]).toEqual([30, "running"]);
  expect((frame.contentWindow as Window & { mark?: string }).mark).toBe("kept");
});

// Where it is busy Chromium now and then paints what has not changed a second time: that is drawn.
test("pages that do not change keep their pictures, and lie in their places after the turn", {
  retry: 2,
}, async () => {
  const [element, pages] = await openBook(plain);
  const letGo = await holdLeaf(element);
  // Nothing was drawn on them: a canvas is 300 pixels wide until it has a page's size.
  expect(drawings(element).map(({ width }) => width)).toEqual([300, 300, 300, 300]);
  await letGo();
  await element.goTo(4);
  await settled(element);
  const usable = root(element).querySelectorAll(".elements.seen > div:not([inert]) > slot");
  expect([...usable].map((slot) => (slot as HTMLSlotElement).assignedElements()[0])).toEqual([
    pages[3],
    pages[4],
  ]);
});

test("a book that closes in a turn gives its elements back", async () => {
  const [element, pages] = await openBook(plain);
  await holdLeaf(element);
  element.remove();
  expect(root(element).querySelector(".drawings")).toBeNull();
  expect(pages[2].parentNode).toBe(element);
});
