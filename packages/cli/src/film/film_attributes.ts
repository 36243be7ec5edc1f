/** How the filmed book is bound: attributes of `<turnleaf-book>` that `--attribute` sets. */

import { attributeName, attributes } from "../../../turnleaf/src/attributes.ts";
import { printable, UsageProblem } from "../problem.ts";

/** The properties whose attributes may be set. */
const properties = [
  "binding",
  "layout",
  "cover",
  "offset",
  "cloth",
  "shadows",
  "hardPages",
  "stocks",
  "tearable",
] as const;

/** The words of each of these attributes; undefined for a value of any form. */
const wordsOf: ReadonlyMap<string, readonly string[] | undefined> = new Map(
  properties.map((name) => [attributeName(name), attributes[name].words?.map(String)]),
);

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
  if (!wordsOf.has(name)) {
    throw new UsageProblem(
      `"${printable(text)}" is no --attribute; it is NAME=VALUE, with a name of ${listed([...wordsOf.keys()])}.`,
    );
  }
  const words = wordsOf.get(name);
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
