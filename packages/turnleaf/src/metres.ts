/** Lengths on paper, as they are written. */

/** Metres in each unit. */
const units = new Map([
  ["mm", 1e-3],
  ["cm", 1e-2],
  ["m", 1],
  ["in", 0.0254],
  ["pt", 0.0254 / 72],
]);

/**
 * Returns the metres in a length such as "210mm", "21 cm" or "8.5in"; undefined if it is none, or not
 * above 0.
 */
export function metresIn(text: string): number | undefined {
  const [, number = "", unit = ""] = /^([\d.]+) ?([a-z]+)$/.exec(text.trim().toLowerCase()) ?? [];
  return metresOf(Number(number), unit);
}

/** Returns the metres in so many of a unit; undefined if it is unknown, or they are not above 0. */
export function metresOf(number: number, unit: string): number | undefined {
  const metres = number * (units.get(unit) ?? Number.NaN);
  return metres > 0 && metres < Number.POSITIVE_INFINITY ? metres : undefined;
}
