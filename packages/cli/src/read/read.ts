import { readFile } from "node:fs/promises";
import { appFiles } from "../app_files.ts";
import type { ReadCommand } from "../arguments.ts";
import type { ServedFile } from "../book.ts";
import { Problem, printable } from "../problem.ts";
import { onlinePolicy, readerPolicy } from "../reader_policy.ts";
import { type ServedSite, serveUntilStopped } from "../serve_until_stopped.ts";
import type { TakeReport } from "../server.ts";
import { Warnings } from "../warnings.ts";
import { type NamedBook, NamedBooks } from "./open_named.ts";
import { shelfBody } from "./shelf_body.ts";

/** Characters of a sentence that are printed. */
const longestSentence = 500;

/**
 * Serves books with the reader until `signal` aborts: one in the whole window,
 * several on a shelf.
 * @throws Problem before anything is served
 */
export async function read(command: ReadCommand, signal: AbortSignal): Promise<void> {
  const named = new NamedBooks(signal);
  try {
    const site = await siteOf(await named.open(command.books));
    if (signal.aborted) throw new Problem("Stopped before anything was served.");
    await serveUntilStopped(site, command, signal);
  } finally {
    await named.close();
  }
}

async function siteOf(books: readonly NamedBook[]): Promise<ServedSite> {
  const isShelf = books.length > 1;
  const app = await appFiles(isShelf ? "shelf.html" : "index.html").catch(() => new Map());
  const files = new Map<string, ServedFile>(app);
  const main = files.get("/");
  if (!main || !("path" in main)) throw new Problem("The reader is not built; run: npm run build");
  const placed = isShelf ? books.map((book, k) => below(book, `/books/${k + 1}`)) : books;
  const listed = placed.map(({ src, title }) => ({ src, title }));
  for (const book of placed) for (const [address, file] of book.files) files.set(address, file);
  files.set("/config.json", { type: "application/json", text: JSON.stringify({ books: listed }) });
  if (isShelf) {
    const page = await readFile(main.path, "utf8");
    files.set("/", {
      type: main.type,
      text: page.replace("</body>", `${shelfBody(listed)}</body>`),
    });
  }
  const what = isShelf ? `${books.length} books` : books[0]?.title;
  return {
    files,
    report: printWarnings(),
    policy: books.some(({ isOnline }) => isOnline) ? onlinePolicy : readerPolicy,
    announce: (url) => `Turnleaf is reading ${what} at ${url}`,
  };
}

/** Sentences of books that are remembered, so that each is printed once: more than are printed. */
const mostRemembered = 10_000;

/** Returns what prints the sentences of what books drop, as the reader finds them, each once. */
function printWarnings(): TakeReport {
  const known = new Set<string>();
  const warnings = new Warnings();
  return (report) => {
    for (const sentence of sentencesIn(report)) {
      if (known.has(sentence) || known.size === mostRemembered) continue;
      known.add(sentence);
      warnings.add(printable(sentence, longestSentence));
    }
  };
}

/** Returns the sentences that a page reports as JSON; none if it is anything else. */
function sentencesIn(report: string): string[] {
  try {
    const value: unknown = JSON.parse(report);
    return Array.isArray(value) ? value.filter((one) => typeof one === "string") : [];
  } catch {
    return [];
  }
}

/** Returns a book whose files are below an address, so that those of several do not meet. */
function below(book: NamedBook, base: string): NamedBook {
  if (book.isOnline) return book;
  const files = [...book.files].map(([address, file]) => [base + address, file] as const);
  return { ...book, src: base + book.src, files: new Map(files) };
}
