/**
 * The book's state over the real engine and over the flat book, with the clock
 * driven by the test.
 */

import { expect, test } from "vitest";
import { PeeledBook } from "../canvas2d/peeled_book.ts";
import type { BookEngine, BookSize } from "../engine/book_engine.ts";
import { CreasableBook } from "../engine/creasable_book.ts";
import { Phase, Side } from "../engine/phases.ts";
import { WasmBook } from "../engine/wasm_book.ts";
import { isLong } from "../for_tests/long.ts";
import { bind, paperLeaves } from "./spreads.ts";
import { type Flight, Turning, type TurningEvents } from "./turning.ts";

let make: (size: BookSize) => Promise<BookEngine>;

/** Runs a test over the engine and over its flat replacement. */
function both(name: string, run: () => Promise<void>): void {
  for (const [over, create] of [
    ["paper", (size: BookSize) => WasmBook.create(size)],
    ["flat leaves", async (size: BookSize) => new PeeledBook(size)],
  ] as const) {
    test(`${name}, ${over}`, async () => {
      make = create;
      await run();
    });
  }
}

async function open(pages: number, cover: "hard" | "none", heard: Partial<TurningEvents> = {}) {
  const binding = bind(pages, cover);
  const leaves = paperLeaves(binding);
  const engine = await make({ width: 0.14, height: 0.21, leaves, thickness: 0.01 });
  const flights: [number, number][] = [];
  const turning = new Turning(engine, binding, {
    started: (flight: Flight) => {
      flights.push([flight.low, flight.high]);
      heard.started?.(flight);
    },
    landed: (flight) => heard.landed?.(flight),
    rested: (from, to) => heard.rested?.(from, to),
  });
  turning.lay(0);
  const run = (ticks = 4000) => {
    for (let tick = 0; tick < ticks && turning.moving; tick += 4) turning.step(4);
  };
  // In frames of a tenth of a second: no frame has more work of many leaves than it may.
  const pass = (seconds: number) => {
    for (let left = Math.round(seconds / engine.tick); left > 0; left -= 12) {
      turning.step(Math.min(left, 12));
    }
  };
  return { engine, turning, flights, run, pass };
}

/** Returns what a promise has resolved to by now, or "pending". */
const now = <T>(promise: Promise<T>): Promise<T | "pending"> =>
  Promise.race([promise, Promise.resolve().then(() => "pending" as const)]);

/** Returns what each of some promises has resolved to by now, or "pending". */
const allNow = <T>(promises: readonly Promise<T>[]) => Promise.all(promises.map(now));

/** Seconds between leaves that follow each other at the default pace. */
const apart = 0.072;

both("a way stops at both boards, and every turn keeps what it promised", async () => {
  const { turning, flights, run } = await open(12, "hard");
  const landed = turning.goTo(6);
  run();
  expect(flights).toEqual([
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 4],
    [4, 5],
    [5, 6],
  ]);
  expect(await now(landed)).toBe(true);
  expect(await now(turning.turn(1))).toBe(false);
  expect(turning.spread).toBe(6);
});

both("no leaf flies beside a board", async () => {
  const { turning, run } = await open(20, "hard");
  turning.goTo(10);
  for (let tick = 0; tick < 8000 && turning.moving; tick++) {
    turning.step(1);
    const boards = turning.flights.filter(({ part }) => part !== "leaf");
    if (boards.length > 0) expect(turning.flights.length).toBe(1);
    // The same by dragging.
    if (boards.length > 0) expect(turning.pickUp(0)).toBeNull();
  }
  run();
  expect(turning.spread).toBe(10);
});

both(
  "a held key has ten leaves and more in flight, one after the other, and stops soon",
  async () => {
    const { engine, turning, flights, run } = await open(200, "none");
    const ticks = (seconds: number) => Math.round(seconds / engine.tick);
    let most = 0;
    for (let frame = 0; frame < 100; frame++) {
      if (frame % 2 === 0) turning.press(1);
      turning.step(ticks(1 / 60));
      most = Math.max(most, turning.flights.length);
    }
    expect(most).toBeGreaterThanOrEqual(10);
    expect(most).toBeLessThanOrEqual(12);
    // Steadily, one leaf every 72 ms.
    expect(flights.length).toBeCloseTo(100 / 60 / apart, -0.5);
    const begun = flights.length;
    expect(turning.destination - begun).toBeLessThanOrEqual(3);
    run();
    expect(turning.spread).toBe(flights.length);
    expect(flights).toEqual(flights.map((_, k) => [k, k + 1]));
  },
);

