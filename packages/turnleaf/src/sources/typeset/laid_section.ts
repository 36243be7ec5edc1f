/** A section of a book as it is set into pages: what is drawn of it, and what stands where. */

import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import type { PageBox, PageColours, PageSize, TextRun, Typography } from "../page_source.ts";
import { orAborted } from "../shared_tasks.ts";
import { type FlowContent, mediumAttribute, mediumKindAttribute } from "./flow_book.ts";
import { drawingOf, type LayoutFrame, openFrame } from "./frame.ts";
import { type LaidParts, laySection, type SectionMap, spokenClass } from "./lay_section.ts";
import { writtenContent } from "./letter_forms.ts";
import type { Markup, PageMargins } from "./markup.ts";
import { isNoteLink, noteText } from "./notes.ts";
import { measuresOf } from "./page_measures.ts";
import { type PageFlow, pageOfRect, type TextMap } from "./text_map.ts";
import { type TitleFace, titleFaceIn } from "./title_font.ts";
import { spokenAttribute } from "./typography.ts";

/** A link as the book writes it, and its box on its page. */
export interface LaidLink extends PageBox {
  readonly href: string;
  readonly title: string;
  /** Whether it leads to a note. */
  readonly isNote: boolean;
}

/** A sound or a film as the book writes it, and its box on its page. */
export interface LaidMedium extends PageBox {
  readonly address: string;
  readonly kind: "audio" | "video";
  readonly title: string;
}

/** What is read aloud in a section now. */
export interface SpokenMark {
  /** The id of the element that is read. */
  readonly id: string;
  /** Its class, and that of the section's root; "" for none. */
  readonly activeClass: string;
  readonly playbackClass: string;
}

/** The text of an element of a section. */
export interface Passage {
  readonly text: string;
  /** The pages (from 0) on which it stands, and the fraction of it before each. */
  readonly pages: readonly { readonly page: number; readonly from: number }[];
}

/** A section set into pages, in a frame of its own. */
export class LaidSection {
  readonly map: SectionMap;
  /** The size of `svg()`. */
  readonly layoutSize: PageSize;
  readonly #frame: LayoutFrame;
  readonly #flow: PageFlow;
  readonly #text: TextMap;
  readonly #makeMarkup: () => Markup;
  readonly #fontRules: () => readonly string[];
  /** The section as it is drawn, with what is read aloud marked in it; made when it is first drawn. */
  #markup: Markup | null = null;
  readonly #html: HTMLElement;
  #spoken: SpokenMark | null = null;
  /** The page's own unit over the frame's CSS pixels. */
  readonly #scale: number;

  private constructor(frame: LayoutFrame, parts: LaidParts) {
    this.#frame = frame;
    this.map = parts.map;
    this.#flow = parts.flow;
    this.#text = parts.text;
    this.#makeMarkup = parts.markup;
    this.#fontRules = parts.fontRules;
    this.layoutSize = parts.layoutSize;
    this.#html = parts.html;
    this.#scale = this.map.size.width / this.layoutSize.width;
  }

  /**
   * Lays a section out. Rejects with any error of the browser, with an `OverspentError`, and with the
   * signal's reason, as soon as that aborts: its frame is gone then.
   *
   * @param isScrolled whether its pages hang together, so that a line may be cut
   * where one ends
   */
  static async lay(
    content: FlowContent,
    typography: Typography,
    isScrolled = false,
    signal?: AbortSignal,
  ): Promise<LaidSection> {
    const size = content.size ?? measuresOf(typography);
    const frame = await openFrame(size.width, size.height, signal);
    const abandon = (): void => frame.close();
    signal?.addEventListener("abort", abandon);
    try {
      const laying = laySection(frame, content, typography, isScrolled);
      return new LaidSection(frame, await (signal ? orAborted(laying, signal) : laying));
    } catch (error) {
      frame.close();
      throw error;
    } finally {
      signal?.removeEventListener("abort", abandon);
    }
  }

  /**
   * Returns a page as an SVG, in colours of the reader's if there are any.
   *
   * @param margins what stands in its margins
   */
  svg(page: number, margins: PageMargins, colours: PageColours | null): string {
    const { stepX, stepY } = this.#flow;
    this.#markup ??= this.#makeMarkup();
    return this.#markup.svg(page, { x: -page * stepX, y: -page * stepY }, margins, colours);
  }

  /** Returns the text of a page. */
  runs(page: number, exact: boolean): TextRun[] {
    return this.#text.runs(page, exact).map((run) => ({ ...run, ...this.#scaled(run) }));
  }

