import { PNG } from "pngjs";
import { expect } from "vitest";

/**
 * Fraction of a small picture that the outlines of both pages take, two pixels wide. The GL that Chromium
 * has in software draws a page's edge that ends between two samples now at one, now at the other, on a
 * busy machine and of the same vertices; another moment of a turn differs in half of the picture.
 */
const outlines = 0.1;

/** Fails where two PNGs are different pictures of a film, and not only of pages whose edges fall otherwise. */
export function expectSamePicture(a: Buffer, b: Buffer, name: string): void {
  const [one, other] = [PNG.sync.read(a), PNG.sync.read(b)];
  expect([other.width, other.height], name).toEqual([one.width, one.height]);
  let differing = 0;
  for (let at = 0; at < one.data.length; at += 4) {
    if (one.data.readUInt32LE(at) !== other.data.readUInt32LE(at)) differing++;
  }
  expect(differing / (one.width * one.height), name).toBeLessThan(outlines);
}
