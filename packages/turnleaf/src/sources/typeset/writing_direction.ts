/** Languages that are written from right to left. */
const rightToLeft = /^(ar|arc|ckb|dv|fa|he|ks|ps|sd|syr|ug|ur|yi)\b(?!-(Latn|Cyrl))/;

/** Returns whether a language (BCP 47) is written from right to left: a book that says no more goes so. */
export function isRightToLeft(language: string): boolean {
  return rightToLeft.test(language);
}
