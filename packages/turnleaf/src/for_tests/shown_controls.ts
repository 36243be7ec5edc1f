/** What tests look up among the controls of a book. */

/** Returns the element in sight that has an accessible name. Throws if there is none. */
export function named(root: ShadowRoot, name: string): HTMLElement {
  const all = root.querySelectorAll<HTMLElement>(`[aria-label="${name}"]`);
  const found = [...all].find((element) => element.offsetParent !== null);
  if (!found) throw new Error(`Nothing in sight is called ${name}.`);
  return found;
}

/** Returns what the book is seen through, and takes the focus of the book; null if it is gone. */
export function frameOf(root: ShadowRoot): Element | null {
  return root.querySelector(".frame");
}

/** Returns the name of what has the focus: "book" of the book itself. */
export function active(root: ShadowRoot): string {
  const { activeElement } = root;
  if (activeElement === frameOf(root)) return "book";
  return activeElement?.getAttribute("aria-label") ?? activeElement?.textContent ?? "";
}
