/**
 * The paper's Table 1 in the browser: a turn simulated for every drawn frame, and
 * the same turn played from key frames, both by what the package ships, in a real
 * Chromium.
 *
 *   npm run build
 *   node bench/table1.mjs [--model sheet] [--seconds 11.4] [--runs 10] [--json]
 *
 * Counted: all computation from the gesture or the key frames to 676 points and
 * their normals, for each frame of 60 Hz. Not counted: recording, reading the
 * file, and drawing on a screen.
 */
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "../scripts/chromium.mjs";

const { values } = parseArgs({
  options: {
    model: { type: "string", default: "sheet" },
    seconds: { type: "string", default: "11.4" },
    runs: { type: "string", default: "10" },
    json: { type: "boolean", default: false },
  },
});
const dist = join(import.meta.dirname, "../packages/turnleaf/dist");

/** Runs in the page. */
async function table({ model, seconds, runs }) {
  const { LooseLeaf } = await import("/models.js");
  const { decodeTurn, TurnRecorder, writeNormals } = await import("/keyframes.js");
  const leaf = await LooseLeaf.create({ model, interpolate: true, preset: "book" });
  const { width = 0.148, height = 0.21 } = leaf.options;
  const frames = Math.round(seconds * 60);
  const even = Array.from({ length: 26 }, (_, i) => i / 25);
  const recorder = new TurnRecorder({ width, height, u: even, v: even, model });
  leaf.play("edge", "left", seconds);
  const start = leaf.time;
  for (let frame = 0; frame <= frames; frame++) {
    if (frame > 0) leaf.advance(1 / 60);
    leaf.update();
    recorder.add(leaf.time - start, leaf.surface().positions);
  }
  const file = recorder.finish();
  const turn = decodeTurn(file.bytes);
  const positions = new Float32Array(3 * 676);
  const normals = new Float32Array(3 * 676);
  const milliseconds = (work) => {
    const start = performance.now();
    work();
    return performance.now() - start;
  };
  const live = () => {
    leaf.play("edge", "left", seconds);
    return milliseconds(() => {
      for (let frame = 1; frame <= frames; frame++) {
        leaf.advance(1 / 60);
        leaf.update();
      }
    });
  };
  const replay = () =>
    milliseconds(() => {
      for (let frame = 1; frame <= frames; frame++) {
        turn.sample(frame / 60, positions);
        writeNormals(26, 26, positions, normals);
      }
    });
  const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];
  replay();
  const rows = Array.from({ length: runs }, () => ({
    live_ms: live(),
    replay_ms: median([replay(), replay(), replay()]),
  }));
  leaf.destroy();
  return { rows, key_frames: turn.frames, bytes: file.bytes.length, replay_error: file.error };
}

const server = createServer((request, response) => {
  const name = request.url.slice(1);
  const isScript = /^[\w-]+\.js$/.test(name);
  response.writeHead(isScript || name === "" ? 200 : 404, {
    "Content-Type": isScript ? "text/javascript" : "text/html",
  });
  response.end(isScript ? readFileSync(join(dist, name)) : "<!doctype html><title>Table 1</title>");
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
try {
  const page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  const { model } = values;
  const [seconds, runs] = [Number(values.seconds), Number(values.runs)];
  const found = await page.evaluate(table, { model, seconds, runs });
  const mean = (name) => found.rows.reduce((sum, row) => sum + row[name], 0) / runs;
  const [live, replay] = [mean("live_ms"), mean("replay_ms")];
  const saved = 100 * (1 - replay / live);
  const summary = { mean_live_ms: live, mean_replay_ms: replay, reduction_percent: saved };
  if (values.json) console.log(JSON.stringify({ model, seconds, ...found, ...summary }, null, 2));
  else {
    console.log(
      `One turn of ${model}, ${seconds} s, ${Math.round(seconds * 60)} frames; ms a turn.`,
    );
    console.log(
      `${found.key_frames} key frames, ${found.bytes} bytes, at most ${(100 * found.replay_error).toFixed(3)} % of the width from the turn.\n`,
    );
    console.log("  run      live    replay   saved");
    const row = (name, live, replay) =>
      console.log(
        `${String(name).padStart(5)} ${live.toFixed(3).padStart(9)} ${replay.toFixed(3).padStart(9)} ${(100 * (1 - replay / live)).toFixed(1).padStart(6)} %`,
      );
    for (const [at, { live_ms, replay_ms }] of found.rows.entries())
      row(at + 1, live_ms, replay_ms);
    row("mean", live, replay);
  }
} finally {
  await browser.close();
  server.close();
}
