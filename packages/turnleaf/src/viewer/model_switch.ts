/** How the leaves of a viewer are turned where not as sheets: what does it is loaded when it is chosen. */

import type { LeafModel, ModelledBook } from "../leaf_models/leaf_model.ts";
import type { ModelChoice } from "../leaf_models/model_choice.ts";
import { loaded } from "../sources/loaded.ts";
import type { BookPose } from "../stage/book_pose.ts";

/** What loads the models that a backend can show. */
export type LoadModels = () => Promise<typeof import("../leaf_models/leaf_models.ts")>;

/** The model of the leaves in flight, and the one that waits for them to land. */
export class ModelSwitch {
  readonly #load: LoadModels | undefined;
  readonly #failed: (error: unknown) => void;
  #model: LeafModel | null = null;
  /** What is to take its place once the book lies still; undefined where nothing is. */
  #next: LeafModel | null | undefined;
  /** Aborted by the next choice: what comes of the one before is void. */
  #choosing = new AbortController();
  #isLoading = false;

  /** @param load undefined where leaves are turned in one way alone */
  constructor(load: LoadModels | undefined, failed: (error: unknown) => void) {
    this.#load = load;
    this.#failed = failed;
  }

  /** Whether nothing that was chosen is yet to come. */
  get ready(): boolean {
    return !this.#isLoading && this.#next === undefined;
  }

  /** Turns leaves in another way, from when the book next lies still. Resolves once `rest` can see to it. Never rejects. */
  async choose(choice: ModelChoice): Promise<void> {
    this.#choosing.abort();
    this.#choosing = new AbortController();
    const { signal } = this.#choosing;
    this.#isLoading = true;
    let model: LeafModel | null = null;
    try {
      const load = choice.model !== "sheet" && this.#load;
      const open = load && (await loaded(load())).openModel;
      if (open && !signal.aborted) model = await open(choice, signal);
    } catch (error) {
      if (!signal.aborted) this.#failed(error);
    }
    if (signal.aborted) return model?.close();
    this.#isLoading = false;
    this.#next?.close();
    this.#next = model;
  }

  /** The book lies still. */
  rest(): void {
    if (this.#next === undefined) return;
    this.#model?.close();
    this.#model = this.#next;
    this.#next = undefined;
  }

  /** What is to be drawn of a book, where its parts are as told. */
  pose(pose: BookPose): BookPose {
    return this.#model?.pose?.(pose) ?? pose;
  }

  /** The sheets that it follows, which may still move when what is drawn does not. */
  get sheets(): LeafModel["sheets"] {
    return this.#model?.sheets ?? [];
  }

  /** Draws the leaves in flight as they are some seconds later than before. */
  update(book: ModelledBook, seconds: number): void {
    this.#model?.show(book, seconds);
    book.engine.update();
    this.#model?.finish?.(book);
  }

  /** Takes away what is and what comes. */
  close(): void {
    this.#choosing.abort();
    this.#next?.close();
    this.#next = null;
    this.rest();
  }
}
