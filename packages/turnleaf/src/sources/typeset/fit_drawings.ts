/**
 * Drawings without a `viewBox` that are larger than a page. A browser cuts at its edges a drawing that is to
 * be smaller than itself, unless that says by a `viewBox` what of it is to be seen: here all of it.
 */

import { setStyles, tolerance } from "./box_styles.ts";
import { drawingOf } from "./frame.ts";

/** What makes room for a drawing's own size. */
const unbounded = ["max-width", "max-height", "max-inline-size", "max-block-size"];

/**
 * Makes the drawings smaller that have no room in their own size.
 *
 * @param body the section's body, laid out
 */
export function fitDrawings(body: Element): void {
  const drawings = [...body.querySelectorAll<SVGSVGElement>("svg:not([viewBox])")].filter(
    (svg) => drawingOf(svg, body) === svg,
  );
  if (drawings.length === 0) return;
  const sizes = (): DOMRect[] => drawings.map((svg) => svg.getBoundingClientRect());
  const shown = sizes();
  const styles = drawings.map((svg) => svg.style.cssText);
  for (const svg of drawings)
    setStyles(svg, Object.fromEntries(unbounded.map((name) => [name, "none"])));
  const own = sizes();
  drawings.forEach((svg, k) => {
    svg.style.cssText = styles[k] as string;
    const [whole, part] = [own[k] as DOMRect, shown[k] as DOMRect];
    const scale = Math.min(part.width / whole.width, part.height / whole.height);
    const isCut = whole.width > part.width + tolerance || whole.height > part.height + tolerance;
    if (!isCut || !(scale > 0)) return;
    svg.setAttribute("viewBox", `0 0 ${whole.width} ${whole.height}`);
    setStyles(svg, {
      width: `${whole.width * scale}px`,
      height: `${whole.height * scale}px`,
    });
  });
}
