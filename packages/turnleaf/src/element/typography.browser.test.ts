import { expect, test } from "vitest";
import { book, happens } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { prose, tinyEpub } from "../sources/epub/tiny_epub.ts";

const words = async (element: ReturnType<typeof book>): Promise<string> =>
  ((await element.search("word15x0"))[0]?.page ?? 0).toString();

test("an EPUB is set as the attributes say, and keeps the reader's place when they change", async () => {
  const element = book(tinyEpub({ chapters: [prose(30)] }), { controls: "", duration: "0" });
  await happens(element, "load");
  await eventually(() => element.canTypeset).toBe(true);
  const before = element.pageCount;
  await element.goTo(Number(await words(element)));
  const changed = happens(element, "pageschange");
  element.fontSize = 1.6;
  await changed;
  expect(element.pageCount).toBeGreaterThan(before);
  const page = Number(await words(element));
  expect(Math.abs(page - element.page)).toBeLessThanOrEqual(1);
  expect([element.getAttribute("font-size"), element.font, element.lineHeight]).toEqual([
    "1.6",
    "",
    0,
  ]);
  element.remove();
});

test("the reader chooses in a tab, which other books do not have", async () => {
  const element = book(tinyEpub({ chapters: [prose(4)] }), { controls: "", duration: "0" });
  await happens(element, "load");
  const root = element.shadowRoot as ShadowRoot;
  const tab = (): HTMLButtonElement | null => root.querySelector('.bar [aria-label="Type"]');
  await eventually(() => tab()?.hidden).toBe(false);
  tab()?.click();
  const choices = [...root.querySelectorAll<HTMLSelectElement>(".choice select")];
  expect(choices.map(({ labels }) => labels[0]?.firstChild?.textContent)).toEqual([
    "Size",
    "Typeface",
    "Line spacing",
    "Margins",
    "Paper",
  ]);
  const changed = happens(element, "pageschange");
  for (const [k, value] of ["2", "serif", "1.6", "0.5"].entries()) {
    const choice = choices[k] as HTMLSelectElement;
    choice.value = value;
    choice.dispatchEvent(new Event("change"));
  }
  await changed;
  expect([element.fontSize, element.font, element.lineHeight, element.margins]).toEqual([
    2,
    "serif",
    1.6,
    0.5,
  ]);
  const canvas = document.createElement("canvas");
  const loaded = happens(element, "load");
  element.pages = [canvas.toDataURL()];
  await loaded;
  await eventually(() => tab()?.hidden).toBe(true);
  element.remove();
});

test("a remembered book opens with the reader's type, at the text where he was", async () => {
  const chapters = [prose(20), prose(30), prose(20)];
  const open = async (): Promise<ReturnType<typeof book>> => {
    const element = book(tinyEpub({ chapters }), { duration: "0", remember: "", layout: "single" });
    await Promise.all([happens(element, "load"), happens(element, "pageschange")]);
    return element;
  };
  const placesOf = async (element: ReturnType<typeof book>): Promise<number[]> =>
    (await element.search("word15x0")).map(({ page }) => page);
  localStorage.clear();
  const first = await open();
  const changed = happens(first, "pageschange");
  first.fontSize = 1.6;
  await changed;
  await eventually(async () => (await placesOf(first)).length).toBe(3);
  const [, there = 0, later = 0] = await placesOf(first);
  await first.goTo(there);
  first.toggleBookmark(later);
  const { pageCount } = first;
  first.remove();
  const second = await open();
  expect([second.fontSize, second.page]).toEqual([1.6, there]);
  await eventually(() => second.pageCount).toBe(pageCount);
  expect(second.page).toBe(there);
  expect(second.bookmarks).toEqual([later]);
  second.remove();
  localStorage.clear();
});
