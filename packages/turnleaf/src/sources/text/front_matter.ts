/** What stands before a Markdown text about it, in YAML between `---` or in TOML between `+++`. */

import { cleanLanguage, cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";

/** What a text says of itself; "" for what it does not. */
export interface FrontMatter {
  readonly title: string;
  /** BCP 47. */
  readonly language: string;
  readonly authors: readonly string[];
  /** The text without it. */
  readonly rest: string;
}

/** Characters of it that are read. */
const longest = 100_000;

/** The marks about it, and what its lines look like, apart from those that are indented or blank. */
const kinds = [
  {
    start: /^---[ \t]*\n(?=\S)/,
    end: /^(?:---|\.\.\.)[ \t]*(?:\n|$)/m,
    line: /^(?:[\w"'$][^\n:]{0,200}:(?:\s|$)|[-#[\]{},])/,
  },
  {
    start: /^\+\+\+[ \t]*\n/,
    end: /^\+\+\+[ \t]*(?:\n|$)/m,
    line: /^(?:[\w"'][\w"'. -]{0,200}=|[-#[\]{},"'])/,
  },
];

/** Reads what a text says of itself before it begins: nothing if its first lines are between two rules. */
export function readFrontMatter(text: string): FrontMatter {
  for (const { start, end, line } of kinds) {
    const [mark] = start.exec(text) ?? [];
    if (mark === undefined) continue;
    const head = text.slice(mark.length, mark.length + longest);
    const last = end.exec(head);
    if (!last) continue;
    const lines = head.slice(0, last.index).split("\n");
    const outer = lines.filter((one) => /^\S/.test(one));
    if (!outer.every((one) => line.test(one))) continue;
    return { ...fieldsOf(lines), rest: text.slice(mark.length + last.index + last[0].length) };
  }
  return { title: "", language: "", authors: [], rest: text };
}

function fieldsOf(lines: readonly string[]): Omit<FrontMatter, "rest"> {
  const fields = new Map<string, string[]>();
  let current: string[] = [];
  for (const line of lines) {
    const [, name, value = ""] = /^["']?([\w-]{1,40})["']?[ \t]*[:=](.*)$/s.exec(line) ?? [];
    if (name === undefined) current.push(line.trim());
    else {
      current = [value.trim()];
      const key = name.toLowerCase();
      if (!fields.has(key)) fields.set(key, current);
    }
  }
  const valuesOf = (...names: readonly string[]): string[] =>
    names.flatMap((name) => valuesIn(fields.get(name) ?? []));
  return {
    title: valuesOf("title")[0] ?? "",
    language: cleanLanguage(valuesOf("lang", "language", "locale")[0]),
    authors: valuesOf("author", "authors", "creator").slice(0, limits.authors),
  };
}

/** Returns the texts that a field has: one, those of a list on its line, or those on the lines after it. */
function valuesIn([first = "", ...more]: readonly string[]): string[] {
  const inner = /^\[(.*)\]$/s.exec([first, ...more].join(" ").trim())?.[1];
  if (inner !== undefined) {
    const items = inner.match(/"(?:[^"\\]|\\.)*"|'[^']*'|[^,]+/g) ?? [];
    return items.map(unquoted).filter((one) => one !== "");
  }
  const isBlock = /^[|>][-+\d]*$/.test(first);
  const rest = more.filter((line) => line !== "" && !line.startsWith("#"));
  if (first !== "" || rest.length === 0) {
    const words = unquoted([isBlock ? "" : first, ...rest].join(" ").trim());
    return words === "" ? [] : [words];
  }
  // An item is a text, or has a name beside other things that are said of it.
  const items = rest.filter((line) => /^-\s/.test(line) || /^name\s*:/.test(line));
  return items.flatMap((line) => {
    const item = line.replace(/^-\s+/, "");
    const named = /^name\s*:(.*)$/s.exec(item)?.[1];
    if (named === undefined && /^[\w-]+\s*:\s/.test(item)) return [];
    const words = unquoted((named ?? item).trim());
    return words === "" ? [] : [words];
  });
}

/** Returns a text without the quotes about it, or what is said behind it. */
function unquoted(text: string): string {
  const trimmed = text.trim();
  const quoted = /^"((?:[^"\\]|\\.)*)"/.exec(trimmed)?.[1];
  if (quoted !== undefined) return cleanText(quoted.replace(/\\(["\\])/g, "$1"));
  const single = /^'((?:[^']|'')*)'/.exec(trimmed)?.[1];
  if (single !== undefined) return cleanText(single.replaceAll("''", "'"));
  return cleanText(trimmed.replace(/\s#.*$/s, ""), limits.titleLength);
}
