/** Books at addresses: fetched by the command, but for a IIIF manifest, which the browser fetches. */

import { once } from "node:events";
import { readdirSync } from "node:fs";
import { createServer, type RequestListener, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { gzipSync } from "node:zlib";
import { afterAll, afterEach, beforeAll, describe, expect, it, onTestFinished, vi } from "vitest";
import { fetchAddress } from "../src/read/fetch_address.ts";
import { type CollectionWeb, iiifBooks } from "../src/read/iiif_books.ts";
import { isInnerPlace } from "../src/read/network.ts";
import { page as coloured, pdf } from "./books.ts";
import { chromiumForTests } from "./browser.ts";
import { ask, folderOf, run, type Started, start } from "./command.ts";

const context = "http://iiif.io/api/presentation/3/context.json";

let server: Server;
let base: string;
/** What the server does, by the path of the request. */
const responses = new Map<string, RequestListener>();
const running: Started[] = [];

const send =
  (body: string | Buffer, headers: Record<string, string> = {}): RequestListener =>
  (_, response) => {
    response.writeHead(200, { "Access-Control-Allow-Origin": "*", ...headers }).end(body);
  };

const json = (value: unknown): RequestListener =>
  send(JSON.stringify(value), { "Content-Type": "application/json" });

function manifest(label: string): Record<string, unknown> {
  return {
    ...{ "@context": context, id: `${base}iiif/a/manifest.json`, type: "Manifest" },
    label: { de: ["Ein Buch"], en: [label] },
    items: [1, 2].map((number) => ({
      ...{ id: `${base}canvas/${number}`, type: "Canvas", width: 64, height: 96 },
      items: [
        {
          type: "AnnotationPage",
          items: [
            {
              ...{ type: "Annotation", motivation: "painting" },
              body: { id: `${base}${number}.png`, type: "Image", format: "image/png" },
              target: `${base}canvas/${number}`,
            },
          ],
        },
      ],
    })),
  };
}

beforeAll(async () => {
  server = createServer((request, response) => {
    const respond = responses.get(request.url ?? "");
    if (respond) respond(request, response);
    else response.writeHead(404).end();
  });
  server.listen(0, "127.0.0.1");
  await once(server, "listening");
  base = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
});
afterAll(() => {
  server.closeAllConnections();
  server.close();
});
afterEach(async () => {
  for (const served of running.splice(0)) await served.stop();
  responses.clear();
});

async function serve(...names: string[]): Promise<Started> {
  const served = await start(...names, "--port", "0");
  running.push(served);
  return served;
}

describe("a book at an address", () => {
  it("is fetched, through a redirect too, served from this machine, and removed at the end", async () => {
    const book = pdf(3, "A Far Book");
    responses.set("/b/far%20book.pdf", send(gzipSync(book), { "Content-Encoding": "gzip" }));
    responses.set("/go", (_, response) =>
      response.writeHead(302, { Location: "/b/far%20book.pdf" }).end(),
    );
    const temporary = folderOf({});
    onTestFinished(() => {
      vi.unstubAllEnvs();
      temporary.remove();
    });
    // For this test alone: a browser that others launch has its profile there and outlives the folder.
    vi.stubEnv("TMPDIR", temporary.path);
    const served = await serve(`${base}go`);
    expect(served.stdout).toContain("Turnleaf is reading A Far Book at ");
    const { books } = JSON.parse((await ask(served.port, "/config.json")).body.toString());
    expect(books).toEqual([{ src: "/book/far%20book.pdf", title: "A Far Book" }]);
    const reply = await ask(served.port, "/book/far%20book.pdf");
    expect(reply.body.equals(book)).toBe(true);
    expect(reply.headers["content-security-policy"]).toContain("connect-src 'self';");
    expect(readdirSync(temporary.path).length).toBe(1);
    await served.stop();
    expect(readdirSync(temporary.path)).toEqual([]);
  });

  it.each([
    ["missing.pdf", "was not found; check the address\\."],
    ["secret.pdf", "may not be read \\(the server responded 403\\); "],
    ["page", "is a web page, not a book; PDF, "],
    ["empty", "is empty; get the file again\\."],
    ["torn.pdf", "broke off while it was fetched; "],
    ["list.json", "is JSON, and no manifest of IIIF; "],
    ["bad.json", "is no valid JSON; "],
    ["nothing.json", "is a collection without books; "],
    ["loop", "could not be reached; "],
    ["packed", "is packed in a way that is not known; "],
    ["not-packed.pdf", "broke off while it was fetched; "],
  ])("%s ends with one sentence that names it", async (path, sentence) => {
    responses.set("/secret.pdf", (_, response) => response.writeHead(403).end());
    responses.set("/page", send("<!doctype html><title>A library</title>"));
    responses.set("/empty", send(""));
    responses.set("/torn.pdf", (_, response) => {
      response.writeHead(200, { "Content-Length": "5000" });
      response.write("%PDF-1.7\n", () => response.destroy());
    });
    // Each coding is a stream of its own to some that unpack them.
    const codings = Array.from({ length: 200 }, () => "gzip").join(", ");
    responses.set("/packed", send("x", { "Content-Encoding": codings }));
    responses.set("/not-packed.pdf", send("%PDF-1.7", { "Content-Encoding": "gzip" }));
    responses.set("/list.json", json({ pages: ["a.png"] }));
    responses.set("/bad.json", send('{"pages": '));
    responses.set("/nothing.json", json({ "@context": context, type: "Collection", items: [] }));
    responses.set("/loop", (_, response) => response.writeHead(302, { Location: "/loop" }).end());
    const ended = await run("read", `${base}${path}`);
    expect(ended.stderr).toMatch(new RegExp(`^${base}${path} ${sentence}[^\n]*\n$`));
    expect(ended).toMatchObject({ status: 1, stdout: "" });
  });

  it("that does not end is given up at its bound", async () => {
    responses.set("/endless", (_, response) => {
      response.writeHead(200);
      const more = (): void => {
        if (!response.destroyed) response.write(Buffer.alloc(65_536), more);
      };
      more();
    });
    const reading = fetchAddress(
      `${base}endless`,
      new AbortController().signal,
      async ({ body }) => {
        let count = 0;
        for await (const piece of body(3_000_000)) count += piece.length;
        return count;
      },
    );
    await expect(reading).rejects.toThrow(/endless is larger than 3 MB; name a smaller file\./);
  });

  it("is given up when the command is stopped", async () => {
    const stopping = new AbortController();
    responses.set("/slow", (_, response) => {
      response.writeHead(200);
      response.write("%PDF", () => stopping.abort());
    });
    const reading = fetchAddress(`${base}slow`, stopping.signal, async ({ body }) => {
      for await (const _ of body(1e6));
    });
    await expect(reading).rejects.toThrow(/^Stopped; \S+slow was not read\.$/);
  });
});

describe("a manifest of IIIF", () => {
  const tests = chromiumForTests();

  it("is read at its address, with the images of its site", async () => {
    responses.set("/iiif/a/manifest.json", json(manifest("A Book of Two")));
    responses.set("/1.png", send(coloured([200, 40, 40]), { "Content-Type": "image/png" }));
    responses.set("/2.png", send(coloured([40, 40, 200]), { "Content-Type": "image/png" }));
    const served = await serve(`${base}iiif/a/manifest.json`);
    expect(served.stdout).toContain("Turnleaf is reading A Book of Two at ");
    const page = await tests.newPage({ viewport: { width: 480, height: 360 } });
    const complaints: string[] = [];
    page.on("console", (message) => {
      if (message.type() === "error") complaints.push(message.text());
    });
    const image = page.waitForResponse(`${base}1.png`);
    await page.goto(served.url);
    expect((await image).status()).toBe(200);
    await page.getByRole("slider").waitFor({ state: "visible" });
    expect(await page.title()).toBe("A Book of Two");
    expect(complaints).toEqual([]);
  });

  it("of a collection is one of a shelf, collections in it too, and one in itself is left out", async () => {
    const other = { "@id": "other.json", "@type": "sc:Manifest", label: "Older" };
    responses.set(
      "/all.json",
      json({
        ...{ "@context": context, id: `${base}all.json`, type: "Collection" },
        items: [
          { id: "iiif/a/manifest.json", type: "Manifest", label: { none: ["First"] } },
          { id: `${base}part.json`, type: "Collection", label: { en: ["Part"] } },
          { id: `${base}gone.json`, type: "Collection" },
          { id: "javascript:alert(1)", type: "Manifest", label: { en: ["Nowhere"] } },
        ],
      }),
    );
    const itself = { "@id": `${base}all.json`, "@type": "sc:Collection", label: "All" };
    responses.set(
      "/part.json",
      json({
        ...{ "@context": "http://iiif.io/api/presentation/2/context.json" },
        ...{ "@id": `${base}part.json`, "@type": "sc:Collection" },
        ...{ collections: [itself], manifests: [other] },
      }),
    );
    const served = await serve(`${base}all.json`);
    expect(served.stdout).toContain("Turnleaf is reading 2 books at ");
    expect(served.stderr()).toContain("All is listed again; it is left out there.\n");
    expect(served.stderr()).toMatch(/gone\.json was not found; .* It is left out\.\n/);
    const { books } = JSON.parse((await ask(served.port, "/config.json")).body.toString());
    expect(books).toEqual([
      { src: `${base}iiif/a/manifest.json`, title: "First" },
      { src: `${base}other.json`, title: "Older" },
    ]);
    const reply = await ask(served.port, "/");
    expect(reply.headers["content-security-policy"]).toContain("connect-src 'self' https: http:;");
  });
});

describe("a hostile collection", () => {
  const collection = (items: unknown): unknown => ({
    "@context": context,
    type: "Collection",
    items,
  });
  const opened = (value: unknown, web: Partial<CollectionWeb> = {}, isPublic = true) => {
    const warnings: string[] = [];
    const books = iiifBooks(
      { value, url: "https://a.example/c.json", isPublic },
      {
        fetchJson: async (url) => ({ value: null, url, isPublic: true }),
        isInner: async () => false,
        ...web,
      },
      (one) => {
        warnings.push(one);
      },
    );
    return { books, warnings };
  };

  it("of a million books has as many as a shelf takes, and says so", async () => {
    const many = Array.from({ length: 1_000_000 }, (_, k) => ({ type: "Manifest", id: `${k}` }));
    const { books, warnings } = opened(collection(many));
    expect((await books).length).toBe(500);
    expect(warnings).toEqual([
      "https://a.example/c.json has more than 500 books; the rest is left out.",
    ]);
  });

  it("of 300,000 that are listed again ends in a bounded number of sentences", async () => {
    const again = { type: "Collection", id: `${base}again.json`, label: { en: ["Again"] } };
    const items = [...Array.from({ length: 300_000 }, () => again), { type: "Manifest", id: "a" }];
    responses.set("/again.json", json({ ...(collection(items) as object), id: again.id }));
    const served = await serve(`${base}again.json`);
    const lines = served.stderr().trimEnd().split("\n");
    expect(lines).toHaveLength(101);
    expect(lines[99]).toBe("Again is listed again; it is left out there.");
    expect(lines[100]).toBe("299900 more sentences like these are not shown.");
  });

  it("whose collections lead ever on is followed for a bounded number of them", async () => {
    let count = 0;
    const next = async (): Promise<unknown> => {
      const items = Array.from({ length: 10 }, () => ({ type: "Collection", id: `${++count}` }));
      return collection([...items, { type: "Manifest", id: `m${count}` }]);
    };
    let fetched = 0;
    const { books } = opened(await next(), {
      fetchJson: async (url) => {
        fetched++;
        return { value: await next(), url, isPublic: true };
      },
    });
    expect((await books).length).toBeLessThanOrEqual(51);
    expect(fetched).toBeLessThanOrEqual(50);
  });

  it("that is public lists no book at an inner address; one of the network may", async () => {
    const items = [
      "https://a.example/1",
      "http://127.0.0.1/2",
      "http://[::1]/3",
      "http://10.0.0.1/4",
    ];
    const value = collection(items.map((id) => ({ type: "Manifest", id, label: { en: [id] } })));
    const web = { isInner: isInnerPlace };
    const { books, warnings } = opened(value, web);
    expect((await books).map(({ url }) => url)).toEqual(items.slice(0, 1));
    expect(warnings).toEqual(
      items
        .slice(1)
        .map(
          (id) =>
            `${id} is on this machine or its network, and a public collection lists it; it is left out.`,
        ),
    );
    expect(await opened(value, web, false).books).toHaveLength(4);
    // Nor does one that a collection of the network lists.
    const within = opened(
      collection([
        { type: "Collection", id: "https://b.example/" },
        { type: "Manifest", id: items[1] },
      ]),
      { ...web, fetchJson: async (url) => ({ value, url, isPublic: true }) },
      false,
    );
    expect((await within.books).map(({ url }) => url)).toEqual([items[0], items[1]]);
  });

  it.each([
    ["members that are none", [null, 3, "x", [], { type: "Manifest" }, { type: 7, id: {} }]],
    ["no list", "a"],
    ["a label of an odd kind", [{ type: "Collection", label: { en: 3 }, id: 5 }]],
  ])("with %s fails in one sentence", async (_, items) => {
    await expect(opened(collection(items)).books).rejects.toThrow("is a collection without books");
  });
});
