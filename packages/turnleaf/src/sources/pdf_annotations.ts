import type { PDFDocumentProxy, PDFPageProxy } from "pdfjs-dist";
import { cleanText } from "./book_text.ts";
import { isPageBox, limits } from "./limits.ts";
import type { PageBox, PageField, PageLink } from "./page_source.ts";
import { isTurn, type PdfTargets } from "./pdf_targets.ts";

/** The properties of a pdf.js annotation used here; a file can contain anything. */
export interface Annotation {
  readonly id: string;
  readonly subtype?: string;
  readonly annotationFlags?: number;
  readonly hasAppearance?: boolean;
  readonly inReplyTo?: string | null;
  readonly titleObj?: { readonly str?: string };
  readonly color?: Uint8ClampedArray | null;
  readonly file?: { readonly filename?: string };
  readonly richMedia?: { readonly filename?: string };
  readonly rect: readonly number[];
  readonly url?: string | null;
  /** The address as the file has it, and the words that lie under the annotation. */
  readonly unsafeUrl?: string | null;
  readonly overlaidText?: string;
  readonly dest?: unknown;
  readonly action?: string | null;
  readonly contentsObj?: { readonly str?: string };
  readonly hidden?: boolean;
  readonly readOnly?: boolean;
  readonly fieldType?: string | null;
  readonly fieldName?: string;
  readonly fieldValue?: unknown;
  readonly alternativeText?: string;
  readonly pushButton?: boolean;
  readonly checkBox?: boolean;
  readonly radioButton?: boolean;
  readonly password?: boolean;
  readonly exportValue?: string;
  readonly buttonValue?: string | null;
  readonly options?: readonly { readonly exportValue?: string; readonly displayValue?: string }[];
  readonly multiSelect?: boolean;
  readonly multiLine?: boolean;
  readonly maxLen?: number;
}

/** Flags of an annotation that is not seen: hidden, and printed alone. */
const unseen = 0x02 | 0x20;

/** Returns whether an annotation is seen on the screen. */
export const isSeen = ({ annotationFlags = 0 }: Annotation): boolean =>
  (annotationFlags & unseen) === 0;

/** The links of a page, and what those are called that lead nowhere. */
interface FoundLinks {
  readonly links: readonly PageLink[];
  readonly lost: readonly string[];
}

/** Returns the links of a page, buttons that lead somewhere too. Rejects as pdf.js does. */
export async function linksOfPage(page: PDFPageProxy, targets: PdfTargets): Promise<FoundLinks> {
  const isLink = ({ subtype, pushButton }: Annotation) => subtype === "Link" || pushButton === true;
  const all = await annotationsOf(page, (one) => isSeen(one) && isLink(one));
  const lost: string[] = [];
  const found = all.map(async (one): Promise<PageLink | null> => {
    const to = await targets.of(one, page.pageNumber);
    const box = boxOf(page, one);
    if (box && !to && !isTurn(one.action)) lost.push(calledOf(one));
    return (
      to && box && { ...box, title: cleanText(one.contentsObj?.str || one.alternativeText), to }
    );
  });
  return { links: (await Promise.all(found)).filter((link) => link !== null), lost };
}

/** Returns what a link is called: by itself, by the words under it, or by what it asks for. */
function calledOf(one: Annotation): string {
  const names = [one.contentsObj?.str, one.alternativeText, one.overlaidText, one.unsafeUrl];
  return [...names, one.action].map((name) => cleanText(name)).find((name) => name !== "") ?? "";
}

/** The values of a document's fields, kept where pdf.js draws and saves them from. */
export class PdfForm {
  #storage: PDFDocumentProxy["annotationStorage"];
  readonly #widgets = new Map<string, Map<string, PageField>>();
  readonly #values = new Map<string, string>();

  constructor(document: PDFDocumentProxy) {
    this.#storage = document.annotationStorage;
  }

