import { zipSync } from "fflate";
import { afterEach, describe, expect, it, vi } from "vitest";
import { hugeImages } from "../for_tests/huge_images.ts";
import { listImages } from "./formats.ts";
import { limits } from "./limits.ts";
import { messageOf } from "./message_of.ts";
import { openSource } from "./open.ts";
import { tinyPdf } from "./tiny_pdf.ts";

const never = new AbortController().signal;

afterEach(() => {
  vi.restoreAllMocks();
});

async function image(width: number, height: number, type = "image/png"): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d")!;
  context.fillStyle = "#00f";
  context.fillRect(0, 0, width, height);
  return await canvas.convertToBlob({ type });
}

const address = async (width: number, height: number): Promise<string> =>
  URL.createObjectURL(await image(width, height));

/** Responds to every fetch with `respond`. */
function serve(respond: (url: string, init?: RequestInit) => Response | Promise<Response>): void {
  vi.spyOn(globalThis, "fetch").mockImplementation(async (input, init) =>
    respond(String(input), init),
  );
}

describe("a book of images", () => {
  it.each([
    [
      "UTF-16",
      (text: string) =>
        [0xfeff, ...text].map((one) => (one === 0xfeff ? one : String(one).charCodeAt(0))),
    ],
    ["Latin-1", (text: string) => Array.from(text, (letter) => letter.charCodeAt(0))],
  ])("reads a manifest in %s, and says of other JSON that it is none", async (name, codes) => {
    const fileOf = (text: string): File => {
      const Bytes = name === "UTF-16" ? Uint16Array : Uint8Array;
      return new File([Bytes.from(codes(text))], "m.json", { type: "application/json" });
    };
    const text = JSON.stringify({ title: "Café", pages: [await address(4, 6)] });
    const source = await openSource(fileOf(text));
    expect(source.title).toBe("Café");
    source.close();
    expect(await messageOf(openSource(fileOf('"é"')))).toMatch(/^m\.json is not a manifest; /);
  });

  it("takes addresses in order and finds sizes by itself", async () => {
    const source = await openSource([await address(40, 60), await address(50, 50)]);
    expect(source.pageCount).toBe(2);
    expect(source.kind).toBe("scan");
    expect(await source.size(0)).toEqual({ width: 40, height: 60 });
    expect(await source.size(1)).toEqual({ width: 50, height: 50 });
    expect(source.label(1)).toBe("2");
  });

  it("draws as wide as asked, and never wider than the image", async () => {
    const source = await openSource([await address(400, 600)]);
    const small = await source.draw(0, 100, never);
    expect([small.width, small.height]).toEqual([100, 150]);
    const large = await source.draw(0, 5000, never);
    expect([large.width, large.height]).toEqual([400, 600]);
  });

  it("believes the image and not what a manifest claims", async () => {
    const pages = [{ src: await address(40, 60), width: 4000, height: 1000, label: "iv" }];
    const source = await openSource({ title: "Atlas", pages });
    expect(source.title).toBe("Atlas");
    expect(source.label(0)).toBe("iv");
    expect(await source.size(0)).toEqual({ width: 4000, height: 1000 });
    const picture = await source.draw(0, 4000, never);
    expect([picture.width, picture.height]).toEqual([40, 60]);
    expect(await source.size(0)).toEqual({ width: 40, height: 60 });
  });

  it("draws a part of a page, and no sharper than the image is", async () => {
    const canvas = new OffscreenCanvas(100, 200);
    const pen = canvas.getContext("2d")!;
    pen.fillStyle = "#f00";
    pen.fillRect(50, 100, 50, 100);
    const source = await openSource(
      new File([await canvas.convertToBlob()], "page.png", { type: "image/png" }),
    );
    const region = { x: 0.5, y: 0.5, width: 0.25, height: 0.5 };
    const part = (await source.draw(0, 10, never, region)) as ImageBitmap;
    expect([part.width, part.height]).toEqual([10, 40]);
    pen.drawImage(part, 0, 0);
    expect([...pen.getImageData(5, 2, 1, 1).data]).toEqual([255, 0, 0, 255]);
    expect((await source.draw(0, 900, never, region)).width).toBe(25);
    expect((await source.file!()).type).toBe("image/png");
  });

  it("tells text and links in its image's own pixels", async () => {
    const box = { x: 400, y: 100, width: 400, height: 50 };
    const said = { text: [{ ...box, text: "Call" }], links: [{ ...box, page: 1 }], alt: "A whale" };
    const pages = [{ src: await address(40, 60), width: 4000, height: 1000, ...said }];
    const source = await openSource({ title: "Atlas", outline: [{ title: "A", page: 1 }], pages });
    expect((await source.text!(0, never))[0]).toMatchObject(box);
    await source.draw(0, 40, never);
    const scaled = { x: 4, y: 6, width: 4, height: 3 };
    expect((await source.text!(0, never))[0]).toMatchObject(scaled);
    expect((await source.links!(0, never))[0]).toMatchObject({ ...scaled, to: { page: 1 } });
    expect(await source.alt!(0, never)).toBe("A whale");
    expect(await source.outline!(never)).toEqual([{ title: "A", page: 1, children: [] }]);
  });

  it.each(["image/png", "image/jpeg", "image/webp"])("opens one %s as a page", async (type) => {
    const source = await openSource(new File([await image(30, 20, type)], "page"));
    expect(await source.size(0)).toEqual({ width: 30, height: 20 });
    expect(source.title).toBe("page");
  });

  it("opens a manifest from its address, after redirects too", async () => {
    const png = await image(10, 10);
    serve((url) => {
      if (url.endsWith(".png")) return new Response(png);
      const respond = new Response('{"title": "Far", "pages": ["1.png"]}');
      Object.defineProperty(respond, "url", { value: "https://b.example/deep/book.json" });
      return respond;
    });
    const source = await openSource("https://a.example/book");
    await source.draw(0, 5, never);
    const asked = vi.mocked(fetch).mock.calls.map(([input]) => String(input));
    // The file, whose first bytes are all of it, is requested once.
    expect(asked).toEqual(["https://a.example/book", "https://b.example/deep/1.png"]);
  });

  it("requests a file again that has more than its first bytes", async () => {
    const png = await image(10, 10);
    const pages = Array.from({ length: 400 }, () => "1.png");
    serve((url) =>
      url.endsWith(".png") ? new Response(png) : new Response(JSON.stringify({ pages })),
    );
    const source = await openSource("https://a.example/book.json");
    expect(source.pageCount).toBe(400);
    expect(fetch).toHaveBeenCalledTimes(2);
  });

  it("fetches a page once for all who want it, and keeps it for sharper drawings", async () => {
    const png = await image(100, 100);
    serve(() => new Response(png));
    const source = await openSource(["https://a.example/1.png"]);
    await Promise.all([source.size(0), source.draw(0, 10, never), source.draw(0, 50, never)]);
    await source.draw(0, 100, never);
    expect(fetch).toHaveBeenCalledTimes(1);
  });

  it("stops fetching when nobody waits any more", async () => {
    let own: AbortSignal | null | undefined;
    serve((_, init) => {
      own = init?.signal;
      return new Promise((_, reject) => {
        own?.addEventListener("abort", () => reject(own?.reason));
      });
    });
    const source = await openSource(["https://a.example/1.png"]);
    const controller = new AbortController();
    const drawing = source.draw(0, 10, controller.signal);
    controller.abort(new Error("turned on"));
    await expect(drawing).rejects.toThrow("turned on");
    expect(own?.aborted).toBe(true);
  });
});

