/** Entities that a document declares itself, as books do for words that they repeat. */

/** What begins a list of declarations, and what ends it. */
const [listStart, listEnd] = [/<!DOCTYPE[^[<>]*\[/i, /\]\s*>/];

/** An entity that stands for text or markup: its name and its value. */
const declaration = /<!ENTITY\s+([A-Z_a-z][\w.-]*)\s+(?:"([^"]*)"|'([^']*)')/g;

/** A reference to an entity by its name. */
const reference = /&([A-Z_a-z][\w.-]{0,63});/g;

/**
 * Entities that are read, and the characters of a value, of what it stands for with others in it, and of all
 * that are put into a document.
 */
const [most, longest, longestExpanded, mostAdded] = [256, 1000, 4000, 1_000_000];

/**
 * Returns a document without its list of declarations, and with the values of entities that it declares in place
 * of references to them. References that are too many, or to an entity within itself, stay.
 */
export function withDeclaredEntities(text: string): string {
  const start = listStart.exec(text);
  if (start === null) return text;
  const from = start.index + start[0].length;
  const length = text.slice(from).search(listEnd);
  if (length < 0) return text;
  const values = new Map<string, string>();
  for (const [, name = "", double, single] of text
    .slice(from, from + length)
    .matchAll(declaration)) {
    const value = double ?? single ?? "";
    // Of several of one name the first counts.
    if (values.size < most && value.length <= longest && !values.has(name)) values.set(name, value);
  }
  let left = mostAdded;
  const known = new Map<string, string | null>();
  const expanded = (name: string): string | null => {
    const value = values.get(name);
    if (value === undefined || known.has(name)) return known.get(name) ?? null;
    // Within itself it stays.
    known.set(name, null);
    const whole = value.replace(reference, (all, inner: string) => expanded(inner) ?? all);
    const found = whole.length > longestExpanded ? null : whole;
    known.set(name, found);
    return found;
  };
  const rest = text.slice(from + length).replace(reference, (all, name: string) => {
    const value = expanded(name);
    if (value === null || value.length > left) return all;
    left -= value.length;
    return value;
  });
  return text.slice(0, from) + rest;
}
