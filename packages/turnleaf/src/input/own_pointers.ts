/** Which elements over the book keep pointers and keys for themselves. */

/** Links, fields, films and other elements that are used by pressing them. */
const pressed =
  "a, button, input, select, textarea, label, summary, video, audio, iframe, object, [contenteditable], [draggable=true], [role=button], [role=slider]";

/** Elements that do something with keys of their own. */
const typed = "input, textarea, select, video, audio, iframe, [contenteditable], [role=slider]";

/** Text of the layer over the book, for a mouse or pen that selects it. */
const selected = "span, .guard";

/** Returns whether keys pressed at a target are its own. */
export function keepsKeys(target: EventTarget | undefined): boolean {
  return target instanceof Element && target.closest(typed) !== null;
}

/**
 * Returns whether a press is for an element on the page: a link or field, or
 * text that it selects.
 *
 * @param stage contains the canvas and what lies over it
 */
export function keepsPointer(event: PointerEvent, stage: HTMLElement): boolean {
  const [target] = event.composedPath();
  if (!(target instanceof Element)) return false;
  if (target.closest(pressed)) return true;
  const selects = event.pointerType !== "touch";
  if (stage.contains(target)) return event.pointerType === "mouse" && !!target.closest(selected);
  // A page that is an element: what its style says is to be pressed, or moves by itself.
  const { cursor, userSelect } = getComputedStyle(target);
  if (cursor === "pointer" || cursor === "grab" || cursor === "move") return true;
  if (onPath(event, stage, ({ touchAction }) => touchAction === "none")) return true;
  return selects && userSelect !== "none" && isOnText(event.clientX, event.clientY);
}

/** Returns whether the style of an element between an event's target and the stage says something. */
function onPath(
  event: Event,
  stage: HTMLElement,
  says: (style: CSSStyleDeclaration) => boolean,
): boolean {
  for (const node of event.composedPath()) {
    if (node === stage || !(node instanceof Element)) return false;
    if (node instanceof HTMLSlotElement) return false;
    if (says(getComputedStyle(node))) return true;
  }
  return false;
}

/** Returns whether there is a letter at a place of the window, CSS pixels. */
function isOnText(x: number, y: number): boolean {
  const caret = document.caretPositionFromPoint?.(x, y);
  const before = caret ? null : document.caretRangeFromPoint?.(x, y);
  const [node, offset] = caret
    ? [caret.offsetNode, caret.offset]
    : [before?.startContainer, before?.startOffset ?? 0];
  if (!(node instanceof Text)) return false;
  const range = document.createRange();
  range.setStart(node, Math.max(offset - 1, 0));
  range.setEnd(node, Math.min(offset + 1, node.length));
  return [...range.getClientRects()].some(
    ({ left, right, top, bottom }) => x >= left && x <= right && y >= top && y <= bottom,
  );
}