/** Returns the colours at places of the picture, fractions of its size, as "r,g,b". */
function coloursOf(
  picture: CanvasImageSource & { width: number; height: number },
  ...at: [number, number][]
) {
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  return at.map(([x, y]) => {
    const place = [Math.floor(x * picture.width), Math.floor(y * picture.height)] as const;
    return [...pen.getImageData(...place, 1, 1).data.slice(0, 3)].join(",");
  });
}

/** Returns a list as a file input has it. */
function fileList(...files: File[]): FileList {
  const transfer = new DataTransfer();
  for (const file of files) transfer.items.add(file);
  return transfer.files;
}

describe("a book is given", () => {
  it.each([
    ["an ArrayBuffer", (bytes: ArrayBuffer) => bytes],
    ["a typed array", (bytes: ArrayBuffer) => new Uint8Array(bytes)],
    [
      "a part of a larger buffer",
      (bytes: ArrayBuffer) => {
        const larger = new Uint8Array([9, ...new Uint8Array(bytes), 9]);
        return larger.subarray(1, -1);
      },
    ],
    ["a DataView", (bytes: ArrayBuffer) => new DataView(bytes)],
    ["a Blob without a type", (bytes: ArrayBuffer) => new Blob([bytes])],
    ["a Blob of a wrong type", (bytes: ArrayBuffer) => new Blob([bytes], { type: "text/plain" })],
    ["a list of one", (bytes: ArrayBuffer) => [bytes]],
  ])("as %s", async (_, wrap) => {
    const png = wrap(await (await image(30, 20)).arrayBuffer());
    const source = await openSource(png);
    expect(await source.size(0)).toEqual({ width: 30, height: 20 });
    expect((await source.draw(0, 15, never)).width).toBe(15);
    const pdf = wrap(tinyPdf({ pages: ["", "", ""] }).buffer);
    expect((await openSource(pdf)).pageCount).toBe(3);
  });

  it("as a FileList: one file of any kind, or images by their names' natural order", async () => {
    const png = (name: string, width: number) =>
      image(width, 10).then((blob) => new File([blob], name));
    const files = await Promise.all([png("page 10.png", 30), png("page 9.png", 20)]);
    const source = await openSource(fileList(...files));
    const sizes = [await source.size(0), await source.size(1)];
    expect(sizes.map(({ width }) => width)).toEqual([20, 30]);
    const pdf = new File([tinyPdf({ pages: ["", ""] })], "a book.pdf");
    const book = await openSource(fileList(pdf));
    expect([book.pageCount, book.title]).toEqual([2, "a book.pdf"]);
    expect(await messageOf(openSource(fileList()))).toBe("No file was chosen; choose one.");
    const both = await openSource(fileList(files[0], pdf));
    expect(await messageOf(both.size(0))).toBe(
      "Page 1 of This book is a PDF among images; open it by itself.",
    );
  });

  it("as pages whose bytes are at hand", async () => {
    const bytes = await (await image(30, 20)).arrayBuffer();
    const source = await openSource([bytes, { src: new Uint8Array(bytes), label: "ii" }]);
    expect(await source.size(1)).toEqual({ width: 30, height: 20 });
    expect(source.label(1)).toBe("ii");
  });

  it.each([
    [7, "a Number"],
    [true, "a Boolean"],
    [() => 1, "a Function"],
    [new Date(0), "a Date"],
    [document.createElement("img"), "an HTMLImageElement"],
    [new Map(), "a Map"],
  ])("as nothing else: %s", async (value, kind) => {
    expect(await messageOf(openSource(value as never))).toBe(
      `A book is not made of ${kind}; give an address, a File or FileList, an ArrayBuffer, a list of images or of elements, or a manifest.`,
    );
  });

  it("by an address that was an object", async () => {
    expect(await messageOf(openSource("[object File]"))).toBe(
      "src is an address, and not File; set pages instead.",
    );
  });
});

