/** IIIF's Presentation API 2 and 3: a manifest as a book. */

import { metresOf } from "../../metres.ts";
import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { isRecord } from "../manifest_checks.ts";
import {
  type BookDetail,
  BookError,
  type BookWarning,
  type OutlineEntry,
  type PageBox,
  type PageSize,
} from "../page_source.ts";
import { serviceOf } from "./image_service.ts";
import {
  addressOf,
  behaviorsOf,
  boxAround,
  boxIn,
  idOf,
  lengthOf,
  objectsIn,
  referencesIn,
  stringsIn,
  textIn,
  typeOf,
  type Value,
} from "./values.ts";

/** An image on a canvas. */
export interface PaintedImage {
  /** Its own address; "" if it has only a service. */
  readonly src: string;
  /** The address of its Image API; "" if it has none. */
  readonly service: string;
  /** The part of the image that is shown, in its pixels; null for all of it. */
  readonly crop: PageBox | null;
  /** By how many quarters it is turned clockwise, after it was cut. */
  readonly turns: 0 | 1 | 2 | 3;
  /** Where it is on the canvas. */
  readonly on: PageBox;
}

/** A page: a canvas, or a half of one that shows two facing pages. */
export interface CanvasPage {
  readonly canvas: PageSize;
  /** The part of the canvas that is this page, in its unit. */
  readonly part: PageBox;
  readonly label: string;
  readonly inSpread?: "first" | "second" | "alone";
  readonly images: readonly PaintedImage[];
  /** The types of what else is painted on it, such as "Video". */
  readonly others: readonly string[];
  /** How many images there are to choose from besides those that are shown. */
  readonly choices: number;
  /** Pages of annotations, here or by their address. */
  readonly annotations: readonly Value[];
  /** Reads it anew once its canvas is whole; absent if it is. */
  readonly unread?: UnreadCanvas;
}

/** A canvas some of whose parts are known by their addresses alone, or whose size is not known. */
export interface UnreadCanvas {
  readonly canvas: Value;
  /** Which of its pages this is, from 0. */
  readonly half: number;
  /** Returns its pages. */
  read(canvas: Value): readonly CanvasPage[];
}

/** A manifest, checked. */
export interface PresentedBook {
  readonly name: string;
  readonly title: string;
  readonly direction: "ltr" | "rtl";
  readonly edge?: "top" | "bottom";
  readonly layout?: "single";
  readonly openingPage?: number;
  /** Metres in a unit of its canvases, if it says so. */
  readonly metres?: number | undefined;
  readonly details: readonly BookDetail[];
  readonly outline: readonly OutlineEntry[];
  readonly pages: readonly CanvasPage[];
  /** The number of a canvas's first page, from 1, by its address. */
  readonly numbers: ReadonlyMap<string, number>;
  /** What it lists besides pages and is not shown. */
  readonly warnings: readonly BookWarning[];
  /** Its absolute address, the base of relative ones in it. */
  readonly base: string;
}

/** Maximum of images on a canvas, of pages of annotations, and of lines about the book. */
const mostImages = 200;
const mostLists = 5;
const mostDetails = 60;

/** Size of a canvas that has none. */
const usualSize: PageSize = { width: 1000, height: 1414 };

/** The context of what was IIIF's Metadata API, the first version of Presentation. */
const version1 = /shared-canvas\.org\/ns\/context|iiif\.io\/api\/presentation\/1\b/;

/** Returns whether a manifest is of Presentation 1, whose canvases are as those of version 2. */
function isOfVersion1(value: Value): boolean {
  return stringsIn(value["@context"]).some((one) => version1.test(one));
}

/** How a manifest is read. */
interface Reading {
  readonly base: string;
  readonly languages: readonly string[];
}

/**
 * Checks a manifest, or the information about a single image. What cannot be
 * understood in it is left out. Throws a `BookError` if it has no pages.
 *
 * @param name the manifest's name in sentences
 * @param languages of the reader, the best first
 */
