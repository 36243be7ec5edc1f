/**
 * Returns a file's path from the archive's root, where paths that are absolute, or lead out of it, begin
 * too; null if it is none.
 */
export function cleanPath(path: string): string | null {
  const steps: string[] = [];
  for (const step of path.replace(/^[a-z]:/i, "").split(/[/\\]/)) {
    if (step === "..") steps.pop();
    else if (step !== "." && step !== "") steps.push(step);
  }
  return steps.join("/") || null;
}

/** Gives files whose paths in an archive are the same paths of their own. */
export class OwnPaths {
  readonly #taken = new Set<string>();
  /** How many there are of each path. */
  readonly #counts = new Map<string, number>();

  /** Returns a path as it is the first time, and then with a number before its ending: "1 (2).png". */
  take(path: string): string {
    let own = path;
    let count = this.#counts.get(path) ?? 1;
    while (this.#taken.has(own)) {
      count += 1;
      own = path.replace(/(\.[^./]*)?$/, ` (${count})$1`);
    }
    this.#counts.set(path, count);
    this.#taken.add(own);
    return own;
  }
}