describe("the size of an image", () => {
  it("is read from its header, upright, without an <img>", async () => {
    const made = vi.spyOn(globalThis, "Image");
    const decoded = vi.spyOn(globalThis, "createImageBitmap");
    for (const type of ["image/png", "image/jpeg", "image/webp"]) {
      const source = await openSource(await image(300, 200, type));
      expect(await source.size(0)).toEqual({ width: 300, height: 200 });
    }
    const jpeg = new Uint8Array(await (await image(300, 200, "image/jpeg")).arrayBuffer());
    // EXIF: turned by a quarter.
    const exif = [0xff, 0xe1, 0, 34, 69, 120, 105, 102, 0, 0, 77, 77, 0, 42, 0, 0, 0, 8, 0, 1];
    const entry = [1, 18, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0, 0, 0, 0, 0];
    const turned = await openSource(
      new Uint8Array([...jpeg.subarray(0, 2), ...exif, ...entry, ...jpeg.subarray(2)]),
    );
    expect(await turned.size(0)).toEqual({ width: 200, height: 300 });
    expect(made).not.toHaveBeenCalled();
    expect(decoded).not.toHaveBeenCalled();
    const picture = await turned.draw(0, 200, never);
    expect([picture.width, picture.height]).toEqual([200, 300]);
  });
});

