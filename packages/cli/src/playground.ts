import { appFiles } from "./app_files.ts";
import type { ServeOptions } from "./arguments.ts";
import { Problem } from "./problem.ts";
import { serveUntilStopped } from "./serve_until_stopped.ts";

/**
 * Serves the playground until `signal` aborts.
 * @throws Problem before anything is served
 */
export async function playground(options: ServeOptions, signal: AbortSignal): Promise<void> {
  const files = await appFiles("playground.html").catch(() => new Map<string, never>());
  if (!files.has("/")) throw new Problem("The playground is not built; run: npm run build");
  const announce = (url: string): string => `Turnleaf's playground is at ${url}`;
  await serveUntilStopped({ files, announce }, options, signal);
}
