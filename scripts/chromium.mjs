import { existsSync } from "node:fs";
import { delimiter, join } from "node:path";

/** Where Debian, Ubuntu, macOS and Google put the browser, besides the PATH. */
const usualPlaces = [
  "/usr/bin/chromium",
  "/usr/bin/chromium-browser",
  "/usr/bin/google-chrome",
  "/snap/bin/chromium",
  "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
];

const usualNames = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/**
 * The path of a Chromium on this machine: the environment variable CHROMIUM
 * first, then the PATH, then the usual places.
 * @returns {string | undefined} undefined where there is none
 */
export function findChromium() {
  const onPath = (process.env.PATH ?? "")
    .split(delimiter)
    .flatMap((folder) => usualNames.map((name) => join(folder, name)));
  return [process.env.CHROMIUM, ...onPath, ...usualPlaces].find((file) => file && existsSync(file));
}

/**
 * Features without which a browser does less beside its pages. Of such flags the last one holds: this one has
 * those of Playwright's too, and the pages that drop down from the address bar of each window, two of
 * which take twice as long to load as opening an empty page.
 */
const disabledFeatures = [
  "AvoidUnnecessaryBeforeUnloadCheckSync",
  "DestroyProfileOnBrowserClose",
  "HttpsUpgrades",
  "HttpsFirstBalancedModeAutoEnable",
  "LensOverlay",
  "MediaRouter",
  "PaintHolding",
  "ThirdPartyStoragePartitioning",
  "AvoidCorsURLLoaderRestartOnRedirect",
  "OptimizationHints",
  "NetworkTimeServiceQuerying",
  "AimEnabled",
  "PreconnectToSearch",
  "WebUIOmniboxPopup",
  "WebUIOmniboxAimPopup",
  "WebUIOmniboxFullPopup",
];

/**
 * Flags for a Chromium that draws WebGL in software, without a window, and
 * speaks to nobody: the same for tests, pictures and benchmarks.
 */
export const chromiumArguments = [
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--ignore-gpu-blocklist",
  `--disable-features=${disabledFeatures.join(",")}`,
];
