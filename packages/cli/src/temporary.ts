/**
 * Folders for files that last as long as the command. The process removes those that its thread leaves when
 * it ends without it.
 */

import { rmSync } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** How often a folder is removed in which a program that ends may still write. */
const attempts = { recursive: true, force: true, maxRetries: 5 } as const;

/** A folder that was made or removed, or the program that writes into it. */
export interface TemporaryNote {
  readonly folder: string;
  /** Its process id; it is ended before the folder is removed. */
  readonly program?: number | undefined;
  readonly isRemoved?: boolean;
}

let report: (note: TemporaryNote) => void = () => {};

/** Calls `listener` for each folder of this thread from now on. */
export function watchTemporary(listener: (note: TemporaryNote) => void): void {
  report = listener;
}

/** Makes a folder for temporary files, whose name begins with `name`. Rejects if there can be none. */
export async function makeTemporary(name: string): Promise<string> {
  const folder = await mkdtemp(join(tmpdir(), `turnleaf-${name}-`));
  report({ folder });
  return folder;
}

/** Notes which program writes into a temporary folder. */
export function noteProgram(folder: string, program: number | undefined): void {
  report({ folder, program });
}

/** Removes a temporary folder. Rejects if it cannot be removed. */
export async function removeTemporary(folder: string): Promise<void> {
  await rm(folder, attempts);
  report({ folder, isRemoved: true });
}

/** The temporary folders of a thread, held by another, for the time when the first no longer runs. */
export class TemporaryFolders {
  readonly #programs = new Map<string, number | undefined>();

  /** Takes what the listener of `watchTemporary` receives. */
  note({ folder, program, isRemoved }: TemporaryNote): void {
    if (isRemoved) this.#programs.delete(folder);
    else this.#programs.set(folder, program);
  }

  /** Ends the programs that write into folders, and removes these. */
  remove(): void {
    for (const [folder, program] of this.#programs) {
      try {
        if (program !== undefined) process.kill(program, "SIGKILL");
      } catch {
        // It has ended.
      }
      try {
        rmSync(folder, attempts);
      } catch {
        // The process ends all the same.
      }
    }
  }
}
