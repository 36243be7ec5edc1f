/** The pages of a published book: pictures in several sizes, and text in parts. */

import {
  BookError,
  type OutlineEntry,
  type PageBox,
  type PageLink,
  type PageSize,
  type PageSource,
  type TextRun,
} from "turnleaf";
import {
  halved,
  halvings,
  pagesInPart,
  pictureAddress,
  type SiteBook,
  type SiteText,
} from "../../src/publish/site_book.ts";

/** What the page knows of its book. */
export interface BookData {
  readonly id: string;
  readonly title: string;
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  /** Part of the addresses of what is drawn anew with the book. */
  readonly version: string;
  /** Name of the book's own file; empty if there are pictures instead. */
  readonly file: string;
}

/** Pictures and parts of text kept. */
const keptPictures = 8;
const keptParts = 20;

const whole: PageBox = { x: 0, y: 0, width: 1, height: 1 };

/** A book as it lies in its folder of the site. */
export class PublishedSource implements PageSource {
  readonly title: string;
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly kind: "typeset" | "scan";
  readonly openingPage: number;
  readonly edge?: "left" | "right" | "top" | "bottom";
  readonly layout?: "spread" | "single";
  readonly details: SiteBook["details"];
  readonly allows: { readonly print: boolean; readonly copy: boolean };
  readonly #book: SiteBook;
  readonly #version: string;
  readonly #pictures = new Kept<Blob>(keptPictures);
  readonly #parts = new Kept<readonly SiteText[]>(keptParts);
  #closed = false;

  constructor(data: BookData, book: SiteBook) {
    this.title = data.title;
    this.language = data.language;
    this.direction = data.direction;
    this.kind = book.kind;
    this.openingPage = book.openingPage;
    if (book.edge) this.edge = book.edge;
    if (book.layout) this.layout = book.layout;
    this.details = book.details;
    this.allows = book.allows;
    this.#book = book;
    this.#version = data.version;
  }

  get pageCount(): number {
    return this.#book.pages.length;
  }

  async size(index: number): Promise<PageSize> {
    const { width, height } = this.#page(index);
    return { width, height };
  }

  inSpread(index: number): SiteBook["pages"][number]["side"] {
    return this.#book.pages[index]?.side;
  }

  roll(index: number): number | null {
    return this.#book.pages[index]?.roll ?? null;
  }

