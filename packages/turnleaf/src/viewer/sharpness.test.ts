/** Sharper parts arrive late, or not at all. */

import { expect, test, vi } from "vitest";
import type { SharpnessParts } from "./detail_pictures.ts";
import type { OpenPage } from "./face_textures.ts";
import { Sharpness } from "./sharpness.ts";

vi.mock("./detail_pictures.ts", () => {
  throw new TypeError("Failed to fetch");
});

/** A leaf is seen a thousand pixels wide. */
const stage = {
  restingRatio: 1,
  projectOn: (_: string, x: number, y: number) => ({ x: 1000 * x, y: 1500 * y }),
} as unknown as SharpnessParts["stage"];

test("nothing is loaded for pages that are sharp, and a failure is reported once", async () => {
  const reports: unknown[] = [];
  let arrived = 0;
  const tools = {
    stage,
    arrived: () => arrived++,
    failed: (error: unknown) => reports.push(error),
  };
  const sharpness = new Sharpness(tools as unknown as SharpnessParts);
  const seen = (width: number): OpenPage[] => [{ face: "left", page: 2, width }];
  for (const width of [0, 1200, Number.POSITIVE_INFINITY])
    sharpness.look(seen(width), { width: 800, height: 600 });
  expect(sharpness.settled).toBe(true);
  sharpness.look(seen(500), { width: 800, height: 600 });
  expect(sharpness.settled).toBe(false);
  await expect.poll(() => sharpness.settled).toBe(true);
  expect(arrived).toBe(1);
  sharpness.look(seen(500), { width: 800, height: 600 });
  expect(sharpness.settled).toBe(true);
  expect(reports).toHaveLength(1);
  expect(String(reports[0])).toMatch("A part of the reader failed");
});
