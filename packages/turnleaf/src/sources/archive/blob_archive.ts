import { bytesOf } from "../book_file.ts";
import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { BookError } from "../page_source.ts";
import type { Archive } from "./archive.ts";

/** The files of an archive that lie unpacked: each as it is, or why it cannot be read. */
export class BlobArchive implements Archive {
  readonly names: readonly string[];
  readonly damage: BookError | undefined;
  readonly #name: string;
  #files: ReadonlyMap<string, Blob | BookError>;

  /**
   * @param name the archive's name in sentences
   * @param files by their paths
   * @param damage what is wrong with the whole of it
   */
  constructor(
    name: string,
    files: ReadonlyMap<string, Blob | BookError>,
    damage?: BookError | undefined,
  ) {
    this.damage = damage;
    this.#name = name;
    this.#files = files;
    this.names = [...files.keys()];
  }

  size(name: string): number {
    const file = this.#files.get(name);
    return file instanceof Blob ? file.size : 0;
  }

  async read(name: string, most: number = limits.archivedBytes): Promise<Uint8Array<ArrayBuffer>> {
    const file = this.#file(name);
    if (file.size <= most) return await bytesOf(file, this.#name);
    throw new BookError(
      `${cleanText(name)} in ${this.#name} is larger than ${Math.floor(most / (1 << 20))} MB when unpacked; make it smaller.`,
      { code: "tooLarge", source: name },
    );
  }

  async readStart(name: string, length: number): Promise<Uint8Array<ArrayBuffer>> {
    return await bytesOf(this.#file(name).slice(0, length), this.#name);
  }

  close(): void {
    this.#files = new Map();
  }

  #file(name: string): Blob {
    const file = this.#files.get(name);
    if (file instanceof Blob) return file;
    throw (
      file ??
      new BookError(`${this.#name} has no file ${name}; get it again.`, {
        code: "damaged",
        source: this.#name,
      })
    );
  }
}
