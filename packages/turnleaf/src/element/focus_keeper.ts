/**
 * Keeps the focus in the book. An element that is removed, hidden or made inert loses the focus to the
 * document, where the book's keys do nothing: a link as its page turns, a button whose use is over.
 */

/**
 * Gives the focus to the book whenever what has it in a shadow tree, or in an element that is shown
 * there, can have it no longer and nothing else has taken it.
 *
 * @param focus gives the focus to the book itself
 */
export function keepFocus(root: ShadowRoot, focus: () => void): void {
  let focused: Element | null = null;
  const observer = new MutationObserver(() => {
    if (focused === null || canHaveFocus(focused)) return;
    const { host, activeElement, ownerDocument } = root;
    const at = ownerDocument.activeElement;
    // An element from elsewhere is no part of the shadow tree.
    const isElsewhere = at !== ownerDocument.body && at !== host && at !== focused;
    const isTaken = isElsewhere || (activeElement !== null && activeElement !== focused);
    end();
    if (!isTaken) focus();
  });
  const end = (): void => {
    focused = null;
    observer.disconnect();
  };
  root.host.addEventListener("focusin", (event) => {
    end();
    const [target] = event.composedPath();
    // What is the tree's own root is never removed.
    if (!(target instanceof Element) || target.parentNode === root) return;
    focused = target;
    observer.observe(root, {
      subtree: true,
      childList: true,
      attributeFilter: ["hidden", "inert", "disabled", "class", "style"],
    });
  });
  root.host.addEventListener("focusout", () => {
    // Of an element that is removed, some browsers say so at once, others never.
    if (focused && canHaveFocus(focused)) end();
  });
}

/**
 * Gives an element the class `tabbed` while its reader goes by Tab, not by a pointer: only then is it shown
 * that it has the focus. Of what is in it the class `pressed` says the same the other way about: a browser
 * frames what a program gives the focus to, and readers by a pointer need no frame.
 */
export function followTab(element: HTMLElement): void {
  // Who comes from outside lets go of the key in it.
  element.addEventListener("keyup", ({ key }) => {
    if (key === "Tab") element.classList.add("tabbed");
  });
  const pressed = (): void => {
    element.classList.remove("tabbed");
    element.classList.add("pressed");
  };
  const go = (): void => element.classList.remove("pressed");
  element.addEventListener("keydown", go, { capture: true, passive: true });
  element.addEventListener("pointerdown", pressed, { capture: true, passive: true });
}

/** Returns whether an element is shown where it can be used. */
function canHaveFocus(element: Element): boolean {
  if (!element.isConnected || element.matches(":disabled")) return false;
  if (!element.checkVisibility({ visibilityProperty: true })) return false;
  for (let at: Element | null = element; at; at = aroundOf(at)) {
    if (at instanceof HTMLElement && at.inert) return false;
  }
  return true;
}

/** Returns what an element is shown in: its slot, its parent, or the host of its shadow tree. */
function aroundOf(element: Element): Element | null {
  const { assignedSlot, parentElement } = element;
  if (assignedSlot ?? parentElement) return assignedSlot ?? parentElement;
  const root = element.getRootNode();
  return root instanceof ShadowRoot ? root.host : null;
}
