import { once } from "node:events";
import { readdirSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { type AddressInfo, connect } from "node:net";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { jpegHead, pdf, png } from "./books.ts";
import {
  ask,
  folderOf,
  type Reply,
  run,
  runWithChromium,
  type Started,
  signalOnce,
  start,
} from "./command.ts";

const book = pdf(3, "A Small Book", 300_000);

describe("a PDF", () => {
  let folder: ReturnType<typeof folderOf>;
  let served: Started;
  const address = "/book/my%20book.pdf";
  const get = (path: string, headers: Record<string, string> = {}): Promise<Reply> =>
    ask(served.port, path, { headers });

  beforeAll(async () => {
    folder = folderOf({ "my book.pdf": book, "secret.txt": "not for you" });
    served = await start(join(folder.path, "my book.pdf"), "--port", "0");
  });
  afterAll(async () => {
    await served.stop();
    folder.remove();
  });

  it("is announced by its title, with how to stop", () => {
    expect(served.stdout).toBe(
      `Turnleaf is reading A Small Book at ${served.url}\nPress Ctrl+C to stop.\n`,
    );
    expect(served.url).toBe(`http://127.0.0.1:${served.port}/`);
    expect(served.stderr()).toBe("");
  });

  it("comes with a reader that knows where it is", async () => {
    const page = await get("/");
    expect(page.status).toBe(200);
    expect(page.headers["content-type"]).toBe("text/html; charset=utf-8");
    expect(page.body.toString()).toContain("<title>Turnleaf</title>");
    const config = JSON.parse((await get("/config.json")).body.toString());
    expect(config).toEqual({ books: [{ src: address, title: "A Small Book" }] });
    const script = /src="\.?(\/assets\/[^"]+\.js)"/.exec(page.body.toString())?.[1] ?? "";
    expect((await get(script)).headers["content-type"]).toContain("text/javascript");
  });

  it("is sent whole, byte by byte", async () => {
    const reply = await get(address);
    expect(reply.status).toBe(200);
    expect(reply.headers).toMatchObject({
      "content-type": "application/pdf",
      "content-length": String(book.length),
      "accept-ranges": "bytes",
    });
    expect(reply.body.equals(book)).toBe(true);
  });

  it("tells its length to HEAD and sends nothing", async () => {
    const reply = await ask(served.port, address, { method: "HEAD" });
    expect(reply.status).toBe(200);
    expect(reply.headers["content-length"]).toBe(String(book.length));
    expect(reply.body.length).toBe(0);
  });

  it.each([
    ["bytes=0-1023", 0, 1023],
    ["bytes=1000-1000", 1000, 1000],
    ["bytes=5-", 5, book.length - 1],
    ["bytes=-7", book.length - 7, book.length - 1],
    ["bytes=-99999999", 0, book.length - 1],
    [`bytes=10-${book.length + 5}`, 10, book.length - 1],
  ])("is sent in part: %s", async (range, from, to) => {
    const reply = await get(address, { Range: range });
    expect(reply.status).toBe(206);
    expect(reply.headers["content-range"]).toBe(`bytes ${from}-${to}/${book.length}`);
    expect(reply.headers["content-length"]).toBe(String(to - from + 1));
    expect(reply.body.equals(book.subarray(from, to + 1))).toBe(true);
  });

  it.each([`bytes=${book.length}-`, "bytes=99999999-999999999", "bytes=-0"])(
    "has nothing at %s",
    async (range) => {
      const reply = await get(address, { Range: range });
      expect(reply.status).toBe(416);
      expect(reply.headers["content-range"]).toBe(`bytes */${book.length}`);
    },
  );

  it.each([
    "bytes=5-2",
    "bytes=0-1,4-5",
    "bytes=x",
    "pages=1-2",
    "bytes=-",
    `bytes=${"9".repeat(99)}-`,
  ])("is sent whole where a range cannot be read: %s", async (range) => {
    expect((await get(address, { Range: range })).status).toBe(200);
  });

  it("is sent whole where the range was meant for another version", async () => {
    const tag = (await get(address)).headers.etag as string;
    const meant = { Range: "bytes=0-9", "If-Range": tag };
    expect((await get(address, meant)).status).toBe(206);
    expect((await get(address, { ...meant, "If-Range": '"old"' })).status).toBe(200);
  });

  it("is sent to nobody who calls the server by another name", async () => {
    for (const host of [
      "evil.example",
      `evil.example:${served.port}`,
      "127.0.0.1",
      "127.0.0.1:1",
    ]) {
      expect((await get(address, { Host: host })).status, host).toBe(403);
      expect((await get("/", { Host: host })).status, host).toBe(403);
    }
    expect((await get(address, { Host: `localhost:${served.port}` })).status).toBe(200);
  });

  it("responds only to GET and HEAD", async () => {
    for (const method of ["POST", "PUT", "DELETE", "OPTIONS", "PATCH"]) {
      const reply = await ask(served.port, address, { method });
      expect(reply.status, method).toBe(405);
      expect(reply.headers.allow).toBe("GET, HEAD");
    }
  });

  it.each([
    "/secret.txt",
    "/book/secret.txt",
    "/book/../secret.txt",
    "/book/%2e%2e/secret.txt",
    "/book/..%2fsecret.txt",
    "/book/..%5csecret.txt",
    "/../../../../etc/passwd",
    "/..%2f..%2f..%2fetc/passwd",
    "//etc/passwd",
    "/book//etc/passwd",
    "/assets/../main.js",
    "/assets/%2e%2e/%2e%2e/main.js",
    "/package.json",
    "/index.html",
    "/book/my book.pdf\0",
    "/__proto__",
    "/constructor",
    "file:///etc/passwd",
    "http://127.0.0.1/config.json",
    "*",
  ])("gives nothing else away: %s", async (path) => {
    const reply = await rawGet(served.port, path);
    expect(reply).toMatch(/^HTTP\/1\.1 (404|400) /);
    expect(reply).not.toContain("not for you");
    expect(reply).not.toContain("root:");
  });

  it("sends every response with the same strict headers", async () => {
    for (const path of ["/", "/config.json", address, "/nothing"]) {
      const { headers } = await get(path);
      expect(headers["x-content-type-options"]).toBe("nosniff");
      expect(headers["referrer-policy"]).toBe("no-referrer");
      expect(headers["cross-origin-resource-policy"]).toBe("same-origin");
      const policy = headers["content-security-policy"];
      expect(policy).toContain("default-src 'none'");
      expect(policy).toContain("script-src 'self' 'wasm-unsafe-eval';");
      expect(policy).toContain("frame-ancestors 'none'");
      expect(headers["access-control-allow-origin"]).toBeUndefined();
    }
  });

  it("survives a client that breaks off in the middle", async () => {
    for (let i = 0; i < 5; i++) {
      const socket = connect(served.port, "127.0.0.1");
      socket.on("error", () => {});
      socket.write(`GET ${address} HTTP/1.1\r\nHost: 127.0.0.1:${served.port}\r\n\r\n`);
      await once(socket, "data");
      socket.destroy();
    }
    expect((await get(address)).status).toBe(200);
    expect(served.stderr()).toBe("");
  });

  it("listens to this machine alone", async () => {
    const probe = createServer().listen(0, "127.0.0.2");
    const free = await once(probe, "listening").then(
      () => true,
      () => false,
    );
    if (free) probe.close();
    const socket = connect(served.port, "127.0.0.2");
    const rejected = await new Promise((resolve) => {
      socket.once("connect", () => resolve(false));
      socket.once("error", () => resolve(true));
    });
    socket.destroy();
    expect(rejected).toBe(true);
  });
});