describe("an SVG", () => {
  const open = (text: string) => openSource(new Blob([text]));
  const root = (attributes: string, content = "") =>
    `<?xml version="1.0"?>\n<!-- a > b --><svg xmlns="http://www.w3.org/2000/svg" ${attributes}>${content}</svg>`;

  it.each([
    ['viewBox="0 0 40 60"', 40, 60],
    ['viewBox="-5,-5 40,60" width="100%" height="auto"', 40, 60],
    ['width="80" height="90px" viewBox="0 0 40 60"', 80, 90],
    ["width='2in' height='1cm'", 192, 96 / 2.54],
    ['width="80" viewBox="0 0 40 60"', 80, 120],
    ['height="30" viewBox="0 0 40 60" stroke-width="7"', 20, 30],
    ["", 300, 150],
    ['viewBox="0 0 0 0" data-x="a > b"', 300, 150],
  ])("has the size that it says: %s", async (attributes, width, height) => {
    expect(await (await open(root(attributes))).size(0)).toEqual({ width, height });
  });

  it.each([
    [
      "without its namespace",
      '<svg viewBox="0 0 9 9"><rect width="9" height="9" fill="#00f"/></svg>',
    ],
    [
      "whose namespace is empty",
      '<svg xmlns="" viewBox="0 0 9 9"><rect width="9" height="9" fill="#00f"/></svg>',
    ],
    [
      "whose prefix is not declared",
      '<s:svg viewBox="0 0 9 9"><s:rect width="9" height="9" fill="#00f"/></s:svg>',
    ],
    [
      "whose links' prefix is not declared",
      '<svg viewBox="0 0 9 9"><rect id="a" width="9" height="9" fill="#00f"/><use xlink:href="#a"/></svg>',
    ],
    [
      "with a bare ampersand, and a tag without an end",
      '<svg viewBox="0 0 9 9"><title>A & B &nbsp;</title><g><rect width="9" height="9" fill="#00f"/></svg>',
    ],
  ])("%s is drawn", async (_, text) => {
    const source = await open(text);
    const pen = new OffscreenCanvas(9, 9).getContext("2d")!;
    pen.drawImage(await source.draw(0, 9, never), 0, 0);
    expect([...pen.getImageData(4, 4, 1, 1).data]).toEqual([0, 0, 255, 255]);
  });

  it.each([
    ["in another namespace", '<svg xmlns="http://example.org/" viewBox="0 0 9 9"/>'],
    ["in capitals", '<SVG viewBox="0 0 9 9"/>'],
  ])("%s is none", async (_, text) => {
    const source = await open(text);
    expect(await messageOf(source.draw(0, 9, never))).toMatch(/is damaged or no image; PNG, /);
  });

  it.each([
    ["UTF-16", [0xff, 0xfe], 2],
    ["windows-1251", [], 1],
  ] as const)("in %s is drawn, whatever its encoding", async (encoding, mark, width) => {
    const text = `<?xml version="1.0" encoding="${encoding}"?><svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><title>\u00e9</title><rect width="9" height="9" fill="#00f"/></svg>`;
    const bytes = [...text].flatMap((letter) => [letter.charCodeAt(0), 0].slice(0, width));
    const source = await openSource(new File([new Uint8Array([...mark, ...bytes])], "a.svg"));
    expect(await source.size(0)).toEqual({ width: 9, height: 9 });
    expect(coloursOf(await source.draw(0, 20, never), [0.5, 0.5])).toEqual(["0,0,255"]);
  });

  it("is drawn sharp at any width, all of it or a part", async () => {
    const rect = '<rect x="5" y="10" width="5" height="10" fill="#00f"/>';
    const source = await open(
      root('viewBox="0 0 10 20"', `<rect width="10" height="20" fill="#f00"/>${rect}`),
    );
    const picture = await source.draw(0, 500, never);
    expect([picture.width, picture.height]).toEqual([500, 1000]);
    // An edge of enlarged pixels would be blurred over 50 of them.
    expect(coloursOf(picture, [0.495, 0.75], [0.505, 0.75], [0.75, 0.495])).toEqual([
      "255,0,0",
      "0,0,255",
      "255,0,0",
    ]);
    const region = { x: 0.5, y: 0.25, width: 0.5, height: 0.5 };
    const part = await source.draw(0, 100, never, region);
    expect([part.width, part.height]).toEqual([100, 200]);
    expect(coloursOf(part, [0.5, 0.49], [0.5, 0.51])).toEqual(["255,0,0", "0,0,255"]);
  });

  it("runs no script and loads nothing", async () => {
    const fetched = vi.spyOn(globalThis, "fetch");
    const other = await address(10, 10);
    const hostile = `<script>parent.ran = true; fetch("/")</script><image href="${other}" width="10" height="10"/><foreignObject width="10" height="10"><body xmlns="http://www.w3.org/1999/xhtml"><img src="x" onerror="parent.ran = true"/></body></foreignObject><rect width="10" height="10" fill="#0f0" onload="parent.ran = true"/>`;
    const source = await open(root('viewBox="0 0 10 10" onload="parent.ran = true"', hostile));
    const picture = await source.draw(0, 100, never);
    // What it draws can be read: the canvas is not tainted.
    expect(coloursOf(picture, [0.9, 0.9])).toEqual(["0,255,0"]);
    expect("ran" in globalThis).toBe(false);
    expect(fetched).not.toHaveBeenCalled();
  });

  it("of many tags, none of which ends, is none", async () => {
    const source = await open("<svg\t".repeat(300_000));
    expect(await messageOf(source.draw(0, 20, never))).toMatch(/is damaged/);
  });

  it("has its usual size where its length is of many spaces", async () => {
    const source = await open(root(`width="1${"\t".repeat(300_000)}."`));
    expect(await source.size(0)).toEqual({ width: 300, height: 150 });
  });

  it("has what a text of it would stand for as it is", async () => {
    const source = await open(
      root(`data-x="${"$'".repeat(1000)}"`, `<desc>${"x".repeat(1_000_000)}</desc>`),
    );
    expect((await source.draw(0, 300, never)).height).toBe(150);
  });

  it("may be a page among others, and that which is none spoils itself alone", async () => {
    const source = await openSource([
      new Blob([root('viewBox="0 0 40 60"')]),
      new Blob(["<svg <"]),
      await image(9, 9),
    ]);
    expect((await source.draw(0, 20, never)).height).toBe(30);
    expect(await messageOf(source.draw(1, 20, never))).toBe(
      `Page 2 of This book is damaged or no image; ${listImages()} can be shown.`,
    );
    expect((await source.draw(2, 20, never)).width).toBe(9);
  });
});

