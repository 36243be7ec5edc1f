/** The element reading an EPUB aloud, by its method and by the button of its controls. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { book, happens } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { prose, tinyEpub } from "../sources/epub/tiny_epub.ts";

/** A recording that is heard until it is stopped. */
class EndlessAudio extends EventTarget {
  src = "";
  currentTime = 0;
  duration = 100;
  playbackRate = 1;
  paused = true;
  async play(): Promise<void> {
    this.paused = false;
  }
  pause(): void {
    this.paused = true;
  }
  load(): void {}
  removeAttribute(): void {}
}

const overlaid = (): Uint8Array<ArrayBuffer> =>
  tinyEpub({
    chapters: [prose(1)],
    items:
      '<item id="o" href="o.smil" media-type="application/smil+xml"/><item id="v" href="v.mp3" media-type="audio/mpeg"/><item id="m" href="m.xhtml" media-type="application/xhtml+xml" media-overlay="o"/>',
    itemrefs: '<itemref idref="m"/>',
    raw: {
      "OEBPS/o.smil":
        '<smil xmlns="http://www.w3.org/ns/SMIL"><body><par><text src="m.xhtml#a"/><audio src="v.mp3"/></par></body></smil>',
      "OEBPS/v.mp3": "sound",
      "OEBPS/m.xhtml":
        '<html xmlns="http://www.w3.org/1999/xhtml"><body><p id="a">Aloud</p></body></html>',
    },
  });

beforeEach(() => vi.stubGlobal("Audio", EndlessAudio));
afterEach(() => {
  document.body.replaceChildren();
  vi.unstubAllGlobals();
});

test("an EPUB with overlays is read aloud from the open page on, until it is stopped or closed", async () => {
  const element = book(overlaid(), { duration: "0", layout: "single" });
  expect([element.canReadAloud, element.readingAloud]).toEqual([false, false]);
  await happens(element, "load");
  expect(element.canReadAloud).toBe(true);
  for (const stop of [() => element.stopReadingAloud(), () => element.remove()]) {
    await element.goTo(1);
    const started = happens(element, "readaloudchange");
    const over = element.readAloud();
    expect(await started).toEqual({ reading: true });
    // What has a recording is the last page.
    await eventually(() => element.page).toBe(element.pageCount);
    expect(element.readingAloud).toBe(true);
    const stopped = happens(element, "readaloudchange");
    stop();
    expect(await stopped).toEqual({ reading: false });
    await over;
    expect(element.readingAloud).toBe(false);
  }
});

test("the controls have a button for it, which other books do not show", async () => {
  const buttonOf = (element: HTMLElement): HTMLElement | null | undefined =>
    element.shadowRoot?.querySelector('[part~="toolbar"] [aria-label$="ead aloud"]');
  const other = book(tinyEpub({ chapters: [prose(1)] }), { controls: "" });
  await happens(other, "load");
  await eventually(() => buttonOf(other)?.hidden).toBe(true);
  other.remove();
  const element = book(overlaid(), { controls: "", duration: "0" });
  await happens(element, "load");
  await eventually(() => buttonOf(element)?.hidden).toBe(false);
  buttonOf(element)?.click();
  await eventually(() => element.readingAloud).toBe(true);
  const stop = element.shadowRoot?.querySelector<HTMLElement>('[aria-label="Stop reading aloud"]');
  stop?.click();
  await eventually(() => element.readingAloud).toBe(false);
});
