/** Canvases that say little in the manifest itself, and what cannot be shown of one. */

import { afterEach, expect, test, vi } from "vitest";
import {
  canvas2,
  canvas3,
  manifest2,
  manifest3,
  serve,
  server,
} from "../../for_tests/image_server.ts";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";

const never = new AbortController().signal;
afterEach(() => void vi.restoreAllMocks());

const images = { a: { width: 400, height: 300 }, b: { width: 200, height: 300 } };

async function open(manifest: object, files = {}): Promise<PageSource> {
  serve(images, { "m.json": manifest, ...files });
  return await openSource(`${server}/m.json`);
}

test("a canvas without a size has that of its image, by its service, its file or what is cut out of it", async () => {
  const none = { width: undefined, height: undefined };
  const [file] = [{ service: undefined, id: `${server}/b/full/max/0/default.jpg` }];
  const crop = {
    type: "SpecificResource",
    source: { id: `${server}/a/full/max/0/default.jpg`, type: "Image" },
    selector: { type: "ImageApiSelector", region: "0,0,100,50", rotation: "90" },
  };
  const source = await open(
    manifest3([
      canvas3("a", none),
      canvas3("b", none, file),
      canvas3("a", none, { ...crop, service: undefined }),
      canvas3("a", { ...none, behavior: "facing-pages" }),
    ]),
  );
  const sizes = await Promise.all([0, 1, 2, 3, 4].map((index) => source.size(index)));
  expect(sizes.map(({ width, height }) => [width, height])).toEqual([
    [400, 300],
    [200, 300],
    [50, 100],
    [200, 300],
    [200, 300],
  ]);
  const { width, height } = await source.draw(0, 100, never);
  expect([width, height]).toEqual([100, 75]);
});

test("what is painted and transcribed is found by its address too", async () => {
  const whole = canvas3("a");
  const painted = { id: `${server}/p.json`, type: "AnnotationPage", items: whole.items[0]?.items };
  const said = (text: string) => ({
    motivation: "supplementing",
    body: { type: "TextualBody", value: text },
    target: `${server}/canvas/a#xywh=0,0,100,20`,
  });
  const files = {
    "p.json": painted,
    "t.json": { type: "AnnotationPage", items: [said("one")], next: `${server}/u.json` },
    "u.json": { type: "AnnotationPage", items: [said("two")] },
    "i.json": {
      "@type": "oa:Annotation",
      resource: { "@id": `${server}/a/full/full/0/default.jpg`, "@type": "dctypes:Image" },
    },
  };
  const source = await open(
    manifest3([
      {
        ...whole,
        items: [{ id: `${server}/p.json`, type: "AnnotationPage" }],
        annotations: [`${server}/t.json`, `${server}/gone.json`],
      },
      { ...whole, items: [`${server}/missing.json`] },
    ]),
    files,
  );
  expect((await source.draw(0, 50, never)).width).toBe(50);
  expect((await source.text?.(0, never))?.map(({ text }) => text)).toEqual(["one", "two"]);
  await expect(source.draw(1, 50, never)).rejects.toThrow("Page 2 of m.json was not found");
  expect(source.warnings).toEqual([
    {
      code: "annotation",
      message: `${server}/gone.json, a mark on a page of m.json, has no appearance that can be shown.`,
      source: `${server}/gone.json`,
      page: 1,
    },
  ]);
  const old = await open(manifest2([{ ...canvas2("a"), images: [`${server}/i.json`] }]), files);
  expect((await old.draw(0, 50, never)).width).toBe(50);
});

test("a canvas of a film says so on its page, and lines of the contents that lead nowhere are listed", async () => {
  const film = { type: "Video", format: "video/mp4", service: undefined, id: `${server}/f.mp4` };
  const structures = [
    { id: "r1", type: "Range", label: { en: ["Lost"] }, items: [{ id: "x", type: "Canvas" }] },
    {
      id: "r2",
      type: "Range",
      label: { en: ["Film"] },
      items: [{ id: `${server}/canvas/b`, type: "Canvas" }],
    },
  ];
  const source = await open(manifest3([canvas3("a"), canvas3("b", {}, film)], { structures }));
  await expect(source.draw(1, 50, never)).rejects.toThrow(
    "Page 2 of m.json has no image but what cannot be shown on paper (Video); turn to another.",
  );
  expect(source.warnings?.map(({ code, source: about, page }) => [code, about, page])).toEqual([
    ["contents", "“Lost”", undefined],
    ["page", "b (Video)", 2],
  ]);
});

test("a manifest of Presentation 1 is read, or rejected for its version", async () => {
  const version1 = { "@context": "http://www.shared-canvas.org/ns/context.json" };
  const old = await open({ ...manifest2([canvas2("a")]), ...version1 });
  expect((await old.draw(0, 50, never)).width).toBe(50);
  await expect(open({ ...version1, "@type": "sc:Manifest", "@graph": [] })).rejects.toThrow(
    "m.json is of version 1 of IIIF's Presentation API",
  );
});
