/**
 * Writes where the repository is into what names it: both packages and the workspace.
 *
 *   node scripts/set_repository.mjs https://example.org/turnleaf.git
 *
 * Until there is one, package.json has no such field and README.md says `ADDRESS-OF-THIS-REPOSITORY`.
 */
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const placeholder = "ADDRESS-OF-THIS-REPOSITORY";
const root = join(import.meta.dirname, "..");
const [address] = process.argv.slice(2);
if (!URL.canParse(address ?? "")) {
  console.error("Say where the repository is: node scripts/set_repository.mjs ADDRESS");
  process.exit(1);
}
for (const folder of ["", "packages/turnleaf", "packages/cli"]) {
  const file = join(root, folder, "package.json");
  const about = JSON.parse(readFileSync(file, "utf8"));
  about.repository = { type: "git", url: address, ...(folder && { directory: folder }) };
  writeFileSync(file, `${JSON.stringify(about, null, 2)}\n`);
}
const readme = join(root, "README.md");
writeFileSync(readme, readFileSync(readme, "utf8").replaceAll(placeholder, address));
