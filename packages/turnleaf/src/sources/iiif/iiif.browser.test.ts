import { afterEach, expect, test, vi } from "vitest";
import {
  canvas2,
  canvas3,
  manifest2,
  manifest3,
  type ServedImage,
  serve,
  server,
} from "../../for_tests/image_server.ts";
import { expectConformance } from "../../for_tests/source_conformance.ts";
import { limits } from "../limits.ts";
import { messageOf } from "../message_of.ts";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";

const never = new AbortController().signal;
afterEach(() => void vi.restoreAllMocks());

const image: ServedImage = { width: 2000, height: 3000 };
const names = ["a", "b", "c", "d"] as const;
const images = Object.fromEntries(names.map((name) => [name, image]));

/** Opens a manifest from the server. */
async function open(manifest: object, served = images, files = {}) {
  const asked = serve(served, { "m.json": manifest, ...files });
  const source = await openSource(`${server}/m.json`);
  return { source, asked };
}

const places = (source: PageSource) =>
  Array.from({ length: source.pageCount }, (_, index) => source.inSpread?.(index));

/** Returns the colours in the middles of a picture's quarters. */
async function colours(
  source: PageSource,
  index: number,
  ...more: [width?: number, region?: object]
) {
  const [width = 40, region] = more;
  const picture = await source.draw(index, width, never, region as undefined);
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const pen = canvas.getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  return [0, 1, 2, 3].map((k) => {
    const x = Math.floor(((k % 2) * 0.5 + 0.25) * picture.width);
    const y = Math.floor(((k >> 1) * 0.5 + 0.25) * picture.height);
    const [r, g, b] = pen.getImageData(x, y, 1, 1).data;
    if (r > 200 && g > 200 && b > 200) return "white";
    return r > 200 && g > 200
      ? "yellow"
      : r > 200
        ? "red"
        : g > 200
          ? "green"
          : b > 200
            ? "blue"
            : "none";
  });
}
const whole = ["red", "green", "blue", "yellow"];

test("a manifest of Presentation 3 is a book", async () => {
  const { source, asked } = await open(manifest3(names.map((name) => canvas3(name))));
  expect([source.title, source.pageCount, source.direction]).toEqual(["A Book", 4, "ltr"]);
  expect(source.label(1)).toBe("b");
  expect(await source.size(0)).toEqual({ width: 1000, height: 1500 });
  expect(await colours(source, 0)).toEqual(whole);
  expect(asked.slice(-2)).toEqual(["a/info.json", "a/full/40,/0/default.jpg"]);
});

test("a manifest of Presentation 2 is a book", async () => {
  const info = {
    "@context": "http://iiif.io/api/image/2/context.json",
    type: undefined,
    profile: ["http://iiif.io/api/image/2/level2.json"],
  };
  const manifest = manifest2(
    names.map((name) => canvas2(name)),
    {
      viewingDirection: "right-to-left",
      attribution: [
        { "@value": "De moi", "@language": "fr" },
        { "@value": "<b>By</b> me", "@language": "en" },
      ],
      license: "https://creativecommons.org/licenses/by/4.0/",
    },
    { startCanvas: `${server}/canvas/c` },
  );
  const { source, asked } = await open(manifest, { ...images, a: { ...image, info } });
  expect([source.direction, source.openingPage]).toEqual(["rtl", 3]);
  expect(source.details).toEqual([
    { label: "", value: "By me" },
    {
      label: "Rights",
      value: "https://creativecommons.org/licenses/by/4.0/",
      href: "https://creativecommons.org/licenses/by/4.0/",
    },
  ]);
  expect(await colours(source, 0)).toEqual(whole);
  expect(asked.at(-1)).toBe("a/full/40,/0/default.jpg");
});

test.each([
  ["left-to-right", "ltr", undefined],
  ["right-to-left", "rtl", undefined],
  ["top-to-bottom", "ltr", "top"],
  ["bottom-to-top", "ltr", "bottom"],
])("read %s it is bound there", async (viewingDirection, direction, edge) => {
  const { source } = await open(manifest3([canvas3("a")], { viewingDirection }));
  expect([source.direction, source.edge]).toEqual([direction, edge]);
});

