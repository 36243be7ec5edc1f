/** An image server by IIIF, in place of `fetch`, and manifests in the shape of the IIIF cookbook's. */

import { vi } from "vitest";

/** The address under which it serves. */
export const server = "https://iiif.example";

/** What the server has of an image. */
export interface ServedImage {
  readonly width: number;
  readonly height: number;
  /** The members of its info.json besides those of every image. */
  readonly info?: Readonly<Record<string, unknown>>;
}

const quarters = ["#f00", "#0f0", "#00f", "#ff0"] as const;

/**
 * Serves images, by their names, and JSON files, by their paths. An image's
 * quarters are red and green, and below them blue and yellow. Returns the paths
 * that are asked for.
 */
export function serve(
  images: Readonly<Record<string, ServedImage>>,
  files: Readonly<Record<string, unknown>> = {},
): string[] {
  const asked: string[] = [];
  vi.spyOn(globalThis, "fetch").mockImplementation(async (input) => {
    const path = String(input).slice(server.length + 1);
    asked.push(path);
    const file = files[path];
    if (file) return new Response(file instanceof Blob ? file : JSON.stringify(file));
    const [name = "", region = "", size = ""] = path.split("/");
    const image = images[name];
    if (!image) return new Response("", { status: 404 });
    if (region === "info.json") return new Response(JSON.stringify(infoOf(name, image)));
    return new Response(await part(image, region, size));
  });
  return asked;
}

function infoOf(name: string, { width, height, info }: ServedImage): object {
  return {
    "@context": "http://iiif.io/api/image/3/context.json",
    id: `${server}/${name}`,
    type: "ImageService3",
    protocol: "http://iiif.io/api/image",
    profile: "level1",
    width,
    height,
    ...info,
  };
}

async function part(image: ServedImage, region: string, size: string): Promise<Blob> {
  const all = [0, 0, image.width, image.height];
  const [x, y, width, height] = (region === "full" ? all : region.split(",").map(Number)) as [
    number,
    number,
    number,
    number,
  ];
  const across = /^(full|max)$/.test(size) ? width : Number.parseInt(size, 10);
  const canvas = new OffscreenCanvas(across, Math.max(Math.round((across * height) / width), 1));
  const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.scale(across / width, across / width);
  pen.translate(-x, -y);
  for (const [k, colour] of quarters.entries()) {
    pen.fillStyle = colour;
    const [w, h] = [image.width / 2, image.height / 2];
    pen.fillRect((k % 2) * w, (k >> 1) * h, w, h);
  }
  return await canvas.convertToBlob();
}

/** A canvas with one annotation that paints. */
export interface Canvas3 {
  readonly items: readonly { readonly items: readonly { readonly body: object }[] }[];
}

/** Returns a canvas of Presentation 3 that an image with a service fills. */
export function canvas3(name: string, more: object = {}, body: object = {}): Canvas3 {
  const id = `${server}/canvas/${name}`;
  const service = [{ id: `${server}/${name}`, type: "ImageService3", profile: "level1" }];
  const image = { id: `${server}/${name}/full/max/0/default.jpg`, type: "Image", service, ...body };
  const annotation = { type: "Annotation", motivation: "painting", body: image, target: id };
  const items = [{ type: "AnnotationPage", items: [annotation] }];
  const label = { none: [name] };
  const canvas = { id, type: "Canvas", width: 1000, height: 1500, label, items, ...more };
  return canvas;
}

/** Returns a manifest of Presentation 3. */
export function manifest3(items: readonly object[], more: object = {}): object {
  const context = "http://iiif.io/api/presentation/3/context.json";
  const label = { en: ["A Book"], fr: ["Un livre"] };
  return { "@context": context, id: `${server}/m.json`, type: "Manifest", label, items, ...more };
}

/** Returns a canvas of Presentation 2. */
export function canvas2(name: string, more: object = {}): object {
  const id = `${server}/canvas/${name}`;
  const service = {
    "@context": "http://iiif.io/api/image/2/context.json",
    "@id": `${server}/${name}`,
    profile: "http://iiif.io/api/image/2/level2.json",
  };
  const resource = {
    "@id": `${server}/${name}/full/full/0/default.jpg`,
    "@type": "dctypes:Image",
    service,
  };
  const images = [{ "@type": "oa:Annotation", motivation: "sc:painting", resource, on: id }];
  return {
    "@id": id,
    "@type": "sc:Canvas",
    width: 1000,
    height: 1500,
    label: name,
    images,
    ...more,
  };
}

/** Returns a manifest of Presentation 2. */
export function manifest2(
  canvases: readonly object[],
  more: object = {},
  sequence: object = {},
): object {
  const context = "http://iiif.io/api/presentation/2/context.json";
  const sequences = [{ "@type": "sc:Sequence", canvases, ...sequence }];
  return {
    "@context": context,
    "@id": `${server}/m.json`,
    "@type": "sc:Manifest",
    label: "A Book",
    sequences,
    ...more,
  };
}
