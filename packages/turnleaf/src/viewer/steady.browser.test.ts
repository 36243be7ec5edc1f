/**
 * The book stands still while a leaf turns: measured frame by frame, under the
 * test's own clock.
 */

import { afterEach, expect, test } from "vitest";
import { canvas2dBackend } from "../canvas2d_backend.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { engineCode } from "../engine/machine_code.ts";
import type { Surface } from "../engine/shapes.ts";
import { clock } from "../for_tests/clock.ts";
import { isLong } from "../for_tests/long.ts";
import { settledViewer } from "../for_tests/viewer_books.ts";
import { openSource } from "../sources/open.ts";
import type { BookPose } from "../stage/book_pose.ts";
import type { BookStage, Place } from "../stage/book_stage.ts";
import { webglBackend } from "../webgl_backend.ts";
import { Viewer, type ViewerOptions } from "./viewer.ts";

const backends = { webgl: webglBackend(engineCode()), canvas2d: canvas2dBackend };

/** A book, the place where it is shown in CSS pixels, and its options. */
interface Shown {
  readonly page: readonly [width: number, height: number];
  readonly place: readonly [width: number, height: number];
  readonly options?: Partial<ViewerOptions>;
  readonly backend?: keyof typeof backends;
}

const usual: Shown = { page: [200, 300], place: [1280, 800] };

/** Typical places for books. */
const places: readonly (Shown & { readonly name: string })[] = [
  { name: "in a page, 4:3", page: [200, 300], place: [800, 600] },
  { name: "full screen, 16:10", ...usual },
  { name: "full screen, 16:9", page: [210, 297], place: [1920, 1080] },
  { name: "square pages", page: [200, 200], place: [1280, 720] },
  { name: "right to left", ...usual, options: { binding: "right" } },
  { name: "calendar", page: [300, 200], place: [800, 1000], options: { binding: "top" } },
  {
    name: "bound at the foot",
    page: [300, 200],
    place: [800, 1000],
    options: { binding: "bottom" },
  },
  { name: "tablet upright", page: [129, 198], place: [820, 1180] },
  { name: "phone", page: [129, 198], place: [390, 844] },
  { name: "a single page", page: [200, 300], place: [800, 600], options: { layout: "single" } },
  { name: "slides", page: [320, 180], place: [1280, 720] },
];

let viewer: Viewer;
let engine: BookEngine;
let stage: BookStage;
let pose: BookPose;
/** The page's size in book space, metres. */
let width: number;
let height: number;

afterEach(() => {
  viewer.destroy();
  document.body.replaceChildren();
});

/** Opens a book in the middle and stops the clock. */
async function opened({ page, place, options, backend = "webgl" }: Shown): Promise<void> {
  const canvas = document.createElement("canvas");
  canvas.style.cssText = `width: ${place[0]}px; height: ${place[1]}px`;
  document.body.append(canvas);
  if (backend === "canvas2d") {
    // Positions are measured, not pixels: thousands of frames would wait to be painted after the test.
    const pen = new OffscreenCanvas(1, 1).getContext("2d") as unknown as CanvasRenderingContext2D;
    canvas.getContext = (() => pen) as unknown as typeof canvas.getContext;
  }
  const picture = document.createElement("canvas");
  [picture.width, picture.height] = page;
  const src = picture.toDataURL("image/png");
  const source = await openSource(
    Array.from({ length: 40 }, () => ({ src })),
    {},
  );
  const nothing = () => undefined;
  const used = backends[backend];
  viewer = await Viewer.open(
    canvas,
    source,
    {
      cover: "none",
      paper: () => ({}),
      page: () => 20,
      turnSeconds: () => 0.8,
      onStart: nothing,
      onRest: nothing,
      onFailure: nothing,
      onMotion: (shown) => {
        pose = shown;
      },
      ...options,
    },
    {
      engine: async (size) => {
        [width, height] = [size.width, size.height];
        engine = await used.engine(size);
        return engine;
      },
      stage: (on, shape) => {
        stage = used.stage(on, shape);
        return stage;
      },
    },
    new AbortController().signal,
  );
  viewer.resize(...place, 1);
  await settledViewer(viewer);
  clock.hold();
}

