/** The built viewer on a bare page, as a web page that embeds it would have it. */

import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { fileURLToPath } from "node:url";
import { afterEach } from "vitest";

const dist = fileURLToPath(new URL("../../turnleaf/dist/", import.meta.url));
const three = fileURLToPath(new URL("../../../node_modules/three/build/", import.meta.url));

const html = `<!doctype html><title>Book</title><link rel="stylesheet" href="/page.css">
<script type="importmap" nonce="map">{"imports":{"three":"/three/three.module.js"}}</script>
<script type="module" src="/turnleaf/index.js"></script>`;
// Small: drawing is in software here.
const css = "turnleaf-book { width: 120px; height: 90px; min-height: 0 }";

/** A server of the viewer and of what else is given, which counts what it is asked for. */
export interface ViewerSite {
  readonly url: string;
  /** Addresses asked for, in order. */
  readonly asked: string[];
  stop(): Promise<void>;
}

/**
 * Serves the viewer.
 *
 * @param respond what is at an address besides, as `/other.html`; null for nothing
 * @param policy the Content-Security-Policy of HTML
 */
export async function serveViewer(
  respond: (path: string) => Buffer | string | null,
  policy?: string,
): Promise<ViewerSite> {
  const asked: string[] = [];
  const server = createServer((request, response) => {
    const path = new URL(request.url ?? "/", "http://localhost").pathname;
    asked.push(path);
    const file = /^\/(turnleaf|three)\/([\w.-]+)$/.exec(path);
    try {
      const own: Record<string, string> = { "/": html, "/page.css": css, "/favicon.ico": "" };
      const folder = file?.[1] === "three" ? three : dist;
      const body = file ? readFileSync(folder + file[2]) : (own[path] ?? respond(path));
      const isHtml = path === "/" || path.endsWith(".html");
      const type = isHtml ? "html" : path.endsWith(".css") ? "css" : "javascript";
      const isText = file || isHtml || path in own || path.endsWith(".js");
      response.writeHead(body === null ? 404 : 200, {
        "Content-Type": isText ? `text/${type}` : "application/octet-stream",
        ...(policy !== undefined && isHtml && { "Content-Security-Policy": policy }),
        // A page without an origin reads nothing else, not even its own scripts.
        ...(policy?.includes("sandbox") && { "Access-Control-Allow-Origin": "*" }),
      });
      response.end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address() as AddressInfo;
  return {
    url: `http://127.0.0.1:${port}/`,
    asked,
    stop: () =>
      new Promise((resolve) => {
        server.closeAllConnections();
        server.close(() => resolve());
      }),
  };
}

/** Sites for the tests of a file. */
export interface TestSites {
  /** Serves the viewer as {@link serveViewer} does, in place of what the test served before. */
  serve(...site: Parameters<typeof serveViewer>): Promise<ViewerSite>;
}

/** Serves sites to the tests of a file; to be called outside them. After each test its site is stopped. */
export function sitesForTests(): TestSites {
  let site: ViewerSite | undefined;
  const stop = async () => {
    await site?.stop();
    site = undefined;
  };
  afterEach(stop);
  return {
    async serve(...of) {
      await stop();
      site = await serveViewer(...of);
      return site;
    },
  };
}
