/** The script of the search page: finds books by words, and pages in them, from small files. */

import "./site.css";
import { searchWords } from "../../src/publish/search_words.ts";
import { pagesInPart, type SiteText } from "../../src/publish/site_book.ts";
import { parseTermFile, type TermIndex, termFileOf } from "../../src/publish/term_lists.ts";
import { keepVisited } from "./offline.ts";

/** Books shown at a time, and pages named of each. */
const booksAtOnce = 10;
const pagesOfBook = 8;
/** Books in one file of their details, as the site was written. */
const booksInPart = 100;
/** Letters from which on the last word finds longer ones; characters around a found word. */
const shortestBeginning = 3;
const around = 90;

/** A book as the search's files have it. */
interface FoundBook {
  readonly id: string;
  readonly title: string;
  readonly authors?: readonly string[];
  readonly language: string;
  readonly pageCount: number;
  readonly cover: { readonly src: string; readonly width: number; readonly height: number } | null;
  readonly version: string;
}

const root = document.body.dataset.root ?? "";
const files = new Map<string, Promise<unknown>>();

/** Fetches a file once. */
function load<T>(address: string, parse: (text: string) => T): Promise<T> {
  const known = files.get(address) as Promise<T> | undefined;
  if (known) return known;
  const loading = fetch(root + address).then(async (response) => {
    if (!response.ok) throw new Error(`${address} is not there.`);
    return parse(await response.text());
  });
  files.set(address, loading);
  return loading;
}

/** Returns the numbers of a word, and of those that begin with it if it is a query's last. */
async function numbersOf(folder: string, word: string, isLast: boolean): Promise<number[]> {
  const index = await load(`${folder}index.json`, (text) => JSON.parse(text) as TermIndex);
  const file = termFileOf(index, word);
  if (file < 0) return [];
  const lists = await load(`${folder}${file}.json`, parseTermFile);
  const exact = lists.get(word) ?? [];
  if (!isLast || word.length < shortestBeginning) return exact;
  const longer = [...lists].filter(([term]) => term.startsWith(word)).flatMap(([, list]) => list);
  return [...new Set(longer)].sort((a, b) => a - b);
}

/** Returns the books that have every word, the likeliest first. */
async function findBooks(words: readonly string[]): Promise<number[]> {
  const lists = await Promise.all(
    words.map((word, k) => numbersOf("search/", word, k === words.length - 1)),
  );
  const scores = new Map<number, { words: number; weight: number }>();
  for (const list of lists) {
    const weights = new Map<number, number>();
    for (const number of list) {
      const book = number >> 2;
      weights.set(book, Math.max(weights.get(book) ?? 0, 1 + (number & 3)));
    }
    for (const [book, weight] of weights) {
      const score = scores.get(book) ?? { words: 0, weight: 0 };
      scores.set(book, { words: score.words + 1, weight: score.weight + weight });
    }
  }
  return [...scores]
    .filter(([, score]) => score.words === words.length)
    .sort(([a, one], [b, other]) => other.weight - one.weight || a - b)
    .map(([book]) => book);
}

/** Returns the pages of a book that have every word; none if only its title has them. */
async function findPages(book: FoundBook, words: readonly string[]): Promise<number[]> {
  const folder = `books/${encodeURIComponent(book.id)}/words/`;
  const lists = await Promise.all(
    words.map((word, k) => numbersOf(folder, word, k === words.length - 1)),
  );
  const [first = [], ...others] = lists.map((list) => new Set(list));
  return [...first].filter((page) => others.every((list) => list.has(page)));
}

async function bookAt(number: number): Promise<FoundBook | undefined> {
  const part = Math.floor(number / booksInPart);
  const books = await load(`search/books/${part}.json`, (text) => JSON.parse(text) as FoundBook[]);
  return books[number % booksInPart];
}

