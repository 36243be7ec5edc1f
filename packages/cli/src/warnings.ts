/** Sentences printed at most: more than a reader goes through, of input that may cause one for each line of it. */
const mostPrinted = 100;

/** What a command leaves out, said on the terminal. */
export class Warnings {
  #count = 0;

  /** Prints a sentence, unless there were too many. */
  readonly add = (sentence: string): void => {
    this.#count++;
    if (this.#count <= mostPrinted) console.error(sentence);
  };

  /** Says how many more there were, once everything is read. */
  end(): void {
    const more = this.#count - mostPrinted;
    if (more > 0) console.error(`${more} more sentences like these are not shown.`);
    this.#count = 0;
  }
}
