/**
 * Leaves turned by another of the engine's models, live: each is a loose leaf
 * that follows the grabs of its sheet.
 */

import type { Vec3 } from "../engine/shapes.ts";
import type { Model } from "../model_names.ts";
import { type LeafNodes, type LeafOptions, LooseLeaf } from "../models/models.ts";
import type { BookPose } from "../stage/book_pose.ts";
import { cleanFold } from "./clean_fold.ts";
import {
  FlightModels,
  type LeafModel,
  type ModelledBook,
  type PickedUpLeaf,
} from "./leaf_model.ts";
import { lying, placeOn } from "./lying_sheet.ts";

/** Speed at which a leaf counts as at rest, m/s: a pixel, about 0.3 mm, a second, as in the engine. */
const slow = 3e-4;

/** A loose leaf, and the point of it that is pulled. */
interface PulledLeaf extends PickedUpLeaf {
  readonly leaf: LooseLeaf;
  /** Normals of the points about its fold, by number. */
  foldNormals: ReadonlyMap<number, Vec3>;
}

/**
 * Every leaf in flight moved by one model: the grabbed point is pulled to where
 * the sheet has it, from then on until the sheet lies. So all models follow the
 * same pointer at the same time, and land when the sheet does.
 */
export class LooseModel implements LeafModel {
  /** Others are made beside it, in the same memory. */
  readonly #first: LooseLeaf;
  readonly #spare: LooseLeaf[] = [];
  readonly #flights: FlightModels<PulledLeaf>;
  #options: LeafOptions;
  #columns: ArrayLike<number> = [];

  private constructor(first: LooseLeaf) {
    this.#first = first;
    this.#options = first.options;
    this.#flights = new FlightModels<PulledLeaf>(
      (taken) => {
        const leaf = this.#spare.pop() ?? this.#another(taken.count);
        leaf.lay(taken.from);
        leaf.grab(taken.u, taken.v);
        return { ...taken, leaf, foldNormals: new Map() };
      },
      ({ leaf }) => this.#spare.push(leaf),
    );
  }

  /** Rejects if there is no WebAssembly. */
  static async open(model: Model): Promise<LooseModel> {
    const options = { model, preset: "book", interpolate: true } as const;
    return new LooseModel(await LooseLeaf.create(options));
  }

  show(book: ModelledBook, seconds: number): void {
    const { width, height } = book.shape;
    const { columns } = book.engine;
    if (width !== this.#options.width || height !== this.#options.height) {
      this.#forget();
      this.#options = { ...this.#options, width, height };
    }
    this.#columns = columns;
    this.#flights.show(book, (pulled, points) => {
      const { leaf, from, u, v, count } = pulled;
      const rows = count / columns.length;
      leaf.hold(...placeOn(points, columns.length, rows, u, v));
      leaf.advance(seconds);
      leaf.update();
      const { positions } = leaf.surface();
      // Springs lag behind the point that pulls them, and are not where it lies.
      const part =
        this.#options.model === "mass-spring" ? 1 - lying(points, columns.length, rows, width) : 1;
      for (let i = 0; i < points.length; i++) points[i] += part * (positions[i] - points[i]);
      if (this.#folds) {
        pulled.foldNormals = cleanFold(points, columns, from === "right" ? width : -width, height);
      }
    });
  }

  get isAsleep(): boolean {
    return this.#flights.every(({ leaf }) => speedOf(leaf.nodes()) < slow);
  }

  pose(pose: BookPose): BookPose {
    return { ...pose, folded: this.#folds };
  }

  finish({ engine, turning }: ModelledBook): void {
    for (const flight of turning.flights) {
      const pulled = this.#flights.of(flight);
      if (!pulled?.foldNormals.size) continue;
      // Differences across a fold give no normal.
      const { normals } = engine.surface(turning.leaves.indexOf(flight));
      for (const [at, normal] of pulled.foldNormals) normals.set(normal, 3 * at);
    }
  }

  close(): void {
    this.#forget();
    this.#first.destroy();
  }

  get #folds(): boolean {
    return this.#options.model === "peel";
  }

  /** Returns a leaf drawn where a book's is, at so many points. */
  #another(count: number): LooseLeaf {
    const leaf = this.#first.another(this.#options);
    const rows = count / this.#columns.length;
    leaf.drawAt(
      this.#columns,
      Array.from({ length: rows }, (_, row) => row / (rows - 1)),
    );
    return leaf;
  }

  #forget(): void {
    this.#flights.clear();
    for (const leaf of this.#spare.splice(0)) leaf.destroy();
  }
}

/** Returns the speed of a leaf's nodes, m/s: the root of the mean square. */
function speedOf({ columns, rows, velocities }: LeafNodes): number {
  return Math.sqrt(velocities.reduce((sum, v) => sum + v * v, 0) / (columns * rows));
}
