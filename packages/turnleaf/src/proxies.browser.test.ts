/**
 * Objects of the package behind a Proxy, as `ref`, `data()`, Pinia, MobX and Alpine hold them: a method
 * that is called through a Proxy has that as its `this`, and a `#private` field would not be found in it.
 */

import { afterEach, expect, test } from "vitest";
import { reactive } from "vue";
import manifest from "../package.json";
import { clock } from "./for_tests/clock.ts";
import { scan, scans } from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { openSource, type PageSource } from "./index.ts";
import { TurnCache, TurnRecorder } from "./key_frames/key_frames.ts";
import { LeafStage } from "./leaf_stage/leaf_stage.ts";
import { LooseLeaf } from "./models/models.ts";
import { PageFlip } from "./page_flip/index.ts";
import { prose, tinyEpub } from "./sources/epub/tiny_epub.ts";

afterEach(() => document.body.replaceChildren());

/** The entries of the package that export something, and the module of each. */
const entries: Record<string, () => Promise<object>> = {
  ".": () => import("./index.ts"),
  "./models": () => import("./models/models.ts"),
  "./keyframes": () => import("./key_frames/key_frames.ts"),
  "./leaf-stage": () => import("./leaf_stage/leaf_stage.ts"),
  "./links": () => import("./links.ts"),
  "./page-flip": () => import("./page_flip/index.ts"),
  "./react-pageflip": () => import("./react_pageflip/index.ts"),
  "./standalone": () => import("./standalone.ts"),
  "./react": () => import("./frameworks/react.ts"),
  "./vue": () => import("./frameworks/vue.ts"),
  "./svelte": () => import("./frameworks/svelte/index.js"),
};

const corners = [0, 0, 0, 0.1, 0, 0, 0, 0.2, 0, 0.1, 0.2, 0];

function recorder(): TurnRecorder {
  const made = new TurnRecorder({ width: 0.1, height: 0.2, u: [0, 1], v: [0, 1] });
  made.add(0, corners);
  return made;
}

/** Returns a function that opens a book for a program. */
const source = (input: Parameters<typeof openSource>[0]) => () => openSource(input);

async function useSource(pages: PageSource): Promise<void> {
  const { signal } = new AbortController();
  expect(pages.pageCount).toBeGreaterThan(0);
  expect(pages.title).toBeTypeOf("string");
  expect((await pages.size(0)).width).toBeGreaterThan(0);
  expect(pages.label(0)).toBeTypeOf("string");
  expect((await pages.draw(0, 60, signal)).width).toBeGreaterThan(0);
  await pages.text?.(0, signal);
  await pages.outline?.(signal);
  await pages.narration?.clipFrom(0, signal);
  pages.close();
}

