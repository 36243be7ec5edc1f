import { constants } from "node:fs";
import type { FileHandle } from "node:fs/promises";
import type { IncomingMessage, ServerResponse } from "node:http";
import { pipeline } from "node:stream/promises";
import type { ServedFile } from "./book.ts";
import { parseRange } from "./byte_range.ts";
import { openRegular } from "./regular_file.ts";

/**
 * Responds to a GET or HEAD request with a file, or with the one requested
 * range of it. A failure after the head was sent ends the connection, so that
 * the client notices.
 */
export async function sendFile(
  file: ServedFile,
  request: IncomingMessage,
  response: ServerResponse,
): Promise<void> {
  response.setHeader("Content-Type", file.type);
  if ("text" in file) {
    const bytes = Buffer.from(file.text);
    response.setHeader("Content-Length", bytes.length);
    response.end(request.method === "HEAD" ? undefined : bytes);
    return;
  }
  const handle = await openServed(file.path);
  if (!handle) {
    response.removeHeader("Content-Type");
    response.writeHead(404).end();
    return;
  }
  try {
    await sendFrom(handle, request, response);
  } finally {
    await handle.close();
  }
}

async function sendFrom(
  handle: FileHandle,
  request: IncomingMessage,
  response: ServerResponse,
): Promise<void> {
  const { size, mtimeMs } = await handle.stat();
  const tag = `"${size.toString(36)}-${Math.floor(mtimeMs).toString(36)}"`;
  response.setHeader("ETag", tag);
  response.setHeader("Accept-Ranges", "bytes");
  const condition = request.headers["if-range"];
  const isSame = condition === undefined || condition === tag;
  const range = isSame ? parseRange(request.headers.range, size) : null;
  if (range === "unsatisfiable") {
    response.writeHead(416, { "Content-Range": `bytes */${size}`, "Content-Length": 0 }).end();
    return;
  }
  const { start, end } = range ?? { start: 0, end: size - 1 };
  response.setHeader("Content-Length", end - start + 1);
  if (range) response.writeHead(206, { "Content-Range": `bytes ${start}-${end}/${size}` });
  if (request.method === "HEAD" || size === 0) {
    response.end();
    return;
  }
  await pipeline(handle.createReadStream({ start, end, autoClose: false }), response);
}

/** Opens a file that was regular when the command started, if it still is, and not a link. */
async function openServed(path: string): Promise<FileHandle | null> {
  return await openRegular(path, constants.O_NOFOLLOW ?? 0).catch(() => null);
}
