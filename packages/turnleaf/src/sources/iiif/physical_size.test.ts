import { expect, test } from "vitest";
import { openIiif } from "./iiif_source.ts";

const canvas = { id: "https://x.example/1", type: "Canvas", width: 2100, height: 2970 };
const service = {
  profile: "http://iiif.io/api/annex/services/physdim",
  physicalScale: 0.1,
  physicalUnits: "mm",
};
const open = (manifest: object): number | undefined =>
  openIiif({ type: "Manifest", ...manifest }, "https://x.example/m", "m").widthInMetres?.(canvas);

test("physical dimensions say how wide a page is, of its canvas or of its book", () => {
  expect(open({ items: [{ ...canvas, service: [service] }] })).toBeCloseTo(0.21);
  expect(open({ items: [canvas], service })).toBeCloseTo(0.21);
});

test("a book without them, or with others, does not", () => {
  expect(open({ items: [canvas] })).toBeUndefined();
  for (const wrong of [{ physicalScale: "x" }, { physicalUnits: "ell" }, { profile: "other" }]) {
    expect(open({ items: [canvas], service: { ...service, ...wrong } })).toBeUndefined();
  }
});
