/** A film of what the book shows, recorded as it is drawn. */

import { nameAndMessage } from "../sources/failures.ts";
import { BookError } from "../sources/page_source.ts";

/** How a film is recorded. */
export interface RecordOptions {
  /**
   * Seconds after its first picture at which it ends by itself, 0.1 to 600. The
   * default is to go on until `stopRecording()`.
   */
  readonly seconds?: number;
}

/** The formats, the best first. */
const types = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

const bitsPerSecond = 12e6;

/** Maximum of pixels along a side, which encoders support. */
const mostAlong = 1920;

/** Frames for which a film continues after it is stopped: the encoder is that far behind. */
const lastFrames = 3;

/** Maximum of frames for which it then waits for the encoder's first picture: ten seconds. */
const longestWait = 600;

/** Interval at which the encoder delivers its data, milliseconds. */
const handOver = 100;

/** One film, from the next frame of the book until it is stopped. */
export class FilmRecorder {
  /** Resolves to the film. Rejects with a `BookError` if the browser fails to make it. */
  readonly done: Promise<Blob>;
  readonly #source: () => HTMLCanvasElement | undefined;
  readonly #type: string;
  readonly #canvas = document.createElement("canvas");
  readonly #seconds: number | undefined;
  #timer: number | undefined;
  #ended!: { resolve: (film: Blob) => void; reject: (error: Error) => void };
  /** Null until the book is first drawn. */
  #recorder: MediaRecorder | null = null;
  /** The requested animation frame. */
  #next = 0;
  #isOver = false;
  /** Frames until it ends, once it is stopped. */
  #left = 0;

  /**
   * @param source returns the canvas on which the book is drawn now
   *
   * @throws BookError if the browser cannot record
   */
  constructor(source: () => HTMLCanvasElement | undefined, { seconds }: RecordOptions) {
    const type =
      globalThis.MediaRecorder && types.find((type) => MediaRecorder.isTypeSupported(type));
    const shown = source();
    if (!type || !shown?.captureStream) {
      throw new BookError("This browser cannot record a film; use a newer one.", {
        code: "misused",
      });
    }
    this.#source = source;
    this.#type = type;
    const { clientWidth, clientHeight } = shown;
    const scale = Math.min(devicePixelRatio, mostAlong / Math.max(clientWidth, clientHeight, 1));
    // Encoders take only even sizes.
    this.#canvas.width = 2 * Math.max(Math.round((clientWidth * scale) / 2), 1);
    this.#canvas.height = 2 * Math.max(Math.round((clientHeight * scale) / 2), 1);
    this.done = new Promise((resolve, reject) => {
      this.#ended = { resolve, reject };
    });
    this.#seconds = seconds;
  }

  /** Call it when the book is about to be drawn: the film takes what is then on its canvas. */
  frame(): void {
    // In the same task: later the canvas may be cleared already.
    queueMicrotask(() => {
      if (this.#isOver) return;
      try {
        this.#paint();
        this.#recorder ??= this.#begin();
      } catch (error) {
        this.#fail(`The film could not be recorded (${nameAndMessage(error)}).`);
      }
    });
  }

  /** Ends the film, once it contains the current picture. */
  stop(): void {
    clearTimeout(this.#timer);
    if (this.#recorder === null) {
      this.#fail("The film was ended before the book was drawn.");
    } else if (document.hidden) this.#recorder.stop();
    else this.#left ||= lastFrames;
  }

  #fail(sentence: string): void {
    this.#isOver = true;
    this.#ended.reject(new BookError(sentence, { code: "misused" }));
  }

  #begin(): MediaRecorder {
    // Firefox does not take single pictures, but each that is drawn.
    const takesPictures =
      "requestFrame" in (globalThis.CanvasCaptureMediaStreamTrack?.prototype ?? {});
    const stream = takesPictures ? this.#canvas.captureStream(0) : this.#canvas.captureStream();
    const track = stream.getVideoTracks()[0] as CanvasCaptureMediaStreamTrack;
    const options = { mimeType: this.#type, videoBitsPerSecond: bitsPerSecond };
    const recorder = new MediaRecorder(stream, options);
    const parts: Blob[] = [];
    let waited = 0;
    const end = (): void => {
      clearTimeout(this.#timer);
      cancelAnimationFrame(this.#next);
      track.stop();
    };
    recorder.ondataavailable = ({ data }) => void parts.push(data);
    recorder.onstop = () => {
      end();
      this.#isOver = true;
      this.#ended.resolve(new Blob(parts, { type: this.#type.split(";")[0] }));
    };
    recorder.onerror = () => {
      end();
      this.#fail("The film could not be recorded.");
    };
    recorder.start(handOver);
    if (this.#seconds !== undefined) {
      const length = Math.min(Math.max(this.#seconds, 0.1), 600) || 0.1;
      this.#timer = window.setTimeout(() => this.stop(), 1000 * length);
    }
    // A resting book is filmed too, frame by frame: a film lasts as long as it was recorded.
    const go = (): void => {
      this.#canvas.getContext("2d")?.drawImage(this.#canvas, 0, 0);
      if (takesPictures) track.requestFrame();
      this.#next = requestAnimationFrame(() => {
        // On a busy machine the encoder has no data yet when a short film should end.
        const isMade = parts.some(({ size }) => size > 0) || waited >= longestWait;
        if (this.#left > 0 && !isMade) waited++;
        if (this.#left > 0 && isMade && --this.#left === 0) recorder.stop();
        else go();
      });
    };
    go();
    return recorder;
  }

  #paint(): void {
    const { width, height } = this.#canvas;
    const pen = this.#canvas.getContext("2d");
    const shown = this.#source();
    if (!pen || !shown) return;
    paintGround(pen, shown, width, height);
    if (shown.width > 0 && shown.height > 0) pen.drawImage(shown, 0, 0, width, height);
  }
}

/** Paints the background of the book: the nearest one behind it, plain or the desk's. */
function paintGround(
  pen: CanvasRenderingContext2D,
  shown: HTMLCanvasElement,
  width: number,
  height: number,
): void {
  pen.fillStyle = "#fff";
  let at: Element | null = shown;
  while (at) {
    const { backgroundColor, backgroundImage } = getComputedStyle(at);
    const desk =
      /^radial-gradient\((?:ellipse )?at (\d+)% (\d+)%, (rgba?\([^()]*\)), (rgba?\([^()]*\)) (\d+)%\)$/.exec(
        backgroundImage,
      );
    if (desk) {
      const [, x = 50, y = 50, inner = "", outer = "", end = 100] = desk;
      const [left, top] = [(width * Number(x)) / 100, (height * Number(y)) / 100];
      // To the farthest corner, as in CSS.
      const reach = Math.SQRT2;
      const gradient = pen.createRadialGradient(0, 0, 0, 0, 0, reach);
      gradient.addColorStop(0, inner);
      gradient.addColorStop(Math.min(Number(end) / 100, 1), outer);
      const [across, down] = [Math.max(left, width - left), Math.max(top, height - top)];
      pen.save();
      pen.translate(left, top);
      pen.scale(across, down);
      pen.fillStyle = gradient;
      pen.fillRect(-2, -2, 4, 4);
      pen.restore();
      return;
    }
    if (!/^(?:transparent|rgba\(.*, 0\))$/.test(backgroundColor)) {
      pen.fillStyle = backgroundColor;
      break;
    }
    at = at.parentElement ?? (at.getRootNode() as ShadowRoot).host ?? null;
  }
  pen.fillRect(0, 0, width, height);
}
