import { expect, test } from "vitest";
import { legacyNames } from "./legacy_names.ts";

const bytes = (...all: number[]): Uint8Array => Uint8Array.from(all);

test.each([
  // "第1話", in which GBK finds letters too, and "表" with the byte of a backslash.
  ["Japanese", [bytes(0x91, 0xe6, 0x31, 0x98, 0x62), bytes(0x95, 0x5c)], ["第1話", "表"]],
  ["Chinese", [bytes(0xb5, 0xda, 0x31, 0xbb, 0xb0), bytes(0xd6, 0xd0)], ["第1话", "中"]],
  ["Korean", [bytes(0xc1, 0xa6, 0x31, 0xc8, 0xad)], ["제1화"]],
  ["Unicode", [bytes(0xc3, 0xa9), bytes(0x61)], ["é", "a"]],
  ["ASCII", [bytes(0x61), bytes(0x62)], ["a", "b"]],
])("names in %s", (_, raw, names) => {
  expect(legacyNames(raw, ["?", "?"].slice(0, raw.length))).toEqual(names);
});

test("names in no other encoding are those of DOS", () => {
  expect(legacyNames([bytes(0x81, 0x2e), bytes(0x94)], ["ü.", "ö"])).toEqual(["ü.", "ö"]);
});
