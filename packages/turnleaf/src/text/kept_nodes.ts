/** Nodes that stay what they are while what they hold is laid anew: a selection ends where its nodes are taken away. */

/** Gives a parent these children, in place of which it keeps its own wherever they say the same: these take over attributes. */
export function keepNodes(parent: Element, nodes: readonly Node[]): void {
  const before = [...parent.childNodes];
  for (const [k, node] of nodes.entries()) {
    const kept = before[k];
    if (!kept) parent.append(node);
    else if (!takesOver(kept, node)) kept.replaceWith(node);
  }
  for (const left of before.slice(nodes.length)) left.remove();
}

/** Makes a node like another if it is of the same kind, and its text the same; returns whether it is. */
function takesOver(kept: Node, node: Node): boolean {
  if (kept.nodeName !== node.nodeName) return false;
  if (!(kept instanceof Element && node instanceof Element))
    return kept.nodeValue === node.nodeValue;
  for (const { name } of [...kept.attributes]) {
    if (!node.hasAttribute(name)) kept.removeAttribute(name);
  }
  for (const { name, value } of node.attributes) {
    if (kept.getAttribute(name) === value) continue;
    // As an attribute a page's policy may forbid it, and does not forbid it as this.
    if (name === "style" && "style" in kept) (kept as HTMLElement).style.cssText = value;
    else kept.setAttribute(name, value);
  }
  keepNodes(kept, [...node.childNodes]);
  return true;
}
