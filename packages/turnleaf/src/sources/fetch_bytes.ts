import { joinBytes } from "./join_bytes.ts";
import { BookError, type BookErrorCode, type BookErrorDetail } from "./page_source.ts";

/**
 * Fetches `url`. Rejects with a `BookError`, a sentence about `name`, or with
 * the signal's reason when aborted.
 *
 * @param about what a program may ask of the error
 */
export async function fetchChecked(
  url: string,
  name: string,
  init: RequestInit,
  about: BookErrorDetail = { source: name },
): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(securedAddress(url), init);
  } catch (error) {
    init.signal?.throwIfAborted();
    if (!(error instanceof TypeError)) throw error;
    throw new BookError(unreachable(url, name), { ...about, code: "unreachable" });
  }
  if (response.ok) return response;
  // 416 is the response to a range request for an empty file.
  if (response.status === 416) throw emptyFile(name);
  await response.body?.cancel().catch(() => {});
  throw httpError(response.status, name, about);
}

/** Hosts that browsers trust without encryption. */
const thisMachine = /^(localhost|.+\.localhost|127(\.\d+){3}|\[::1\])$/;

/**
 * Returns the address at which a page may fetch: browsers let one of https fetch nothing of http, and old
 * manifests name so what their servers have by https too.
 */
export function securedAddress(
  url: string,
  protocol: string | undefined = globalThis.location?.protocol,
): string {
  if (protocol !== "https:" || !/^http:/i.test(url)) return url;
  const secured = new URL(url);
  if (thisMachine.test(secured.hostname)) return url;
  secured.protocol = "https:";
  return secured.href;
}

/** Returns the error for a status of the server other than success. */
export function httpError(
  status: number,
  name: string,
  about: BookErrorDetail = { source: name },
): BookError {
  const [code, sentence] = ((): [BookErrorCode, string] => {
    switch (status) {
      case 404:
      case 410:
        return ["absent", `${name} was not found; check the address and open it again.`];
      case 401:
      case 403:
        return [
          "forbidden",
          `${name} may not be read (the server responded ${status}); ask for access, or open a copy of it.`,
        ];
      default:
        return [
          "server",
          `${name} could not be fetched (the server responded ${status}); try again later.`,
        ];
    }
  })();
  return new BookError(sentence, { ...about, code, status });
}

/** Returns the error for an empty file. */
export function emptyFile(name: string): BookError {
  return new BookError(`${name} is empty; get the file again.`, { code: "empty", source: name });
}

/** Returns the error for a connection that breaks. */
export function brokeOff(name: string): BookError {
  return new BookError(
    `${name} broke off while it was fetched; check the connection and try again.`,
    { code: "unreachable", source: name },
  );
}

function unreachable(url: string, name: string): string {
  if (url.startsWith("blob:")) {
    return `${name} is no longer there, or this page's Content-Security-Policy lacks blob: in connect-src; choose the file again, or allow it.`;
  }
  if (url.startsWith("file:")) {
    return `${name} cannot be read from a page opened as a file; serve it, for example with: npx turnleaf-cli read`;
  }
  return `${name} could not be reached; check the connection and the address, and that its server lets other sites read it (CORS), and that this page's Content-Security-Policy does (connect-src).`;
}

/**
 * Reads a response's bytes, at most `most`. Rejects with a `BookError` beyond
 * that or when the connection breaks.
 */
export async function readBounded(
  response: Response,
  most: number,
  name: string,
  signal?: AbortSignal,
): Promise<Uint8Array<ArrayBuffer>> {
  const parts: Uint8Array[] = [];
  let length = 0;
  const reader = response.body?.getReader();
  try {
    for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
      length += part.value.length;
      if (length > most) throw tooLarge(name, most);
      parts.push(part.value);
    }
  } catch (error) {
    await reader?.cancel().catch(() => {});
    signal?.throwIfAborted();
    if (error instanceof BookError) throw error;
    throw brokeOff(name);
  }
  return joinBytes(parts, length);
}

/**
 * Reads the first bytes of a response, `wanted` of them if it has so many; the
 * rest is not fetched.
 */
export async function readStart(
  response: Response,
  wanted: number,
): Promise<Uint8Array<ArrayBuffer>> {
  const reader = response.body?.getReader();
  const parts: Uint8Array[] = [];
  let length = 0;
  while (reader && length < wanted) {
    const part = await reader.read();
    if (part.done) break;
    parts.push(part.value);
    length += part.value.length;
  }
  // A response with no more than was requested is read to its end, so that the
  // connection can be reused.
  const isAll = response.status === 206 && (await reader?.read())?.done;
  if (!isAll) await reader?.cancel().catch(() => {});
  return joinBytes(parts, length).subarray(0, wanted);
}

function tooLarge(name: string, most: number): BookError {
  return new BookError(
    `${name} is larger than ${Math.floor(most / (1 << 20))} MB; make it smaller and open it again.`,
    { code: "tooLarge", source: name },
  );
}
