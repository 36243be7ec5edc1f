/** What is at an address of the web, for `turnleaf read`: bounded in bytes and in idle time. */

import { once } from "node:events";
import { type ClientRequest, type IncomingMessage, request as requestHttp } from "node:http";
import { request as requestHttps } from "node:https";
import type { Readable, Transform } from "node:stream";
import { createBrotliDecompress, createGunzip, createInflate } from "node:zlib";
import { Problem, printable } from "../problem.ts";
import { tooLarge } from "../regular_file.ts";
import { placeOf } from "./network.ts";

/** Milliseconds without a byte after which a server is given up. */
const patience = 60_000;

/** Redirects that are followed, as many as browsers do. */
const mostRedirects = 20;

/** How a body may be packed, each with what unpacks it. */
const unpackers: Readonly<Record<string, () => Transform>> = {
  gzip: createGunzip,
  "x-gzip": createGunzip,
  deflate: createInflate,
  br: createBrotliDecompress,
};

/** A response whose body has not been read. */
export interface Fetched {
  /** Its address after redirects. */
  readonly url: string;
  /** Whether it is of the public internet: what it names must be too. */
  readonly isPublic: boolean;
  /** Bytes that it is going to have, if its server says so; else null. */
  readonly length: number | null;
  /**
   * Yields its body, piece by piece.
   *
   * @throws Problem beyond `most` bytes, and when the connection breaks or falls silent
   */
  body(most: number): AsyncIterable<Uint8Array>;
}

/** Returns whether a name on the command line is an address of the web. */
export function isAddress(name: string): boolean {
  return /^https?:\/\//i.test(name);
}

/**
 * Fetches an address, http or https, and calls `use` with what is there; the
 * connection ends with it. A public address may not lead to this machine or
 * to a network around it, where a stranger's book could read what only its reader may.
 *
 * @param isNamedByPublic whether a public address named this one
 * @throws Problem
 */
export async function fetchAddress<Result>(
  address: string,
  signal: AbortSignal,
  use: (fetched: Fetched) => Promise<Result>,
  isNamedByPublic = false,
): Promise<Result> {
  const name = printable(address);
  const silent = new AbortController();
  const timer = setTimeout(() => silent.abort(), patience);
  const problem = (what: string): Problem => {
    if (signal.aborted) return new Problem(`Stopped; ${name} was not read.`);
    return new Problem(
      silent.signal.aborted ? `${name} fell silent; try again later.` : `${name} ${what}`,
    );
  };
  try {
    const ending = AbortSignal.any([signal, silent.signal]);
    const { response, url, isPublic } = await follow(address, ending, isNamedByPublic).catch(
      (error: unknown) => {
        throw error instanceof InnerRedirect
          ? problem("leads from the internet to this machine or its network; name what is there.")
          : problem("could not be reached; check the address and the connection.");
      },
    );
    const { statusCode = 0, headers } = response;
    if (statusCode < 200 || statusCode > 299) throw problem(reasonOf(statusCode));
    const length = Number(headers["content-length"]) || null;
    const coding = headers["content-encoding"]?.trim().toLowerCase() ?? "identity";
    const unpacker = coding === "identity" ? null : unpackers[coding];
    if (unpacker === undefined) {
      throw problem("is packed in a way that is not known; get it as a file and name that.");
    }
    return await use({
      url,
      isPublic,
      length: unpacker ? null : length,
      async *body(most) {
        let count = 0;
        try {
          for await (const part of unpacked(response, unpacker)) {
            timer.refresh();
            count += part.length;
            if (count > most) break;
            yield part;
          }
        } catch {
          throw problem("broke off while it was fetched; check the connection and try again.");
        }
        if (count > most) throw tooLarge(address, most);
      },
    });
  } finally {
    clearTimeout(timer);
    // Ends a connection of which not everything was read.
    silent.abort();
  }
}

/** A public address leads to this machine or to a network around it. */
class InnerRedirect extends Error {}

/** A response, whatever its status, at the end of redirects. */
interface Followed {
  readonly response: IncomingMessage;
  readonly url: string;
  readonly isPublic: boolean;
}

/** Requests an address and those to which it leads. Rejects if there is no response. */
async function follow(
  address: string,
  signal: AbortSignal,
  isNamedByPublic: boolean,
): Promise<Followed> {
  let url = new URL(address);
  let isPublic = isNamedByPublic;
  let sent: ClientRequest | undefined;
  const stopped = ended(signal);
  // Ends the response too, while its body is read.
  stopped.catch((reason: Error) => sent?.destroy(reason));
  for (let count = 0; count <= mostRedirects; count++) {
    const { isInner, lookup } = await Promise.race([placeOf(url.hostname), stopped]);
    if (isPublic && isInner) throw new InnerRedirect();
    isPublic = !isInner;
    const request = { "http:": requestHttp, "https:": requestHttps }[url.protocol];
    if (!request) break;
    const headers = { "Accept-Encoding": "gzip, deflate, br", "User-Agent": "turnleaf" };
    sent = request(url, { agent: false, headers, lookup });
    // Rejects below; what fails later fails the body.
    sent.on("error", () => {});
    sent.end();
    const [response] = (await once(sent, "response")) as [IncomingMessage];
    response.on("error", () => {});
    const { location } = response.headers;
    const isRedirect = [301, 302, 303, 307, 308].includes(response.statusCode ?? 0);
    if (!isRedirect || location === undefined) return { response, url: url.href, isPublic };
    response.destroy();
    url = new URL(location, url);
  }
  throw new Error("It leads ever on, or away from the web.");
}

/** Rejects when a signal aborts. */
async function ended(signal: AbortSignal): Promise<never> {
  if (!signal.aborted) await once(signal, "abort");
  throw signal.reason;
}

/** Yields a body as it is without its coding. */
async function* unpacked(
  response: IncomingMessage,
  unpacker: (() => Transform) | null,
): AsyncGenerator<Buffer> {
  const end: Readable = unpacker ? response.pipe(unpacker()) : response;
  // A connection that breaks does not end what it is piped into.
  if (end !== response) response.once("error", (error) => end.destroy(error));
  for await (const part of end) yield part as Buffer;
}

function reasonOf(status: number): string {
  if (status === 404 || status === 410) return "was not found; check the address.";
  if (status === 401 || status === 403) {
    return `may not be read (the server responded ${status}); get it as a file and name that.`;
  }
  return `could not be fetched (the server responded ${status}); try again later.`;
}
