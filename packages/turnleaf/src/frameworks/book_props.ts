/** What the components for frameworks have in common: the properties of a book, and its events. */

import {
  type Attribute,
  type AttributeProperties,
  attributeName,
  attributeProperties,
  attributes,
} from "../attributes.ts";
import type { TurnleafBook, TurnleafEventMap } from "../index.ts";

/** The others that can be set, and what they are if they are not. */
const otherProps = {
  pages: null,
  paper: null,
  password: "",
  zoom: 1,
  bookmarks: [],
  dogEars: [],
  folds: [],
  shifts: [],
} as const;

type AttributeProp = keyof AttributeProperties | "page";
type OtherProp = keyof typeof otherProps;
const attributeProps: readonly AttributeProp[] = ["page", ...attributeProperties];

/** The properties of a book that can be set, as those of `<turnleaf-book>`. */
export type BookProps = Partial<Pick<TurnleafBook, AttributeProp | OtherProp>>;

/** Their names. */
export const bookProps: readonly (keyof BookProps)[] = [
  ...attributeProps,
  ...(Object.keys(otherProps) as OtherProp[]),
];

/** Those that are true or false. */
export const booleanProps: readonly (keyof BookProps)[] = attributeProperties.filter(
  (name) => typeof attributes[name].read(null) === "boolean",
);

/** The events by the property of a listener in React. */
export const eventOf = {
  onLoad: "load",
  onTurnStart: "turnstart",
  onPageChange: "pagechange",
  onLayoutChange: "layoutchange",
  onPagesChange: "pageschange",
  onStateChange: "statechange",
  onZoomChange: "zoomchange",
  onBookmarkChange: "bookmarkchange",
  onDogEarChange: "dogearchange",
  onFoldChange: "foldchange",
  onTear: "tear",
  onTorn: "torn",
  onShiftChange: "shiftchange",
  onPlayChange: "playchange",
  onReadAloudChange: "readaloudchange",
  onPageError: "pageerror",
  onWarnings: "warnings",
  onError: "error",
} as const;

/** Returns the value of an attribute, `true` for one without a value; null if there is to be none. */
function attributeValue(prop: AttributeProp, value: unknown): string | true | null {
  if (value === undefined || value === null) return null;
  return prop === "page" ? String(value) : (attributes[prop] as Attribute<unknown>).write(value);
}

/** Returns the attributes of a book as it is first rendered, also on a server; `true` for those without a value. */
export function attributesOf(props: BookProps): Record<string, string | true> {
  const values = attributeProps.flatMap((prop) => {
    const value = attributeValue(prop, props[prop]);
    return value === null ? [] : [[attributeName(prop), value] as const];
  });
  return Object.fromEntries(values);
}

/** What was set last, by book. */
const applied = new WeakMap<TurnleafBook, BookProps>();

/**
 * Sets properties that are others than the last time. Lists and objects of the same contents are the
 * same: a list that is written anew at every rendering does not open the book anew.
 */
export function applyProps(book: TurnleafBook, props: BookProps): void {
  const before = applied.get(book) ?? {};
  applied.set(book, { ...props });
  for (const prop of attributeProps) {
    const value = attributeValue(prop, props[prop]);
    if (value === attributeValue(prop, before[prop])) continue;
    if (value === null) book.removeAttribute(attributeName(prop));
    else book.setAttribute(attributeName(prop), value === true ? "" : value);
  }
  for (const [prop, missing] of Object.entries(otherProps)) {
    const value = props[prop as OtherProp] ?? missing;
    if (!isSame(value, before[prop as OtherProp] ?? missing)) Reflect.set(book, prop, value);
  }
}

/** Whether two values are one, or lists or plain objects of the same contents. */
function isSame(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true;
  if (Array.isArray(a) && Array.isArray(b)) {
    return a.length === b.length && a.every((item, k) => isSame(item, b[k]));
  }
  if (!isPlain(a) || !isPlain(b)) return false;
  const keys = Object.keys(a);
  return (
    keys.length === Object.keys(b).length &&
    keys.every((key) => Object.hasOwn(b, key) && isSame(a[key], b[key]))
  );
}

function isPlain(value: unknown): value is Record<string, unknown> {
  return (
    typeof value === "object" && value !== null && Object.getPrototypeOf(value) === Object.prototype
  );
}

/**
 * Calls a listener of `load` if the book is open already: one of a server's HTML may be, before its
 * framework is.
 */
export function reportOpen(
  book: TurnleafBook,
  listener?: (event: TurnleafEventMap["load"]) => void,
): void {
  const { pageCount, bookTitle: title } = book;
  if (pageCount > 0) listener?.(new CustomEvent("load", { detail: { pageCount, title } }));
}
