/** GitHub's Markdown, read in bounded time and depth. */

import { Lexer, marked, type Parser, Renderer, type Token, Tokenizer, type Tokens } from "marked";
import { limits } from "../limits.ts";
import { Footnotes, footnoteSyntax } from "./footnotes.ts";
import { withoutWideEnds } from "./plain_text.ts";

/** Lists and quotations within each other, as many as a page is wide; deeper ones are shown as their text. */
const deepest = 8;

/** Characters of a paragraph whose marks are read: pairing them takes quadratic time. */
const longestMarked = 50_000;

/** Returns Markdown as tokens. Throws a `RangeError` if its marks are nested too deeply. */
export function readMarkdown(text: string): Token[] {
  const tokenizer = new BoundedTokenizer();
  const extensions = { ...footnoteSyntax, renderers: {}, childTokens: {} };
  return new BoundedLexer({ ...marked.defaults, gfm: true, tokenizer, extensions }).lex(text);
}

/**
 * Returns tokens as HTML.
 *
 * @param ids of headings, by their tokens, of letters, digits, and the signs -_.: ; others get none
 *
 * @param notes to which they may refer, numbered
 */
export function htmlOf(
  tokens: Token[],
  ids: ReadonlyMap<Token, string> = new Map(),
  notes: Footnotes = new Footnotes(),
): string {
  const renderer = new Renderer();
  renderer.heading = function (heading: Tokens.Heading): string {
    const { depth, tokens } = heading;
    const id = ids.get(heading);
    const own = id === undefined ? "" : ` id="${id}"`;
    return `<h${depth}${own}>${this.parser.parseInline(tokens)}</h${depth}>\n`;
  };
  renderer.text = function (text: Tokens.Text | Tokens.Escape): string {
    return withoutWideEnds(Renderer.prototype.text.call(this, text));
  };
  const renderers = {
    footnoteRef: ({ label }: Tokens.Generic) => notes.markOf(String(label)),
    // One that stands within another block stays there.
    footnote(this: { readonly parser: Parser }, { tokens: inner = [] }: Tokens.Generic) {
      return this.parser.parse(inner);
    },
  };
  const extensions = { renderers: renderers as never, childTokens: {} };
  return marked.parser(tokens, { ...marked.defaults, renderer, extensions });
}

class BoundedTokenizer extends Tokenizer {
  /** Reads a table: each of its rows has as many cells as its head, so that one of too many is text. */
  override table(text: string): Tokens.Table | undefined {
    const [head = "", line = ""] = text.split("\n", 2);
    if (!head.includes("|") || !/^[ \t|:-]+$/.test(line)) return undefined;
    const [rows = ""] = text.split("\n\n", 1);
    const cells = head.split("|").length * rows.split("\n").length;
    return cells > limits.elements ? undefined : super.table(text);
  }
}

class BoundedLexer extends Lexer {
  #depth = 0;

  override blockTokens(
    text: string,
    tokens: Token[] = [],
    lastParagraphClipped?: boolean,
  ): Tokens.Generic[] & { links: Record<string, never> } {
    this.#depth += 1;
    try {
      if (this.#depth > deepest) tokens.push(asText(text));
      else super.blockTokens(text, tokens, lastParagraphClipped);
      return tokens as never;
    } finally {
      this.#depth -= 1;
    }
  }

  override inline(text: string, tokens: Token[] = []): Token[] {
    if (text.length <= longestMarked) return super.inline(text, tokens);
    tokens.push(asText(text));
    return tokens;
  }
}

function asText(text: string): Tokens.Text {
  return { type: "text", raw: text, text, escaped: false };
}
