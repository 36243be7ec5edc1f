import { nameOfUrl } from "./book_text.ts";
import { cropImage } from "./crop_image.ts";
import { closedError } from "./failures.ts";
import { fetchChecked, readBounded } from "./fetch_bytes.ts";
import { listImages } from "./formats.ts";
import { claimedSize, kindOfFile, typedImage } from "./image_header.ts";
import { fitPixels, isPageSize, limits, wholePage } from "./limits.ts";
import { loadPart } from "./load_part.ts";
import type { ImageBook, ImagePage, StoredImage, StripPage } from "./manifest.ts";
import { isMoving } from "./moving_image.ts";
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
} from "./page_source.ts";
import { SharedTasks } from "./shared_tasks.ts";
import { showableImage } from "./showable_image.ts";
import { shownImage } from "./shown_image.ts";
import { withStrips } from "./strip_pages.ts";
import type { Strip } from "./strips.ts";
import { lostLines, WarningList } from "./warnings.ts";

/** Encoded images kept, so that drawing a page sharper does not fetch it again. */
const keptImages = 6;

/**
 * A book of images: scans, a comic's pages, exported slides. Each is fetched
 * when it is first needed and decoded straight to the requested width, never
 * beyond its own.
 */
export class ImageSource implements PageSource {
  readonly title: string;
  readonly authors: PageSource["authors"];
  readonly details: readonly BookDetail[];
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly kind: "typeset" | "scan";
  readonly cover: PageSource["cover"];
  readonly pageCount: number;
  /** The archive of the images, or a single image. */
  readonly file?: () => Promise<Blob>;
  readonly #book: ImageBook;
  readonly #sizes: (PageSize | undefined)[];
  readonly #measured = new Set<number>();
  readonly #images = new Map<ImagePage["src"], Blob>();
  readonly #fetching = new SharedTasks<ImagePage["src"], Blob>();
  readonly #warnings = new WarningList();
  #closed = false;

  constructor(book: ImageBook) {
    this.title = book.title;
    this.authors = book.authors;
    this.details = (book.authors ?? []).map((value) => ({ label: "", value }));
    this.language = book.language;
    this.direction = book.direction;
    this.kind = book.kind;
    this.cover = book.cover;
    this.pageCount = book.pages.length;
    this.#book = book;
    this.#sizes = book.pages.map((page) => page.size);
    this.#warnings.add(...(book.warnings ?? []), ...lostLines(book.outline ?? [], book.name));
    const { file } = book;
    if (file) this.file = () => Promise.resolve(file);
    else if (this.pageCount === 1) this.file = () => this.#image(0);
  }

  get warnings(): readonly BookWarning[] {
    return this.#warnings.all;
  }

  watchWarnings(listener: () => void): void {
    this.#warnings.watch(listener);
  }

  async size(index: number, signal?: AbortSignal): Promise<PageSize> {
    const known = this.#sizes[index];
    if (known) return known;
    return await this.#measure(index, await this.#image(index, signal));
  }

  widthInMetres(): number | undefined {
    return this.#book.pageWidth;
  }

  label(index: number): string {
    return this.#book.pages[index]?.label ?? String(index + 1);
  }

