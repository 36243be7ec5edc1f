/** What is done in a film: arguments, and films of folds and tears by the built command. */

import { cpSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { PNG } from "pngjs";
import type { TurnleafBook } from "turnleaf";
import { afterAll, beforeAll, describe, expect, it, test } from "vitest";
import { type Performed, perform } from "../app/perform.ts";
import { parseCommand } from "../src/arguments.ts";
import type { ChromiumPage } from "../src/chromium/devtools.ts";
import { Taking } from "../src/film/film.ts";
import { mostActions } from "../src/film/film_actions.ts";
import type { FilmCommand } from "../src/film/film_arguments.ts";
import { type Frames, mostPictures } from "../src/film/frames.ts";
import { Progress } from "../src/progress.ts";
import { page as coloured } from "./books.ts";
import { type Ended, folderOf, runWithChromium } from "./command.ts";
import { expectSamePicture } from "./same_picture.ts";

const parse = (...args: string[]): FilmCommand =>
  parseCommand(["film", "a.pdf", "--out", "a", ...args]) as FilmCommand;

describe("arguments", () => {
  test("actions are named after the methods of the element, in one list or several", () => {
    const { actions } = parse(
      "--do",
      "dog-ear 8 foot 0.3,next;fold 3 0.7,0 0.7,1 -90,  go-to 4, tear-out",
      "--do",
      "wait 1.5,tear-across 0,.5 1,.25, dog-ear 0.1, fold 5 letter,",
    );
    expect(actions).toEqual([
      { text: "dog-ear 8 foot 0.3", name: "dog-ear", page: 8, corner: "foot", size: 0.3 },
      { text: "next", name: "next" },
      {
        text: "fold 3 0.7,0 0.7,1 -90",
        name: "fold",
        page: 3,
        fold: { from: { x: 0.7, y: 0 }, to: { x: 0.7, y: 1 }, angle: -90 },
      },
      { text: "go-to 4", name: "go-to", page: 4 },
      { text: "tear-out", name: "tear-out" },
      { text: "wait 1.5", name: "wait", seconds: 1.5 },
      {
        text: "tear-across 0,.5 1,.25",
        name: "tear-across",
        from: { x: 0, y: 0.5 },
        to: { x: 1, y: 0.25 },
      },
      { text: "dog-ear 0.1", name: "dog-ear", size: 0.1 },
      { text: "fold 5 letter", name: "fold", page: 5, fold: "letter" },
    ]);
  });

  test("without any, pages turn", () => {
    expect(parse().actions).toBeUndefined();
    expect(parse("--pages", "3-5")).toMatchObject({ from: 3, to: 5 });
  });

  test("attributes bind the book", () => {
    const { attributes } = parse("--attribute", "binding=top", "--attribute", "stocks=1-4 card");
    expect(attributes).toEqual({ binding: "top", stocks: "1-4 card" });
  });

  it.each([
    [["--do", "next, turn"], '"turn" in --do was not understood; an action is next, previous, '],
    [["--do", "constructor"], '"constructor" in --do was not understood; an action is next, '],
    [
      ["--do", "dog-ear 8 top"],
      '"top" in "dog-ear 8 top" was not understood; it is written dog-ear [PAGE] [head|foot] [SIZE], its size 0.05 to 0.5.',
    ],
    [["--do", "dog-ear 0"], '"0" in "dog-ear 0" was not understood; it is written dog-ear '],
    [["--do", "go-to"], '"go-to" in --do is not complete; it is written go-to PAGE.'],
    [
      ["--do", "fold 3 0.5,0"],
      '"fold 3 0.5,0" in --do is not complete; it is written fold PAGE X,Y X,Y [ANGLE] ',
    ],
    [["--do", "fold 3 0.5,0 0.5,1 200"], '"200" in "fold 3 0.5,0 0.5,1 200" was not understood'],
    [["--do", "fold 3 0,1 0,1"], "A fold in --do goes through two places that are not the same."],
    [["--do", "tear-across 0,1 0.5,2"], '"0.5,2" in "tear-across 0,1 0.5,2" was not understood'],
    [["--do", "wait 61"], '"61" in "wait 61" was not understood; it is written wait SECONDS, 0 to'],
    [["--do", "crumple hard"], '"hard" in "crumple hard" was not understood; it is written crum'],
    [["--do", " ,; "], "--do is a list of actions: next, previous, go-to PAGE, "],
    [
      ["--do", "next", "--pages", "1-9"],
      "With --do, --pages is the one page at which the film begins.",
    ],
    [["--attribute", "src=b.pdf"], '"src=b.pdf" is no --attribute; it is NAME=VALUE, with a name'],
    [["--attribute", "binding"], '"binding" is no --attribute; it is NAME=VALUE, with a name of'],
    [
      ["--attribute", "layout=wide"],
      '"wide" in --attribute layout was not understood; it is auto, spread or single.',
    ],
  ])("%j", (args, sentence) => {
    expect(() => parse(...args)).toThrow(sentence);
  });

  test("too many actions", () => {
    const sentence = "--do takes at most 500 actions; these are 501.";
    expect(() => parse("--do", "next,".repeat(mostActions + 1))).toThrow(sentence);
    expect(parse("--do", "next,".repeat(mostActions)).actions).toHaveLength(mostActions);
  });
});

describe("bounds", () => {
  const command = parse("--fps", "1", "--do", "crumple");

  /** Takes a film of a page in which everything moves on for ever. */
  const take = (frames: Partial<Frames>, restless: FilmCommand = command): Promise<void> => {
    const page = {
      evaluate: async (expression: string) =>
        expression.startsWith("film.open") ? { pages: 9, turns: 1 } : true,
      picture: async () => Buffer.of(1),
    } as unknown as ChromiumPage;
    const all = { has: async () => true, endPart: async () => {}, ...frames } as Frames;
    const signal = new AbortController().signal;
    return new Taking(page, restless, all, new Progress(), signal).run();
  };

  test("an action that never comes to rest ends the film", async () => {
    await expect(take({ count: 0, parts: 0 })).rejects.toThrow(
      'Action 1, "crumple", has not come to rest after 31 s of the film.',
    );
    await expect(take({ count: 0, parts: 0 }, parse("--fps", "1"))).rejects.toThrow(
      "Turn 1 has not come to rest after 31 s of the film.",
    );
  });

  test("a film has no more pictures than there are numbers for", async () => {
    await expect(take({ count: mostPictures - 5, parts: 1 })).rejects.toThrow(
      "A film has at most 999999 frames; film less of it.",
    );
  });
});

describe("an action that cannot be done says why", () => {
  /** A book of which pages 2 and 3 lie open, which does nothing. */
  const book = {
    spread: { left: 2, right: 3 },
    getAttribute: () => null,
    dogEar: () => Promise.reject(new Error("It is all cover.")),
    crumple: () => false,
  } as unknown as TurnleafBook;

  it.each([
    ["crumple", "no loose sheet is whole."],
    ["fold 6 letter", "the page does not lie open."],
    ["dog-ear 3", "It is all cover."],
  ])("%s", async (does, reason) => {
    const [action] = parse("--do", does).actions as [Performed];
    await expect(perform(book, action)).rejects.toThrow(
      new Error(`"${does}" cannot be done: ${reason}`),
    );
  });
});

describe("films", () => {
  let folder: ReturnType<typeof folderOf>;
  beforeAll(() => {
    const colours = [200, 170, 140, 110, 80, 50, 30, 10].map((red) => coloured([red, 90, 60]));
    folder = folderOf(Object.fromEntries(colours.map((png, k) => [`book/${k + 1}.png`, png])));
  });
  afterAll(() => folder.remove());

  // Of a film every frame has more pixels than its picture, and all of them are drawn in software.
  const size = { width: 96, height: 64 };
  const small = [
    "--size",
    `${size.width}x${size.height}`,
    "--fps",
    "8",
    "--seconds-per-turn",
    "0.5",
    "--pause",
    "0.25",
  ];

  const film = (name: string, does: string): Promise<Ended> => {
    const out = join(folder.path, name);
    const args = [join(folder.path, "book"), ...small, "--pages", "2", "--do", does, "--out", out];
    return runWithChromium(["film", ...args]);
  };
  const picturesIn = (name: string): string[] =>
    readdirSync(join(folder.path, name))
      .filter((file) => file.endsWith(".png"))
      .sort();
  const pictures = (name: string): Buffer[] =>
    picturesIn(name).map((file) => readFileSync(join(folder.path, name, file)));

  /** Returns the mean difference of two pictures between two columns, of 255. */
  const difference = (a: Buffer, b: Buffer, from: number, to: number): number => {
    const [before, after] = [PNG.sync.read(a).data, PNG.sync.read(b).data];
    let sum = 0;
    for (let y = 0; y < size.height; y++) {
      for (let k = 4 * (y * size.width + from); k < 4 * (y * size.width + to); k++) {
        sum += Math.abs((before[k] as number) - (after[k] as number));
      }
    }
    return sum / (3 * size.height * (to - from));
  };

  describe("of folds and tears", () => {
    const does = "fold 3 0.6,0 0.6,1, unfold 3, next, tear-out 5, crumple, wait 0.25";
    let done: Ended;
    let whole: Buffer[];
    let note: { readonly parts: number[] };
    beforeAll(async () => {
      done = await film("whole", does);
      whole = pictures("whole");
      note = JSON.parse(readFileSync(join(folder.path, "whole", "film.json"), "utf8"));
    }, 240_000);
    /** Returns the number of pictures in so many parts. */
    const picturesOf = (parts: number): number =>
      note.parts.slice(0, parts).reduce((sum, count) => sum + count, 0);

    it("show them, and end by themselves", () => {
      expect(done).toMatchObject({
        status: 0,
        stdout: expect.stringMatching(/: \d+ frames, 6 actions, \d+\.\d s\n$/),
      });
      expect(note.parts).toHaveLength(7);
      expect(note.parts.at(-1), "a wait of 0.25 s at 8 frames a second").toBe(2);
      const ends = note.parts.map((_, part) => whole[picturesOf(part + 1) - 1] as Buffer);
      const [flat, folded, unfolded, turned, torn, ball] = ends;
      const middle = size.width / 2;
      const right = (a?: Buffer, b?: Buffer): number =>
        difference(a as Buffer, b as Buffer, middle + 4, size.width);
      const left = (a?: Buffer, b?: Buffer): number =>
        difference(a as Buffer, b as Buffer, 0, middle - 4);
      // The page on the right is folded, and nothing on the left.
      expect(right(flat, folded)).toBeGreaterThan(5);
      expect(left(flat, folded)).toBeLessThan(1);
      expect(right(flat, unfolded)).toBeLessThan(right(flat, folded) / 2);
      expect(right(turned, torn)).toBeGreaterThan(5);
      expect(right(torn, ball)).toBeGreaterThan(1);
      // No frame is empty: the page on the left lies there in each until it turns.
      for (const [k, picture] of whole.slice(0, picturesOf(3)).entries()) {
        expect(left(flat, picture), `frame ${k + 1}`).toBeLessThan(8);
      }
    });

    it("are the same pictures where they go on in the middle of an action", async () => {
      // As it was stopped, three pictures into the fourth action.
      const kept = picturesOf(4) + 3;
      const path = join(folder.path, "stopped");
      cpSync(join(folder.path, "whole"), path, { recursive: true });
      for (const name of picturesIn("stopped").slice(kept)) rmSync(join(path, name));
      const stopped = { ...note, parts: note.parts.slice(0, 4), whole: false };
      writeFileSync(join(path, "film.json"), JSON.stringify(stopped));
      expect((await film("stopped", does)).status).toBe(0);
      const again = pictures("stopped");
      expect(again).toHaveLength(whole.length);
      for (const [k, picture] of again.entries()) {
        expectSamePicture(whole[k] as Buffer, picture, `frame ${k + 1}`);
      }
    }, 240_000);

    it("of another action are another film", async () => {
      const { stderr } = await film("whole", "wait 0.5");
      expect(stderr).toContain("holds other files or another film");
    });
  });

  it.each([
    [
      "wait 0.25, fold 3 0,0 1,1",
      '"fold 3 0,0 1,1" cannot be done: A page cannot be folded along a line that',
    ],
    ["wait 1, go-to 90", "The book has 8 pages; page 90 is none of them.\n"],
  ])("what cannot be done ends with one sentence: %s", async (does, sentence) => {
    const ended = await film(`not ${does.replaceAll(/\W+/g, "-")}`, does);
    expect(ended.stderr).toContain(sentence);
    expect(ended.status).toBe(1);
  });
});
