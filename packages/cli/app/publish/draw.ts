/** The page in which `turnleaf publish` opens a book and draws its pages. */

import {
  openSource,
  type PageLink,
  type PagePicture,
  type PageSource,
  type TextRun,
} from "turnleaf";
import type {
  DrawnPage,
  DrawOptions,
  OpenedBook,
  UnshownPart,
} from "../../src/publish/drawn_page.ts";
import { halved, halvings, type SiteLink, type SiteRun } from "../../src/publish/site_book.ts";

/** The command's configuration. */
interface Config {
  readonly src: string;
  readonly name: string;
}

class Drawing {
  #source: PageSource | null = null;

  /** Opens the book. A failure is a sentence. */
  async open(config: Config): Promise<OpenedBook | { readonly failed: string }> {
    try {
      const source = await openSource(new URL(config.src, location.href).href, {
        name: config.name,
      });
      this.#source = source;
      await source.settle?.();
      const { title, language, direction, kind, pageCount, openingPage = 1 } = source;
      const { edge, layout, details = [] } = source;
      return {
        ...{ title, language, direction, kind, pageCount, openingPage, details },
        ...(edge ? { edge } : {}),
        ...(layout ? { layout } : {}),
        allows: source.allows ?? { print: true, copy: true },
        outline: (await source.outline?.(signal())) ?? [],
      };
    } catch (error) {
      return { failed: sentenceOf(error) };
    }
  }

  /** Returns what the book lists and cannot be shown, besides pages: these say so themselves. */
  warnings(): UnshownPart[] {
    return (this.#source?.warnings ?? [])
      .filter(({ code }) => code !== "page" && code !== "chapter")
      .map(({ message, page }) => ({ message, ...(page === undefined ? {} : { page }) }));
  }

  /** Draws page `index` (from 0) and reads its text. A failure is a sentence. */
  async page(index: number, options: DrawOptions): Promise<DrawnPage> {
    const source = this.#source;
    if (!source) throw new Error("No book is open.");
    const size = await source.size(index).catch(() => ({ width: 3, height: 4 }));
    const label = source.label(index);
    const mayCopy = source.allows?.copy !== false;
    const side = source.inSpread?.(index);
    const roll = source.roll?.(index) ?? null;
    const where = { label, ...(side ? { side } : {}), ...(roll === null ? {} : { roll }) };
    const page = { ...where, pictures: [] as DrawnPage["pictures"], runs: [] as SiteRun[] };
    try {
      if (options.pictures) {
        const longer = Math.max(size.width, size.height);
        const width = Math.max(1, Math.round((options.longest * size.width) / longer));
        const drawn = await source.draw(index, width, signal());
        page.pictures = await encode(drawn, options);
      }
      const [runs, links, alt] = await Promise.all([
        mayCopy ? source.text?.(index, signal()) : [],
        source.links?.(index, signal()),
        source.alt?.(index, signal()),
      ]);
      page.runs = (runs ?? []).map(packRun);
      // Known exactly once the page has been drawn.
      const { width, height } = await source.size(index);
      return {
        ...page,
        ...{ width: rounded(width), height: rounded(height) },
        links: (links ?? []).map(packLink),
        alt: alt ?? "",
      };
    } catch (error) {
      const failed = sentenceOf(error);
      return { ...page, ...size, pictures: [], links: [], alt: "", failed };
    }
  }
}

/** Nothing is ever aborted here: the command ends the browser. */
function signal(): AbortSignal {
  return new AbortController().signal;
}

function sentenceOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** Returns a picture in all its sizes as base64; each is half as large as the one before. */
async function encode(
  drawn: PagePicture,
  { format, quality }: DrawOptions,
): Promise<DrawnPage["pictures"]> {
  const full: [number, number] = [drawn.width, drawn.height];
  const pictures: { width: number; height: number; data: string }[] = [];
  let last: PagePicture | OffscreenCanvas = drawn;
  for (let times = 0; times <= halvings; times++) {
    const [width, height] = halved(full, times);
    const canvas = new OffscreenCanvas(width, height);
    // In software, whose pixels are the same on every machine.
    const context = canvas.getContext("2d", { alpha: false, willReadFrequently: true });
    if (!context) throw new Error("The browser has no memory left for a picture.");
    context.fillStyle = "#fff";
    context.fillRect(0, 0, width, height);
    context.imageSmoothingQuality = "high";
    context.drawImage(last, 0, 0, width, height);
    if (times === 0 && "close" in drawn) drawn.close();
    last = canvas;
    const blob = await canvas.convertToBlob({ type: `image/${format}`, quality: quality / 100 });
    pictures.push({ width, height, data: base64(new Uint8Array(await blob.arrayBuffer())) });
  }
  return pictures;
}

function base64(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 0x8000) {
    text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  }
  return btoa(text);
}

function packRun({ text, x, y, width, height, angle, end, vertical }: TextRun): SiteRun {
  const flags = (end ? 1 : 0) + (vertical ? 2 : 0);
  const box = [rounded(x), rounded(y), rounded(width), rounded(height)] as const;
  return [text, ...box, rounded(angle, 1e4), flags];
}

function packLink({ x, y, width, height, to, title }: PageLink): SiteLink {
  const box = [rounded(x), rounded(y), rounded(width), rounded(height)] as const;
  return [...box, "page" in to ? to.page : to.href, title];
}

function rounded(value: number, by = 100): number {
  return Math.round(value * by) / by;
}

Object.assign(globalThis, { drawing: new Drawing() });
