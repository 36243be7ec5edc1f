import { appFiles } from "./app_files.ts";
import type { ServeOptions } from "./arguments.ts";
import { openBook } from "./book.ts";
import { Problem } from "./problem.ts";
import { serveUntilStopped } from "./serve_until_stopped.ts";

/**
 * Serves the book at `path` with the reader until the command is stopped.
 * @throws Problem before anything is served
 */
export async function read(path: string, options: ServeOptions): Promise<void> {
  const book = await openBook(path, (sentence) => console.error(sentence));
  const app = await appFiles("index.html").catch(() => new Map<string, never>());
  if (!app.has("/")) throw new Problem("The reader is not built; run: npm run build");
  const config = JSON.stringify({ src: book.src, title: book.title });
  const files = new Map([
    ...app,
    ...book.files,
    ["/config.json", { type: "application/json", text: config }] as const,
  ]);
  await serveUntilStopped(files, options, (url) => `Turnleaf is reading ${book.title} at ${url}`);
}