  label(index: number): string {
    return this.#book.pages[index]?.label ?? String(index + 1);
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region: PageBox = whole,
  ): Promise<ImageBitmap> {
    signal.throwIfAborted();
    const { pixels, failed } = this.#page(index);
    if (!pixels)
      throw new BookError(failed ?? `Page ${index + 1} of ${this.title} has no picture.`, {
        code: "damaged",
        page: index + 1,
        source: this.title,
      });
    const times = timesHalved(pixels, width / region.width);
    const [across, down] = halved(pixels, times);
    const address = `${pictureAddress(index, pixels, times, this.#book.format)}?v=${this.#version}`;
    const picture = await this.#pictures.get(address, () => this.#fetch(address));
    signal.throwIfAborted();
    const [x, y] = [Math.round(region.x * across), Math.round(region.y * down)];
    const part = [
      Math.max(1, Math.min(Math.round(region.width * across), across - x)),
      Math.max(1, Math.min(Math.round(region.height * down), down - y)),
    ] as const;
    const options: ImageBitmapOptions = {
      resizeWidth: Math.max(1, Math.min(Math.floor(width), part[0])),
      resizeQuality: "high",
    };
    const bitmap = await createImageBitmap(picture, x, y, ...part, options).catch(() => {
      throw this.#missing(index);
    });
    if (!signal.aborted && !this.#closed) return bitmap;
    bitmap.close();
    signal.throwIfAborted();
    throw new BookError(`${this.title} is closed; open it again.`, {
      code: "closed",
      source: this.title,
    });
  }

  async text(index: number): Promise<readonly TextRun[]> {
    const { runs } = await this.#text(index);
    return runs.map(([text, x, y, width, height, angle, flags]) => ({
      ...{ text, x, y, width, height, angle },
      end: (flags & 1) !== 0,
      ...(flags & 2 ? { vertical: true } : {}),
    }));
  }

  async links(index: number): Promise<readonly PageLink[]> {
    const { links } = await this.#text(index);
    return links.map(([x, y, width, height, to, title]) => ({
      ...{ x, y, width, height, title },
      to: typeof to === "number" ? { page: to } : { href: to },
    }));
  }

  async alt(index: number): Promise<string> {
    return (await this.#text(index)).alt;
  }

  async outline(): Promise<readonly OutlineEntry[]> {
    return this.#book.outline;
  }

  close(): void {
    this.#closed = true;
  }

  /** Returns the addresses of everything that reading the whole book needs. */
  addresses(): string[] {
    const parts = Math.ceil(this.pageCount / pagesInPart);
    return [
      ...Array.from({ length: parts }, (_, part) => this.#partAddress(part)),
      ...this.#book.pages.flatMap(({ pixels }, index) => {
        if (!pixels) return [];
        const sizes = Array.from({ length: halvings }, (_, times) => times);
        return sizes.map(
          (times) =>
            `${pictureAddress(index, pixels, times, this.#book.format)}?v=${this.#version}`,
        );
      }),
    ];
  }

  #page(index: number): SiteBook["pages"][number] {
    const page = this.#book.pages[index];
    if (page && !this.#closed) return page;
    throw new BookError(`${this.title} has no page ${index + 1} any more; open it again.`, {
      code: "noPage",
      source: this.title,
    });
  }

  async #text(index: number): Promise<SiteText> {
    const part = Math.floor(index / pagesInPart);
    const address = this.#partAddress(part);
    const texts = await this.#parts.get(address, async () =>
      JSON.parse(await (await this.#fetch(address)).text()),
    );
    return texts[index % pagesInPart] ?? { runs: [], links: [], alt: "" };
  }

  #partAddress(part: number): string {
    return `text/${part + 1}.json?v=${this.#version}`;
  }

  async #fetch(address: string): Promise<Blob> {
    const response = await fetch(address).catch(() => null);
    if (response?.ok) return await response.blob();
    throw new BookError(
      `A page of ${this.title} could not be loaded${response ? ` (status ${response.status})` : ""}; check the connection and turn back to it.`,
      response
        ? { code: "server", status: response.status, source: this.title }
        : { code: "unreachable", source: this.title },
    );
  }

  #missing(index: number): BookError {
    return new BookError(`Page ${index + 1} of ${this.title} is damaged on the server.`, {
      code: "damaged",
      page: index + 1,
      source: this.title,
    });
  }
}

/** Opens the book beside the page that shows it. */
export async function openPublished(data: BookData): Promise<PublishedSource> {
  const response = await fetch(`book.json?v=${data.version}`).catch(() => null);
  if (!response?.ok) {
    throw new BookError(
      `${data.title} could not be loaded; check the connection and load it again.`,
      { code: "unreachable", source: data.title },
    );
  }
  return new PublishedSource(data, (await response.json()) as SiteBook);
}

/** Returns how often the largest picture may be halved and still has `width` pixels. */
function timesHalved(pixels: readonly [number, number], width: number): number {
  for (let times = halvings; times > 0; times--) {
    if (halved(pixels, times)[0] >= width) return times;
  }
  return 0;
}

/** The results last asked for; what failed is asked for again. */
class Kept<Value> {
  readonly #most: number;
  readonly #values = new Map<string, Promise<Value>>();

  constructor(most: number) {
    this.#most = most;
  }

  async get(key: string, make: () => Promise<Value>): Promise<Value> {
    const value = this.#values.get(key) ?? make();
    this.#values.delete(key);
    this.#values.set(key, value);
    for (const oldest of this.#values.keys()) {
      if (this.#values.size <= this.#most) break;
      this.#values.delete(oldest);
    }
    try {
      return await value;
    } catch (error) {
      if (this.#values.get(key) === value) this.#values.delete(key);
      throw error;
    }
  }
}
