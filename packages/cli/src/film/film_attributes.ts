/** How the filmed book is bound: attributes of `<turnleaf-book>` that `--attribute` sets. */

import { printable, UsageProblem } from "../problem.ts";

/** The attributes that may be set, each with its words; null for a value of any form. */
const attributes: Readonly<Record<string, readonly string[] | null>> = {
  binding: ["auto", "left", "right", "top", "bottom"],
  layout: ["auto", "spread", "single"],
  cover: ["auto", "hard", "soft", "none"],
  offset: ["0", "1"],
  cloth: null,
  shadows: null,
  "hard-pages": null,
  stocks: null,
  tearable: ["sewn", "stapled", "perforated"],
};

/**
 * Parses attributes such as "binding=top". Of two of one name the last is set.
 *
 * @throws UsageProblem
 */
export function parseAttributes(texts: readonly string[]): Readonly<Record<string, string>> {
  return Object.fromEntries(texts.map(parseAttribute));
}

function parseAttribute(text: string): [name: string, value: string] {
  const [, name = "", value = ""] = /^([a-z-]+)=(.{1,1000})$/s.exec(text.trim()) ?? [];
  if (!Object.hasOwn(attributes, name)) {
    throw new UsageProblem(
      `"${printable(text)}" is no --attribute; it is NAME=VALUE, with a name of ${listed(Object.keys(attributes))}.`,
    );
  }
  const words = attributes[name];
  if (words && !words.includes(value)) {
    throw new UsageProblem(
      `"${printable(value)}" in --attribute ${name} was not understood; it is ${listed(words)}.`,
    );
  }
  return [name, value];
}

function listed(words: readonly string[]): string {
  return `${words.slice(0, -1).join(", ")} or ${words.at(-1)}`;
}
