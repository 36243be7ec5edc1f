/** Every frame of a turn shows pages, and never blank paper in their place. */

import { afterEach, expect, test } from "vitest";
import type { TurnleafBook } from "./element.ts";
import { book, drawRoughly, happens, settled } from "./for_tests/element_books.ts";

drawRoughly();

const request = globalThis.requestAnimationFrame;

afterEach(() => {
  globalThis.requestAnimationFrame = request;
  document.body.replaceChildren();
});

/** A page that is blue from edge to edge. */
function bluePage(): string {
  const canvas = document.createElement("canvas");
  canvas.width = 90;
  canvas.height = 120;
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#3060d0";
  pen.fillRect(0, 0, 90, 120);
  return canvas.toDataURL();
}

/** Returns the fraction of the book in the picture that is blue; 0 if no book is in it. */
function blueFraction(element: TurnleafBook): number {
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const [width, height] = [150, 110];
  const copy = new OffscreenCanvas(width, height).getContext("2d");
  if (copy === null) throw new Error("There is no canvas to look with.");
  copy.drawImage(canvas, 0, 0, width, height);
  const { data } = copy.getImageData(0, 0, width, height);
  let [blue, all] = [0, 0];
  for (let at = 0; at < data.length; at += 4) {
    // The book's shadow on the table is not opaque.
    if (data[at + 3] < 250) continue;
    all++;
    if (data[at + 2] > data[at] * 1.5) blue++;
  }
  return all > 0 ? blue / all : 0;
}

test("no frame of a turn, there or back, shows blank paper or no book", async () => {
  const page = bluePage();
  const element = book(
    Array.from({ length: 8 }, () => ({ src: page })),
    { cover: "none", page: "2", duration: "600" },
  );
  await happens(element, "load");
  await settled(element);
  // A page that was never visible may still be on its way: here all pages have been.
  for (const to of [4, 6, 4]) await element.goTo(to);
  await settled(element);

  const fractions: number[] = [];
  // The canvas holds its picture until the frame is over.
  globalThis.requestAnimationFrame = (call) =>
    request((time) => {
      call(time);
      fractions.push(blueFraction(element));
    });
  expect(await element.next()).toBe(true);
  expect(await element.previous()).toBe(true);
  await settled(element);
  const rest = fractions.at(-1) ?? 0;
  expect(rest).toBeGreaterThan(0.7);
  expect(fractions.length).toBeGreaterThan(4);
  // A blank page would be nearly half of it.
  expect(Math.min(...fractions)).toBeGreaterThan(0.75 * rest);
});
