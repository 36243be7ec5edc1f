/** Whether an element may be seen larger or smaller than before. */

/**
 * Calls `changed` after anything that may have transformed an element as it is seen: a style or a class of
 * its own or of an element around it, a transition or an animation that ended, another size of the window.
 * No browser reports a transformation itself.
 *
 * @param signal ends it
 */
export function watchTransformation(
  element: HTMLElement,
  changed: () => void,
  signal: AbortSignal,
): void {
  const view = element.ownerDocument.defaultView ?? window;
  const observer = new view.MutationObserver(changed);
  const attributeFilter = ["style", "class"];
  for (let node: Element | null = element; node; node = around(node)) {
    observer.observe(node, { attributes: true, attributeFilter });
  }
  signal.addEventListener("abort", () => observer.disconnect(), { once: true });
  for (const type of ["transitionend", "animationend", "resize"]) {
    view.addEventListener(type, changed, { signal });
  }
}

/** Returns the element within which one is laid out. */
function around(element: Element): Element | null {
  const root = element.getRootNode();
  return (
    element.assignedSlot ?? element.parentElement ?? (root instanceof ShadowRoot ? root.host : null)
  );
}
