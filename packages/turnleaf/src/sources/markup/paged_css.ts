/**
 * What style sheets say of pages, as columns understand it: books are set as columns of a frame, whose
 * breaks are breaks of columns and whose view is no page.
 */

/** Properties of breaks beside a box and in it. */
const beside = /^break-(?:before|after)$/;

/** Values that ask for a page, or a side of one. */
const newPage = /^(?:always|all|page|left|right|recto|verso)$/;

/** A length in a unit of the view, as the browser writes it, outside strings and names. */
const viewLength = /(?<![\w.#-])(-?(?:\d{1,30}\.\d{1,30}|\d{1,30}))[sld]?v(w|h|min|max|i|b)\b/g;

/** A string, or what is between strings. */
const pieces = /"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*'|[^"']+/g;

/** Names of the custom properties that hold a hundredth of the type area's sides. */
const areaUnit = {
  w: "var(--laid-area-width)",
  h: "var(--laid-area-height)",
  i: "var(--laid-area-inline)",
  b: "var(--laid-area-block)",
  min: "min(var(--laid-area-width), var(--laid-area-height))",
  max: "max(var(--laid-area-width), var(--laid-area-height))",
} as const;

/** Returns the value of a property, by its name in full, as it is set in columns. */
export function pagedValue(name: string, value: string): string {
  if (beside.test(name) && newPage.test(value)) return "column";
  if (name === "break-inside" && value === "avoid-page") return "avoid";
  if (!/\dv|\d[sld]v/.test(value)) return value;
  return value.replace(pieces, (piece) =>
    /^["']/.test(piece)
      ? piece
      : piece.replace(viewLength, (_, count: string, unit: keyof typeof areaUnit) => {
          return `calc(${count} * ${areaUnit[unit]})`;
        }),
  );
}

/**
 * Returns the declarations that say how large the type area is, for `pagedValue`'s lengths.
 *
 * @param width of the area, CSS pixels
 * @param height likewise
 */
export function areaDeclarations(width: number, height: number, isVertical: boolean): string {
  const [inline, block] = isVertical ? [height, width] : [width, height];
  return Object.entries({ width, height, inline, block })
    .map(([name, length]) => `--laid-area-${name}: ${length / 100}px !important;`)
    .join(" ");
}