  /** Returns the links on a page. */
  links(page: number): LaidLink[] {
    const links: LaidLink[] = [];
    for (const link of this.#frame.root.querySelectorAll("a[href]")) {
      const href = link.getAttribute("href") ?? "";
      const title = cleanText(
        link.getAttribute("title") ?? writtenContent(link),
        limits.labelLength,
      );
      for (const rect of link.getClientRects()) {
        if (rect.width === 0 || rect.height === 0) continue;
        if (pageOfRect(this.#flow, rect) !== page) continue;
        if (links.length >= limits.annotations) return links;
        links.push({ ...this.#onPage(rect, page), href, title, isNote: isNoteLink(link) });
      }
    }
    return links;
  }

  /** Returns the sounds and films on a page. */
  media(page: number): LaidMedium[] {
    const media: LaidMedium[] = [];
    for (const element of this.#frame.root.querySelectorAll(`[${mediumAttribute}]`)) {
      const [rect] = element.getClientRects();
      if (!rect || rect.width === 0 || rect.height === 0) continue;
      if (pageOfRect(this.#flow, rect) !== page || media.length >= limits.annotations) continue;
      const address = element.getAttribute(mediumAttribute) ?? "";
      const name = element.getAttribute("title") || address.split("/").pop();
      media.push({
        ...this.#onPage(rect, page),
        address,
        kind: element.getAttribute(mediumKindAttribute) === "video" ? "video" : "audio",
        title: cleanText(name, limits.labelLength),
      });
    }
    return media;
  }

  /** Returns the text of the note that has an id; empty if there is none. */
  note(id: string): string {
    const target = id === "" ? null : this.#element(id);
    return target ? noteText(target) : "";
  }

  /** Returns the text of the element that has an id, and the pages on which it stands; null if there is none. */
  passage(id: string): Passage | null {
    const element = this.#element(id);
    if (element === null) return null;
    const text = cleanText(writtenContent(element), limits.passageLength);
    const { offset, length } = this.#text.extentOf(element);
    if (length === 0) return { text, pages: [{ page: this.map.ids.get(id) ?? 0, from: 0 }] };
    const first = this.#text.pageAt(offset);
    const count = this.#text.pageAt(offset + length - 1) - first + 1;
    const pages = Array.from({ length: count }, (_, k) => {
      const before = (this.map.starts[first + k] ?? offset) - offset;
      return { page: first + k, from: Math.max(before / length, 0) };
    });
    return { text, pages };
  }

  /** Returns the face of its first heading; null if the book chose none. */
  titleFace(): TitleFace | null {
    return titleFaceIn(this.#html, this.#fontRules);
  }

  /** Marks what is read aloud, in what is drawn from now on; null removes the mark. */
  mark(spoken: SpokenMark | null): void {
    if (spoken?.id === this.#spoken?.id) return;
    for (const [mark, isOn] of [
      [this.#spoken, false],
      [spoken, true],
    ] as const) {
      if (mark === null) continue;
      if (mark.playbackClass !== "") this.#html.classList.toggle(mark.playbackClass, isOn);
      const element = this.#element(mark.id);
      element?.classList.toggle(mark.activeClass || spokenClass, isOn);
      element?.toggleAttribute(spokenAttribute, isOn);
    }
    this.#spoken = spoken;
    this.#markup = null;
  }

  #element(id: string): Element | null {
    // Without an id it is all of the section.
    return id === "" ? this.#html : this.#html.querySelector(`[id="${CSS.escape(id)}"]`);
  }

  /** Returns what the pictures on a page show, in words. */
  alt(page: number): string {
    const said = [...this.#frame.root.querySelectorAll("img[alt], svg > title")]
      .filter((element) => {
        const [rect] = drawingOf(element, this.#html).getClientRects();
        return rect !== undefined && pageOfRect(this.#flow, rect) === page;
      })
      .map((element) => element.getAttribute("alt") ?? element.textContent);
    return cleanText(said.join(" "), limits.altLength);
  }

  close(): void {
    this.#frame.close();
  }

  #onPage(rect: DOMRect, page: number): PageBox {
    const { stepX, stepY } = this.#flow;
    const { width, height } = rect;
    return this.#scaled({ x: rect.left - page * stepX, y: rect.top - page * stepY, width, height });
  }

  #scaled({ x, y, width, height }: PageBox): PageBox {
    const scale = this.#scale;
    return { x: x * scale, y: y * scale, width: width * scale, height: height * scale };
  }
}
