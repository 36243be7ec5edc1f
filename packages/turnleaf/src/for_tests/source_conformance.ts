/**
 * What every source of pages has to do, whatever its format: for tests only. A
 * new source is run through this in `conformance.browser.test.ts`.
 */

import { expect } from "vitest";
import { cleanText } from "../sources/book_text.ts";
import {
  BookError,
  type LinkTarget,
  type OutlineEntry,
  type PageBox,
  type PagePicture,
  type PageSource,
  type TextRun,
} from "../sources/page_source.ts";

/** The width at which pages are drawn, pixels. */
const width = 64;
const never = new AbortController().signal;

/**
 * Fails if a source breaks the contract of `PageSource`.
 *
 * @param open returns the source, newly opened each time
 */
export async function expectConformance(open: () => Promise<PageSource>): Promise<void> {
  const source = await open();
  checkProperties(source);
  for (const index of someIndices(source)) await checkPage(source, index);
  checkOutline(source, (await source.outline?.(never)) ?? []);
  if (source.file) expect((await source.file()).size, "bytes of file()").toBeGreaterThan(0);
  await checkAborts(source);
  await checkMissingPages(source);
  checkChanges(source);
  source.close();
  source.close();
  await expect(source.draw(0, width, never), "draw() after close()").rejects.toBeInstanceOf(
    BookError,
  );
  // One that is closed while it works ends its work.
  const other = await open();
  const drawing = other.draw(0, width, never).then(closePicture, (error: unknown) => {
    expect(error).toBeInstanceOf(BookError);
  });
  other.close();
  await drawing;
}

function checkProperties(source: PageSource): void {
  const { title, language, direction, kind, pageCount, openingPage = 1 } = source;
  expect(title, "title").toBe(cleanText(title));
  expect(title, "title").not.toBe("");
  expect(language === "" || Intl.getCanonicalLocales(language)[0], "language").toBe(
    language === "" || language,
  );
  expect(["ltr", "rtl"], "direction").toContain(direction);
  expect(["typeset", "scan"], "kind").toContain(kind);
  expect(Number.isInteger(pageCount) && pageCount >= 1, "pageCount").toBe(true);
  checkPageNumber(source, openingPage, "openingPage");
}

/** Returns the first, a middle and the last page. */
function someIndices({ pageCount }: PageSource): ReadonlySet<number> {
  return new Set([0, Math.floor(pageCount / 2), pageCount - 1]);
}

async function checkPage(source: PageSource, index: number): Promise<void> {
  const label = source.label(index);
  expect(label, "label()").toBe(cleanText(label));
  expect(label, "label()").not.toBe("");
  const picture = await source.draw(index, width, never);
  // The size may be known better once the page has been drawn.
  const size = await source.size(index);
  expect(size.width > 0 && size.height > 0, "size()").toBe(true);
  expect(Number.isFinite(size.width * size.height), "size()").toBe(true);
  checkPicture(picture, size.height / size.width);
  const region = { x: 0.25, y: 0.5, width: 0.5, height: 0.25 };
  const part = await source.draw(index, width, never, region);
  checkPicture(part, (size.height * region.height) / (size.width * region.width));
  const around = { x: 0, y: 0, ...size };
  const runs = (await source.text?.(index, never)) ?? [];
  for (const run of runs) checkRun(run, around);
  const exact = (await source.text?.(index, never, true)) ?? [];
  expect(textOf(exact).length > 0, "text() with exact places").toBe(textOf(runs).length > 0);
  for (const run of exact) checkRun(run, around);
  expect(await source.alt?.(index, never), "alt()").toBeTypeOf(source.alt ? "string" : "undefined");
  for (const link of (await source.links?.(index, never)) ?? []) {
    checkBox(link, around, "a link");
    checkTarget(source, link.to);
  }
  for (const medium of (await source.media?.(index, never)) ?? []) {
    checkBox(medium, around, "a sound or a film");
    expect(medium.title, "a sound's or a film's title").not.toBe("");
  }
  for (const field of (await source.fields?.(index, never)) ?? []) {
    checkBox(field, around, "a field");
    expect(field.name, "a field's name").not.toBe("");
  }
}