test.each([
  ["paged", undefined],
  ["individuals", "single"],
  ["continuous", "single"],
])("the behavior %s", async (behavior, layout) => {
  const { source } = await open(manifest3([canvas3("a")], { behavior: [behavior] }));
  expect(source.layout).toBe(layout);
});

test("fold-outs change no other page's side, and facing pages are two pages", async () => {
  const manifest = manifest3(
    [
      canvas3("a"),
      canvas3("b", { behavior: ["non-paged"] }),
      canvas3("c", { width: 2000, behavior: ["facing-pages"] }),
      canvas3("d"),
    ],
    {
      structures: [
        { type: "Range", label: "Last", items: [{ type: "Canvas", id: `${server}/canvas/d` }] },
      ],
    },
  );
  const { source } = await open(manifest);
  expect(places(source)).toEqual([undefined, "alone", "first", "second", undefined]);
  expect(await source.size(2)).toEqual({ width: 1000, height: 1500 });
  expect(await colours(source, 2)).toEqual(["red", "red", "blue", "blue"]);
  expect(await colours(source, 3)).toEqual(["green", "green", "yellow", "yellow"]);
  expect((await source.outline!(never))[0]?.page).toBe(5);
});

test("ranges are the contents, of both versions", async () => {
  const canvas = (name: string) => ({ id: `${server}/canvas/${name}`, type: "Canvas" });
  const range = (id: string, label: string, items: object[], more = {}) => ({
    id,
    type: "Range",
    label: { en: [label] },
    items,
    ...more,
  });
  const specific = { type: "SpecificResource", source: canvas("d"), selector: {} };
  const first = range("r1", "One", [canvas("a"), canvas("b")]);
  const second = range("r2", "Two", [range("r3", "Two and a half", [canvas("c")]), specific]);
  const order = range("r4", "Another order", [canvas("d")], { behavior: ["sequence"] });
  const { source } = await open(
    manifest3(
      names.map((name) => canvas3(name)),
      { structures: [range("r", "Contents", [first, second]), order] },
    ),
  );
  const lines = await source.outline!(never);
  expect(lines).toMatchObject([
    { title: "One", page: 1, children: [] },
    { title: "Two", page: 3, children: [{ title: "Two and a half", page: 3 }] },
  ]);
  const old = [
    {
      "@id": "r",
      "@type": "sc:Range",
      label: "Contents",
      viewingHint: "top",
      ranges: ["r1", "r2"],
    },
    { "@id": "r1", "@type": "sc:Range", label: "One", canvases: [`${server}/canvas/b`] },
    { "@id": "r2", "@type": "sc:Range", label: "Round", ranges: ["r2", "r1"] },
  ];
  const second2 = await open(
    manifest2(
      names.map((name) => canvas2(name)),
      { structures: old },
    ),
  );
  expect(await second2.source.outline!(never)).toMatchObject([
    { title: "One", page: 2 },
    { title: "Round", page: null },
  ]);
  // As in the specification's own example: a range with canvases, and one within it.
  const nested = [
    {
      "@id": "r1",
      "@type": "sc:Range",
      label: "Introduction",
      ranges: ["r1-1"],
      canvases: ["a", "b", "c"].map((name) => `${server}/canvas/${name}`),
    },
    {
      "@id": "r1-1",
      "@type": "sc:Range",
      label: "Objectives and Scope",
      canvases: [`${server}/canvas/b#xywh=0,0,500,500`],
    },
    { "@id": "r2", "@type": "sc:Range", label: "Bibliography", canvases: [`${server}/canvas/d`] },
  ];
  const third = await open(
    manifest2(
      names.map((name) => canvas2(name)),
      { structures: nested },
    ),
  );
  expect(await third.source.outline!(never)).toMatchObject([
    { title: "Introduction", page: 1, children: [{ title: "Objectives and Scope", page: 2 }] },
    { title: "Bibliography", page: 4 },
  ]);
});

