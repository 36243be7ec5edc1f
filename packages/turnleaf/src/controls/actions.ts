/** The actions on a book: one table, used by the toolbar, the menu and the keys. */

import type { ControlledBook } from "./book.ts";
import type { Icon } from "./make.ts";
import type { Wording } from "./wording.ts";

/** The tabs of the side panel. */
export const tabs = ["contents", "thumbnails", "search", "bookmarks", "type"] as const;
export type Tab = (typeof tabs)[number];

/** An action of the reader. */
export interface Action {
  icon(): Icon;
  label(): string;
  /** @param opener the button, to which the focus returns */
  run(opener: HTMLElement): void;
  /** The key of the same action. */
  readonly key?: string;
  /** Returns whether it is on; absent if it cannot be on and off. */
  pressed?(): boolean;
  disabled?(): boolean;
  hidden?(): boolean;
}

export type ActionName =
  | "zoomIn"
  | "zoomOut"
  | "layout"
  | "shift"
  | "bookmark"
  | "fullscreen"
  | "play"
  | "readAloud"
  | "sound"
  | "tilt"
  | "foldOut"
  | "tearOut"
  | "crumple"
  | "tearAcross"
  | "putBack"
  | "print"
  | "download"
  | "keys";

/** Zoom factor of one press. */
const zoomStep = 1.5;
const maxZoom = 8;

/** Degrees by which the eye leans back that a reader chose to lean back. */
const leaning = 12;
const isTilted = (book: ControlledBook): boolean => Number(book.getAttribute("tilt") ?? 0) > 0;

/** The page of a new bookmark: the first visible one. */
const isMarked = (book: ControlledBook): boolean => book.bookmarks.includes(book.page);

/** Zooms by one step in or out, or (0) back to the whole book. */
export function zoomBy(book: ControlledBook, by: 1 | 0 | -1): void {
  book.zoomTo(by === 0 ? 1 : Math.min(Math.max(book.zoom * zoomStep ** by, 1), maxZoom));
}

/**
 * Returns all actions.
 *
 * @param print asks what is to be printed
 * @param help says what keys do
 */
export function actionsOf(
  book: ControlledBook,
  { texts }: Wording,
  print: () => void,
  help: () => void,
): Readonly<Record<ActionName, Action>> {
  const isFull = (): boolean => book.ownerDocument.fullscreenElement === book;
  return {
    zoomOut: {
      icon: () => "zoomOut",
      label: () => texts.zoomOut,
      key: "-",
      run: () => zoomBy(book, -1),
      disabled: () => book.zoom <= 1,
    },
    zoomIn: {
      icon: () => "zoomIn",
      label: () => texts.zoomIn,
      key: "+",
      run: () => zoomBy(book, 1),
      disabled: () => book.zoom >= maxZoom,
    },
    layout: {
      icon: () => (book.shownLayout === "single" ? "spread" : "single"),
      label: () => (book.shownLayout === "single" ? texts.spread : texts.single),
      run: () => book.setAttribute("layout", book.shownLayout === "single" ? "spread" : "single"),
      hidden: () => book.scrolled,
    },
    shift: {
      icon: () => "shift",
      label: () => texts.shift,
      key: "o",
      run: () => book.toggleShift(),
      pressed: () => book.shifts.includes(book.page),
      hidden: () => book.shownLayout === "single",
    },
    bookmark: {
      icon: () => "bookmark",
      label: () => (isMarked(book) ? texts.removeBookmark : texts.addBookmark),
      key: "b",
      run: () => book.toggleBookmark(),
      pressed: () => isMarked(book),
    },
    fullscreen: {
      icon: () => (isFull() ? "leaveFullscreen" : "fullscreen"),
      label: () => (isFull() ? texts.leaveFullscreen : texts.fullscreen),
      key: "f",
      run: () => void book.toggleFullscreen(),
      hidden: () => !book.ownerDocument.fullscreenEnabled,
    },
    play: {
      icon: () => (book.playing ? "pause" : "play"),
      label: () => (book.playing ? texts.pause : texts.play),
      run: () => (book.playing ? book.pause() : book.play()),
    },
    readAloud: {
      icon: () => (book.readingAloud ? "pause" : "readAloud"),
      label: () => (book.readingAloud ? texts.stopReadingAloud : texts.readAloud),
      run: () => (book.readingAloud ? book.stopReadingAloud() : void book.readAloud()),
      hidden: () => !book.canReadAloud,
    },
    sound: {
      icon: () => "sound",
      label: () => texts.sound,
      run: () => void book.toggleAttribute("sound"),
      pressed: () => book.hasAttribute("sound"),
    },
    tilt: {
      icon: () => "tilt",
      label: () => texts.tilt,
      run: () => book.setAttribute("tilt", String(isTilted(book) ? 0 : leaning)),
      pressed: () => isTilted(book),
      hidden: () => book.getAttribute("camera") === "overhead",
    },
    foldOut: {
      icon: () => "foldOut",
      label: () => (book.foldOut === "open" ? texts.foldIn : texts.unfold),
      key: "Enter",
      run: () => book.toggleFoldOut(),
      hidden: () => book.foldOut === "none",
    },
    tearOut: {
      icon: () => "tearOut",
      label: () => texts.tearOut,
      run: () => void book.tearOut(book.tearablePage ?? undefined),
      hidden: () => book.tearablePage === null,
    },
    crumple: {
      icon: () => "crumple",
      label: () => texts.crumple,
      run: () => book.crumple(),
      hidden: () => book.wholeSheet === null,
    },
    tearAcross: {
      icon: () => "tearOut",
      label: () => texts.tearAcross,
      run: () => book.tearAcross({ x: 0, y: 0.5 }, { x: 1, y: 0.5 }),
      hidden: () => book.wholeSheet !== "flat",
    },
    putBack: {
      icon: () => "putBack",
      label: () => texts.putBack,
      key: "Control+Z",
      run: () => void book.putBack(),
      hidden: () => book.tornLeaves === 0,
    },
    print: {
      icon: () => "print",
      label: () => texts.print,
      run: print,
      hidden: () => !book.allows.print,
    },
    download: {
      icon: () => "download",
      label: () => texts.download,
      run: () => void book.download(),
      hidden: () => !book.allows.download,
    },
    keys: {
      icon: () => "keys",
      label: () => texts.keys,
      key: "?",
      run: help,
      // A phone has none.
      hidden: () => !matchMedia("(any-pointer: fine)").matches,
    },
  };
}