  inSpread(index: number): ImagePage["inSpread"] {
    return this.#book.pages[index]?.inSpread;
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region: PageBox = wholePage,
  ): Promise<PagePicture> {
    const image = await this.#image(index, signal);
    const size = await this.#measure(index, image);
    signal.throwIfAborted();
    const { part: own = wholePage, strip } = this.#book.pages[index] ?? {};
    const from = { x: own.x / own.width + region.x, y: own.y / own.height + region.y };
    const part = scaleBox({ ...region, ...from }, size);
    // Vector images are sharp at any size, bitmaps at their own.
    const pixels = fitPixels(part, isSvg(image) ? width : Math.min(width, part.width));
    const whole = region === wholePage && own === wholePage && !isSvg(image);
    const picture = strip
      ? await this.#drawStrip(index, image, strip, part, pixels, signal)
      : await this.#decode(index, image, whole ? null : part, pixels);
    if (!signal.aborted && !this.#closed) return picture;
    picture.close();
    signal.throwIfAborted();
    throw closedError(this.#book.name);
  }

  async text(index: number): Promise<readonly TextRun[]> {
    return this.#toScale(index, this.#book.pages[index]?.text);
  }

  async links(index: number): Promise<readonly PageLink[]> {
    return this.#toScale(index, this.#book.pages[index]?.links);
  }

  async alt(index: number): Promise<string> {
    return this.#book.pages[index]?.alt ?? "";
  }

  async outline(): Promise<readonly OutlineEntry[]> {
    return this.#book.outline ?? [];
  }

  close(): void {
    this.#closed = true;
    this.#images.clear();
    this.#fetching.abortAll(closedError(this.#book.name));
    this.#book.close?.();
  }

  /**
   * Scales boxes to the unit of `size()`, which is the image's own pixels once
   * they are known, not what a manifest claims.
   */
  #toScale<T extends PageBox>(index: number, boxes: readonly T[] = []): readonly T[] {
    const claimed = this.#book.pages[index]?.size;
    const size = this.#sizes[index];
    if (!claimed || !size) return boxes;
    const scale = { width: size.width / claimed.width, height: size.height / claimed.height };
    return boxes.map((box) => ({ ...box, ...scaleBox(box, scale) }));
  }

  /** Measures the image's own size, which may differ from what a manifest claims. */
  async #measure(index: number, image: Blob): Promise<PageSize> {
    const known = this.#sizes[index];
    if (known && this.#measured.has(index)) return known;
    const pixels = await measure(image).catch(async () => {
      throw (await isPdf(image)) ? this.#misplacedPdf(index) : this.#undecodable(index);
    });
    if (!isPageSize(pixels)) throw this.#undecodable(index);
    if (!isSvg(image) && pixels.width * pixels.height > limits.imagePixels) {
      throw new BookError(
        `${this.#place(index)} has ${pixels.width} x ${pixels.height} pixels, more than can be shown; make it smaller.`,
        { code: "tooLarge", page: index + 1, source: this.#book.name },
      );
    }
    const { part: { width, height } = wholePage, strip } = this.#book.pages[index] ?? {};
    const size = strip
      ? { width: pixels.width, height: pixels.width * strip.ratio }
      : { width: pixels.width * width, height: pixels.height * height };
    this.#measured.add(index);
    this.#sizes[index] = size;
    return size;
  }

  /** @param part the part of the image wanted, in its pixels; null for all of it */
  async #decode(
    index: number,
    image: Blob,
    part: PageBox | null,
    pixels: PageSize,
  ): Promise<ImageBitmap> {
    const options: ImageBitmapOptions = {
      resizeWidth: pixels.width,
      resizeHeight: pixels.height,
      resizeQuality: "high",
    };
    try {
      if (part !== null && isSvg(image)) {
        const { drawSvg } = await loadPart(import("./svg.ts"));
        const about = { page: index + 1, source: this.#book.name };
        return await drawSvg(image, part, pixels, this.#place(index), about);
      }
      if (part === null) return await bitmapOf(image, options);
      const whole = await bitmapOf(image);
      return await cropImage(whole, part, pixels).finally(() => whole.close());
    } catch (error) {
      throw error instanceof BookError ? error : this.#undecodable(index);
    }
  }

  /** Draws a page of a strip, which is one image or lies in several. */
  async #drawStrip(
    index: number,
    image: Blob,
    page: StripPage,
    part: PageBox,
    pixels: PageSize,
    signal: AbortSignal,
  ): Promise<ImageBitmap> {
    const { drawStripPage, joinedStrip } = await loadPart(import("./strips.ts"));
    let place = this.#place(index);
    try {
      let strip: Strip;
      if (page.slices) {
        strip = joinedStrip(page.slices, async ({ src }) => {
          place = this.#place(index, src);
          return await bitmapOf(await this.#image(index, signal, src));
        });
      } else {
        const whole = await bitmapOf(image);
        strip = { size: whole, rows: async () => ({ image: whole, first: 0 }) };
      }
      return await drawStripPage(strip, page, part, pixels);
    } catch (error) {
      if (error instanceof BookError || signal.aborted) throw error;
      throw this.#undecodable(index, place);
    }
  }

  /** @param src the image, if it is not the page's own */
  async #image(
    index: number,
    signal?: AbortSignal,
    src: ImagePage["src"] | undefined = this.#book.pages[index]?.src,
  ): Promise<Blob> {
    signal?.throwIfAborted();
    if (this.#closed || src === undefined) {
      throw new BookError(`${this.#book.name} has no page ${index + 1} any more; open it again.`, {
        code: "noPage",
        source: this.#book.name,
      });
    }
    const kept = this.#images.get(src);
    const image =
      kept ??
      (src instanceof Blob
        ? await this.#read(index, src)
        : await this.#fetching.run(src, (own) => this.#fetch(index, src, own), signal));
    if (kept === undefined && (await isMoving(image))) {
      const message = `${this.#place(index, src)} moves; of its pictures the first is shown.`;
      this.#warnings.add({ code: "medium", message, page: index + 1 });
    }
    this.#keep(src, image);
    return image;
  }

  /** Moves the image to the end of those kept and drops the oldest. */
  #keep(src: ImagePage["src"], image: Blob): void {
    if (this.#closed) return;
    this.#images.delete(src);
    this.#images.set(src, image);
    for (const oldest of this.#images.keys()) {
      if (this.#images.size <= keptImages) break;
      this.#images.delete(oldest);
    }
  }

  async #fetch(index: number, src: string | StoredImage, signal: AbortSignal): Promise<Blob> {
    if (typeof src !== "string") return await this.#showable(index, src, await src.read());
    const place = this.#place(index, src);
    const response = await fetchChecked(
      src,
      place,
      { signal },
      { page: index + 1, source: this.#book.name },
    );
    const bytes = await readBounded(response, limits.imageBytes, place, signal);
    if (bytes.length === 0)
      throw new BookError(`${place} is empty; get the file again.`, {
        code: "empty",
        page: index + 1,
        source: this.#book.name,
      });
    const type = response.headers.get("content-type") ?? "";
    return await this.#showable(index, src, new Blob([bytes], { type }));
  }

  async #read(index: number, image: Blob): Promise<Blob> {
    try {
      return await this.#showable(index, image, image);
    } catch (error) {
      if (error instanceof BookError) throw error;
      throw new BookError(`${this.#place(index)} cannot be read any more; choose the file again.`, {
        code: "gone",
        page: index + 1,
        source: this.#book.name,
      });
    }
  }

  async #showable(index: number, src: ImagePage["src"], image: Blob): Promise<Blob> {
    const about = { page: index + 1, source: this.#book.name };
    const typed = await typedImage(image);
    if (typed.type === "image/tiff") await this.#checkOnePage(index, typed);
    return await showableImage(typed, this.#place(index, src), about);
  }

  /** Lists a TIFF of several pages, of which one is shown, as its book has one for it. */
  async #checkOnePage(index: number, image: Blob): Promise<void> {
    const { pagesOfTiff } = await loadPart(import("./rare_images/tiff_pages.ts"));
    const { length } = await pagesOfTiff(image);
    const message = `${this.#place(index)} is a TIFF of ${length} pages, of which only the first is shown.`;
    if (length > 1) this.#warnings.add({ code: "image", message, page: index + 1 });
  }

  #misplacedPdf(index: number): BookError {
    return new BookError(`${this.#place(index)} is a PDF among images; open it by itself.`, {
      code: "unsupported",
      page: index + 1,
      source: this.#book.name,
    });
  }

  #undecodable(index: number, place = this.#place(index)): BookError {
    return new BookError(`${place} is damaged or no image; ${listImages()} can be shown.`, {
      code: "damaged",
      page: index + 1,
      source: this.#book.name,
    });
  }

  /** "Page 3 of atlas.json (003.jpg)". */
  #place(index: number, src = this.#book.pages[index]?.src): string {
    const file = nameOf(src);
    if (this.pageCount === 1 && file === this.#book.name) return file;
    const suffix = file === "this book" ? "" : ` (${file})`;
    return `Page ${index + 1} of ${this.#book.name}${suffix}`;
  }
}

/** Opens a book of images, of which those that are strips take several pages. */
export async function openImageBook(book: ImageBook): Promise<PageSource> {
  return new ImageSource(await withStrips(book));
}

/** Returns the name of an image's file in sentences. */
function nameOf(src: ImagePage["src"] | undefined): string {
  if (typeof src === "string") return nameOfUrl(src);
  return src === undefined || src instanceof Blob ? "this book" : src.name;
}

function scaleBox({ x, y, width, height }: PageBox, by: PageSize): PageBox {
  return { x: x * by.width, y: y * by.height, width: width * by.width, height: height * by.height };
}

const isPdf = async (file: Blob): Promise<boolean> => (await kindOfFile(file)) === "pdf";
const isSvg = (image: Blob): boolean => image.type === "image/svg+xml";

/** Returns an image's size in pixels, upright by its EXIF data. Rejects if it is not an image. */
async function measure(image: Blob): Promise<PageSize> {
  if (isSvg(image)) {
    const { sizeOfSvg } = await loadPart(import("./svg.ts"));
    return await sizeOfSvg(image);
  }
  const claimed = await claimedSize(image);
  if (claimed?.isShown) return claimed;
  const isTooLarge = claimed && claimed.width * claimed.height > limits.imagePixels;
  return isTooLarge ? claimed : await measureByDecoding(image);
}

async function measureByDecoding(image: Blob): Promise<PageSize> {
  const bitmap = await bitmapOf(image);
  const size = { width: bitmap.width, height: bitmap.height };
  bitmap.close();
  return size;
}

/** Returns all of an image, upright. Rejects if the browser shows none of it. */
async function bitmapOf(image: Blob, options: ImageBitmapOptions = {}): Promise<ImageBitmap> {
  return await createImageBitmap(image, options).catch(
    async () => await createImageBitmap(await shownImage(image), options),
  );
}