test("labels, statement, rights and provider are in the reader's language", async () => {
  vi.spyOn(navigator, "languages", "get").mockReturnValue(["fr-CH", "en"]);
  const both = (en: string, fr: string) => ({ en: [en], fr: [fr] });
  const { source } = await open(
    manifest3([canvas3("a", { label: both("Cover", "Couverture") })], {
      requiredStatement: {
        label: both("By", "De"),
        value: both("Us", "<span>Nous &amp; co</span>"),
      },
      rights: "http://rightsstatements.org/vocab/NoC-US/1.0/",
      provider: [
        {
          type: "Agent",
          label: { en: ["Library"] },
          homepage: [{ id: "https://library.example/" }],
        },
      ],
      homepage: [{ id: "https://library.example/book", label: both("The book", "Le livre") }],
      metadata: [{ label: { none: ["Date"] }, value: { none: ["1600", "1601"] } }],
    }),
  );
  expect([source.title, source.label(0)]).toEqual(["Un livre", "Couverture"]);
  expect(source.details).toEqual([
    { label: "De", value: "Nous & co" },
    {
      label: "Rights",
      value: "http://rightsstatements.org/vocab/NoC-US/1.0/",
      href: "http://rightsstatements.org/vocab/NoC-US/1.0/",
    },
    { label: "", value: "Library", href: "https://library.example/" },
    { label: "", value: "Le livre", href: "https://library.example/book" },
    { label: "Date", value: "1600; 1601" },
  ]);
});

test("annotations that transcribe are the text, here or by their address, in both versions", async () => {
  const note = (value: string, xywh: string, motivation = "supplementing") => ({
    type: "Annotation",
    motivation,
    body: { type: "TextualBody", value, format: "text/plain" },
    target: `${server}/canvas/a#xywh=${xywh}`,
  });
  const list = {
    type: "AnnotationPage",
    items: [note("Call me", "100,100,200,50"), note("Nice", "1,1,2,2", "commenting")],
  };
  const far = { id: `${server}/far.json`, type: "AnnotationPage" };
  const old = {
    resources: [
      {
        motivation: "sc:painting",
        resource: { "@type": "cnt:ContentAsText", chars: "Ishmael" },
        on: {
          full: `${server}/canvas/b`,
          selector: { "@type": "oa:FragmentSelector", value: "xywh=percent:10,10,20,5" },
        },
      },
    ],
  };
  const { source } = await open(
    manifest3([
      canvas3("a", { annotations: [list, far, { id: `${server}/gone.json` }] }),
      canvas3("b", { annotations: [{ id: `${server}/old.json` }] }),
    ]),
    images,
    {
      "far.json": { items: [note("Some years ago", "100,200,300,50")] },
      "old.json": old,
    },
  );
  expect(await source.text!(0, never)).toEqual([
    { text: "Call me", x: 100, y: 100, width: 200, height: 50, angle: 0, end: true },
    { text: "Some years ago", x: 100, y: 200, width: 300, height: 50, angle: 0, end: true },
  ]);
  expect((await source.text!(1, never))[0]).toMatchObject({
    text: "Ishmael",
    x: 100,
    y: 150,
    width: 200,
    height: 75,
  });
});

test("zoomed, tiles are fetched as sharp as is needed, else a region", async () => {
  const tiles = [{ width: 512, scaleFactors: [1, 2, 4, 8] }];
  const { source, asked } = await open(manifest3([canvas3("a"), canvas3("b")]), {
    ...images,
    a: { ...image, info: { tiles } },
  });
  const region = { x: 0.25, y: 0.25, width: 0.5, height: 0.5 };
  expect(await colours(source, 0, 500, region)).toEqual(whole);
  // 500 pixels for 1000: every second one, from a grid of 3 by 2.
  const tilesAsked = asked.filter((path) => path.startsWith("a/") && !path.endsWith("info.json"));
  expect(tilesAsked).toHaveLength(6);
  expect(tilesAsked).toContain("a/1024,2048,976,952/488,476/0/default.jpg");
  const sharpest = await source.draw(0, 4000, never, region);
  expect(sharpest.width).toBe(1000);
  expect(await colours(source, 1, 500, region)).toEqual(whole);
  expect(asked.at(-1)).toBe("b/500,750,1000,1500/500,/0/default.jpg");
});

test("no seam shows between tiles", async () => {
  const tiles = [{ width: 100, scaleFactors: [1, 2, 4, 8] }];
  const { source } = await open(manifest3([canvas3("a")]), { a: { ...image, info: { tiles } } });
  const region = { x: 0.013, y: 0.007, width: 0.4, height: 0.4 };
  const picture = await source.draw(0, 333, never, region);
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  // All of it is in the red quarter.
  const { data } = pen.getImageData(0, 0, picture.width, picture.height);
  expect(data.findIndex((value, k) => value !== [255, 0, 0, 255][k % 4])).toBe(-1);
});

