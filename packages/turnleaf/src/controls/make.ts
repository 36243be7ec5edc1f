/**
 * Elements and icons, created in code: a strict security policy allows no
 * inline style in markup.
 */

/**
 * Creates an element with its attributes and children; `true` is an attribute
 * without a value, `false` none.
 */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Readonly<Record<string, string | number | boolean>> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== false) element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

/** Paths on a field of 24 x 24, drawn with a round pen. */
const paths = {
  tilt: "M7.5 6h9L20 18H4zM12 6v12",
  contents: "M9.5 6.5h10M9.5 12h10M9.5 17.5h10M4.5 6.5h1M4.5 12h1M4.5 17.5h1",
  thumbnails: "M4.5 4.5h6v6h-6zM13.5 4.5h6v6h-6zM4.5 13.5h6v6h-6zM13.5 13.5h6v6h-6z",
  search: "M16 10.5a5.5 5.5 0 1 1-11 0a5.5 5.5 0 0 1 11 0M14.6 14.6l5 5",
  bookmarks: "M8.5 7.5V4.5h10V17l-2.5-1.9M5.5 7.5h10V20l-5-3.8L5.5 20z",
  bookmark: "M7 4.5h10V20l-5-3.8L7 20z",
  previous: "M14.5 5.5 8 12l6.5 6.5",
  next: "M9.5 5.5 16 12l-6.5 6.5",
  zoomIn: "M16 10.5a5.5 5.5 0 1 1-11 0a5.5 5.5 0 0 1 11 0M14.6 14.6l5 5M10.5 8.2v4.6M8.2 10.5h4.6",
  zoomOut: "M16 10.5a5.5 5.5 0 1 1-11 0a5.5 5.5 0 0 1 11 0M14.6 14.6l5 5M8.2 10.5h4.6",
  spread: "M12 7c-2-1.6-4.6-2-8-2v12.5c3.4 0 6 .4 8 2 2-1.6 4.6-2 8-2V5c-3.4 0-6 .4-8 2zM12 7v12",
  shift: "M4.5 5h6v14h-6zM13.5 9.5H20M17 6.5l3 3-3 3M13.5 19v-5",
  single: "M6.5 4h11v16h-11zM9.5 8h5M9.5 11.5h5",
  fullscreen: "M9 4.5H4.5V9M15 4.5h4.5V9M9 19.5H4.5V15M15 19.5h4.5V15",
  leaveFullscreen: "M4.5 9H9V4.5M19.5 9H15V4.5M4.5 15H9v4.5M19.5 15H15v4.5",
  print: "M7.5 9V4.5h9V9M7.5 16.5H4.5V9h15v7.5h-3M7.5 13.5h9v6h-9z",
  download: "M12 4.5v10M7.5 10.5 12 15l4.5-4.5M5 19.5h14",
  play: "M8 5.5v13l10.5-6.5z",
  pause: "M8.5 5.5v13M15.5 5.5v13",
  sound: "M4.5 9.5v5h3l4.5 4v-13l-4.5 4zM15.5 9c1.5 1.8 1.5 4.2 0 6M18 6.5c3 3.3 3 7.7 0 11",
  readAloud:
    "M5 14.5v-2.5a7 7 0 0 1 14 0v2.5M5 14h2.5v5H6.5a1.5 1.5 0 0 1-1.5-1.5zM19 14h-2.5v5h1a1.5 1.5 0 0 0 1.5-1.5z",
  foldOut: "M4.5 5.5h7v13h-7zM11.5 5.5l8 2.5v10l-8 .5",
  tearOut: "M12.5 4.5H19.5V19.5H12.5l1.5-2.5-1.5-2.5 1.5-2.5-1.5-2.5 1.5-2.5zM9 4.5H4.5V19.5H9",
  crumple: "M8 4.5l8 1 3.5 6-2.5 7-8 1-4.5-6zM8 4.5l3 6.5 8.5.5M11 11l-2 8.5M11 11l-6.5 2.5",
  putBack: "M9.5 5.5 5 10l4.5 4.5M5 10h9a5 5 0 0 1 0 9h-3",
  theme: "M12 4a8 8 0 1 0 0 16a8 8 0 1 0 0-16zM12 4v16M12 8l5.5 0M12 12h8M12 16l5.5 0",
  type: "M4 18.5 8.5 6.5h1l4.5 12M5.7 14h6.6M15.5 18.5l2.8-7h.6l2.6 7M16.4 16.3h4.3",
  keys: "M3.5 7h17v10.5h-17zM7 10.5h.1M10.4 10.5h.1M13.6 10.5h.1M17 10.5h.1M8.5 14h7",
  more: "M11 6a1 1 0 1 0 2 0a1 1 0 1 0-2 0M11 12a1 1 0 1 0 2 0a1 1 0 1 0-2 0M11 18a1 1 0 1 0 2 0a1 1 0 1 0-2 0",
  close: "M6.5 6.5l11 11M17.5 6.5l-11 11",
} as const;

/** The name of an icon. */
export type Icon = keyof typeof paths;

/** Creates an icon in the colour of the surrounding text. */
export function icon(name: Icon): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", paths[name]);
  svg.append(path);
  return svg;
}

/** Shows another icon on a button. */
export function setIcon(button: Element, name: Icon): void {
  button.querySelector("path")?.setAttribute("d", paths[name]);
}

/**
 * Adds keyboard navigation to a row: arrows, Home and End move between the
 * `items`, in the order in which they are seen.
 *
 * @param isColumn whether they lie below each other too: then vertical arrows
 * move as well
 */
export function roving(row: HTMLElement, items: () => HTMLElement[], isColumn = false): void {
  row.addEventListener("keydown", (event) => {
    const all = items();
    const at = all.indexOf((row.getRootNode() as ShadowRoot).activeElement as HTMLElement);
    const isRtl = getComputedStyle(row).direction === "rtl";
    const across = isRtl ? { ArrowLeft: 1, ArrowRight: -1 } : { ArrowRight: 1, ArrowLeft: -1 };
    const steps: Record<string, number> = isColumn
      ? { ...across, ArrowDown: 1, ArrowUp: -1 }
      : across;
    const step = steps[event.key];
    let to = -1;
    if (step !== undefined) to = (at + step + all.length) % all.length;
    else if (event.key === "Home") to = 0;
    else if (event.key === "End") to = all.length - 1;
    if (to < 0 || event.defaultPrevented) return;
    event.preventDefault();
    for (const item of all) item.tabIndex = item === all[to] ? 0 : -1;
    all[to]?.focus();
  });
}
