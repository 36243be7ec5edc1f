/**
 * Photographs of a turn over a book, in real Chromium: which of them is seen
 * where, by its colour.
 */

import type { Group } from "three";
import { afterEach, expect, test, vi } from "vitest";
import type { Turning } from "./book/turning.ts";
import type { BookEngine } from "./engine/book_engine.ts";
import { book, happens, scans } from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { photograph, serve } from "./for_tests/photographs.ts";
import type { ModelledBook } from "./leaf_models/leaf_model.ts";
import { PhotographsModel } from "./leaf_models/photographs.ts";
import type { BookPose, BookShape } from "./stage/book_pose.ts";
import type { PhotographQuad } from "./webgl/photographs_mesh.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});
const unaborted = new AbortController().signal;
/**
 * Returns a book of unit size with stiff leaves in flight, each with a fraction
 * of its turn done.
 */
function flying(fractions: readonly number[], isPeek = false): ModelledBook {
  const flights = fractions.map((_, k) => ({ part: "leaf", low: 4 + k, high: 5 + k, from: 4 + k }));
  const overrideSurface = (index: number): Float32Array => {
    const [x, z] = [Math.cos(Math.PI * fractions[index]), Math.sin(Math.PI * fractions[index])];
    return new Float32Array([0, 0, 0, x, 0, z, 0, 1, 0, x, 1, z]);
  };
  return {
    engine: { columns: new Float32Array([0, 1]), overrideSurface } as unknown as BookEngine,
    turning: { flights } as unknown as Turning,
    shape: { width: 1, height: 1 } as BookShape,
    peek: { flight: isPeek ? flights[0] : null },
  };
}

const pose = { left: null, right: null, leaves: [{}] } as unknown as BookPose;

test("a corner that only lifts stays paper", async () => {
  serve(photograph);
  const model = await PhotographsModel.open("/photographs/{0-4}.png", unaborted);
  model.show(flying([0.5], true));
  expect(model.pose(pose).leaves).toHaveLength(1);
  model.show(flying([0.5]));
  expect(model.pose(pose).leaves).toHaveLength(0);
  model.close();
});

test("of several leaves the steepest lies over the others", async () => {
  // Each is identified by its width.
  serve((number) => photograph(number, 200 + number));
  const model = await PhotographsModel.open("/photographs/{0-4}.png", unaborted);
  const shown = (): number[] =>
    ((model.pose(pose).above as Group | undefined)?.children ?? [])
      .filter(({ visible }) => visible)
      .map((quad) => (quad as PhotographQuad).material.uniforms.picture.value.image.width - 200);
  model.show(flying([0.95, 0.55, 0.2]));
  expect(shown()).toEqual([4, 1, 2]);
  model.show(flying([0.3]));
  expect(shown()).toEqual([1]);
  model.show(flying([]));
  expect(shown()).toEqual([]);
  model.close();
});

test("they are given up with a book that is taken away, and with another choice", async () => {
  const asked: AbortSignal[] = [];
  const { fetch } = globalThis;
  vi.spyOn(globalThis, "fetch").mockImplementation((input, init) => {
    if (!String(input).includes("/photographs/")) return fetch(input, init);
    const signal = init?.signal as AbortSignal;
    asked.push(signal);
    return new Promise((_, reject) =>
      signal.addEventListener("abort", () => reject(signal.reason), { once: true }),
    );
  });
  const element = book(scans(6), { model: "photographs", "model-src": "/photographs/{0-4}.png" });
  const said: string[] = [];
  element.addEventListener("error", (event) => said.push(event.detail.message));
  await happens(element, "load");
  await eventually(() => asked.length).toBe(1);
  element.model = "sheet";
  await eventually(() => asked[0].aborted).toBe(true);
  element.model = "photographs";
  await eventually(() => asked.length).toBe(2);
  expect(asked[1].aborted).toBe(false);
  element.remove();
  await eventually(() => asked[1].aborted).toBe(true);
  expect(said).toEqual([]);
});

test.for([
  ["that are not there", async () => null, "was not found; check the address"],
  ["that are none", async () => "<!doctype html>", "is damaged or no image"],
  [
    "of several sizes",
    (number: number) => photograph(number, 200, 100 + 20 * number),
    "The photographs of a turn must all be of one size.",
  ],
] as const)(
  "of photographs %s one sentence tells, and leaves turn as sheets",
  async ([, respond, sentence]) => {
    serve(respond);
    const said: string[] = [];
    const element = book(scans(10), {
      model: "photographs",
      "model-src": "/photographs/{0-4}.png",
      cover: "none",
      duration: "300",
    });
    element.addEventListener("error", (event) => said.push(event.detail.message));
    await happens(element, "load");
    await eventually(() => element.ready).toBe(true);
    expect(said).toHaveLength(1);
    expect(said[0]).toContain(sentence);
    expect(await element.next()).toBe(true);
  },
);

test("no more than four of them are fetched at the same time, and none after one has failed", async () => {
  let [now, most, asked] = [0, 0, 0];
  serve(async (number) => {
    now++;
    asked++;
    most = Math.max(most, now);
    const picture = await photograph(number % 5, 20, 16);
    now--;
    return number === 45 ? null : picture;
  });
  const model = await PhotographsModel.open("/photographs/{0-39}.png", unaborted);
  expect([asked, most]).toEqual([40, 4]);
  model.close();
  asked = 0;
  const failing = PhotographsModel.open("/photographs/{40-119}.png", unaborted);
  await expect(failing).rejects.toThrow("was not found");
  expect(asked).toBeLessThan(14);
});
