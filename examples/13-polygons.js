import { BookError } from "turnleaf";

/** A source of pages that are in no file: page n shows a polygon of n + 2 sides. */
export class PolygonBook {
  title = "Polygons";
  language = "en";
  direction = "ltr";
  kind = "typeset";
  #isClosed = false;

  constructor(pageCount) {
    this.pageCount = pageCount;
  }

  label(index) {
    return String(index + 1);
  }

  /** Any unit will do: text and links are placed in the same. */
  async size() {
    return { width: 300, height: 450 };
  }

  async draw(index, width, signal, region = { x: 0, y: 0, width: 1, height: 1 }) {
    signal.throwIfAborted();
    if (this.#isClosed || !(index >= 0 && index < this.pageCount)) {
      throw new BookError(`${this.title} has no page ${index + 1}; turn to another.`);
    }
    // Only the part that is wanted is drawn, as many pixels wide as it is wanted.
    const scale = width / (300 * region.width);
    const canvas = new OffscreenCanvas(width, Math.max(1, Math.round(450 * region.height * scale)));
    const pen = canvas.getContext("2d");
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.setTransform(scale, 0, 0, scale, -300 * region.x * scale, -450 * region.y * scale);
    pen.fillStyle = "#2b2622";
    pen.font = "18px Georgia, serif";
    for (const { text, x, y, height, width } of await this.text(index)) {
      pen.fillText(text, x, y + 0.8 * height, width);
    }
    const sides = index + 3;
    pen.beginPath();
    for (let k = 0; k <= sides; k++) {
      const angle = (2 * Math.PI * k) / sides;
      pen.lineTo(150 + 110 * Math.sin(angle), 240 - 110 * Math.cos(angle));
    }
    pen.stroke();
    await null;
    signal.throwIfAborted();
    return canvas.transferToImageBitmap();
  }

  /** Optional, as all below: what can be selected, found and read aloud. */
  async text(index) {
    const text = `A polygon of ${index + 3} sides`;
    return [{ text, x: 50, y: 50, width: 200, height: 24, angle: 0, end: true }];
  }

  async outline() {
    return [{ title: "The triangle", page: 1, children: [] }];
  }

  close() {
    this.#isClosed = true;
  }
}
