/**
 * Returns the anchor of a heading, as web sites of repositories make it, which links in the
 * docs name after `#`.
 *
 * @param words the heading as it is written in Markdown
 */
export function anchorOf(words) {
  return words
    .toLowerCase()
    .replace(/[^\p{L}\p{N}\s_-]/gu, "")
    .replace(/\s/g, "-");
}
