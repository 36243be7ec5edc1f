/** KF8, as in AZW3: sections of XHTML, each a skeleton and fragments that are put into it. */

import { dataUrl } from "../data_url.ts";
import { isPageSize, limits } from "../limits.ts";
import { type CleanSheet, cleanCss } from "../markup/clean_css.ts";
import { cleanMarkup, type MarkupFiles } from "../markup/clean_markup.ts";
import { checkedData } from "../markup/data_address.ts";
import { parseMarkup } from "../markup/parse_markup.ts";
import { readMarkup } from "../markup/read_markup.ts";
import type { PageSize } from "../page_source.ts";
import type { FlowContent, FlowSection, FlowTarget } from "../typeset/flow_book.ts";
import { coverSection, lonePicture } from "../typeset/lone_picture.ts";
import { linesIn } from "../typeset/page_estimate.ts";
import { mark } from "./kindle_header.ts";
import { type KindleParts, type KindleText, outlineOf } from "./kindle_text.ts";
import { damaged } from "./palm_database.ts";

/** Bytes that are moved to put fragments in, for one section. */
const mostMoved = 2_000_000_000;

/** Pictures within one drawing. */
const mostEmbedded = 100;

const resource = /^kindle:(flow|embed):([0-9a-v]{1,8})(?:\?mime=([\w/.+-]+))?/i;
const embedded = /kindle:embed:([0-9a-v]{1,8})(?:\?mime=[\w/.+-]+)?/gi;
const place = /^kindle:pos:fid:([0-9a-v]{1,8}):off:([0-9a-v]{1,10})/i;

/** A place as links are kept: a fragment, as other schemes are cleaned away. */
const keptPlace = /^#kindle-([0-9a-v]{1,8})-([0-9a-v]{1,10})$/i;

/** A place in its own section, by its name, as such a link is kept. */
const keptName = /^#kindle-in-(\d{1,9})-(.+)$/;

/** A piece of a section. */
interface Fragment {
  /** The number by which links name it. */
  readonly index: number;
  /** Where it goes, in bytes of the text as it is when its turn comes. */
  readonly insertAt: number;
  /** Where it is, in bytes of the text as it is stored, and its length. */
  readonly from: number;
  readonly length: number;
}

/** A section: a skeleton, directly followed by its fragments. */
interface Skeleton {
  readonly from: number;
  readonly length: number;
  readonly fragments: readonly Fragment[];
}

