/** Text of a canvas, from annotations that transcribe it. */

import { cleanRun } from "../book_text.ts";
import { limits } from "../limits.ts";
import type { TextRun } from "../page_source.ts";
import { type CanvasPage, targetBox } from "./presentation.ts";
import { objectsIn, plain, stringsIn, typeOf, type Value } from "./values.ts";

/** Returns the runs of text that pages of annotations have on a page, in their order. */
export function textOn(page: CanvasPage, lists: readonly Value[]): TextRun[] {
  const runs: TextRun[] = [];
  let letters = 0;
  for (const annotation of lists.flatMap((list) => objectsIn(annotationsIn(list) ?? []))) {
    const box = targetBox(annotation.target ?? annotation.on, page.canvas);
    const text = isTranscript(annotation) ? textOf(annotation) : "";
    const { part } = page;
    const middle = box ? box.x + box.width / 2 : -1;
    if (!box || text === "" || middle < part.x || middle >= part.x + part.width) continue;
    letters += text.length;
    if (runs.length >= limits.runs || letters > limits.textLength) break;
    runs.push({ ...box, x: box.x - part.x, y: box.y - part.y, text, angle: 0, end: true });
  }
  return runs;
}

/** Returns the annotations in a page of them; undefined if it is known by its address alone. */
export function annotationsIn(list: Value): unknown {
  return list.items ?? list.resources;
}

/** Returns whether an annotation says what stands on the canvas, rather than something about it. */
function isTranscript(annotation: Value): boolean {
  return stringsIn(annotation.motivation).some((one) =>
    /^(sc:)?(supplementing|painting)$/.test(one),
  );
}

function textOf(annotation: Value): string {
  const bodies = objectsIn(annotation.body ?? annotation.resource ?? [], 5);
  const body = bodies.find((one) => /^(TextualBody|ContentAsText)$/.test(typeOf(one)));
  const [text = ""] = stringsIn(body?.value ?? body?.chars);
  const [format = ""] = stringsIn(body?.format);
  return cleanRun(format === "text/html" ? plain(text) : text).trim();
}
