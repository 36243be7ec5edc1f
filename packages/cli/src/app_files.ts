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

/** The reader app's built files by their addresses; its page is at "/". */
export async function appFiles(): Promise<Map<string, ServedFile>> {
  const root = fileURLToPath(new URL("./app/", import.meta.url));
  const files = new Map<string, ServedFile>();
  for (const entry of await readdir(root, { recursive: true, withFileTypes: true })) {
    const type = types[entry.name.split(".").pop() ?? ""];
    if (!entry.isFile() || !type) continue;
    const path = join(entry.parentPath, entry.name);
    const address = `/${path.slice(root.length).split(sep).join("/")}`;
    files.set(address === "/index.html" ? "/" : address, { type, path });
  }
  return files;
}
