/** The theme of an element's book, by its attributes and by the system. */

import type { PageColours } from "../sources/page_source.ts";
import { type PageTheme, pageThemes } from "../themes.ts";

/** Attributes that say in which colours a book is shown. */
export const themeAttributes = ["theme", "dark-pages"] as const;

const darkScheme = "(prefers-color-scheme: dark)";

/** What dark themes may do with pages that are drawn already. */
export const darkPages = ["invert", "dim"] as const;

/**
 * Returns the theme of an element's book: the one that `theme` names, or by day and by night as the
 * system has it. An element with neither controls nor a theme is a picture in its web page, which
 * decides: it is `light`.
 */
export function pageThemeOf(element: Element): PageTheme {
  const named = pageThemes.find((theme) => theme === element.getAttribute("theme"));
  if (named) return named;
  const isOwn = element.hasAttribute("controls") || element.hasAttribute("theme");
  const view = element.ownerDocument.defaultView;
  return isOwn && view?.matchMedia(darkScheme).matches ? "night" : "light";
}

/** Returns what dark themes do with pages that are drawn already, by `dark-pages`. */
export function darkPagesOf(element: Element): PageColours["pictures"] {
  return darkPages.find((known) => known === element.getAttribute("dark-pages")) ?? "";
}

/** Calls `changed` when the system goes over to day or night, until the signal aborts. */
export function watchScheme(view: Window, changed: () => void, signal: AbortSignal): void {
  view.matchMedia(darkScheme).addEventListener("change", changed, { signal });
}
