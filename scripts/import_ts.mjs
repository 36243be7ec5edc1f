/** Loads a TypeScript file of the viewer that imports nothing of a browser. */
import { join } from "node:path";
import { runnerImport } from "vite";

const sources = join(import.meta.dirname, "../packages/turnleaf/src");

/**
 * Returns the exports of a file.
 *
 * @param path in packages/turnleaf/src
 */
export async function importTs(path) {
  const { module } = await runnerImport(join(sources, path), {
    configFile: false,
    logLevel: "error",
  });
  return module;
}