function checkPicture(picture: PagePicture, ratio: number): void {
  expect(picture.width, "width of draw()").toBeLessThanOrEqual(width);
  expect(picture.width, "width of draw()").toBeGreaterThan(0);
  // Whole pixels.
  const height = Math.min(Math.max(picture.width * ratio, 1), 4096);
  expect(Math.abs(picture.height - height), "height of draw()").toBeLessThanOrEqual(1 + ratio);
  closePicture(picture);
}

function checkRun(run: TextRun, around: PageBox): void {
  expect(run.text, "text of a run").not.toBe("");
  expect(Number.isFinite(run.angle), "angle of a run").toBe(true);
  if (run.angle === 0) checkBox(run, around, "a run");
  if (run.places) expect(run.places.length, "places of a run").toBe(run.text.length);
}

/** Checks that a box has a size and touches the page. */
function checkBox(box: PageBox, around: PageBox, what: string): void {
  expect(box.width > 0 && box.height > 0, `${what} has a size`).toBe(true);
  const isOn =
    box.x < around.width &&
    box.y < around.height &&
    box.x + box.width > 0 &&
    box.y + box.height > 0;
  expect(isOn, `${what} lies on its page: ${JSON.stringify(box)}`).toBe(true);
}

function textOf(runs: readonly TextRun[]): string {
  return runs
    .map(({ text }) => text)
    .join("")
    .trim();
}

function checkPageNumber(source: PageSource, page: number, what: string): void {
  const isPage = Number.isInteger(page) && page >= 1 && page <= source.pageCount;
  expect(isPage, `${what}: ${page} of ${source.pageCount}`).toBe(true);
}

function checkTarget(source: PageSource, to: LinkTarget): void {
  if ("page" in to) checkPageNumber(source, to.page, "the page of a link");
  else expect(new URL(to.href).protocol, "a link").toMatch(/^(https?|mailto):$/);
}

function checkOutline(source: PageSource, entries: readonly OutlineEntry[]): void {
  for (const entry of entries) {
    expect(entry.title, "a line of outline()").toBe(cleanText(entry.title));
    if (entry.page !== null) checkPageNumber(source, entry.page, "the page of a line");
    expect(Number.isFinite(entry.top ?? 0), "how far down its page a line leads").toBe(true);
    checkOutline(source, entry.children);
  }
}

/** Everything that takes a signal rejects with its reason. */
async function checkAborts(source: PageSource): Promise<void> {
  const reason = new Error("turned on");
  const aborted = AbortSignal.abort(reason);
  await expect(source.draw(0, width, aborted), "draw(), aborted before").rejects.toBe(reason);
  const later = new AbortController();
  const drawing = source.draw(0, width, later.signal);
  later.abort(reason);
  await expect(drawing, "draw(), aborted while it draws").rejects.toBe(reason);
}

async function checkMissingPages(source: PageSource): Promise<void> {
  for (const index of [-1, source.pageCount]) {
    await expect(source.draw(index, width, never), `draw(${index})`).rejects.toBeInstanceOf(
      BookError,
    );
  }
}

/** Makes the changes that are due, and checks that every page has a place after them. */
function checkChanges(source: PageSource): void {
  source.watchPages?.((change) => {
    const before = source.pageCount;
    const moved = change();
    expect(source.pageCount, "pageCount after a change").toBeGreaterThan(0);
    const found = new Set<number>();
    for (let index = 0; index < before; index++) {
      const now = moved(index);
      if (now !== null) {
        checkPageNumber(source, now + 1, "where a page lies");
        expect(found.has(now), "two pages lie in one place").toBe(false);
        found.add(now);
      }
      if (moved.placeOf) checkPageNumber(source, moved.placeOf(index) + 1, "where its place is");
    }
  });
}

function closePicture(picture: PagePicture): void {
  if ("close" in picture) picture.close();
}
