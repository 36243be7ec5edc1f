/** The flat page, on which creases are drawn, and a row for each with its angle and its moment. */

import type { CreaseState } from "turnleaf/models";
import {
  type DrawnCrease,
  endsOf,
  mostAngle,
  mostCreases,
  readCreases,
  writeCreases,
} from "./creases.ts";
import { make } from "./make.ts";
import type { Settings } from "./settings.ts";
import { fill, type Texts } from "./texts.ts";
import { isCreasable, leafSize } from "./variants.ts";

/** Millimetres of the flat page. */
const [width, height] = [1000 * leafSize.width, 1000 * leafSize.height];

/** A shorter stroke is a slip of the pointer, millimetres. */
const shortest = 12;

/** The angle to which a new crease folds, degrees: as a fold that is pressed by hand rests. */
const firstAngle = 150;

/** What the page shows of one crease. */
interface Row {
  readonly element: HTMLElement;
  readonly input: HTMLInputElement;
  readonly value: HTMLElement;
  readonly live: HTMLElement;
}

type Place = readonly [u: number, v: number];

/** Creates an element of SVG with attributes. */
function draw(tag: string, attributes: Readonly<Record<string, string | number>>): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, `${value}`);
  return element;
}

/** The editor of the sheet's creases. */
export class CreaseEditor {
  readonly element: HTMLElement;
  readonly #texts: Texts;
  readonly #change: (creases: string) => void;
  readonly #page: SVGElement;
  readonly #lines: SVGElement;
  readonly #stroke = draw("line", { class: "stroke", visibility: "hidden" });
  readonly #rows = make("div", { className: "creases" });
  readonly #note: HTMLElement;
  #shown: Row[] = [];
  #creases: readonly DrawnCrease[] = [];
  /** Where the stroke that is being drawn begins. */
  #start: Place | null = null;
  /** The pointer that draws it. */
  #pointer = 0;

