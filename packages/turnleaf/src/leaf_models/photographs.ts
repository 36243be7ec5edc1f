/** Photographs of a real turn in place of the leaf, as the British Library turned pages. */

import { pileHeight } from "../engine/shapes.ts";
import { ImageSource } from "../sources/images.ts";
import { BookError } from "../sources/page_source.ts";
import type { BookPose } from "../stage/book_pose.ts";
import { type OpenPages, PhotographsMesh } from "../webgl/photographs_mesh.ts";
import {
  FlightModels,
  type LeafModel,
  type ModelledBook,
  type PickedUpLeaf,
} from "./leaf_model.ts";
import { fractionTurned } from "./lying_sheet.ts";
import { photographRow } from "./photograph_row.ts";

/** Maximum of pixels of all photographs of a turn together, 128 MB as RGBA, and of their width. */
const mostPixels = 32e6;
const mostWidth = 2048;

/** Photographs fetched and decoded at the same time: each may be large before it is scaled down. */
const atOnce = 4;

/** Difference of ratios below which pictures are of one size, but for whole pixels. */
const sameRatio = 0.02;

/**
 * Leaves in flight are not drawn; over the open pages lies, for each, the
 * photograph of the moment at which as much of the turn was done as is of the
 * sheet's. A corner that only lifts is not a turn, and stays paper.
 */
export class PhotographsModel implements LeafModel {
  readonly #pictures: readonly ImageBitmap[];
  readonly #mesh: PhotographsMesh;
  readonly #flights = new FlightModels<PickedUpLeaf>((taken) => taken);
  /** The visible photographs, by number. */
  #seen: readonly number[] = [];
  #size: Pick<OpenPages, "width" | "height"> = { width: 1, height: 1 };

  private constructor(pictures: readonly ImageBitmap[], ratio: number | null) {
    this.#pictures = pictures;
    this.#mesh = new PhotographsMesh(pictures, ratio);
  }

  /**
   * Opens the photographs at an address with their numbers in braces, the first
   * with the leaf on the right and the last with it on the left. All are
   * fetched and decoded first. Rejects with a `BookError` if one cannot be, or
   * with the signal's reason.
   */
  static async open(address: string, signal: AbortSignal): Promise<PhotographsModel> {
    const { addresses, ratio } = photographRow(address, document.baseURI);
    return new PhotographsModel(await decoded(addresses, signal), ratio);
  }

  show(book: ModelledBook): void {
    const { columns } = book.engine;
    const last = this.#pictures.length - 1;
    const seen: number[] = [];
    this.#size = book.shape;
    this.#flights.show(book, ({ count }, points) => {
      const fraction = fractionTurned(points, columns.length, count / columns.length);
      seen.push(Math.round(fraction * last));
    });
    // On either side the steeper leaf lies over the others.
    seen.sort((a, b) => Math.abs(b - last / 2) - Math.abs(a - last / 2));
    this.#seen = book.peek.flight ? [] : seen;
  }

  pose(pose: BookPose): BookPose {
    const foreEdge = (pile: BookPose["left"]): number => (pile ? pileHeight(pile) : 0);
    const { width, height } = this.#size;
    const [left, right] = [foreEdge(pose.left), foreEdge(pose.right)];
    this.#mesh.show(this.#seen, { width, height, left, right });
    const leaves = this.#seen.length > 0 ? [] : pose.leaves;
    return { ...pose, leaves, above: this.#mesh.group };
  }

  close(): void {
    this.#flights.clear();
    this.#mesh.dispose();
    for (const picture of this.#pictures) picture.close();
  }
}

/** Fetches pictures and decodes them, all or none. */
async function decoded(addresses: readonly string[], signal: AbortSignal): Promise<ImageBitmap[]> {
  const source = new ImageSource({
    name: "the photographs of a turn",
    title: "",
    language: "",
    direction: "ltr",
    kind: "scan",
    pages: addresses.map((src) => ({ src })),
  });
  const pictures: ImageBitmap[] = [];
  try {
    const size = await source.size(0, signal);
    const ratio = size.height / size.width;
    const width = Math.min(mostWidth, Math.sqrt(mostPixels / (addresses.length * ratio)));
    let hasFailed = false;
    const indices = addresses.keys();
    const drawInTurn = async (): Promise<void> => {
      for (const index of indices) {
        if (hasFailed) return;
        try {
          const picture = (await source.draw(index, width, signal)) as ImageBitmap;
          pictures[index] = picture;
          if (Math.abs(picture.height / picture.width / ratio - 1) < sameRatio) continue;
          throw new BookError("The photographs of a turn must all be of one size.", {
            code: "misused",
          });
        } catch (error) {
          hasFailed = true;
          throw error;
        }
      }
    };
    // All have ended before their results are dropped.
    const drawn = await Promise.allSettled(Array.from({ length: atOnce }, drawInTurn));
    const failed = drawn.find(({ status }) => status === "rejected");
    if (failed) throw (failed as PromiseRejectedResult).reason;
    return pictures;
  } catch (error) {
    for (const picture of pictures) picture?.close();
    throw error;
  } finally {
    source.close();
  }
}