test("of a server of level 0, the sizes and tiles at hand alone are asked for", async () => {
  const sizes = [
    { width: 100, height: 150 },
    { width: 1000, height: 1500 },
  ];
  const tiles = [{ width: 1024, scaleFactors: [1, 2] }];
  const still = { profile: "level0", sizes };
  const served = {
    a: { ...image, info: still },
    b: { ...image, info: { ...still, tiles } },
    c: { ...image, info: { profile: "level0" } },
  };
  const { source, asked } = await open(
    manifest3([canvas3("a"), canvas3("b"), canvas3("c")]),
    served,
  );
  expect(await colours(source, 0, 60)).toEqual(whole);
  expect(asked.at(-1)).toBe("a/full/100,150/0/default.jpg");
  expect((await source.draw(0, 4000, never)).width).toBe(1000);
  expect(asked.at(-1)).toBe("a/full/1000,1500/0/default.jpg");
  expect(await colours(source, 1, 2000)).toEqual(whole);
  expect(asked.slice(-6).sort()[0]).toBe("b/0,0,1024,1024/1024,1024/0/default.jpg");
  await source.draw(2, 50, never);
  expect(asked.at(-1)).toBe("c/full/max/0/default.jpg");
});

test("a canvas holds several images, a choice, a part of an image, or none", async () => {
  const painted = (name: string, target: string, body = {}) => ({
    motivation: "painting",
    body: { ...canvas3(name).items[0]!.items[0]!.body, ...body },
    target: `${server}/canvas/x${target}`,
  });
  const of = (...items: object[]) => ({
    type: "Canvas",
    id: `${server}/canvas/x`,
    width: 1000,
    height: 1500,
    items: [{ items }],
  });
  const choice = { type: "Choice", items: [canvas3("b").items[0]!.items[0]!.body, {}] };
  const crop = {
    type: "SpecificResource",
    source: canvas3("b").items[0]!.items[0]!.body,
    selector: { type: "ImageApiSelector", region: "0,0,1000,1500" },
  };
  const { source } = await open(
    manifest3([
      of(painted("a", "#xywh=0,0,500,1500"), painted("b", "#xywh=500,0,500,1500")),
      of({ body: choice, target: "x" }),
      of({ body: crop, target: "x" }),
      of(),
    ]),
  );
  expect(await colours(source, 0, 400, { x: 0, y: 0, width: 0.5, height: 1 })).toEqual(whole);
  expect(await colours(source, 0, 400, { x: 0.5, y: 0, width: 0.5, height: 1 })).toEqual(whole);
  expect(await colours(source, 1)).toEqual(whole);
  expect(await colours(source, 2)).toEqual(["red", "red", "red", "red"]);
  expect(await colours(source, 3)).toEqual(["white", "white", "white", "white"]);
});

test.each([
  ["90", 1500, 1000, ["blue", "red", "yellow", "green"]],
  ["180", 1000, 1500, ["yellow", "blue", "green", "red"]],
  ["270", 1500, 1000, ["green", "yellow", "red", "blue"]],
  ["45", 1000, 1500, whole],
])(
  "an image turned by %s degrees is drawn so, whole and zoomed",
  async (rotation, width, height, seen) => {
    const { body } = canvas3("a").items[0]!.items[0]!;
    const selector = { type: "ImageApiSelector", rotation };
    const turned = { type: "SpecificResource", source: body, selector };
    const canvas = { type: "Canvas", id: `${server}/x`, width, height };
    const { source } = await open(
      manifest3([{ ...canvas, items: [{ items: [{ body: turned }] }] }]),
    );
    expect(await colours(source, 0)).toEqual(seen);
    // A quarter of the page is of one colour, with tiles too.
    const corner = { x: 0.5, y: 0, width: 0.5, height: 0.5 };
    expect(new Set(await colours(source, 0, 900, corner))).toEqual(new Set([seen[1]]));
    expect(await colours(source, 0, 900)).toEqual(seen);
  },
);

