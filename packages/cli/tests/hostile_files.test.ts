/** Files that never end, or are too large: rejected in one sentence. */
import { execFileSync } from "node:child_process";
import { existsSync, symlinkSync, truncateSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { openBook } from "../src/book.ts";
import { Frames } from "../src/film/frames.ts";
import { openRegular, readRegular } from "../src/regular_file.ts";
import { pdf, png } from "./books.ts";
import { folderOf, run } from "./command.ts";

let folder: ReturnType<typeof folderOf>;
const at = (name: string): string => join(folder.path, name);

beforeAll(() => {
  folder = folderOf({
    "small.png": png(3, 4),
    "large.png": png(3, 4),
    "large.pdf": pdf(),
    "film/000001.png": png(1, 1),
  });
  // Sparse: they take no space on the disk.
  truncateSync(at("large.png"), 100_000_001);
  truncateSync(at("large.pdf"), 2_000_000_001);
  if (process.platform === "win32") return;
  for (const pipe of ["pipe", "pipe.png", "film/film.json"]) execFileSync("mkfifo", [at(pipe)]);
  symlinkSync("/dev/zero", at("zero.png"));
});
afterAll(() => folder.remove());

const onUnix = describe.skipIf(process.platform === "win32");

onUnix("bake", () => {
  it.each([
    ["/dev/zero", /^\/dev\/zero is not a regular file; name another\.\n$/],
    ["zero.png", /^\S+zero\.png is not a regular file; name another\.\n$/],
    ["pipe", /^\S+pipe is not a regular file; name another\.\n$/],
    ["film", /^\S+film is not a regular file; name another\.\n$/],
    ["large.png", /^\S+large\.png is larger than 100 MB; name a smaller file\.\n$/],
  ])("--front and --back %s", async (name, sentence) => {
    const image = name.startsWith("/") ? name : at(name);
    for (const side of ["--front", "--back"]) {
      const ended = await run("bake", "--out", at("turn.glb"), side, image);
      expect(ended).toMatchObject({ status: 1, stdout: "" });
      expect(ended.stderr).toMatch(sentence);
    }
    expect(existsSync(at("turn.glb"))).toBe(false);
  });
});

onUnix("read", () => {
  it.each([
    ["/dev/zero", /^\/dev\/zero is neither a file nor a folder; name a book\.\n$/],
    ["pipe.png", /^\S+pipe\.png is neither a file nor a folder; name a book\.\n$/],
    ["large.png", /^\S+large\.png is larger than 100 MB; name a smaller file\.\n$/],
    ["large.pdf", /^\S+large\.pdf is larger than 2 GB; name a smaller file\.\n$/],
  ])("%s", async (name, sentence) => {
    const ended = await run("read", name.startsWith("/") ? name : at(name), "--port", "0");
    expect(ended).toMatchObject({ status: 1, stdout: "" });
    expect(ended.stderr).toMatch(sentence);
  });

  it("reads a Kindle book as large as an archive", async () => {
    const folder = folderOf({ "a.mobi": `${"a".padEnd(60, "\0")}BOOKMOBI` });
    truncateSync(join(folder.path, "a.mobi"), 200_000_000);
    const { src } = await openBook(join(folder.path, "a.mobi"), () => {});
    expect(src).toBe("/book/a.mobi");
    folder.remove();
  });

  it("leaves pipes and devices out of a folder", async () => {
    const book = await openBook(folder.path, () => {}).catch((error: Error) => error.message);
    // The one PDF of the folder is the book, and it is too large; nothing waits for a pipe.
    expect(book).toMatch(/large\.pdf is larger than 2 GB/);
  });
});

onUnix("film", () => {
  const request = { request: "x", fps: 30, width: 2, height: 2 };

  it("does not wait for a note that is a pipe", async () => {
    const opening = Frames.open(at("film"), request, false);
    await expect(opening).rejects.toThrow("holds other files or another film");
  });

  it.each([
    ["a million frames in one part", { parts: [1_000_000] }],
    ["parts that are no numbers", { parts: ["1e9"] }],
    ["half a picture", { parts: [0.5] }],
    ["no end", { whole: "yes" }],
    ["a megabyte of parts", { parts: Array(600_000).fill(1) }],
  ])("does not go by a note of %s", async (_, wrong) => {
    const note = JSON.stringify({ ...request, parts: [1], whole: false, ...wrong });
    const other = folderOf({ "film.json": note });
    const frames = await Frames.open(other.path, request, true);
    expect([frames.count, frames.parts, frames.isWhole]).toEqual([0, 0, false]);
    other.remove();
  });
});

onUnix("a file that is opened", () => {
  it("is a regular one", async () => {
    for (const name of ["/dev/zero", "/dev/null", at("pipe"), folder.path]) {
      expect(await openRegular(name), name).toBeNull();
    }
    const handle = await openRegular(at("small.png"));
    expect((await handle?.stat())?.isFile()).toBe(true);
    await handle?.close();
  });

  it("is read whole, up to its bound", async () => {
    const bytes = png(3, 4);
    expect(await readRegular(at("small.png"), bytes.length)).toEqual(bytes);
    await expect(readRegular(at("small.png"), bytes.length - 1)).rejects.toThrow(
      "small.png is larger than 0 MB; name a smaller file.",
    );
    // Files of the kernel report no size: they are read as empty.
    if (existsSync("/proc/self/maps")) {
      expect(await readRegular("/proc/self/maps", 1e6)).toHaveLength(0);
    }
  });
});
