/**
 * Fetches public collections of books, each at one commit, into a folder that is
 * not part of this repository: those that reports are made of.
 *
 *   node scripts/corpora.mjs            all that scripts/corpora.json lists
 *   node scripts/corpora.mjs NAME ...   these alone
 *
 * A folder of the collections elsewhere is named by TURNLEAF_CORPORA.
 */
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(import.meta.dirname, "..");
const folder = process.env.TURNLEAF_CORPORA ?? join(root, "corpora");
const list = JSON.parse(readFileSync(join(import.meta.dirname, "corpora.json"), "utf8"));

/**
 * The collections by name: the address and the commit that are fetched, the
 * folders in it that are read, and the folder where it lies here.
 */
export const corpora = Object.fromEntries(
  list.map((one) => [one.name, { ...one, folder: join(folder, one.name) }]),
);

/** Returns the commit that lies in a folder; null if there is none. */
function commitIn(folder) {
  try {
    const options = { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] };
    const output = execFileSync(
      "git",
      ["-C", folder, "rev-parse", "--show-prefix", "HEAD"],
      options,
    );
    const [prefix, commit] = output.split("\n");
    // In a folder without a repository of its own git finds this one.
    return prefix === "" ? commit : null;
  } catch {
    return null;
  }
}

/** Fetches one commit of a collection, without its history: the folders that are read. */
function fetchCollection({ address, commit, folders, folder }) {
  mkdirSync(folder, { recursive: true });
  const git = (...what) => execFileSync("git", ["-C", folder, ...what], { stdio: "inherit" });
  git("init", "--quiet");
  git("config", "remote.origin.url", address);
  // What lies elsewhere in a collection, such as its programs, is neither fetched nor written.
  const patterns = folders.map((one) => (one === "." ? "/*" : `/${one}`));
  git("sparse-checkout", "set", "--no-cone", ...patterns);
  git("fetch", "--quiet", "--depth", "1", "--filter=blob:none", "origin", commit);
  git("checkout", "--quiet", "--force", commit);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const names = process.argv.slice(2);
  for (const [name, one] of Object.entries(corpora)) {
    if (names.length > 0 && !names.includes(name)) continue;
    try {
      if (commitIn(one.folder) !== one.commit) fetchCollection(one);
    } catch {
      console.error(`${name} could not be fetched from ${one.address}; see git's words above.`);
      process.exit(1);
    }
    console.log(`${name} ${one.commit}`);
  }
}
