import { mkdir, rm, writeFile } from "node:fs/promises";
import { availableParallelism } from "node:os";
import { basename, join } from "node:path";
import packageJson from "../../package.json" with { type: "json" };
import { openBook } from "../book.ts";
import { findChromium } from "../chromium/find_chromium.ts";
import { fileProblem, Problem, printable } from "../problem.ts";
import { Progress } from "../progress.ts";
import { Warnings } from "../warnings.ts";
import { type ListedBook, listBooks } from "./catalogue.ts";
import { contentHash, hashOf } from "./content_hash.ts";
import { drawBook, makeFolder } from "./draw_book.ts";
import type { UnshownPart } from "./drawn_page.ts";
import { mergeShards, type ShardNote } from "./merge.ts";
import { PageDrawer } from "./page_drawer.ts";
import type { PublishCommand } from "./publish_arguments.ts";
import { readRecord } from "./record.ts";
import { readAssets, type SiteAssets } from "./site_assets.ts";
import { bookFormat } from "./site_book.ts";
import { writeBook } from "./write_book.ts";
import { type Failure, shardNoteName, writeSite } from "./write_site.ts";

/**
 * Publishes books as a web site. A book that fails is reported, and the others
 * are published all the same.
 *
 * @throws Problem if anything failed, or the signal aborts
 */
export async function publish(command: PublishCommand, signal: AbortSignal): Promise<void> {
  try {
    await publishBooks(command, signal);
  } catch (error) {
    if (signal.aborted) throw new Problem("Stopped; the same command goes on from here.");
    const isOfFileSystem = error instanceof Error && "syscall" in error;
    throw isOfFileSystem ? fileProblem(command.out, error, "written") : error;
  }
}

async function publishBooks(command: PublishCommand, signal: AbortSignal): Promise<void> {
  const { out, site } = command;
  const assets = await readAssets();
  await mkdir(out, { recursive: true });
  if (command.merge) {
    const { ids, failures } = await mergeShards(command.paths, out, signal);
    const count = await writeSite(out, { site, assets, ids, failures });
    return finish(out, count, failures, `merged from ${command.paths.length} shards`);
  }
  const listed = await listBooks(command.paths, command.catalogue);
  const { number, count } = command.shard ?? { number: 1, count: 1 };
  const own = listed.filter((_, index) => index % count === number - 1);
  await rm(join(out, shardNoteName), { force: true });
  const publishing = new Publishing(command, assets, own, signal);
  const failures = await publishing.run();
  const ids = listed.map(({ id }) => id);
  const { done } = publishing;
  const how = `${done.drawn} drawn, ${done.kept} unchanged`;
  if (command.shard === null) {
    const books = await writeSite(out, { site, assets, ids, failures });
    return finish(out, books, failures, how);
  }
  const note: ShardNote = { ...{ number, count, ids }, failures };
  await writeFile(join(out, shardNoteName), `${JSON.stringify(note)}\n`);
  finish(out, done.drawn + done.kept, failures, how);
}

function finish(out: string, books: number, failures: readonly Failure[], how: string): void {
  console.log(`${printable(out)}: ${books} ${books === 1 ? "book" : "books"}, ${how}`);
  if (failures.length === 0) return;
  throw new Problem(
    `${failures.length} ${failures.length === 1 ? "failure" : "failures"}; the rest was published.`,
  );
}

/** Returns a sentence for what a book failed by, even if it is a fault of this command. */
function sentenceOf(error: unknown): string {
  if (error instanceof Problem) return error.message;
  const message = error instanceof Error ? error.message : String(error);
  return `It could not be published (${printable(message)}).`;
}

/** A run over the books of one site or shard. */
class Publishing {
  readonly #command: PublishCommand;
  readonly #assets: SiteAssets;
  readonly #books: readonly ListedBook[];
  readonly #signal: AbortSignal;
  readonly #progress = new Progress();
  /** By the book's place in the list, so that the report does not depend on who was first. */
  readonly #failures: Failure[][] = [];
  #next = 0;
  /** Books done, and the fractions of those under way. */
  #ended = 0;
  readonly #fractions = new Map<number, number>();
  readonly done = { drawn: 0, kept: 0 };

  constructor(
    command: PublishCommand,
    assets: SiteAssets,
    books: readonly ListedBook[],
    signal: AbortSignal,
  ) {
    this.#command = command;
    this.#assets = assets;
    this.#books = books;
    this.#signal = signal;
  }

