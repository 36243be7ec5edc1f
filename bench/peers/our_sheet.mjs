/**
 * The engine's own sheet on the scene of the hanging page.
 *
 *   node bench/peers/our_sheet.mjs [FILE.wasm]
 *
 * Prints the processor's time of a frame once the page hangs still, as JSON: `cpu_us`, microseconds,
 * and the error of the drop. Fails without target/trials.wasm (`node scripts/build_wasm.mjs --trials`).
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";

const root = join(import.meta.dirname, "../..");

/** The page, SI units, and its load: (grammage g) width^3 / stiffness. */
export const PAGE = { width: 0.148, height: 0.21, columns: 12, rows: 16, grammage: 0.07 };
export const GAMMA = 10;
/** The longest settling of any contestant, in frames of 1/60 s. */
export const LONGEST_SETTLING = 20 * 60;

/** Returns exact reach and drop of a clamped strip under a load. */
export function exactTip(gamma) {
  const table = readFileSync(join(root, "engine/tests/anchors/heavy_elastica.csv"), "utf8");
  const row = table.split("\n").find((line) => Number(line.split(",")[0]) === gamma);
  const [, reach, drop] = row.split(",").map(Number);
  return { reach, drop };
}

/** Returns the engine's sheet, hanging still, or undefined if this WASM has none. */
export async function ourSheet(file = join(root, "target/trials.wasm")) {
  const { instance } = await WebAssembly.instantiate(readFileSync(file), {});
  const engine = instance.exports;
  if (!engine.tl_bench_sheet_new) return undefined;
  const handle = engine.tl_bench_sheet_new(PAGE.columns, PAGE.rows, GAMMA);
  const frame = () => engine.tl_bench_sheet_frame(handle);
  for (let count = 0; count < LONGEST_SETTLING; count++) frame();
  const drop = engine.tl_bench_sheet_drop(handle);
  const dropError = drop / exactTip(GAMMA).drop - 1;
  return { name: "turnleaf", drop, dropError, frame };
}

if (process.argv[1] === import.meta.filename) {
  const { frame, dropError } = await ourSheet(process.argv[2]);
  const frames = 400;
  const start = process.cpuUsage();
  for (let count = 0; count < frames; count++) frame();
  const { user, system } = process.cpuUsage(start);
  console.log(JSON.stringify({ cpu_us: (user + system) / frames, dropError }));
}
