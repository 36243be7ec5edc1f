/** The progress of a long command, on the terminal. */

const width = 24;
/** Minimum interval between two drawings of the bar, milliseconds. */
const least = 100;

/** One line that is rewritten on a terminal; elsewhere a line for every tenth. */
export class Progress {
  readonly #out: NodeJS.WriteStream;
  readonly #started = Date.now();
  #drawn = 0;
  #tenths = 0;
  #isShown = false;

  constructor(out: NodeJS.WriteStream = process.stderr) {
    this.#out = out;
  }

  /**
   * Shows the progress.
   *
   * @param fraction 0 to 1
   * @param text what is being done
   * @param before the fraction done by an earlier run, which took this one no
   * time
   */
  show(fraction: number, text: string, before = 0): void {
    const part = Math.min(Math.max(fraction, 0), 1);
    if (this.#out.isTTY) this.#draw(part, text, before);
    else if (Math.floor(part * 10) > this.#tenths) {
      this.#tenths = Math.floor(part * 10);
      this.#out.write(`${this.#tenths * 10} %  ${text}\n`);
    }
  }

  /** Removes the bar. */
  clear(): void {
    if (this.#isShown) this.#out.write("\r\x1b[K");
    this.#isShown = false;
  }

  #draw(part: number, text: string, before: number): void {
    const now = Date.now();
    if (now - this.#drawn < least) return;
    this.#drawn = now;
    const full = Math.round(part * width);
    const bar = "█".repeat(full) + "░".repeat(width - full);
    const seconds = ((now - this.#started) / 1000) * ((1 - part) / Math.max(part - before, 1e-6));
    const left = part - before > 0.02 ? `, ${span(seconds)} left` : "";
    const line = `${bar} ${String(Math.floor(part * 100)).padStart(3)} %  ${text}${left}`;
    this.#out.write(`\r${line.slice(0, (this.#out.columns || 80) - 1)}\x1b[K`);
    this.#isShown = true;
  }
}

function span(seconds: number): string {
  return seconds < 90 ? `${Math.ceil(seconds)} s` : `${Math.ceil(seconds / 60)} min`;
}
