/** The test books of w3c/epub-tests, as its own script packs them. */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join, relative } from "node:path";
import { zipSync } from "fflate";
import { corpora } from "../../scripts/corpora.mjs";
import { silentRecording } from "../silent_recording.mjs";

/** The folder of the tests. */
export const folder = join(corpora["epub-tests"].folder, "tests");

/** Returns the names of the tests in order; their templates are none. */
export function testNames() {
  if (!existsSync(folder)) {
    console.error("The test books are not here: run `make corpora`, then this again.");
    process.exit(1);
  }
  return readdirSync(folder, { withFileTypes: true })
    .filter((entry) => entry.isDirectory() && !entry.name.startsWith("xx-"))
    .map(({ name }) => name);
}

/** The longest recording, which copies of the collection may lack, as they leave out what is large. */
const recording = "EPUB/audio/mobydick.mp4";

/** Seconds of silence that stand in for it, which ends after 182 s. */
const silence = 200;

/** Returns whether a test's recording is not here, so that silence is heard in its place. */
export function stoodInFor(test) {
  const manifest = join(folder, test, "EPUB/package.opf");
  return (
    existsSync(manifest) &&
    readFileSync(manifest, "utf8").includes('href="audio/mobydick.mp4"') &&
    !existsSync(join(folder, test, recording))
  );
}

/** Returns the files of a test by their paths in its archive, `mimetype` first. */
export function filesOf(test) {
  const root = join(folder, test);
  const paths = readdirSync(root, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile() && entry.name !== ".DS_Store")
    .map((entry) => relative(root, join(entry.parentPath, entry.name)))
    .sort();
  const ordered = ["mimetype", ...paths.filter((path) => path !== "mimetype")];
  const files = Object.fromEntries(ordered.map((path) => [path, readFileSync(join(root, path))]));
  if (stoodInFor(test)) files[recording] = silentRecording(silence);
  return files;
}

/** Where a ZIP's headers have the method of compression, by their marks; and that of bzip2. */
const methodAt = [
  [0x04034b50, 8],
  [0x02014b50, 10],
];
const bzip2 = 12;

/** Says in a ZIP that what is deflated in it is compressed by bzip2. */
function claimBzip2(zip) {
  const view = new DataView(zip.buffer, zip.byteOffset, zip.byteLength);
  for (let at = 0; at + 12 < zip.length; at++) {
    for (const [mark, method] of methodAt) {
      const isDeflated =
        view.getUint32(at, true) === mark && view.getUint16(at + method, true) === 8;
      if (isDeflated) view.setUint16(at + method, bzip2, true);
    }
  }
  return zip;
}

/**
 * Returns a test's book.
 *
 * @param left files whose paths match are left out
 */
export function bookOf(test, left = /^$/) {
  // Split archives come as their segments.
  const segment = join(folder, `${test}.z01`);
  if (existsSync(segment)) return readFileSync(segment);
  const packed = Object.entries(filesOf(test)).filter(([path]) => !left.test(path));
  const zip = zipSync(
    Object.fromEntries(
      packed.map(([path, bytes]) => [path, [bytes, { level: path === "mimetype" ? 0 : 6 }]]),
    ),
  );
  return test === "ocf-zip-comp" ? claimBzip2(zip) : zip;
}

/** Returns a test's package document. */
function packageOf(files) {
  const container = files["META-INF/container.xml"].toString();
  const [, path] = /full-path="([^"]+)"/.exec(container);
  return files[path].toString();
}

/**
 * Returns what a test says of itself: its identifier, by which reports name it,
 * the version of EPUB with which it came, and what it asks for, in words.
 */
export function factsOf(test) {
  const xml = packageOf(filesOf(test));
  const textIn = (pattern) =>
    (pattern.exec(xml)?.[1] ?? "")
      .replace(/<[^>]*>/g, "")
      .replace(/\s+/g, " ")
      .trim();
  return {
    id: textIn(/<dc:identifier[^>]*>([\s\S]*?)<\/dc:identifier>/) || test,
    version: textIn(/property="schema:version"[^>]*>([^<]*)</) || "3.3",
    isDeprecated: />\s*deprecated\s*</.test(xml),
    asks: textIn(/<dc:description[^>]*>([\s\S]*?)<\/dc:description>/),
  };
}
