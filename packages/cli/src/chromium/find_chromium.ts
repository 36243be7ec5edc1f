import { Problem, printable } from "../problem.ts";
import { findProgram } from "./find_program.ts";

/** Names of Chromium and its relatives, and their locations outside the PATH. */
const usual = [
  "chromium",
  "chromium-browser",
  "google-chrome",
  "google-chrome-stable",
  "chrome",
  "microsoft-edge",
  "/snap/bin/chromium",
  "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
  "/Applications/Chromium.app/Contents/MacOS/Chromium",
  "C:\\Program Files\\Google\\Chrome\\Application\\chrome.exe",
  "C:\\Program Files (x86)\\Microsoft\\Edge\\Application\\msedge.exe",
];

/**
 * Returns the file of a Chromium: the one named by --chromium, otherwise by the
 * environment variable CHROMIUM, otherwise one of the usual ones.
 *
 * @throws Problem if there is none
 */
export function findChromium(
  named: string | undefined,
  environment: NodeJS.ProcessEnv = process.env,
): string {
  const asked = named ?? environment.CHROMIUM;
  const found = findProgram(asked === undefined ? usual : [asked], environment);
  if (found !== null) return found;
  throw new Problem(
    asked === undefined
      ? "No Chromium was found on this machine; install Chromium or Chrome, or name one with --chromium."
      : `${printable(asked)} is no program; name a Chromium or Chrome.`,
  );
}
