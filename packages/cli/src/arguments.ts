import { parseArgs } from "node:util";
import { type BakeCommand, bakeHelp, parseBake } from "./bake/bake_arguments.ts";
import { type FilmCommand, filmHelp, parseFilm } from "./film/film_arguments.ts";
import { usageProblem } from "./options.ts";
import { UsageProblem } from "./problem.ts";
import { type PublishCommand, parsePublish, publishHelp } from "./publish/publish_arguments.ts";
import { readable } from "./served_formats.ts";

/** A parsed command line. */
export type Command =
  | { readonly name: "help"; readonly text: string }
  | FilmCommand
  | BakeCommand
  | PublishCommand
  | { readonly name: "version" }
  | (ServeOptions & { readonly name: "playground" })
  | ReadCommand;

/** Books to be read. */
export interface ReadCommand extends ServeOptions {
  readonly name: "read";
  /** Files, folders and addresses; at least one. */
  readonly books: readonly string[];
}

/** The options of serving. */
export interface ServeOptions {
  /** Undefined: 4173, or the next one that is free. */
  readonly port: number | undefined;
  /** Whether the browser is opened. */
  readonly opens: boolean;
}

/** Where the help describes commands, and the end of its lines, in characters. */
const [descriptionAt, lineEnd] = [33, 80];

/** Returns a command with its description, in lines of the help. */
function describe(command: string, description: string): string {
  const lines = [`  ${command}`.padEnd(descriptionAt - 1)];
  for (const word of description.split(" ")) {
    const longer = `${lines.at(-1)} ${word}`;
    if (longer.length <= lineEnd) lines[lines.length - 1] = longer;
    else lines.push(" ".repeat(descriptionAt) + word);
  }
  return lines.join("\n");
}

const described = describe(
  "turnleaf read BOOK…",
  `reads ${readable} in their order, or what is at an address (https://…), a IIIF manifest too; several books, or a folder of them, as a shelf`,
);

export const help = `Turnleaf shows a book whose pages turn as paper turns.

  turnleaf BOOK…                 the same as turnleaf read
${described}
  turnleaf film BOOK --out FILE  films a book as its pages turn, as MP4, WebM,
                                 GIF or numbered pictures (turnleaf film --help)
  turnleaf bake --out FILE       writes the turn of a leaf as glTF, OBJ, JSON or
                                 key frames (turnleaf bake --help)
  turnleaf publish BOOK… --out FOLDER
                                 makes a web site of books, with reader, text and
                                 search (turnleaf publish --help)
  turnleaf playground            turns a page by two models side by side

  --port N     serve at this port of this machine (4173, or the next free one)
  --no-open    open no browser
  --version    print the version
  --help       print this
`;

/** The commands with options of their own. */
const commands = new Map<
  string,
  { readonly help: string; readonly parse: (args: readonly string[]) => Command }
>([
  ["film", { help: filmHelp, parse: parseFilm }],
  ["bake", { help: bakeHelp, parse: parseBake }],
  ["publish", { help: publishHelp, parse: parsePublish }],
]);

/**
 * Parses the command line, without the names of Node and of the script.
 *
 * @throws UsageProblem
 */
export function parseCommand(args: readonly string[]): Command {
  // A book whose name is a command's is opened by: turnleaf read film
  const own = commands.get(args[0] ?? "");
  if (own) {
    const [, ...rest] = args;
    const asksHelp = rest.some((arg) => arg === "--help" || arg === "-h");
    if (asksHelp) return { name: "help", text: own.help };
    try {
      return own.parse(rest);
    } catch (error) {
      if (error instanceof UsageProblem) error.help = own.help;
      throw error;
    }
  }
  const { values, positionals } = parse(args);
  if (values.help) return { name: "help", text: help };
  if (values.version) return { name: "version" };
  const serving = { port: parsePort(values.port), opens: !values["no-open"] };
  if (positionals[0] === "playground") {
    if (positionals.length > 1) throw new UsageProblem("The playground takes no book.");
    return { name: "playground", ...serving };
  }
  // A book called "read" is opened by: turnleaf read read
  const books = positionals[0] === "read" ? positionals.slice(1) : positionals;
  if (books.length === 0) {
    throw new UsageProblem("Name a book: a file, a folder of images, or an address.");
  }
  if (books.includes("")) throw new UsageProblem("A book's name is empty.");
  return { name: "read", books, ...serving };
}

function parse(args: readonly string[]): ReturnType<typeof parseOptions> {
  try {
    return parseOptions(args);
  } catch (error) {
    throw usageProblem(error);
  }
}

function parseOptions(args: readonly string[]) {
  return parseArgs({
    args: [...args],
    allowPositionals: true,
    options: {
      port: { type: "string" },
      "no-open": { type: "boolean" },
      help: { type: "boolean", short: "h" },
      version: { type: "boolean", short: "v" },
    },
  });
}

function parsePort(text: string | undefined): number | undefined {
  if (text === undefined) return undefined;
  const port = Number(text);
  if (/^\d{1,5}$/.test(text) && port <= 65535) return port;
  throw new UsageProblem("--port takes a number from 0 to 65535.");
}
