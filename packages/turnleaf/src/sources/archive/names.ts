/**
 * Returns a file's path from the archive's root, where paths that are absolute begin too; null if it
 * leads out of the archive, or is none.
 */
export function cleanPath(path: string): string | null {
  const steps: string[] = [];
  for (const step of path.replace(/^[a-z]:/i, "").split(/[/\\]/)) {
    if (step !== "..") {
      if (step !== "." && step !== "") steps.push(step);
    } else if (steps.pop() === undefined) return null;
  }
  return steps.join("/") || null;
}