/** Reads the text of a KF8. Rejects with a `BookError`. */
export async function openKf8(book: KindleParts): Promise<KindleText> {
  const { text, header, name, resources } = book;
  const skeletons = await skeletonsOf(book);
  const flows = await flowsOf(book);
  const decoder = new TextDecoder(header.encoding);
  const flow = (digits: string): string => {
    const [from, to] = flows[Number.parseInt(digits, 32)] ?? [0, 0];
    return decoder.decode(text.subarray(from, to));
  };
  const embeddedData = (digits: string) => resources.data(Number.parseInt(digits, 32) - 1);
  const data = async (address: string): Promise<string | null> => {
    const [, kind, digits = "", type] = resource.exec(address) ?? [];
    if (kind === undefined) return await checkedData(address);
    if (kind.toLowerCase() === "embed") return await embeddedData(digits);
    if (type !== "image/svg+xml") return null;
    // A drawing in an <img> loads nothing: what is in it goes into it.
    const drawing = flow(digits);
    if (drawing === "") return null;
    const inner = new Map<string, string>();
    for (const [, one = ""] of [...drawing.matchAll(embedded)].slice(0, mostEmbedded)) {
      if (!inner.has(one)) inner.set(one, (await embeddedData(one)) ?? "data:,");
    }
    const whole = drawing.replace(embedded, (_, one: string) => inner.get(one) ?? "data:,");
    return await dataUrl(new TextEncoder().encode(whole), "image/svg+xml");
  };
  const styles = new Map<number, Promise<CleanSheet>>();
  const files: MarkupFiles = {
    data,
    style: async (address) => {
      const [, kind, digits = ""] = resource.exec(address) ?? [];
      if (kind?.toLowerCase() !== "flow") return [];
      const number = Number.parseInt(digits, 32);
      const isThere = flows[number] !== undefined;
      const style = styles.get(number) ?? (isThere ? cleanCss(flow(digits), data) : lost(address));
      styles.set(number, style);
      return [await style];
    },
  };
  const size = header.isFixed ? sizeOf(header.resolution) : null;
  const isCover = async (skeleton: Skeleton): Promise<boolean> => {
    const markup = decoder.decode(assembled(text, skeleton, name));
    const { document } = await readMarkup(markup, "application/xhtml+xml");
    return lonePicture(document.documentElement) !== null;
  };
  const load = async (skeleton: Skeleton): Promise<FlowContent> => {
    const markup = decoder.decode(assembled(text, skeleton, name));
    const { document } = await readMarkup(markup, "application/xhtml+xml");
    for (const element of document.querySelectorAll("[aid]:not([id]), a[name]:not([id])")) {
      element.id = element.getAttribute("name") ?? `aid-${element.getAttribute("aid")}`;
    }
    for (const link of document.querySelectorAll("a[href]")) {
      const href = link.getAttribute("href") ?? "";
      const [, index, offset] = place.exec(href) ?? [];
      if (index && offset) link.setAttribute("href", `#kindle-${index}-${offset}`);
      else if (/^#./.test(href)) {
        link.setAttribute("href", `#kindle-in-${skeletons.indexOf(skeleton)}-${href.slice(1)}`);
      }
    }
    const content = await cleanMarkup(document, files, `A chapter of ${name}`);
    return size ? { ...content, size } : content;
  };
  const isFirst = size === null && skeletons[0] !== undefined && (await isCover(skeletons[0]));
  const isBefore = size === null && !isFirst && header.cover !== null;
  const sectionOf = new Map<number, number>();
  const fragments = new Map<number, Fragment>();
  skeletons.forEach((skeleton, section) => {
    for (const fragment of skeleton.fragments) {
      sectionOf.set(fragment.index, section + (isBefore ? 1 : 0));
      fragments.set(fragment.index, fragment);
    }
  });
  const targetOf = (index: number, offset: number): FlowTarget | null => {
    const section = sectionOf.get(index);
    const fragment = fragments.get(index);
    if (section === undefined || !fragment) return null;
    const from = Math.min(fragment.from + offset, fragment.from + fragment.length);
    const after = text.subarray(from, Math.min(fragment.from + fragment.length, from + 4096));
    return { section, id: offset === 0 && index === 0 ? "" : idIn(decoder.decode(after)) };
  };
  const resolve = (href: string): FlowTarget | null => {
    const [, section, id] = keptName.exec(href) ?? [];
    if (section !== undefined && id !== undefined) {
      return { section: Number(section) + (isBefore ? 1 : 0), id };
    }
    const [, index, offset] = keptPlace.exec(href) ?? [];
    if (index === undefined || offset === undefined) return null;
    return targetOf(Number.parseInt(index, 32), Number.parseInt(offset, 32));
  };
  const table =
    header.contents === null ? null : await book.table(header.contents).catch(() => null);
  const outline = table
    ? outlineOf(table, (numbers) => {
        const [index, offset = 0] = numbers(6);
        return index === undefined ? null : targetOf(index, offset);
      })
    : [];
  const sections = skeletons.map((skeleton, index): FlowSection => {
    if (index === 0 && isFirst) return coverSection(() => load(skeleton));
    const length = skeleton.fragments.reduce((sum, one) => sum + one.length, skeleton.length);
    return {
      length,
      isFixed: size !== null,
      lines: async () => linesIn(decoder.decode(assembled(text, skeleton, name))),
      load: () => load(skeleton),
    };
  });
  if (isBefore) {
    const digits = ((header.cover ?? 0) + 1).toString(32).padStart(4, "0");
    const markup = `<html><body><img src="kindle:embed:${digits}" alt=""></body></html>`;
    const cover = coverSection(() =>
      cleanMarkup(parseMarkup(markup, "text/html"), files, `The cover of ${name}`),
    );
    sections.unshift(cover);
  }
  return { sections, outline, resolve, ...(size ? {} : { isCovered: isFirst || isBefore }) };
}

