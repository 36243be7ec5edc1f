import type { ServeOptions } from "./arguments.ts";
import type { ServedFile } from "./book.ts";
import { openBrowser } from "./browser.ts";
import { serve } from "./server.ts";

/**
 * Serves files, prints the address, and opens the browser, until the command is
 * stopped.
 *
 * @param announce returns the line that says what is served at an address
 * @throws Problem if nothing can be served
 */
export async function serveUntilStopped(
  files: ReadonlyMap<string, ServedFile>,
  { port, opens }: ServeOptions,
  announce: (url: string) => string,
): Promise<void> {
  const serving = await serve(files, port);
  const ending = stopped();
  console.log(announce(serving.url));
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
