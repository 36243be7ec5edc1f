import { readdir, readFile, stat } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { readingWorker, withChanges } from "./changed_pdf_worker.js";

const prefix = "packed:";
const suffix = ".packed";
const require = createRequire(import.meta.url);

/**
 * Lets TypeScript import a file, or a whole folder, of an npm package as text:
 * `await import("packed:pdfjs-dist/wasm/jbig2.wasm")` yields gzip in base64. A
 * lazy import of a module is the one kind of asset that every bundler, and a
 * browser without one, finds with nothing to configure. A folder (its id ends
 * in "/") becomes one file: a 4-byte little-endian length, a JSON table {name:
 * [offset, length]} of that length, and the files' bytes. Serves both tsdown
 * and vite, as a plugin of either.
 */
export function packedFiles() {
  return {
    name: "turnleaf-packed-files",
    enforce: "pre",
    resolveId(id) {
      // The zero byte and the ending keep other plugins from taking it for a file of their kind.
      return id.startsWith(prefix) ? `\0${id.replace(/\/$/, "")}${suffix}` : null;
    },
    async load(id) {
      const path = packedFile(id);
      if (path === null) return null;
      const isFolder = (await stat(path)).isDirectory();
      const bytes = isFolder ? await packFolder(path) : await readWhole(path);
      const base64 = gzipSync(bytes, { level: 9 }).toString("base64");
      return { code: `export default ${JSON.stringify(base64)};`, moduleType: "js", map: null };
    },
  };
}

/** Returns the path of the file or folder that a module is the packed form of; null for any other module. */
export function packedFile(id) {
  const isPacked = id.startsWith(`\0${prefix}`) && id.endsWith(suffix);
  return isPacked ? locate(id.slice(prefix.length + 1, -suffix.length)) : null;
}

/** Packages that list no `exports` for their files are found through package.json. */
function locate(path) {
  const [, name, rest] = /^((?:@[^/]+\/)?[^/]+)\/?(.*)$/.exec(path);
  return join(dirname(require.resolve(`${name}/package.json`)), rest);
}

/** Returns a file as the package has it; pdf.js's worker as it finds all pages. */
async function readWhole(path) {
  const bytes = await readFile(path);
  return path.endsWith(readingWorker) ? withChanges(bytes.toString()) : bytes;
}

async function packFolder(folder) {
  const names = (await readdir(folder)).filter((name) => !name.startsWith("LICENSE")).sort();
  const files = await Promise.all(names.map((name) => readFile(join(folder, name))));
  let offset = 0;
  const table = Object.fromEntries(
    files.map((file, i) => {
      offset += file.length;
      return [names[i], [offset - file.length, file.length]];
    }),
  );
  const head = Buffer.from(JSON.stringify(table));
  const length = Buffer.alloc(4);
  length.writeUInt32LE(head.length);
  return Buffer.concat([length, head, ...files]);
}
