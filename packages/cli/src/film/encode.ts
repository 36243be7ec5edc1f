/** Encodes numbered pictures as a film, by ffmpeg. */

import { spawn } from "node:child_process";
import { rename, rm } from "node:fs/promises";
import { dirname, extname, join } from "node:path";
import { findProgram } from "../chromium/find_program.ts";
import { fileProblem, Problem, printable } from "../problem.ts";
import type { Frames } from "./frames.ts";

/** The formats of a film. */
export const filmFormats = ["mp4", "webm", "gif", "webp", "png"] as const;
export type FilmFormat = (typeof filmFormats)[number];

/** Those that ffmpeg writes. */
export type EncodedFormat = Exclude<FilmFormat, "webp" | "png">;

/** Arguments of ffmpeg for each; pictures stay as they are. */
const codecs: Readonly<Record<EncodedFormat, readonly string[]>> = {
  mp4: ["-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"],
  webm: ["-c:v", "libvpx-vp9", "-crf", "30", "-b:v", "0", "-row-mt", "1", "-pix_fmt", "yuv420p"],
  // One palette for all of the film: 256 colours of its pages.
  gif: [
    "-vf",
    "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=bayer:bayer_scale=4",
  ],
};

/**
 * Returns the file of ffmpeg: named by the environment variable FFMPEG, or on
 * the PATH.
 *
 * @throws Problem if there is none
 */
export function findFfmpeg(environment: NodeJS.ProcessEnv = process.env): string {
  const found = findProgram([environment.FFMPEG ?? "ffmpeg"], environment);
  if (found !== null) return found;
  throw new Problem(
    "No ffmpeg was found, which writes MP4, WebM and GIF; install ffmpeg, or ask for --out FILM.webp, or for numbered pictures with --out FOLDER.",
  );
}

/**
 * Writes the film to `out`, complete or not at all.
 *
 * @throws Problem with ffmpeg's message if it fails
 */
export async function encodeFilm(
  ffmpeg: string,
  frames: Frames,
  fps: number,
  format: EncodedFormat,
  out: string,
  signal: AbortSignal,
): Promise<void> {
  const part = join(dirname(out), `.${Date.now()}${process.pid}${extname(out)}`);
  const input = ["-hide_banner", "-loglevel", "error", "-y", "-framerate", String(fps)];
  // No random numbers or versions in the file: the same film is the same to the last bit.
  const output = [...codecs[format], "-fflags", "+bitexact", part];
  const args = [...input, "-i", frames.pattern, ...output];
  const child = spawn(ffmpeg, args, { stdio: ["ignore", "ignore", "pipe"], signal });
  let complaint = "";
  child.stderr.on("data", (data: Buffer) => {
    complaint = (complaint + data.toString()).slice(-4000);
  });
  const status = await new Promise<number | null>((resolve) => {
    child.once("error", () => resolve(null));
    child.once("close", resolve);
  });
  if (status !== 0) await rm(part, { force: true });
  signal.throwIfAborted();
  if (status !== 0) {
    const line = complaint.trim().split("\n").at(-1) ?? "";
    throw new Problem(`ffmpeg could not write the film: ${printable(line) || "it did not start"}.`);
  }
  await rename(part, out).catch((error: unknown) => {
    throw fileProblem(out, error);
  });
}
