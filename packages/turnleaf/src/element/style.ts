/** Style sheets of a shadow tree, whatever document its host is in. */

/**
 * Adds a style sheet to a shadow tree: not a `<style>` element, which pages
 * with a strict security policy forbid. A constructed sheet belongs to one
 * document for good, and a tree that moves to another loses its sheets, so each
 * is made in the window in which the tree is now.
 *
 * @returns a function that removes it
 */
export function addStyle(root: ShadowRoot, css: string): () => void {
  const view = root.ownerDocument.defaultView;
  // A document without a window shows nothing.
  if (view === null) return () => undefined;
  const sheet = new view.CSSStyleSheet();
  sheet.replaceSync(css);
  root.adoptedStyleSheets = [...root.adoptedStyleSheets, sheet];
  return () => {
    root.adoptedStyleSheets = root.adoptedStyleSheets.filter((other) => other !== sheet);
  };
}
