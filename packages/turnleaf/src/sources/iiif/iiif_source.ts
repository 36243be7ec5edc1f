/** Books by IIIF: pages whose images a server sends in the size that is wanted. */

import { closedError } from "../failures.ts";
import { fetchChecked, readBounded } from "../fetch_bytes.ts";
import { claimedSize } from "../image_header.ts";
import { fitPixels, limits, wholePage } from "../limits.ts";
import {
  type BookDetail,
  BookError,
  type BookWarning,
  type OutlineEntry,
  type PageBox,
  type PageLink,
  type PagePicture,
  type PageSize,
  type PageSource,
  type TextRun,
} from "../page_source.ts";
import { SharedTasks } from "../shared_tasks.ts";
import { showableImage } from "../showable_image.ts";
import { lostLines, WarningList, warningOf } from "../warnings.ts";
import { annotationsIn, farText, farTexts, linksOn, textOn } from "./annotations.ts";
import { type ImageInfo, parseInfo, partsFor, sharpestWidth } from "./image_service.ts";
import {
  type CanvasPage,
  elsewhere,
  type PaintedImage,
  type PresentedBook,
  parsePresentation,
  wholeCanvas,
} from "./presentation.ts";
import { addressOf, idOf, type Value } from "./values.ts";

/** Images kept as they came, and requests of one page under way at a time. */
const keptImages = 40;
const atOnce = 6;

/** Pages of annotations that follow each other, of which each may hold some thousand. */
const mostLists = 20;

const never = new AbortController().signal;

/**
 * Returns the book that a manifest of IIIF describes. Throws a `BookError` if
 * there is none in it.
 *
 * @param base the manifest's absolute address
 * @param name its name in sentences
 */
export function openIiif(value: Value, base: string, name: string): PageSource {
  const languages = globalThis.navigator?.languages ?? [];
  return new IiifSource(parsePresentation(value, base, name, languages));
}

class IiifSource implements PageSource {
  readonly title: string;
  readonly language = "";
  readonly direction: "ltr" | "rtl";
  readonly edge?: "top" | "bottom";
  readonly layout?: "single";
  readonly openingPage?: number;
  readonly details: readonly BookDetail[];
  readonly kind = "scan";
  readonly pageCount: number;
  readonly #book: PresentedBook;
  /** Its pages, as far as they are read. */
  readonly #pages: CanvasPage[];
  readonly #warnings = new WarningList();
  readonly #infos = new Map<string, ImageInfo>();
  readonly #images = new Map<string, Blob>();
  readonly #fetching = new SharedTasks<string, Blob>();
  #closed = false;

  constructor(book: PresentedBook) {
    const { title, direction, edge, layout, openingPage, details, pages } = book;
    Object.assign(this, { edge, layout, openingPage });
    this.title = title;
    this.direction = direction;
    this.details = details;
    this.pageCount = pages.length;
    this.#book = book;
    this.#pages = [...pages];
    this.#warnings.add(
      ...lostLines(book.outline, book.name),
      ...book.warnings,
      ...pages.flatMap(this.#othersOn),
    );
  }

  get warnings(): readonly BookWarning[] {
    return this.#warnings.all;
  }

  watchWarnings(listener: () => void): void {
    this.#warnings.watch(listener);
  }

  async size(index: number, signal: AbortSignal = never): Promise<PageSize> {
    // A page whose parts cannot be had says so where it is drawn.
    const page = await this.#whole(index, signal).catch(() => this.#page(index));
    signal.throwIfAborted();
    const { width, height } = page.part;
    return { width, height };
  }

  widthInMetres({ width }: PageSize): number | undefined {
    const { metres } = this.#book;
    return metres && width * metres;
  }

  label(index: number): string {
    return this.#book.pages[index]?.label ?? String(index + 1);
  }

