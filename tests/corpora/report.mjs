/**
 * Writes docs/reports/corpora.md from what `node tests/corpora/run.mjs` has found. A page that cannot be drawn
 * counts as rejected, not as wrong, if seen.json says that others do not draw it either.
 *
 *   node tests/corpora/report.mjs
 */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { corpora } from "../../scripts/corpora.mjs";
import { markdown } from "../../scripts/docs_tables.mjs";

const root = join(import.meta.dirname, "../..");

/** Maximum of faults that are listed of a book. */
const toldFaults = 3;

/** Returns a text as it stands in a cell of a table. */
const cell = (text) =>
  text
    .replace(/[|`<>]/g, " ")
    .replace(/\s+/g, " ")
    .trim();

/** Returns the value beneath which a fraction of some numbers lie. */
function quantile(numbers, fraction) {
  const sorted = numbers.filter((one) => one !== undefined && one !== null).sort((a, b) => a - b);
  return sorted.length === 0 ? "" : sorted[Math.ceil(fraction * sorted.length) - 1];
}

const spread = (numbers) =>
  [0.5, 0.95, 1].map((fraction) => quantile(numbers, fraction)).join(" / ");

/** What other readers of PDFs show of books that are rejected here, by collection and path. */
const seen = JSON.parse(readFileSync(join(import.meta.dirname, "seen.json"), "utf8"));

const isOneSentence = (text) => /^[^\n]+\.$/.test(text) && !/[.!?]\s+\p{Lu}/u.test(text);
const isRefused = ({ refused }) => refused !== undefined;
const isSentence = ([kind, what]) => kind === "rejected" && isOneSentence(what);

/** Returns whether pages of a book are rejected in one sentence each, and others do not draw them either. */
const hasRejectedPages = ({ faults = [], foreign, seenElsewhere }) =>
  faults.length > 0 && !foreign && seenElsewhere !== undefined && faults.every(isSentence);

const isRejected = (book) =>
  isRefused(book) ? book.isBookError && isOneSentence(book.refused) : hasRejectedPages(book);
const isWrong = (book) =>
  !isRejected(book) && (isRefused(book) || (book.faults ?? []).length > 0 || Boolean(book.foreign));

const found = Object.values(corpora).flatMap((corpus) => {
  const file = join(root, "target/corpora", `${corpus.name}.json`);
  if (!existsSync(file)) return [];
  const { total, books } = JSON.parse(readFileSync(file, "utf8"));
  const elsewhere = seen[corpus.name] ?? {};
  return [
    {
      ...corpus,
      total,
      books: books.map((book) => ({ ...book, seenElsewhere: elsewhere[book.path] })),
    },
  ];
});

const summary = [
  [
    "collection",
    "books tried, of",
    "right",
    "rejected",
    "wrong",
    "not compared",
    "first page, ms: p50 / p95 / worst",
    "memory, MB: p50 / p95 / worst",
  ],
  ...found.map(({ name, address, commit, total, books }) => [
    `[${name}](${address.replace(/\.git$/, "")}) ${commit.slice(0, 8)}`,
    `${books.length} of ${total}`,
    books.filter((book) => !isWrong(book) && !isRejected(book)).length,
    books.filter(isRejected).length,
    books.filter(isWrong).length,
    books.filter(({ opinion, refused }) => opinion !== null && refused === undefined).length,
    spread(books.map(({ milliseconds }) => milliseconds?.first)),
    spread(books.map(({ megabytes }) => megabytes)),
  ]),
];

const sentences = [["collection", "book", "sentence", "other readers"]];
const faults = [["collection", "book", "what is wrong"]];
for (const { name, books } of found) {
  for (const book of books) {
    if (isRejected(book)) {
      const said = book.refused ?? [...new Set(book.faults.map(([, what]) => what))].join(" ");
      sentences.push([name, cell(book.path), cell(said), cell(book.seenElsewhere ?? "")]);
    } else if (isWrong(book)) {
      const said = (book.faults ?? []).map(([kind, what, page]) =>
        cell(`${kind}${page ? `, page ${page}` : ""}: ${what}`),
      );
      // Of one page it may be said as its text is read and as it is drawn.
      const told = [...new Set(said)];
      if (isRefused(book)) told.push(cell(book.refused));
      if (book.foreign) told.push(`asked for ${book.foreign.length} addresses`);
      const more = told.length - toldFaults;
      const words = told.slice(0, toldFaults).join("; ");
      faults.push([name, cell(book.path), more > 0 ? `${words}; ${more} more` : words]);
    }
  }
}

const text = `# Books of public collections

\`make corpora\` fetches the collections that [\`corpora.json\`](../../scripts/corpora.json) lists, each at one commit; \`make report-corpora\` opens their books in Chromium, walks their pages and writes this page. Of an EPUB that is well-formed, what its pages say is compared with what plain Chromium shows of its documents: every word on exactly one page, lines of the contents that lead where they say, no blank page that the book does not ask for; in every line that is drawn there is ink, no line lies upon another or beyond its page. Of every book: each page opens and is drawn, and nothing is asked of the network. A book is rejected if it says in one sentence why it is not opened; or pages of it, if [\`seen.json\`](../../tests/corpora/seen.json) has what other readers make of them, and that is no more. At most 40 pages of a book are drawn, the text of all is read. "Not compared" are those of other formats, and EPUBs that are not well-formed: they were walked alone. Times and memory are those of a machine that did other work as well.

## By collection

${markdown(summary)}
## What is wrong

${faults.length > 1 ? markdown(faults) : "Nothing.\n"}
## What is rejected

${sentences.length > 1 ? markdown(sentences) : "Nothing.\n"}`;
mkdirSync(join(root, "docs/reports"), { recursive: true });
writeFileSync(join(root, "docs/reports/corpora.md"), text);
console.log(markdown(summary));