export function parsePresentation(
  value: Value,
  base: string,
  name: string,
  languages: readonly string[],
): PresentedBook {
  const reading = { base, languages };
  const type = typeOf(value);
  if (type === "Collection") throw ofCollection(value, name, reading);
  if (/^Annotation/.test(type)) {
    throw new BookError(`${name} has notes about a book; open the manifest of the book.`, {
      code: "unsupported",
      source: name,
    });
  }
  const manifest = manifestOf(value, type, base);
  const sequences = objectsIn(manifest.sequences ?? [], mostLists);
  const sequence = sequences.find(({ canvases }) => canvases) ?? sequences[0] ?? {};
  const listed = manifest.items ?? sequence.canvases;
  const count = Array.isArray(listed) ? listed.length : 0;
  if (count > limits.pages) {
    throw new BookError(
      `${name} lists ${count} canvases; split it into books of at most ${limits.pages}.`,
      { code: "tooLarge", source: name },
    );
  }
  const canvases = objectsIn(listed ?? []);
  if (canvases.length === 0 && isOfVersion1(value)) {
    throw new BookError(
      `${name} is of version 1 of IIIF's Presentation API, and lists no pages as that has them; ask its owner for one of version 2 or 3.`,
      { code: "unsupported", source: name },
    );
  }
  if (canvases.length === 0)
    throw new BookError(`${name} lists no pages; open another book.`, {
      code: "empty",
      source: name,
    });
  const [way = ""] = [
    ...stringsIn(sequence.viewingDirection),
    ...stringsIn(manifest.viewingDirection),
  ];
  const isReversed = way === "right-to-left";
  const pagesOf = canvases.map((canvas, index) => readCanvas(canvas, index, isReversed, reading));
  const pages = pagesOf.flat();
  // By a canvas's address, the number of its first page.
  const numbers = new Map<string, number>();
  let number = 1;
  for (const [index, canvas] of canvases.entries()) {
    const id = canvasOf(canvas);
    // Of several that have one address the first is meant; that of one without an address is none.
    if (id !== "" && !numbers.has(id)) numbers.set(id, number);
    number += pagesOf[index]?.length ?? 0;
  }
  const behaviors = [...behaviorsOf(manifest), ...behaviorsOf(sequence)];
  const isSingle = behaviors.some((one) => /^(individuals|continuous|unordered)$/.test(one));
  const openingPage = numbers.get(
    canvasOf(manifest.start ?? sequence.startCanvas ?? manifest.startCanvas),
  );
  return {
    name,
    title: textIn(manifest.label, languages) || name,
    direction: isReversed ? "rtl" : "ltr",
    ...(way === "top-to-bottom" ? { edge: "top" as const } : {}),
    ...(way === "bottom-to-top" ? { edge: "bottom" as const } : {}),
    ...(isSingle ? { layout: "single" as const } : {}),
    ...(openingPage === undefined ? {} : { openingPage }),
    metres: metresInUnit(canvases[0]) ?? metresInUnit(manifest),
    details: readDetails(manifest, canvases, reading),
    warnings: otherOrders(manifest, sequence, name, languages),
    numbers,
    outline: readRanges(manifest.structures, numbers, languages),
    pages: pages.slice(0, limits.pages),
    base,
  };
}

/** Returns warnings of sequences, or ranges that stand for them, besides the one whose pages are shown. */
function otherOrders(
  manifest: Value,
  shown: Value,
  name: string,
  languages: readonly string[],
): BookWarning[] {
  const sequences = objectsIn(manifest.sequences ?? []).filter((one) => one !== shown);
  const ranges = objectsIn(manifest.structures ?? [], limits.outlineEntries).filter((range) =>
    behaviorsOf(range).includes("sequence"),
  );
  return [...sequences, ...ranges].slice(0, limits.warnings).map((one) => {
    const source = textIn(one.label, languages) || cleanText(idOf(one)) || "–";
    const message = `${source}, another sequence of pages of ${name}, is not shown.`;
    return { code: "page", message, source };
  });
}

