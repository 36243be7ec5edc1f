import { brokeOff, emptyFile, fetchChecked, readBounded, readStart } from "./fetch_bytes.ts";
import { type FileStart, sniffLength } from "./formats.ts";
import { BookError } from "./page_source.ts";

/** A file to open, at an address or in memory, with its first bytes read. */
export interface BookFile extends FileStart {
  /** Its name in sentences. */
  readonly name: string;
  /** Its absolute address, or itself. */
  readonly from: string | Blob;
  /** Its length in bytes, if known. */
  readonly length: number | undefined;
  /**
   * Returns the whole file. Rejects with a `BookError` if it has more than
   * `most` bytes or cannot be read.
   */
  whole(most: number, signal?: AbortSignal): Promise<WholeFile>;
}

/** A file that was read whole. */
export interface WholeFile {
  readonly blob: Blob;
  /** Its address after redirects, the base of relative ones in it; "" if it has none. */
  readonly url: string;
}

/** Returns the file at an address. Rejects with a `BookError` if its start cannot be read. */
export async function fileAt(url: string, name: string, signal?: AbortSignal): Promise<BookFile> {
  const init = signal ? { signal } : {};
  const headers = { Range: `bytes=0-${sniffLength - 1}` };
  const response = await fetchChecked(url, name, { ...init, headers });
  const start = await readStart(response, sniffLength).catch((error: unknown) => {
    signal?.throwIfAborted();
    throw error instanceof BookError ? error : brokeOff(name);
  });
  if (start.length === 0) throw emptyFile(name);
  const length = lengthOf(response);
  // A file that ended before as many bytes as were requested is not requested again.
  const isWhole =
    start.length < sniffLength && (response.status === 200 || start.length === length);
  return {
    name,
    from: url,
    start,
    type: mediaType(response.headers.get("content-type")),
    length,
    async whole(most, signal) {
      signal?.throwIfAborted();
      if (isWhole) return { blob: new Blob([start]), url: response.url || url };
      const whole = await fetchChecked(url, name, signal ? { signal } : {});
      const bytes = await readBounded(whole, most, name, signal);
      return { blob: new Blob([bytes]), url: whole.url || url };
    },
  };
}

/** Returns a file in memory or on disk. Rejects with a `BookError` if it cannot be read. */
export async function fileIn(blob: Blob, name: string): Promise<BookFile> {
  const start = await bytesOf(blob.slice(0, sniffLength), name);
  if (start.length === 0) throw emptyFile(name);
  return {
    name,
    from: blob,
    start,
    type: mediaType(blob.type),
    length: blob.size,
    async whole(most) {
      if (blob.size <= most) return { blob, url: "" };
      const megabytes = Math.floor(most / (1 << 20));
      throw new BookError(`${name} is larger than ${megabytes} MB; split it and open a part.`, {
        code: "tooLarge",
        source: name,
      });
    },
  };
}

/** Returns a blob's bytes. Rejects with a `BookError` if its file is gone. */
export async function bytesOf(blob: Blob, name: string): Promise<Uint8Array<ArrayBuffer>> {
  try {
    return new Uint8Array(await blob.arrayBuffer());
  } catch {
    throw new BookError(`${name} cannot be read any more; choose the file again.`, {
      code: "gone",
      source: name,
    });
  }
}

/** Returns a media type without its parameters, in lower case. */
function mediaType(header: string | null): string {
  return (header ?? "").split(";", 1)[0]?.trim().toLowerCase() ?? "";
}

/** Returns the whole file's length, from the response to a request for its start. */
function lengthOf(response: Response): number | undefined {
  const total = /\/(\d+)$/.exec(response.headers.get("content-range") ?? "")?.[1];
  const length = total ?? (response.status === 200 ? response.headers.get("content-length") : null);
  return length ? Number(length) : undefined;
}
