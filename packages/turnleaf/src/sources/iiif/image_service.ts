/** IIIF's Image API 1 to 3: which addresses have the pixels that are wanted. */

import { limits } from "../limits.ts";
import { isRecord } from "../manifest_checks.ts";
import type { PageBox, PageSize } from "../page_source.ts";
import { idOf, objectsIn, pixelsOf, stringsIn, typeOf, type Value } from "./values.ts";

/** What the information about an image says. */
export interface ImageInfo extends PageSize {
  /** Its address, without a slash at its end. */
  readonly id: string;
  readonly version: 1 | 2 | 3;
  /** 0 if it has only the sizes and tiles that it lists. */
  readonly level: 0 | 1;
  /** Maximum of pixels across and of all pixels that the server sends. */
  readonly mostAcross: number;
  readonly mostPixels: number;
  /** Sizes of the whole image that are at hand, the smallest first. */
  readonly sizes: readonly PageSize[];
  readonly tiles: Tiles | null;
}

interface Tiles extends PageSize {
  /** By how much they are made smaller, from 1. */
  readonly factors: readonly number[];
}

/** A part of an image, by the address at which it is. */
export interface ImagePart {
  readonly url: string;
  /** In pixels of the whole image. */
  readonly box: PageBox;
}

/** Maximum of tiles for one picture: of 256 pixels, enough for one of `limits.pixels`. */
const mostTiles = 320;

/**
 * Returns the address of the Image API in a resource's services; "" if it has none. One that does not say
 * what it is, is one if the resource is at an address within its own.
 */
export function serviceOf(resource: Value): string {
  const services = objectsIn(resource.service, 20);
  const found = services.find((service) => {
    const marks = [
      typeOf(service),
      ...stringsIn(service["@context"]),
      ...stringsIn(service.profile),
    ];
    return marks.some((mark) =>
      /ImageService[123]|api\/image\/[123]|image-api|^level[012]$/.test(mark),
    );
  });
  const within = services.find((service) => {
    const id = idOf(service).replace(/\/$/, "");
    return id !== "" && idOf(resource).startsWith(`${id}/`);
  });
  return idOf(found ?? within).replace(/\/$/, "");
}

/** Returns what an info.json says; null if it is about no image. */
export function parseInfo(value: unknown, id: string): ImageInfo | null {
  if (!isRecord(value)) return null;
  const [width, height] = [pixelsOf(value.width), pixelsOf(value.height)];
  if (width === 0 || height === 0) return null;
  const profiles = Array.isArray(value.profile) ? value.profile : [value.profile];
  const more = objectsIn(profiles, 10);
  const bound = (name: string): number =>
    pixelsOf(value[name]) || pixelsOf(more.find((profile) => name in profile)?.[name]);
  const area = value.maxArea ?? more.find((profile) => "maxArea" in profile)?.maxArea;
  const mostAcross = bound("maxWidth");
  const mostDown = bound("maxHeight") || mostAcross;
  return {
    id,
    version: versionOf(value),
    level: stringsIn(profiles).some((profile) => /level0/.test(profile)) ? 0 : 1,
    width,
    height,
    mostAcross: Math.max(
      Math.min(mostAcross || width, (mostDown || height) * (width / height), width),
      1,
    ),
    mostPixels: typeof area === "number" && area > 0 ? area : Number.POSITIVE_INFINITY,
    sizes: objectsIn(value.sizes, 100)
      .map((size) => ({ width: pixelsOf(size.width), height: pixelsOf(size.height) }))
      .filter((size) => size.width > 0 && size.height > 0)
      .sort((a, b) => a.width - b.width),
    tiles: tilesIn(value),
  };
}

function versionOf(info: Value): ImageInfo["version"] {
  const marks = [...stringsIn(info["@context"]), ...stringsIn(info.profile), typeOf(info)];
  if (marks.some((mark) => /image\/3|^ImageService3$/.test(mark))) return 3;
  // Version 1.0 has no context, and its profile is at the same place as that of 1.1.
  return marks.some((mark) => /image-api\/|api\/image\/1/.test(mark)) ? 1 : 2;
}

function tilesIn(value: Value): Tiles | null {
  const [tile] = objectsIn(value.tiles, 1);
  const width = pixelsOf(tile?.width);
  const all = Array.isArray(tile?.scaleFactors) ? tile.scaleFactors.slice(0, 40) : [];
  const factors = all
    .map(pixelsOf)
    .filter((factor) => factor > 0)
    .sort((a, b) => a - b);
  if (width < 16 || factors.length === 0) return null;
  return { width, height: Math.max(pixelsOf(tile?.height) || width, 16), factors };
}