/** Sends a path that no client would. Returns the whole response. */
async function rawGet(port: number, path: string): Promise<string> {
  const socket = connect(port, "127.0.0.1");
  socket.write(`GET ${path} HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nConnection: close\r\n\r\n`);
  let text = "";
  for await (const part of socket) text += part;
  return text;
}

describe("a folder", () => {
  it("is read in the natural order of its names, with sizes, and nothing but images", async () => {
    const folder = folderOf({
      "page 10.png": png(30, 40),
      "page 9.PNG": png(10, 20),
      "page 1.jpg": jpegHead(60, 40, 6),
      "page 2.svg": "<svg><script>alert(1)</script></svg>",
      ".hidden.png": png(1, 1),
      "notes.txt": "x",
      "deeper/page 3.png": png(1, 1),
      "torn.webp": "RIFF",
    });
    const served = await start(folder.path, "--port", "0");
    const config = JSON.parse((await ask(served.port, "/config.json")).body.toString());
    const reply = await ask(served.port, config.books[0].src);
    expect(reply.headers["content-type"]).toBe("application/json");
    const manifest = JSON.parse(reply.body.toString());
    expect(manifest.pages).toEqual([
      { src: "../pages/1/page%201.jpg", width: 40, height: 60 },
      { src: "../pages/2/page%209.PNG", width: 10, height: 20 },
      { src: "../pages/3/page%2010.png", width: 30, height: 40 },
      { src: "../pages/4/torn.webp" },
    ]);
    const image = await ask(served.port, "/pages/3/page%2010.png");
    expect(image.headers["content-type"]).toBe("image/png");
    expect(image.body.equals(png(30, 40))).toBe(true);
    await served.stop();
    folder.remove();
  });

  it("with one PDF opens that", async () => {
    const folder = folderOf({ "book.pdf": pdf(), "notes.txt": "x", "cover.png": png(3, 4) });
    const served = await start(folder.path, "--port", "0");
    expect(served.stdout).toContain("Turnleaf is reading A Small Book at ");
    await served.stop();
    folder.remove();
  });

  it("leaves out links that lead out of it, and says so", async () => {
    const outside = folderOf({ "private.png": png(5, 5) });
    const folder = folderOf({ "1.png": png(3, 4), "inner.png": png(3, 4) });
    symlinkSync(join(outside.path, "private.png"), join(folder.path, "2.png"));
    symlinkSync(join(folder.path, "inner.png"), join(folder.path, "3.png"));
    symlinkSync(join(folder.path, "4.png"), join(folder.path, "4.png"));
    const served = await start(folder.path, "--port", "0");
    const config = JSON.parse((await ask(served.port, "/config.json")).body.toString());
    const manifest = JSON.parse((await ask(served.port, config.books[0].src)).body.toString());
    expect(manifest.pages.length).toBe(3);
    expect(served.stderr()).toContain(
      "2.png is a link that leads out of the folder; it is left out.",
    );
    expect(served.stderr()).toContain("4.png is a link that leads to itself");
    await served.stop();
    outside.remove();
    folder.remove();
  });

  it("does not follow a link that is put in a page's place later", async () => {
    const outside = folderOf({ "private.png": "not for you" });
    const folder = folderOf({ "1.png": png(3, 4), "2.png": png(3, 4) });
    const served = await start(folder.path, "--port", "0");
    rmSync(join(folder.path, "1.png"));
    symlinkSync(join(outside.path, "private.png"), join(folder.path, "1.png"));
    rmSync(join(folder.path, "2.png"));
    expect((await ask(served.port, "/pages/1/1.png")).status).toBe(404);
    expect((await ask(served.port, "/pages/2/2.png")).status).toBe(404);
    writeFileSync(join(folder.path, "2.png"), png(7, 7));
    expect((await ask(served.port, "/pages/2/2.png")).status).toBe(200);
    await served.stop();
    outside.remove();
    folder.remove();
  });
});