describe("unreadable input fails in one sentence", () => {
  const fails = (respond: () => Response, address = "https://a.example/a%20book.json") => {
    serve(respond);
    return messageOf(openSource(address));
  };

  it("not found", async () => {
    expect(await fails(() => new Response("", { status: 404 }))).toBe(
      "a book.json was not found; check the address and open it again.",
    );
  });
  it("rejected", async () => {
    expect(await fails(() => new Response("", { status: 403 }))).toMatch(
      /^a book\.json may not be/,
    );
  });
  it("a server in trouble", async () => {
    expect(await fails(() => new Response("", { status: 503 }))).toMatch(
      /responded 503\); try again/,
    );
  });
  it("unreachable", async () => {
    const fail = (): Response => {
      throw new TypeError("Failed to fetch");
    };
    expect(await fails(fail)).toMatch(
      /^a book\.json could not be reached; .*CORS\).*connect-src\)\.$/,
    );
  });
  it("empty", async () => {
    expect(await fails(() => new Response(""))).toBe("a book.json is empty; get the file again.");
    expect(await fails(() => new Response("", { status: 416 }))).toMatch(/is empty/);
  });
  it("a web page, an archive, an unknown format", async () => {
    expect(await fails(() => new Response("<!doctype html>"))).toMatch(
      /is a web page, not a book; PDF/,
    );
    expect(await fails(() => new Response("PK\x03\x04"))).toMatch(
      /^a book\.json is damaged: it is no ZIP file/,
    );
    const other = zipSync({ "notes.doc": new Uint8Array(9) }) as Uint8Array<ArrayBuffer>;
    expect(await fails(() => new Response(other))).toMatch(
      /has no pages: no file in it, such as notes.doc, is a book or an image that can be shown; open another/,
    );
    expect(await fails(() => new Response("Rar!\x1a\x07\0"))).toMatch(
      /^a book\.json is damaged \(/,
    );
    expect(await fails(() => new Response("\x00\x01"))).toMatch(/is of an unknown format; PDF,/);
  });
  it("JSON that is none", async () => {
    expect(await fails(() => new Response("{oops"))).toMatch(/^a book\.json is no valid JSON; /);
  });
  it("an address that is none", async () => {
    expect(await messageOf(openSource("http://"))).toBe("http:// is no address; correct it.");
    expect(await messageOf(openSource("javascript:alert(1)"))).toMatch(
      /is not an address of the web/,
    );
  });
  it("a page that is no image, without harm to the others", async () => {
    const bad = URL.createObjectURL(new Blob(["no image"]));
    const source = await openSource({ title: "Atlas", pages: [bad, await address(9, 9)] });
    expect(await messageOf(source.draw(0, 9, never))).toMatch(
      /^Page 1 of This book is damaged or no/,
    );
    expect((await source.draw(1, 9, never)).width).toBe(9);
  });
  it("a manifest and an image that never end", async () => {
    const endless = (start: string) => () => {
      const parts = [new TextEncoder().encode(start)];
      const pull = (stream: ReadableStreamDefaultController) =>
        stream.enqueue(parts.shift() ?? new Uint8Array(100_000).fill(32));
      return new Response(new ReadableStream({ pull }));
    };
    expect(await fails(endless('{"pages": ['))).toBe(
      "a book.json is larger than 30 MB; make it smaller and open it again.",
    );
    const { imageBytes } = limits;
    const bounds = limits as { imageBytes: number };
    bounds.imageBytes = 3 << 20;
    try {
      serve(endless("\x89PNG"));
      const source = await openSource(["https://a.example/scans/003.png"]);
      expect(await messageOf(source.draw(0, 9, never))).toBe(
        "Page 1 of This book (003.png) is larger than 3 MB; make it smaller and open it again.",
      );
    } finally {
      bounds.imageBytes = imageBytes;
    }
  });
  it.each(Object.entries(hugeImages))(
    "an image of more pixels than can be shown, by its header alone: %s",
    async (format, bytes) => {
      const decode = vi.spyOn(globalThis, "createImageBitmap");
      const source = await openSource([new File([bytes], `huge.${format}`)]);
      expect(await messageOf(source.draw(0, 9, never))).toMatch(
        /has 50000 x 50000 pixels, more than can be shown; make it smaller\.$/,
      );
      expect(decode).not.toHaveBeenCalled();
    },
  );
  it("a JPEG whose size comes after megabytes of other data, by its header too", async () => {
    const jpeg = hugeImages.jpeg as Uint8Array<ArrayBuffer>;
    const other = new Uint8Array(65_535 + 2);
    other.set([0xff, 0xee, 0xff, 0xff]);
    const parts = [jpeg.slice(0, 20), ...Array.from({ length: 20 }, () => other), jpeg.slice(20)];
    const source = await openSource([new File(parts, "late.jpg")]);
    expect(await messageOf(source.draw(0, 9, never))).toContain("has 50000 x 50000 pixels");
  });
  it("an SVG whose entities multiply, on its page alone", async () => {
    const entities = Array.from({ length: 9 }, (_, k) =>
      k === 0 ? '<!ENTITY e0 "lol">' : `<!ENTITY e${k} "${`&e${k - 1};`.repeat(10)}">`,
    );
    const bomb = `<!DOCTYPE svg [${entities.join("")}]><svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><text>&e8;</text></svg>`;
    const sound = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>';
    const source = await openSource([new File([bomb], "1.svg"), new File([sound], "2.svg")]);
    expect(await messageOf(source.draw(0, 9, never))).toMatch(/^Page 1 of .* is damaged.*\.$/);
    expect((await source.draw(1, 9, never)).width).toBe(9);
  });
  it("a page that is not there", async () => {
    serve(() => new Response("", { status: 404 }));
    const source = await openSource(["https://a.example/scans/003.jpg"]);
    expect(await messageOf(source.draw(0, 9, never))).toBe(
      "Page 1 of This book (003.jpg) was not found; check the address and open it again.",
    );
  });
});