/** Returns the metres in a unit of a canvas by its service Physical Dimensions; undefined without one. */
function metresInUnit({ service, services }: Value = {}): number | undefined {
  for (const one of [
    ...objectsIn(service ?? [], mostLists),
    ...objectsIn(services ?? [], mostLists),
  ]) {
    const { profile, physicalScale, physicalUnits } = one;
    if (typeof profile !== "string" || !profile.includes("/services/physdim")) continue;
    return metresOf(Number(physicalScale), String(physicalUnits));
  }
  return undefined;
}

/** Returns what lists the pages: for one canvas, or what is known of one image, the manifest of it. */
function manifestOf(value: Value, type: string, base: string): Value {
  if (type === "Canvas") return { items: [value] };
  return lengthOf(value.width) > 0 && type !== "Manifest" ? imageAlone(value, base) : value;
}

/** Returns the manifest of one image. */
function imageAlone(info: Value, base: string): Value {
  const id = idOf(info) || base.replace(/\/info\.json$/, "");
  const { width, height } = info;
  const body = { id: `${id}/full/max/0/default.jpg`, service: [{ id, type: "ImageService3" }] };
  return { items: [{ id, width, height, items: [{ items: [{ body }] }] }] };
}

function ofCollection(value: Value, name: string, { base, languages }: Reading): BookError {
  const members = [value.items, value.manifests, value.members, value.collections];
  const listed = members.flatMap((list) => objectsIn(list ?? [], 10));
  const names = listed.slice(0, 3).map((one) => {
    return `${textIn(one.label, languages) || "a book"} (${cleanText(addressOf(one, base), 200)})`;
  });
  const some = names.length > 0 ? `, such as ${names.join(", ")}` : "";
  return new BookError(`${name} is a collection of books; open one of them${some}.`, {
    code: "unsupported",
    source: name,
  });
}

/** Returns the canvas that is meant: itself, or the one that a part of is meant. */
export function canvasOf(value: unknown): string {
  const source = isRecord(value) && "source" in value ? value.source : value;
  return idOf(source).split("#", 1)[0] ?? "";
}

function readCanvas(
  canvas: Value,
  index: number,
  isReversed: boolean,
  reading: Reading,
): CanvasPage[] {
  const all = [
    ...objectsIn(canvas.items ?? []).flatMap((page) => objectsIn(page.items ?? [])),
    ...objectsIn(canvas.images ?? []),
  ];
  const images = all.slice(0, mostImages);
  const [first] = images.map(resourceOf);
  const named = sizeOf(canvas) ?? (first ? sizeOf(first) : null);
  const size = named ?? usualSize;
  const painted = images.map((image) => readImage(image, size, reading));
  const isWhole = (named !== null || images.length === 0) && elsewhere(canvas).length === 0;
  const read = (whole: Value): CanvasPage[] => readCanvas(whole, index, isReversed, reading);
  const unread = (half: number) => (isWhole ? {} : { unread: { canvas, half, read } });
  const page = {
    canvas: size,
    part: { x: 0, y: 0, ...size },
    label:
      cleanText(textIn(canvas.label, reading.languages), limits.labelLength) || String(index + 1),
    images: painted.filter((image) => typeof image !== "string"),
    others: [
      ...painted.filter((image) => typeof image === "string"),
      ...(all.length > mostImages ? [`${all.length - mostImages} more images`] : []),
    ],
    choices: images.reduce((sum, image) => sum + choicesOf(image).length - 1, 0),
    annotations: [
      ...referencesIn(canvas.annotations ?? [], mostLists),
      ...referencesIn(canvas.otherContent ?? [], mostLists),
    ],
  };
  const behaviors = behaviorsOf(canvas);
  if (behaviors.includes("non-paged")) return [{ ...page, ...unread(0), inSpread: "alone" }];
  if (!behaviors.includes("facing-pages")) return [{ ...page, ...unread(0) }];
  const half = { ...page.part, width: size.width / 2 };
  const left = { ...page, part: half };
  const right = { ...page, part: { ...half, x: size.width / 2 } };
  const [one, two] = isReversed ? [right, left] : [left, right];
  return [
    { ...one, ...unread(0), inSpread: "first" },
    { ...two, ...unread(1), inSpread: "second" },
  ];
}

