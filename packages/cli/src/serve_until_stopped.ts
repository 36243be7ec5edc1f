import { once } from "node:events";
import type { ServeOptions } from "./arguments.ts";
import type { ServedFile } from "./book.ts";
import { openBrowser } from "./browser.ts";
import { serve, type TakeReport } from "./server.ts";

/** What is served, and how it is announced. */
export interface ServedSite {
  readonly files: ReadonlyMap<string, ServedFile>;
  /** Directives of the pages' Content-Security-Policy; the default is the reader's. */
  readonly policy?: readonly string[];
  /** Takes what its pages report. */
  readonly report?: TakeReport;
  /** Returns the line that says what is served at an address. */
  announce(url: string): string;
}

/**
 * Serves files, prints the address, and opens the browser, until `signal`
 * aborts.
 *
 * @throws Problem if nothing can be served
 */
export async function serveUntilStopped(
  { files, policy, report, announce }: ServedSite,
  { port, opens }: ServeOptions,
  signal: AbortSignal,
): Promise<void> {
  const serving = await serve(files, port, policy, report);
  console.log(announce(serving.url));
  console.log("Press Ctrl+C to stop.");
  if (opens) openBrowser(serving.url);
  if (!signal.aborted) await once(signal, "abort");
  await serving.close();
}