  /** Goes on with the same document, opened anew. */
  moveTo(document: PDFDocumentProxy): void {
    this.#storage = document.annotationStorage;
    for (const [name, value] of this.#values) this.#storeAll(name, value);
  }

  /** Whether the value of a field differs from its file's. */
  get isFilled(): boolean {
    return this.#values.size > 0;
  }

  /**
   * Returns the fields of a page: text, check boxes, radio buttons and choices.
   * Rejects as pdf.js does.
   */
  async fieldsOf(page: PDFPageProxy): Promise<PageField[]> {
    const all = await annotationsOf(page, (one) => one.subtype === "Widget" && !one.hidden);
    return all.flatMap((one) => {
      const kind = kindOf(one);
      const box = boxOf(page, one);
      if (!kind || !box) return [];
      const field = fieldOf(one, kind, box);
      const views = this.#widgets.get(field.name) ?? new Map<string, PageField>();
      this.#widgets.set(field.name, views.set(one.id, field));
      const value = this.#values.get(field.name);
      if (value === undefined) return [field];
      this.#store(one.id, field, value);
      return [{ ...field, value: field.on !== "" && field.on !== value ? "" : value }];
    });
  }

  /** Sets the value of a field, in every view of it. */
  fill(name: string, value: string): void {
    const held = value.slice(0, limits.fieldLength);
    this.#values.set(name, held);
    this.#storeAll(name, held);
  }

  #storeAll(name: string, value: string): void {
    for (const [id, field] of this.#widgets.get(name) ?? []) this.#store(id, field, value);
  }

  #store(id: string, { kind, on }: PageField, value: string): void {
    const isSwitch = kind === "check" || kind === "radio";
    this.#storage.setValue(id, { value: isSwitch ? value !== "" && value === on : value });
  }
}

/** Annotations of pages, which pdf.js sends anew whenever it is asked. */
const sent = new WeakMap<PDFPageProxy, Promise<readonly Annotation[]>>();

/** Returns a page's annotations of some kind, in their order. Rejects as pdf.js does. */
export async function annotationsOf(
  page: PDFPageProxy,
  isWanted: (one: Annotation) => boolean,
): Promise<Annotation[]> {
  let all = sent.get(page);
  if (all === undefined) {
    all = page.getAnnotations().then((some: Annotation[]) => some.slice(0, limits.annotations));
    sent.set(page, all);
    all.catch(() => sent.delete(page));
  }
  return (await all).filter(isWanted);
}

/** Returns where an annotation lies on its page; null if it lies nowhere. */
export function boxOf(page: PDFPageProxy, { rect }: Annotation): PageBox | null {
  const [a, b, c, d, e, f] = page.getViewport({ scale: 1 }).transform as readonly number[];
  const [x1, x2] = [a * rect[0] + c * rect[1] + e, a * rect[2] + c * rect[3] + e];
  const [y1, y2] = [b * rect[0] + d * rect[1] + f, b * rect[2] + d * rect[3] + f];
  const box = {
    x: Math.min(x1, x2),
    y: Math.min(y1, y2),
    width: Math.abs(x2 - x1),
    height: Math.abs(y2 - y1),
  };
  return isPageBox(box) ? box : null;
}

function kindOf(one: Annotation): PageField["kind"] | null {
  if (one.fieldType === "Tx") return one.password ? null : "text";
  if (one.fieldType === "Ch") return one.multiSelect ? null : "choice";
  if (one.fieldType !== "Btn") return null;
  return one.checkBox ? "check" : one.radioButton ? "radio" : null;
}

function fieldOf(one: Annotation, kind: PageField["kind"], box: PageBox): PageField {
  const most = limits.fieldLength;
  const said = Array.isArray(one.fieldValue) ? one.fieldValue[0] : one.fieldValue;
  const held = typeof said === "string" ? said.slice(0, most) : "";
  const on = cleanText((kind === "check" ? one.exportValue : one.buttonValue) ?? "");
  const isSwitch = kind === "check" || kind === "radio";
  const options = (one.options ?? []).slice(0, limits.options).map((option) => ({
    value: cleanText(option.exportValue),
    label: cleanText(option.displayValue),
  }));
  return {
    ...box,
    kind,
    name: cleanText(one.fieldName),
    title: cleanText(one.alternativeText) || cleanText(one.fieldName),
    value: isSwitch && held !== on ? "" : held,
    on: isSwitch ? on : "",
    options: kind === "choice" ? options : [],
    multiline: one.multiLine === true,
    readonly: one.readOnly === true,
    maxLength: Math.min(Math.max(Math.floor(Number(one.maxLen)) || 0, 0), most),
  };
}
