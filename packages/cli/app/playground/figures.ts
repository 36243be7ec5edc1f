/** The plots of energy, strain and cost, and the same in words. */

import type { BenchLeaf } from "./leaves.ts";
import { make } from "./make.ts";
import { type Line, Plot } from "./plots.ts";
import { fill, type Texts } from "./texts.ts";

type Kind = keyof Texts["plots"];

const both = (...dashes: Line["dash"][]): Line[] =>
  (["first", "second"] as const).flatMap((of) => dashes.map((dash) => ({ of, dash })));

const lines: Readonly<Record<Kind, readonly Line[]>> = {
  energy: both("whole", "dashed", "dotted"),
  strain: both("whole", "dashed"),
  cost: both("whole"),
};

const kinds: readonly Kind[] = ["energy", "strain", "cost"];

/** Returns a number with its unit, with three digits. */
export function write(value: number, unit: "J" | "s" | "%"): string {
  if (!Number.isFinite(value)) return "–";
  if (unit === "%") return `${Number((100 * value).toPrecision(2))} %`;
  const size = Math.abs(value);
  // Less than a nanojoule, or a nanosecond, counts as zero.
  if (size < 1e-9) return `0 ${unit}`;
  const [scale, prefix] = size < 1e-3 ? [1e6, "µ"] : size < 1 ? [1e3, "m"] : [1, ""];
  return `${Number((scale * value).toPrecision(3))} ${prefix}${unit}`;
}

/** The plots under the pictures. */
export class Figures {
  readonly element: HTMLElement;
  readonly #texts: Texts;
  readonly #plots: Readonly<Record<Kind, Plot>>;
  readonly #words: Readonly<Record<Kind, readonly HTMLElement[]>>;

  constructor(texts: Texts) {
    this.#texts = texts;
    const labels = { energy: "J", strain: "%", cost: "s" } as const;
    const made = kinds.map((kind) => {
      const canvas = make("canvas");
      canvas.setAttribute("aria-hidden", "true");
      const scale = kind === "cost" ? 1e-6 : 1;
      const label = (value: number) => write(scale * value, labels[kind]);
      const plot = new Plot(canvas, lines[kind], label, kind === "cost");
      const words = [make("p", { className: "of-first" }), make("p", { className: "of-second" })];
      const title = make("figcaption", {}, texts.plots[kind]);
      const figure = make("figure", { className: "plot" }, title, canvas, ...words);
      return { kind, plot, words, figure };
    });
    const of = <T>(pick: (one: (typeof made)[number]) => T) =>
      Object.fromEntries(made.map((one) => [one.kind, pick(one)])) as Record<Kind, T>;
    this.#plots = of(({ plot }) => plot);
    this.#words = of(({ words }) => words);
    this.element = make("div", { className: "plots" }, ...made.map(({ figure }) => figure));
  }

  /** Adds a moment. */
  add(time: number, pair: readonly BenchLeaf[]): void {
    const figures = pair.map((one) => one.figures);
    const all = {
      energy: figures.flatMap(({ kinetic, bending, gravity }) => [kinetic, bending, gravity]),
      strain: figures.flatMap(({ stretch, compression }) => [stretch, -compression]),
      cost: pair.map(({ cost }) => cost),
    };
    for (const kind of kinds) this.#plots[kind].add(time, all[kind]);
  }

  /** Draws the plots, and writes the current figures of both leaves. */
  show(pair: readonly BenchLeaf[], names: readonly string[]): void {
    for (const kind of kinds) this.#plots[kind].draw();
    for (const [k, one] of pair.entries()) {
      const { kinetic, bending, gravity, stretch, compression } = one.figures;
      const step = one.leaf.timeStep;
      const fraction = (1e-6 * one.cost) / step;
      this.#say("energy", k, names[k], {
        kinetic: write(kinetic, "J"),
        bending: write(bending, "J"),
        gravity: write(gravity, "J"),
      });
      this.#say("strain", k, names[k], {
        stretch: write(stretch, "%"),
        compression: write(-compression, "%"),
      });
      this.#say("cost", k, names[k], {
        cost: write(1e-6 * one.cost, "s"),
        step: String(Number((1000 * step).toPrecision(3))),
        fraction: write(fraction, "%"),
      });
    }
  }

  /** Clears the plots. */
  clear(): void {
    for (const kind of kinds) this.#plots[kind].clear();
  }

  #say(kind: Kind, leaf: number, model: string, values: Record<string, string>): void {
    const [before, after] = this.#texts.figures[kind].split("{model}");
    const words = this.#words[kind][leaf];
    words.replaceChildren(before ?? "", make("b", {}, model), fill(after ?? "", values));
  }
}
