import { createServer, type IncomingMessage, type Server, type ServerResponse } from "node:http";
import type { AddressInfo } from "node:net";
import type { ServedFile } from "./book.ts";
import { Problem } from "./problem.ts";
import { readerPolicy } from "./reader_policy.ts";
import { sendFile } from "./send_file.ts";

/** Only this machine. */
const loopback = "127.0.0.1";
const usualPort = 4173;
/** Ports tried from `usualPort` on. */
const portsTried = 50;

const headers: Readonly<Record<string, string>> = {
  "X-Content-Type-Options": "nosniff",
  "Referrer-Policy": "no-referrer",
  "Cross-Origin-Resource-Policy": "same-origin",
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cache-Control": "no-store",
};

/** A server that is listening. */
export interface Serving {
  /** `http://127.0.0.1:4173/`. */
  readonly url: string;
  /** Ends every connection and the server. */
  close(): Promise<void>;
}

/** Takes what a page that is served reports. */
export type TakeReport = (report: string) => void;

/** Where pages report, and the maximum of bytes of a report. */
const reportPath = "/report";
const mostReported = 1 << 20;

/**
 * Serves `files`, each at the exact path that is its key, to this machine only.
 *
 * @param port undefined for the default one or the next that is free; 0 for any
 * @param policy directives of the pages' Content-Security-Policy
 * @param report takes what served pages send to `/report`; without it nothing is taken
 * @throws Problem if the port is not available
 */
export async function serve(
  files: ReadonlyMap<string, ServedFile>,
  port: number | undefined,
  policy: readonly string[] = readerPolicy,
  report?: TakeReport,
): Promise<Serving> {
  const all = {
    ...headers,
    "Content-Security-Policy": [...policy, "form-action 'none'", "frame-ancestors 'none'"].join(
      "; ",
    ),
  };
  const server = createServer({ maxHeaderSize: 16_384, requestTimeout: 30_000 });
  server.headersTimeout = 10_000;
  server.maxConnections = 256;
  await listen(server, port);
  const actual = (server.address() as AddressInfo).port;
  const hosts = new Set([`${loopback}:${actual}`, `localhost:${actual}`]);
  server.on("request", (request, response) => {
    for (const [name, value] of Object.entries(all)) response.setHeader(name, value);
    respond(files, hosts, report, request, response).catch(() => response.destroy());
  });
  return {
    url: `http://${loopback}:${actual}/`,
    close: () =>
      new Promise((resolve) => {
        server.close(() => resolve());
        server.closeAllConnections();
      }),
  };
}

async function respond(
  files: ReadonlyMap<string, ServedFile>,
  hosts: ReadonlySet<string>,
  report: TakeReport | undefined,
  request: IncomingMessage,
  response: ServerResponse,
): Promise<void> {
  // Another name that resolves here (DNS rebinding) would let a web page read the book.
  if (!hosts.has(request.headers.host?.toLowerCase() ?? "")) {
    sendError(response, 403, "This address is not served.");
    return;
  }
  if (request.method === "POST" && request.url === reportPath && report) {
    await takeReport(report, request, response);
    return;
  }
  if (request.method !== "GET" && request.method !== "HEAD") {
    response.setHeader("Allow", "GET, HEAD");
    sendError(response, 405, "Only GET and HEAD are supported.");
    return;
  }
  // Looked up as it is, never joined to a path: only keys exist.
  const file = files.get(request.url?.split("?", 1)[0] ?? "");
  if (file) await sendFile(file, request, response);
  else sendError(response, 404, "There is nothing here.");
}

/** Takes a report of a page that is served here: other sites may send one as well, under their own name. */
async function takeReport(
  take: TakeReport,
  request: IncomingMessage,
  response: ServerResponse,
): Promise<void> {
  if (request.headers.origin !== `http://${request.headers.host}`) {
    sendError(response, 403, "Only pages of this address report here.");
    return;
  }
  const parts: Buffer[] = [];
  let length = 0;
  for await (const part of request as AsyncIterable<Buffer>) {
    length += part.length;
    if (length > mostReported) {
      sendError(response, 413, "This report is too long.");
      return;
    }
    parts.push(part);
  }
  take(Buffer.concat(parts).toString());
  response.writeHead(204).end();
}

function sendError(response: ServerResponse, status: number, sentence: string): void {
  // The body of a rejected request is not read.
  response.setHeader("Connection", "close");
  response.writeHead(status, { "Content-Type": "text/plain" }).end(`${sentence}\n`);
}

async function listen(server: Server, port: number | undefined): Promise<void> {
  const last = port ?? usualPort + portsTried - 1;
  for (let at = port ?? usualPort; at <= last; at++) {
    const error = await listenAt(server, at);
    if (error === null) return;
    if (error.code === "EACCES") {
      throw new Problem(`Port ${at} needs rights you do not have; choose one from 1024 on.`);
    }
    if (error.code !== "EADDRINUSE") throw new Problem(`Port ${at} cannot be had (${error.code}).`);
  }
  throw new Problem(
    port === undefined
      ? `Ports ${usualPort} to ${last} are taken; choose another with --port.`
      : `Port ${port} is taken; choose another with --port, or leave --port out.`,
  );
}

function listenAt(server: Server, port: number): Promise<NodeJS.ErrnoException | null> {
  return new Promise((resolve) => {
    const fail = (error: NodeJS.ErrnoException): void => resolve(error);
    server.once("error", fail);
    server.listen(port, loopback, () => {
      server.removeListener("error", fail);
      resolve(null);
    });
  });
}
