/**
 * Lists of numbers by terms, in files of bounded size: `index.json` has the first
 * term of each file, so a reader of one term fetches two small files however
 * many terms there are. Written here, read by the site's search page.
 */

/** Bytes (as UTF-16 units) of one file, more only if one term's list alone is longer. */
const longest = 48_000;

/** Between two terms: lines, for tools that compare files by them. */
const separator = ",\n";

/** The rising numbers of every term. */
export type TermLists = ReadonlyMap<string, readonly number[]>;

/** What `index.json` holds: the first term of `0.json`, `1.json` and so on. */
export interface TermIndex {
  readonly first: readonly string[];
}

/** Returns the files of term lists by their names. The same lists yield the same bytes. */
export function termFiles(lists: TermLists): Map<string, string> {
  const files = new Map<string, string>();
  const first: string[] = [];
  let lines: string[] = [];
  let length = 0;
  const end = (): void => {
    if (lines.length > 0) files.set(`${first.length - 1}.json`, `{${lines.join(separator)}}\n`);
    lines = [];
    length = 0;
  };
  // By UTF-16 units, as a reader compares them.
  for (const term of [...lists.keys()].sort()) {
    const line = `${JSON.stringify(term)}:${JSON.stringify(differences(lists.get(term) ?? []))}`;
    if (length + line.length > longest) end();
    if (lines.length === 0) first.push(term);
    lines.push(line);
    length += line.length + separator.length;
  }
  end();
  files.set("index.json", `${JSON.stringify({ first } satisfies TermIndex)}\n`);
  return files;
}

/** Returns the lists of one file. */
export function parseTermFile(text: string): Map<string, number[]> {
  const lists = JSON.parse(text) as Record<string, number[]>;
  return new Map(Object.entries(lists).map(([term, steps]) => [term, sums(steps)]));
}

/** Returns the number of the file that has a term, if any has; -1 if none can. */
export function termFileOf({ first }: TermIndex, term: string): number {
  let low = 0;
  let high = first.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((first[middle] ?? "") <= term) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

function differences(numbers: readonly number[]): number[] {
  return numbers.map((number, k) => number - (k === 0 ? 0 : (numbers[k - 1] ?? 0)));
}

function sums(steps: readonly number[]): number[] {
  let sum = 0;
  return steps.map((step) => (sum += step));
}
