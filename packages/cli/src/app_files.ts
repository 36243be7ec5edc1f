import { readdir } from "node:fs/promises";
import { join, sep } from "node:path";
import { fileURLToPath } from "node:url";
import type { ServedFile } from "./book.ts";

const types: Readonly<Record<string, string>> = {
  html: "text/html; charset=utf-8",
  js: "text/javascript; charset=utf-8",
  css: "text/css; charset=utf-8",
  svg: "image/svg+xml",
  wasm: "application/wasm",
};

/**
 * Returns the built pages and what they load, by their addresses.
 *
 * @param page the name of the one that is at "/"
 */
export async function appFiles(page: string): Promise<Map<string, ServedFile>> {
  const root = fileURLToPath(new URL("./app/", import.meta.url));
  const files = new Map<string, ServedFile>();
  for (const entry of await readdir(root, { recursive: true, withFileTypes: true })) {
    const type = types[entry.name.split(".").pop() ?? ""];
    if (!entry.isFile() || !type) continue;
    const path = join(entry.parentPath, entry.name);
    const address = `/${path.slice(root.length).split(sep).join("/")}`;
    files.set(address === `/${page}` ? "/" : address, { type, path });
  }
  return files;
}
