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
