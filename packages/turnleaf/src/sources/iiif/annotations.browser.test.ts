/** What annotations of a IIIF canvas say, and what else of a manifest is not a page. */

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

const images = Object.fromEntries(["a", "b"].map((name) => [name, { width: 2000, height: 3000 }]));

async function open(manifest: object, files = {}): Promise<PageSource> {
  serve(images, { "m.json": manifest, ...files });
  return await openSource(`${server}/m.json`);
}

const canvasA = `${server}/canvas/a`;
const note = (motivation: string, body: object, target: unknown = canvasA) => ({
  type: "Annotation",
  ...{ motivation, body, target },
});
const text = (value: string, format = "text/plain") => ({ type: "TextualBody", value, format });
const withNotes = (items: readonly object[]) =>
  manifest3([canvas3("a", { annotations: [{ type: "AnnotationPage", items }] }), canvas3("b")]);

test("a text of all of a canvas stands on it line by line, here or at an address of its own", async () => {
  const far = { id: `${server}/far.txt`, type: "Text", format: "text/plain" };
  const source = await open(
    withNotes([
      note("supplementing", text("Call me<br>Ishmael.<p>Some years ago</p>", "text/html")),
      note("supplementing", far),
      note("supplementing", { ...far, id: `${server}/alto.xml`, format: "application/xml" }),
    ]),
    { "far.txt": "never mind\nhow long" },
  );
  const runs = await source.text!(0, never);
  expect(runs.map((run) => run.text)).toEqual([
    "Call me",
    "Ishmael.",
    "Some years ago",
    '"never mind\\nhow long"',
  ]);
  expect(runs.map(({ y }) => y)).toEqual([0, 50, 100, 150]);
  expect(source.warnings?.map(({ code, source }) => [code, source])).toEqual([
    ["annotation", `${server}/alto.xml`],
  ]);
});

test("a line whose place is drawn as a polygon is there", async () => {
  const selector = (value: string) => ({ type: "SvgSelector", value });
  const at = (value: string) => ({ source: canvasA, selector: selector(value) });
  const source = await open(
    withNotes([
      note(
        "supplementing",
        text("One"),
        at("<svg><path d='M100,100 L300,110 300,150 100,140Z'/></svg>"),
      ),
      note(
        "supplementing",
        text("Two"),
        at('<svg><polygon points="100,200 300,200 300,250"/></svg>'),
      ),
    ]),
  );
  expect(await source.text!(0, never)).toEqual([
    { text: "One", x: 100, y: 100, width: 200, height: 50, angle: 0, end: true },
    { text: "Two", x: 100, y: 200, width: 200, height: 50, angle: 0, end: true },
  ]);
});

test("links on a canvas lead to others and to the web, and comments are notes", async () => {
  const at = `${canvasA}#xywh=10,20,30,40`;
  const source = await open(
    withNotes([
      note("linking", { id: `${server}/canvas/b`, type: "Canvas" }, at),
      note("linking", { id: "https://example.org/", type: "Text" }, at),
      note("commenting", text("A whale"), at),
      note("commenting", text("About all of it")),
    ]),
  );
  const box = { x: 10, y: 20, width: 30, height: 40, title: "" };
  expect(await source.links!(0, never)).toEqual([
    { ...box, to: { page: 2 } },
    { ...box, to: { href: "https://example.org/" } },
    { ...box, to: { page: 1 }, note: "A whale" },
  ]);
  expect(source.warnings?.map(({ source, page }) => [source, page])).toEqual([
    ["About all of it", 1],
  ]);
});

test("other sequences, and images to choose from, are listed", async () => {
  const choice = (name: string) => ({
    "@type": "oa:Choice",
    default: { "@id": `${server}/${name}.jpg`, "@type": "dctypes:Image" },
    item: [{ "@id": `${server}/x.jpg`, "@type": "dctypes:Image" }, "rdf:nil"],
  });
  const chosen = { ...canvas2("a"), images: [{ resource: choice("a") }] };
  const manifest = manifest2([chosen]) as { sequences: object[] };
  const source = await open({
    ...manifest,
    sequences: [{ "@id": `${server}/empty` }, ...manifest.sequences, { label: "By quires" }],
  });
  expect(source.pageCount).toBe(1);
  expect(source.warnings?.map(({ message }) => message)).toEqual([
    `${server}/empty, another sequence of pages of m.json, is not shown.`,
    "By quires, another sequence of pages of m.json, is not shown.",
    "Page 1 of m.json has 1 more of its images to choose from, which are not shown.",
  ]);
});

test("sizes in words of digits, and a service that does not say what it is, are read", async () => {
  const [service, resource] = [{ "@id": `${server}/a` }, { "@type": "dctypes:Image" }];
  const canvas = {
    ...{ "@id": canvasA, width: "500", height: "750" },
    images: [{ resource: { ...resource, "@id": `${server}/a/full/full/0/default.jpg`, service } }],
  };
  const asked = serve(images, { "m.json": manifest2([canvas]) });
  const source = await openSource(`${server}/m.json`);
  expect(await source.size(0)).toEqual({ width: 500, height: 750 });
  await source.draw(0, 40, never);
  expect(asked).toContain("a/info.json");
});

test("what a canvas's owner wants to be said, what the book is about and its other forms are details", async () => {
  const said = (value: string) => ({ requiredStatement: { label: "Owner", value } });
  const source = await open({
    ...manifest3([canvas3("a", said("Ours")), canvas3("b", said("Theirs"))]),
    ...said("Ours"),
    summary: { en: ["About a whale"] },
    rendering: [{ id: "https://example.org/a.pdf", type: "Text", label: "As a PDF" }],
  });
  expect(source.details).toEqual([
    { label: "Owner", value: "Ours" },
    { label: "", value: "About a whale" },
    { label: "", value: "As a PDF", href: "https://example.org/a.pdf" },
    { label: "b", value: "Theirs" },
  ]);
});
