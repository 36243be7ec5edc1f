/** The worker in which an archive is unpacked: it may be ended at any time. */

import { type Unpacked, type UnpackingBounds, unpackAll } from "./unpack_all.ts";
import type { ArchiveBytes, Packing } from "./unpacker.ts";

/** What the page sends, once. */
export interface UnpackingTask {
  /** The bytes of `unpacker.wasm`. */
  readonly code: Uint8Array<ArrayBuffer>;
  readonly file: Blob;
  readonly bounds: UnpackingBounds;
  readonly packing: Packing;
}

/** What the worker sends besides what is in the archive: that it runs, or why it does not. */
export type WorkerMessage =
  | Unpacked
  | { readonly kind: "started" }
  | { readonly kind: "forbidden"; readonly detail: string };

/** The part of a worker's scope that is used here. */
interface Scope {
  postMessage(message: WorkerMessage): void;
  onmessage: ((event: MessageEvent<UnpackingTask>) => void) | null;
  readonly FileReaderSync: new () => { readAsArrayBuffer(blob: Blob): ArrayBuffer };
}

/** Bytes of the file that are read at a time. */
const windowLength = 1 << 20;

const scope = globalThis as unknown as Scope;

scope.onmessage = async ({ data: { code, file, bounds, packing } }) => {
  try {
    const messages = unpackAll(code, bytesOf(file), bounds, packing);
    for await (const message of messages) scope.postMessage(message);
  } catch (error) {
    scope.postMessage({ kind: "forbidden", detail: String(error) });
  }
};
scope.postMessage({ kind: "started" });

/** Returns a file's bytes, read in windows: libarchive asks for small pieces. */
function bytesOf(file: Blob): ArchiveBytes {
  const reader = new scope.FileReaderSync();
  let [start, bytes] = [0, new Uint8Array()];
  return {
    length: file.size,
    read(offset, length) {
      if (offset < start || offset >= start + bytes.length) {
        bytes = new Uint8Array(reader.readAsArrayBuffer(file.slice(offset, offset + windowLength)));
        start = offset;
      }
      return bytes.subarray(offset - start, offset - start + length);
    },
  };
}
