/** The shelf that `turnleaf read` serves: draws each book's cover when it comes in sight. */

import "./publish/site.css";
import { openSource, type PageSource } from "turnleaf";

/** Milliseconds after which a cover is given up: others wait for it. */
const patience = 30_000;

/** Entries in sight whose covers are not drawn, the first of which is being drawn. */
const waiting: HTMLElement[] = [];

const observer = new IntersectionObserver(
  (entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting || !(target instanceof HTMLElement)) continue;
      observer.unobserve(target);
      if (waiting.push(target) === 1) void drawWaiting();
    }
  },
  { rootMargin: "300px" },
);

for (const entry of document.querySelectorAll("[data-src]")) observer.observe(entry);

/** One book at a time, so that as much memory is used as for one. */
async function drawWaiting(): Promise<void> {
  for (let [entry] = waiting; entry; [entry] = waiting) {
    const place = entry.querySelector(".facts");
    await drawCover(entry).catch((error: unknown) => {
      if (place && error instanceof Error) place.textContent = error.message;
    });
    waiting.shift();
  }
}

async function drawCover(entry: HTMLElement): Promise<void> {
  const signal = AbortSignal.timeout(patience);
  const source = await openSource(entry.dataset.src ?? "", { signal });
  try {
    nameBook(entry, source);
    const blank = entry.querySelector<HTMLElement>(".blank");
    if (!blank) return;
    const room = blank.parentElement?.clientWidth ?? 0;
    const picture = await source.draw(0, room * devicePixelRatio, signal);
    const cover = document.createElement("canvas");
    cover.className = "drawn";
    cover.width = picture.width;
    cover.height = picture.height;
    cover.getContext("2d")?.drawImage(picture, 0, 0);
    if ("close" in picture) picture.close();
    blank.replaceWith(cover);
  } finally {
    source.close();
  }
}

/** Shows what only the opened book tells. */
function nameBook(entry: HTMLElement, source: PageSource): void {
  const { title, language, pageCount } = source;
  const name = entry.querySelector<HTMLElement>(".title");
  if (name) {
    name.textContent = title;
    name.lang = language;
    name.dir = "auto";
  }
  // Flowing text has as many pages as its reader's settings make of it.
  const pages = source.typeset ? "" : `${pageCount} ${pageCount === 1 ? "page" : "pages"}`;
  const facts = [languageName(language), pages].filter(Boolean);
  const place = entry.querySelector(".facts");
  if (place) place.textContent = facts.join(" · ");
}

function languageName(tag: string): string {
  try {
    return (tag && new Intl.DisplayNames(["en"], { type: "language" }).of(tag)) || "";
  } catch {
    return "";
  }
}
