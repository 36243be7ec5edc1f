/** Recordings of both leaves: a film of the pictures, and key frames of each. */

import { TurnRecorder } from "turnleaf/keyframes";
import type { BenchLeaf } from "./leaves.ts";

/** The formats, the best first. */
const types = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

/**
 * Minimum time between two frames of a recording, in seconds of the leaves'
 * time: half a frame of a film less.
 */
const leastBetween = 1 / 61;

/** A recording ends by itself after this time, seconds of the leaves' time. */
const longest = 10;

/** A file to be saved. */
export interface MadeFile {
  readonly name: string;
  readonly blob: Blob;
  /** Maximum distance of a replay of key frames from the recording, over the width. */
  readonly error?: number;
}

/** Both pictures as one, beside each other on the desk. */
export class BothPictures {
  readonly canvas: HTMLCanvasElement = document.createElement("canvas");
  readonly #pictures: readonly HTMLCanvasElement[];

  constructor(pictures: readonly HTMLCanvasElement[]) {
    this.#pictures = pictures;
    const sum = pictures.reduce((all, { width }) => all + width, 0);
    const highest = Math.max(...pictures.map(({ height }) => height));
    // Encoders take only even sizes.
    this.canvas.width = 2 * Math.max(1, Math.floor(sum / 2));
    this.canvas.height = 2 * Math.max(1, Math.floor(highest / 2));
    this.paint();
  }

  /** Copies the pictures' canvases, in the task in which they were drawn. */
  paint(): void {
    const pen = this.canvas.getContext("2d");
    if (!pen) return;
    const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
    pen.fillStyle = isDark ? "#403a33" : "#c8c0b3";
    pen.fillRect(0, 0, this.canvas.width, this.canvas.height);
    let x = 0;
    for (const picture of this.#pictures) {
      pen.drawImage(picture, x, 0);
      x += picture.width;
    }
  }
}

/** One recording, from its creation on. */
export class Recording {
  readonly #both: BothPictures;
  readonly #leaves: readonly BenchLeaf[];
  /** What the files of the leaves are named after. */
  readonly #names: readonly string[];
  readonly #turns: readonly TurnRecorder[];
  readonly #film: MediaRecorder | null;
  readonly #parts: Blob[] = [];
  #first: number | null = null;
  #last = Number.NEGATIVE_INFINITY;

  constructor(
    both: BothPictures,
    leaves: readonly BenchLeaf[],
    names: readonly string[],
    size: { width: number; height: number },
  ) {
    this.#both = both;
    this.#names = names;
    this.#leaves = leaves;
    this.#turns = leaves.map(({ leaf }) => {
      const { columns, rows, creased } = leaf.surface();
      const even = (count: number) => Array.from({ length: count }, (_, k) => k / (count - 1));
      const { model } = leaf.options;
      return new TurnRecorder({ ...size, u: even(columns), v: even(rows), model, creased });
    });
    this.#film = openFilm(both.canvas);
    this.#film?.addEventListener("dataavailable", ({ data }) => this.#parts.push(data));
    this.#film?.start();
  }

  /** Whether it has reached its maximum length. */
  get isFull(): boolean {
    return this.#first !== null && this.#last - this.#first >= longest;
  }

  /** Takes a frame, in the task in which the pictures were drawn. @param time of the leaves, seconds */
  frame(time: number): void {
    this.#both.paint();
    const track = this.#film?.stream.getVideoTracks()[0];
    (track as CanvasCaptureMediaStreamTrack | undefined)?.requestFrame();
    if (this.isFull || time - this.#last < leastBetween) return;
    this.#first ??= time;
    this.#last = time;
    for (const [k, turn] of this.#turns.entries()) {
      turn.add(time - this.#first, this.#leaves[k].leaf.surface().positions);
    }
  }

  /** Ends it. Returns the recorded files, without those that have no frame. */
  async finish(): Promise<MadeFile[]> {
    const files: MadeFile[] = [];
    const film = await this.#endFilm();
    if (film)
      files.push({ name: film.type === "video/mp4" ? "turn.mp4" : "turn.webm", blob: film });
    if (this.#first === null) return files;
    for (const [k, turn] of this.#turns.entries()) {
      const { bytes, error } = turn.finish();
      files.push({ name: `${k + 1}-${this.#names[k]}.tlkf`, blob: new Blob([bytes]), error });
    }
    return files;
  }

  async #endFilm(): Promise<Blob | null> {
    const film = this.#film;
    if (!film) return null;
    const ended = new Promise((resolve) => film.addEventListener("stop", resolve, { once: true }));
    film.stop();
    await ended;
    for (const track of film.stream.getTracks()) track.stop();
    const blob = new Blob(this.#parts, { type: film.mimeType.split(";")[0] });
    return blob.size > 0 ? blob : null;
  }
}

/** Returns a recorder of a canvas; null if the browser has none. */
function openFilm(canvas: HTMLCanvasElement): MediaRecorder | null {
  const mimeType =
    globalThis.MediaRecorder && types.find((type) => MediaRecorder.isTypeSupported(type));
  if (!mimeType || !canvas.captureStream) return null;
  return new MediaRecorder(canvas.captureStream(0), { mimeType, videoBitsPerSecond: 8e6 });
}