/** Returns the apparent size of the book, CSS pixels: along the spine and across a page. */
function apparentSize(): [number, number] {
  const [spine, head, edge] = [
    [0, 0, 0],
    [0, height, 0],
    [width, 0, 0],
  ].map(([x, y, z]) => stage.project([x, y, z]));
  return [apart(spine, head), apart(spine, edge)];
}

const apart = (a: Place, b: Place): number => Math.hypot(a.x - b.x, a.y - b.y);

/** Returns where a place of a leaf, in fractions from spine and foot, is seen. */
function seenOn({ positions, columns, rows }: Surface, u: number, v: number): Place {
  // A view of the engine's memory, valid for the moment.
  const places = engine.columns;
  let column = 0;
  while (column < columns - 2 && places[column + 1] < u) column++;
  const from = places[column];
  const across = (u - from) / (places[column + 1] - from);
  const row = Math.min(Math.floor(v * (rows - 1)), rows - 2);
  const along = v * (rows - 1) - row;
  const mixed = [0, 1, 2].map((axis) => {
    const at = (r: number, c: number) => positions[3 * (r * columns + c) + axis];
    const [low, high] = [row, row + 1].map(
      (r) => (1 - across) * at(r, column) + across * at(r, column + 1),
    );
    return (1 - along) * low + along * high;
  });
  return stage.project([mixed[0], mixed[1], mixed[2]]);
}

/** Compares what is visible while leaves move with the book at rest. */
class Watch {
  /** Smallest and largest apparent size, as a fraction of that at rest. */
  size: [number, number] = [1, 1];
  /** How far a leaf reaches beyond the place where the book is shown, CSS pixels, by side. */
  beyond = { left: 0, top: 0, right: 0, bottom: 0 };
  /** How far it would, were it seen from infinitely far above: what of it the paper does, not the eye. */
  paper = { left: 0, top: 0, right: 0, bottom: 0 };
  readonly #rest = apparentSize();
  readonly #place: readonly [number, number];
  #looks = 0;

  constructor(place: readonly [number, number]) {
    this.#place = place;
  }

