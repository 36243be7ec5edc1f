/** Runs in the browser: test books as the package opens them, with what their checks ask about. */
import { openSource } from "/turnleaf/index.js";

const never = new AbortController().signal;

/** The width at which pages are looked at, pixels. */
const lookedAtWidth = 360;

/** How text is set as its book says. */
const ownTypography = {
  ...{ font: "", size: 1, lineHeight: 0, margins: 1, align: "", hyphens: "" },
  ...{ letterSpacing: 0, wordSpacing: 0, width: 0 },
};

/** A page's picture. */
class Picture {
  constructor({ width, height, data }) {
    Object.assign(this, { width, height, data });
  }

  /** Returns the colour at a place, in fractions of the page: red, green and blue, 0 to 255. */
  at(x, y) {
    const { width, height, data } = this;
    const pixel = Math.round(y * (height - 1)) * width + Math.round(x * (width - 1));
    return [...data.slice(pixel * 4, pixel * 4 + 3)];
  }

  /** Returns the fraction of pixels whose colour fulfils a condition. */
  fraction(fulfils) {
    let count = 0;
    const { data } = this;
    for (let k = 0; k < data.length; k += 4) {
      if (fulfils(data[k], data[k + 1], data[k + 2])) count++;
    }
    return (4 * count) / data.length;
  }

  /** Returns the fraction of pixels in which it differs from another picture; 1 if their sizes differ. */
  differenceFrom({ width, height, data }) {
    if (width !== this.width || height !== this.height) return 1;
    let count = 0;
    for (let k = 0; k < data.length; k += 4) {
      const off = [0, 1, 2].map((channel) => Math.abs(data[k + channel] - this.data[k + channel]));
      if (Math.max(...off) > 32) count++;
    }
    return (4 * count) / data.length;
  }
}

/** A test's book, open. */
export class OpenedBook {
  /** What the reader is told where the book cannot be opened; null where it can. */
  error = null;
  source = null;

  /** Opens a book and waits until the number of its pages is known. */
  static async open(bytes, name) {
    const book = new OpenedBook();
    book.file = new File([bytes], `${name}.epub`, { type: "application/epub+zip" });
    try {
      book.source = await openSource(book.file);
    } catch (error) {
      book.error = error.message;
      return book;
    }
    await new Promise((resolve) =>
      book.source.watchPages((change) => {
        change();
        resolve();
      }),
    );
    return book;
  }

  get pageCount() {
    return this.source.pageCount;
  }

  /** Returns a page's text (from page 1), its lines joined by spaces. */
  async text(page) {
    const runs = await this.source.text(page - 1, never);
    return runs
      .map(({ text, end }) => text + (end ? " " : ""))
      .join("")
      .replace(/\s+/g, " ")
      .trim();
  }

  /** Returns every page's text, in order. */
  async texts() {
    const pages = Array.from({ length: this.pageCount }, (_, k) => this.text(k + 1));
    return await Promise.all(pages);
  }

  runs(page) {
    return this.source.text(page - 1, never, true);
  }

  links(page) {
    return this.source.links(page - 1, never);
  }

  outline() {
    return this.source.outline(never);
  }

  size(page) {
    return this.source.size(page - 1);
  }

  /** Sets flowing text anew, its type so many times as large as the book's own. */
  async setSize(size) {
    const change = await this.source.typeset({ ...ownTypography, size });
    change?.();
    await this.source.settle();
  }

  /** Returns the lines of all pages; of one that ends within a word the last character is a soft hyphen. */
  async lines() {
    const lines = [];
    let line = "";
    for (let page = 1; page <= this.pageCount; page++) {
      for (const { text, end } of await this.runs(page)) {
        line += text;
        if (!end) continue;
        lines.push(line);
        line = "";
      }
    }
    return lines;
  }

  async bitmap(page, width = lookedAtWidth) {
    return await this.source.draw(page - 1, width, never);
  }

  /** Returns a page's picture. */
  async picture(page, width) {
    return this.pictureOf(await this.bitmap(page, width));
  }

  /** Returns a bitmap's picture, and closes the bitmap. */
  pictureOf(bitmap) {
    const pen = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    pen.drawImage(bitmap, 0, 0);
    bitmap.close();
    return new Picture(pen.getImageData(0, 0, pen.canvas.width, pen.canvas.height));
  }

  /**
   * Shows the book in an element of a size in CSS pixels, with the controls, and
   * returns it once its pages are counted.
   */
  async shown(width, height, attributes = {}) {
    this.element?.remove();
    const element = document.createElement("turnleaf-book");
    this.element = element;
    element.style.cssText = `display: block; width: ${width}px; height: ${height}px`;
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.duration = 0;
    // Text is set for the size in which pages are shown: the pages that are asked about are those.
    this.source.close();
    this.source = await openSource(this.file);
    element.pages = this.source;
    const loaded = new Promise((resolve, reject) => {
      element.addEventListener("load", resolve);
      element.addEventListener("error", ({ detail }) => reject(new Error(detail.message)));
    });
    document.body.append(element);
    await loaded;
    // Before every chapter is set, the number of pages is estimated.
    while (element.estimated || element.pageCount !== this.pageCount) {
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    return element;
  }

  close() {
    this.element?.remove();
    this.source?.close();
  }
}

/** Draws a book's first pages beside each other, for the eye. Returns a PNG as base64. */
export async function contactSheet(book, mostPages = 8) {
  const [width, height, gap, across] = [330, 500, 10, 4];
  const count = Math.min(book.pageCount, mostPages);
  const rows = Math.ceil(count / across);
  const canvas = document.createElement("canvas");
  canvas.width = Math.min(count, across) * (width + gap);
  canvas.height = rows * (height + gap);
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#999";
  pen.fillRect(0, 0, canvas.width, canvas.height);
  for (let k = 0; k < count; k++) {
    const bitmap = await book.bitmap(k + 1, 2 * width);
    const scale = Math.min(width / bitmap.width, height / bitmap.height);
    const [x, y] = [(k % across) * (width + gap), Math.floor(k / across) * (height + gap)];
    pen.drawImage(bitmap, x, y, bitmap.width * scale, bitmap.height * scale);
    bitmap.close();
  }
  return canvas.toDataURL("image/png").split(",")[1];
}
