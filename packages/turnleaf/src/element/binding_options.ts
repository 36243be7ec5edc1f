/** The attributes of the binding: `cover`, `cloth`, `binding`, `layout`, `offset`, `hard-pages`. */

import type { LayoutOptions } from "../book/layout.ts";

/** Their names. */
export const bindingAttributes: readonly string[] = [
  "cover",
  "cloth",
  "binding",
  "layout",
  "offset",
  "hard-pages",
];

const covers = ["hard", "soft", "none"] as const;
const bindings = ["auto", "left", "right", "top", "bottom"] as const;
const layouts = ["auto", "spread", "single"] as const;

/** Returns the options in an element's attributes; an invalid value counts as missing. */
export function bindingOptionsOf(element: Element): LayoutOptions & { cloth: string } {
  const word = <W extends string>(name: string, words: readonly W[]): W =>
    words.find((known) => known === element.getAttribute(name)) ?? words[0];
  return {
    cover: word("cover", covers),
    cloth: element.getAttribute("cloth") ?? "#6a2a26",
    binding: word("binding", bindings),
    layout: word("layout", layouts),
    offset: element.getAttribute("offset") === "0" ? 0 : 1,
    hardPages: element.getAttribute("hard-pages") ?? "",
  };
}
