import { extname } from "node:path";
import { oneOf, parseNumber, parseOptions, parseSize } from "../options.ts";
import { UsageProblem } from "../problem.ts";
import { stockNames, stockWords } from "../stock_names.ts";
import { type FilmFormat, filmFormats } from "./encode.ts";
import { type FilmAction, parseActions } from "./film_actions.ts";
import { parseAttributes } from "./film_attributes.ts";

/** The options of a film. */
export interface FilmCommand {
  readonly name: "film";
  readonly path: string;
  /** Pages from 1; `to` is null for the book's last. */
  readonly from: number;
  readonly to: number | null;
  /** What is done from page `from` on; undefined if pages turn from there to `to`. */
  readonly actions: readonly FilmAction[] | undefined;
  /** Attributes of the book. */
  readonly attributes: Readonly<Record<string, string>>;
  /** A file, or a folder for pictures. */
  readonly out: string;
  readonly format: FilmFormat;
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  readonly fps: number;
  /** Length of a turn, and of the pause between two. */
  readonly turnSeconds: number;
  readonly pauseSeconds: number;
  readonly stock: string;
  readonly theme: string;
  /** A browser by its file or name; undefined for one of the usual ones. */
  readonly chromium: string | undefined;
}

export const filmHelp = `turnleaf film BOOK --out FILE films a book as its pages turn: headless, frame by
frame, so that no frame is ever dropped. Needs Chromium, and ffmpeg for MP4, WebM
and GIF. Stopped, the same command goes on where it was.

  --out FILE             book.mp4, book.webm, book.gif or book.webp, an animated
                         picture; or a folder, which gets numbered PNG pictures
  --pages A-B            from the spread of page A to that of page B (all); with
                         --do the page at which the film begins
  --do "ACTION, …"       what is done in place of turning from page to page, one
                         after the other; may be given several times:
                         next, previous, go-to PAGE
                         dog-ear [PAGE] [head|foot] [SIZE]
                         fold PAGE X,Y X,Y [ANGLE], fold PAGE letter
                         unfold PAGE (its folds, or a fold-out), fold-in
                         tear-out [PAGE], tear-across X,Y X,Y, crumple, put-back
                         wait SECONDS
  --attribute NAME=VALUE how the book is bound, as an attribute of
                         <turnleaf-book>: binding, layout, cover, offset, cloth,
                         shadows, hard-pages, stocks or tearable; once for each
  --size WxH             pixels (1280x720)
  --fps N                frames a second, 1 to 120 (30)
  --seconds-per-turn S   how long a leaf is in the air (1)
  --pause S              how long the book lies still between turns or actions (1)
  --stock NAME           ${stockWords} (book)
  --theme NAME           light, sepia, grey or night (light)
  --chromium PATH        the browser; else CHROMIUM, else one on the PATH
`;

/**
 * Parses the arguments of `turnleaf film`.
 *
 * @throws UsageProblem
 */
export function parseFilm(args: readonly string[]): FilmCommand {
  const names = [
    ...["out", "pages", "size", "fps", "seconds-per-turn", "pause"],
    ...["stock", "theme", "chromium"],
  ];
  const { values, lists, positionals } = parseOptions(args, names, [], ["do", "attribute"]);
  const [path] = positionals;
  if (path === undefined || path === "") throw new UsageProblem("Name the book to film.");
  if (positionals.length > 1) {
    throw new UsageProblem("Name one book; quote a name that has spaces.");
  }
  const { out } = values;
  if (!out) throw new UsageProblem("Say where the film goes: --out book.mp4");
  const format = formatOf(out);
  const { width, height } = parseSize("size", values.size ?? "1280x720", 16, 4096);
  if ((format === "mp4" || format === "webm") && (width % 2 || height % 2)) {
    throw new UsageProblem("A film's width and height are even numbers.");
  }
  const { do: texts = [], attribute = [] } = lists;
  const actions = texts.length > 0 ? parseActions(texts) : undefined;
  if (actions && values.pages?.includes("-")) {
    throw new UsageProblem("With --do, --pages is the one page at which the film begins.");
  }
  return {
    name: "film",
    path,
    ...parsePages(values.pages),
    actions,
    attributes: parseAttributes(attribute),
    out,
    format,
    width,
    height,
    fps: parseNumber("fps", values.fps, 30, 1, 120),
    turnSeconds: parseNumber("seconds-per-turn", values["seconds-per-turn"], 1, 0.1, 60),
    pauseSeconds: parseNumber("pause", values.pause, 1, 0, 60),
    stock: oneOf("stock", values.stock, stockNames),
    theme: oneOf("theme", values.theme, ["light", "sepia", "grey", "night"]),
    chromium: values.chromium,
  };
}

function formatOf(out: string): FilmFormat {
  const ending = extname(out).slice(1).toLowerCase();
  if (ending === "") return "png";
  const format = filmFormats.find((format) => format === ending && format !== "png");
  if (format) return format;
  throw new UsageProblem(
    "--out is a file that ends in .mp4, .webm, .gif or .webp, or a folder for numbered pictures.",
  );
}

function parsePages(text: string | undefined): { from: number; to: number | null } {
  if (text === undefined) return { from: 1, to: null };
  const match = /^(\d{1,6})(?:-(\d{1,6})?)?$/.exec(text);
  const from = Number(match?.[1]);
  const to = match?.[2] === undefined ? (text.includes("-") ? null : from) : Number(match[2]);
  if (match && from >= 1 && (to === null || to >= from)) return { from, to };
  throw new UsageProblem("--pages is a range such as 1-20.");
}
