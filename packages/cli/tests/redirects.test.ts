/** Where a server sends its reader on: by real redirects of a server on this machine. */

import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { afterAll, beforeAll, expect, test } from "vitest";
import { fileAt } from "../../turnleaf/src/sources/book_file.ts";
import { messageOf } from "../../turnleaf/src/sources/message_of.ts";

const targets: Readonly<Record<string, string>> = {
  "/round": "/about",
  "/about": "/round",
  "/moved": "/deep/book.json",
  "/file": "file:///etc/passwd",
  "/data": "data:text/plain,x",
  "/script": "javascript:alert(1)",
};
let asked: string[] = [];
let server: Server;
let address = "";

beforeAll(async () => {
  server = createServer(({ url = "" }, response) => {
    asked.push(url);
    const location = targets[url];
    response.writeHead(location ? 302 : 200, location ? { location } : {});
    response.end(location ? "" : "{}");
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  address = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
});
afterAll(() => void server.close());

test.each(["round", "file", "data", "script"])(
  "redirects that lead nowhere end in a sentence: %s",
  async (path) => {
    asked = [];
    expect(await messageOf(fileAt(`${address}/${path}`, "Atlas"))).toMatch(
      /^Atlas could not be reached;.*\.$/,
    );
    expect(asked.length).toBeLessThan(50);
  },
);

test("relative addresses are those of where a redirect leads", async () => {
  const file = await fileAt(`${address}/moved`, "Atlas");
  expect((await file.whole(100)).url).toBe(`${address}/deep/book.json`);
});
