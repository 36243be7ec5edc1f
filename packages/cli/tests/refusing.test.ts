import { chmodSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { parseCommand } from "../src/arguments.ts";
import { browserCommand } from "../src/browser.ts";
import { fileProblem, printable } from "../src/problem.ts";
import { ownedPdf, pdf, png } from "./books.ts";
import { folderOf, run, start } from "./command.ts";

const whole = pdf();
let folder: ReturnType<typeof folderOf>;

beforeAll(() => {
  folder = folderOf({
    "whole.pdf": whole,
    "empty.pdf": "",
    "owned.pdf": ownedPdf,
    "torn.pdf": "%PDF-1.7\nand then nothing",
    "half.pdf": whole.subarray(0, 200),
    "page.pdf": "<!doctype html><title>Not found</title>",
    "novel.epub": "\x1f\x8b\x08",
    "bad/only.pdf": "",
    "other/notes.docx": "x",
    "page.svg": '<?xml version="1.0"?><!-- x --><svg xmlns="http://www.w3.org/2000/svg"/>',
    "list.json": '{"pages":[]}',
    "evil\u001b[31m.txt": "\0",
    "one.png": png(3, 4),
  });
  mkdirSync(join(folder.path, "none"));
});
afterAll(() => folder.remove());

describe("what cannot be read ends with one sentence and status 1", () => {
  it.each([
    ["missing.pdf", /^\S+missing\.pdf was not found; check its name and folder\.\n$/],
    ["whole.pdf/x", /^\S+x was not found; check its name and folder\.\n$/],
    ["empty.pdf", /^\S+empty\.pdf is empty; get the file again\.\n$/],
    ["torn.pdf", /^\S+torn\.pdf is damaged or no PDF; repair the file or get it again\.\n$/],
    ["half.pdf", /^\S+half\.pdf has no pages; choose another file\.\n$/],
    ["page.pdf", /^\S+page\.pdf is a web page, not a book; PDF, EPUB, .* can be read\.\n$/],
    ["page.svg", /^\S+page\.svg is an SVG, which may hold scripts; PDF, .* can be read\.\n$/],
    [
      "list.json",
      /^\S+list\.json is JSON \(a IIIF manifest is opened by its address\); PDF, .*\n$/,
    ],
    ["novel.epub", /^\S+novel\.epub is of an unknown format; .* can be read\.\n$/],
    ["none", /^\S+none holds no pages; put images \(PNG, .*\) or books into it\.\n$/],
    ["other", /^\S+other holds no pages; put images \(PNG, .*\) or books into it\.\n$/],
    ["bad", /^\S+only\.pdf is empty; get the file again\.\n$/],
    ["evil\u001b[31m.txt", /^\S+evil \[31m\.txt is of an unknown format; /],
  ])("%s", async (name, sentence) => {
    const ended = await run("read", join(folder.path, name), "--port", "0");
    expect(ended.stderr).toMatch(sentence);
    expect(ended).toMatchObject({ status: 1, stdout: "" });
  });

  it.skipIf(process.platform === "win32")("something that is no file", async () => {
    const ended = await run("/dev/null");
    expect(ended.stderr).toBe("/dev/null is neither a file nor a folder; name a book.\n");
    expect(ended.status).toBe(1);
  });

  it.skipIf(process.getuid?.() === 0)("a file without permission", async () => {
    chmodSync(join(folder.path, "one.png"), 0);
    const ended = await run(join(folder.path, "one.png"));
    chmodSync(join(folder.path, "one.png"), 0o600);
    expect(ended.stderr).toMatch(/one\.png may not be read; give yourself the permission/);
    expect(ended.status).toBe(1);
  });

  it("whatever else the file system says", () => {
    const sentence = (code: string): string => fileProblem("a.pdf", { code }).message;
    expect(sentence("EACCES")).toMatch(/^a\.pdf may not be read; /);
    expect(sentence("ELOOP")).toMatch(/^a\.pdf is a link that leads to itself; /);
    expect(sentence("EIO")).toMatch(/^a\.pdf could not be read \(EIO\); /);
  });
});

describe("what can be read after all is served", () => {
  it.each([["owned.pdf"], ["one.png"]])("%s", async (name) => {
    const served = await start(join(folder.path, name), "--port", "0");
    expect(served.stdout).toContain(`Turnleaf is reading ${name} at `);
    expect((await served.stop()).status).toBe(0);
  });
});

describe("the command line", () => {
  it("is quoted if it is not understood, with status 2", async () => {
    for (const args of [
      [],
      ["read"],
      ["a", ""],
      ["--nope"],
      ["a", "--port", "x"],
      ["a", "--port"],
    ]) {
      const ended = await run(...args);
      expect(ended.status, args.join(" ")).toBe(2);
      expect(ended.stdout).toBe("");
      expect(ended.stderr).toMatch(/^[^\n]+\.\n\nTurnleaf shows a book/);
    }
  });

  it("prints --help and --version", async () => {
    expect(await run("--help")).toMatchObject({ status: 0, stderr: "" });
    expect((await run("read", "-h")).stdout).toContain("turnleaf read BOOK…");
    expect((await run("--version")).stdout).toMatch(/^\d+\.\d+\.\d+\n$/);
  });

  it("takes a book with and without the word read", () => {
    const expected = { name: "read", books: ["b.pdf"], port: undefined, opens: true };
    expect(parseCommand(["b.pdf"])).toEqual(expected);
    expect(parseCommand(["read", "b.pdf"])).toEqual(expected);
    expect(parseCommand(["read", "read"])).toEqual({ ...expected, books: ["read"] });
    expect(parseCommand(["b.pdf", "--no-open", "--port", "80"])).toEqual({
      ...expected,
      port: 80,
      opens: false,
    });
    expect(parseCommand(["--", "--odd.pdf"])).toEqual({ ...expected, books: ["--odd.pdf"] });
    for (const port of ["65536", "-1", "1.5", "", "0x50", "1e3"]) {
      expect(() => parseCommand(["b.pdf", `--port=${port}`])).toThrow("--port takes a number");
    }
  });

  it("opens a browser only where somebody would see it", () => {
    expect(browserCommand("linux", {})).toBeNull();
    expect(browserCommand("linux", { DISPLAY: ":0" })).toEqual(["xdg-open"]);
    expect(browserCommand("linux", { WAYLAND_DISPLAY: "w", CI: "true" })).toBeNull();
    expect(browserCommand("darwin", {})).toEqual(["open"]);
    expect(browserCommand("win32", {})).toEqual(["cmd", "/c", "start", ""]);
  });

  it("prints names without what would steer a terminal", () => {
    expect(printable("a\u001b]0;x\u0007b\u202e")).toBe("a ]0;x b");
    expect([...printable("😀".repeat(500))].length).toBe(200);
  });
});
