/** What a book drops, as the command that serves it prints it. */

import { afterAll, beforeAll, expect, test } from "vitest";
import { tinyEpub } from "../../turnleaf/src/sources/epub/tiny_epub.ts";
import { pageForTests } from "./browser.ts";
import { ask, folderOf, type Started, start } from "./command.ts";
import { bookComesTo } from "./waiting.ts";

const reader = pageForTests({ viewport: { width: 760, height: 620 }, locale: "en-GB" });

let folder: ReturnType<typeof folderOf>;
let served: Started;

beforeAll(async () => {
  const chapters = [
    '<p>One.</p><img src="gone.png" alt=""/>',
    '<p>Two.</p><img src="lost.png" alt=""/>',
  ];
  folder = folderOf({ "a.epub": tinyEpub({ chapters }) });
  served = await start(`${folder.path}/a.epub`, "--no-open", "--port", "0");
});
afterAll(async () => {
  await served.stop();
  folder.remove();
});

const sentences = ["gone", "lost"].map(
  (name) => `OEBPS/${name}.png, an image of a.epub, is missing or cannot be shown.`,
);

/** Returns the lines that the command has printed, once as many are there. */
async function linesOf(count: number): Promise<string[]> {
  const lines = (): string[] => served.stderr().split("\n").slice(0, -1);
  while (lines().length < count) {
    await new Promise((resolve) => served.child.stderr?.once("data", resolve));
  }
  return lines();
}

test("each sentence is printed once, however often the book is opened", async () => {
  for (let opened = 0; opened < 2; opened++) {
    await reader.page.goto(served.url);
    await bookComesTo(reader.page, (book) => book.warnings.length, 2);
    expect((await linesOf(2)).sort()).toEqual(sentences);
  }
});

test("other sites print nothing, nor does what is no list of sentences", async () => {
  const origin = served.url.slice(0, -1);
  const report = (body: string, headers: Record<string, string>) =>
    ask(served.port, "/report", { method: "POST", headers, body });
  const sentence = JSON.stringify(["Anything."]);
  expect((await report(sentence, { Origin: "https://evil.example" })).status).toBe(403);
  expect((await report(sentence, {})).status).toBe(403);
  for (const body of ["", "{}", "[1, null]", "no JSON"]) {
    expect((await report(body, { Origin: origin })).status).toBe(204);
  }
  expect((await report("x".repeat((1 << 20) + 1), { Origin: origin })).status).toBe(413);
  expect((await report('["\\u001b[31mRed."]', { Origin: origin })).status).toBe(204);
  expect((await linesOf(3))[2]).toBe("[31mRed.");
});
