/** Invalid addresses, and those that lead elsewhere: both servers reject them and go on. */
import { connect } from "node:net";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { serve as serveExamples } from "../../../examples/serve.mjs";
import { serve } from "../src/server.ts";
import { ask } from "./command.ts";

const addresses = [
  ...["//", "///", "//x", "//x/y", "//[", "//:0", "//%00", "/\\", "/\\\\x", "*", "?", "#"],
  ...["http://", "http://[", "http://x:99999/", "https://example.org/x", "javascript:1"],
  ...["/%", "/%00", "/%zz", "/..", "/../..", "/%2e%2e/%2e%2e/etc/passwd"],
  ...["/examples/../package.json", "/examples/..%2f..%2fetc%2fpasswd", "/examples/%2e%2e/Makefile"],
  ...[
    "/books/../../../../etc/passwd.html",
    "/examples/\\..\\..\\package.json",
    "/examples/x\0.html",
  ],
  ...[`/${"a/".repeat(3000)}`, `/examples/${"%41".repeat(2000)}.html`, "/examples/.html"],
];

/**
 * Returns the status of the response to a raw request line, or null if the
 * connection is closed.
 */
function statusOf(port: number, address: string): Promise<number | null> {
  return new Promise((resolve, reject) => {
    const socket = connect(port, "127.0.0.1");
    let text = "";
    socket.on("data", (data) => {
      text += data.toString("latin1");
    });
    socket.on("error", reject);
    socket.on("close", () => {
      const status = /^HTTP\/1\.1 (\d{3})/.exec(text)?.[1];
      resolve(status === undefined ? null : Number(status));
    });
    socket.end(`GET ${address} HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nConnection: close\r\n\r\n`);
  });
}

/** Returns addresses by a seed, made of pieces that have broken other servers. */
function invented(seed: number): string {
  const pieces = ["/", "//", ".", "..", "%2e", "%2f", "%00", "%", "\\", ":", "@", "[", "]", "?"];
  const words = ["examples", "books", "index.html", "node_modules", "http:", "localhost", "é", "#"];
  const all = [...pieces, ...words];
  let state = seed;
  const next = (below: number): number => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * below);
  };
  return `/${Array.from({ length: 1 + next(8) }, () => all[next(all.length)]).join("")}`;
}

const seeds = Array.from({ length: 200 }, (_, seed) => seed + 1);

describe("the server of the examples", () => {
  let site: Awaited<ReturnType<typeof serveExamples>>;
  let port: number;
  beforeAll(async () => {
    site = await serveExamples();
    port = Number(new URL(site.url).port);
  });
  afterAll(() => site.stop());

  it("rejects what is no address of its own, and goes on", async () => {
    for (const address of addresses) {
      expect([null, 302, 400, 404], address).toContain(await statusOf(port, address));
    }
    for (const seed of seeds) {
      const status = await statusOf(port, invented(seed));
      expect([null, 200, 302, 400, 404], `seed ${seed}: ${invented(seed)}`).toContain(status);
    }
    expect((await ask(port, "/examples/")).status).toBe(200);
  });
});

describe("the server of the command", () => {
  it("rejects what is not a key of its files, and goes on", async () => {
    const page = { type: "text/html", text: "<!doctype html>" };
    const serving = await serve(new Map([["/", page]]), 0);
    const port = Number(new URL(serving.url).port);
    for (const address of addresses) {
      const expected = address === "?" ? [400, 404] : [null, 400, 404];
      expect(expected, address).toContain(await statusOf(port, address));
    }
    for (const seed of seeds) {
      const status = await statusOf(port, invented(seed));
      expect([null, 200, 400, 404], `seed ${seed}: ${invented(seed)}`).toContain(status);
    }
    expect((await ask(port, "/")).body.toString()).toBe(page.text);
    await serving.close();
  });
});