/** Returns what is painted on a canvas and known by its address alone: pages of annotations, or annotations. */
export function elsewhere(canvas: Value): Value[] {
  const listed = (list: unknown): Value[] =>
    Array.isArray(list) ? referencesIn(list, mostImages) : [];
  const pages = listed(canvas.items).filter(({ items }) => !items);
  const images = listed(canvas.images).filter(({ resource }) => !resource);
  return [...pages, ...images].filter((one) => idOf(one) !== "");
}

/** Returns a canvas with such parts as they were fetched, and of the size of an image if it has none. */
export function wholeCanvas(
  canvas: Value,
  fetched: ReadonlyMap<string, Value>,
  size: PageSize | null = null,
): Value {
  const whole = (list: unknown): Value[] =>
    referencesIn(list ?? [], mostImages).map((one) => fetched.get(idOf(one)) ?? one);
  const { width, height } = sizeOf(canvas) ?? size ?? {};
  return { ...canvas, items: whole(canvas.items), images: whole(canvas.images), width, height };
}

function sizeOf(value: Value): PageSize | null {
  const [width, height] = [lengthOf(value.width), lengthOf(value.height)];
  return width > 0 && height > 0 ? { width, height } : null;
}

/** Returns what an annotation may paint: of a choice all, the first first. */
function choicesOf(annotation: Value): Value[] {
  const [body = {}] = referencesIn(annotation.body ?? annotation.resource ?? [], 1);
  if (typeOf(body) !== "Choice") return [body];
  const all = [body.default, body.items ?? body.item].flatMap((list) =>
    referencesIn(list ?? [], mostImages),
  );
  // Version 2 has the word for no image at all among them.
  const chosen = all.filter((one) => idOf(one) !== "rdf:nil");
  return chosen.length > 0 ? chosen : [{}];
}

/** Returns what an annotation paints: of a choice, the first. */
function resourceOf(annotation: Value): Value {
  return choicesOf(annotation)[0] as Value;
}

