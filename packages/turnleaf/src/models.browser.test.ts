import { afterEach, expect, test } from "vitest";
import type { TurnleafBook } from "./element.ts";
import { clock } from "./for_tests/clock.ts";
import { book, happens, scans, settled } from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { TestPointer } from "./for_tests/test_pointer.ts";
import { type TurnModelName, turnModels } from "./leaf_models/model_choice.ts";

afterEach(() => document.body.replaceChildren());

const ready = (element: TurnleafBook): Promise<void> => eventually(() => element.ready).toBe(true);

/** Opens a book of ten pages with a model, at pages 4 and 5. */
async function opened(
  model: TurnModelName,
  attributes: Record<string, string> = {},
): Promise<TurnleafBook> {
  const element = book(scans(10), {
    model,
    cover: "none",
    duration: "300",
    page: "4",
    ...attributes,
  });
  const failed: string[] = [];
  element.addEventListener("error", (event) => failed.push(event.detail.message));
  await happens(element, "load");
  await ready(element);
  expect(failed).toEqual([]);
  return element;
}

/** Drags from one place of the element to another, in fractions of its size. */
async function drag(element: TurnleafBook, from: [number, number], to: [number, number]) {
  const pointer = new TestPointer(element);
  const at = ([x, y]: [number, number]): [number, number] => [300 * x, 220 * y];
  pointer.point("pointerdown", ...at(from));
  await pointer.move(at(from), at(to));
  // However slow the machine is, the leaf is where the pointer is before the release.
  for (let frame = 0; frame < 40; frame++) {
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  pointer.point("pointerup", ...at(to));
}

/** The models that need no data. */
const modelNames = turnModels.filter((model) => model !== "sheet" && model !== "photographs");

test.for(modelNames)(
  "%s: a command and a drag turn a page, and then nothing runs",
  async (model) => {
    const element = await opened(model);
    expect(await element.next()).toBe(true);
    expect(element.spread).toEqual({ left: 6, right: 7 });
    await ready(element);
    const turned = happens(element, "pagechange");
    await drag(element, [0.08, 0.6], [0.85, 0.5]);
    expect(await turned).toMatchObject({ from: 6, to: 4, direction: "backward" });
    await settled(element);
    let frames = 0;
    const { requestAnimationFrame } = window;
    window.requestAnimationFrame = (call) => {
      frames++;
      return requestAnimationFrame(call);
    };
    await clock.pass(200);
    window.requestAnimationFrame = requestAnimationFrame;
    expect(frames).toBe(0);
  },
);

const ways = [
  { binding: "right", from: [0.08, 0.6], to: [0.85, 0.5] },
  { binding: "top", from: [0.5, 0.85], to: [0.5, 0.1] },
] as const;

test.for(modelNames.flatMap((model) => ways.map((way) => ({ model, ...way }))))(
  "$model, bound at the $binding: a drag turns a leaf",
  async ({ model, binding, from, to }) => {
    const element = await opened(model, { binding });
    const turned = happens(element, "pagechange");
    await drag(element, [...from], [...to]);
    expect(await turned).toMatchObject({ direction: "forward" });
    await settled(element);
  },
);
