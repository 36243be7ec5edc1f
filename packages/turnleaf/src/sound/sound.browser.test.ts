import { afterEach, beforeEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import type { Stock } from "../engine/shapes.ts";
import { book, happens, scans } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import type { TurnleafBook } from "../index.ts";
import type { Motion } from "./motion.ts";
import { PaperSound } from "./paper_sound.ts";

const rate = 22_050;

/**
 * Returns the loudness (root mean square) of a second of motion, and of the
 * remainder a second later.
 */
async function loudness(motion: Motion, stock: Stock = "book"): Promise<[number, number]> {
  const context = new OfflineAudioContext(1, 3 * rate, rate);
  const sound = new PaperSound(context);
  sound.stock = stock;
  for (let time = 0; time < 1; time += 1 / 60) sound.move(motion, time);
  sound.rest(1, () => {});
  const samples = (await context.startRendering()).getChannelData(0);
  const of = (from: number, to: number): number => {
    const part = samples.subarray(from * rate, to * rate);
    return Math.sqrt(part.reduce((sum, x) => sum + x * x, 0) / part.length);
  };
  return [of(0.2, 1), of(2, 3)];
}

test("paper is heard while it bends, the louder the faster, and not at rest", async () => {
  const [still] = await loudness({ bending: 0, impact: 0, tearing: 0 });
  const [slow, afterSlow] = await loudness({ bending: 0.3, impact: 0, tearing: 0 });
  const [fast, afterFast] = await loudness({ bending: 1.5, impact: 0, tearing: 0 });
  expect(still).toBe(0);
  expect(slow).toBeGreaterThan(0.003);
  expect(fast).toBeGreaterThan(2 * slow);
  expect([afterSlow, afterFast]).toEqual([0, 0]);
});

test("it is heard when it lands, card louder than bible paper", async () => {
  const landing = { bending: 0, impact: 0.5, tearing: 0 };
  const [bible] = await loudness(landing, "bible");
  const [card] = await loudness(landing, "card");
  expect(bible).toBeGreaterThan(0.003);
  expect(card).toBeGreaterThan(1.5 * bible);
});

test("tearing is heard by the work that is done, and no longer than it is done", async () => {
  const [slow, afterSlow] = await loudness({ bending: 0, impact: 0, tearing: 0.1 });
  const [fast, afterFast] = await loudness({ bending: 0, impact: 0, tearing: 1 });
  expect(slow).toBeGreaterThan(0.003);
  expect(fast).toBeGreaterThan(2 * slow);
  expect([afterSlow, afterFast]).toEqual([0, 0]);
});

const Native = globalThis.AudioContext;
const made: AudioContext[] = [];
/** States that the browser has brought the contexts to as they were asked, one after another. */
const states: AudioContextState[] = [];

beforeEach(() => {
  made.length = states.length = 0;
  // By the promises, not by events: an event on a busy machine is heard when the state is the next one.
  const reached = (state: AudioContextState): void => {
    if (states.at(-1) !== state) states.push(state);
  };
  globalThis.AudioContext = class extends Native {
    constructor(options?: AudioContextOptions) {
      super(options);
      made.push(this);
      // Where the reader has clicked, some run as soon as they are made.
      if (this.state === "running") reached("running");
    }
    override resume(): Promise<void> {
      return super.resume().then(() => reached("running"));
    }
    override suspend(): Promise<void> {
      return super.suspend().then(() => reached("suspended"));
    }
    override close(): Promise<void> {
      return super.close().then(() => reached("closed"));
    }
  };
});

afterEach(() => {
  globalThis.AudioContext = Native;
});

/** Opens a book with sound and turns leaves until the code for it, which the first turn loads, makes a context. */
async function soundingBook(): Promise<TurnleafBook> {
  const element = book(scans(8), { cover: "none", sound: "" });
  expect(element.sound).toBe(true);
  await happens(element, "load");
  expect(made).toEqual([]);
  await userEvent.click(document.body);
  await element.next();
  // As an element loads it: it may be late for any number of turns.
  await import("./sound.ts");
  await element.next();
  expect(made.length).toBe(1);
  return element;
}

test("nothing is made where nobody asked for sound", async () => {
  const element = book(scans(4), { cover: "none" });
  await happens(element, "load");
  await userEvent.click(document.body);
  await element.next();
  expect(made).toEqual([]);
  element.remove();
});

test("with sound, a context runs while leaves move, is suspended at rest and closed with the book", async () => {
  const element = await soundingBook();
  await eventually(() => states.at(-1)).toBe("suspended");
  // As often as leaves have moved since it was made: once, or twice if its code was there for the first turn.
  const before = [...states];
  expect([2, 4]).toContain(before.length);
  expect(before).toEqual(before.map((_, k) => (k % 2 === 0 ? "running" : "suspended")));
  await element.next();
  await eventually(() => states).toEqual([...before, "running", "suspended"]);
  element.remove();
  await eventually(() => states.at(-1)).toBe("closed");
  expect(made.length).toBe(1);
});

test("taking the attribute away silences the book", async () => {
  const element = await soundingBook();
  element.sound = false;
  await eventually(() => made[0].state).toBe("closed");
  await element.next();
  expect(made.length).toBe(1);
  element.remove();
});