/**
 * Returns the parts that show a box of an image with at least `scale` pixels
 * for each of its own, or with as many as the server has.
 */
export function partsFor(info: ImageInfo, box: PageBox, scale: number): ImagePart[] {
  const wanted = Math.min(scale, 1);
  const isWhole = box.width > 0.9 * info.width && box.height > 0.9 * info.height;
  const most = Math.min(info.mostAcross, Math.sqrt((info.mostPixels * info.width) / info.height));
  const across = Math.ceil(wanted * info.width);
  const size = info.sizes.find(({ width }) => width >= across && width <= most);
  const isAtHand = size !== undefined && size.width <= 2 * across;
  if (info.level === 0) {
    if ((size && isWhole) || (size && isAtHand) || !info.tiles) {
      return [whole(info, size ?? info.sizes.at(-1) ?? null)];
    }
    return tiled(info, info.tiles, box, wanted);
  }
  if (isWhole && across <= most) {
    return [isAtHand ? whole(info, size) : whole(info, { width: across, height: 0 })];
  }
  if (info.tiles) return tiled(info, info.tiles, box, wanted);
  return [regionOf(info, box, Math.min(Math.ceil(wanted * box.width), Math.floor(most)))];
}

/** @param size one of those at hand, or any width with a height of 0; null for the largest */
function whole(info: ImageInfo, size: PageSize | null): ImagePart {
  const box = { x: 0, y: 0, width: info.width, height: info.height };
  const full = info.version === 3 ? "max" : "full";
  const isFull = size === null || (size.width >= info.width && info.level === 0);
  const named = isFull ? full : sizeName(info, size.width, size.height);
  return { url: addressOf(info, "full", named), box };
}

/** Returns the address of an upright JPEG of a region, both by their names in addresses. */
function addressOf({ id, version }: ImageInfo, region: string, size: string): string {
  return `${id}/${region}/${size}/0/${version === 1 ? "native" : "default"}.jpg`;
}

function sizeName({ version }: ImageInfo, width: number, height: number): string {
  return version === 3 && height > 0 ? `${width},${height}` : `${width},`;
}

function regionOf(info: ImageInfo, box: PageBox, across: number): ImagePart {
  const x = Math.floor(box.x);
  const y = Math.floor(box.y);
  const width = Math.min(Math.ceil(box.x + box.width), info.width) - x;
  const height = Math.min(Math.ceil(box.y + box.height), info.height) - y;
  const url = addressOf(info, `${x},${y},${width},${height}`, `${Math.max(across, 1)},`);
  return { url, box: { x, y, width, height } };
}

function tiled(info: ImageInfo, tiles: Tiles, box: PageBox, scale: number): ImagePart[] {
  const sharp = tiles.factors.filter((factor) => 1 / factor >= scale);
  let factor = sharp.at(-1) ?? (tiles.factors[0] as number);
  const count = (by: number): number =>
    (box.width / (tiles.width * by) + 2) * (box.height / (tiles.height * by) + 2);
  // A file that lists many tiny tiles is shown less sharp.
  factor = tiles.factors.find((by) => by >= factor && count(by) <= mostTiles) ?? factor;
  const [wide, high] = [tiles.width * factor, tiles.height * factor];
  const parts: ImagePart[] = [];
  for (let y = Math.floor(box.y / high) * high; y < box.y + box.height; y += high) {
    for (let x = Math.floor(box.x / wide) * wide; x < box.x + box.width; x += wide) {
      if (parts.length >= mostTiles || x >= info.width || y >= info.height) break;
      const [width, height] = [Math.min(wide, info.width - x), Math.min(high, info.height - y)];
      const isAll = width === info.width && height === info.height;
      const region = isAll ? "full" : `${x},${y},${width},${height}`;
      const size = sizeName(info, Math.ceil(width / factor), Math.ceil(height / factor));
      parts.push({
        url: addressOf(info, region, size),
        box: { x, y, width, height },
      });
    }
  }
  return parts;
}

/** Maximum of pixels across that a service has of an image, as one picture. */
export function sharpestWidth(info: ImageInfo): number {
  if (info.level === 1 || info.tiles) return info.width;
  return info.sizes.at(-1)?.width ?? Math.min(info.width, limits.side);
}
