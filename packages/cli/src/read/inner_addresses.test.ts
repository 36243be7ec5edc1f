/** A public address may not lead to this machine or to a network around it. */

import { once } from "node:events";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { afterAll, beforeAll, expect, test, vi } from "vitest";
import { fetchAddress } from "./fetch_address.ts";
import { isInnerAddress, type Place } from "./network.ts";

/** A server of this machine stands for one of the internet, by a name. */
vi.mock("./network.ts", async (original) => {
  const real = await original<typeof import("./network.ts")>();
  const placeOf = async (hostname: string): Promise<Place> => {
    if (hostname !== "public.example") return await real.placeOf(hostname);
    return { ...(await real.placeOf("127.0.0.1")), isInner: false };
  };
  return { ...real, placeOf };
});

let server: Server;
let port = 0;
let asked: string[] = [];

beforeAll(async () => {
  server = createServer(({ url = "", headers }, response) => {
    asked.push(`${headers.host}${url}`);
    const to = decodeURIComponent(url.slice(1));
    if (to === "") response.end("here");
    else response.writeHead(302, { Location: to }).end();
  });
  server.listen(0, "127.0.0.1");
  await once(server, "listening");
  port = (server.address() as AddressInfo).port;
});
afterAll(() => void server.close());

const read = (address: string, isNamedByPublic = false): Promise<string> =>
  fetchAddress(
    address,
    new AbortController().signal,
    async ({ body }) => {
      let text = "";
      for await (const piece of body(100)) text += Buffer.from(piece).toString();
      return text;
    },
    isNamedByPublic,
  );

test.each([
  ...["127.0.0.1", "localhost", "[::1]", "[::ffff:127.0.0.1]", "2130706433", "0x7f.1", "0"],
  ...["10.1.2.3", "192.168.0.1", "169.254.169.254", "[fd00::1]", "[64:ff9b::7f00:1]"],
])("a redirect to %s is not followed", async (host) => {
  asked = [];
  const inner = `http://${host}:${port}/`;
  const address = `http://public.example:${port}/${encodeURIComponent(inner)}`;
  await expect(read(address)).rejects.toThrow(
    /^\S+ leads from the internet to this machine or its network; name what is there\.$/,
  );
  expect(asked.length).toBe(1);
  // Nor is one that a public collection lists.
  await expect(read(inner, true)).rejects.toThrow("leads from the internet to this machine");
  expect(asked.length).toBe(1);
});

test("one from machine to machine of a network is followed, and one to the internet", async () => {
  const [inner, outer] = [`http://127.0.0.1:${port}/`, `http://public.example:${port}/`];
  expect(await read(`${inner}${encodeURIComponent(inner)}`)).toBe("here");
  expect(await read(`${inner}${encodeURIComponent(outer)}`)).toBe("here");
  expect(await read(`${outer}${encodeURIComponent(outer)}`)).toBe("here");
  // Not by a way around.
  const around = `${outer}${encodeURIComponent(`${outer}${encodeURIComponent(inner)}`)}`;
  await expect(read(around)).rejects.toThrow("leads from the internet");
});

test("addresses are of the internet, or of networks that are not", () => {
  for (const address of ["1.1.1.1", "172.32.0.1", "100.128.0.1", "2606:4700::1111", "2002:101::"]) {
    expect(isInnerAddress(address), address).toBe(false);
  }
  for (const address of ["172.31.0.1", "100.64.0.1", "::", "fe80::1", "2002:a00:1::", "::7f00:1"]) {
    expect(isInnerAddress(address), address).toBe(true);
  }
});
