/**
 * Takes all that is in an element out of it, in order. A hundred thousand nodes are more than a function takes
 * arguments, as `replaceWith(...element.childNodes)` would have it.
 */
export function takeContent(element: Element): DocumentFragment {
  const range = element.ownerDocument.createRange();
  range.selectNodeContents(element);
  return range.extractContents();
}
