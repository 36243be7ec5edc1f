/** An error described in one sentence for the user; the command then ends with status 1. */
export class Problem extends Error {}

/** The command line was not understood: status 2. */
export class UsageProblem extends Error {
  /** The valid usage, if it is narrower than that of the command as a whole. */
  help: string | undefined;
}

/** Control and direction-override characters, as in the viewer's `book_text.ts`. */
export const unprintable: RegExp = /[\p{Cc}\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff]+/gu;

/**
 * Returns a text from outside, such as a file's name or a title, made safe for a
 * terminal and no longer than so many characters.
 */
export function printable(text: string, most = 200): string {
  const line = [...text.replace(unprintable, " ").trim()];
  return line.length <= most ? line.join("") : `${line.slice(0, most - 1).join("")}…`;
}

/** Returns the sentence for an error of the file system at `path`, where it was read or written. */
export function fileProblem(
  path: string,
  error: unknown,
  work: "read" | "written" = "read",
): Problem {
  const name = printable(path);
  const code = (error as NodeJS.ErrnoException | null)?.code;
  if (code === "ENOENT" || code === "ENOTDIR") {
    return new Problem(`${name} was not found; check its name and folder.`);
  }
  if (code === "EACCES" || code === "EPERM") {
    const to = work === "read" ? "read" : "write";
    return new Problem(`${name} may not be ${work}; give yourself the permission to ${to} it.`);
  }
  if (code === "ELOOP") return new Problem(`${name} is a link that leads to itself; correct it.`);
  return new Problem(
    `${name} could not be ${work} (${code ?? "unknown error"}); check the disk it is on.`,
  );
}
