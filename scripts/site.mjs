/**
 * Makes the project's web site, for any server of files.
 *
 *   node scripts/site.mjs [folder]    target/site without one
 */
import { join, resolve } from "node:path";
import { makeSite } from "./site/site.mjs";

const out = resolve(process.argv[2] ?? join(import.meta.dirname, "../target/site"));
try {
  console.log(
    `${makeSite(out)} pages in ${out}; look at them by: python3 -m http.server --directory ${out}`,
  );
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
}
