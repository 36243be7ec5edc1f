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

/** Values of a property that would keep a box from its page, by the property's name, and what it is set to. */
const offPage: Readonly<Record<string, readonly [value: RegExp, paged: string]>> = {
  // There is no view that a box could stay in.
  position: [/^fixed$/, "absolute"],
  // A box that is laid out apart from what is around it does not break; of what is out of sight, nothing is laid out.
  contain: [/./, "none"],
  "content-visibility": [/^auto$/, "visible"],
  "column-span": [/^all$/, "var(--laid-column-span, none)"],
};

/** Properties that set a box in columns of its own. */
const ownColumns = /^column-(?:count|width)$/;

/** Returns the declaration of a property, by its name in full, as it is set in columns. */
export function pagedDeclaration(name: string, value: string, priority: string): string {
  const declaration = `${name}: ${pagedValue(name, value)}${priority};`;
  // What spans columns is not to span the pages.
  const hasColumns = ownColumns.test(name) && value !== "auto";
  return hasColumns ? `${declaration} --laid-column-span: all${priority};` : declaration;
}

function pagedValue(name: string, value: string): string {
  if (beside.test(name) && newPage.test(value)) return "column";
  if (name === "break-inside" && value === "avoid-page") return "avoid";
  const [kept, paged] = offPage[name] ?? [];
  if (kept?.test(value) && paged !== undefined) return paged;
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
 * Returns the declarations that say how large the type area is, for the lengths of `pagedDeclaration`.
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
