/** GitHub's Markdown, read in bounded time and depth. */

import { Lexer, marked, type Token, type Tokens } from "marked";

/** Lists and quotations within each other, as many as a page is wide; deeper ones are shown as their text. */
const deepest = 8;

/** Characters of a paragraph whose marks are read: pairing them takes quadratic time. */
const longestMarked = 50_000;

/** Returns Markdown as tokens. Throws a `RangeError` if its marks are nested too deeply. */
export function readMarkdown(text: string): Token[] {
  return new BoundedLexer({ ...marked.defaults, gfm: true }).lex(text);
}

/** Returns tokens as HTML. */
export function htmlOf(tokens: Token[]): string {
  return marked.parser(tokens);
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
