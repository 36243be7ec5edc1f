import { expect, test } from "vitest";
import { inOrder } from "./comic.ts";

test("pages are in the natural order of their paths, without the endings of names", () => {
  const names = ["Ch 10/1.jpg", "Ch 2/10.PNG", "Ch 2/9.png", "cover.webp"];
  expect(inOrder(names)).toEqual(["Ch 2/9.png", "Ch 2/10.PNG", "Ch 10/1.jpg", "cover.webp"]);
  expect(inOrder(["p02.jpg", "P1.jpg", "p001.jpg"])).toEqual(["p001.jpg", "P1.jpg", "p02.jpg"]);
  expect(inOrder(["X-01.JPG", "X-02.JPG", "X-10.jpg", "X.JPG"])).toEqual([
    "X.JPG",
    "X-01.JPG",
    "X-02.JPG",
    "X-10.jpg",
  ]);
});

test("numbers count in any script", () => {
  const orders = [
    ["第一話/1.jpg", "第二話/1.jpg", "第十話/1.jpg", "第十二話/1.jpg", "第百話/1.jpg"],
    ["①.jpg", "②.jpg", "⑩.jpg", "⑳.jpg"],
    ["p９.jpg", "p１０.jpg"],
    ["物語（上）.jpg", "物語（中）.jpg", "物語（下）.jpg"],
    ["卷壹.jpg", "卷贰.jpg", "卷叁.jpg", "卷拾.jpg"],
    ["一九.jpg", "二〇.jpg", "二千三.jpg", "一万.jpg"],
  ];
  for (const order of orders) expect(inOrder([...order].sort())).toEqual(order);
});
