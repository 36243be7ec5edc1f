/** How far something long has come, for whoever waits at a terminal. */

const width = 24;
/** The bar is drawn anew no more often than this, milliseconds. */
const least = 100;

/** One line that is written anew on a terminal; elsewhere a line for every tenth. */
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
   * Shows how far it has come.
   * @param share 0 to 1
   * @param text what is being done
   * @param before the share that an earlier run had done: it took this one no time
   */
  show(share: number, text: string, before = 0): void {
    const part = Math.min(Math.max(share, 0), 1);
    if (this.#out.isTTY) this.#draw(part, text, before);
    else if (Math.floor(part * 10) > this.#tenths) {
      this.#tenths = Math.floor(part * 10);
      this.#out.write(`${this.#tenths * 10} %  ${text}\n`);
    }
  }

  /** Takes the bar away. */
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