test("an image turned beside another stays where it is", async () => {
  const { body } = canvas3("a").items[0]!.items[0]!;
  const selector = { type: "ImageApiSelector", rotation: "90" };
  const turned = { type: "SpecificResource", source: body, selector };
  const canvas = { type: "Canvas", id: `${server}/x`, width: 2000, height: 3000 };
  const { source } = await open(
    manifest3([
      {
        ...canvas,
        items: [{ items: [{ body: turned, target: `${server}/x#xywh=0,2000,1500,1000` }] }],
      },
    ]),
  );
  const there = { x: 0, y: 2 / 3, width: 0.75, height: 1 / 3 };
  expect(await colours(source, 0, 400, there)).toEqual(["blue", "red", "yellow", "green"]);
  const above = { x: 0, y: 0, width: 1, height: 0.6 };
  expect(await colours(source, 0, 400, above)).toEqual(["white", "white", "white", "white"]);
});

test("an image without a service, and one whose service is gone, are shown", async () => {
  const plain = canvas3("a", {}, { service: undefined });
  const files = { "b/info.json": { error: "none" } };
  const { source, asked } = await open(manifest3([plain, canvas3("b")]), images, files);
  expect(await colours(source, 0)).toEqual(whole);
  expect(await colours(source, 1)).toEqual(whole);
  expect(asked).not.toContain("a/info.json");
});

test("a service that responds by a page to log in at fails that page alone, in a sentence", async () => {
  const alone = canvas3("b", {}, { id: undefined });
  const page = new Blob(["<!doctype html><title>Log in</title>"]);
  const { source } = await open(
    manifest3([canvas3("a"), alone]),
    { a: image },
    { "b/info.json": page },
  );
  expect(await messageOf(source.draw(1, 40, never))).toBe(
    "Page 2 of m.json is described by no image; try again later.",
  );
  expect(await colours(source, 0)).toEqual(whole);
});

test.each([
  [
    "1.1",
    {
      "@context": "http://library.stanford.edu/iiif/image-api/1.1/context.json",
      profile: "http://library.stanford.edu/iiif/image-api/1.1/compliance.html#level2",
    },
  ],
  [
    "1.0",
    {
      "@context": undefined,
      profile: "http://library.stanford.edu/iiif/image-api/compliance.html#level2",
    },
  ],
])("a server of version %s of the Image API is asked for its native images", async (_, info) => {
  const old = { ...info, type: undefined, id: undefined, "@id": `${server}/a` };
  const { source, asked } = await open(manifest2([canvas2("a")]), { a: { ...image, info: old } });
  expect(await colours(source, 0)).toEqual(whole);
  expect(asked.at(-1)).toBe("a/full/40,/0/native.jpg");
});

test("an image server that fails fails that page alone, and is asked again", async () => {
  const served: Record<string, ServedImage> = { a: image };
  const { source } = await open(manifest3([canvas3("a"), canvas3("b")]), served);
  expect(await messageOf(source.draw(1, 40, never))).toBe(
    "Page 2 of m.json was not found; check the address and open it again.",
  );
  expect(await colours(source, 0)).toEqual(whole);
  served.b = image;
  expect(await colours(source, 1)).toEqual(whole);
});

test("the information about one image is a book of one page", async () => {
  serve({ a: image });
  const source = await openSource(`${server}/a/info.json`);
  expect(source.pageCount).toBe(1);
  expect(await colours(source, 0)).toEqual(whole);
});

test("a collection fails in a sentence that names its books, also one within itself", async () => {
  const collection = {
    "@context": "http://iiif.io/api/presentation/3/context.json",
    type: "Collection",
    id: `${server}/m.json`,
    items: [
      { id: `${server}/m.json`, type: "Collection", label: { en: ["Itself"] } },
      { id: "b.json", type: "Manifest" },
    ],
  };
  expect(await messageOf(open(collection))).toBe(
    `m.json is a collection of books; open one of them, such as Itself (${server}/m.json), a book (${server}/b.json).`,
  );
});

test.each(["AnnotationPage", "AnnotationCollection", "Annotation"])(
  "a file of type %s is no book",
  async (type) => {
    expect(await messageOf(open({ ...manifest3([canvas3("a")]), type }))).toBe(
      "m.json has notes about a book; open the manifest of the book.",
    );
  },
);

