/** Tags of any number of attributes, which parsers compare with each other. */

/** Attributes that an element may have; no book's has as many. */
const mostAttributes = 1000;

/** Characters that as many have, at least: a blank and a letter each. */
const leastLength = 2 * mostAttributes;

const tagStart = /<[a-z][^\s<>/"'=]*/gi;
const attribute = /[\s/]+[^\s=<>"'/]+(?:\s*=\s*(?:"[^"]*"|'[^']*'|[^\s"'<>]+))?/gy;

/** Returns markup without the attributes that a tag has beyond the first thousand. */
export function withBoundedTags(markup: string): string {
  const parts: string[] = [];
  let kept = 0;
  for (const { 0: name, index } of markup.matchAll(tagStart)) {
    const start = index + name.length;
    const next = markup.indexOf("<", start);
    if (index < kept || (next < 0 ? markup.length : next) - start < leastLength) continue;
    let [count, end] = [0, start];
    for (attribute.lastIndex = start; attribute.test(markup); count++) {
      if (count === mostAttributes - 1) parts.push(markup.slice(kept, attribute.lastIndex));
      end = attribute.lastIndex;
    }
    if (count >= mostAttributes) kept = end;
  }
  return kept === 0 ? markup : parts.join("") + markup.slice(kept);
}
