/** Page numbers as pages and frameworks give them. */

/**
 * Returns the number that a value stands for as a page: a number, or text that
 * writes one, as attributes and fields do. Null for anything else, such as NaN,
 * undefined and text without a number. It may lie outside the book.
 */
export function pageNumber(value: unknown): number | null {
  const isNumber = typeof value === "number" || (typeof value === "string" && value.trim() !== "");
  const number = isNumber ? Number(value) : Number.NaN;
  return Number.isNaN(number) ? null : number;
}
