import { spawnSync } from "node:child_process";
import { join } from "node:path";

/** Says before the tests of what is built that it is older than its sources, if make finds it so. */
export default function warnOfStaleBuild() {
  // Packages that were installed since are no change of the sources.
  const args = [
    "--question",
    "--old-file=node_modules/.package-lock.json",
    "packages/cli/dist/.built",
  ];
  const { status } = spawnSync("make", args, { cwd: join(import.meta.dirname, "..") });
  if (status === 1) {
    console.warn(
      "These tests run the viewer and the command as they were built, which is before the last change of their sources: run make build.",
    );
  }
}
