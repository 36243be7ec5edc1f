import { expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import { clock } from "../for_tests/clock.ts";
import { book, happens } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { tinyEpub } from "../sources/epub/tiny_epub.ts";

/** Returns ten seconds of a tone as a WAV. */
function tone(): Uint8Array {
  const [rate, seconds] = [8000, 10];
  const samples = Int16Array.from({ length: rate * seconds }, (_, k) => 9000 * Math.sin(k / 3));
  const view = new DataView(new ArrayBuffer(44 + samples.byteLength));
  const letters = (at: number, text: string): void =>
    [...text].forEach((letter, k) => {
      view.setUint8(at + k, letter.charCodeAt(0));
    });
  letters(0, "RIFF");
  view.setUint32(4, 36 + samples.byteLength, true);
  letters(8, "WAVEfmt ");
  view.setUint32(16, 16, true);
  view.setUint16(20, 1, true);
  view.setUint16(22, 1, true);
  view.setUint32(24, rate, true);
  view.setUint32(28, 2 * rate, true);
  view.setUint16(32, 2, true);
  view.setUint16(34, 16, true);
  letters(36, "data");
  view.setUint32(40, samples.byteLength, true);
  samples.forEach((sample, k) => {
    view.setInt16(44 + 2 * k, sample, true);
  });
  return new Uint8Array(view.buffer);
}

const chapters = [
  '<p>Listen:</p><audio controls="" title="A tone"><source src="a.xyz"/><source src="tone.wav"/>No sound.</audio><audio src="tone.wav"/>',
  '<audio controls="" src="bad.wav"/>',
  "<p>The end.</p>",
];

test("a sound is played where it stands on the page, once it is pressed, and ends as the page is turned", async () => {
  const element = book(
    tinyEpub({
      chapters,
      raw: { "OEBPS/tone.wav": tone(), "OEBPS/bad.wav": "no sound", "OEBPS/a.xyz": "?" },
      items:
        '<item id="w" href="tone.wav" media-type="audio/wav"/><item id="b" href="bad.wav" media-type="audio/wav"/><item id="x" href="a.xyz" media-type="audio/xyz"/>',
    }),
    { duration: "0", layout: "single" },
  );
  // Once every chapter is set, the buttons are made anew.
  await Promise.all([happens(element, "load"), happens(element, "pageschange")]);
  const root = element.shadowRoot as ShadowRoot;
  const places = (): Element[] => [...root.querySelectorAll(".medium")];
  // Pressed by hand: browsers play nothing that a script alone asks for.
  // On a busy machine its button may be made anew between focus and key: then it is pressed again.
  const press = async (): Promise<void> => {
    const button = places()[0]?.querySelector("button");
    if (!button || button.disabled) return;
    button.focus();
    await userEvent.keyboard("{Enter}");
  };
  await eventually(() => places().length).toBe(1);
  expect(root.querySelector("audio")).toBeNull();
  const [place] = places();
  expect(place?.querySelector("button")?.getAttribute("aria-label")).toBe("A tone");
  const { offsetWidth, offsetHeight } = place as HTMLElement;
  expect(offsetWidth).toBeGreaterThan(5 * offsetHeight);
  const player = (): HTMLAudioElement | null => root.querySelector("audio");
  const played = async (): Promise<number> => {
    await press();
    return player()?.currentTime ?? 0;
  };
  await eventually(played).toBeGreaterThan(0.1);
  const sound = player() as HTMLAudioElement;
  expect([sound.controls, sound.paused, sound.muted]).toEqual([true, false, false]);
  // Other pages far from it change nothing of what is heard.
  await element.insertPages(4, new Blob(["More."], { type: "text/plain" }));
  await clock.pass(200);
  expect([player() === sound, sound.paused]).toEqual([true, false]);
  await element.goTo(2);
  await eventually(() => sound.paused).toBe(true);
  expect(sound.getAttribute("src")).toBeNull();
  // One that is no sound says so in its place.
  await eventually(() => places().length === 1 && !places().includes(place as Element)).toBe(true);
  const pressed = async (): Promise<string | null | undefined> => {
    await press();
    return places()[0]?.textContent;
  };
  await eventually(pressed).toMatch(/^bad\.wav cannot be played;/);
  await element.goTo(3);
  await eventually(() => places().length).toBe(0);
  element.remove();
});