/** How an object of each public class is made, and what is done with it behind a Proxy. */
const uses: Record<string, [make: () => unknown, use: (made: never) => unknown]> = {
  LooseLeaf: [
    () => LooseLeaf.create({ model: "rigid" }),
    (leaf: LooseLeaf) => {
      leaf.lay("left");
      leaf.play("corner", "left", 0.2);
      leaf.advance(0.1);
      expect(leaf.playing).toBe(true);
      leaf.update();
      expect(leaf.surface().columns).toBeGreaterThan(1);
      const another = leaf.another({ model: "sheet" });
      expect(another.measure().kinetic).toBe(0);
      another.destroy();
      leaf.destroy();
    },
  ],
  TurnRecorder: [
    recorder,
    (made: TurnRecorder) => {
      made.add(1, corners);
      expect(made.finish().frames).toBe(2);
    },
  ],
  TurnCache: [
    () => new TurnCache({ name: "turnleaf-turns-of-a-proxy" }),
    async (cache: TurnCache) => {
      const turn = await cache.record("one", async () => recorder().finish().bytes);
      expect(turn.columns).toBe(2);
      await cache.clear();
    },
  ],
  RecordedTurn: [
    () => new TurnCache().record("two", async () => recorder().finish().bytes),
    (turn: Awaited<ReturnType<TurnCache["record"]>>) => {
      const out = new Float32Array(12);
      turn.mirrored().reversed().faster(2).scaled(0.2, 0.4).sample(0, out);
      expect(out[3]).toBeCloseTo(-0.2);
      expect(turn.times.length).toBe(turn.frames);
    },
  ],
  LeafStage: [
    () => new LeafStage(document.createElement("canvas"), { width: 0.1, height: 0.2 }),
    (stage: LeafStage) => {
      stage.resize(100, 100, 1);
      stage.print({ recto: null, verso: null, left: null, right: null });
      const normals = Float32Array.from([0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]);
      stage.show({ columns: 2, rows: 2, positions: Float32Array.from(corners), normals });
      stage.draw();
      expect(stage.handAt(50, 50, 0.1)).toBeDefined();
      stage.pick(60, 50);
      stage.destroy();
    },
  ],
  PageFlip: [
    () => {
      const host = document.createElement("div");
      host.style.width = "400px";
      document.body.append(host);
      return new PageFlip(host, { width: 100, height: 150, flippingTime: 200 });
    },
    async (flip: PageFlip) => {
      const flips: unknown[] = [];
      const opens = new Promise((resolve) => flip.on("init", resolve));
      flip.on("flip", ({ data, object }) => flips.push([data, object.getCurrentPageIndex()]));
      flip.loadFromImages([1, 2, 3, 4].map((number) => scan(number)));
      await opens;
      flips.length = 0;
      flip.flipNext();
      await eventually(() => flips).toEqual([[2, 2]]);
      flip.turnToPrevPage();
      flip.update();
      expect(flip.getCurrentPageIndex()).toBe(0);
      expect(flip.getOrientation()).toBe("landscape");
      expect(flip.getBoundsRect().pageWidth).toBe(100);
      expect(flip.getSettings().width).toBe(100);
      flip.off("flip");
      await clock.pass(300);
      flip.destroy();
    },
  ],
  "images of openSource": [source(scans(2)), useSource],
  "an EPUB of openSource": [source(tinyEpub({ chapters: [prose(2)] })), useSource],
};

/** Errors, which nobody holds; and elements, which frameworks leave as they are. */
const exempt = (made: { prototype: unknown }): boolean =>
  made.prototype instanceof Error || made.prototype instanceof HTMLElement;

const isClass = (value: unknown): value is { name: string; prototype: object } =>
  typeof value === "function" && /^class\b/.test(String(value));

/** Adds the classes of an object and of all that a Proxy of Vue's would reach from it. */
function classesWithin(made: unknown, found: Set<object>, seen: Set<unknown> = new Set()): void {
  if (typeof made !== "object" || made === null || seen.has(made)) return;
  seen.add(made);
  if (reactive(made) === made) return;
  for (let kind = Object.getPrototypeOf(made); kind; kind = Object.getPrototypeOf(kind)) {
    if (isClass(kind.constructor)) found.add(kind.constructor);
  }
  for (const value of Object.values(made)) classesWithin(value, found, seen);
}

test("each entry that exports classes is looked at", () => {
  const modules = Object.keys(manifest.exports).filter((name) => !/\.(js|json|wasm)$/.test(name));
  expect(Object.keys(entries).sort()).toEqual(modules.sort());
});

test("every public class is used behind a Proxy below", async () => {
  const modules = await Promise.all(Object.values(entries).map((load) => load()));
  const classes = modules.flatMap((module) => Object.values(module).filter(isClass));
  const names = new Set(classes.filter((one) => !exempt(one)).map(({ name }) => name));
  expect(Object.keys(uses)).toEqual(expect.arrayContaining([...names]));
});

test("an element, and what is reached from it, stays as it is in Vue's", async () => {
  const element = document.createElement("turnleaf-book");
  expect(reactive({ element }).element).toBe(element);
});

for (const [name, [make, use]] of Object.entries(uses)) {
  test(`${name} behind a Proxy`, async () => {
    await use(new Proxy((await make()) as object, {}) as never);
  });

  test(`${name} behind Vue's Proxy, which wraps what it returns too`, async () => {
    await use(reactive((await make()) as object) as never);
  });

  test(`${name} has no #private, nor has what a Proxy reaches from it`, async () => {
    const found = new Set<object>();
    const made = await make();
    // Of a source every method is called on the source itself.
    if (!/openSource/.test(name)) classesWithin(made, found);
    expect([...found].filter((one) => /\.#\w|^\s*#\w/m.test(String(one)))).toEqual([]);
  });
}