describe("images that browsers show and decode less readily", () => {
  const fixture = async (name: string): Promise<File> => {
    const response = await fetch(new URL(`./fixtures/${name}`, import.meta.url));
    return new File([await response.blob()], name);
  };

  /** Returns a page's picture as pixels. */
  async function pixelsOf(file: File, width: number): Promise<ImageData> {
    const source = await openSource(file);
    const drawn = (await source.draw(0, width, never)) as ImageBitmap;
    const pen = new OffscreenCanvas(drawn.width, drawn.height).getContext("2d")!;
    pen.drawImage(drawn, 0, 0);
    return pen.getImageData(0, 0, drawn.width, drawn.height);
  }

  it("shows a JPEG that breaks off as far as it goes", async () => {
    const { data, width, height } = await pixelsOf(await fixture("i-trunc.jpg"), 400);
    expect([width, height]).not.toContain(0);
    expect(data.some((value, k) => k % 4 < 3 && value < 200)).toBe(true);
  });

  it("shows a PNG upright, as its camera held it", async () => {
    const file = await fixture("i-exif.png");
    const source = await openSource(file);
    await source.draw(0, 100, never);
    expect(await source.size(0)).toEqual({ width: 200, height: 300 });
    const { width, height } = await pixelsOf(file, 100);
    expect([width, height]).toEqual([100, 150]);
  });

  it("shows a BMP as OS/2 wrote it", async () => {
    // Two pixels of 24 bits, one above the other, each row filled to four bytes.
    const header = [
      66, 77, 34, 0, 0, 0, 0, 0, 0, 0, 26, 0, 0, 0, 12, 0, 0, 0, 1, 0, 2, 0, 1, 0, 24, 0,
    ];
    const bytes = new Uint8Array([...header, 0, 0, 255, 0, 255, 0, 0, 0]);
    const source = await openSource(new File([bytes], "a.bmp"));
    expect(await source.size(0)).toEqual({ width: 1, height: 2 });
    const { data } = await pixelsOf(new File([bytes], "a.bmp"), 1);
    expect([...data]).toEqual([0, 0, 255, 255, 255, 0, 0, 255]);
  });

  it("shows a BMP", async () => {
    // Two pixels, blue and red, of 24 bits.
    const bytes = new Uint8Array(62);
    const view = new DataView(bytes.buffer);
    bytes.set([0x42, 0x4d]);
    view.setUint32(2, 62, true);
    view.setUint32(10, 54, true);
    view.setUint32(14, 40, true);
    view.setInt32(18, 2, true);
    view.setInt32(22, 1, true);
    view.setUint16(26, 1, true);
    view.setUint16(28, 24, true);
    bytes.set([255, 0, 0, 0, 0, 255], 54);
    const { data } = await pixelsOf(new File([bytes], "a.bmp"), 2);
    expect([...data]).toEqual([0, 0, 255, 255, 255, 0, 0, 255]);
  });

  it.each([
    ["\xff\x0a", "a JPEG XL"],
    ["\0\0\0\x18ftypheic", "a HEIC"],
  ])("says that %j is %s", async (mark, format) => {
    const bytes = Uint8Array.from(mark.padEnd(64, "\0"), (letter) => letter.charCodeAt(0));
    const source = await openSource(new File([bytes], "a.img"));
    expect(await messageOf(source.draw(0, 10, never))).toBe(
      `Page 1 of a.img is ${format}, which this browser does not show; convert it to PNG or JPEG.`,
    );
  });
});
