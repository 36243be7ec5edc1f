import { expect, test } from "vitest";
import { rar4, rar5, sevenZip } from "../../for_tests/stored_archives.ts";
import { marksLength, obstacleIn } from "./archive_marks.ts";
import { fixture } from "./unpacker/fixtures_for_tests.ts";

const obstacleOf = (bytes: Uint8Array) => obstacleIn(bytes.subarray(0, marksLength), bytes.length);

test.each([
  ["rar.rar", null],
  ["rar5_stored.rar", null],
  ["rar5_multiple_files_solid.rar", null],
  ["7zip_lzma1.7z", null],
  ["7zip_empty_archive.7z", null],
  ["rar_multivolume_single_file.part1.rar", "volume"],
  ["rar5_multiarchive_solid.part04.rar", "volume"],
  ["rar_encryption_header.rar", "encrypted"],
  ["rar5_encrypted_filenames.rar", "encrypted"],
])("%s: %s", (name, obstacle) => {
  expect(obstacleOf(fixture(name))).toBe(obstacle);
});

test("a 7-Zip archive whose end is missing is seen to be short, and others by nothing", () => {
  const whole = sevenZip({ "1.png": "image" });
  expect(obstacleOf(whole)).toBeNull();
  for (const length of [6, 31, 32, whole.length - 1]) {
    expect(obstacleOf(whole.slice(0, length))).toBe("short");
  }
  for (const bytes of [rar4({ a: "b" }), rar5({ a: "b" })]) {
    for (let length = 0; length <= bytes.length; length++) {
      expect(obstacleOf(bytes.slice(0, length))).toBeNull();
    }
  }
});
