/** Lines over time, of both leaves in one picture. */

/** The style of a line. */
type Dash = "whole" | "dashed" | "dotted";

const dashes: Record<Dash, readonly number[]> = {
  whole: [],
  dashed: [5, 3],
  dotted: [1.5, 2.5],
};

/** One line: of which leaf, and how it is drawn. */
export interface Line {
  readonly of: "first" | "second";
  readonly dash: Dash;
}

/** Visible seconds of the leaves' time. */
const span = 4;

/** Maximum of samples kept: two for each pixel of a wide plot. */
const most = 1200;

/** A plot on a canvas. */
export class Plot {
  readonly #canvas: HTMLCanvasElement;
  readonly #lines: readonly Line[];
  readonly #isLogarithmic: boolean;
  readonly #times: number[] = [];
  readonly #values: number[][];
  readonly #label: (value: number) => string;

  /** @param label formats a value for the top of the plot */
  constructor(
    canvas: HTMLCanvasElement,
    lines: readonly Line[],
    label: (value: number) => string,
    isLogarithmic = false,
  ) {
    this.#canvas = canvas;
    this.#lines = lines;
    this.#label = label;
    this.#isLogarithmic = isLogarithmic;
    this.#values = lines.map(() => []);
  }

  /** Adds the value of each line at a time, in the lines' order. */
  add(time: number, values: readonly number[]): void {
    this.#times.push(time);
    for (const [k, value] of values.entries()) this.#values[k].push(value);
    const old = this.#times.findIndex((at) => at >= time - span);
    const gone = Math.max(old, this.#times.length - most);
    if (gone <= 0) return;
    this.#times.splice(0, gone);
    for (const own of this.#values) own.splice(0, gone);
  }

  /** Removes all samples. */
  clear(): void {
    this.#times.length = 0;
    for (const own of this.#values) own.length = 0;
  }

  /** Draws the plot. */
  draw(): void {
    const canvas = this.#canvas;
    const pen = canvas.getContext("2d");
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!pen || width === 0 || height === 0) return;
    const ratio = Math.min(devicePixelRatio, 2);
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const style = getComputedStyle(canvas);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const [low, high] = this.#range();
    const scale = this.#isLogarithmic ? Math.log10 : (value: number) => value;
    const top = 14;
    const y = (value: number) =>
      height - 2 - ((scale(value) - scale(low)) / (scale(high) - scale(low))) * (height - top - 2);
    pen.strokeStyle = colour("--rule");
    pen.lineWidth = 1;
    for (const value of this.#isLogarithmic ? [low, high] : [0, high]) {
      pen.beginPath();
      pen.moveTo(0, y(value));
      pen.lineTo(width, y(value));
      pen.stroke();
    }
    pen.fillStyle = colour("--quiet");
    pen.font = "11px system-ui, sans-serif";
    pen.fillText(this.#label(high), 0, top - 4);
    const end = this.#times.at(-1) ?? 0;
    for (const [k, { of, dash }] of this.#lines.entries()) {
      pen.strokeStyle = colour(`--${of}`);
      pen.lineWidth = 1.5;
      pen.setLineDash([...dashes[dash]]);
      pen.beginPath();
      for (const [i, time] of this.#times.entries()) {
        const value = this.#values[k][i];
        if (Number.isFinite(value)) pen.lineTo(width * (1 - (end - time) / span), y(value));
      }
      pen.stroke();
    }
    pen.setLineDash([]);
  }

  /** Returns the values at the foot and at the top: a round number above the highest. */
  #range(): readonly [number, number] {
    const all = this.#values.flat().filter(Number.isFinite);
    const [least, most] = [Math.min(0, ...all), Math.max(0, ...all)];
    if (!this.#isLogarithmic) return [least, roundUp(Math.max(most, 1e-9))];
    const positive = all.filter((value) => value > 0);
    const low = 10 ** Math.floor(Math.log10(Math.min(1, ...positive)));
    return [low, 10 ** Math.ceil(Math.log10(Math.max(10 * low, ...positive)))];
  }
}

/** Returns 1, 2 or 5 times a power of ten, at least the value. */
function roundUp(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  // A value slightly above a round number counts as that number.
  const times = [1, 2, 5].find((times) => times * power >= 0.999999 * value) ?? 10;
  return times * power;
}
