import { appFiles } from "./app_files.ts";
import type { ServeOptions } from "./arguments.ts";
import { Problem } from "./problem.ts";
import { serveUntilStopped } from "./serve_until_stopped.ts";

/**
 * Serves the playground until the command is stopped.
 * @throws Problem before anything is served
 */
export async function playground(options: ServeOptions): Promise<void> {
  const files = await appFiles("playground.html").catch(() => new Map<string, never>());
  if (!files.has("/")) throw new Problem("The playground is not built; run: npm run build");
  await serveUntilStopped(files, options, (url) => `Turnleaf's playground is at ${url}`);
}
