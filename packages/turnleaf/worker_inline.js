import { dirname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { Rolldown } from "tsdown";

const prefix = "worker:";
const suffix = ".packed";

/** The name under which a module of a worker's script says which files are within it. */
export const filesInWorker = "turnleaf-files-in-worker";

/**
 * Lets TypeScript import the script of a worker as text, with all that it imports in it:
 * `await import("worker:./a_worker.ts")` yields gzip in base64, which src/packed.ts unpacks. A worker
 * starts from a blob of it, as pdf.js's do, because no other way works in every bundler without
 * configuration. Serves both tsdown and vite, as a plugin of either.
 */
export function workerInline() {
  return {
    name: "turnleaf-worker-inline",
    enforce: "pre",
    resolveId(id, importer) {
      if (!id.startsWith(prefix) || !importer) return null;
      const path = join(dirname(importer.split("?")[0]), id.slice(prefix.length));
      // The zero byte and the ending keep other plugins from taking it for a file of their kind.
      return `\0${prefix}${path}${suffix}`;
    },
    async load(id) {
      if (!id.startsWith(`\0${prefix}`)) return null;
      const input = id.slice(prefix.length + 1, -suffix.length);
      const { output } = await Rolldown.build({
        input,
        platform: "browser",
        // Its paths lead to types.
        tsconfig: false,
        write: false,
        transform: { target: "es2022" },
        output: { format: "esm", minify: true },
      });
      // The bundler's own modules are no files.
      const files = output[0].moduleIds.filter((id) => !id.startsWith("\0"));
      for (const file of files) this.addWatchFile(file);
      const base64 = gzipSync(output[0].code, { level: 9 }).toString("base64");
      const code = `export default ${JSON.stringify(base64)};`;
      return { code, moduleType: "js", map: null, meta: { [filesInWorker]: files } };
    },
  };
}