  inSpread(index: number): CanvasPage["inSpread"] {
    return this.#book.pages[index]?.inSpread;
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region: PageBox = wholePage,
  ): Promise<PagePicture> {
    signal.throwIfAborted();
    const page = await this.#whole(index, signal);
    const { part, images: painted, others } = page;
    const [other] = others;
    if (painted.length === 0 && other !== undefined) {
      throw new BookError(
        `${this.#place(index)} has no image but what cannot be shown on paper (${other}); turn to another.`,
        { code: "unsupported", page: index + 1, source: this.#book.name },
      );
    }
    const box = {
      x: part.x + region.x * part.width,
      y: part.y + region.y * part.height,
      width: region.width * part.width,
      height: region.height * part.height,
    };
    const images = await Promise.all(painted.map((image) => this.#measured(index, image, signal)));
    const sharpest = Math.max(...images.map(({ density }) => density * box.width), 1);
    const pixels = fitPixels(box, images.length > 0 ? Math.min(width, sharpest) : width);
    const canvas = new OffscreenCanvas(pixels.width, pixels.height);
    const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, pixels.width, pixels.height);
    pen.imageSmoothingQuality = "high";
    for (const image of images) await this.#paint(pen, index, image, box, signal);
    this.#check(index, signal);
    return canvas.transferToImageBitmap();
  }

  async text(index: number, signal: AbortSignal): Promise<readonly TextRun[]> {
    signal.throwIfAborted();
    const page = await this.#whole(index, signal);
    const lists = await this.#lists(index, page, signal);
    const texts = { items: [] as Value[] };
    for (const annotation of farTexts(lists).slice(0, mostLists)) {
      const body = await this.#farText(index, annotation, signal);
      if (body !== null) texts.items.push({ ...annotation, body });
    }
    return textOn(page, [...lists, texts]);
  }

  async links(index: number, signal: AbortSignal): Promise<readonly PageLink[]> {
    signal.throwIfAborted();
    const page = await this.#whole(index, signal);
    const lists = await this.#lists(index, page, signal);
    const { numbers, base, name } = this.#book;
    const { links, aboutAll } = linksOn(page, lists, index + 1, numbers, base);
    this.#warnings.add(
      ...aboutAll.map((text) => ({ ...warningOf("annotation", text, name), page: index + 1 })),
    );
    return links;
  }

  async outline(): Promise<readonly OutlineEntry[]> {
    return this.#book.outline;
  }

  close(): void {
    this.#closed = true;
    this.#images.clear();
    this.#infos.clear();
    this.#fetching.abortAll(closedError(this.#book.name));
  }

  /** Returns a page once all that is painted on it is known, and its size. Rejects as `draw` does. */
  async #whole(index: number, signal: AbortSignal): Promise<CanvasPage> {
    const page = this.#page(index);
    const { unread } = page;
    if (!unread) return page;
    const { canvas, half, read } = unread;
    const fetched = new Map<string, Value>();
    for (const part of elsewhere(canvas)) {
      const url = addressOf(part, this.#book.base);
      if (url === "") continue;
      const blob = await this.#fetch(index, url, limits.manifestBytes, signal);
      fetched.set(idOf(part), Object(jsonIn(await blob.text())) as Value);
    }
    let now = read(wholeCanvas(canvas, fetched))[half] ?? page;
    const [image] = now.images;
    if (now.unread && image) {
      const { pixels } = await this.#sizeOf(index, image, signal);
      const size = image.crop ?? pixels;
      const upright = image.turns % 2 === 0 ? size : { width: size.height, height: size.width };
      now = read(wholeCanvas(canvas, fetched, upright))[half] ?? now;
    }
    const { unread: _, ...whole } = now;
    this.#check(index, signal);
    this.#pages[index] = whole;
    this.#warnings.add(...this.#othersOn(whole, index));
    return whole;
  }

  /** Returns warnings of what is painted on a page beside its images. */
  readonly #othersOn = ({ images, others, choices }: CanvasPage, index: number): BookWarning[] => {
    const [page, source] = [index + 1, this.label(index)];
    const message = `${this.#place(index)} has ${choices} more of its images to choose from, which are not shown.`;
    const unchosen: BookWarning[] = [{ code: "embedded", message, source, page }];
    return [
      ...others.map((other) => {
        const code = images.length === 0 ? "page" : "embedded";
        return { ...warningOf(code, `${source} (${other})`, this.#book.name), page };
      }),
      ...(choices > 0 ? unchosen : []),
    ];
  };

  #page(index: number): CanvasPage {
    const page = this.#pages[index];
    if (this.#closed || !page) {
      throw new BookError(`${this.#book.name} has no page ${index + 1} any more; open it again.`, {
        code: "noPage",
        source: this.#book.name,
      });
    }
    return page;
  }

  #check(index: number, signal: AbortSignal): void {
    signal.throwIfAborted();
    this.#page(index);
  }

