/** What is at an address of the web, for `turnleaf read`: bounded in bytes and in idle time. */

import { Problem, printable } from "../problem.ts";
import { tooLarge } from "../regular_file.ts";

/** Milliseconds without a byte after which a server is given up. */
const patience = 60_000;

/** A response whose body has not been read. */
export interface Fetched {
  /** Its address after redirects. */
  readonly url: string;
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
 * connection ends with it.
 *
 * @throws Problem
 */
export async function fetchAddress<Result>(
  address: string,
  signal: AbortSignal,
  use: (fetched: Fetched) => Promise<Result>,
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
    const init = { signal: AbortSignal.any([signal, silent.signal]) };
    const response = await fetch(address, init).catch(() => {
      throw problem("could not be reached; check the address and the connection.");
    });
    if (!response.ok) throw problem(reasonOf(response.status));
    const length = Number(response.headers.get("content-length")) || null;
    const isPacked = response.headers.has("content-encoding");
    return await use({
      url: response.url || address,
      length: isPacked ? null : length,
      async *body(most) {
        let count = 0;
        const reader = response.body?.getReader();
        for (;;) {
          const part = await reader?.read().catch(() => {
            throw problem("broke off while it was fetched; check the connection and try again.");
          });
          if (!part || part.done) return;
          timer.refresh();
          count += part.value.length;
          if (count > most) throw tooLarge(address, most);
          yield part.value;
        }
      },
    });
  } finally {
    clearTimeout(timer);
    // Ends a connection of which not everything was read.
    silent.abort();
  }
}

function reasonOf(status: number): string {
  if (status === 404 || status === 410) return "was not found; check the address.";
  if (status === 401 || status === 403) {
    return `may not be read (the server responded ${status}); get it as a file and name that.`;
  }
  return `could not be fetched (the server responded ${status}); try again later.`;
}
