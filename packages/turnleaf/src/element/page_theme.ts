/** The theme of an element's book, by its attributes and by the system. */

import { attributeOf, attributesThat } from "../attributes.ts";
import type { PageTheme } from "../themes.ts";

/** Attributes that say in which colours a book is shown. */
export const themeAttributes: readonly string[] = attributesThat("recolour");

const darkScheme = "(prefers-color-scheme: dark)";

/**
 * Returns the theme of an element's book: the one that `theme` names, or by day and by night as the
 * system has it. An element with neither controls nor a theme is a picture in its web page, which
 * decides: it is `light`.
 */
export function pageThemeOf(element: Element): PageTheme {
  const named = attributeOf(element, "theme");
  if (named !== "auto") return named;
  const isOwn = element.hasAttribute("controls") || element.hasAttribute("theme");
  const view = element.ownerDocument.defaultView;
  return isOwn && view?.matchMedia(darkScheme).matches ? "night" : "light";
}

/** Calls `changed` when the system goes over to day or night, until the signal aborts. */
export function watchScheme(view: Window, changed: () => void, signal: AbortSignal): void {
  view.matchMedia(darkScheme).addEventListener("change", changed, { signal });
}
