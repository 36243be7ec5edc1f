import { appFiles } from "./app_files.ts";
import { openBook } from "./book.ts";
import { openBrowser } from "./browser.ts";
import { Problem } from "./problem.ts";
import { serve } from "./server.ts";

/**
 * Serves the book at `path` with the reader until the command is stopped.
 * @throws Problem before anything is served
 */
export async function read(path: string, port: number | undefined, opens: boolean): Promise<void> {
  const book = await openBook(path, (sentence) => console.error(sentence));
  const app = await appFiles().catch(() => new Map<string, never>());
  if (!app.has("/")) throw new Problem("The reader is not built; run: npm run build");
  const config = JSON.stringify({ src: book.src, title: book.title });
  const files = new Map([
    ...app,
    ...book.files,
    ["/config.json", { type: "application/json", text: config }] as const,
  ]);
  const serving = await serve(files, port);
  const ending = stopped();
  console.log(`Turnleaf is reading ${book.title} at ${serving.url}`);
  console.log("Press Ctrl+C to stop.");
  if (opens) openBrowser(serving.url);
  await ending;
  await serving.close();
}

/** Resolves when the user or the system asks the command to end. */
function stopped(): Promise<void> {
  return new Promise((resolve) => {
    for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"] as const) process.once(signal, resolve);
  });
}
