/** Whatever a command line, a header, a link or a note says, it is rejected or stays within its bounds. */
import { expect } from "vitest";
import { clue, fuzzed, wildPieces } from "../../turnleaf/src/for_tests/random_numbers.ts";
import { readCreases } from "../app/playground/creases.ts";
import { BadLink, bounds, firstSettings, readLink, writeLink } from "../app/playground/settings.ts";
import { parseCommand } from "../src/arguments.ts";
import { parseRange } from "../src/byte_range.ts";
import { Frames } from "../src/film/frames.ts";
import { UsageProblem } from "../src/problem.ts";
import { folderOf } from "./command.ts";

/** Sound command lines, and the bounds of the numbers that come of them. */
const lines = [
  "read book.pdf --port 4173 --no-open",
  "film book.pdf --out book.mp4 --pages 1-20 --size 1280x720 --fps 30 --seconds-per-turn 1 --pause 1",
  "bake --out turn.glb --model sheet --seconds 0.8 --size 148x210 --points 26x26 --tolerance 0.001 --fps 30",
  "playground --port 0",
];
const numbers: Readonly<Record<string, readonly [least: number, most: number]>> = {
  port: [0, 65535],
  from: [1, 999_999],
  to: [1, 999_999],
  width: [0.01, 4096],
  height: [0.01, 4096],
  fps: [1, 240],
  turnSeconds: [0.1, 60],
  pauseSeconds: [0, 60],
  seconds: [0.1, 60],
  tolerance: [0.00001, 0.1],
};

fuzzed(
  "a mutated command line is rejected in one sentence or within its bounds",
  5000,
  (random) => {
    const words = random.among(lines).split(" ");
    for (let k = random.below(4); k > 0; k--) {
      const at = random.below(words.length);
      const how = random.below(4);
      if (how === 0) words.splice(at, 1);
      else if (how === 1) words.splice(at, 0, random.among(words.concat(wildPieces)));
      else words[at] = random.mutate(words[at] ?? "", wildPieces);
      if (words.length === 0) break;
    }
    try {
      const command = parseCommand(words);
      for (const [name, value] of Object.entries(command)) {
        const bound = numbers[name];
        if (bound === undefined || value === null || value === undefined) continue;
        expect(value >= bound[0] && value <= bound[1], `${name}, ${clue(words)}`).toBe(true);
      }
      if (command.name === "bake") {
        expect(
          command.points.every((count) => count >= 2 && count <= 200),
          clue(words),
        ).toBe(true);
      }
    } catch (error) {
      expect(error, clue(words)).toBeInstanceOf(UsageProblem);
      expect((error as Error).message, clue(words)).toMatch(/^[^\n]+$/);
    }
  },
);

fuzzed("a mutated Range header asks for bytes of the file alone", 5000, (random) => {
  const header = random.mutate(random.among(["bytes=0-99", "bytes=-5", "bytes=7-"]), wildPieces);
  const size = random.among([0, 1, 100, 2 ** 33]);
  const range = parseRange(header, size);
  if (range === null || range === "unsatisfiable") return;
  const { start, end } = range;
  expect(start >= 0 && start <= end && end < size, clue([header, size])).toBe(true);
});

fuzzed(
  "a mutated link of the playground is rejected whole or within its bounds",
  5000,
  (random) => {
    const sound = writeLink({
      ...firstSettings,
      right: "shell",
      grammage: 200,
      nodes: 9,
      pace: 0.25,
    });
    const link = random.mutate(sound, wildPieces);
    try {
      const settings = readLink(link);
      for (const [name, bound] of Object.entries(bounds)) {
        const value = settings[name as keyof typeof settings];
        if (bound.kind === "range") {
          expect(Number(value) >= bound.least && Number(value) <= bound.most, clue(link)).toBe(
            true,
          );
        } else if (bound.kind === "creases") {
          expect(readCreases(String(value)), clue(link)).not.toBeNull();
        } else if (bound.kind !== "switch") expect(bound.of, clue(link)).toContain(value);
      }
    } catch (error) {
      expect(error, clue(link)).toBeInstanceOf(BadLink);
    }
  },
);

const request = { request: "x", fps: 30, width: 2, height: 2 };
const note = JSON.stringify({ ...request, parts: [30, 42, 17], whole: false });

fuzzed("a mutated note of a film counts pictures that a film may have", 300, async (random) => {
  const text = random.mutate(note, wildPieces);
  const folder = folderOf({ "film.json": text });
  const { count, parts, isWhole } = await Frames.open(folder.path, request, true);
  expect(Number.isInteger(count) && count >= parts && count < 1e6, clue(text)).toBe(true);
  expect(typeof isWhole).toBe("boolean");
  folder.remove();
});
