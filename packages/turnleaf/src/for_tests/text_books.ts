/** Books with text over their pages, for tests in a browser. */

import { expect } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { tinyPdf } from "../sources/tiny_pdf.ts";
import { book, happens, settled } from "./element_books.ts";
import { eventually } from "./eventually.ts";

/** The resources of a PDF's page that has lines of text. */
export const fonts = "/Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >>";
/**
 * Returns a line of text on a page of 200 x 300 points, its baseline at a
 * height above the foot.
 */
export const line = (text: string, y: number, x = 30): string =>
  `BT /F1 16 Tf ${x} ${y} Td (${text}) Tj ET\n`;
const link = (target: string): string =>
  `<< /Type /Annot /Subtype /Link /Rect [20 90 180 125] ${target} >>`;

/** Returns a PDF of eight pages; the second and third lie open together. */
function whalePdf(): File {
  const pages = Array.from({ length: 8 }, (_, i) => line(`Page number ${i + 1}`, 150));
  pages[1] =
    line("Call me", 230) + line("Ishmael. Some", 205) + line("years ago", 180) + line("End", 100);
  pages[2] = line("never mind how", 230) + line("long Ishmael", 205);
  const bytes = tinyPdf({
    pages,
    resources: `${fonts} >> /Annots [10 0 R] /Ignored <<`,
    objects: [link("/Dest [6 /Fit]")],
    catalog: "/Lang (en-GB) /PageLabels << /Nums [0 << /S /r >>] >>",
  });
  return new File([bytes], "whale.pdf");
}

/** Returns the pieces of text over a book. */
export const spansOf = (element: TurnleafBook): HTMLElement[] => [
  ...(element.shadowRoot?.querySelectorAll<HTMLElement>(".text span") ?? []),
];

/** Returns the box of a piece of text over a book, which may be laid out in several. */
export function boxIn(element: TurnleafBook, text: string): DOMRect {
  const all = spansOf(element);
  for (let first = all.length - 1; first >= 0; first--) {
    let said = "";
    for (let last = first; last < all.length; last++) {
      said += all[last].textContent;
      if (!said.startsWith(text.slice(0, said.length))) break;
      if (said.trim() !== text) continue;
      const [a, b] = [all[first], all[last]].map((span) => span.getBoundingClientRect());
      return new DOMRect(
        a.left,
        Math.min(a.top, b.top),
        b.right - a.left,
        Math.max(a.bottom, b.bottom) - Math.min(a.top, b.top),
      );
    }
  }
  throw new Error(`No "${text}" on the page.`);
}

/** Resolves to a book of that PDF at its second page, in the upper left corner of the window, once its text is laid. */
export async function openedWhale(): Promise<TurnleafBook> {
  const element = book(null, { cover: "none", page: "2", duration: "60" });
  element.style.cssText = "position: fixed; left: 0; top: 0; width: 640px; height: 460px";
  const loaded = happens(element, "load");
  element.pages = whalePdf();
  await loaded;
  await settled(element);
  await eventually(() => spansOf(element).length).toBeGreaterThan(5);
  return element;
}

/** Moves the view of a book: the text disappears, however shortly, and comes back at rest. */
export async function awayAndBack(element: TurnleafBook, move: () => unknown): Promise<void> {
  const layer = element.shadowRoot?.querySelector(".reading") as HTMLElement;
  const states: boolean[] = [];
  const observer = new MutationObserver(() => states.push(layer.hasAttribute("hidden")));
  observer.observe(layer, { attributeFilter: ["hidden"] });
  await move();
  await eventually(() => states.at(-1)).toBe(false);
  expect(states).toContain(true);
  observer.disconnect();
  await settled(element);
}
