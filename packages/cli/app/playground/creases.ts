/** Creases of the sheet as a setting: a text that a link can carry. */

/** A crease drawn on the flat page. */
export interface DrawnCrease {
  /** u, v, u, v of two places on its line, hundredths of the page's width and height. */
  readonly through: readonly [number, number, number, number];
  /** The angle at which it is to rest, degrees: above 0 the parts turn toward the recto. */
  readonly angle: number;
}

/** Maximum number: more lie too near each other on the sheet's own nodes. */
export const mostCreases = 4;

/** Greatest angle, degrees, as of the sliders: further folds lie in themselves. */
export const mostAngle = 175;

/** Returns creases as a text: numbers with points between them, creases with underscores. */
export function writeCreases(creases: readonly DrawnCrease[]): string {
  return creases.map(({ through, angle }) => [...through, angle].join(".")).join("_");
}

/** Returns the creases of a text; null if it is none that `writeCreases` returns. */
export function readCreases(text: string): readonly DrawnCrease[] | null {
  if (text === "") return [];
  const creases = text.split("_").map((one): DrawnCrease | null => {
    const match = /^(\d{1,3})\.(\d{1,3})\.(\d{1,3})\.(\d{1,3})\.(-?\d{1,3})$/.exec(one);
    if (!match) return null;
    const [a, b, c, d, angle] = match.slice(1).map(Number);
    const isOnPage = Math.max(a, b, c, d) <= 100 && (a !== c || b !== d);
    return isOnPage && Math.abs(angle) <= mostAngle ? { through: [a, b, c, d], angle } : null;
  });
  const found = creases.filter((one) => one !== null);
  return found.length === creases.length && found.length <= mostCreases ? found : null;
}

/** Returns whether two creases lie on the same line. */
export const isSameLine = (a: DrawnCrease, b: DrawnCrease): boolean =>
  a.through.every((place, k) => place === b.through[k]);

/** Returns both ends of the line through two places: where it meets the page's edges, as these. */
export function endsOf([a, b, c, d]: DrawnCrease["through"]): readonly [
  number,
  number,
  number,
  number,
] {
  let [from, to] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
  for (const [start, way] of [
    [a, c - a],
    [b, d - b],
  ]) {
    if (way === 0) continue;
    const [one, other] = [-start / way, (100 - start) / way];
    from = Math.max(from, Math.min(one, other));
    to = Math.min(to, Math.max(one, other));
  }
  const at = (t: number): [number, number] => [a + t * (c - a), b + t * (d - b)];
  return [...at(from), ...at(to)];
}
