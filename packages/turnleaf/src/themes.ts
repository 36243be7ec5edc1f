/** The colours of a book by day and by night: one choice for paper, text, edges and boards. */

/** The colours in which the reader wants pages. CSS colours of six digits. */
export interface PageColours {
  /** The colour of paper. */
  readonly paper: string;
  /** The colour of print. */
  readonly ink: string;
  /** The colour of links in text that is set for the reader. */
  readonly link: string;
  /** Whether the paper is darker than the print. */
  readonly isDark: boolean;
  /**
   * What is done on dark paper with pages that are no text which is set for the reader: lightness is
   * turned over and hues stay (`invert`), or they are dimmed (`dim`). By default documents are inverted,
   * and pictures dimmed.
   */
  readonly pictures: "" | "invert" | "dim";
}

/** The themes of a book, the usual one first. */
export const pageThemes = ["light", "sepia", "grey", "night"] as const;

/** A theme of a book. */
export type PageTheme = (typeof pageThemes)[number];

/** How a book looks in a theme. CSS colours of six digits. */
export interface ThemeLook {
  /** Paper that nothing is printed on, and print that stands in for a page. */
  readonly paper: string;
  readonly ink: string;
  /** Links in text that is set for the reader. By day they have the book's own colour. */
  readonly link: string;
  /** The edges of its leaves, as they are seen from the side. */
  readonly edges: string;
  /** How bright cloth and headbands are, 0 to 1 of what they are by day. */
  readonly cloth: number;
  /** Whether the paper is darker than the ink. */
  readonly isDark: boolean;
}

/** The look of each theme. Ink on paper, and a link too, has a contrast of at least 7 to 1. */
export const themeLooks: Readonly<Record<PageTheme, ThemeLook>> = {
  light: {
    paper: "#fbf5e8",
    ink: "#211d1a",
    link: "#0b4a7d",
    edges: "#efe4cf",
    cloth: 1,
    isDark: false,
  },
  sepia: {
    paper: "#f4ecd8",
    ink: "#3b2d1f",
    link: "#7a2c10",
    edges: "#e6d8b8",
    cloth: 0.92,
    isDark: false,
  },
  grey: {
    paper: "#3f3e3d",
    ink: "#e9e7e3",
    link: "#bfd8f5",
    edges: "#5a5855",
    cloth: 0.7,
    isDark: true,
  },
  night: {
    paper: "#1c1b1a",
    ink: "#c9c5bd",
    link: "#93bdec",
    edges: "#3a3734",
    cloth: 0.42,
    isDark: true,
  },
};

/**
 * Returns the colours in which pages are drawn; null for their own.
 *
 * @param pictures what dark themes do with what is drawn already, as `PageColours` has it
 */
export function coloursOf(theme: PageTheme, pictures: PageColours["pictures"]): PageColours | null {
  const { paper, ink, link, isDark } = themeLooks[theme];
  return theme === "light" ? null : { paper, ink, link, isDark, pictures };
}

/** Returns the look of a book's theme, `light` if it has none. */
export function lookOf({ theme = "light" }: { readonly theme?: PageTheme }): ThemeLook {
  return themeLooks[theme];
}
