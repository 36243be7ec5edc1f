/**
 * Controls of forms. Nothing on paper operates them, and what a browser draws in one is no text that is found
 * or goes on on the next page: those that show words become boxes that look like them and have the words as text.
 */

import { takeContent } from "../markup/take_content.ts";
import { type Styles, setStyles } from "./box_styles.ts";

/** Types of `<input>` that show words. */
const wordedTypes =
  /^(?:|text|search|tel|url|email|number|date|time|month|week|datetime-local|button|submit|reset)$/;

/** What a box keeps of the style of its control, as it was computed. */
const kept: readonly string[] = [
  "align-items align-self background-attachment background-clip background-color background-image background-origin",
  "background-position background-repeat background-size border-radius bottom box-shadow break-after break-before break-inside",
  "clear color direction flex float font-family font-size font-stretch font-style font-weight gap grid-area justify-content",
  "justify-self left letter-spacing line-height margin-bottom margin-left margin-right margin-top max-width opacity order",
  "padding-bottom padding-left padding-right padding-top position right text-align text-indent text-shadow text-transform",
  "top vertical-align visibility white-space word-spacing writing-mode",
  ...["top", "right", "bottom", "left"].map(
    (side) => `border-${side}-color border-${side}-style border-${side}-width`,
  ),
].flatMap((names) => names.split(" "));

/** Puts boxes with their words in place of the controls in a section's body, laid out, that show any. */
export function drawControls(body: Element): void {
  const view = body.ownerDocument.defaultView as Window;
  const boxes = new Map<HTMLElement, HTMLElement>();
  // All are measured before any is changed: after a change the browser lays out the whole section.
  for (const control of body.querySelectorAll<HTMLElement>("button, input, select, textarea")) {
    const style = view.getComputedStyle(control);
    const words = wordsOf(control);
    if (words.length === 0 || style.display === "none") continue;
    const box = body.ownerDocument.createElement("span");
    for (const name of ["id", "class", "title", "lang", "dir"]) {
      const value = control.getAttribute(name);
      if (value !== null) box.setAttribute(name, value);
    }
    setStyles(box, boxStyles(control, style));
    box.append(...words);
    boxes.set(control, box);
  }
  for (const [control, box] of boxes) {
    // The browser does not tell what a button's own content is before it is taken out.
    if (control.localName === "button") box.replaceChildren(takeContent(control));
    control.replaceWith(box);
  }
}

/** Returns what a control shows in words: texts, and boxes of their lines; nothing if it shows none. */
function wordsOf(control: HTMLElement): (string | HTMLElement)[] {
  if (control.localName === "button") return [control.textContent ?? ""];
  if (control.localName === "select") {
    const { options, selectedOptions, multiple, size } = control as HTMLSelectElement;
    // One that drops down shows what is chosen alone.
    if (!multiple && size <= 1) return [...selectedOptions].map(({ label }) => label);
    return [...options].map((option) => {
      const line = control.ownerDocument.createElement("span");
      setStyles(line, {
        display: "block",
        ...(option.selected && { "background-color": "#8884" }),
      });
      line.textContent = option.label;
      return line;
    });
  }
  const { type, value, placeholder } = control as HTMLInputElement;
  const shown = value || placeholder;
  const isWorded = control.localName === "textarea" || wordedTypes.test(type);
  return isWorded && shown ? [shown] : [];
}

/** Returns the styles by which a box looks like a control, and is higher where its words are. */
function boxStyles(control: HTMLElement, style: CSSStyleDeclaration): Styles {
  const { offsetWidth, offsetHeight } = control;
  const isText = /^(?:input|textarea)$/.test(control.localName);
  const isButton =
    control.localName === "button" ||
    /^(?:button|submit|reset)$/.test((control as HTMLInputElement).type);
  return {
    ...Object.fromEntries(kept.map((name) => [name, style.getPropertyValue(name)])),
    // Edges of which the book says nothing are drawn in another way than they are computed.
    ...(/^(?:inset|outset)$/.test(style.borderTopStyle) && {
      "border-style": "solid",
      "border-width": "1px",
    }),
    "box-sizing": "border-box",
    [isText && !isButton ? "width" : "min-width"]: `${offsetWidth}px`,
    "min-height": `${offsetHeight}px`,
    "overflow-wrap": "break-word",
    display: style.display === "inline" ? "inline-block" : style.display,
    ...(isButton && { "align-content": "center" }),
  };
}
