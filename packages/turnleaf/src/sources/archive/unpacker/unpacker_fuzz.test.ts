/** Whatever bytes an archive of RAR or 7-Zip, or a file packed by XZ, has, it comes to an end within the bounds. */

import { expect } from "vitest";
import { clue, fuzzed } from "../../../for_tests/random_numbers.ts";
import { rar4, rar5, sevenZip, xz } from "../../../for_tests/stored_archives.ts";
import { fixture, fixtureNames } from "./fixtures_for_tests.ts";
import { bounds, unpacked } from "./unpacked_for_tests.ts";

const files = { "1.png": "an image", "b/2.png": "another", "ComicInfo.xml": "<ComicInfo/>" };
const whole: readonly Uint8Array[] = [
  ...fixtureNames.map(fixture),
  ...[rar4, rar5, sevenZip].map((pack) => pack(files)),
  xz(new TextEncoder().encode("text ".repeat(20))),
];

fuzzed(
  "a mutated archive of RAR or 7-Zip, or file of XZ, comes to an end within the bounds",
  300,
  async (random) => {
    const index = random.below(whole.length);
    let bytes = whole[index].slice();
    for (let k = random.below(6); k >= 0; k--) {
      // Headers are at the start and at the end.
      const near = random.among([bytes.length, 64, 200]);
      const at = random.among([random.below(near), bytes.length - 1 - random.below(near)]);
      bytes[at] = random.among([0, 255, 1, 128, random.below(256)]);
    }
    if (random.below(4) === 0) bytes = bytes.slice(0, random.below(bytes.length));
    const said = clue([index, [...bytes].join()]);
    const all = await unpacked(bytes, {}, index === whole.length - 1 ? "xz" : "archive");
    expect(["end", "failed"], said).toContain(all.at(-1)?.kind);
    let sum = 0;
    for (const one of all) {
      if ("path" in one) expect(one.path.length, said).toBeLessThanOrEqual(bounds.pathLength);
      if (one.kind !== "file") continue;
      expect(one.bytes.size, said).toBeLessThanOrEqual(bounds.fileBytes);
      sum += one.bytes.size;
    }
    expect(sum, said).toBeLessThanOrEqual(bounds.allBytes);
  },
);
