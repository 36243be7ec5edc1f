/** Text spoken by the browser's own voices, where a book has text to be read aloud and no recording. */

import { BookError } from "../sources/page_source.ts";

/** Longest text that is spoken at once, characters: some voices stop after a quarter of a minute. */
const longest = 200;

/**
 * Speaks a text. Resolves when it has been heard, or `signal` aborts; rejects
 * with a `BookError` if the browser cannot speak.
 *
 * @param language BCP 47 tag; "" for the browser's own
 * @param heard called with the fraction of the text that has been heard
 */
export async function speak(
  text: string,
  language: string,
  signal: AbortSignal,
  heard: (fraction: number) => void,
): Promise<void> {
  const { speechSynthesis } = globalThis;
  if (speechSynthesis === undefined) throw new BookError(mute, { code: "silent" });
  let before = 0;
  for (const part of partsOf(text, language)) {
    if (signal.aborted) return;
    heard(before / text.length);
    const utterance = new SpeechSynthesisUtterance(part);
    if (language !== "") utterance.lang = language;
    await new Promise<void>((resolve, reject) => {
      const stop = (): void => {
        speechSynthesis.cancel();
        resolve();
      };
      signal.addEventListener("abort", stop, { once: true });
      utterance.onend = () => {
        signal.removeEventListener("abort", stop);
        resolve();
      };
      utterance.onerror = ({ error }) => {
        signal.removeEventListener("abort", stop);
        if (signal.aborted) resolve();
        else reject(new BookError(mute, { code: "silent", cause: new Error(error) }));
      };
      speechSynthesis.speak(utterance);
    });
    before += part.length;
  }
}

const mute = "This browser cannot speak the text; install a voice for its language.";

/** Splits a text where its sentences end, and long ones between words. */
function partsOf(text: string, language: string): string[] {
  const segments = new Intl.Segmenter(language || undefined, { granularity: "sentence" });
  return [...segments.segment(text)].flatMap(({ segment }) => {
    const parts: string[] = [];
    let rest = segment;
    while (rest.length > longest) {
      const space = rest.lastIndexOf(" ", longest);
      const cut = space > 0 ? space + 1 : longest;
      parts.push(rest.slice(0, cut));
      rest = rest.slice(cut);
    }
    return [...parts, rest];
  });
}
