import { type ChildProcess, execFileSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { parseCommand } from "../src/arguments.ts";
import { ChromiumPage } from "../src/chromium/devtools.ts";
import { findChromium } from "../src/chromium/find_chromium.ts";
import { findProgram } from "../src/chromium/find_program.ts";
import { Frames } from "../src/film/frames.ts";
import { watchTemporary } from "../src/temporary.ts";
import { pdf } from "./books.ts";
import { type Ended, folderOf, main, runWithChromium, signalOnce } from "./command.ts";
import { expectSamePicture } from "./same_picture.ts";

/** Small and few: rendering is in software here. */
const small = ["--size", "96x64", "--fps", "8", "--seconds-per-turn", "0.5", "--pause", "0.25"];

let folder: ReturnType<typeof folderOf>;
let book: string;

beforeAll(() => {
  folder = folderOf({ "small.pdf": pdf(9) });
  book = join(folder.path, "small.pdf");
});
afterAll(() => folder.remove());

/** Films with the built command; `watch` sees it as it begins. */
const film = (
  args: readonly string[],
  environment: NodeJS.ProcessEnv = {},
  watch?: (child: ChildProcess) => void,
): Promise<Ended> => runWithChromium(["film", ...args], watch, environment);

function pictures(path: string): string[] {
  return readdirSync(path).filter((name) => name.endsWith(".png"));
}

describe("what cannot be filmed ends with one sentence", () => {
  it.each([
    [[], "Name the book to film."],
    [["a.pdf"], "Say where the film goes: --out book.mp4"],
    [
      ["a.pdf", "--out", "a.avi"],
      "--out is a file that ends in .mp4, .webm, .gif or .webp, or a folder for numbered pictures.",
    ],
    [["a.pdf", "--out", "a", "--pages", "9-3"], "--pages is a range such as 1-20."],
    [["a.pdf", "--out", "a", "--pages", "0"], "--pages is a range such as 1-20."],
    [
      ["a.pdf", "--out", "a", "--size", "big"],
      "--size is a size such as 1280x720, each side 16 to 4096.",
    ],
    [
      ["a.pdf", "--out", "a.mp4", "--size", "321x240"],
      "A film's width and height are even numbers.",
    ],
    [["a.pdf", "--out", "a", "--fps", "1e3"], "--fps takes a number from 1 to 120."],
    [["a.pdf", "--out", "a", "--stock", "tin"], "--stock is book, bible, office, coated or card."],
  ])("%j", (args, sentence) => {
    expect(() => parseCommand(["film", ...args])).toThrow(sentence);
  });

  it("no Chromium", async () => {
    const args = [book, "--out", join(folder.path, "none")];
    const none = "No Chromium was found on this machine; install Chromium or Chrome, or name one";
    expect((await film([...args, "--chromium", "/no/such"])).stderr).toBe(
      "/no/such is no program; name a Chromium or Chrome.\n",
    );
    // Also if the usual places hold none.
    const ended = await film(args, { PATH: "", CHROMIUM: undefined });
    if (ended.status !== 0) expect(ended.stderr).toContain(none);
    expect(findProgram(["chromium"], { PATH: "" })).toBeNull();
  });

  it("something that is no Chromium", async () => {
    const args = [book, "--out", join(folder.path, "no"), "--chromium", process.execPath];
    const ended = await film(args);
    expect(ended.stderr).toMatch(/^Chromium ended before its work was done.*\n$/);
    expect(ended.status).toBe(1);
  });

  it("no ffmpeg, said before anything is drawn", async () => {
    const out = join(folder.path, "film.mp4");
    const ended = await film([book, "--out", out], { FFMPEG: "/no/ffmpeg" });
    expect(ended.stderr).toMatch(/^No ffmpeg was found, which writes MP4, WebM and GIF; install /);
    expect(ended.status).toBe(1);
    expect(existsSync(`${out}.frames`)).toBe(false);
  });

  it("pages that are not there", async () => {
    const out = join(folder.path, "beyond");
    const ended = await film([book, ...small, "--pages", "1-90", "--out", out]);
    expect(ended.stderr).toBe("The book has 9 pages; page 90 is none of them.\n");
    expect(ended.status).toBe(1);
  });

  it("a folder that holds something else", async () => {
    const ended = await film([book, ...small, "--out", folder.path]);
    expect(ended.stderr).toContain("holds other files or another film; name another folder");
    expect(existsSync(book)).toBe(true);
  });
});

it("a browser that the command starts loads no page but the one that is asked for", async () => {
  let profile = "";
  watchTemporary(({ folder }) => {
    profile = folder;
  });
  const page = await ChromiumPage.start(findChromium(undefined), 96, 64, [
    "--remote-debugging-port=0",
  ]);
  try {
    const [port] = readFileSync(join(profile, "DevToolsActivePort"), "utf8").split("\n", 1);
    const list = await fetch(`http://127.0.0.1:${port}/json/list`);
    const pages = (await list.json()) as { url: string }[];
    expect(pages.map(({ url }) => url)).toEqual(["about:blank"]);
  } finally {
    await page.close();
    watchTemporary(() => {});
  }
});

describe("a film", () => {
  const pages = ["--pages", "1-7"];

  it("is the same pictures where it was stopped on the way and went on", async () => {
    const [whole, stopped] = ["whole", "stopped"].map((name) => join(folder.path, name));
    const done = await film([book, ...small, ...pages, "--out", whole]);
    expect(done.stdout).toMatch(/: \d+ frames, 3 turns, \d+\.\d s\n$/);
    const names = pictures(whole);
    expect(names.length).toBeGreaterThan(12);
    expect(names.at(-1)).toBe(`${String(names.length).padStart(6, "0")}.png`);

    const ended = await film([book, ...small, ...pages, "--out", stopped], {}, (child) => {
      const most = names.length / 2 + 2;
      signalOnce(child, () => existsSync(stopped) && pictures(stopped).length >= most, "SIGINT");
    });
    expect(ended).toMatchObject({
      status: 1,
      stderr: expect.stringMatching(/Stopped; the same command goes on from here\.\n$/),
    });
    const kept = pictures(stopped);
    expect(kept.length).toBeLessThan(names.length);
    const times = kept.map((name) => statSync(join(stopped, name)).mtimeMs);

    expect((await film([book, ...small, ...pages, "--out", stopped])).status).toBe(0);
    expect(pictures(stopped)).toEqual(names);
    expect(kept.map((name) => statSync(join(stopped, name)).mtimeMs)).toEqual(times);
    for (const name of names) {
      const [a, b] = [whole, stopped].map((folder) => readFileSync(join(folder, name)));
      expectSamePicture(a as Buffer, b as Buffer, name);
    }
    // Each turn shows other pictures than the resting book before and after it.
    expect(
      new Set(names.map((name) => readFileSync(join(whole, name), "base64"))).size,
    ).toBeGreaterThan(names.length / 2);

    const again = await film([book, ...small, ...pages, "--out", whole], { CHROMIUM: main });
    expect(again.status, "what is whole asks for no browser's work").toBe(0);
  }, 240_000);

  const ffmpeg = findProgram(["ffmpeg"]);
  if (!ffmpeg) console.warn("No ffmpeg on the PATH: films are tested as pictures alone.");

  it.skipIf(!ffmpeg || !findProgram(["ffprobe"])).each(["mp4", "webm", "gif"])(
    "%s holds every frame, at its rate and size",
    async (format) => {
      const out = join(folder.path, `film.${format}`);
      const ended = await film([book, ...small, "--pages", "3-5", "--out", out]);
      const frames = Number(/: (\d+) frames, 1 turns/.exec(ended.stdout)?.[1]);
      const fields = "stream=width,height,r_frame_rate,nb_read_frames";
      const found = execFileSync("ffprobe", [
        ...["-v", "error", "-count_frames", "-of", "json", "-show_entries", fields, out],
      ]);
      expect(JSON.parse(String(found)).streams[0]).toMatchObject({
        width: 96,
        height: 64,
        nb_read_frames: String(frames),
      });
      expect(existsSync(`${out}.frames`)).toBe(false);
      const again = join(folder.path, `again.${format}`);
      await film([book, ...small, "--pages", "3-5", "--out", again]);
      expect(readFileSync(again).equals(readFileSync(out)), "the same to the last bit").toBe(true);
    },
    240_000,
  );
});

it("pictures of another request in the command's own folder go", async () => {
  const path = join(folder.path, "own");
  const of = (request: string) => ({ request, fps: 8, width: 9, height: 9 });
  const first = await Frames.open(path, of("a"), true);
  await first.write(0, Uint8Array.of(1));
  await first.endPart(1);
  expect((await Frames.open(path, of("a"), true)).count).toBe(1);
  expect((await Frames.open(path, of("b"), true)).count).toBe(0);
  expect(pictures(path)).toEqual([]);
});
