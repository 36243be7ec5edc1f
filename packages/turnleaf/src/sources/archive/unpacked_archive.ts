/**
 * RAR and 7-Zip: archives that are unpacked whole, once and in order, by
 * libarchive in a worker. Most of them are solid: a file is understood only
 * after all those before it. A file that is packed by XZ is unpacked there too.
 */

import { unpack } from "../../packed.ts";
import { bytesOf } from "../book_file.ts";
import { cleanText } from "../book_text.ts";
import { formatOfName } from "../formats.ts";
import { limits } from "../limits.ts";
import { loadPart } from "../load_part.ts";
import { BookError } from "../page_source.ts";
import { trustedScript } from "../trusted_script.ts";
import { scriptOfWorker, workerNotStarted } from "../worker_script.ts";
import type { Archive } from "./archive.ts";
import { marksLength, type Obstacle, obstacleIn } from "./archive_marks.ts";
import { BlobArchive } from "./blob_archive.ts";
import { cleanPath, OwnPaths } from "./names.ts";
import type { Stop, UnpackingBounds } from "./unpacker/unpack_all.ts";
import type { Packing } from "./unpacker/unpacker.ts";
import type { UnpackingTask, WorkerMessage } from "./unpacker/unpacker_worker.ts";

/** Bounds on an archive, and on the milliseconds in which it is unpacked. */
export interface UnpackedBounds extends UnpackingBounds {
  readonly time: number;
}

/** The bounds on what a reader opens. */
export const usualBounds: UnpackedBounds = {
  entries: limits.archiveEntries,
  fileBytes: limits.archivedBytes,
  allBytes: limits.unpackedBytes,
  pathLength: limits.archivePath,
  time: limits.unpackingTime,
};

/** Milliseconds in which the worker has to report that it runs. */
const startingTime = 60_000;

/** Maximum of characters quoted from libarchive. */
const detailLength = 200;

const workerScript = scriptOfWorker(() => import("worker:./unpacker/unpacker_worker.ts"));

/** Loads what unpacks. */
export async function prepareUnpacking(): Promise<void> {
  await Promise.all([workerScript(), import("./unpacker/unpacker.wasm")]);
}

/**
 * Opens a RAR or 7-Zip archive, all of which is unpacked. Rejects with a
 * `BookError` if it is damaged, encrypted, one of several volumes or beyond the
 * bounds, or with the signal's reason.
 *
 * @param name the file's name in sentences
 */
export async function openUnpacked(
  file: Blob,
  name: string,
  signal?: AbortSignal,
  bounds: UnpackedBounds = usualBounds,
): Promise<Archive> {
  const obstacle = obstacleIn(await bytesOf(file.slice(0, marksLength), name), file.size);
  if (obstacle)
    throw new BookError(`${name} ${obstacles[obstacle]}`, {
      code: obstacle === "encrypted" ? "locked" : "damaged",
      source: name,
    });
  return new BlobArchive(name, await unpackInWorker(file, "archive", name, bounds, signal));
}

/**
 * Returns the file that is packed in another by XZ. Rejects with a `BookError`
 * if it is damaged or beyond the bounds, or with the signal's reason.
 *
 * @param name the file's name in sentences
 */
export async function unpackXz(
  file: Blob,
  name: string,
  signal?: AbortSignal,
  bounds: UnpackedBounds = usualBounds,
): Promise<Blob> {
  // One file is all that there is.
  const whole = { ...bounds, fileBytes: bounds.allBytes };
  const files = await unpackInWorker(file, "xz", name, whole, signal);
  const [unpacked = new Blob()] = files.values();
  if (unpacked instanceof Blob) return unpacked;
  throw unpacked;
}

/** A file of an archive, or why it is not there. */
type UnpackedFile = Blob | BookError;

