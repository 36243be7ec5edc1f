/** Footnotes of Markdown, as GitHub writes them: `[^1]` in the text, and `[^1]: …` anywhere in the file. */

import type { Lexer, MarkedOptions, Token, TokenizerThis, Tokens } from "marked";

/** A note as it is defined. */
interface Definition extends Tokens.Generic {
  readonly type: "footnote";
  readonly label: string;
  readonly tokens: Token[];
}

/** A definition, with the lines that are indented under it, or go on with its paragraph. */
const definition =
  /^ {0,3}\[\^([^\]\s]{1,100})\]:[ \t]*([^\n]*(?:\n(?![ \t]*\n| {0,3}\[\^[^\]\s]{1,100}\]:)[^\n]+|\n(?:[ \t]*\n)+(?: {2,}|\t)[^\n]+)*)(?:\n+|$)/;

const reference = /^\[\^([^\]\s]{1,100})\](?!:)/;

/** How `marked` reads footnotes: the definitions as blocks, what leads to them in their lines. */
export const footnoteSyntax: Pick<
  NonNullable<MarkedOptions["extensions"]>,
  "block" | "startBlock" | "inline" | "startInline"
> = {
  block: [
    function (this: TokenizerThis, text: string): Definition | undefined {
      const [raw, label, lines] = definition.exec(text) ?? [];
      if (raw === undefined || label === undefined || lines === undefined) return undefined;
      const tokens: Token[] = [];
      this.lexer.blockTokens(lines.replace(/\n(?: {1,4}|\t)/g, "\n"), tokens);
      labelsOf(this.lexer).add(label);
      return { type: "footnote", raw, label, tokens };
    },
  ],
  // A paragraph ends at a definition; beyond its own end nothing is looked for.
  startBlock: [
    (text: string) => indexOf(text.split("\n\n", 1)[0] ?? "", /\n {0,3}\[\^[^\]\s]{1,100}\]:/),
  ],
  inline: [
    function (this: TokenizerThis, text: string): Tokens.Generic | undefined {
      const [raw, label = ""] = reference.exec(text) ?? [];
      // All definitions are read before the lines of any block.
      const isDefined = raw !== undefined && labelsOf(this.lexer).has(label);
      return isDefined ? { type: "footnoteRef", raw, label } : undefined;
    },
  ],
  startInline: [(text: string) => indexOf(text, /\[\^/)],
};

/** Returns where the text before a match ends; undefined without one. */
function indexOf(text: string, mark: RegExp): number | undefined {
  const index = text.search(mark);
  return index < 0 ? undefined : index;
}

const labels = new WeakMap<Lexer, Set<string>>();

/** The labels of the notes that are defined in a text. */
function labelsOf(lexer: Lexer): Set<string> {
  const known = labels.get(lexer) ?? new Set();
  labels.set(lexer, known);
  return known;
}

/** The footnotes of one text: each is numbered where it is first referred to, and stands at that chapter's end. */
export class Footnotes {
  readonly #definitions = new Map<string, Definition>();
  readonly #numbers = new Map<string, number>();

  /** Takes the definitions out of the blocks of a text, and returns the others. */
  take(tokens: readonly Token[]): Token[] {
    return tokens.filter((token) => {
      if (token.type !== "footnote") return true;
      const note = token as Definition;
      if (!this.#definitions.has(note.label)) this.#definitions.set(note.label, note);
      return false;
    });
  }

  /**
   * Returns the notes that a chapter is the first to refer to, as they are numbered; of the last chapter
   * also those to which nothing does.
   */
  of(tokens: readonly Token[], isLast: boolean): readonly Footnote[] {
    const found: Footnote[] = [];
    const add = (label: string): void => {
      const note = this.#definitions.get(label);
      if (!note || this.#numbers.has(label)) return;
      const number = this.#numbers.size + 1;
      this.#numbers.set(label, number);
      found.push({ number, tokens: note.tokens });
    };
    for (const label of referencesIn(tokens)) add(label);
    // Notes may refer to others, which come after them.
    for (const note of found) for (const label of referencesIn(note.tokens)) add(label);
    if (isLast) for (const label of this.#definitions.keys()) add(label);
    return found;
  }

  /** Returns the markup of a reference. */
  markOf(label: string): string {
    const number = this.#numbers.get(label) ?? 0;
    return `<sup><a id="${backOf(number)}" href="#${idOf(number)}" role="doc-noteref">${number}</a></sup>`;
  }
}

/** A note with its number, from 1. */
export interface Footnote {
  readonly number: number;
  readonly tokens: Token[];
}

/** Returns the ids of a note and of the first mark that leads to it. */
export function idsOf({ number }: Footnote): readonly string[] {
  return [idOf(number), backOf(number)];
}

const idOf = (number: number): string => `turnleaf-note-${number}`;
const backOf = (number: number): string => `turnleaf-noteref-${number}`;

/** Returns notes as a list. */
export function listOf(notes: readonly Footnote[], html: (tokens: Token[]) => string): string {
  if (notes.length === 0) return "";
  const items = notes.map(({ number, tokens }) => {
    const back = `<a href="#${backOf(number)}" role="doc-backlink">↩</a>`;
    // The link back stands in the last line of the note.
    const text = html(tokens).trim();
    const whole = /<\/p>$/.test(text) ? text.replace(/<\/p>$/, ` ${back}</p>`) : text + back;
    return `<li id="${idOf(number)}" value="${number}" role="doc-footnote">${whole}</li>`;
  });
  return `<hr/><ol class="notes">${items.join("")}</ol>`;
}

/** Returns the labels to which tokens refer, in their order. */
function* referencesIn(tokens: readonly Token[]): Generator<string> {
  for (const token of tokens) {
    const { type, label, tokens: inner, items, header, rows } = token as Tokens.Generic;
    if (type === "footnoteRef") yield label;
    for (const within of [inner, items, header, ...(rows ?? [])]) {
      if (Array.isArray(within)) yield* referencesIn(within);
    }
  }
}