  /** Publishes all books. Returns what failed, in the books' order. */
  async run(): Promise<readonly Failure[]> {
    const { chromium, workers, pageSeconds } = this.#command;
    const program = findChromium(chromium);
    const count = Math.min(workers ?? availableParallelism(), Math.max(this.#books.length, 1));
    const drawers = Array.from(
      { length: count },
      () => new PageDrawer(program, 1000 * pageSeconds),
    );
    const stop = (): void => {
      for (const drawer of drawers) void drawer.close();
    };
    this.#signal.addEventListener("abort", stop, { once: true });
    try {
      const ends = await Promise.allSettled(drawers.map((drawer) => this.#work(drawer)));
      for (const end of ends) if (end.status === "rejected") throw end.reason;
    } finally {
      this.#signal.removeEventListener("abort", stop);
      this.#progress.clear();
      await Promise.all(drawers.map((drawer) => drawer.close()));
    }
    return this.#failures.flat();
  }

  async #work(drawer: PageDrawer): Promise<void> {
    while (this.#next < this.#books.length) {
      const index = this.#next++;
      const listed = this.#books[index];
      if (!listed) return;
      try {
        this.#failures[index] = await this.#publish(index, listed, drawer);
      } catch (error) {
        if (this.#signal.aborted) throw error;
        // What was published of it before stays: its file may be out of reach for this run alone.
        const { id, given } = listed;
        this.#failures[index] = [{ id, book: printable(given), message: sentenceOf(error) }];
      }
      this.#report(listed, this.#failures[index] ?? []);
      this.#fractions.delete(index);
      this.#ended++;
      this.#show(listed);
    }
  }

  /** Prints sentences about a book, as many of each kind as are read. */
  #report({ given }: ListedBook, sentences: readonly UnshownPart[]): void {
    const warnings = new Warnings();
    if (sentences.length > 0) this.#progress.clear();
    for (const { page, message } of sentences) {
      const where = page === undefined ? "" : `, page ${page}`;
      warnings.add(`${printable(given)}${where}: ${printable(message)}`);
    }
    warnings.end();
  }

  /**
   * Publishes one book if it is not there as it should be. Returns what failed
   * of its pages.
   */
  async #publish(index: number, listed: ListedBook, drawer: PageDrawer): Promise<Failure[]> {
    const { out, books: options, site, bookMinutes } = this.#command;
    const { version } = packageJson;
    const folder = this.#folder(listed);
    const book = await openBook(listed.path, () => {});
    const name = basename(listed.path);
    const drawing = [version, bookFormat, this.#assets.drawing];
    const drawn = hashOf(drawing, options, name, await contentHash(book));
    const scripts = [...this.#assets.files.keys()];
    const written = hashOf(version, drawn, listed.id, listed.details, site, scripts);
    this.#signal.throwIfAborted();
    let record = await readRecord(folder);
    if (record?.drawn !== drawn) {
      await makeFolder(folder, join(out, `.part-${listed.id}`), async (part) => {
        const late = await drawBook(part, {
          ...{ book, name: printable(name), drawer, options, signal: this.#signal },
          until: Date.now() + 60_000 * bookMinutes,
          missing: (missing) => this.#report(listed, missing),
          progress: (fraction) => {
            this.#fractions.set(index, fraction);
            this.#show(listed);
          },
        });
        // With pages given up for their time it is not the book that was asked for: the next run draws it again.
        const asDrawn = late.length > 0 ? hashOf(drawn, late) : drawn;
        record = await this.#write(part, listed, asDrawn, written);
      });
      this.done.drawn++;
    } else {
      if (record.written !== written) record = await this.#write(folder, listed, drawn, written);
      this.done.kept++;
    }
    return (record?.details.failures ?? []).map((failure) => ({
      id: listed.id,
      book: printable(listed.given),
      ...failure,
    }));
  }

  async #write(folder: string, { id, details }: ListedBook, drawn: string, written: string) {
    const { site } = this.#command;
    const settings = { id, given: details, site, assets: this.#assets, drawn, written };
    return await writeBook(folder, settings);
  }

  #folder({ id }: ListedBook): string {
    return join(this.#command.out, "books", id);
  }

  #show({ given }: ListedBook): void {
    const all = this.#books.length;
    const under = [...this.#fractions.values()].reduce((sum, fraction) => sum + fraction, 0);
    const text = `${this.#ended} of ${all} books, ${printable(basename(given))}`;
    this.#progress.show((this.#ended + under) / Math.max(all, 1), text);
  }
}
