/** The reader's controls around a book: toolbar, side panel, slider, keys. */

import { addStyle } from "../element/shadow_tree.ts";
import { typographyAttributes, typographyOf } from "../element/typography.ts";
import { languageOf, loadLanguage } from "../words/languages.ts";
import { actionsOf, type Tab, zoomBy } from "./actions.ts";
import { Bar } from "./bar.ts";
import { watchTaps } from "./bare_page.ts";
import type { ControlledBook, FoundPlace } from "./book.ts";
import { BookmarksTab } from "./bookmarks_tab.ts";
import { ContentsTab } from "./contents_tab.ts";
import { panelWidth, style } from "./controls.css.ts";
import { watchFullScreen } from "./full_screen.ts";
import { listenToKeys } from "./keys.ts";
import { showKeys } from "./keys_dialog.ts";
import { PagesBar } from "./pages_bar.ts";
import { Panel } from "./panel.ts";
import { askPrint } from "./print_dialog.ts";
import { SearchTab } from "./search_tab.ts";
import { themes } from "./themes.css.ts";
import { ThumbnailsTab } from "./thumbnails_tab.ts";
import { TypeTab } from "./type_tab.ts";
import { wordingFor } from "./wording.ts";

export { askPassword } from "./password_dialog.ts";

/** Attributes of the element that change what the controls show. */
const watched = ["lang", "dir", "sound", "theme", "dark-pages", "layout", ...typographyAttributes];

/** The book's events that change what the controls show. */
const heard = [
  "pagechange",
  "zoomchange",
  "layoutchange",
  "bookmarkchange",
  "shiftchange",
  "playchange",
  "readaloudchange",
  "warnings",
];

/** Width in CSS pixels below which the panel covers the book. */
const narrow = 720;

/**
 * How small the book may become beside the panel, as a fraction of its size without that. Where it would be
 * smaller, the panel lies over it and closes when something is picked in it.
 */
const leastBeside = 0.75;

/**
 * Adds controls around a book.
 *
 * @param frame holds the stage; the controls go before and after it
 * @returns a function that removes them, with every listener
 */
export function addControls<Hit extends FoundPlace>(
  book: ControlledBook<Hit>,
  frame: HTMLElement,
  stage: HTMLElement,
): () => void {
  const root = frame.getRootNode() as ShadowRoot;
  const removeStyle = addStyle(root, themes + style);
  let remove = build(book, frame, stage);
  const language = (): string => `${languageOf(book)} ${getComputedStyle(book).direction}`;
  let spoken = language();
  let isRemoved = false;
  // Another language changes every text.
  const observer = new MutationObserver(() => {
    if (language() === spoken) return;
    const asked = language();
    spoken = asked;
    void loadLanguage(languageOf(book)).then(() => {
      if (isRemoved || spoken !== asked) return;
      remove();
      remove = build(book, frame, stage);
    });
  });
  observer.observe(book, { attributeFilter: ["lang", "dir"] });
  return () => {
    isRemoved = true;
    observer.disconnect();
    remove();
    removeStyle();
  };
}

