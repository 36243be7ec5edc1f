/** The theme of an element's book, by its attributes and by the system. */

import { attributeOf, attributesThat } from "../attributes.ts";
import type { PageColours, PageTheme } from "../themes.ts";

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

/**
 * Returns the CSS filter under which a book in a dark theme is printed with the web page: its ink on
 * light paper, as black paper takes a cartridge of ink; pictures that are dimmed as bright as they are.
 *
 * @param done what the theme does with what is drawn already, as `PageList.darkened` has it
 */
export function printFilterOf(colours: PageColours | null, done: PageColours["pictures"]): string {
  if (!colours?.isDark) return "none";
  return done === "dim" ? "brightness(1.25)" : "invert() hue-rotate(180deg) brightness(1.12)";
}

/** Calls `changed` when the system goes over to day or night, until the signal aborts. */
export function watchScheme(view: Window, changed: () => void, signal: AbortSignal): void {
  view.matchMedia(darkScheme).addEventListener("change", changed, { signal });
}
