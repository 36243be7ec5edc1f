/**
 * Forms of letters that a style asks for and the browser does not know (`text-transform: full-width` and
 * `full-size-kana`): the letters are replaced by those of these forms, one by one, as the text is laid out.
 * What the book wrote is kept, and is what is read, copied and found.
 */

import { letterFormsMark, letterFormsProperty } from "../markup/prefixed_css.ts";
import type { StyleMentions } from "./style_mentions.ts";

/** What a book wrote in a text whose letters were replaced. Each has as many characters as the text. */
const written = new WeakMap<Node, string>();

/** Returns consecutive letters with as many consecutive forms. */
function rangeOf(first: number, last: number, form: number): [string, string][] {
  return Array.from({ length: last - first + 1 }, (_, k) => [
    String.fromCharCode(first + k),
    String.fromCharCode(form + k),
  ]);
}

/** Returns letters, in turn with their forms. */
function pairsOf(pairs: string): [string, string][] {
  return Array.from(pairs.matchAll(/(.)(.)/gsu), ([, letter = "", form = ""]) => [letter, form]);
}

/** The full-width forms of narrow letters: the inverse of Unicode's `<wide>`, and its `<narrow>`. */
const fullWidth: ReadonlyMap<string, string> = new Map([
  ...rangeOf(0x21, 0x7e, 0xff01),
  ...pairsOf("¢￠£￡¬￢¯￣¦￤¥￥₩￦⦅｟⦆｠￨│￩←￪↑￫→￬↓￭■￮○"),
  // Kana and their marks, which join the letter before them.
  ...rangeOf(0xff61, 0xff9f, 0).map(([letter]): [string, string] => [
    letter,
    letter.normalize("NFKC"),
  ]),
  // Hangul, of which that would make letters to be joined.
  ...rangeOf(0xffa0, 0xffa0, 0x3164),
  ...rangeOf(0xffa1, 0xffbe, 0x3131),
  ...rangeOf(0xffc2, 0xffc7, 0x314f),
  ...rangeOf(0xffca, 0xffcf, 0x3155),
  ...rangeOf(0xffd2, 0xffd7, 0x315b),
  ...rangeOf(0xffda, 0xffdc, 0x3161),
]);

/** The space of full width: blanks that collapse do so before letters are replaced, and stay as they are. */
const wideSpace = "\u3000";

/** Small kana in full size, by the list of CSS Text; those of two characters apart. */
const fullSizeKana: ReadonlyMap<string, string> = new Map([
  // Most stand before their large form.
  ...Array.from("ぁぃぅぇぉっゃゅょゎァィゥェォッャュョヮ", (small): [string, string] => [
    small,
    String.fromCharCode(small.charCodeAt(0) + 1),
  ]),
  ...pairsOf("ゕかゖけヵカヶケㇰクㇱシㇲスㇳトㇴヌㇺムｯﾂ"),
  ...pairsOf("ㇵハㇶヒㇷフㇸヘㇹホㇻラㇼリㇽルㇾレㇿロ"),
  ...rangeOf(0xff67, 0xff6b, 0xff71),
  ...rangeOf(0xff6c, 0xff6e, 0xff94),
]);

/**
 * Replaces the letters of a section whose style asks for forms that the browser does not know.
 *
 * @param body the section's body, with its style sheets
 * @param mentions of the section's own style
 */
export function applyLetterForms(body: Element, mentions: StyleMentions): void {
  if (!mentions.has([letterFormsMark])) return;
  const view = body.ownerDocument.defaultView as Window;
  const texts = body.ownerDocument.createTreeWalker(body, NodeFilter.SHOW_TEXT);
  for (let node = texts.nextNode() as Text | null; node; node = texts.nextNode() as Text | null) {
    const style = view.getComputedStyle(node.parentElement as Element);
    const forms = style.getPropertyValue(letterFormsProperty).split(" ");
    const isWide = forms.includes("full-width");
    const isFullSize = forms.includes("full-size-kana");
    if (!isWide && !isFullSize) continue;
    const keepsBlanks = /^(?:pre|pre-wrap|break-spaces)$/.test(style.whiteSpace);
    const { data } = node;
    const shown = data.replace(/[\s\S]/g, (letter) => {
      if (isWide && keepsBlanks && letter === " ") return wideSpace;
      const wide = isWide ? (fullWidth.get(letter) ?? letter) : letter;
      return isFullSize ? (fullSizeKana.get(wide) ?? wide) : wide;
    });
    if (shown === data) continue;
    written.set(node, data);
    node.data = shown;
  }
}

/** Returns what the book wrote in a text. */
export function writtenIn(text: CharacterData): string {
  return written.get(text) ?? text.data;
}

/** Returns what the book wrote in an element: its `textContent`, but for letters that were replaced. */
export function writtenContent(element: Element): string {
  const texts = element.ownerDocument.createTreeWalker(
    element,
    NodeFilter.SHOW_TEXT | NodeFilter.SHOW_CDATA_SECTION,
  );
  let content = "";
  while (texts.nextNode()) content += writtenIn(texts.currentNode as CharacterData);
  return content;
}
