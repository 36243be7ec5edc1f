import { stat } from "node:fs/promises";
import { dirname } from "node:path";
import packageJson from "../../package.json" with { type: "json" };
import { appFiles } from "../app_files.ts";
import { openBook, type ServedBook, type ServedFile } from "../book.ts";
import { ChromiumPage } from "../chromium/devtools.ts";
import { findChromium } from "../chromium/find_chromium.ts";
import { fileProblem, Problem, printable } from "../problem.ts";
import { Progress } from "../progress.ts";
import { type Serving, serve } from "../server.ts";
import { Warnings } from "../warnings.ts";
import { encodeWebp } from "./animated_webp.ts";
import { encodeFilm, findFfmpeg } from "./encode.ts";
import type { FilmAction } from "./film_actions.ts";
import type { FilmCommand } from "./film_arguments.ts";
import { Frames, mostPictures, requestName } from "./frames.ts";

/**
 * Maximum time of a motion beyond that of a turn, seconds of the film: several times as long as
 * anything takes to come to rest.
 */
const longestMotion = 30;

/**
 * Films a book as its pages turn, or as the actions of `--do` say. Frame by frame: the page's clock advances by
 * one frame when that has been taken, so the film is as smooth on a slow
 * machine. Stopped by `signal`, it goes on from there the next time.
 *
 * @throws Problem
 */
export async function film(command: FilmCommand, signal: AbortSignal): Promise<void> {
  const { path, out, format, fps, width, height } = command;
  const ffmpeg = format === "png" || format === "webp" ? null : findFfmpeg();
  const chromium = findChromium(command.chromium);
  await requireFolder(out);
  const warnings = new Warnings();
  const book = await openBook(path, warnings.add);
  warnings.end();
  const request = await nameOf(command, book);
  const isOneFile = format !== "png";
  const folder = isOneFile ? `${out}.frames` : out;
  const frames = await Frames.open(folder, { request, fps, width, height }, isOneFile);
  const progress = new Progress();
  try {
    if (!frames.isWhole) await take(command, book, chromium, frames, progress, signal);
    signal.throwIfAborted();
    progress.clear();
    if (format === "webp") await encodeWebp(chromium, frames, command, out, signal);
    else if (format !== "png") {
      await encodeFilm(ffmpeg as string, frames, fps, format, out, signal);
    }
    if (isOneFile) await frames.remove();
  } catch (error) {
    progress.clear();
    if (!signal.aborted) throw error;
    throw new Problem("Stopped; the same command goes on from here.");
  }
  const seconds = (frames.count / fps).toFixed(1);
  const parts = `${frames.parts - 1} ${command.actions ? "actions" : "turns"}`;
  console.log(`${printable(out)}: ${frames.count} frames, ${parts}, ${seconds} s`);
}

/** Draws every frame that is missing. */
async function take(
  command: FilmCommand,
  book: ServedBook,
  chromium: string,
  frames: Frames,
  progress: Progress,
  signal: AbortSignal,
): Promise<void> {
  const serving = await serveFilm(command, book);
  let page: ChromiumPage | null = null;
  try {
    page = await ChromiumPage.start(chromium, command.width, command.height);
    const ending = page;
    signal.addEventListener("abort", () => void ending.close(), { once: true });
    signal.throwIfAborted();
    await page.goTo(`${serving.url}film.html`);
    await new Taking(page, command, frames, progress, signal).run();
    await frames.end();
  } finally {
    await page?.close();
    await serving.close();
  }
}

/** The page's description of the opened book. */
interface Opened {
  /** From 1, of the book. */
  readonly pages: number;
  /** Turns from the first page to the last one in the film. */
  readonly turns: number;
}

/** Advances the film's page, and saves its pictures. */
export class Taking {
  readonly #page: ChromiumPage;
  readonly #command: FilmCommand;
  readonly #frames: Frames;
  readonly #progress: Progress;
  readonly #signal: AbortSignal;
  #number: number;

  constructor(
    page: ChromiumPage,
    command: FilmCommand,
    frames: Frames,
    progress: Progress,
    signal: AbortSignal,
  ) {
    this.#page = page;
    this.#command = command;
    this.#frames = frames;
    this.#progress = progress;
    this.#signal = signal;
    this.#number = frames.count;
  }

