import { writeFile } from "node:fs/promises";
import { type TurnFile, TurnRecorder } from "turnleaf/keyframes";
import packageJson from "../../package.json" with { type: "json" };
import { fileProblem, Problem, printable } from "../problem.ts";
import { Progress } from "../progress.ts";
import type { BakeCommand } from "./bake_arguments.ts";
import { meshOf } from "./baked_mesh.ts";
import { atRate, keepFrames, pointsOf, simulate, type Turn } from "./baked_turn.ts";
import { writeGlb } from "./glb.ts";
import { writeObj } from "./obj.ts";
import { readPageImage } from "./page_image.ts";

/**
 * Simulates the turn of a leaf and writes it for other programs.
 * @throws Problem
 */
export async function bake(command: BakeCommand, signal: AbortSignal): Promise<void> {
  const { out, format, model } = command;
  const [front, back] = [await readPageImage(command.front), await readPageImage(command.back)];
  const progress = new Progress();
  let turn: Turn;
  try {
    turn = await simulate(
      command,
      (seconds, about) => progress.show(seconds / about, `${model}, ${seconds.toFixed(2)} s`),
      signal,
    );
  } catch (error) {
    throw signal.aborted ? new Problem("Stopped; nothing was written.") : error;
  } finally {
    progress.clear();
  }
  const { frames, creased } = turn;
  const points = pointsOf(command);
  const mesh = meshOf(points, creased);
  const seconds = frames.at(-1)?.time ?? 0;
  const extras = {
    ...{ model, gesture: command.gesture, stock: command.stock, seconds },
    ...{ width: command.width, height: command.height, tolerance: command.tolerance },
    ...(creased && { creases: command.creases }),
  };
  const report = (what: string): void =>
    console.log(`${printable(out)}: ${what}, ${seconds.toFixed(2)} s`);
  if (format === "glb") {
    const kept = keepFrames(frames, command.tolerance * command.width);
    const generator = `Turnleaf ${packageJson.version}`;
    const bytes = writeGlb(mesh, kept, { generator, front, back, extras });
    await write(out, bytes);
    report(`${kept.length - 1} morph targets, ${kilobytes(bytes)}`);
  } else if (format === "tlkf") {
    const { bytes, error, frames: kept } = keyFrames(command, turn);
    await write(out, bytes);
    report(
      `${kept} key frames, ${kilobytes(bytes)}, error ${(100 * error).toFixed(3)} % of the width`,
    );
  } else {
    const steady = atRate(frames, command.fps);
    if (format === "json") await write(out, json(command, { frames: steady, creased }, extras));
    else {
      const name = out.replace(/\.obj$/i, "");
      for (const { ending, text } of writeObj(name, mesh, steady, command)) {
        if (signal.aborted) throw new Problem("Stopped; some of the files were written.");
        await write(name + ending, text);
      }
    }
    report(`${steady.length} frames`);
  }
}

/** Returns the file of key frames of a turn. */
function keyFrames(command: BakeCommand, { frames, creased }: Turn): TurnFile {
  const recorder = new TurnRecorder({ ...command, ...pointsOf(command), creased });
  try {
    for (const { time, positions } of frames) recorder.add(time, positions);
    return recorder.finish(command.tolerance);
  } catch (error) {
    // Too many points and frames, or a tolerance that no file has.
    if (!(error instanceof RangeError)) throw error;
    throw new Problem(
      `${printable(command.out)} cannot be written: ${error.message} Take fewer --points or --seconds, or another --tolerance.`,
    );
  }
}

function json(command: BakeCommand, { frames, creased }: Turn, extras: object): string {
  const { u, v } = pointsOf(command);
  const short = (value: number) => Math.round(value * 1e6) / 1e6;
  return `${JSON.stringify({
    generator: `Turnleaf ${packageJson.version}`,
    ...extras,
    fps: command.fps,
    u: Array.from(u, short),
    v: Array.from(v, short),
    ...(creased && {
      places: Array.from(creased.places, short),
      triangles: Array.from(creased.triangles),
      parts: Array.from(creased.parts),
    }),
    frames: frames.map(({ positions }) => Array.from(positions, short)),
  })}\n`;
}

function kilobytes(bytes: Uint8Array): string {
  return `${(bytes.length / 1000).toFixed(1)} kB`;
}

async function write(file: string, content: Uint8Array | string): Promise<void> {
  await writeFile(file, content).catch((error: unknown) => {
    throw fileProblem(file, error, "written");
  });
}
