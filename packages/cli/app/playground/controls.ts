/** Sliders, choices and switches for every setting. */

import { type CreaseState, leafStocks } from "turnleaf/models";
import { CreaseEditor } from "./crease_editor.ts";
import { make } from "./make.ts";
import { bounds, type Settings } from "./settings.ts";
import { fullStrain } from "./strain.ts";
import { fill, type Texts } from "./texts.ts";
import { ownNodes, rowsOf } from "./variants.ts";

/** The controls of all settings but the two models. */
export interface Controls {
  readonly form: HTMLFormElement;
  /** Shows settings. */
  show(settings: Settings): void;
  /** Shows creases as they are now. */
  follow(states: readonly (CreaseState | null)[]): void;
}

type NumberName = {
  [Name in keyof Settings]: Settings[Name] extends number ? Name : never;
}[keyof Settings];
type SwitchName = {
  [Name in keyof Settings]: Settings[Name] extends boolean ? Name : never;
}[keyof Settings];

/** The stocks as settings. */
const presets = Object.entries(leafStocks).map(([name, stock]) => ({
  name: name as keyof typeof leafStocks,
  settings: {
    grammage: round(1e3 * stock.grammage),
    caliper: round(1e6 * stock.caliper),
    stiffness: round(1e3 * stock.stiffnessAcross),
  },
}));

function round(value: number): number {
  return Number(value.toPrecision(6));
}

/**
 * Creates the controls.
 *
 * @param change called with the changed settings
 * @param keep the buttons of the last group
 */
export function makeControls(
  texts: Texts,
  change: (changed: Partial<Settings>) => void,
  keep: readonly Node[],
): Controls {
  const shown: ((settings: Settings) => void)[] = [];
  const slider = (name: NumberName, write: (value: number) => string): HTMLElement => {
    const row = makeSlider(name, texts, write, change);
    shown.push(row.show);
    return row.element;
  };
  const group = (name: keyof Texts["groups"], ...children: Node[]) =>
    make("fieldset", {}, make("legend", {}, texts.groups[name]), ...children);
  const [stock, pace] = [makeStock(texts, change), makePace(texts, change)];
  const switches = makeSwitches(texts, change);
  const creases = new CreaseEditor(texts, (creases) => change({ creases }));
  shown.push((settings) => creases.show(settings));
  shown.push(stock.show, pace.show, switches.show);
  const form = make(
    "form",
    {},
    group(
      "shown",
      switches.element,
      note(fill(texts.notes.springs, { full: `${100 * fullStrain} %` })),
    ),
    group("creases", creases.element),
    group(
      "paper",
      stock.element,
      slider("grammage", (value) => `${value} g/m²`),
      slider("caliper", (value) => `${value} µm`),
      slider("stiffness", (value) => `${value} mN m`),
    ),
    group(
      "world",
      slider("gravity", (value) => `${value} m/s²`),
      slider("air", (value) => `× ${value}`),
      slider("seconds", (value) => `${value} s`),
      pace.element,
    ),
    group(
      "model",
      slider("angle", (value) => `${value}°`),
      slider("nodes", (value) =>
        value === ownNodes ? texts.ownNumber : `${value} × ${rowsOf(value)}`,
      ),
      slider("steps", (value) =>
        value === 0 ? texts.ownNumber : fill(texts.aSecond, { n: String(value) }),
      ),
      note(texts.notes.shell),
    ),
    group("keep", ...keep),
  );
  form.addEventListener("submit", (event) => event.preventDefault());
  return {
    form,
    show: (settings) => {
      for (const show of shown) show(settings);
    },
    follow: (states) => creases.follow(states),
  };
}

type Change = (changed: Partial<Settings>) => void;
type Part = { element: HTMLElement; show: (settings: Settings) => void };

const note = (text: string) => make("p", { className: "note" }, text);

/** Creates a slider over the values of a setting; over a list of numbers it uses their indices. */
function makeSlider(
  name: NumberName,
  texts: Texts,
  write: (value: number) => string,
  change: Change,
): Part {
  const bound = bounds[name];
  const numbers = bound.kind === "numbers" ? bound.of : null;
  const [least, most, by] =
    bound.kind === "range" ? [bound.least, bound.most, bound.by] : [0, bound.of.length - 1, 1];
  const id = `set-${name}`;
  const input = make("input", {
    type: "range",
    id,
    min: `${least}`,
    max: `${most}`,
    step: `${by}`,
  });
  // Hidden from screen readers: the slider says it too.
  const words = make("span", { className: "value", ariaHidden: "true" });
  const show = (settings: Settings): void => {
    const value = settings[name];
    input.value = String(numbers ? numbers.indexOf(value) : value);
    words.textContent = write(value);
    input.setAttribute("aria-valuetext", write(value));
  };
  input.addEventListener("input", () => {
    const at = input.valueAsNumber;
    change({ [name]: numbers ? numbers[at] : round(at) });
  });
  const label = make("label", { htmlFor: id }, texts.names[name]);
  return { element: make("div", { className: "row" }, label, input, words), show };
}

function makeChoice(
  id: string,
  name: string,
  options: readonly (readonly [value: string, text: string])[],
  choose: (value: string) => void,
): { element: HTMLElement; select: HTMLSelectElement } {
  const select = make(
    "select",
    { id },
    ...options.map(([value, text]) => make("option", { value }, text)),
  );
  select.addEventListener("change", () => choose(select.value));
  const label = make("label", { htmlFor: id }, name);
  return { element: make("div", { className: "row" }, label, select), select };
}

function makeStock(texts: Texts, change: Change): Part {
  const { element, select } = makeChoice(
    "set-stock",
    texts.preset,
    [
      ["own", texts.stocks.own],
      ...presets.map(({ name, settings: { grammage } }): [string, string] => [
        name,
        fill(texts.stocks.preset, {
          name: texts.stockNames[name] ?? inTitle(name),
          grammage: String(grammage),
        }),
      ]),
    ],
    (chosen) => change(presets.find(({ name }) => name === chosen)?.settings ?? {}),
  );
  const show = (settings: Settings): void => {
    const same = presets.find(({ settings: { grammage, caliper, stiffness } }) => {
      const is = [settings.grammage, settings.caliper, settings.stiffness];
      return [grammage, caliper, stiffness].every((value, k) => value === is[k]);
    });
    select.value = same?.name ?? "own";
  };
  return { element, show };
}

/** Returns a word as it begins a line of a list. */
function inTitle(word: string): string {
  return `${word.charAt(0).toUpperCase()}${word.slice(1)}`;
}

function makePace(texts: Texts, change: Change): Part {
  const { element, select } = makeChoice(
    "set-pace",
    texts.names.pace,
    Object.entries(texts.paces).sort(([a], [b]) => Number(b) - Number(a)),
    (chosen) => change({ pace: Number(chosen) }),
  );
  return {
    element,
    show: ({ pace }) => {
      select.value = String(pace);
    },
  };
}

function makeSwitches(texts: Texts, change: Change): Part {
  const names: readonly SwitchName[] = ["masses", "springs", "lines", "strain"];
  const inputs = names.map((name) => {
    const input = make("input", { type: "checkbox" });
    input.addEventListener("change", () => change({ [name]: input.checked }));
    return { name, input, label: make("label", {}, input, texts.names[name]) };
  });
  return {
    element: make("div", { className: "switches" }, ...inputs.map(({ label }) => label)),
    show: (settings) => {
      for (const { name, input } of inputs) input.checked = settings[name];
    },
  };
}