test("hostile manifests fail in a sentence or are opened within their bounds", async () => {
  const many = Array.from({ length: 100_000 }, (_, k) => ({ id: String(k) }));
  expect(await messageOf(open(manifest3(many)))).toBe(
    `m.json lists 100000 canvases; split it into books of at most ${limits.pages}.`,
  );
  expect(await messageOf(open(manifest3([])))).toContain("lists no pages");
  const numbers = canvas3("a", { width: 1e300, height: -1, label: 7, behavior: {} });
  const annotations = [
    {
      items: [
        {
          motivation: "supplementing",
          body: { type: "TextualBody", value: "x" },
          target: "#xywh=1e9,NaN,-1,0",
        },
      ],
    },
    null,
    3,
  ];
  const bad = await open(
    manifest3(
      [
        numbers,
        { ...canvas3("b"), annotations },
        { items: [null, { items: [{ body: 7 }] }] },
        { items: "x" },
      ] as object[],
      {
        label: { en: 5, __proto__: 1 },
        structures: [null, { items: [null, 5, {}] }],
        provider: 5,
        metadata: [[], null],
        viewingDirection: ["up"],
        start: 9,
      },
    ),
    {
      a: {
        ...image,
        info: { width: 1e300, tiles: [{ width: 1e-9, scaleFactors: [0, "x"] }], sizes: [null, {}] },
      },
      b: { width: 2000, height: 3000, info: { tiles: [{ width: 16, scaleFactors: [1] }] } },
    },
  );
  expect(bad.source.pageCount).toBe(4);
  expect(await bad.source.text!(1, never)).toEqual([]);
  await bad.source.draw(1, 4000, never, { x: 0, y: 0, width: 0.5, height: 0.5 });
  expect(bad.asked.length).toBeLessThan(340);
  await bad.source.draw(3, 10, never);
});

test("an image of 50,000 x 50,000 pixels in place of a tile is not decoded", async () => {
  serve({ a: image }, { "m.json": manifest3([canvas3("a", {}, { service: undefined })]) });
  const canvas = new OffscreenCanvas(1, 1);
  canvas.getContext("2d");
  const bytes = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
  new DataView(bytes.buffer).setUint32(16, 50_000);
  new DataView(bytes.buffer).setUint32(20, 50_000);
  const source = await openSource(`${server}/m.json`);
  vi.mocked(fetch).mockImplementation(async () => new Response(bytes));
  const decode = vi.spyOn(globalThis, "createImageBitmap");
  expect(await messageOf(source.draw(0, 40, never))).toContain("50000 x 50000 pixels");
  expect(decode).not.toHaveBeenCalled();
});

test("it fulfils the contract of a source", async () => {
  const contents = [{ type: "Range", id: "r", label: "One", items: [canvas3("b")] }];
  const wide = canvas3("c", { width: 2000, behavior: ["facing-pages"] });
  const manifest = manifest3([canvas3("a"), canvas3("b"), wide, canvas3("d")], {
    structures: contents,
  });
  serve(images, { "m.json": manifest });
  await expectConformance(() => openSource(`${server}/m.json`));
});

test.each([
  ["3", manifest3([canvas3("a"), canvas3("b")])],
  ["2", manifest2([canvas2("a"), canvas2("b")])],
])("a manifest of version %s without a context is a book", async (_, manifest) => {
  const { source } = await open({ ...manifest, "@context": undefined });
  expect([source.pageCount, await colours(source, 1)]).toEqual([2, whole]);
  source.close();
});

test("what a sequence says of its direction counts before what its manifest does", async () => {
  const { source } = await open(
    manifest2(
      [canvas2("a")],
      { viewingDirection: "left-to-right" },
      { viewingDirection: "right-to-left" },
    ),
  );
  expect(source.direction).toBe("rtl");
  source.close();
});

test("a canvas alone is a book of one page", async () => {
  const context = { "@context": "http://iiif.io/api/presentation/3/context.json" };
  const { source } = await open({ ...canvas3("a"), ...context });
  expect([source.pageCount, await colours(source, 0)]).toEqual([1, whole]);
  source.close();
});

test("a canvas without an address is no place, and of several with one the first is", async () => {
  const structures = [{ id: "r", type: "Range", label: { en: ["R"] }, items: [canvas3("a")] }];
  const { source } = await open(
    manifest3([{}, canvas3("a"), canvas3("a"), {}] as never, { structures, start: undefined }),
  );
  expect(source.openingPage).toBeUndefined();
  expect(await source.outline?.(never)).toMatchObject([{ title: "R", page: 2 }]);
  source.close();
});
