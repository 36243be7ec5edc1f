/** Pages of one hue each, which differ wherever they are seen. */

/** What a page should show: one hue in degrees, or the print of a PDF's page. */
export type Content = number | "print";

/** Steps of hue, and how many of them lie between pages that follow each other: no two in sight are alike. */
export const hueCount = 36;
const hueStep = 7;

/** Makes pages of hues that follow each other, all of which come before one comes again. */
export class HuePages {
  readonly #pictures = new Map<string, string>();
  #made = 0;

  /** Begins with the first hue again. */
  restart(): void {
    this.#made = 0;
  }

  /** Returns the next hues. */
  take(count: number): number[] {
    const next = () => (360 / hueCount) * ((this.#made++ * hueStep) % hueCount);
    return Array.from({ length: count }, next);
  }

  /** Returns pages of hues; some have other proportions and are fitted to their leaves. */
  images(hues: readonly Content[]): { src: string }[] {
    return hues.map((hue) => ({ src: this.#image(Number(hue), Number(hue) % 50 === 30) }));
  }

  /** Returns a manifest, as a file, of images with a text. */
  manifest(hues: readonly Content[]): Blob {
    const place = { x: 10, y: 10, width: 60, height: 12 };
    const pages = this.images(hues).map((page) => ({
      ...page,
      text: [{ ...place, text: "hue" }],
    }));
    return new Blob([JSON.stringify({ title: "Hues", pages })], { type: "application/json" });
  }

  #image(hue: number, isWide: boolean): string {
    const key = `${hue} ${isWide}`;
    const known = this.#pictures.get(key);
    if (known) return known;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = isWide ? [120, 120] : [90, 120];
    const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
    pen.fillStyle = `hsl(${hue} 100% 50%)`;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    const address = canvas.toDataURL("image/png");
    canvas.width = canvas.height = 0;
    this.#pictures.set(key, address);
    return address;
  }
}
