import { expect, test } from "vitest";
import { metresIn, metresOf } from "./metres.ts";

test("lengths on paper are read in their units, and nothing else is", () => {
  const lengths = ["210mm", " 21 CM", "0.21m", "8.5in", "595.2pt"].map(metresIn);
  const metres = [0.21, 0.21, 0.21, 0.2159, 0.20997];
  for (const [k, length] of lengths.entries()) expect(length).toBeCloseTo(metres[k], 4);
  for (const none of ["", "210", "mm", "1.2.3mm", "-3mm", "0mm", "9px", "1e3mm", "2 m m"]) {
    expect(metresIn(none), none).toBeUndefined();
  }
  expect(metresOf(Number.NaN, "mm")).toBeUndefined();
});
