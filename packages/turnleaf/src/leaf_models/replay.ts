/** Leaves turned as in a recording: the viewer's own, or one that the page gives. */

import { decodeTurn } from "../key_frames/decode.ts";
import { TurnError } from "../key_frames/file.ts";
import type { RecordedTurn } from "../key_frames/recorded_turn.ts";
import { TurnCache } from "../key_frames/turn_cache.ts";
import { nameOfUrl } from "../sources/book_text.ts";
import { loadPart } from "../sources/load_part.ts";
import { BookError } from "../sources/page_source.ts";
import type { BookPose } from "../stage/book_pose.ts";
import {
  FlightModels,
  type LeafModel,
  type ModelledBook,
  type PickedUpLeaf,
} from "./leaf_model.ts";
import { fractionTurned, lying } from "./lying_sheet.ts";
import { Recording, type ReplayedLeaf } from "./recording.ts";

/** Turns that pages give: all books of a document use the same ones. */
const turns = new TurnCache();

/** A file in base64. */
type InlinedFile = { readonly default: string };

/** The recordings that come with the viewer, by model. */
const own = {
  sheet: (): Promise<InlinedFile> => import("./turns/sheet_turn.tlkf"),
  shell: (): Promise<InlinedFile> => import("./turns/shell_turn.tlkf"),
};

/**
 * Every leaf in flight is where a recording was when as much of its turn was
 * done as is of the sheet's. So it follows a pointer over and back, and the
 * clock of a timed turn; where the pointer pulls other than over it does not
 * follow.
 */
export class ReplayModel implements LeafModel {
  readonly #recording: Recording;
  readonly #flights = new FlightModels<PickedUpLeaf>((taken) => taken);
  #columns = new Float32Array();
  #rows: readonly number[] = [];
  #points = new Float32Array();

  private constructor(recording: Recording) {
    this.#recording = recording;
  }

  /** Opens the turn by the fore-edge that comes with the viewer. */
  static async ofOwn(model: keyof typeof own): Promise<ReplayModel> {
    const { default: base64 } = await loadPart(own[model]());
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    return new ReplayModel(new Recording(decodeTurn(bytes), model));
  }

  /** Opens the turn in the file at an address. Rejects with a `BookError` if there is none. */
  static async at(address: string): Promise<ReplayModel> {
    const isNamed = !/^(blob|data):/i.test(address);
    const name = isNamed ? `The turn file ${nameOfUrl(address)}` : "The turn file";
    const fetched = new Promise<RecordedTurn>((resolve) => resolve(turns.fetch(address)));
    const turn = await fetched.catch((error: unknown) => {
      const why = error instanceof TurnError ? error.message : "Its address is none.";
      throw new BookError(`${name} cannot be played. ${why}`, { code: "misused", source: name });
    });
    return new ReplayModel(new Recording(turn, name));
  }

  show(book: ModelledBook): void {
    const { width, height } = book.shape;
    const { columns } = book.engine;
    this.#flights.show(book, ({ from, v, count }, points) => {
      const rows = count / columns.length;
      this.#drawnAt(columns, rows);
      const isMirrored = from === "left";
      const turned = fractionTurned(points, columns.length, rows);
      const leaf: ReplayedLeaf = {
        u: this.#columns,
        v: this.#rows,
        width,
        height,
        isMirrored,
        isUpsideDown: v > 0.5,
      };
      this.#recording.write(leaf, isMirrored ? 1 - turned : turned, this.#points);
      // A recording need not end, nor begin, as flat as this leaf lies.
      const part = 1 - lying(points, columns.length, rows, width);
      for (let i = 0; i < points.length; i++) points[i] += part * (this.#points[i] - points[i]);
    });
  }

  pose(pose: BookPose): BookPose {
    return { ...pose, folded: this.#recording.model === "peel" };
  }

  close(): void {
    this.#flights.clear();
  }

  /**
   * Copies the columns at which leaves are drawn, because the engine's memory
   * moves; rows are evenly spaced.
   */
  #drawnAt(columns: Float32Array, rows: number): void {
    if (columns.length === this.#columns.length && rows === this.#rows.length) return;
    this.#columns = columns.slice();
    this.#rows = Array.from({ length: rows }, (_, row) => row / (rows - 1));
    this.#points = new Float32Array(3 * columns.length * rows);
  }
}
