/** Plays clips of recordings, one after the other, without a break where one goes on as the next. */

import { nameAndMessage } from "../sources/failures.ts";
import { BookError, type NarratedClip } from "../sources/page_source.ts";

/** A clip with this little left is over, seconds: less than a timer can wait. */
const over = 0.004;
/** With less than this left a timer waits for the end, seconds: the player's own event comes four times a second. */
const nearEnd = 1;

/** The recordings of one reading. While nothing is heard, no timer runs. */
export class RecordingPlayer {
  readonly #name: string;
  readonly #sound = new Audio();
  /** The recording that is loaded. */
  #recording: Blob | null = null;
  #isHeard = false;
  #isClosed = false;

  /**
   * @param name the book's name in sentences
   * @param stopped called when something else than this has stopped the sound,
   * such as a key of the keyboard
   */
  constructor(name: string, stopped: () => void) {
    this.#name = name;
    this.#sound.addEventListener("pause", () => {
      // The event comes a task later: by then it may be heard again.
      if (this.#isHeard && this.#sound.paused && !this.#sound.ended) stopped();
    });
  }

  /**
   * Plays a clip. Resolves at its end, at the recording's, or when `signal`
   * aborts; the sound goes on until `pause` or the next clip. Rejects with a
   * `BookError` if it cannot be played.
   *
   * @param goesOn whether it goes on where the last one ended: the sound, which
   * may be a little further by now, is not taken back
   * @param heard called with the fraction that has been heard, now and then
   */
  async play(
    clip: NarratedClip & { readonly recording: Blob },
    goesOn: boolean,
    signal: AbortSignal,
    heard: (fraction: number) => void,
  ): Promise<void> {
    const sound = this.#sound;
    if (clip.recording !== this.#recording) this.#load(clip.recording);
    if (!goesOn) sound.currentTime = clip.begin;
    try {
      this.#isHeard = true;
      if (sound.paused) await sound.play();
    } catch (error) {
      if (signal.aborted || this.#isClosed) return;
      const isForbidden = error instanceof DOMException && error.name === "NotAllowedError";
      throw isForbidden
        ? new BookError(
            `${this.#name} is read aloud only when its reader asks for it by a press.`,
            { code: "silent", source: this.#name },
          )
        : this.#unplayable(error);
    }
    await this.#ended(clip, signal, heard);
  }

  /** Stops the sound where it is. */
  pause(): void {
    this.#isHeard = false;
    this.#sound.pause();
  }

  /** Stops the sound and frees the recording. */
  close(): void {
    this.#isClosed = true;
    this.pause();
    this.#load(null);
  }

  /** Resolves when a clip has been heard. */
  #ended(
    clip: NarratedClip,
    signal: AbortSignal,
    heard: (fraction: number) => void,
  ): Promise<void> {
    const sound = this.#sound;
    const done = new AbortController();
    let timer: ReturnType<typeof setTimeout> | undefined;
    const heardAll = new Promise<void>((resolve, reject) => {
      const look = (): void => {
        clearTimeout(timer);
        const left = (clip.end - sound.currentTime) / sound.playbackRate;
        if (left <= over || signal.aborted) {
          resolve();
          return;
        }
        const length = Math.min(clip.end, sound.duration || clip.end) - clip.begin;
        heard((sound.currentTime - clip.begin) / length);
        if (left < nearEnd) timer = setTimeout(look, 1000 * left);
      };
      const options = { signal: done.signal };
      sound.addEventListener("timeupdate", look, options);
      sound.addEventListener("ended", () => resolve(), options);
      sound.addEventListener("error", () => reject(this.#unplayable(sound.error)), options);
      signal.addEventListener("abort", () => resolve(), options);
      look();
    });
    return heardAll.finally(() => {
      clearTimeout(timer);
      done.abort();
    });
  }

  #load(recording: Blob | null): void {
    const before = this.#sound.src;
    this.#recording = recording;
    // What is heard of the one before ends without being stopped by anybody.
    this.#isHeard = false;
    if (recording) this.#sound.src = URL.createObjectURL(recording);
    else this.#sound.removeAttribute("src");
    this.#sound.load();
    if (before) URL.revokeObjectURL(before);
  }

  #unplayable(error: unknown): BookError {
    const why = error instanceof MediaError ? error.message : nameAndMessage(error);
    return new BookError(
      `A recording in ${this.#name} cannot be played (${why || "its format is unknown"}); update the browser, get the book again, or allow blob: in media-src of this page's Content-Security-Policy.`,
      { code: "silent", source: this.#name },
    );
  }
}
