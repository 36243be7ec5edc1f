/** Returns a file's path from the archive's root; null if it leads out of it. */
export function cleanPath(path: string): string | null {
  const steps = path.replaceAll("\\", "/").split("/");
  const isInside = !steps.includes("..") && !/^([a-z]:|$)/i.test(steps[0] ?? "");
  return isInside ? steps.filter((step) => step !== "." && step !== "").join("/") : null;
}