describe("a command that serves", () => {
  it.each(["SIGINT", "SIGTERM"] as const)(
    "stops cleanly at %s, open connections or not",
    async (signal) => {
      const folder = folderOf({ "1.png": png(3, 4) });
      const served = await start(folder.path, "--port", "0");
      const socket = connect(served.port, "127.0.0.1");
      socket.on("error", () => {});
      await once(socket, "connect");
      const ended = await served.stop(signal);
      expect(ended).toMatchObject({ status: 0, signal: null, stderr: "" });
      folder.remove();
    },
  );

  it.each(["SIGINT", "SIGTERM"] as const)("ends at %s, however busy it is", async (signal) => {
    const folder = folderOf({
      // Once it has fetched the book, looks at its first words for ever.
      "busy.cjs": `const { trimStart } = String.prototype;
        const { readdirSync, writeSync } = require("fs");
        String.prototype.trimStart = function () {
          const names = readdirSync(process.env.TMPDIR);
          if (!names.some((name) => name.startsWith("turnleaf-read-"))) return trimStart.call(this);
          for (writeSync(2, "busy"); ; );
        };`,
    });
    const site = createServer((_, response) => response.end("Call me Ishmael."));
    await once(site.listen(0, "127.0.0.1"), "listening");
    const address = `http://127.0.0.1:${(site.address() as AddressInfo).port}/book.txt`;
    const options = {
      NODE_OPTIONS: `--require=${join(folder.path, "busy.cjs")}`,
      ...{ TMPDIR: folder.path, TEMP: folder.path },
    };
    let said = "";
    let kept: readonly string[] = [];
    const ended = await runWithChromium(
      ["read", address, "--no-open"],
      (child) => {
        child.stderr?.on("data", (data) => {
          said += data;
          kept = readdirSync(folder.path);
        });
        signalOnce(child, () => said.includes("busy"), signal);
      },
      options,
    );
    expect(ended).toMatchObject({ status: null, signal, stdout: "" });
    // What it had fetched is gone.
    expect(kept).toContainEqual(expect.stringMatching(/^turnleaf-read-/));
    expect(readdirSync(folder.path)).toEqual(["busy.cjs"]);
    site.close();
    folder.remove();
  });

  it("says when its port is taken, and takes another when it may", async () => {
    const folder = folderOf({ "1.png": png(3, 4) });
    const other = createServer().listen(0, "127.0.0.1");
    await once(other, "listening");
    const { port } = other.address() as AddressInfo;
    const ended = await run("read", folder.path, "--port", String(port));
    expect(ended).toMatchObject({
      status: 1,
      stdout: "",
      stderr: `Port ${port} is taken; choose another with --port, or leave --port out.\n`,
    });
    other.close();
    const first = await start(folder.path);
    const second = await start(folder.path);
    expect(second.port).toBeGreaterThan(first.port);
    await first.stop();
    await second.stop();
    folder.remove();
  });
});