function build<Hit extends FoundPlace>(
  book: ControlledBook<Hit>,
  frame: HTMLElement,
  stage: HTMLElement,
): () => void {
  const wording = wordingFor(languageOf(book));
  const ended = new AbortController();
  const { signal } = ended;
  const isNarrow = (): boolean => frame.clientWidth < narrow;

  /** Whether the panel was opened by the keyboard at a button of the toolbar. */
  let isOpenedByKey = false;
  const hasFocus = (part: HTMLElement): boolean =>
    part.contains((frame.getRootNode() as ShadowRoot).activeElement);

  const close = (): void => {
    const { tab } = panel;
    if (tab === null) return;
    const hadFocus = hasFocus(panel.element);
    panel.close();
    // Back to where the reader was: a reader who goes by keys at the button, others in the book.
    const opener = isOpenedByKey ? bar.buttonOf(tab) : undefined;
    if (hadFocus) (opener ?? book).focus({ preventScroll: true });
  };
  const picked = (): void => {
    if (frame.classList.contains("shared")) return;
    panel.close();
    book.focus({ preventScroll: true });
    restBars();
  };
  const open = (tab: Tab, opener: HTMLElement | null): void => {
    isOpenedByKey = opener?.matches(":focus-visible") ?? false;
    panel.open(tab);
    panel.focus();
  };
  const toggle = (tab: Tab, opener: HTMLElement): void => {
    if (panel.tab === tab) close();
    else open(tab, opener);
  };

  const views = {
    contents: new ContentsTab(book, wording, picked),
    thumbnails: new ThumbnailsTab(book, wording, picked),
    search: new SearchTab(book, wording, picked),
    bookmarks: new BookmarksTab(book, wording, picked),
    type: new TypeTab(book, wording),
  };
  const stepType = (by: 1 | -1): void => {
    if (!book.canTypeset) return;
    views.type.stepSize(by);
    book.announce(
      `${wording.texts.typeSize}: ${wording.number(Math.round(100 * typographyOf(book).size))} %`,
    );
  };
  const print = (): void => askPrint(book, wording, frame);
  const help = (): void => showKeys(book, wording, frame);
  const actions = actionsOf(book, wording, print, help);
  const bar = new Bar(book, wording, actions, toggle);
  const pages = new PagesBar(book, wording);
  /** Moves the book aside for the open panel where it stays large enough. */
  const placePanel = (): void => {
    const isShared =
      panel.tab !== null && !isNarrow() && book.fractionBeside(panelWidth) >= leastBeside;
    frame.classList.toggle("shared", isShared);
  };
  const panel = new Panel(wording, views, close, (tab) => {
    bar.showTab(tab);
    frame.classList.toggle("open", tab !== null);
    placePanel();
  });
  const sizes = new ResizeObserver(placePanel);
  sizes.observe(frame);
  frame.prepend(bar.element, panel.element);
  stage.after(pages.element);

  const refresh = (): void => {
    bar.refresh();
    pages.refresh();
    panel.allow("type", book.canTypeset);
    panel.refresh();
  };
  for (const name of heard) book.addEventListener(name, refresh, { signal });
  const opened = (): void => {
    views.contents.forget();
    views.thumbnails.forget();
    views.search.forget();
    refresh();
  };
  const renumbered = (): void => {
    views.contents.renew();
    views.thumbnails.forget();
    views.search.renew();
    refresh();
  };
  book.addEventListener("load", opened, { signal });
  for (const name of ["load", "layoutchange"]) book.addEventListener(name, placePanel, { signal });
  book.addEventListener("pageschange", renumbered, { signal });
  const observer = new MutationObserver((records) => {
    // Pages have other colours.
    if (records.some(({ attributeName }) => /^(theme|dark-pages)$/.test(attributeName ?? ""))) {
      views.thumbnails.forget();
    }
    refresh();
  });
  observer.observe(book, { attributeFilter: watched });
  watchFullScreen(book, frame, refresh, signal);
  const restBars = watchTaps(book, frame, stage, signal);
  listenToKeys(
    book,
    {
      search: () => open("search", null),
      escape: () => {
        const wasOpen = panel.tab !== null;
        close();
        const isBeside = hasFocus(bar.element) || hasFocus(pages.element);
        if (!wasOpen && isBeside) book.focus({ preventScroll: true });
        return wasOpen;
      },
      zoom: (by) => {
        zoomBy(book, by);
        book.announceZoom();
      },
      help,
      type: stepType,
      print: () => {
        if (!book.allows.print) return false;
        print();
        return true;
      },
      bookmark: () => {
        book.toggleBookmark();
        const { texts, list } = wording;
        const labels = list(book.bookmarks.map((page) => book.label(page)));
        book.announce(labels === "" ? texts.noBookmarks : `${texts.bookmarks}: ${labels}`);
      },
    },
    signal,
  );
  // Who presses a button by a pointer reads on by keys: the next one is for the book, not the button again.
  const leaveButtons = (event: MouseEvent): void => {
    const button = (event.target as Element).closest("button, a");
    if (!button || button.closest(".menu") || !button.closest(".bar, .pages, .panel")) return;
    event.preventDefault();
    // The menu takes the focus, and would close without it.
    if (!button.hasAttribute("aria-haspopup")) book.focus({ preventScroll: true });
  };
  frame.addEventListener("mousedown", leaveButtons, { signal });
  refresh();

  return () => {
    ended.abort();
    observer.disconnect();
    sizes.disconnect();
    if (panel.tab !== null) panel.close();
    views.search.forget();
    for (const part of [bar, pages, panel]) part.element.remove();
  };
}
