/** Random folds of a book's pages, leaves torn out of it, and what undoes both. */

import type { TurnleafBook } from "../element.ts";
import type { Content } from "./hue_pages.ts";
import { hues, partOf, pixels } from "./picture_measures.ts";
import { TestPointer } from "./test_pointer.ts";

/** What folds and tears need of what draws them. */
export interface FoldHost {
  readonly element: () => TurnleafBook;
  /** Returns a number from 0 to 1. */
  readonly random: () => number;
  /** Whether each operation may first turn to another page. */
  readonly turns: boolean;
  /** Puts the pages that were torn out last back. */
  readonly putBack: () => Promise<void>;
}

/** Leaves that a book keeps when others are torn out: half of those of the smallest book. */
const leastPages = 8;

/** Steps in which a pointer pulls a leaf out, and how far each, in page widths. */
const pullSteps = 12;
const pullStep = 0.12;

/** Width of a page drawn to see its hue, pixels, and the least part of it that has that. */
const drawnWidth = 8;
const leastOfHue = 0.9;

/** Folds, tears and their undoing, by their names. */
export function foldOperations(host: FoldHost): Readonly<Record<string, () => Promise<void>>> {
  const { element, random } = host;
  const between = (least: number, most: number): number => least + random() * (most - least);
  const among = <T>(values: readonly T[]): T => values[Math.floor(random() * values.length)];

  /** Turns to another page, now and then. Returns one that lies open, or now and then any. */
  const page = async (): Promise<number> => {
    const any = () => Math.ceil(between(0, element().pageCount));
    if (host.turns && random() < 0.3) await element().goTo(any(), { motion: false });
    const { left, right } = element().spread;
    const open = [left, right].filter((page) => page !== null);
    return random() < 0.8 && open.length > 0 ? among(open) : Math.max(any(), 1);
  };

  const fold = async (
    of: number,
    lines: readonly (readonly [number, number, number, number, number])[],
  ): Promise<void> => {
    // One after the other, as a letter is folded.
    const folds = lines.map(([x, y, toX, toY, angle]) =>
      element().fold(of, { x, y }, { x: toX, y: toY }, angle).catch(ignoreRejection),
    );
    await Promise.all(folds);
  };
  const angle = (): number => among([160, 160, 175, 180, 120, 60, -160, -90]);

  return {
    dogEar: async () => {
      await element().dogEar(await page(), among(["head", "foot"]), between(0.05, 0.5));
    },
    foldInTwo: async () => {
      const [of, x] = [await page(), between(0.2, 0.8)];
      await fold(of, [[x, 0, x, 1, angle()]]);
    },
    foldAcross: async () => {
      const of = await page();
      await fold(of, [[between(0.1, 0.9), 0, between(0.1, 0.9), 1, angle()]]);
    },
    letter: async () => {
      const of = await page();
      const isRight = element().spread.right === of;
      const [outer, inner] = isRight ? [0.7, 0.4] : [0.3, 0.6];
      await fold(of, [
        [outer, 0, outer, 1, 175],
        [inner, 0, inner, 1, 160],
      ]);
    },
    unfold: async () => {
      const folded = [...element().folds, ...element().dogEars];
      const of = folded.length > 0 && random() < 0.8 ? among(folded).page : await page();
      await element().unfold(of);
    },
    tear: async () => {
      const of = await page();
      if (element().pageCount > leastPages) await element().tearOut(of);
    },
    tearByHand: async () => {
      await page();
      if (element().pageCount > leastPages)
        await pull(element(), random() < 0.5 ? 1 : -1, random());
    },
    putBack: host.putBack,
    putAllBack: async () => {
      for (let k = element().tornLeaves; k > 0; k--) await host.putBack();
    },
  };
}

/** Ignores that a page cannot be folded so, which is said in one sentence. */
function ignoreRejection(error: unknown): void {
  if (!(error instanceof Error && error.name === "BookError")) throw error;
}

/** Pulls a page outward at its edge, on the right (1) or the left (-1), at a fraction of its height, and lets go. */
async function pull(element: TurnleafBook, side: number, at: number): Promise<void> {
  const bounds = element.bookBounds;
  if (bounds === null || !element.shadowRoot?.querySelector("canvas")) return;
  const pointer = new TestPointer(element);
  const edge = side > 0 ? bounds.right : bounds.left;
  const more = { pointerId: 7, buttons: 1 };
  const place = (out: number): [number, number] => [
    edge + side * out * (bounds.width / 2),
    bounds.top + (0.05 + 0.9 * at) * bounds.height,
  ];
  pointer.point("pointerdown", ...place(-0.05), more);
  for (let k = 1; k <= pullSteps; k++) {
    pointer.point("pointermove", ...place(k * pullStep), more);
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  pointer.point("pointerup", ...place(pullSteps * pullStep), more);
}

/**
 * Returns a sentence for each thing by which a book differs from one that has no folds and these
 * pages: what is listed, how many pages there are, and the hue of each.
 */
export async function differences(
  element: TurnleafBook,
  before: readonly Content[],
): Promise<string[]> {
  const found: string[] = [];
  const { folds, dogEars, pageCount } = element;
  if (folds.length + dogEars.length > 0) {
    found.push(`${folds.length} folds and ${dogEars.length} corners are listed`);
  }
  if (pageCount !== before.length) found.push(`${pageCount} pages in place of ${before.length}`);
  for (const [k, content] of before.entries()) {
    if (content === "print" || k >= pageCount) continue;
    const part = partOf(hues(pixels(await element.drawPage(k + 1, drawnWidth))), content);
    if (part < leastOfHue) found.push(`page ${k + 1} has ${part} of its hue ${content}`);
  }
  return found;
}
