/** Where the programs are that the tests in three engines start. */
import { existsSync, readdirSync } from "node:fs";
import { delimiter, join } from "node:path";
import { findChromium } from "./chromium.mjs";

const onPath = (names) =>
  (process.env.PATH ?? "")
    .split(delimiter)
    .flatMap((folder) => names.map((name) => join(folder, name)));

const firstThatExists = (files) => files.find((file) => file && existsSync(file));

/** The folders that a pattern with one "*" as a folder's name stands for. */
function foldersLike(pattern) {
  const [before, after] = pattern.split("*");
  if (!existsSync(before)) return [];
  return readdirSync(before).map((name) => join(before, name, after));
}

/** The path of a Firefox: the environment variable FIREFOX first, then the PATH, then the usual places. */
export function findFirefox() {
  return firstThatExists([
    process.env.FIREFOX,
    ...onPath(["firefox-esr", "firefox"]),
    "/Applications/Firefox.app/Contents/MacOS/firefox",
  ]);
}

/** The path of WebKitGTK's WebDriver: the environment variable WEBKIT_DRIVER first, then the PATH. */
export function findWebKitDriver() {
  return firstThatExists([process.env.WEBKIT_DRIVER, ...onPath(["WebKitWebDriver"])]);
}

/** The path of WebKitGTK's MiniBrowser, which lies beside the library, in a folder of its version. */
export function findMiniBrowser() {
  const folders = [...foldersLike("/usr/lib/*/"), "/usr/libexec", "/usr/lib", "/usr/lib64"];
  const versions = ["webkitgtk-6.0", "webkit2gtk-4.1", "webkit2gtk-4.0"];
  return firstThatExists([
    process.env.MINI_BROWSER,
    ...folders.flatMap((folder) => versions.map((version) => join(folder, version, "MiniBrowser"))),
  ]);
}

/** The path of Xvfb, a screen in memory. */
export const findXvfb = () => firstThatExists(onPath(["Xvfb"]));

/** Mesa's driver that draws OpenGL without a graphics card. */
const findSoftwareGl = () =>
  firstThatExists(
    [...foldersLike("/usr/lib/*/dri"), "/usr/lib/dri", "/usr/lib64/dri"].map((folder) =>
      join(folder, "swrast_dri.so"),
    ),
  );

/**
 * What the tests need and this machine does not have: what it is, and the packages that
 * have it, by their names in Debian and Ubuntu, in the order to try them.
 * WebKitGTK is for Linux alone, and only there does Firefox need a screen.
 * @param {string} [only] "chromium": nothing else is needed
 */
export function missingBrowsers(only) {
  const chromium = [["a Chromium (CHROMIUM)", findChromium(), ["chromium", "chromium-browser"]]];
  const others = [["a Firefox (FIREFOX)", findFirefox(), ["firefox-esr", "firefox"]]];
  const onLinux = [
    ["WebKitWebDriver (WEBKIT_DRIVER)", findWebKitDriver(), ["webkit2gtk-driver"]],
    [
      "WebKitGTK's MiniBrowser (MINI_BROWSER)",
      findMiniBrowser(),
      ["libwebkit2gtk-4.1-0", "libwebkitgtk-6.0-4"],
    ],
    ["Xvfb", findXvfb(), ["xvfb"]],
    // With it come Mesa's drivers in software, which give Firefox WebGL.
    ["OpenGL in software", findSoftwareGl(), ["libgl1-mesa-dri"]],
  ];
  const isLinux = process.platform === "linux";
  const needed =
    only === "chromium" ? chromium : [...chromium, ...others, ...(isLinux ? onLinux : [])];
  return needed.filter(([, file]) => !file).map(([name, , packages]) => ({ name, packages }));
}