both("of a reader's turns three wait, and more are rejected at once", async () => {
  const { turning, run } = await open(60, "none");
  const press = (): Promise<boolean> => turning.press(1);
  const first = Array.from({ length: 30 }, press);
  expect(turning.destination).toBe(3);
  expect(await allNow(first.slice(3))).toEqual(Array(27).fill(false));
  turning.step(1);
  const second = Array.from({ length: 30 }, press);
  expect(turning.destination).toBe(4);
  run();
  expect(turning.spread).toBe(4);
  const kept = await allNow([...first, ...second]);
  expect(kept.filter((done) => done).length).toBe(4);
});

both("every turn that a command asks for counts, and says so", async () => {
  for (const [cover, count] of [
    ["none", 5],
    ["none", 60],
    ["hard", 60],
  ] as const) {
    const { engine, turning, flights, run } = await open(400, cover);
    turning.lay(1);
    const promised = Array.from({ length: count }, () => turning.turn(1));
    expect(turning.destination).toBe(1 + count);
    run(20_000);
    expect([turning.spread, engine.read]).toEqual([1 + count, count + (cover === "none" ? 1 : 0)]);
    expect(await allNow(promised)).toEqual(Array(count).fill(true));
    // Many leaves at once are a jump.
    expect(flights.length).toBe(count > 12 ? 9 : count);
  }
});

both("turns asked for one after another while others fly all count", async () => {
  const { engine, turning, run } = await open(400, "none");
  turning.lay(1);
  const promised: Promise<boolean>[] = [];
  for (let k = 0; k < 60; k++) {
    promised.push(turning.turn(1));
    turning.step(Math.round(1 / 60 / engine.tick));
  }
  for (let k = 0; k < 20; k++) promised.push(turning.turn(-1));
  run(20_000);
  expect(turning.spread).toBe(41);
  // Turns that were taken back resolve to false.
  const kept = [...Array(40).fill(true), ...Array(20).fill(false), ...Array(20).fill(true)];
  expect(await allNow(promised)).toEqual(kept);
});

both("a turn beyond the book's end is rejected at once, however many there are", async () => {
  const { turning, run } = await open(12, "hard");
  const promised = Array.from({ length: 9 }, () => turning.turn(1));
  expect(await allNow(promised.slice(6))).toEqual([false, false, false]);
  run(20_000);
  expect(turning.spread).toBe(6);
  expect(await allNow(promised.slice(0, 6))).toEqual(Array(6).fill(true));
  expect(await now(turning.turn(1))).toBe(false);
  expect(await now(turning.press(1))).toBe(false);
});

both("a turn by command goes on from where a jump leads", async () => {
  const { turning, run, pass } = await open(400, "hard");
  turning.lay(2);
  const promised = [turning.goTo(100)];
  pass(0.4);
  promised.push(turning.turn(-1), turning.turn(-1), turning.turn(1));
  run(20_000);
  expect(turning.spread).toBe(99);
  expect(await allNow(promised)).toEqual([false, true, false, true]);
});

both("a reader's turn against a jump calls it off", async () => {
  const { turning, run, pass } = await open(400, "none");
  turning.lay(2);
  const far = turning.goTo(100);
  pass(0.4);
  expect(turning.flights.length).toBeGreaterThan(2);
  const back = turning.press(-1);
  run();
  expect(turning.spread).toBeLessThan(90);
  expect([await now(far), await now(back)]).toEqual([false, true]);
});

both("the book says that it rests once, at the end of its way", async () => {
  for (const [cover, moments] of [
    ["hard", [0.1, 0.5, 0.9]],
    ["none", [0.3, 0.7, 1.1]],
  ] as const) {
    const rests: string[] = [];
    const heard = { rested: (from: number, to: number) => void rests.push(`${from} to ${to}`) };
    const { engine, turning, run, pass } = await open(200, cover, heard);
    const tell = async (promised: Promise<boolean>): Promise<string | undefined> => {
      run(20_000);
      expect(await now(promised)).toBe(true);
      expect(rests.length).toBe(1);
      return rests.pop();
    };
    expect(await tell(turning.goTo(60))).toBe("0 to 60");
    expect(await tell(turning.goTo(100))).toBe("60 to 100");
    expect(await tell(turning.goTo(0))).toBe("100 to 0");
    // Reversed, and sent elsewhere, halfway: also at moments when nothing flies, which flat leaves have as well.
    const [, halfway] = moments;
    for (const seconds of isLong || engine instanceof PeeledBook ? moments : [halfway]) {
      void turning.goTo(60);
      pass(seconds);
      expect(await tell(turning.goTo(0))).toBe("0 to 0");
      void turning.goTo(60);
      pass(seconds);
      void turning.goTo(3);
      pass(seconds);
      rests.length = 0;
      expect(await tell(turning.goTo(30))).toMatch(/^(0|3|60) to 30$/);
      turning.lay(0);
    }
  }
});

