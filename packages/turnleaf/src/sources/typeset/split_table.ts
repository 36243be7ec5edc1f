/** Tables that lie sideways and have more rows than a page has room for: as many tables, each with the head. */

/** Marks a head that is repeated: it is drawn, and is no text of the book. */
export const repeatedAttribute = "data-turnleaf-repeated";

/**
 * Splits a table between its rows, where no cell goes over, so that each part is no longer than a page. Each
 * begins with the table's head and keeps the widths of its columns. Returns the parts after the first, which
 * is the table itself; null if a row is longer than a page has room for, and then changes nothing.
 *
 * @param table laid out in lines that stand upright, from right to left
 * @param length of a page across these lines, CSS pixels
 * @param zoom of the table
 */
export function splitTable(
  table: HTMLTableElement,
  length: number,
  zoom: number,
): HTMLTableElement[] | null {
  const rows = [...table.rows];
  const head = headOf(table, rows);
  const groups = partsOf(table, rows, head, length);
  if (groups === null) return null;
  const widths = new Map<HTMLElement, number>();
  for (const cell of rows.flatMap(({ cells }) => [...cells])) {
    if (cell.colSpan === 1) widths.set(cell, cell.getBoundingClientRect().height / zoom);
  }
  for (const [cell, width] of widths) {
    cell.style.setProperty("box-sizing", "border-box", "important");
    cell.style.setProperty("inline-size", `${width}px`, "important");
  }
  let last = table;
  return groups.slice(1).map((group) => {
    const part = table.cloneNode(false) as HTMLTableElement;
    const columns = [...table.children].filter(({ localName }) => /^col(group)?$/.test(localName));
    part.removeAttribute("id");
    part.append(...columns.map((one) => one.cloneNode(true)));
    addRows(head, table, part, repeated);
    addRows(group, table, part, (row) => row);
    last.after(part);
    last = part;
    return part;
  });
}

/** Returns the rows of a table's head: those that say so, or the first ones that have headings alone. */
function headOf(
  { tHead }: HTMLTableElement,
  rows: readonly HTMLTableRowElement[],
): HTMLTableRowElement[] {
  if (tHead) return [...tHead.rows];
  const end = rows.findIndex(({ cells }) => [...cells].some(({ localName }) => localName !== "th"));
  return rows.slice(0, Math.max(end, 0));
}

/** Returns the rows of each part, of the first with the head; null if there is no room for some. */
function partsOf(
  table: HTMLTableElement,
  rows: readonly HTMLTableRowElement[],
  head: readonly HTMLTableRowElement[],
  length: number,
): HTMLTableRowElement[][] | null {
  const { right, width } = table.getBoundingClientRect();
  const ends = rows.map((row) => {
    const rect = row.getBoundingClientRect();
    return { from: right - rect.right, to: right - rect.left };
  });
  const last = ends.at(-1);
  if (!last) return null;
  const after = width - last.to;
  // What later parts have before their own rows: all that is before the first, but for the caption.
  const caption = table.caption?.getBoundingClientRect().width ?? 0;
  const before = (ends[head.length]?.from ?? 0) - caption;
  const parts: HTMLTableRowElement[][] = [[...head]];
  let start = caption;
  for (const [first, next] of blocksOf(rows, head.length)) {
    const [from, to] = [ends[first]?.from ?? 0, ends[next - 1]?.to ?? 0];
    const isFull = to - start + (parts.length > 1 ? 0 : caption) + after > length;
    if (isFull) {
      if (before + to - from + after > length) return null;
      parts.push([]);
      start = from - before;
    }
    parts.at(-1)?.push(...rows.slice(first, next));
  }
  return (parts[0]?.length ?? 0) > head.length ? parts : null;
}

/** Yields the rows that stay together, as a cell goes over them: the first, and the one after the last. */
function* blocksOf(
  rows: readonly HTMLTableRowElement[],
  from: number,
): Generator<readonly [first: number, next: number]> {
  for (let first = from; first < rows.length; ) {
    let next = first + 1;
    for (let row = first; row < next; row++) {
      for (const { rowSpan } of rows[row]?.cells ?? []) {
        // 0 is all that there are.
        next = Math.min(Math.max(next, rowSpan === 0 ? rows.length : row + rowSpan), rows.length);
      }
    }
    yield [first, next];
    first = next;
  }
}

/** Returns a copy of a row of a head, without ids, which are each of one element. */
function repeated(row: HTMLTableRowElement): HTMLTableRowElement {
  const copy = row.cloneNode(true) as HTMLTableRowElement;
  copy.setAttribute(repeatedAttribute, "");
  for (const element of [copy, ...copy.querySelectorAll("[id]")]) element.removeAttribute("id");
  return copy;
}

/**
 * Adds rows to the end of a table, in parts of it like those of the table that they are from, if they are in any.
 *
 * @param made returns the row that is added for one
 */
function addRows(
  rows: readonly HTMLTableRowElement[],
  from: HTMLTableElement,
  to: HTMLTableElement,
  made: (row: HTMLTableRowElement) => HTMLTableRowElement,
): void {
  let own: Element | null = null;
  let section: Element = to;
  for (const row of rows) {
    if (row.parentElement !== own) {
      own = row.parentElement;
      section = to;
      if (own !== from) {
        section = own?.cloneNode(false) as Element;
        section.removeAttribute("id");
        to.append(section);
      }
    }
    section.append(made(row));
  }
}
