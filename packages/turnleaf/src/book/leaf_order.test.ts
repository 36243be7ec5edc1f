import { expect, test } from "vitest";
import { Side } from "../engine/phases.ts";
import {
  inWay,
  landingOrder,
  nextTo,
  outermost,
  sideBefore,
  uppermost,
  withPickedUp,
} from "./leaf_order.ts";

const { left, right } = Side;
const fourth = { low: 4, high: 5 };
const fifth = { low: 5, high: 6 };
const sixth = { low: 6, high: 9 };

test("leaves picked up from either side fly next to its pile", () => {
  let flights = withPickedUp(right, [], fifth);
  flights = withPickedUp(right, flights, sixth);
  flights = withPickedUp(left, flights, fourth);
  expect(flights).toEqual([fourth, fifth, sixth]);
  expect([nextTo(left, flights), nextTo(right, flights)]).toEqual([fourth, sixth]);
  expect(outermost(flights, 5)).toEqual({ low: 4, high: 9 });
  expect(outermost([], 5)).toEqual({ low: 5, high: 5 });
});

test("the next leaf of a side lies beyond everything in flight", () => {
  expect(uppermost(left, [fourth, fifth, sixth], 5)).toEqual({ low: 3, high: 4 });
  expect(uppermost(right, [fourth, fifth, sixth], 5)).toEqual({ low: 9, high: 10 });
  expect(uppermost(left, [], 5)).toEqual({ low: 4, high: 5 });
  expect(uppermost(right, [], 5)).toEqual({ low: 5, high: 6 });
});

test("between a leaf and a pile are those that land first", () => {
  const flights = [fourth, fifth, sixth];
  expect(inWay(left, flights, fifth)).toEqual([fourth]);
  expect(inWay(right, flights, fifth)).toEqual([sixth]);
  expect(inWay(right, flights, sixth)).toEqual([]);
  const landed = [
    { ...fourth, to: left },
    { ...fifth, to: right },
    { ...sixth, to: right },
  ];
  expect(landingOrder(landed).map(({ low }) => low)).toEqual([4, 6, 5]);
});

test("a leaf comes from the right if it was picked up at its lower spread", () => {
  expect(sideBefore({ ...sixth, from: 6 })).toBe(right);
  expect(sideBefore({ ...sixth, from: 9 })).toBe(left);
});
