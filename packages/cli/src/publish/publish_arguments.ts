import { oneOf, parseNumber, parseOptions } from "../options.ts";
import { UsageProblem } from "../problem.ts";
import type { BookOptions } from "./draw_book.ts";
import type { SiteOptions } from "./page_shell.ts";

/** A parsed `turnleaf publish`. */
export interface PublishCommand {
  readonly name: "publish";
  /** The folder of the site. */
  readonly out: string;
  readonly paths: readonly string[];
  /** A JSON file that lists books with their details. */
  readonly catalogue: string | undefined;
  /** Folders of shards, which are merged instead of books published. */
  readonly merge: boolean;
  /** Which part of the books, from 1, of how many; null for all of them, and the site. */
  readonly shard: { readonly number: number; readonly count: number } | null;
  readonly site: SiteOptions;
  readonly books: BookOptions;
  /** Browsers that draw at the same time; undefined for as many as there are cores. */
  readonly workers: number | undefined;
  /** Bounds on one page and on one book. */
  readonly pageSeconds: number;
  readonly bookMinutes: number;
  /** A browser by its file or name; undefined for one of the usual ones. */
  readonly chromium: string | undefined;
}

export const publishHelp = `turnleaf publish BOOK… --out FOLDER makes a web site of books: a shelf, a reader,
the text of every page, a search over all books, covers and IIIF manifests, for any
web server that serves files. Needs Chromium. A book that has not changed is left as
it is; stopped, the same command goes on where it was.

  --out FOLDER         the site's folder
  --catalogue FILE     more books, and title, authors, language and licence of each:
                       {"books": [{"file": "a.pdf", "licence": "CC-BY-4.0"}]}
  --title TEXT         the site's name (Books)
  --url ADDRESS        where the site will be: needed for IIIF manifests and a sitemap
  --size N             longer side of the largest picture of a page, 256 to 4096
                       pixels (2048); each is there at a half and a quarter of it too
  --format NAME        jpeg or webp (jpeg; IIIF's image service needs it)
  --quality N          of the pictures, 1 to 100 (85)
  --keep-file          the book's own file in place of pictures, for readers to open
  --workers N          browsers that draw at the same time (as many as cores)
  --shard K/N          only part K of N of the books, into a folder of its own
  --merge              instead of books, name the folders of all shards
  --page-seconds N     a page that takes longer is given up (60)
  --book-minutes N     a book that takes longer is given up (120)
  --chromium PATH      the browser; else CHROMIUM, else one on the PATH
`;

/**
 * Parses the arguments of `turnleaf publish`.
 *
 * @throws UsageProblem
 */
export function parsePublish(args: readonly string[]): PublishCommand {
  const { values, flags, positionals } = parseOptions(
    args,
    [
      ...["out", "catalogue", "title", "url", "size", "format", "quality", "workers"],
      ...["shard", "page-seconds", "book-minutes", "chromium"],
    ],
    ["keep-file", "merge"],
  );
  const { out } = values;
  if (!out) throw new UsageProblem("Name the site's folder: --out site");
  const merge = flags.has("merge");
  if (merge && (values.catalogue !== undefined || values.shard !== undefined)) {
    throw new UsageProblem("--merge takes the folders of shards, and neither books nor --shard.");
  }
  if (positionals.length === 0 && values.catalogue === undefined) {
    throw new UsageProblem(merge ? "Name the folders of the shards." : "Name a book to publish.");
  }
  if (positionals.includes("")) throw new UsageProblem("A book's name is empty.");
  return {
    name: "publish",
    ...{ out, paths: positionals, catalogue: values.catalogue, merge },
    shard: parseShard(values.shard),
    site: { title: values.title || "Books", url: parseUrl(values.url) },
    books: {
      longest: whole("size", values.size, 2048, 256, 4096),
      format: oneOf("format", values.format, ["jpeg", "webp"]),
      quality: whole("quality", values.quality, 85, 1, 100),
      keepFile: flags.has("keep-file"),
    },
    workers: values.workers === undefined ? undefined : whole("workers", values.workers, 1, 1, 256),
    pageSeconds: parseNumber("page-seconds", values["page-seconds"], 60, 1, 3600),
    bookMinutes: parseNumber("book-minutes", values["book-minutes"], 120, 0.1, 10_000),
    chromium: values.chromium,
  };
}

function whole(
  name: string,
  text: string | undefined,
  usual: number,
  least: number,
  most: number,
): number {
  const number = parseNumber(name, text, usual, least, most);
  if (Number.isInteger(number)) return number;
  throw new UsageProblem(`--${name} takes a whole number from ${least} to ${most}.`);
}

function parseShard(text: string | undefined): PublishCommand["shard"] {
  if (text === undefined) return null;
  const match = /^(\d{1,5})\/(\d{1,5})$/.exec(text);
  const [number, count] = [Number(match?.[1]), Number(match?.[2])];
  if (match && number >= 1 && number <= count) return { number, count };
  throw new UsageProblem("--shard is a part of all, such as 2/8.");
}

function parseUrl(text: string | undefined): string | null {
  if (text === undefined) return null;
  try {
    const url = new URL(text);
    if (/^https?:$/.test(url.protocol) && url.search === "" && url.hash === "") {
      return url.href.replace(/(?<!\/)\/*$/, "/");
    }
  } catch {
    // It is no address.
  }
  throw new UsageProblem("--url is the site's address, such as https://example.org/books/");
}
