/** The book's state over the real engine, its clock driven by hand. */

import { expect, test } from "vitest";
import { EngineBook } from "../engine/engine.ts";
import { bind, paperLeaves } from "./spreads.ts";
import { type Flight, Turning, type TurningEvents } from "./turning.ts";

async function open(pages: number, cover: "hard" | "none", heard: Partial<TurningEvents> = {}) {
  const binding = bind(pages, cover);
  const leaves = paperLeaves(binding);
  const engine = await EngineBook.create({ width: 0.14, height: 0.21, leaves, thickness: 0.01 });
  const flights: [number, number][] = [];
  const turning = new Turning(engine, binding, {
    started: (flight: Flight) => {
      flights.push([flight.low, flight.high]);
      heard.started?.(flight);
    },
    landed: (from, to) => heard.landed?.(from, to),
  });
  turning.lay(0);
  const run = (ticks = 4000) => {
    for (let tick = 0; tick < ticks && turning.moving; tick += 4) turning.step(4);
  };
  return { engine, turning, flights, run };
}

/** What a promise holds by now; "pending" where it has not resolved. */
const now = <T>(promise: Promise<T>): Promise<T | "pending"> =>
  Promise.race([promise, Promise.resolve().then(() => "pending" as const)]);

test("a jump stops at both boards, and every turn keeps what it promised", async () => {
  const { turning, flights, run } = await open(20, "hard");
  const landed = turning.goTo(10);
  run();
  expect(flights).toEqual([
    [0, 1],
    [1, 9],
    [9, 10],
  ]);
  expect(await landed).toBe(true);
  expect(await turning.turn(1)).toBe(true);
  expect(turning.spread).toBe(10);
});

test("a step back takes the leaf in flight back, though it stands for many", async () => {
  const { turning, flights, run } = await open(40, "none");
  turning.lay(2);
  const away = turning.goTo(15);
  run(60);
  const back = turning.turn(-1);
  expect(turning.destination).toBe(2);
  run();
  expect(turning.spread).toBe(2);
  expect(flights).toEqual([[2, 15]]);
  expect(await away).toBe(false);
  expect(await back).toBe(true);
});

test("a held key turns at most three leaves more than the one in flight", async () => {
  const { turning, run } = await open(60, "none");
  for (let repeat = 0; repeat < 30; repeat++) turning.turn(1);
  turning.step(1);
  for (let repeat = 0; repeat < 30; repeat++) turning.turn(1);
  expect(turning.destination).toBe(4);
  run();
  expect(turning.spread).toBe(4);
});

test("a book taken away in the middle of a turn keeps nobody waiting", async () => {
  const { turning, run } = await open(20, "hard");
  const promised = [turning.goTo(6), turning.turn(1)];
  run(30);
  turning.close();
  expect(await now(Promise.all(promised))).toEqual([false, false]);
  expect(turning.moving).toBe(false);
});

test("a turn called off before it began keeps nobody waiting", async () => {
  const { turning } = await open(20, "none");
  const away = turning.turn(1);
  const back = turning.goTo(0);
  expect(turning.moving).toBe(false);
  expect([await now(away), await now(back)]).toEqual([false, true]);
});

test("nothing is asked of the engine once a listener took the book away", async () => {
  for (const event of ["started", "landed"] as const) {
    let close = () => {};
    const { engine, turning, run } = await open(20, "none", { [event]: () => close() });
    let touched = false;
    close = () => {
      turning.close();
      for (const name of ["lay", "lift", "play", "step", "grab", "hold"] as const) {
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

test("a hand has no hold on what a key took from it, nor on what flies next", async () => {
  const { turning, flights, run } = await open(12, "hard");
  turning.lay(4);
  expect(turning.lift(0)).toBe(true);
  turning.grab(1, 0.5);
  turning.hold(0.1, 0.1, 0.08);
  turning.step(40);
  // The leaf goes on to the left, and the back board after it.
  expect(turning.flight?.high).toBe(5);
  const one = turning.turn(1);
  expect(turning.destination).toBe(5);
  const two = turning.turn(1);
  expect(turning.destination).toBe(6);
  for (let tick = 0; tick < 4000 && turning.moving; tick += 4) {
    turning.step(4);
    turning.hold(0.14, 0.1, 0);
  }
  turning.release();
  expect(flights).toEqual([
    [4, 5],
    [5, 6],
  ]);
  expect(turning.spread).toBe(6);
  expect([await one, await two]).toEqual([false, true]);
  run();
});

test("a key during a hand's hold sends the leaf to the key's side", async () => {
  for (const [by, spread] of [
    [1, 4],
    [-1, 3],
  ] as const) {
    const { turning, run } = await open(12, "none");
    turning.lay(3);
    turning.lift(0);
    turning.grab(1, 0.5);
    turning.hold(0.05, 0.1, 0.1);
    turning.step(60);
    const landed = turning.turn(by);
    run();
    expect(turning.spread).toBe(spread);
    expect(await landed).toBe(true);
  }
});

test("a leaf or a board let go says where it falls", async () => {
  for (const [x, falls, by, end] of [
    [0.12, 0, -1, 2],
    [-0.12, 1, 1, 5],
  ] as const) {
    const { turning, run } = await open(12, "hard");
    turning.lay(3);
    turning.lift(0);
    turning.grab(1, 0.5);
    turning.hold(x, 0.1, 0.03);
    turning.step(120);
    turning.release();
    // The next turn goes on from the side that it falls to.
    expect(turning.destination).toBe(3 + falls);
    turning.turn(by);
    run();
    expect(turning.spread).toBe(end);

    turning.lay(0);
    turning.lift(0);
    turning.grab(1, 0.5);
    turning.hold(x, 0.1, 0.03);
    turning.step(120);
    turning.release();
    expect(turning.destination).toBe(falls);
    run();
    expect(turning.spread).toBe(falls);
  }
});
