import type { PDFPageProxy } from "pdfjs-dist";
import { cleanText } from "./book_text.ts";
import { limits } from "./limits.ts";

/** A node of a tagged page, as far as it is used here. */
interface Node {
  readonly alt?: unknown;
  readonly children?: readonly Node[];
}

/** Maximum of nodes visited: a page has a few thousand at most. */
const mostNodes = 20_000;

/**
 * Returns a tagged PDF's descriptions of a page's pictures, in the page's
 * order. Rejects as pdf.js does.
 */
export async function altOfPage(page: PDFPageProxy): Promise<string> {
  const said: string[] = [];
  const waiting: Node[] = [((await page.getStructTree()) ?? {}) as Node];
  for (let count = 0; waiting.length > 0 && count < mostNodes; count++) {
    const node = waiting.pop();
    const alt = cleanText(node?.alt, limits.altLength);
    if (alt !== "") said.push(alt);
    // The description of a whole replaces those of its parts.
    else waiting.push(...(node?.children ?? []).toReversed());
  }
  return said.join(" ").slice(0, limits.altLength);
}