/** Returns the image that an annotation paints; the type of what it paints if that is none. */
function readImage(annotation: Value, size: PageSize, { base }: Reading): PaintedImage | string {
  const resource = resourceOf(annotation);
  const [source = {}] = referencesIn(resource.source ?? resource.full ?? resource, 1);
  const [selector] = objectsIn(resource.selector ?? [], 1);
  const service = addressOf(serviceOf(source) || serviceOf(resource), base);
  const src = addressOf(source, base);
  const [format = ""] = stringsIn(source.format);
  const isImage =
    typeOf(source) === "Image" ||
    format.startsWith("image/") ||
    /\.(jpe?g|png|gif|webp|avif|svg)([?#]|$)/i.test(src);
  if (service === "" && !isImage) return cleanText(typeOf(source)) || cleanText(format) || src;
  const [fragment = ""] = stringsIn(selector?.value);
  const region = selector ? `xywh=${stringsIn(selector.region)[0] ?? ""}` : src;
  return {
    src,
    service: service.replace(/\/$/, ""),
    crop: boxIn(fragment || region, limits.pageSide, limits.pageSide),
    turns: turnsOf(selector?.rotation),
    on: targetBox(annotation.target ?? annotation.on, size) ?? { x: 0, y: 0, ...size },
  };
}

/** Returns the quarters of a rotation in degrees; 0 for other angles and mirrored images. */
function turnsOf(rotation: unknown): PaintedImage["turns"] {
  const quarters = ["0", "90", "180", "270"].indexOf(String(rotation));
  return quarters === 1 || quarters === 2 || quarters === 3 ? quarters : 0;
}

/** Returns the box on a canvas that an annotation is about; null for all of it. */
export function targetBox(target: unknown, { width, height }: PageSize): PageBox | null {
  const [object] = objectsIn(target, 1);
  if (!object) return boxIn(stringsIn(target)[0] ?? "", width, height);
  const selectors = objectsIn(object.selector ?? [], 5).flatMap((one) => [
    one,
    ...objectsIn(one.default ?? [], 1),
  ]);
  for (const selector of selectors) {
    const [value = ""] = stringsIn(selector.value ?? selector.chars);
    const box = boxIn(value, width, height) ?? boxAround(value, width, height);
    if (box) return box;
  }
  return boxIn(idOf(object) || idOf(object.source ?? object.full), width, height);
}

function readDetails(
  manifest: Value,
  canvases: readonly Value[],
  { base, languages }: Reading,
): BookDetail[] {
  const details: BookDetail[] = [];
  const add = (label: unknown, value: unknown, href = ""): void => {
    const text =
      typeof value === "string" && href === value ? cleanText(value) : textIn(value, languages);
    if (text === "" || details.length >= mostDetails) return;
    details.push({ label: textIn(label, languages), value: text, ...(href ? { href } : {}) });
  };
  for (const { label, value } of objectsIn(manifest.requiredStatement ?? [], 1)) add(label, value);
  add("", manifest.attribution);
  for (const rights of [manifest.rights, manifest.license].flatMap(stringsIn)) {
    const href = addressOf(rights, base);
    if (href) add("Rights", href, href);
  }
  for (const provider of objectsIn(manifest.provider ?? [], 5)) {
    const [page] = objectsIn(provider.homepage ?? [], 1);
    add("", provider.label, page ? addressOf(page, base) : "");
  }
  add("", manifest.summary ?? manifest.description);
  // Other forms of the book too, such as a PDF.
  for (const list of [manifest.homepage, manifest.related, manifest.rendering]) {
    for (const page of referencesIn(list ?? [], mostLists)) {
      const href = addressOf(page, base);
      if (href) add("", page.label ?? href, href);
    }
  }
  for (const { label, value } of objectsIn(manifest.metadata ?? [], mostDetails)) add(label, value);
  for (const { label, requiredStatement, attribution } of canvases) {
    const [{ value = attribution } = {}] = objectsIn(requiredStatement ?? {}, 1);
    // Those of each page are alike in most books.
    const text = textIn(value, languages);
    if (!details.some((detail) => detail.value === text)) add(label, value);
  }
  return details;
}

/** Returns the contents that ranges are; a range within itself is left out. */
function readRanges(
  structures: unknown,
  numbers: ReadonlyMap<string, number>,
  languages: readonly string[],
): OutlineEntry[] {
  const listed = objectsIn(structures ?? [], limits.outlineEntries);
  const byId = new Map(listed.map((range) => [idOf(range), range]));
  // Its own canvases before the ranges in it: version 2 lists them apart, and the first one is its page.
  const within = (range: Value): unknown[] =>
    [range.items, range.members, range.canvases, range.ranges].flatMap((list) =>
      Array.isArray(list) ? list.slice(0, limits.outlineEntries) : [],
    );
  const inner = new Set(listed.flatMap(within).map(idOf));
  const roots = listed.filter((range) => !inner.has(idOf(range)));
  let left: number = limits.outlineEntries;
  const seen = new Set<Value>();
  const read = (range: Value, depth: number): OutlineEntry[] => {
    const isHidden = behaviorsOf(range).some((one) => one === "sequence" || one === "no-nav");
    if (isHidden || seen.has(range) || left <= 0 || depth > limits.outlineDepth) return [];
    seen.add(range);
    left -= 1;
    const children: OutlineEntry[] = [];
    let page: number | null = null;
    for (const item of within(range)) {
      const child =
        byId.get(idOf(item)) ?? (isRecord(item) && typeOf(item) === "Range" ? item : null);
      const inside = child ? read(child, depth + 1) : [];
      children.push(...inside);
      page ??= child ? firstPage(inside) : (numbers.get(canvasOf(item)) ?? null);
    }
    const title = textIn(range.label, languages);
    return title === "" ? children : [{ title, page, children }];
  };
  const lines = roots.flatMap((range) => read(range, 1));
  // One that holds all others is the contents' own title.
  const [only] = lines;
  return lines.length === 1 && only && only.children.length > 0 ? [...only.children] : lines;
}

function firstPage(entries: readonly OutlineEntry[]): number | null {
  return entries.find((entry) => entry.page !== null)?.page ?? null;
}
