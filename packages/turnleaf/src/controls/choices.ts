/** Ways to choose the value of an attribute: a few side by side, or steps of a scale. */

import type { ControlledBook } from "./book.ts";
import { make, roving } from "./make.ts";

/** A choice of a row, or a step of a scale: the attribute's value, "" for none, and its text. */
export type Choice = readonly [value: string, text: string];

/** A row of a form that shows the value of an attribute and sets it. */
export interface ChoiceRow {
  readonly element: HTMLElement;
  /** Shows the attribute's value. */
  refresh(): void;
}

/** Sets an attribute of the book, or removes it. */
function set(book: ControlledBook, name: string, value: string): void {
  if (value === "") book.removeAttribute(name);
  else book.setAttribute(name, value);
}

/**
 * Has buttons of a group work as radio buttons by key: the tab key leads to the one that is chosen, and
 * arrows choose another. Returns what shows which one is chosen.
 */
export function radios(
  group: HTMLElement,
  buttons: readonly HTMLButtonElement[],
): (chosen: number) => void {
  roving(group, () => [...buttons], true);
  for (const button of buttons) {
    // The one that has the focus is chosen.
    button.addEventListener("keyup", ({ key }) => key.startsWith("Arrow") && button.click());
  }
  return (chosen) => {
    for (const [k, button] of buttons.entries()) {
      button.ariaChecked = String(k === chosen);
      button.tabIndex = k === chosen ? 0 : -1;
    }
  };
}

/** Makes a row of buttons of which one is chosen, each with its text in `decorate`, if that is given. */
export function choiceOf(
  book: ControlledBook,
  name: string,
  label: string,
  choices: readonly Choice[],
  decorate?: (button: HTMLButtonElement, value: string) => void,
): ChoiceRow {
  const group = make("div", { role: "radiogroup", class: "segments", "aria-label": label });
  const buttons = choices.map(([value, text]) => {
    const button = make("button", { type: "button", role: "radio" }, make("span", {}, text));
    decorate?.(button, value);
    button.addEventListener("click", () => set(book, name, value));
    return button;
  });
  group.append(...buttons);
  const check = radios(group, buttons);
  const refresh = (): void => {
    const value = book.getAttribute(name) ?? "";
    check(
      Math.max(
        choices.findIndex(([known]) => known === value),
        0,
      ),
    );
  };
  const head = make("span", { class: "what", "aria-hidden": "true" }, label);
  return { element: make("div", { class: "choice" }, head, group), refresh };
}

/** How a scale is named. */
export interface ScaleTexts {
  readonly label: string;
  readonly less: string;
  readonly more: string;
}

/** A row with the value of a scale between buttons for less and more. */
export interface ScaleRow extends ChoiceRow {
  /** Goes one step down (-1) or up (1). */
  step(by: 1 | -1): void;
}

/**
 * Makes a row of a scale.
 *
 * @param steps from the least to the most
 * @param signs what the buttons show
 */
export function scaleOf(
  book: ControlledBook,
  name: string,
  { label, less, more }: ScaleTexts,
  steps: readonly Choice[],
  signs: readonly [less: string, more: string] = ["−", "+"],
): ScaleRow {
  const output = make("output", { class: "value", "aria-label": label });
  const usual = Math.max(
    steps.findIndex(([value]) => value === ""),
    0,
  );
  const at = (): number => {
    const value = book.getAttribute(name) ?? "";
    const exact = steps.findIndex(([known]) => known === value);
    if (exact >= 0 || value === "") return exact >= 0 ? exact : usual;
    // A value between two, of the web page's own: the last step that is not more.
    return Math.max(
      steps.findLastIndex(([known], k) => k !== usual && Number(known) <= Number(value)),
      0,
    );
  };
  const step = (by: 1 | -1): void => {
    const next = steps[at() + by];
    if (next) set(book, name, next[0]);
  };
  const button = (sign: string, title: string, by: 1 | -1): HTMLButtonElement => {
    const made = make("button", { type: "button", "aria-label": title, title }, sign);
    made.addEventListener("click", () => step(by));
    return made;
  };
  const [down, up] = [button(signs[0], less, -1), button(signs[1], more, 1)];
  const refresh = (): void => {
    const k = at();
    output.textContent = steps[k]?.[1] ?? "";
    down.ariaDisabled = String(k === 0);
    up.ariaDisabled = String(k === steps.length - 1);
  };
  const group = make("div", { role: "group", class: "stepper", "aria-label": label });
  group.append(down, output, up);
  const head = make("span", { class: "what", "aria-hidden": "true" }, label);
  return { element: make("div", { class: "choice" }, head, group), refresh, step };
}
