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

/** Says of what is in an element whether it may span columns: those of the book's own alone. */
export const columnSpan = "--laid-column-span";
const spanning = `${columnSpan}: all`;

/** Values of a property that would keep a box from its page, by the property's name, and what it is set to. */
const offPage: Readonly<Record<string, readonly [value: RegExp, paged: string]>> = {
  // There is no view that a box could stay in.
  position: [/^fixed$/, "absolute"],
  // A box that is laid out apart from what is around it does not break; of what is out of sight, nothing is laid out.
  contain: [/./, "none"],
  "content-visibility": [/^auto$/, "visible"],
  // Nor may a box be as high as nothing, whatever is in it.
  "container-type": [/^size$/, "inline-size"],
  "column-span": [/^all$/, `var(${columnSpan}, none)`],
};

/** Properties that set a box in columns of its own. */
const ownColumns = /^column-(?:count|width)$/;

/** Properties whose values are others in columns. */
const pagedProperties = [
  "break-before",
  "break-after",
  "break-inside",
  "column-count",
  "column-width",
  ...Object.keys(offPage),
];

/** Names of these, and of what stands for several of them. */
const ofPages =
  /^(?:page-|-webkit-column-)?break-|^col|^position$|^contain$|^container|^content-visibility$/;

/**
 * Stands beside a declaration of such a property whose value is a variable's, or depends on one: what it is
 * in columns is not known before the element is.
 */
export const variableMark = "--laid-by-variable";

/** Returns the declaration of a property, by its name in full, as it is set in columns. */
export function pagedDeclaration(name: string, value: string, priority: string): string {
  const declaration = `${name}: ${pagedValue(name, value)}${priority};`;
  if (ofPages.test(name) && /\bvar\(/i.test(value)) return `${declaration} ${variableMark}: 1;`;
  // What spans columns is not to span the pages.
  return hasColumns(name, value) ? `${declaration} ${spanning}${priority};` : declaration;
}

/**
 * Returns the declarations by which an element's values are as they are set in columns, those apart that are so.
 *
 * @param style of the element, computed
 */
export function pagedStyles(style: CSSStyleDeclaration): Readonly<Record<string, string>> {
  const changes: Record<string, string> = {};
  for (const name of pagedProperties) {
    const value = style.getPropertyValue(name);
    const paged = pagedValue(name, value);
    if (paged !== value) changes[name] = paged;
    if (hasColumns(name, value)) changes[columnSpan] = "all";
  }
  return changes;
}

function hasColumns(name: string, value: string): boolean {
  return ownColumns.test(name) && value !== "auto";
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