  readonly look = (): void => {
    for (const [k, length] of apparentSize().entries()) {
      const size = length / this.#rest[k];
      this.size = [Math.min(this.size[0], size), Math.max(this.size[1], size)];
    }
    // A leaf's points move little in a twentieth of a second, and there are 1,225 of them.
    if (this.#looks++ % 3 > 0) return;
    for (const { positions } of pose.leaves) {
      for (let k = 0; k < positions.length; k += 3) {
        const [x, y, z] = [positions[k], positions[k + 1], positions[k + 2]];
        this.#reach(this.beyond, stage.project([x, y, z]));
        this.#reach(this.paper, stage.project([x, y, 0]));
      }
    }
  };

  #reach(beyond: Watch["beyond"], { x, y }: Place): void {
    beyond.left = Math.max(beyond.left, -x);
    beyond.top = Math.max(beyond.top, -y);
    beyond.right = Math.max(beyond.right, x - this.#place[0]);
    beyond.bottom = Math.max(beyond.bottom, y - this.#place[1]);
  }
}

/**
 * Grabs the leaf that is turned next at a place (fractions from spine and foot)
 * and carries it over in a second, resting ten times on the way. Returns the
 * maximum distance of the held point from the pointer, CSS pixels.
 */
function carry(u: number, v: number, look: () => void): number {
  const side = viewer.binding.reversed ? -1 : 1;
  const from = stage.project([side * u * width, v * height, 0]);
  const to = stage.project([-0.9 * side * u * width, v * height, 0]);
  const hold = viewer.drags.pick(from.x, from.y);
  if (hold === null) throw new Error(`No leaf at ${u}, ${v}.`);
  const drag = viewer.drags.grab(hold, { x: to.x - from.x, y: to.y - from.y });
  let worst = 0;
  for (let k = 0; k <= 60; k++) {
    const at = {
      x: from.x + ((to.x - from.x) * k) / 60,
      y: from.y + ((to.y - from.y) * k) / 60,
    };
    drag?.move(at.x, at.y);
    clock.frames(1, look);
    if (k % 6 !== 0) continue;
    clock.frames(20, look);
    worst = Math.max(worst, apart(seenOn(pose.leaves[0], hold.u, hold.v), at));
  }
  drag?.release();
  clock.frames(150, look);
  return worst;
}

/** Turns by command. */
function turn(look: () => void): void {
  void viewer.turning.turn(viewer.binding.reversed ? -1 : 1);
  viewer.invalidate();
  clock.frames(90, look);
}

/**
 * Places where a leaf is grabbed, as fractions from spine and foot: corners,
 * the edge, and far from it.
 */
const grips = [
  [0.97, 0.05],
  [0.97, 0.5],
  [0.97, 0.95],
  [0.7, 0.5],
  [0.7, 0.95],
] as const;

/**
 * Turns a leaf by command and carries others over by dragging: of all grips, or of one, another in each
 * place. Returns what was measured.
 */
function turnAndCarry({ place }: Shown, number: number): string {
  const [tall, page] = apparentSize();
  const watch = new Watch(place);
  turn(watch.look);
  const played = { ...watch.beyond };
  const taken = grips.filter((_, k) => isLong || k === number % grips.length);
  const worst = taken.map(([u, v]) => carry(u, v, watch.look));
  const { beyond, paper, size } = watch;
  const said = (lengths: readonly number[]) => lengths.map((px) => px.toFixed(1)).join(", ");
  const [least, most] = size.map((fraction) => fraction.toFixed(3));
  const report =
    `Size ${least} to ${most} of that at rest. What was taken and the pointer were apart at most ` +
    `${said(worst)} px, on a page of ${said([page])}. Beyond left, top, right and foot of the ` +
    `place: ${said(Object.values(beyond))} px, of that by the paper ${said(Object.values(paper))} px; ` +
    `played: ${said(Object.values(played))} px.`;
  expect(size[0], report).toBeGreaterThan(0.98);
  expect(size[1], report).toBeLessThan(1.02);
  for (const px of worst) expect(px, report).toBeLessThan(0.035 * page);
  // A page alone carries its leaves over an edge beyond which nothing is shown.
  const sides =
    viewer.binding.layout === "spread"
      ? (["left", "top", "right", "bottom"] as const)
      : (["top", "bottom"] as const);
  // Carried by a corner, a leaf that is wider than high hangs aslant beyond head and foot, as paper does
  // and whatever the eye.
  const hanging = page > tall ? 0.12 * tall : 0;
  for (const side of sides) {
    expect(played[side], report).toBe(0);
    expect(paper[side], report).toBeLessThanOrEqual(hanging);
    // The eye adds nothing to what stays in the picture, and little to what does not.
    const most = paper[side] > 0 ? paper[side] + 0.01 * place[1] : 0;
    expect(beyond[side], report).toBeLessThanOrEqual(most);
  }
  return report;
}

test.for(places)(
  "a turn neither moves the book nor leaves the picture: $name",
  async (shown, { annotate }) => {
    await opened(shown);
    await annotate(turnAndCarry(shown, places.indexOf(shown)));
  },
);

test.for(places.filter(({ name }) => /16:10|right|calendar|phone/.test(name)))(
  "nor does one of the book on the flat: $name",
  async (shown, { annotate }) => {
    await opened({ ...shown, backend: "canvas2d" });
    await annotate(turnAndCarry(shown, places.indexOf(shown) + 2));
  },
);

test.each([2, 4])("zoomed %s times, the book stands still", async (level) => {
  await opened(usual);
  const middle = { x: 640, y: 400 };
  viewer.zoom(level, middle, middle, 0);
  clock.frames(2);
  const watch = new Watch(usual.place);
  turn(watch.look);
  for (const size of watch.size) expect(size).toBeCloseTo(1, 9);
});