  async run(): Promise<void> {
    const frames = this.#frames;
    const { from, to, actions, pauseSeconds } = this.#command;
    const done = Math.max(frames.parts - 1, 0);
    await this.#loaded();
    const asked = JSON.stringify({ from, to, done, actions });
    const { turns } = await this.#page.evaluate<Opened>(`film.open(${asked})`);
    if (frames.parts === 0) await this.#part(() => this.#pause(pauseSeconds));
    const count = actions?.length ?? turns;
    for (let part = done; part < count; part++) {
      const action = actions?.[part];
      const name = action ? "action" : "turn";
      const which = action ? `Action ${part + 1}, "${action.text}",` : `Turn ${part + 1}`;
      const show = (fraction: number): void => {
        const text = `${name} ${part + 1} of ${count}, ${this.#number} frames`;
        this.#progress.show((part + fraction) / count, text, done / count);
      };
      await this.#part(() => this.#film(action, which, show));
    }
    this.#progress.clear();
    const warnings = new Warnings();
    for (const sentence of await this.#page.evaluate<string[]>("film.warnings()")) {
      warnings.add(printable(sentence));
    }
    warnings.end();
  }

  /** Resolves when the page's script has run. */
  async #loaded(): Promise<void> {
    await this.#page.evaluate(`new Promise((resolve) => {
      const look = () => globalThis.film ? resolve() : setTimeout(look, 20);
      look();
    })`);
  }

  async #part(shoot: () => Promise<void>): Promise<void> {
    const before = this.#number;
    await shoot();
    await this.#frames.endPart(this.#number - before);
  }

  /**
   * Films an action, or a turn if there is none, and the pause after it.
   *
   * @param which the action as the subject of a sentence
   * @throws Problem if it does not come to rest
   */
  async #film(
    action: FilmAction | undefined,
    which: string,
    show: (fraction: number) => void,
  ): Promise<void> {
    const { fps, turnSeconds, pauseSeconds } = this.#command;
    if (action?.name === "wait") return await this.#pause(action.seconds);
    const before = this.#number;
    const longest = turnSeconds + longestMotion;
    let isMoving = await this.#page.evaluate<boolean>(
      action ? `film.begin(${JSON.stringify(action)})` : "film.turn()",
    );
    while (isMoving) {
      isMoving = await this.#page.evaluate<boolean>("film.step()");
      if (isMoving) await this.#take();
      const seconds = (this.#number - before) / fps;
      if (seconds > longest) {
        throw new Problem(`${which} has not come to rest after ${longest} s of the film.`);
      }
      show(Math.min(seconds / (turnSeconds + 0.5), 0.99));
    }
    await this.#pause(pauseSeconds);
  }

  /** Films the resting book: one picture, repeated for some seconds. */
  async #pause(seconds: number): Promise<void> {
    const count = Math.max(Math.round(seconds * this.#command.fps), 1);
    const first = this.#number;
    await this.#page.evaluate("film.rest()");
    await this.#take();
    for (let k = 1; k < count; k++) {
      this.#checkLength();
      if (!(await this.#frames.has(this.#number))) await this.#frames.repeat(this.#number, first);
      this.#number++;
    }
  }

  async #take(): Promise<void> {
    this.#signal.throwIfAborted();
    this.#checkLength();
    if (!(await this.#frames.has(this.#number))) {
      await this.#frames.write(this.#number, await this.#page.picture());
    }
    this.#number++;
  }

  /** @throws Problem if the film has as many pictures as one may have */
  #checkLength(): void {
    if (this.#number < mostPictures) return;
    throw new Problem(`A film has at most ${mostPictures} frames; film less of it.`);
  }
}

/** Serves the filming page and the book. */
async function serveFilm(command: FilmCommand, book: ServedBook): Promise<Serving> {
  const app = await appFiles("index.html").catch(() => new Map<string, ServedFile>());
  if (!app.has("/film.html")) throw new Problem("The reader is not built; run: npm run build");
  const { fps, turnSeconds, stock, theme, attributes } = command;
  const config = JSON.stringify({ src: book.src, fps, turnSeconds, stock, theme, attributes });
  const files = new Map([
    ...app,
    ...book.files,
    ["/config.json", { type: "application/json", text: config }] as const,
  ]);
  return await serve(files, 0);
}

/** Returns a name that is equal for two films only if all their pictures are the same. */
async function nameOf(command: FilmCommand, book: ServedBook): Promise<string> {
  const { chromium: _, out: __, path: ___, format: ____, ...what } = command;
  const files = await Promise.all(
    [...book.files].map(async ([address, file]) => {
      if ("text" in file) return [address, file.text];
      const { size, mtimeMs } = await stat(file.path);
      return [address, size, mtimeMs];
    }),
  );
  return requestName({ version: packageJson.version, ...what, files });
}

async function requireFolder(out: string): Promise<void> {
  const folder = dirname(out);
  const stats = await stat(folder).catch((error: unknown) => {
    throw fileProblem(folder, error);
  });
  if (!stats.isDirectory()) throw new Problem(`${printable(folder)} is no folder.`);
}