  #place(index: number): string {
    return `Page ${index + 1} of ${this.#book.name}`;
  }

  /** Returns an image with its size, and how many of its pixels there are for a unit of the canvas. */
  async #measured(index: number, image: PaintedImage, signal: AbortSignal): Promise<MeasuredImage> {
    const { info, pixels } = await this.#sizeOf(index, image, signal);
    const crop = within(image.crop, pixels);
    const sharpest = info ? sharpestWidth(info) / info.width : 1;
    return { ...image, info, crop, density: (sharpest * crop.width) / upright(image).width };
  }

  /** Returns an image's own size, and what its service says of it, if it has one. */
  async #sizeOf(
    index: number,
    image: PaintedImage,
    signal: AbortSignal,
  ): Promise<{ readonly info: ImageInfo | null; readonly pixels: PageSize }> {
    const info = image.service ? await this.#info(index, image, signal) : null;
    if (info) return { info, pixels: info };
    return { info, pixels: await this.#pixels(index, await this.#image(index, image.src, signal)) };
  }

  /** Returns what a service says of its image; null if the image is shown without it. */
  async #info(index: number, image: PaintedImage, signal: AbortSignal): Promise<ImageInfo | null> {
    const { service } = image;
    const known = this.#infos.get(service);
    if (known) return known;
    try {
      const blob = await this.#fetch(index, `${service}/info.json`, limits.manifestBytes, signal);
      const info = parseInfo(jsonIn(await blob.text()), service);
      if (info) this.#infos.set(service, info);
      if (info || image.src) return info;
    } catch (error) {
      signal.throwIfAborted();
      if (!image.src) throw error;
      return null;
    }
    throw new BookError(`${this.#place(index)} is described by no image; try again later.`, {
      code: "empty",
      page: index + 1,
      source: this.#book.name,
    });
  }

  async #paint(
    pen: OffscreenCanvasRenderingContext2D,
    index: number,
    image: MeasuredImage,
    page: PageBox,
    signal: AbortSignal,
  ): Promise<void> {
    const { info, crop, turns } = image;
    // As seen before the image is turned: it is drawn upright by a turned pen.
    const [on, box] = [upright(image), turnedBack(page, image)];
    const { width, height } = pen.canvas;
    const picture = turns % 2 === 1 ? { width: height, height: width } : { width, height };
    const scale = picture.width / box.width;
    // Pixels of the image for a unit of the canvas.
    const [across, down] = [crop.width / on.width, crop.height / on.height];
    const seen = overlap(box, on);
    if (seen === null) return;
    const wanted = {
      x: crop.x + (seen.x - on.x) * across,
      y: crop.y + (seen.y - on.y) * down,
      width: seen.width * across,
      height: seen.height * down,
    };
    const all = { x: 0, y: 0, width: info?.width ?? 0, height: info?.height ?? 0 };
    const parts = info ? partsFor(info, wanted, scale / across) : [{ url: image.src, box: all }];
    pen.save();
    pen.transform(...turningOf(turns, pen.canvas));
    pen.beginPath();
    pen.rect(...inPixels(seen, box, picture));
    pen.clip();
    const waiting = parts.values();
    const work = async (): Promise<void> => {
      for (const part of waiting) {
        const blob = await this.#image(index, part.url, signal);
        await this.#pixels(index, blob);
        const bitmap = await this.#decoded(index, blob);
        const from = info ? part.box : { x: 0, y: 0, width: bitmap.width, height: bitmap.height };
        const to = {
          x: on.x + (from.x - crop.x) / across,
          y: on.y + (from.y - crop.y) / down,
          width: from.width / across,
          height: from.height / down,
        };
        pen.drawImage(bitmap, ...inPixels(to, box, picture));
        bitmap.close();
      }
    };
    await Promise.all(Array.from({ length: atOnce }, work));
    pen.restore();
  }

  /** Returns an image's size in pixels. Rejects if it has too many to be decoded. */
  async #pixels(index: number, image: Blob): Promise<PageSize> {
    const isBounded = ({ width, height }: PageSize): boolean =>
      width * height <= limits.imagePixels;
    const claimed = await claimedSize(image);
    const { width, height } =
      claimed && (claimed.isShown || !isBounded(claimed))
        ? claimed
        : await this.#decodedSize(index, image);
    if (isBounded({ width, height })) return { width, height };
    throw new BookError(
      `${this.#place(index)} has ${width} x ${height} pixels, more than can be shown; try another copy of the book.`,
      { code: "tooLarge", page: index + 1, source: this.#book.name },
    );
  }

  async #decodedSize(index: number, image: Blob): Promise<PageSize> {
    const bitmap = await this.#decoded(index, image);
    const { width, height } = bitmap;
    bitmap.close();
    return { width, height };
  }

  /** Decodes an image of a page. Rejects with a `BookError` if it is none. */
  async #decoded(index: number, image: Blob): Promise<ImageBitmap> {
    return await createImageBitmap(image).catch(() => {
      throw new BookError(`${this.#place(index)} is damaged or no image; try again later.`, {
        code: "damaged",
        page: index + 1,
        source: this.#book.name,
      });
    });
  }

  async #image(index: number, url: string, signal: AbortSignal): Promise<Blob> {
    const kept = this.#images.get(url);
    this.#images.delete(url);
    const about = { page: index + 1, source: this.#book.name };
    const image =
      kept ??
      (await showableImage(
        await this.#fetch(index, url, limits.imageBytes, signal),
        this.#place(index),
        about,
      ));
    this.#check(index, signal);
    this.#images.set(url, image);
    for (const oldest of this.#images.keys()) {
      if (this.#images.size <= keptImages) break;
      this.#images.delete(oldest);
    }
    return image;
  }

  #fetch(index: number, url: string, most: number, signal: AbortSignal): Promise<Blob> {
    return this.#fetching.run(
      url,
      async (own) => {
        const place = this.#place(index);
        const response = await fetchChecked(url, place, { signal: own });
        return new Blob([await readBounded(response, most, place, own)]);
      },
      signal,
    );
  }

  async #lists(index: number, page: CanvasPage, signal: AbortSignal): Promise<Value[]> {
    const lists = page.annotations.map((list) => this.#annotations(index, list, signal));
    return (await Promise.all(lists)).flat();
  }

  /** Returns the text of an annotation that is at an address of its own; null if it cannot be had or read. */
  async #farText(index: number, annotation: Value, signal: AbortSignal): Promise<Value | null> {
    const far = farText(annotation);
    const url = addressOf(far?.body, this.#book.base);
    const format = far?.format.split(";", 1)[0] ?? "";
    try {
      if (url !== "" && /^text\/(plain|html)$/.test(format)) {
        const blob = await this.#fetch(index, url, limits.manifestBytes, signal);
        return { type: "TextualBody", value: await blob.text(), format };
      }
    } catch {
      signal.throwIfAborted();
    }
    const warning = warningOf("annotation", url || "–", this.#book.name);
    this.#warnings.add({ ...warning, page: index + 1 });
    return null;
  }

  /**
   * Returns a page of annotations, fetched if need be, and those that follow it; nothing if it cannot be
   * had.
   */
  async #annotations(index: number, list: Value, signal: AbortSignal): Promise<readonly Value[]> {
    const lists: Value[] = [];
    let next: unknown = list;
    while (next && lists.length < mostLists) {
      const url = addressOf(next, this.#book.base);
      const here = Object(next) as Value;
      const page = annotationsIn(here) ? here : await this.#list(index, url, signal);
      lists.push(page);
      next = page.first ?? page.next;
    }
    return lists;
  }

  /** Returns a list of annotations at an address; nothing if it cannot be had. */
  async #list(index: number, url: string, signal: AbortSignal): Promise<Value> {
    if (url === "") return {};
    try {
      const blob = await this.#fetch(index, url, limits.manifestBytes, signal);
      return Object(JSON.parse(await blob.text()));
    } catch {
      // The page is shown without it.
      signal.throwIfAborted();
      const warning = warningOf("annotation", url, this.#book.name);
      this.#warnings.add({ ...warning, page: index + 1 });
      return {};
    }
  }
}

