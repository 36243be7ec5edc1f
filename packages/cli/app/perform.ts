/** Performs the actions of a film on its book. */

import type { TurnleafBook } from "turnleaf";
import type { ActionFold, ActionPlace, FilmAction } from "../src/film/film_actions.ts";

/** An action that begins a motion. */
export type Performed = Exclude<FilmAction, { name: "wait" }>;

/** Why nothing comes of an action. */
const reasons: Readonly<Record<Performed["name"], string>> = {
  next: "no page follows",
  previous: "no page lies before it",
  "go-to": "the book does not lie there",
  "dog-ear": "this page does not fold",
  fold: "this page does not fold",
  unfold: "this page is neither folded nor an open page that is wider than the book",
  "fold-in": "no fold-out lies open",
  "tear-out": "only a leaf of paper of which a page lies open can be torn out",
  "tear-across": "no loose sheet is whole, or a piece would be narrower than some 16 mm",
  crumple: "no loose sheet is whole",
  "put-back": "nothing is torn out",
};

/**
 * The folds of a letter, in the order in which they are made: how far they are from the spine, as
 * fractions of the page, and their angles in degrees.
 */
const letterFolds = [
  [0.7, 175],
  [0.4, 160],
] as const;

/** Returns whether an action needs leaves that may be torn out. */
export function tears({ name }: FilmAction): boolean {
  return name === "tear-out";
}

/**
 * Performs an action. Resolves once it is done; what it moved may move on.
 *
 * Rejects with an error whose sentence says why it cannot be done.
 */
export async function perform(book: TurnleafBook, action: Performed): Promise<void> {
  const isDone = await done(book, action).catch((error: unknown) => {
    throw new Error(sentence(action, error instanceof Error ? error.message : String(error)));
  });
  if (!isDone) throw new Error(sentence(action, `${reasons[action.name]}.`));
}

function sentence({ text }: FilmAction, reason: string): string {
  return `"${text}" cannot be done: ${reason}`;
}

async function done(book: TurnleafBook, action: Performed): Promise<boolean> {
  switch (action.name) {
    case "next":
      return await book.next();
    case "previous":
      return await book.previous();
    case "go-to":
      return await book.goTo(action.page);
    case "dog-ear":
      return await book.dogEar(action.page, action.corner, action.size);
    case "fold":
      return await fold(book, action.page, action.fold);
    case "unfold":
      return await book.unfold(action.page);
    case "fold-in":
      await book.foldIn();
      return true;
    case "tear-out":
      return await book.tearOut(action.page);
    case "tear-across":
      return book.tearAcross(action.from, action.to);
    case "crumple":
      return book.crumple();
    case "put-back":
      return await book.putBack();
  }
}

async function fold(book: TurnleafBook, page: number, fold: ActionFold | "letter") {
  const folds = fold === "letter" ? letter(book, page) : [fold];
  for (const { from, to, angle } of folds) {
    if (!(await book.fold(page, from, to, angle))) return false;
  }
  return true;
}

/** Returns the folds of an open page as a letter, parallel to its spine. */
function letter(book: TurnleafBook, page: number): ActionFold[] {
  const { left, right } = book.spread;
  if (page !== left && page !== right) throw new Error("the page does not lie open.");
  const isLevel = /^(top|bottom)$/.test(book.getAttribute("binding") ?? "");
  return letterFolds.map(([far, angle]) => {
    const at = page === right ? far : 1 - far;
    const place = (along: number): ActionPlace =>
      isLevel ? { x: along, y: at } : { x: at, y: along };
    return { from: place(0), to: place(1), angle };
  });
}
