import { accessSync, constants, statSync } from "node:fs";
import { delimiter, isAbsolute, join, sep } from "node:path";

/**
 * Returns the file of a program: of the first name that exists. A name with a
 * folder is used as it is, any other is looked up on the PATH.
 */
export function findProgram(
  names: readonly string[],
  environment: NodeJS.ProcessEnv = process.env,
): string | null {
  const folders = (environment.PATH ?? "").split(delimiter).filter((folder) => folder !== "");
  const endings = process.platform === "win32" ? ["", ".exe"] : [""];
  for (const name of names) {
    const hasFolder = isAbsolute(name) || name.includes("/") || name.includes(sep);
    const places = hasFolder ? [name] : folders.map((folder) => join(folder, name));
    const files = places.flatMap((place) => endings.map((ending) => place + ending));
    const found = files.find(isProgram);
    if (found !== undefined) return found;
  }
  return null;
}

function isProgram(file: string): boolean {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}
