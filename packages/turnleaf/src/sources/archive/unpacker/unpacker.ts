/** libarchive's readers of RAR, 7-Zip and XZ, as WASM, over one archive that the caller reads for it. */

/** What `unpacker.wasm` exports; see `unpacker.c`. Pointers are places in its memory. */
interface Exports {
  readonly memory: WebAssembly.Memory;
  _initialize(): void;
  open(length: number, isXz: number): number;
  next(): number;
  isFile(): number;
  path(): number;
  isEncrypted(): number;
  unpack(): number;
  output(): number;
  reason(): number;
}

/** libarchive's statuses that mean success, or success with a remark. */
const [ok, end, retry, remark] = [0, 1, -10, -20];

/** Maximum of tries of one entry, and of bytes of a reason. */
const [mostTries, reasonLength] = [10, 400];

/** Statuses of WASI: success, no such file descriptor, not supported. */
const [success, badDescriptor, notSupported] = [0, 8, 52];

/** An archive that is damaged, or packed in a way that is not supported. */
export class UnpackingError extends Error {
  override readonly name: string = "UnpackingError";
}

/** Bytes of an archive. */
export interface ArchiveBytes {
  readonly length: number;
  /** Returns bytes from `offset` on, at most `length` and at least one. Throws if they cannot be read. */
  read(offset: number, length: number): Uint8Array;
}

/** What is unpacked: an archive of files, or one file that is packed by XZ. */
export type Packing = "archive" | "xz";

/** An archive whose files are unpacked in their order. */
export class Unpacker {
  readonly #wasm: Exports;
  readonly #archive: ArchiveBytes;
  readonly #packing: Packing;

  /** Starts the code in `code`. Call `open` first. Rejects if the page's policy forbids WASM. */
  static async start(
    code: BufferSource,
    archive: ArchiveBytes,
    packing: Packing,
  ): Promise<Unpacker> {
    const module = await WebAssembly.compile(code);
    let wasm: Exports | undefined;
    const read = (to: number, offset: number, length: number): number => {
      try {
        const bytes = archive.read(offset, length).subarray(0, length);
        new Uint8Array((wasm as Exports).memory.buffer).set(bytes, to);
        return bytes.length;
      } catch {
        return -1;
      }
    };
    // It has no files, no clock and no environment.
    const rejected: Record<string, (...pointers: number[]) => number> = {};
    for (const { name, module: from } of WebAssembly.Module.imports(module)) {
      if (from !== "page") rejected[name] = () => notSupported;
    }
    rejected.fd_prestat_get = () => badDescriptor;
    rejected.environ_get = () => success;
    rejected.environ_sizes_get = (count, length) => {
      const memory = new DataView((wasm as Exports).memory.buffer);
      memory.setUint32(count, 0, true);
      memory.setUint32(length, 0, true);
      return success;
    };
    const { exports } = await WebAssembly.instantiate(module, {
      page: { read },
      wasi_snapshot_preview1: rejected,
    });
    wasm = exports as unknown as Exports;
    wasm._initialize();
    return new Unpacker(wasm, archive, packing);
  }

  private constructor(wasm: Exports, archive: ArchiveBytes, packing: Packing) {
    this.#wasm = wasm;
    this.#archive = archive;
    this.#packing = packing;
  }

  /** Opens the archive from its start, again if it is open. Throws an `UnpackingError` if it is none. */
  open(): void {
    const isXz = this.#packing === "xz" ? 1 : 0;
    if (this.#wasm.open(this.#archive.length, isXz) !== ok) throw this.#failure();
  }

  /** Goes on to the next entry. Returns false if there is none. Throws an `UnpackingError`. */
  next(): boolean {
    const status = this.#repeat(() => this.#wasm.next());
    if (status === end) return false;
    if (status !== ok && status !== remark) throw this.#failure();
    return true;
  }

  /** Returns whether the entry is a file, no folder and no link. */
  isFile(): boolean {
    return this.#wasm.isFile() !== 0;
  }

  /** Returns the entry's path as the archive has it; null if it has more than `most` bytes. */
  path(most: number): string | null {
    const bytes = this.#text(this.#wasm.path(), most + 1);
    if (bytes.length > most) return null;
    try {
      return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    } catch {
      return new TextDecoder("latin1").decode(bytes);
    }
  }

  /** Returns whether an entry up to this one is encrypted, or the list of entries is. */
  isEncrypted(): boolean {
    return this.#wasm.isEncrypted() !== 0;
  }

  /** Returns the entry's next bytes, a copy; null at its end. Throws an `UnpackingError`. */
  unpack(): Uint8Array<ArrayBuffer> | null {
    const length = this.#repeat(() => this.#wasm.unpack());
    if (length < 0) throw this.#failure();
    if (length === 0) return null;
    const at = this.#wasm.output();
    return new Uint8Array(this.#wasm.memory.buffer.slice(at, at + length) as ArrayBuffer);
  }

  #repeat(call: () => number): number {
    for (let tries = 1; tries < mostTries; tries++) {
      const status = call();
      if (status !== retry) return status;
    }
    return call();
  }

  #failure(): UnpackingError {
    const reason = new TextDecoder().decode(this.#text(this.#wasm.reason(), reasonLength));
    return new UnpackingError(reason || "it is not understood");
  }

  /** Returns the bytes from a place on up to a zero, at most `most`. */
  #text(at: number, most: number): Uint8Array {
    const bytes = new Uint8Array(this.#wasm.memory.buffer, at).subarray(0, most);
    const length = bytes.indexOf(0);
    return bytes.slice(0, length < 0 ? most : length);
  }
}
