/** The texts of the element and its controls, in one language. */

/**
 * A text that depends on a number: one wording for each of the language's plural
 * forms that differ, `other` for the rest. `{n}` stands for the number.
 */
export type Plural = { readonly other: string } & Partial<
  Readonly<Record<Intl.LDMLPluralRule, string>>
>;

/** The element's own texts. Words in braces are placeholders. */
export interface ElementTexts {
  readonly opening: string;
  /** The element has no book. */
  readonly missing: string;
  /** Which pages lie open: `{pages}` are their labels, `{n}` is the number of pages in the book. */
  readonly pageOpen: string;
  readonly pagesOpen: string;
  /** The closed back: `{n}` is the number of pages in the book. */
  readonly back: string;
  readonly notOpened: string;
  /** A page by its label. */
  readonly pageNamed: string;
  /** A number of pages, `{n}`, that is an estimate. */
  readonly about: string;
  /** In place of a page, by its label, that takes long to draw. */
  readonly slowPage: string;
  /** Before a link is followed out of the book: to `{address}`. */
  readonly leaving: string;
  /** Follows that link. */
  readonly leave: string;
}

/** The texts of the controls. Words in braces are placeholders. */
export interface ControlTexts {
  readonly toolbar: string;
  readonly pages: string;
  readonly contents: string;
  readonly thumbnails: string;
  readonly search: string;
  readonly bookmarks: string;
  readonly close: string;
  readonly more: string;
  readonly next: string;
  readonly previous: string;
  readonly page: string;
  /** After the page field: `{n}` is the number of pages. */
  readonly of: string;
  /** After the page field if the label is not a number: `{page}` of `{n}`. */
  readonly pageOf: string;
  /** The slider's place: the page's label, its number, the number of pages. */
  readonly place: string;
  /** Turns back to the page, by its label, from which the reader has jumped. */
  readonly backTo: string;
  /** The same, to a page whose label is a name. */
  readonly backToNamed: string;
  readonly noSuchPage: string;
  readonly zoomIn: string;
  readonly zoomOut: string;
  readonly spread: string;
  readonly single: string;
  /** Other pages face each other from here on. */
  readonly shift: string;
  readonly addBookmark: string;
  readonly removeBookmark: string;
  readonly fullscreen: string;
  readonly leaveFullscreen: string;
  readonly print: string;
  readonly download: string;
  readonly play: string;
  readonly pause: string;
  readonly readAloud: string;
  readonly stopReadingAloud: string;
  readonly sound: string;
  readonly tilt: string;
  /** Opens the fold-out that lies open, and shuts it. */
  readonly unfold: string;
  readonly foldIn: string;
  /** Tears the leaf of the open page out. */
  readonly tearOut: string;
  /** Of the sheet that was torn out last: into a ball, in two pieces, back into the book. */
  readonly crumple: string;
  readonly tearAcross: string;
  readonly putBack: string;
  readonly theme: string;
  readonly themeAuto: string;
  readonly themeLight: string;
  readonly type: string;
  readonly typeSize: string;
  readonly typeface: string;
  /** Sets it one step smaller, and larger. */
  readonly smallerType: string;
  readonly largerType: string;
  readonly lineHeight: string;
  readonly margins: string;
  /** Less and more of a choice, whose name is `{name}`. */
  readonly lessOf: string;
  readonly moreOf: string;
  /** Whether lines are of one length, and whether words are divided. */
  readonly alignment: string;
  readonly justified: string;
  readonly ragged: string;
  readonly hyphens: string;
  readonly on: string;
  readonly off: string;
  readonly letterSpacing: string;
  readonly wordSpacing: string;
  /** Some words to be set as the reader chooses. */
  readonly typeSample: string;
  /** The choice of what the book itself says. */
  readonly asInBook: string;
  /** The same in few letters. */
  readonly booksOwn: string;
  readonly serif: string;
  readonly sansSerif: string;
  readonly sepia: string;
  readonly grey: string;
  readonly night: string;
  /** Over the choice of what dark themes do with pages that are drawn already. */
  readonly darkPages: string;
  readonly inverted: string;
  readonly dimmed: string;
  readonly noContents: string;
  /** Over a list of what cannot be shown of the book. */
  readonly notShown: Plural;
  readonly noBookmarks: string;
  readonly searchHint: string;
  readonly searching: string;
  readonly found: Plural;
  readonly nothingFound: string;
  /** Nothing was found in a book that has no text. */
  readonly noText: string;
  readonly from: string;
  readonly to: string;
  readonly allPages: string;
  readonly cancel: string;
  /** The help that says what keys do. */
  readonly keys: string;
  readonly firstPage: string;
  readonly lastPage: string;
  /** Ends a zoom. */
  readonly wholePage: string;
  /** What is written on keys. */
  readonly keySpace: string;
  readonly keyHome: string;
  readonly keyEnd: string;
  /** Maximum of pages that are printed at once. */
  readonly mostPrinted: Plural;
  readonly password: string;
  readonly passwordNeeded: string;
  readonly wrongPassword: string;
  /** Opens a protected file. */
  readonly open: string;
  readonly drawing: string;
  readonly wait: string;
}