interface MeasuredImage extends PaintedImage {
  readonly info: ImageInfo | null;
  readonly crop: PageBox;
  readonly density: number;
}

/** Returns the part of an image that is shown, which lies within it. */
function within(crop: PageBox | null, { width, height }: PageSize): PageBox {
  const all = { x: 0, y: 0, width, height };
  return (crop && overlap(crop, all)) ?? all;
}

/** Returns where an image is on its canvas before it is turned about its middle. */
function upright(image: PaintedImage): PageBox {
  return turnedBack(image.on, image);
}

/** Returns a box of the canvas as it lies for an image that is not turned yet. */
function turnedBack({ x, y, width, height }: PageBox, { on, turns }: PaintedImage): PageBox {
  const [middleX, middleY] = [on.x + on.width / 2, on.y + on.height / 2];
  let box: PageBox = { x: x - middleX, y: y - middleY, width, height };
  for (let turn = 0; turn < turns; turn++) {
    box = { x: box.y, y: -box.x - box.width, width: box.height, height: box.width };
  }
  return { ...box, x: middleX + box.x, y: middleY + box.y };
}

/** Returns the transformation that turns a picture by quarters, clockwise, onto a canvas. */
function turningOf(
  turns: PaintedImage["turns"],
  { width, height }: PageSize,
): [number, number, number, number, number, number] {
  if (turns === 1) return [0, 1, -1, 0, width, 0];
  if (turns === 2) return [-1, 0, 0, -1, width, height];
  return turns === 3 ? [0, -1, 1, 0, 0, height] : [1, 0, 0, 1, 0, 0];
}

function overlap(a: PageBox, b: PageBox): PageBox | null {
  const [x, y] = [Math.max(a.x, b.x), Math.max(a.y, b.y)];
  const width = Math.min(a.x + a.width, b.x + b.width) - x;
  const height = Math.min(a.y + a.height, b.y + b.height) - y;
  return width > 0 && height > 0 ? { x, y, width, height } : null;
}

/**
 * Returns a part of a box in pixels of the picture of the box: x, y, width,
 * height. Edges are whole pixels, so that no seam shows between tiles.
 */
function inPixels(
  part: PageBox,
  box: PageBox,
  picture: PageSize,
): [number, number, number, number] {
  const across = (x: number): number => Math.round(((x - box.x) / box.width) * picture.width);
  const down = (y: number): number => Math.round(((y - box.y) / box.height) * picture.height);
  const [x, y] = [across(part.x), down(part.y)];
  return [x, y, across(part.x + part.width) - x, down(part.y + part.height) - y];
}

/** Returns what JSON says; undefined if a text is none, as a page to log in at is. */
function jsonIn(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}
