/** What cannot be shown of a book, as the element and its controls list it. */

import { afterEach, expect, test } from "vitest";
import { book, happens, scan, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { tinyEpub } from "../sources/epub/tiny_epub.ts";
import type { WarningDetail } from "./events.ts";

afterEach(() => document.body.replaceChildren());

const lacking = (): Uint8Array<ArrayBuffer> =>
  tinyEpub({
    chapters: ['<p>one</p><img src="gone.png" alt=""/>', "<p>two</p>"],
    toc: '<li><a href="c2.xhtml">Two</a></li><li><a href="none.xhtml">Gone</a></li>',
  });

test("an event lists what is missing in the element's language, and the controls show it", async () => {
  const element = book(lacking(), { lang: "de", controls: "" });
  const heard: (readonly WarningDetail[])[] = [];
  element.addEventListener("warnings", ({ detail }) => heard.push(detail.warnings));
  await happens(element, "load");
  await eventually(() => element.warnings.length).toBe(2);
  expect(element.warnings).toEqual([
    {
      code: "image",
      message: "OEBPS/gone.png, ein Bild, fehlt oder kann nicht gezeigt werden.",
      source: "OEBPS/gone.png",
      page: 1,
    },
    {
      code: "contents",
      message:
        "“Gone”, eine Zeile des Inhaltsverzeichnisses, führt zu keiner Stelle in diesem Buch.",
      source: "“Gone”",
    },
  ]);
  expect(heard.at(-1)).toEqual(element.warnings);
  const root = element.shadowRoot as ShadowRoot;
  await eventually(() => root.querySelectorAll("[part~=toolbar] button").length).toBeGreaterThan(0);
  root.querySelector<HTMLButtonElement>('[aria-label="Inhalt"]')?.click();
  const list = () => root.querySelector(".warnings");
  await eventually(() => list()?.querySelector("summary")?.textContent).toBe(
    "2 Sachen aus diesem Buch werden nicht gezeigt",
  );
  expect(list()?.hasAttribute("open")).toBe(false);
  expect(list()?.querySelector("li")?.textContent).toMatch(/fehlt.* Seite 1$/);
  const silent = happens<{ pageCount: number }>(element, "load");
  element.pages = [{ src: scan(1) }];
  await silent;
  expect(element.warnings).toEqual([]);
  await eventually(list).toBe(null);
});

test("a page that could not be drawn is listed with its number and why, until it is", async () => {
  const element = book([{ src: scan(1) }, { src: "data:image/png;base64,AAAA" }, { src: scan(3) }]);
  await happens(element, "load");
  await settled(element);
  await expect(element.drawPage(2, 20)).rejects.toThrow();
  const [warning] = element.warnings;
  expect(warning).toMatchObject({ code: "page", page: 2 });
  expect(warning?.message).toMatch(/^Page 2 of .* is damaged or no image/);
  expect(element.warnings.length).toBe(1);
  await element.insertPages(1, [{ src: scan(9) }]);
  expect(element.warnings[0]?.page).toBe(3);
  await element.removePages(3);
  expect(element.warnings).toEqual([]);
});
