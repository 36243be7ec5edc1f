/** Canvases of pages that are elements, painted by script, seen while their leaves turn. */

import { afterEach, expect, test } from "vitest";
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

keepWhatIsDrawn();
drawRoughly();

afterEach(() => document.body.replaceChildren());

/** Opens a book at page 2, each page with a canvas that nothing is painted on yet. */
async function opened(): Promise<{ element: TurnleafBook; canvases: HTMLCanvasElement[] }> {
  const pages = Array.from({ length: 6 }, () => {
    const section = document.createElement("section");
    section.style.cssText = "width: 200px; height: 300px; padding: 20px";
    section.innerHTML = "<div><canvas width=160 height=260></canvas></div>";
    return section;
  });
  const element = book(null, { cover: "none" });
  element.append(...pages);
  await happens(element, "load");
  await element.goTo(2, { motion: false });
  await clock.until(() => element.ready);
  return {
    element,
    canvases: pages.map((page) => page.querySelector("canvas") as HTMLCanvasElement),
  };
}

function paint(canvas: HTMLCanvasElement, colour: string): void {
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = colour;
  pen.fillRect(0, 0, canvas.width, canvas.height);
}

/** Returns the fraction of the book's picture in which red stands out. */
function redIn(element: TurnleafBook): number {
  const shown = element.shadowRoot?.querySelector('[part="stage"] > canvas') as HTMLCanvasElement;
  const pen = new OffscreenCanvas(150, 110).getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.drawImage(shown, 0, 0, 150, 110);
  const { data } = pen.getImageData(0, 0, 150, 110);
  let found = 0;
  for (let k = 0; k < data.length; k += 4) {
    if (data[k] > 2 * Math.max(data[k + 1], data[k + 2]) && data[k] > 60) found++;
  }
  return found / (150 * 110);
}

// The boards have some red.
test("a canvas is seen in the air as it is painted when its leaf takes off", async () => {
  const { element, canvases } = await opened();
  expect(redIn(element)).toBeLessThan(0.01);
  paint(canvases[2], "#f00");
  const pointer = new TestPointer(element);
  pointer.point("pointerdown", 240, 110);
  await pointer.move([240, 110], [200, 100]);
  await settled(element);
  // The page on the right, in the air with its margins: a large part of a quarter of the picture.
  expect(redIn(element)).toBeGreaterThan(0.05);
  pointer.point("pointerup", 240, 110);
  await settled(element);
  paint(canvases[2], "#00f");
  pointer.point("pointerdown", 240, 110);
  await pointer.move([240, 110], [200, 100]);
  await settled(element);
  expect(redIn(element)).toBeLessThan(0.01);
  pointer.point("pointerup", 240, 110);
  await settled(element);
});

test("redraw draws a page as its canvas is painted now", async () => {
  const { element, canvases } = await opened();
  paint(canvases[2], "#f00");
  element.redraw(3);
  await settled(element);
  const picture = await element.drawPage(3, 100);
  const pen = new OffscreenCanvas(100, 150).getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.drawImage(picture, 0, 0, 100, 150);
  expect([...pen.getImageData(50, 75, 1, 1).data]).toEqual([255, 0, 0, 255]);
});