  /** @param change called with the changed setting */
  constructor(texts: Texts, change: (creases: string) => void) {
    this.#texts = texts;
    this.#change = change;
    this.#lines = draw("g", {});
    this.#page = draw("svg", {
      class: "flat-page",
      viewBox: `-4 -4 ${width + 8} ${height + 8}`,
      role: "img",
      "aria-label": texts.creases.page,
    });
    this.#page.append(
      draw("rect", { class: "paper", width, height }),
      draw("line", { class: "spine", x1: 0, y1: 0, x2: 0, y2: height }),
      this.#lines,
      this.#stroke,
    );
    this.#listen();
    this.#note = make("p", { className: "note" });
    const presets = (["ear", "half"] as const).map((name) => {
      const button = make("button", { type: "button" }, texts.creases[name]);
      button.addEventListener("click", () =>
        this.#add(name === "ear" ? [62, 0, 100, 27] : [50, 0, 50, 100]),
      );
      return button;
    });
    this.element = make(
      "div",
      { className: "crease-editor" },
      this.#page,
      make("div", { className: "buttons" }, ...presets),
      this.#rows,
      this.#note,
    );
  }

  /** Shows settings. */
  show(settings: Settings): void {
    const creases = readCreases(settings.creases) ?? [];
    const canBe = [settings.left, settings.right].some(isCreasable);
    this.#note.textContent = canBe ? this.#texts.creases.note : this.#texts.creases.none;
    if (creases.length !== this.#shown.length) this.#makeRows(creases.length);
    this.#creases = creases;
    this.#lines.replaceChildren(...creases.flatMap(({ through }, k) => this.#drawLine(through, k)));
    for (const [k, { angle }] of creases.entries()) {
      const { input, value } = this.#shown[k];
      input.value = `${angle}`;
      value.textContent = `${angle}°`;
      input.setAttribute("aria-valuetext", `${angle}°`);
    }
  }

  /** Shows creases as they are now; none where no leaf is creased. */
  follow(states: readonly (CreaseState | null)[]): void {
    for (const [k, { live }] of this.#shown.entries()) {
      const state = states[k] ?? null;
      const text = state ? fill(this.#texts.creases.live, wordsOf(state)) : "";
      if (live.textContent !== text) live.textContent = text;
    }
  }

  #drawLine(through: DrawnCrease["through"], k: number): SVGElement[] {
    const [a, b, c, d] = endsOf(through);
    const [x1, y1, x2, y2] = [...pixel([a, b]), ...pixel([c, d])];
    const number = draw("text", { x: (x1 + x2) / 2 + 3, y: (y1 + y2) / 2 - 3 });
    number.textContent = `${k + 1}`;
    return [draw("line", { class: "crease", x1, y1, x2, y2 }), number];
  }

  #makeRows(count: number): void {
    this.#shown = Array.from({ length: count }, (_, k) => this.#makeRow(k));
    this.#rows.replaceChildren(...this.#shown.map(({ element }) => element));
  }

  #makeRow(k: number): Row {
    const id = `crease-${k}`;
    const input = make("input", {
      type: "range",
      id,
      min: `${-mostAngle}`,
      max: `${mostAngle}`,
      step: "5",
    });
    input.addEventListener("input", () => {
      const angle = input.valueAsNumber;
      this.#set(this.#creases.map((one, at) => (at === k ? { ...one, angle } : one)));
    });
    const number = { n: String(k + 1) };
    const remove = make("button", { type: "button" }, "×");
    remove.ariaLabel = fill(this.#texts.creases.remove, number);
    remove.addEventListener("click", () => this.#set(this.#creases.filter((_, at) => at !== k)));
    // Hidden from screen readers: the slider says it too.
    const value = make("span", { className: "value", ariaHidden: "true" });
    const live = make("p", { className: "live" });
    const label = make("label", { htmlFor: id }, fill(this.#texts.creases.rest, number));
    const row = make("div", { className: "row" }, label, input, make("span", {}, value, remove));
    return { element: make("div", {}, row, live), input, value, live };
  }

  #set(creases: readonly DrawnCrease[]): void {
    this.#change(writeCreases(creases));
  }

  #add(through: DrawnCrease["through"]): void {
    if (this.#creases.length >= mostCreases) return;
    this.#set([...this.#creases, { through, angle: firstAngle }]);
  }

  #listen(): void {
    const page = this.#page;
    page.addEventListener("pointerdown", (event) => {
      if (!event.isPrimary || event.button !== 0) return;
      this.#start = this.#placeAt(event);
      this.#pointer = event.pointerId;
      page.setPointerCapture(event.pointerId);
    });
    const isAnother = ({ pointerId }: PointerEvent): boolean => pointerId !== this.#pointer;
    page.addEventListener("pointermove", (event) => {
      if (isAnother(event)) return;
      if (this.#start) this.#drawStroke(this.#start, this.#placeAt(event));
    });
    page.addEventListener("pointercancel", (event) => {
      if (!isAnother(event)) this.#endStroke();
    });
    page.addEventListener("pointerup", (event) => {
      if (isAnother(event)) return;
      const [start, end] = [this.#start, this.#placeAt(event)];
      this.#endStroke();
      if (!start) return;
      const [[a, b], [c, d]] = [start, end].map(pixel);
      if (Math.hypot(c - a, d - b) >= shortest) this.#add([...start, ...end]);
    });
  }

  #drawStroke(start: Place, end: Place): void {
    const [[x1, y1], [x2, y2]] = [start, end].map(pixel);
    for (const [name, value] of Object.entries({ x1, y1, x2, y2, visibility: "visible" })) {
      this.#stroke.setAttribute(name, `${value}`);
    }
  }

  #endStroke(): void {
    this.#start = null;
    this.#stroke.setAttribute("visibility", "hidden");
  }

  /** Returns the place of a pointer on the page, or the nearest on its edge. */
  #placeAt(event: PointerEvent): Place {
    const box = this.#page.querySelector(".paper")?.getBoundingClientRect() ?? new DOMRect();
    const part = (value: number) => Math.round(100 * Math.min(Math.max(value, 0), 1));
    const across = part((event.clientX - box.left) / box.width);
    return [across, 100 - part((event.clientY - box.top) / box.height)];
  }
}

/** Returns where a place is on the drawn page, millimetres from its head at the spine. */
function pixel([u, v]: Place): [x: number, y: number] {
  return [(u / 100) * width, (1 - v / 100) * height];
}

/** Returns a crease in words: degrees, and millinewtons of moment per length. */
function wordsOf({ angle, rest, moment }: CreaseState): Record<string, string> {
  const degrees = (radians: number) => `${Math.round((180 / Math.PI) * radians) || 0}°`;
  const millinewtons = Number((1e3 * moment).toFixed(2)) || 0;
  return { angle: degrees(angle), rest: degrees(rest), moment: `${millinewtons} mN` };
}
