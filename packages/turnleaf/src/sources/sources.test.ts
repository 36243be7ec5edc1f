import { describe, expect, it } from "vitest";
import { cleanLanguage, cleanText, nameOfUrl } from "./book_text.ts";
import { securedAddress } from "./fetch_bytes.ts";
import { sniff } from "./formats.ts";
import { fitPixels, limits } from "./limits.ts";
import { SharedTasks } from "./shared_tasks.ts";

const bytes = (text: string): Uint8Array => Uint8Array.from(text, (c) => c.charCodeAt(0));

describe("sniff", () => {
  it.each([
    ["pdf", "%PDF-1.7\n"],
    ["pdf", `${"x".repeat(1000)}%PDF-1.4`],
    ["pdf", `${"x".repeat(1022)}%PDF-1.4`],
    ["pdf", `${"x".repeat(1024)}%PDF-1.4`],
    ["pdf", "HTTP/1.1 200 OK\r\nContent-Type: application/pdf\r\n\r\n%PDF-1.4"],
    ["pdf", "<!doctype html>\n%PDF-1.4"],
    ["zip", "PK\x03\x04%PDF-1.4"],
    ["rar", "Rar!\x1a\x07 %PDF-1.4"],
    ["pdf", "%PDF-1.4 PK\x03\x04"],
    ["pdf", "%!PS-Adobe-3.0 PDF-1.4"],
    ["image", "\x89PNG\r\n\x1a\nIHDR"],
    ["image", "\xff\xd8\xff\xe0JFIF"],
    ["image", "GIF89a"],
    ["image", "RIFF....WEBPVP8 "],
    ["image", "\0\0\0\x1cftypavif"],
    ["json", ' \n{"pages":[]}'],
    ["json", "\xef\xbb\xbf[]"],
    ["html", "<!doctype html><title>"],
    ["html", "  <html>"],
    ["zip", "PK\x03\x04"],
    ["rar", "Rar!\x1a\x07"],
    ["7z", "7z\xbc\xaf\x27\x1c"],
    ["text", "Call me Ishmael."],
    ["text", "# Moby-Dick"],
    ["text", "[Turnleaf](https://example.org) turns pages."],
    ["text", "[[Page]] [x] [1]: one"],
    ["json", '[ "a.png", "b.png"]'],
    ["json", '[{"src":"a.png"}]'],
    ["text", "Caf\xc3\xa9 ".repeat(200)],
    ["unknown", "Caf\xe9"],
    ["unknown", "a\0b"],
    ["image", '<svg xmlns="http://www.w3.org/2000/svg">'],
    ["image", '\xef\xbb\xbf<?xml version="1.0"?>\n<!-- by hand -->\n<svg:svg>'],
    ["html", "<!-- a page --><html><svg></svg>"],
    ["html", "<?xml version='1.0'?>\n<!DOCTYPE html><html>"],
    ["html", "\xff\xfe<\0h\0t\0m\0l\0>\0"],
    ["json", "\xff\xfe{\0"],
    ["text", `${"x".repeat(1025)}%PDF-1.4`],
    ["unknown", ""],
  ])("tells %s by its first bytes", (kind, text) => {
    expect(sniff({ start: bytes(text), type: "" })).toBe(kind);
  });
});

it("takes text of other encodings where the media type says that it is text", () => {
  expect(sniff({ start: bytes("Caf\xe9"), type: "text/plain" })).toBe("text");
  expect(sniff({ start: bytes("%PDF-1.4"), type: "text/plain" })).toBe("pdf");
  expect(sniff({ start: bytes("a\0b"), type: "text/plain" })).toBe("unknown");
  expect(sniff({ start: bytes('{"pages":[]}'), type: "text/plain" })).toBe("json");
});

it.each(['["quoted"](#a)', "{% include a %}", "<!-- by hand -->\n# A", "<html>"])(
  "takes %s for Markdown where the media type says so",
  (text) => {
    expect(sniff({ start: bytes(text), type: "text/markdown" })).toBe("text");
  },
);

