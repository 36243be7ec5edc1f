import type { StyleMentions } from "./style_mentions.ts";

/** Languages that are written from right to left. */
const rightToLeft = /^(ar|arc|ckb|dv|fa|he|ks|ps|sd|syr|ug|ur|yi)\b(?!-(Latn|Cyrl))/;

/** Returns whether a language (BCP 47) is written from right to left: a book that says no more goes so. */
export function isRightToLeft(language: string): boolean {
  return rightToLeft.test(language);
}

/** Characters of a text by which its direction is found. */
const sampleLength = 200_000;

/** Letters that are written from right to left, and others. */
const leftward =
  /[\p{Script=Arabic}\p{Script=Hebrew}\p{Script=Syriac}\p{Script=Thaana}\p{Script=Nko}\p{Script=Adlam}]/gu;
const letter = /\p{Letter}/gu;

/** Returns whether most letters of a text are written from right to left. */
export function mostlyRightToLeft(text: string): boolean {
  const sample = text.slice(0, sampleLength);
  const count = (letters: RegExp): number => sample.match(letters)?.length ?? 0;
  const back = count(leftward);
  return back > 0 && back > count(letter) / 2;
}

/** How text is written: values of CSS. */
export interface Writing {
  readonly writingMode: string;
  readonly direction: string;
  /** Whether some of the text is written otherwise. */
  readonly isMixed: boolean;
}

/** Lines that go up a page fill no pages from the first on: they go down. */
const paged: Readonly<Record<string, string>> = { "sideways-lr": "vertical-lr" };

/**
 * Returns how most of the text in a section is written. Some books say so of their root, others of a box
 * in it, or of each.
 *
 * @param body the section's body, laid out
 * @param mentions of the section's own style
 */
export function writingOf(body: Element, view: Window, mentions: StyleMentions): Writing {
  const own = view.getComputedStyle(body);
  const isNamed = body.closest("[dir]") ?? body.querySelector("[dir], bdi, bdo");
  if (!isNamed && !mentions.has(["writing-mode", "direction"])) return writingIn(own, false);
  const ways = new Map<string, { readonly writing: CSSStyleDeclaration; letters: number }>();
  const walker = body.ownerDocument.createTreeWalker(body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node !== null; node = walker.nextNode()) {
    const letters = node.nodeValue?.trim().length ?? 0;
    if (letters === 0 || node.parentElement === null) continue;
    const writing = view.getComputedStyle(node.parentElement);
    const { writingMode, direction } = writing;
    const way = ways.get(`${writingMode} ${direction}`);
    if (way) way.letters += letters;
    else ways.set(`${writingMode} ${direction}`, { writing, letters });
  }
  const [most] = [...ways.values()].sort((a, b) => b.letters - a.letters);
  return writingIn(most?.writing ?? own, ways.size > 1);
}

function writingIn({ writingMode, direction }: CSSStyleDeclaration, isMixed: boolean): Writing {
  return { writingMode: paged[writingMode] ?? writingMode, direction, isMixed };
}