both("a way that is taken back where nothing flies is over at once", async () => {
  const rests: string[] = [];
  const heard = { rested: (from: number, to: number) => void rests.push(`${from} to ${to}`) };
  const { turning } = await open(40, "hard", heard);
  void turning.goTo(20);
  // Until the board has landed and no leaf has followed it.
  while (turning.flights.length === 0) turning.step(1);
  while (turning.flights.length > 0) turning.step(1);
  expect(turning.spread).toBe(1);
  expect(rests).toEqual([]);
  expect(await now(turning.goTo(1))).toBe(true);
  expect(rests).toEqual(["0 to 1"]);
  expect(turning.moving).toBe(false);
});

both("a listener that asks for the same place at rest, or another, gets it", async () => {
  const asked: Promise<boolean>[] = [];
  const rests: number[] = [];
  const { turning, run } = await open(200, "hard", {
    rested: (_, to) => {
      rests.push(to);
      asked.push(turning.goTo(to));
      if (to === 50) asked.push(turning.goTo(20), turning.turn(-1));
    },
  });
  const jump = turning.goTo(50);
  run(20_000);
  expect(rests).toEqual([50, 19]);
  expect(await now(jump)).toBe(true);
  expect(await allNow(asked)).toEqual([true, false, true, true]);
});

both("a step back sends the leaf taken up last back first", async () => {
  const { turning, run, pass } = await open(60, "none");
  turning.lay(10);
  void turning.goTo(16);
  pass(0.5);
  expect(turning.flights.length).toBe(6);
  const sides = () => turning.flights.map(({ to }) => to).join("");
  const promised: Promise<boolean>[] = [];
  for (const expected of ["111110", "111100", "111000"]) {
    promised.push(turning.press(-1));
    expect(sides()).toBe(expected);
  }
  expect(turning.destination).toBe(13);
  promised.push(turning.press(1));
  expect(sides()).toBe("111100");
  run();
  expect(turning.spread).toBe(14);
  expect(await allNow(promised)).toEqual([true, true, false, true]);
});

both("a held key the other way first takes back what flies, then turns on", async () => {
  const { engine, turning, run } = await open(100, "none");
  turning.lay(20);
  const frame = Math.round(1 / 60 / engine.tick);
  for (const by of [1, -1] as const) {
    for (let k = 0; k < 60; k++) {
      if (k % 2 === 0) turning.press(by);
      turning.step(frame);
      const sides = turning.flights.map(({ to }) => to).join("");
      expect(sides).toMatch(/^1*0*$/);
    }
  }
  const { destination } = turning;
  run();
  expect(turning.spread).toBe(destination);
  expect(destination).toBeLessThan(20);
});

both("a far jump takes few leaves and little time, and lands at its page", async () => {
  const { engine, turning, flights } = await open(1000, "none");
  for (const spread of [437, 12, 13, 400]) {
    flights.length = 0;
    const from = turning.spread;
    const landed = turning.goTo(spread);
    let ticks = 0;
    for (; turning.moving; ticks++) turning.step(1);
    expect(ticks * engine.tick).toBeLessThan(1.6);
    expect(await now(landed)).toBe(true);
    expect([turning.spread, engine.read]).toEqual([spread, spread]);
    expect(flights.length).toBe(Math.abs(spread - from) > 12 ? 9 : Math.abs(spread - from));
  }
});

both("a slider dragged to and fro ends where it was let go", async () => {
  const { engine, turning, run, pass } = await open(600, "hard");
  const promised: Promise<boolean>[] = [];
  for (const spread of [5, 40, 90, 91, 70, 20, 22, 30, 180, 179, 177]) {
    promised.push(turning.goTo(spread));
    pass(0.15);
    expect(turning.flights.length).toBeLessThanOrEqual(12);
  }
  expect(turning.destination).toBe(177);
  run(20_000);
  expect([turning.spread, engine.read]).toEqual([177, 176]);
  expect((await allNow(promised)).at(-1)).toBe(true);
});

