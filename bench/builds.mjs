/**
 * What scenes of a book cost in the engine's WASM as it is shipped, beside that of other commits: leaves
 * that are riffled, whole and dog-eared, turned and back, torn out, torn across and crumpled.
 *
 *   node --no-liftoff bench/builds.mjs [commit ...]
 *
 * Processor time in milliseconds of all frames of a scene and of making its book: the least of five
 * rounds in which the builds take turns, so that what else the machine does counts for little. With --no-liftoff all code is compiled
 * before it is measured.
 */
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { foldedTurns, riffleFrames, tornFrames } from "./scenes.mjs";

const root = join(import.meta.dirname, "..");
const folder = "packages/turnleaf/src/engine";
const rounds = 5;

/** The file that each scene needs, and what plays it. */
const scenes = {
  "a riffle, one leaf in the air": ["turnleaf", (wasm) => riffleFrames(wasm, 1)],
  "a riffle, three": ["turnleaf", (wasm) => riffleFrames(wasm, 3)],
  "a riffle, ten": ["turnleaf", (wasm) => riffleFrames(wasm, 10)],
  "a riffle of dog-eared leaves, one": ["creases", (wasm) => riffleFrames(wasm, 1, true)],
  "a riffle of dog-eared leaves, three": ["creases", (wasm) => riffleFrames(wasm, 3, true)],
  "one dog-eared leaf, turned and back": ["creases", (wasm) => foldedTurns(wasm, 1, 4)],
  "three dog-eared leaves": ["creases", (wasm) => foldedTurns(wasm, 3, 4)],
  "two leaves torn out, crumpled and torn across": [
    "creases",
    (wasm) => tornFrames(wasm, false, 2),
  ],
};

/** Returns the modules of a commit; of the files as they are without one. */
async function build(commit) {
  const modules = {};
  for (const name of ["turnleaf", "creases"]) {
    const file = `${folder}/${name}.wasm`;
    const bytes = commit
      ? execFileSync("git", ["show", `${commit}:${file}`], { cwd: root, maxBuffer: 1 << 26 })
      : readFileSync(join(root, file));
    modules[name] = await WebAssembly.compile(bytes);
  }
  return { name: commit ?? "now", modules };
}

const builds = await Promise.all([...process.argv.slice(2), undefined].map(build));
for (const [scene, [file, play]] of Object.entries(scenes)) {
  const least = builds.map(() => Number.POSITIVE_INFINITY);
  for (let round = 0; round < rounds; round++) {
    for (const [k, { modules }] of builds.entries()) {
      const { exports } = await WebAssembly.instantiate(modules[file], {});
      const from = process.cpuUsage();
      play(exports);
      least[k] = Math.min(least[k], process.cpuUsage(from).user / 1000);
    }
  }
  const figures = builds.map(({ name }, k) => `${name} ${least[k].toFixed(0)}`);
  console.log(`${scene.padEnd(46)} ${figures.join("   ")} ms`);
}