/** Returns what stands for a style sheet that is not there. */
async function lost(source: string): Promise<CleanSheet> {
  return { namespaces: "", rules: "", lost: [{ code: "style", source }] };
}

/** Returns the sections that have something in them. */
async function skeletonsOf({ header, table, text, name }: KindleParts): Promise<Skeleton[]> {
  if (header.skeletons === null) throw damaged(name);
  const rows = (await table(header.skeletons)).entries;
  const pieces = header.fragments === null ? [] : (await table(header.fragments)).entries;
  const skeletons: Skeleton[] = [];
  let next = 0;
  for (const { numbers } of rows.slice(0, limits.pages)) {
    const [count = 0, from = 0, length = 0] = [numbers(1)[0], ...numbers(6)];
    if (from + length > text.length) throw damaged(name);
    let at = from + length;
    const fragments = pieces.slice(next, next + count).map((piece): Fragment => {
      const own = piece.numbers(6)[1] ?? 0;
      const index = piece.numbers(4)[0] ?? 0;
      const fragment = { index, insertAt: Number.parseInt(piece.name, 10), from: at, length: own };
      at += own;
      return fragment;
    });
    next += count;
    if (at > text.length) throw damaged(name);
    if (fragments.length > 0) skeletons.push({ from, length, fragments });
  }
  return skeletons;
}

/** Returns where the text and each style sheet and drawing begin and end ("FDST"). */
async function flowsOf({ header, read, text }: KindleParts): Promise<[number, number][]> {
  if (header.flows === null) return [];
  const bytes = await read(header.flows).catch(() => new Uint8Array());
  const view = new DataView(bytes.buffer);
  if (bytes.length < 12 || view.getUint32(0) !== mark("FDST")) return [];
  const count = Math.min(view.getUint32(8), Math.floor((bytes.length - 12) / 8));
  return Array.from({ length: count }, (_, k) => {
    const [from, to] = [view.getUint32(12 + 8 * k), view.getUint32(16 + 8 * k)];
    return from <= to && to <= text.length ? [from, to] : [0, 0];
  });
}

/** Returns a section's bytes: each fragment is put in where it says, into what is there by then. */
function assembled(
  text: Uint8Array,
  { from, length, fragments }: Skeleton,
  name: string,
): Uint8Array<ArrayBuffer> {
  const whole = new Uint8Array(fragments.reduce((sum, one) => sum + one.length, length));
  whole.set(text.subarray(from, from + length));
  let filled = length;
  let moved = 0;
  for (const fragment of fragments) {
    const at = fragment.insertAt - from;
    if (!(at >= 0 && at <= filled)) throw damaged(name);
    moved += filled - at;
    if (moved > mostMoved) throw damaged(name);
    whole.copyWithin(at + fragment.length, at, filled);
    whole.set(text.subarray(fragment.from, fragment.from + fragment.length), at);
    filled += fragment.length;
  }
  return whole;
}

/** Returns the id of the element that begins there, or of the next one that has an id; "" if there is none. */
function idIn(markup: string): string {
  const [, name = "", value = ""] =
    /\s(id|name|aid)\s*=\s*["']([^"'<>]{1,200})["']/i.exec(markup) ?? [];
  return name.toLowerCase() === "aid" ? `aid-${value}` : value;
}

/** Returns the size of pages of fixed layout; that of most of them if it is not known. */
function sizeOf(resolution: string): PageSize {
  const [, width, height] = /^(\d{1,5})x(\d{1,5})$/.exec(resolution.trim()) ?? [];
  const size = { width: Number(width), height: Number(height) };
  return isPageSize(size) ? size : { width: 768, height: 1024 };
}
