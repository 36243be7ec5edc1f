/** Values that are read once and kept, up to a size of them all. */
export class KeptValues<T> {
  readonly #most: number;
  readonly #sizeOf: (value: T) => number;
  #kept = new Map<string, Promise<T>>();
  #size = 0;

  /** @param most size, in the unit of `sizeOf`, above which all are read anew */
  constructor(most: number, sizeOf: (value: T) => number) {
    this.#most = most;
    this.#sizeOf = sizeOf;
  }

  /** Returns what `read`, which does not reject, returned for a key before, or now. */
  get(key: string, read: () => Promise<T>): Promise<T> {
    const kept = this.#kept.get(key);
    if (kept) return kept;
    const reading = read();
    this.#kept.set(key, reading);
    void reading.then((value) => {
      this.#size += this.#sizeOf(value);
      if (this.#size <= this.#most) return;
      this.#kept = new Map();
      this.#size = 0;
    });
    return reading;
  }
}
