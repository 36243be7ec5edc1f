/**
 * Serves the examples as a careful site would: only what they need, under a
 * strict Content-Security-Policy.
 *
 *   node examples/serve.mjs [port]
 */
import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { pathToFileURL } from "node:url";

const root = join(import.meta.dirname, "..");
const served = /^\/(examples|books|packages\/turnleaf\/dist|node_modules\/three\/build)\/[^\\]+$/;
const types = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json",
  ".pdf": "application/pdf",
  ".webp": "image/webp",
};

/** The policy of a page: nothing inline but its import map, which is named by its hash. */
function policyFor(html) {
  const [, map = ""] = /<script type="importmap">(.*?)<\/script>/s.exec(html) ?? [];
  const hash = createHash("sha256").update(map).digest("base64");
  return [
    "default-src 'none'",
    `script-src 'self' 'wasm-unsafe-eval' 'sha256-${hash}'`,
    "worker-src 'self' blob:",
    "style-src 'self'",
    "img-src 'self' blob: data:",
    "connect-src 'self'",
    "base-uri 'none'",
    "form-action 'none'",
  ].join("; ");
}

async function respond(request, response) {
  // An address such as /../secret is made plain by URL before it is looked at. Put
  // together, as //host would be another host, and // none.
  const address = `http://localhost${request.url}`;
  if (!request.url?.startsWith("/") || !URL.canParse(address)) {
    return response.writeHead(400).end();
  }
  const { pathname } = new URL(address);
  if (pathname === "/") return response.writeHead(302, { Location: "/examples/" }).end();
  const path = pathname === "/examples/" ? "/examples/index.html" : pathname;
  const type = types[extname(path)];
  if (!served.test(path) || type === undefined) return response.writeHead(404).end();
  const body = await readFile(join(root, path)).catch(() => null);
  if (body === null) return response.writeHead(404).end();
  response.writeHead(200, {
    "Content-Type": type,
    "Cache-Control": "no-cache",
    "X-Content-Type-Options": "nosniff",
    ...(type.startsWith("text/html") && { "Content-Security-Policy": policyFor(body.toString()) }),
  });
  response.end(body);
}

/** Serves the examples to this machine alone; port 0 takes any that is free. */
export async function serve(port = 0) {
  const server = createServer((request, response) => {
    respond(request, response).catch(() => response.destroy());
  });
  await new Promise((resolve, reject) => {
    server.once("error", reject);
    server.listen(port, "127.0.0.1", resolve);
  });
  return {
    url: `http://127.0.0.1:${server.address().port}/examples/`,
    stop: () =>
      new Promise((resolve) => {
        server.close(resolve);
        server.closeAllConnections();
      }),
  };
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? "").href) {
  const { url } = await serve(Number(process.argv[2] ?? 8080));
  console.log(`The examples are at ${url} (Ctrl+C ends)`);
}