/** Returns the files by their paths. Ends the worker in any case. */
async function unpackInWorker(
  file: Blob,
  packing: Packing,
  name: string,
  { time, ...bounds }: UnpackedBounds,
  signal?: AbortSignal,
): Promise<ReadonlyMap<string, UnpackedFile>> {
  const [address, packed] = await Promise.all([
    loadPart(workerScript()),
    loadPart(import("./unpacker/unpacker.wasm")),
  ]);
  const task: UnpackingTask = { code: await unpack(packed.default), file, bounds, packing };
  signal?.throwIfAborted();
  return await new Promise((resolve, reject) => {
    const files = new Map<string, UnpackedFile>();
    const paths = new OwnPaths();
    let worker: Worker | undefined;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const stop = (): void => {
      clearTimeout(timer);
      worker?.terminate();
      signal?.removeEventListener("abort", abort);
    };
    const fail = (reason: unknown): void => {
      stop();
      reject(reason);
    };
    const failAfter = (milliseconds: number, error: () => BookError): void => {
      clearTimeout(timer);
      timer = setTimeout(() => fail(error()), milliseconds);
    };
    const abort = (): void => fail(signal?.reason);
    const whatOf = (path: string): string =>
      packing === "xz" ? name : `${quoted(path)} in ${name}`;
    const add = (path: string, file: UnpackedFile): void => {
      const clean = cleanPath(path);
      if (clean) files.set(paths.take(clean), file);
    };
    const take = (message: WorkerMessage): void => {
      switch (message.kind) {
        case "started":
          failAfter(
            time,
            () => new BookError(`${name} ${tooLong(time)}`, { code: "tooLarge", source: name }),
          );
          break;
        case "file":
          add(message.path, message.bytes);
          break;
        case "other":
          if (formatOfName(message.path)) add(message.path, notFollowed(message.path, name));
          break;
        case "large":
          add(message.path, tooLarge(message.path, name, task.bounds.fileBytes));
          break;
        case "damaged":
          add(message.path, notUnpacked(whatOf(message.path), message.detail));
          break;
        case "failed":
          fail(
            message.stop === "damaged"
              ? notUnpacked(name, message.detail)
              : new BookError(`${name} ${stops(task.bounds)[message.stop]}`, {
                  code: message.stop === "encrypted" ? "locked" : "tooLarge",
                  source: name,
                }),
          );
          break;
        case "forbidden":
          fail(workerNotStarted(name, "unpacks it", new Error(message.detail)));
          break;
        case "end":
          stop();
          resolve(files);
      }
    };
    signal?.addEventListener("abort", abort);
    try {
      worker = new Worker(trustedScript(address), { type: "module" });
      failAfter(startingTime, () =>
        workerNotStarted(name, "unpacks it", new Error("It gave no sign of life.")),
      );
      worker.onmessage = ({ data }: MessageEvent<WorkerMessage>) => take(data);
      worker.onmessageerror = () => fail(notUnpacked(name, "a message could not be read"));
      worker.onerror = (event) => {
        event.preventDefault();
        // An event without a message comes from a script that could not be loaded.
        const { message } = event;
        fail(
          message
            ? notUnpacked(name, message)
            : workerNotStarted(name, "unpacks it", new Error("It did not load.")),
        );
      };
      worker.postMessage(task);
    } catch (error) {
      fail(workerNotStarted(name, "unpacks it", error));
    }
  });
}

const obstacles: Readonly<Record<Obstacle, string>> = {
  volume:
    "is one part of an archive in several; unpack all its parts together, and pack them as one.",
  short:
    "is cut off, or the first part of an archive in several; get it again, or unpack all its parts together and pack them as one.",
  encrypted: "is protected by a password; unpack it first.",
};

function stops(bounds: UnpackingBounds): Readonly<Record<Exclude<Stop, "damaged">, string>> {
  return {
    encrypted: obstacles.encrypted,
    entries: `has more than ${bounds.entries} files; split it and open a part.`,
    bytes: `is larger than ${megabytes(bounds.allBytes)} when unpacked; split it and open a part.`,
  };
}

function tooLong(time: number): string {
  return `took more than ${Math.ceil(time / 1000)} seconds to unpack; pack it again as ZIP (CBZ).`;
}

function tooLarge(path: string, name: string, most: number): BookError {
  return new BookError(
    `${quoted(path)} in ${name} is larger than ${megabytes(most)} when unpacked; make it smaller.`,
    { code: "tooLarge" },
  );
}

/** Returns the error for what is no file and named as one. */
function notFollowed(path: string, name: string): BookError {
  return new BookError(
    `${quoted(path)} in ${name} is a link, which is not followed; pack it again with the whole file.`,
    { code: "unsupported", source: name },
  );
}

/** Returns the error for what libarchive did not unpack, by what it says. */
function notUnpacked(what: string, detail: string): BookError {
  const said = quoted(detail);
  if (/support|unknown codec/i.test(said)) {
    return new BookError(
      `${what} is packed in a way that cannot be read (${said}); pack it again as ZIP (CBZ).`,
      { code: "unsupported", source: what },
    );
  }
  if (/memory|allocat/i.test(said)) {
    return new BookError(
      `${what} needs more memory to unpack than a book may have (${said}); pack it again as ZIP (CBZ).`,
      { code: "tooLarge", source: what },
    );
  }
  return new BookError(`${what} is damaged (${said}); repair it or get it again.`, {
    code: "damaged",
    source: what,
  });
}

function quoted(text: string): string {
  return cleanText(text, detailLength);
}

function megabytes(bytes: number): string {
  return `${Math.floor(bytes / (1 << 20))} MB`;
}