both("a jump back while leaves fly takes those back that need not have flown", async () => {
  const { turning, flights, run, pass } = await open(60, "none");
  void turning.goTo(10);
  pass(0.34);
  expect(turning.flights.length).toBe(5);
  void turning.goTo(2);
  expect(turning.flights.map(({ to }) => to).join("")).toBe("11000");
  run();
  expect(turning.spread).toBe(2);
  expect(flights.length).toBe(5);
});

both("every leaf tells of its landing, and the book of its rest", async () => {
  const reports: string[] = [];
  const { turning, run, pass } = await open(60, "none", {
    landed: ({ low, to }) => reports.push(`${low} ${to === 1 ? "left" : "right"}`),
    rested: (from, to) => reports.push(`${from} to ${to}`),
  });
  turning.lay(4);
  void turning.goTo(8);
  pass(0.3);
  void turning.turn(-1);
  run();
  expect(reports.sort()).toEqual(["4 left", "4 to 7", "5 left", "6 left", "7 right"]);
  expect(turning.spread).toBe(7);
});

both("a book taken away in the middle of a turn keeps nobody waiting", async () => {
  const { turning, run } = await open(20, "hard");
  const promised = [turning.goTo(6), turning.turn(1)];
  run(30);
  turning.close();
  expect(await now(Promise.all(promised))).toEqual([false, false]);
  expect(turning.moving).toBe(false);
});

both("a turn called off before it began keeps nobody waiting", async () => {
  const { turning } = await open(20, "none");
  const away = turning.turn(1);
  const back = turning.goTo(0);
  expect(turning.moving).toBe(false);
  expect([await now(away), await now(back)]).toEqual([false, true]);
});

both("nothing is asked of the engine once a listener took the book away", async () => {
  for (const event of ["started", "landed", "rested"] as const) {
    let close = () => {};
    const { engine, turning, run } = await open(20, "none", { [event]: () => close() });
    let touched = false;
    close = () => {
      turning.close();
      const calls = ["lay", "pickUp", "play", "beginFrame", "stepFrame", "grab", "hold"] as const;
      for (const name of calls) {
        engine[name] = () => {
          touched = true;
          return 0 as never;
        };
      }
    };
    turning.turn(1);
    turning.turn(1);
    run();
    expect(touched, event).toBe(false);
  }
});

both("a grab does not hold a leaf that a key took from it, nor the next one", async () => {
  const { turning, flights, run } = await open(12, "hard");
  turning.lay(4);
  const flight = turning.pickUp(0) as Flight;
  turning.grab(flight, 0, 1, 0.5);
  turning.hold(0, 0.1, 0.1, 0.08);
  turning.step(40);
  // The leaf goes on to the left, and the back board after it.
  expect(turning.flights[0].high).toBe(5);
  const one = turning.turn(1);
  expect(turning.destination).toBe(5);
  const two = turning.turn(1);
  expect(turning.destination).toBe(6);
  for (let tick = 0; tick < 4000 && turning.moving; tick += 4) {
    turning.step(4);
    turning.hold(0, 0.14, 0.1, 0);
  }
  turning.release(0);
  expect(flights).toEqual([
    [4, 5],
    [5, 6],
  ]);
  expect(turning.spread).toBe(6);
  expect([await now(one), await now(two)]).toEqual([true, true]);
  run();
});

both("a key during a grab sends the leaf to the key's side", async () => {
  for (const [by, spread] of [
    [1, 4],
    [-1, 3],
  ] as const) {
    const { turning, run } = await open(12, "none");
    turning.lay(3);
    turning.grab(turning.pickUp(0) as Flight, 0, 1, 0.5);
    turning.hold(0, 0.05, 0.1, 0.1);
    turning.step(60);
    const landed = turning.turn(by);
    run();
    expect(turning.spread).toBe(spread);
    expect(await now(landed)).toBe(true);
  }
});

