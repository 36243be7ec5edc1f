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
