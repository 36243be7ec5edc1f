/** Buttons that follow the state of their actions. */

import type { Action } from "./actions.ts";
import { type Icon, icon, make, setIcon } from "./make.ts";

/**
 * Creates a round button with an icon and a name.
 *
 * @csspart button A button of the controls that shows an icon.
 */
export function iconButton(
  name: Icon,
  label: string,
  attributes: Readonly<Record<string, string | boolean>> = {},
): HTMLButtonElement {
  return make(
    "button",
    { type: "button", part: "button", "aria-label": label, title: label, ...attributes },
    icon(name),
  );
}

/** Creates a button for an action; `refresh` updates its state. */
export function actionButton(action: Action): { button: HTMLButtonElement; refresh(): void } {
  const button = iconButton(action.icon(), action.label());
  if (action.key) button.setAttribute("aria-keyshortcuts", action.key);
  button.addEventListener("click", () => {
    // Not `disabled`: the focus would be lost with the last press.
    if (button.ariaDisabled !== "true") action.run(button);
  });
  const refresh = (): void => {
    setIcon(button, action.icon());
    const label = action.label();
    button.setAttribute("aria-label", label);
    button.title = action.key ? `${label} (${action.key.toUpperCase()})` : label;
    if (action.pressed) button.ariaPressed = String(action.pressed());
    if (action.disabled) button.ariaDisabled = String(action.disabled());
    if (action.hidden) button.hidden = action.hidden();
  };
  refresh();
  return { button, refresh };
}