/** Returns the text of a page around the first of some words, and where that stands in it. */
async function excerpt(book: FoundBook, page: number, words: readonly string[]) {
  const part = Math.floor((page - 1) / pagesInPart) + 1;
  const address = `books/${encodeURIComponent(book.id)}/text/${part}.json?v=${book.version}`;
  const texts = await load(address, (text) => JSON.parse(text) as SiteText[]);
  const runs = texts[(page - 1) % pagesInPart]?.runs ?? [];
  const text = runs.map(([text, , , , , , flags]) => (flags & 1 ? `${text} ` : text)).join("");
  for (const { index, 0: word } of text.matchAll(/[\p{L}\p{N}\p{M}'\u2019]+/gu)) {
    const folded = searchWords(word);
    if (!folded.some((one) => words.some((wanted) => one.startsWith(wanted)))) continue;
    const end = index + word.length;
    const [from, to] = [Math.max(0, index - around), Math.min(text.length, end + around)];
    return {
      // No half words at the cuts.
      before: text.slice(from, index).replace(from > 0 ? /^\S*/ : "", from > 0 ? "…" : ""),
      word,
      after: text
        .slice(end, to)
        .replace(to < text.length ? /\S*$/ : "", to < text.length ? "…" : ""),
    };
  }
  return null;
}

function element<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  properties: Partial<HTMLElementTagNameMap[Name]>,
  ...children: readonly (Node | string)[]
): HTMLElementTagNameMap[Name] {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

async function resultOf(number: number, words: readonly string[]): Promise<HTMLElement> {
  const book = await bookAt(number);
  if (!book) throw new Error("The search is of another version of the site; load it again.");
  const folder = `${root}books/${encodeURIComponent(book.id)}/`;
  const result = element("li", {});
  if (book.cover) {
    const { src, width, height } = book.cover;
    const picture = { src: `${folder}${src}?v=${book.version}`, width, height, alt: "" };
    result.append(
      element(
        "a",
        { href: folder, className: "cover" },
        element("img", { ...picture, loading: "lazy" }),
      ),
    );
  }
  const about = element(
    "div",
    {},
    element("a", { href: folder, className: "title", lang: book.language }, book.title),
  );
  if (book.authors) about.append(element("span", { className: "author" }, book.authors.join(", ")));
  const pages = await findPages(book, words);
  const [first] = pages;
  if (first !== undefined) {
    const found = await excerpt(book, first, words).catch(() => null);
    if (found) {
      const { before, word, after } = found;
      about.append(element("p", { lang: book.language }, before, element("mark", {}, word), after));
    }
    const links = pages
      .slice(0, pagesOfBook)
      .flatMap((page) => [" ", element("a", { href: `${folder}#page=${page}` }, String(page))]);
    const more = pages.length > pagesOfBook ? ` and ${pages.length - pagesOfBook} more` : "";
    about.append(
      element("p", { className: "facts" }, pages.length === 1 ? "Page" : "Pages", ...links, more),
    );
  }
  result.append(about);
  return result;
}

async function search(query: string): Promise<void> {
  const state = document.getElementById("search-state");
  const results = document.getElementById("results");
  const more = document.getElementById("more");
  if (!state || !results || !more) return;
  const words = [...new Set(searchWords(query))];
  if (words.length === 0) return;
  state.textContent = "Searching …";
  const books = await findBooks(words);
  const count = books.length;
  state.textContent =
    count === 0
      ? `No book has ${query}.`
      : `${count} ${count === 1 ? "book has" : "books have"} ${query}.`;
  let shown = 0;
  const show = async (): Promise<void> => {
    const next = books.slice(shown, shown + booksAtOnce);
    shown += next.length;
    more.hidden = shown >= count;
    results.append(...(await Promise.all(next.map((book) => resultOf(book, words)))));
  };
  more.addEventListener("click", () => void show().catch(fail));
  await show();
}

function fail(error: unknown): void {
  const state = document.getElementById("search-state");
  const reason = error instanceof Error ? error.message : "";
  if (state)
    state.textContent = `The search failed; check the connection and load it again. ${reason}`;
}

const query = new URLSearchParams(location.search).get("q") ?? "";
const field = document.querySelector<HTMLInputElement>("input[name=q]");
if (field) field.value = query;
await search(query).catch(fail);
void keepVisited();