describe("fitPixels", () => {
  it("keeps proportions at the width that is asked for", () => {
    expect(fitPixels({ width: 600, height: 900 }, 300)).toEqual({ width: 300, height: 450 });
  });
  it.each([
    [{ width: 1, height: 1 }, 1e9],
    [{ width: 1, height: 100_000 }, 4000],
    [{ width: 100_000, height: 1 }, 4000],
    [{ width: 3, height: 4 }, Number.POSITIVE_INFINITY],
    [{ width: 3, height: 4 }, Number.NaN],
    [{ width: 3, height: 4 }, -5],
  ])("stays within bounds for %o at %d", (size, width) => {
    const fitted = fitPixels(size, width);
    expect(fitted.width).toBeGreaterThanOrEqual(1);
    expect(fitted.height).toBeGreaterThanOrEqual(1);
    expect(Math.max(fitted.width, fitted.height)).toBeLessThanOrEqual(limits.side);
    expect(fitted.width * fitted.height).toBeLessThanOrEqual(limits.pixels);
  });
});

describe("texts of a book", () => {
  it("names a file by the end of its address", () => {
    expect(nameOfUrl("https://x.example/a/My%20book.pdf?v=1#p")).toBe("My book.pdf");
    expect(nameOfUrl("https://x.example/%E0%A4%A")).toBe("%E0%A4%A");
    expect(nameOfUrl("blob:https://x.example/1-2")).toBe("this book");
    expect(nameOfUrl("https://x.example/")).toBe("x.example");
    expect(nameOfUrl(`https://x.example/a.pdf${"/".repeat(1_000_000)}`)).toBe("a.pdf");
    expect(nameOfUrl(`https://${"/".repeat(1_000_000)}?`)).toBe("https:");
  });
  it("keeps one clean line", () => {
    expect(cleanText("a\u0007\n  b\u202e")).toBe("a b");
    expect(cleanText(7)).toBe("");
  });
  it("makes tags canonical and drops invalid ones", () => {
    expect(cleanLanguage("pt_br")).toBe("pt-BR");
    expect(cleanLanguage("not a language")).toBe("");
    expect(cleanLanguage(undefined)).toBe("");
  });
});

describe("SharedTasks", () => {
  it("runs one task for all who wait and aborts it when the last gives up", async () => {
    const tasks = new SharedTasks<string, number>();
    let started = 0;
    let own: AbortSignal | undefined;
    const start = (signal: AbortSignal): Promise<number> => {
      started += 1;
      own = signal;
      return new Promise(() => {});
    };
    const first = new AbortController();
    const second = new AbortController();
    const waiting = [
      tasks.run("a", start, first.signal).catch((error: unknown) => error),
      tasks.run("a", start, second.signal).catch((error: unknown) => error),
    ];
    expect(started).toBe(1);
    first.abort("enough");
    expect(await waiting[0]).toBe("enough");
    expect(own?.aborted).toBe(false);
    second.abort("me too");
    expect(await waiting[1]).toBe("me too");
    expect(own?.aborted).toBe(true);
  });
  it("starts anew after a task has ended", async () => {
    const tasks = new SharedTasks<string, number>();
    expect(await tasks.run("a", () => Promise.resolve(1))).toBe(1);
    expect(await tasks.run("a", () => Promise.resolve(2))).toBe(2);
    await expect(tasks.run("a", () => Promise.reject(new Error("no")))).rejects.toThrow("no");
    expect(await tasks.run("a", () => Promise.resolve(3))).toBe(3);
  });
});

describe("securedAddress", () => {
  it.each([
    ["http://a.example/i.jpg", "https://a.example/i.jpg"],
    ["HTTP://a.example:8080/i?q", "https://a.example:8080/i?q"],
    ["https://a.example/i", "https://a.example/i"],
    ["http://localhost:8000/i", "http://localhost:8000/i"],
    ["http://127.0.0.1/i", "http://127.0.0.1/i"],
    ["http://[::1]/i", "http://[::1]/i"],
    ["blob:https://a.example/1", "blob:https://a.example/1"],
    ["a.jpg", "a.jpg"],
  ])("a secure page fetches %s from %s", (url, secured) => {
    expect(securedAddress(url, "https:")).toBe(secured);
  });

  it("leaves addresses to other pages as they are", () => {
    expect(securedAddress("http://a.example/", "http:")).toBe("http://a.example/");
  });
});
