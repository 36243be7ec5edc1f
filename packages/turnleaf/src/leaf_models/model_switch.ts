/**
 * Selects the model that turns the leaves, if not as sheets: its code is loaded
 * when it is chosen.
 */

import { loadPart } from "../sources/load_part.ts";
import type { BookPose } from "../stage/book_pose.ts";
import type { LeafModel, ModelledBook } from "./leaf_model.ts";
import type { ModelChoice } from "./model_choice.ts";

/** Loads the models that a backend can show. */
export type LoadModels = () => Promise<typeof import("./leaf_models.ts")>;

/** The model of the leaves in flight, and the one that waits for them to land. */
export class ModelSwitch {
  readonly #load: LoadModels | undefined;
  readonly #failed: (error: unknown) => void;
  #model: LeafModel | null = null;
  /** The model that replaces it once the book is at rest; undefined if there is none. */
  #next: LeafModel | null | undefined;
  /** Aborted by the next choice, which voids the result of this one. */
  #choosing = new AbortController();
  #isLoading = false;

  /** @param load undefined if the backend turns leaves in one way only */
  constructor(load: LoadModels | undefined, failed: (error: unknown) => void) {
    this.#load = load;
    this.#failed = failed;
  }

  /** Whether no chosen model is still being loaded. */
  get ready(): boolean {
    return !this.#isLoading && this.#next === undefined;
  }

  /**
   * Chooses another model, used from the next rest of the book on. Resolves
   * once `rest` can switch to it. Never rejects.
   */
  async choose(choice: ModelChoice): Promise<void> {
    this.#choosing.abort();
    this.#choosing = new AbortController();
    const { signal } = this.#choosing;
    this.#isLoading = true;
    let model: LeafModel | null = null;
    try {
      const load = choice.model !== "sheet" && this.#load;
      const open = load && (await loadPart(load())).openModel;
      if (open && !signal.aborted) model = await open(choice, signal);
    } catch (error) {
      if (!signal.aborted) this.#failed(error);
    }
    if (signal.aborted) return model?.close();
    this.#isLoading = false;
    this.#next?.close();
    this.#next = model;
  }

  /** Switches to the next model. Call it when the book is at rest. */
  rest(): void {
    if (this.#next === undefined) return;
    this.#model?.close();
    this.#model = this.#next;
    this.#next = undefined;
  }

  /** Returns what is to be drawn of a book whose parts are as `pose` says. */
  pose(pose: BookPose): BookPose {
    return this.#model?.pose?.(pose) ?? pose;
  }

  /** Whether it draws nothing else while the engine sleeps. */
  get isAsleep(): boolean {
    return this.#model?.isAsleep ?? true;
  }

  /** Draws the leaves in flight `seconds` later than before. */
  update(book: ModelledBook, seconds: number): void {
    this.#model?.show(book, seconds);
    book.engine.update();
    this.#model?.finish?.(book);
  }

  /** Removes the current model and the next one. */
  close(): void {
    this.#choosing.abort();
    this.#next?.close();
    this.#next = null;
    this.rest();
  }
}
