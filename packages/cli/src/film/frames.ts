/**
 * The frames of a film on the disk, and a note beside them from which an
 * interrupted film goes on.
 */

import { createHash } from "node:crypto";
import { constants } from "node:fs";
import {
  access,
  copyFile,
  mkdir,
  readdir,
  readFile,
  rename,
  rm,
  writeFile,
} from "node:fs/promises";
import { join } from "node:path";
import { fileProblem, Problem, printable } from "../problem.ts";
import { readRegular } from "../regular_file.ts";

const noteName = "film.json";
/** Maximum of bytes of a note: more than that of any film has. */
const longestNote = 1_000_000;
/** Maximum of pictures of a film: their numbers have six digits. */
export const mostPictures = 999_999;

/** The state of a film besides its pictures. */
interface Note {
  /** Hash of everything that determines its pictures. */
  readonly request: string;
  readonly fps: number;
  readonly width: number;
  readonly height: number;
  /**
   * Pictures of the pause before the first turn or action, and of each complete
   * one with the pause after it.
   */
  parts: number[];
  whole: boolean;
}

/** Returns a short name of everything that makes films differ. */
export function requestName(request: object): string {
  return createHash("sha256").update(JSON.stringify(request)).digest("hex").slice(0, 32);
}

/** A folder of numbered pictures. */
export class Frames {
  readonly folder: string;
  readonly #note: Note;

  private constructor(folder: string, note: Note) {
    this.folder = folder;
    this.#note = note;
  }

  /**
   * Opens the folder of a film; existing pictures of the same film are kept.
   *
   * @param isOurs whether the folder is the command's own, whose pictures of
   * another film may be deleted
   * @throws Problem if the folder holds something else, or cannot be written
   */
  static async open(
    folder: string,
    film: { request: string; fps: number; width: number; height: number },
    isOurs: boolean,
  ): Promise<Frames> {
    try {
      await mkdir(folder, { recursive: true });
      const note = await readNote(join(folder, noteName));
      if (note?.request === film.request) return new Frames(folder, note);
      const names = await readdir(folder);
      if (names.length > 0 && !isOurs) {
        throw new Problem(
          `${printable(folder)} holds other files or another film; name another folder, or remove it.`,
        );
      }
      for (const name of names) if (isOwnName(name)) await rm(join(folder, name));
      const frames = new Frames(folder, { ...film, parts: [], whole: false });
      await frames.#keep();
      return frames;
    } catch (error) {
      throw error instanceof Problem ? error : fileProblem(folder, error);
    }
  }

  /** Complete parts: the pause at the beginning and the turns or actions after it. */
  get parts(): number {
    return this.#note.parts.length;
  }

  /** Pictures in the complete parts. */
  get count(): number {
    return this.#note.parts.reduce((sum, count) => sum + count, 0);
  }

  /** Whether every picture exists. */
  get isWhole(): boolean {
    return this.#note.whole;
  }

  /** Marks another part as complete. */
  async endPart(pictures: number): Promise<void> {
    this.#note.parts.push(pictures);
    await this.#keep();
  }

  /** Marks the film as complete. */
  async end(): Promise<void> {
    this.#note.whole = true;
    await this.#keep();
  }

  /** Returns whether picture `number` (from 0) exists. */
  async has(number: number): Promise<boolean> {
    const there = access(this.#file(number), constants.R_OK);
    return await there.then(
      () => true,
      () => false,
    );
  }

  /** Returns picture `number` (from 0), a PNG. */
  async read(number: number): Promise<Buffer> {
    return await readFile(this.#file(number)).catch((error: unknown) => {
      throw fileProblem(this.folder, error);
    });
  }

  /** Writes a picture, completely or not at all. */
  async write(number: number, picture: Uint8Array): Promise<void> {
    const file = this.#file(number);
    await writeFile(`${file}.part`, picture).catch((error: unknown) => {
      throw fileProblem(this.folder, error);
    });
    await rename(`${file}.part`, file);
  }

  /** Writes a copy of another picture. */
  async repeat(number: number, as: number): Promise<void> {
    const file = this.#file(number);
    await copyFile(this.#file(as), `${file}.part`, constants.COPYFILE_FICLONE).catch(
      (error: unknown) => {
        throw fileProblem(this.folder, error);
      },
    );
    await rename(`${file}.part`, file);
  }

  /** Removes the folder. */
  async remove(): Promise<void> {
    await rm(this.folder, { recursive: true, force: true });
  }

  /** The name pattern of the pictures for film programs. */
  get pattern(): string {
    return join(this.folder.replaceAll("%", "%%"), "%06d.png");
  }

  #file(number: number): string {
    return join(this.folder, `${String(number + 1).padStart(6, "0")}.png`);
  }

  async #keep(): Promise<void> {
    const file = join(this.folder, noteName);
    await writeFile(`${file}.part`, `${JSON.stringify(this.#note)}\n`);
    await rename(`${file}.part`, file);
  }
}

function isOwnName(name: string): boolean {
  return /^\d{6}\.png(\.part)?$/.test(name) || name.startsWith(noteName);
}

/** Returns the note of a film, or null if there is no valid one. */
async function readNote(file: string): Promise<Note | null> {
  try {
    const note = JSON.parse(String(await readRegular(file, longestNote))) as Note;
    const { request, parts, whole } = note;
    const isNote =
      typeof request === "string" &&
      typeof whole === "boolean" &&
      Array.isArray(parts) &&
      parts.every((part) => Number.isInteger(part) && part > 0) &&
      parts.reduce((sum, part) => sum + part, 0) <= mostPictures;
    return isNote ? note : null;
  } catch {
    return null;
  }
}
