import type { PDFDocumentProxy } from "pdfjs-dist";
import { cleanAddress, cleanText } from "./book_text.ts";
import { limits } from "./limits.ts";
import type { LinkTarget, OutlineEntry } from "./page_source.ts";

/** Returns whether an action turns pages, if it is one that a file calls by its name alone. */
export function isTurn(action: string | null | undefined): boolean {
  return /^(First|Last|Next|Prev)Page$/.test(action ?? "");
}

/** The targets of links and contents of one document: each destination is resolved once. */
export class PdfTargets {
  readonly #document: PDFDocumentProxy;
  readonly #pages = new Map<string, Promise<number | null>>();

  constructor(document: PDFDocumentProxy) {
    this.#document = document;
  }

  /** Returns the page (from 1) of a destination, or null if it is invalid. */
  page(destination: unknown): Promise<number | null> {
    const key = JSON.stringify(destination) ?? "";
    let page = this.#pages.get(key);
    if (page === undefined) {
      page = this.#find(destination).catch(() => null);
      if (this.#pages.size < limits.outlineEntries) this.#pages.set(key, page);
    }
    return page;
  }

  /** Returns the target of a link or a line of the contents, or null. */
  async of(
    from: { url?: string | null; dest?: unknown; action?: string | null },
    here = 1,
  ): Promise<LinkTarget | null> {
    const href = cleanAddress(from.url);
    if (href !== "") return { href };
    const last = this.#document.numPages;
    const named = { FirstPage: 1, LastPage: last, NextPage: here + 1, PrevPage: here - 1 }[
      from.action ?? ""
    ];
    const page = named ?? (from.dest ? await this.page(from.dest) : null);
    return page !== null && page >= 1 && page <= last ? { page } : null;
  }

  async #find(destination: unknown): Promise<number | null> {
    const document = this.#document;
    const explicit =
      typeof destination === "string" ? await document.getDestination(destination) : destination;
    const target: unknown = Array.isArray(explicit) ? explicit[0] : null;
    const isReference = typeof target === "object" && target !== null;
    const index = isReference
      ? await document.getPageIndex(target as Parameters<typeof document.getPageIndex>[0])
      : target;
    return Number.isInteger(index) &&
      (index as number) >= 0 &&
      (index as number) < document.numPages
      ? (index as number) + 1
      : null;
  }
}

/** Returns the contents of a document, bounded in depth and number. Rejects as pdf.js does. */
export async function outlineOf(
  document: PDFDocumentProxy,
  targets: PdfTargets,
): Promise<OutlineEntry[]> {
  let left: number = limits.outlineEntries;
  type Node = Awaited<ReturnType<PDFDocumentProxy["getOutline"]>>[number];
  const read = (nodes: readonly Node[], depth: number): Promise<OutlineEntry[]> => {
    const within = depth < limits.outlineDepth ? nodes.slice(0, left) : [];
    left -= within.length;
    return Promise.all(
      within.map(async (node) => {
        const children = await read(node.items, depth + 1);
        const to = await targets.of(node as { url: string | null; dest: unknown });
        const title = cleanText(node.title) || "…";
        return to && "href" in to
          ? { title, page: null, href: to.href, children }
          : { title, page: to?.page ?? null, children };
      }),
    );
  };
  return await read((await document.getOutline()) ?? [], 0);
}
