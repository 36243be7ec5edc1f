/** A plain web server of a folder, as published sites are served, which counts what it is asked for. */

import { readFile, stat } from "node:fs/promises";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";

const types: Readonly<Record<string, string>> = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".json": "application/json",
  ".jpg": "image/jpeg",
  ".webp": "image/webp",
  ".pdf": "application/pdf",
  ".webmanifest": "application/manifest+json",
};

/** A server of a site. */
export interface SiteServer {
  readonly url: string;
  /** Addresses asked for, in order. */
  readonly asked: string[];
  stop(): Promise<void>;
}

/** Serves a folder below a path, as most sites lie below one. */
export async function serveSite(folder: string, below = "/library/"): Promise<SiteServer> {
  const asked: string[] = [];
  const server = createServer(async (request, response) => {
    const address = decodeURIComponent((request.url ?? "/").split("?", 1)[0] ?? "/");
    asked.push(request.url ?? "");
    try {
      if (!address.startsWith(below)) throw new Error("outside");
      let file = join(folder, normalize(`/${address.slice(below.length)}`));
      if ((await stat(file)).isDirectory()) file = join(file, "index.html");
      const body = await readFile(file);
      response.writeHead(200, { "Content-Type": types[extname(file)] ?? "text/plain" }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address() as AddressInfo;
  return {
    url: `http://127.0.0.1:${port}${below}`,
    asked,
    stop: () =>
      new Promise((resolve) => {
        server.closeAllConnections();
        server.close(() => resolve());
      }),
  };
}
