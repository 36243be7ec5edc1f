import { Problem, printable } from "../problem.ts";
import { findProgram } from "./find_program.ts";

/** What Chromium and its kin are called, and where they are where they are on no PATH. */
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
 * The file of a Chromium: the one named by --chromium, else by the environment
 * variable CHROMIUM, else one of the usual ones.
 * @throws Problem where there is none
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
