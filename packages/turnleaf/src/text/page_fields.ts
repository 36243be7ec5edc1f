/** The form fields of an open page as real ones, over the printed ones. */

import type { PageField } from "../sources/page_source.ts";
import { layOver, type Project, placeIn } from "./run_place.ts";

/** Values of a book's fields, by their names; they outlive the pages' elements. */
export type FieldValues = Map<string, string>;

/** An element, and how it is laid onto the page. */
export interface FieldPlace {
  readonly element: HTMLElement;
  readonly lay: (project: Project) => void;
  /** Shows a field's current value, which another view of it may have changed. */
  readonly refresh?: () => void;
}

type Control = HTMLInputElement | HTMLTextAreaElement | HTMLSelectElement;

/**
 * Maximum and minimum size of letters in a field, as a fraction of its height
 * and in CSS pixels.
 */
const letters = { fraction: 0.62, least: 6, most: 40 };

/**
 * Returns a page's fields as elements, with their values from `values`.
 *
 * @csspart form-field A field of a form on a page.
 * @param changed called with a field's name after its value has changed, and
 * with whether the reader is done with it for now
 */
export function makeFields(
  fields: readonly PageField[],
  values: FieldValues,
  changed: (name: string, isDone: boolean) => void,
): FieldPlace[] {
  return fields.map((field) => {
    const element = makeField(field);
    const refresh = (): void => fillIn(element, field, values.get(field.name) ?? field.value);
    const take = (isDone: boolean): void => {
      values.set(field.name, heldBy(element, field));
      changed(field.name, isDone);
    };
    refresh();
    element.addEventListener("input", () => take(false));
    element.addEventListener("change", () => take(true));
    // Typing is not a command to the book.
    element.addEventListener("keydown", (event) => event.stopPropagation());
    const lay = (project: Project): void => {
      layOver(element, placeIn(field, project));
      const height = field.multiline ? lineHeight : Number.parseFloat(element.style.height) || 0;
      const size = Math.min(Math.max(letters.fraction * height, letters.least), letters.most);
      element.style.fontSize = `${size}px`;
    };
    return { element, lay, refresh };
  });
}

/** Height of a line in a field of several lines, CSS pixels. */
const lineHeight = 20;

function makeField(field: PageField): Control {
  const { kind, multiline, maxLength, title } = field;
  const element = document.createElement(
    kind === "choice" ? "select" : kind === "text" && multiline ? "textarea" : "input",
  );
  element.className = "field";
  element.setAttribute("part", "form-field");
  element.setAttribute("aria-label", title);
  element.title = title;
  element.disabled = field.readonly;
  if (element instanceof HTMLSelectElement) {
    element.append(...field.options.map(({ label, value }) => new Option(label, value)));
  } else if (kind === "text") {
    if (maxLength > 0) element.maxLength = maxLength;
    element.autocomplete = "off";
  } else if (element instanceof HTMLInputElement) {
    element.type = kind === "check" ? "checkbox" : "radio";
    element.name = field.name;
  }
  return element;
}

function fillIn(element: Control, field: PageField, value: string): void {
  if (isSwitch(element)) element.checked = value !== "" && value === field.on;
  // A focused field keeps its caret.
  else if (element.value !== value) element.value = value;
}

function heldBy(element: Control, field: PageField): string {
  if (!isSwitch(element)) return element.value;
  return element.checked ? field.on : "";
}

function isSwitch(element: Control): element is HTMLInputElement {
  return element instanceof HTMLInputElement && element.type !== "text";
}