both("a leaf or a board let go says where it falls", async () => {
  for (const [x, falls, by, end] of [
    [0.12, 0, -1, 2],
    [-0.12, 1, 1, 5],
  ] as const) {
    const { turning, run } = await open(12, "hard");
    turning.lay(3);
    turning.grab(turning.pickUp(0) as Flight, 0, 1, 0.5);
    turning.hold(0, x, 0.1, 0.03);
    turning.step(120);
    turning.release(0);
    // The next turn goes on from the side that it falls to.
    expect(turning.destination).toBe(3 + falls);
    turning.turn(by);
    run();
    expect(turning.spread).toBe(end);

    turning.lay(0);
    turning.grab(turning.pickUp(0) as Flight, 0, 1, 0.5);
    turning.hold(0, x, 0.1, 0.03);
    turning.step(120);
    turning.release(0);
    expect(turning.destination).toBe(falls);
    run();
    expect(turning.spread).toBe(falls);
  }
});

both("the leaf of the second grab is held, and that of the first falls to its side", async () => {
  for (const [first, second] of [
    [0, 1],
    [1, 0],
  ] as const) {
    const { engine, turning, run } = await open(60, "none");
    turning.lay(10);
    const sign = first === 0 ? 1 : -1;
    const one = turning.pickUp(first) as Flight;
    turning.grab(one, 0, 1, 0.5);
    turning.hold(0, sign * 0.08, 0.1, 0.06);
    turning.step(60);
    const two = turning.pickUp(second) as Flight;
    turning.grab(two, 1, 1, 0.5);
    turning.hold(1, -sign * 0.08, 0.1, 0.06);
    expect(one.to).toBe(first);
    expect(engine.phase(one.id)).toBe(first === 0 ? Phase.fallingRight : Phase.fallingLeft);
    for (let k = 0; k < 120; k++) {
      // The first pointer no longer affects either leaf.
      turning.hold(0, -sign * 0.1, 0.1, 0.1);
      turning.step(4);
    }
    expect(turning.flights).toEqual([two]);
    turning.release(0);
    expect(engine.phase(two.id)).toBe(Phase.held);
    turning.release(1);
    run();
    expect(turning.spread).toBe(10);
  }
});

both("a key after a second grab turns the leaf of that grab", async () => {
  const { turning, run } = await open(60, "none");
  turning.lay(10);
  const one = turning.pickUp(0) as Flight;
  turning.grab(one, 0, 1, 0.5);
  turning.hold(0, 0.08, 0.1, 0.06);
  turning.step(30);
  const two = turning.pickUp(1) as Flight;
  turning.grab(two, 1, 1, 0.5);
  turning.hold(1, -0.08, 0.1, 0.06);
  turning.step(30);
  turning.release(1);
  // The finger that lost its leaf is still down; it holds no leaf.
  expect([one.to, two.to]).toEqual([0, 1]);
  turning.turn(-1);
  expect([one.to, two.to]).toEqual([0, 0]);
  run();
  expect(turning.spread).toBe(9);
});

both("a leaf held by two grabs falls at the release of the second", async () => {
  const { turning, run } = await open(60, "none");
  turning.lay(10);
  const flight = turning.pickUp(0) as Flight;
  for (const grab of [0, 1]) {
    turning.grab(flight, grab, 1, grab);
    turning.hold(grab, 0.1, 0.2 * grab, 0.05);
  }
  turning.step(100);
  turning.release(0);
  turning.step(200);
  expect(turning.flights).toEqual([flight]);
  turning.release(1);
  run();
  expect(turning.spread).toBe(10);
});

test("folds that come to lie uppermost open while nothing turns, until they rest", async () => {
  const binding = bind(20, "none");
  const size = { width: 0.14, height: 0.21, leaves: paperLeaves(binding), thickness: 0.01 };
  const engine = await CreasableBook.creasable(size);
  const nothing = { started: () => {}, landed: () => {}, rested: () => {} };
  const turning = new Turning(engine, binding, nothing);
  turning.lay(5);
  expect(turning.isSettling).toBe(false);
  expect(engine.creases.crease(5, [{ through: [0.8, 0, 1, 0.14], rest: 2.8 }])).toBe(true);
  expect([turning.moving, turning.isSettling]).toEqual([false, true]);
  const at = (): number[] => {
    engine.update();
    return Array.from(engine.surface(0).positions);
  };
  const pressed = at();
  let frames = 0;
  for (; turning.isSettling && frames < 600; frames++) expect(turning.step(2)).toBe(false);
  expect(frames).toBeGreaterThan(12);
  expect(frames).toBeLessThan(300);
  expect(engine.creases.lies(Side.right)).toBe(true);
  const opened = at();
  const apart = opened.map((x, k) => Math.abs(x - pressed[k]));
  expect(Math.max(...apart)).toBeGreaterThan(0.002);
  turning.step(2);
  expect(at()).toEqual(opened);
});
