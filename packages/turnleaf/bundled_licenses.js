import { readdir, readFile, stat } from "node:fs/promises";
import { dirname, join } from "node:path";
import { packedFile } from "./packed_files.js";
import { filesInWorker } from "./worker_inline.js";

/**
 * Writes the licences of all packages of which something is in the built files, as code or packed, into
 * `licenses.txt` beside them. A plugin of tsdown.
 */
export function bundledLicenses() {
  return {
    name: "turnleaf-bundled-licenses",
    async generateBundle(_, bundle) {
      const folders = new Set();
      for (const { moduleIds = [] } of Object.values(bundle)) {
        for (const id of moduleIds) {
          const within = this.getModuleInfo(id)?.meta[filesInWorker] ?? [];
          for (const file of [id, ...within]) {
            for (const folder of await foldersOf(file)) folders.add(folder);
          }
        }
      }
      if (folders.size === 0) return;
      const source = await licensesIn([...folders].sort());
      this.emitFile({ type: "asset", fileName: "licenses.txt", source });
    },
  };
}

/** Returns the folders with the licences of a module; none of a module of this package, and of types. */
async function foldersOf(id) {
  const packed = packedFile(id);
  const path = packed ?? id.replace(/^\0|\?.*$/g, "");
  const [root] = /.*node_modules[\\/](?:@[^\\/]+[\\/])?[^\\/]+/.exec(path) ?? [];
  if (root === undefined || /\.d\.[cm]?ts$/.test(path)) return [];
  if (packed === null) return [root];
  return [root, (await stat(packed)).isDirectory() ? packed : dirname(packed)];
}

/** Returns the licences that lie in some folders, each under its path. */
async function licensesIn(folders) {
  const texts = [];
  for (const folder of folders) {
    const names = (await readdir(folder)).filter((name) => /^LICEN[CS]E/i.test(name)).sort();
    for (const name of names) {
      const title = join(folder, name)
        .split(/node_modules[\\/]/)
        .pop();
      const text = await readFile(join(folder, name), "utf8");
      texts.push(`${title}\n${"=".repeat(title.length)}\n\n${text.trim()}\n`);
    }
  }
  return texts.join("\n\n");
}
