import type { PDFPageProxy } from "pdfjs-dist";
import { cleanRun } from "./book_text.ts";
import { isPageSize, limits } from "./limits.ts";
import type { TextRun } from "./page_source.ts";

/** What pdf.js says of a piece of text; what stands in the file can still be anything. */
interface Item {
  readonly str?: string;
  readonly transform: readonly number[];
  readonly width: number;
  readonly height: number;
  readonly fontName: string;
  readonly hasEOL: boolean;
}

interface Style {
  readonly ascent: number;
  readonly descent: number;
  readonly vertical: boolean;
}

interface Chunk {
  readonly items: readonly Item[];
  readonly styles: Readonly<Record<string, Style>>;
}

/** The text of a page in the order of its file, which is the order of reading. Rejects as pdf.js does. */
export async function textOfPage(page: PDFPageProxy, signal: AbortSignal): Promise<TextRun[]> {
  const view = page.getViewport({ scale: 1 });
  const runs: TextRun[] = [];
  const styles: Record<string, Style> = Object.create(null);
  let letters = 0;
  const reader = (page.streamTextContent() as ReadableStream<Chunk>).getReader();
  try {
    for (;;) {
      const { value, done } = await reader.read();
      signal.throwIfAborted();
      if (done) return runs;
      Object.assign(styles, value.styles);
      for (const item of value.items) {
        if (item.str === undefined) continue;
        const run = runOf(item, styles[item.fontName], view.transform);
        if (run && isWithin(run, view)) {
          letters += run.text.length;
          if (runs.length >= limits.runs || letters > limits.textLength) return runs;
          runs.push(run);
        } else follow(runs, item);
      }
    }
  } finally {
    // Ends the worker's reading too, where this stops before the page does.
    reader.cancel(new Error("The text is not wanted any more.")).catch(() => {});
  }
}

/** Spaces and ends of lines that come as items of their own belong to the run before them. */
function follow(runs: TextRun[], item: Item): void {
  const last = runs.at(-1);
  if (last === undefined) return;
  const isGap = item.str !== "" && !/\s$/.test(last.text);
  runs[runs.length - 1] = {
    ...last,
    text: isGap && item.str?.trim() === "" ? `${last.text} ` : last.text,
    end: last.end || item.hasEOL,
  };
}

function runOf(item: Item, style: Style | undefined, view: readonly number[]): TextRun | null {
  const text = cleanRun(item.str);
  if (text.trim() === "") return null;
  const [a, b, c, d, e, f] = item.transform;
  // Where the baseline begins, and how the letters stand, on a page seen from its top left corner.
  const x = view[0] * e + view[2] * f + view[4];
  const y = view[1] * e + view[3] * f + view[5];
  const along = { x: view[0] * a + view[2] * b, y: view[1] * a + view[3] * b };
  const size = Math.hypot(view[0] * c + view[2] * d, view[1] * c + view[3] * d);
  const angle = Math.atan2(along.y, along.x) || 0;
  const unit = Math.hypot(view[0], view[1]);
  const end = item.hasEOL;
  if (style?.vertical) {
    const across = { x: Math.cos(angle) * (size / 2), y: Math.sin(angle) * (size / 2) };
    const height = item.height * unit;
    return {
      text,
      x: x - across.x,
      y: y - across.y,
      width: size,
      height,
      angle,
      end,
      vertical: true,
    };
  }
  const ascent = size * between(style?.ascent, 0.5, 1.2, 0.8);
  const descent = size * between(style?.descent && -style.descent, 0.05, 0.5, 0.2);
  return {
    text,
    x: x + ascent * Math.sin(angle),
    y: y - ascent * Math.cos(angle),
    width: item.width * unit,
    height: ascent + descent,
    angle,
    end,
  };
}

function between(value: number | undefined, low: number, high: number, otherwise: number): number {
  return value !== undefined && value >= low && value <= high ? value : otherwise;
}

/** Whether something of the run is seen on its page: a file's text may lie anywhere. */
function isWithin(
  run: TextRun,
  page: { readonly width: number; readonly height: number },
): boolean {
  const { x, y, width, height, angle } = run;
  if (!Number.isFinite(x + y + angle) || !isPageSize({ width, height })) return false;
  const middle = {
    x: x + (width * Math.cos(angle) - height * Math.sin(angle)) / 2,
    y: y + (width * Math.sin(angle) + height * Math.cos(angle)) / 2,
  };
  return middle.x > 0 && middle.y > 0 && middle.x < page.width && middle.y < page.height;
}
