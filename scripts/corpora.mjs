/**
 * Fetches public collections of books, each at one commit, into a folder that is
 * not part of this repository: those that reports are made of.
 *
 *   node scripts/corpora.mjs
 */
import { execFileSync } from "node:child_process";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(import.meta.dirname, "..");

const collection = (name, address, commit) => ({
  address,
  commit,
  folder: join(root, "corpora", name),
});

/** The collections by name: address, commit, and the folder where it lies. */
export const corpora = {
  "epub-tests": collection(
    "epub-tests",
    "https://github.com/w3c/epub-tests.git",
    "ec9085b1377668921eb252496163524fdbbb3b42",
  ),
  "iiif-cookbook": collection(
    "iiif-cookbook",
    "https://github.com/IIIF/cookbook-recipes.git",
    "31efecaa32559de29c640d43329278c2dd8e0e3a",
  ),
};

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

/** Fetches one commit of a collection, without its history. */
function fetchCollection({ address, commit, folder }) {
  mkdirSync(folder, { recursive: true });
  const git = (...what) => execFileSync("git", ["-C", folder, ...what], { stdio: "inherit" });
  git("init", "--quiet");
  git("fetch", "--quiet", "--depth", "1", address, commit);
  git("checkout", "--quiet", "--force", commit);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  for (const [name, one] of Object.entries(corpora)) {
    try {
      if (commitIn(one.folder) !== one.commit) fetchCollection(one);
    } catch {
      console.error(`${name} could not be fetched from ${one.address}; see git's words above.`);
      process.exit(1);
    }
    console.log(`${name} ${one.commit}`);
  }
}