/**
 * What the element says of a `BookError` in other languages than English, by its `code`; the
 * error's own `message` is English and says more. `{source}` is the book, file or address, and
 * `{status}` what its server responded.
 */
export interface ErrorTexts {
  /** Its server has nothing at the address. */
  readonly absent: string;
  /** The browser did not start a script that it needs, or draws nothing of it. */
  readonly blocked: string;
  /** It was closed before. */
  readonly closed: string;
  /** Its shop protects it against copying. */
  readonly copyProtected: string;
  /** It is damaged, or another kind of file than it seems. */
  readonly damaged: string;
  /** Nothing is in it. */
  readonly empty: string;
  /** Unforeseen: `{detail}` is the English sentence. */
  readonly failed: string;
  /** Its server does not let it be read. */
  readonly forbidden: string;
  /** A chosen file is no longer there. */
  readonly gone: string;
  /** A password protects it. */
  readonly locked: string;
  /** Something was given that cannot be used: `{detail}` is the English sentence. */
  readonly misused: string;
  /** It has no such page. */
  readonly noPage: string;
  /** A part of the viewer could not be loaded. */
  readonly partMissing: string;
  /** Its server failed otherwise. */
  readonly server: string;
  /** It cannot be read aloud. */
  readonly silent: string;
  /** It is larger, or has more in it, than can be shown. */
  readonly tooLarge: string;
  /** Its server cannot be reached, or does not let this page read it. */
  readonly unreachable: string;
  /** Its format cannot be read. */
  readonly unsupported: string;
  /** In place of `{source}` if that is unknown. */
  readonly thisBook: string;
  /** Around a sentence about one page: `{page}` is its number, `{sentence}` the sentence. */
  readonly onPage: string;
}

/**
 * What the element says of a `BookWarning` in other languages than English, by its `code`; the
 * warning's own `message` is English. `{source}` is the file, address, name or title.
 */
export interface WarningTexts {
  /** A mark on a page, or a list of such, is not there. */
  readonly annotation: string;
  /** A chapter. */
  readonly chapter: string;
  /** A line of the contents leads nowhere in the book. */
  readonly contents: string;
  /** What is embedded in a page from elsewhere. */
  readonly embedded: string;
  /** A font: its text is set in another. */
  readonly font: string;
  /** An image. */
  readonly image: string;
  /** A link on a page leads nowhere in the book. */
  readonly link: string;
  /** A sound or a film. */
  readonly medium: string;
  /** A note is not there, or has no text. */
  readonly note: string;
  /** A file that is no page. */
  readonly page: string;
  /** A style sheet. */
  readonly style: string;
}

/** Every text, so that a language is added whole. */
export type Texts = ElementTexts &
  ControlTexts & { readonly errors: ErrorTexts; readonly warnings: WarningTexts };
