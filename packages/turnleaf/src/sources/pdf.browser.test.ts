import { afterEach, describe, expect, it, vi } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { eventually } from "../for_tests/eventually.ts";
import { limits } from "./limits.ts";
import { messageOf } from "./message_of.ts";
import { openSource } from "./open.ts";
import type { PagePicture, PageSource } from "./page_source.ts";
import { PackedDataFactory } from "./pdf_runtime.ts";
import { startingTime } from "./pdf_thread.ts";
import { jpeg2000, type TinyPdf, tinyPdf } from "./tiny_pdf.ts";

const red = "1 0 0 rg 0 0 200 300 re f";
const never = new AbortController().signal;
const opened: PageSource[] = [];

afterEach(() => {
  vi.restoreAllMocks();
  for (const source of opened.splice(0)) source.close();
});

async function open(bytes: Uint8Array<ArrayBuffer>, name = "book.pdf"): Promise<PageSource> {
  const source = await openSource(new File([bytes], name));
  opened.push(source);
  return source;
}

const openTiny = (pdf: TinyPdf): Promise<PageSource> => open(tinyPdf(pdf));

/** Returns the colour at fractions of the picture's width and height, as "r,g,b". */
function colourAt(picture: PagePicture, x: number, y: number): string {
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const context = canvas.getContext("2d")!;
  context.drawImage(picture, 0, 0);
  const at = [Math.floor(x * picture.width), Math.floor(y * picture.height)] as const;
  return [...context.getImageData(...at, 1, 1).data.slice(0, 3)].join(",");
}

describe("a PDF", () => {
  it("says what it is", async () => {
    const source = await openTiny({
      pages: [red, red, red],
      catalog:
        "/Lang (pt_BR) /ViewerPreferences << /Direction /R2L >> /PageLabels << /Nums [0 << /S /r >> 2 << /S /D >>] >>",
      info: "/Title (Of\\000 Whales)",
    });
    expect(source.title).toBe("Of Whales");
    expect(source.language).toBe("pt-BR");
    expect(source.direction).toBe("rtl");
    expect(source.pageCount).toBe(3);
    expect([0, 1, 2].map((index) => source.label(index))).toEqual(["i", "ii", "1"]);
    expect(await source.size(0)).toEqual({ width: 200, height: 300 });
  });

  it("may begin with a comment and its first object, without a header", async () => {
    const bytes = tinyPdf({ pages: [red] });
    // The comment by which programs see that it is no text.
    bytes.set([0x25, 0xe2, 0xe3, 0xcf, 0xd3, 0x0a, 0x0a, 0x0a, 0x0a]);
    const source = await open(bytes);
    expect(source.pageCount).toBe(1);
    expect(colourAt(await source.draw(0, 50, never), 0.5, 0.5)).toBe("255,0,0");
  });

  it("is named by its file and numbered from 1 where it says nothing", async () => {
    const source = await openTiny({ pages: [red] });
    expect(source.title).toBe("book.pdf");
    expect(source.language).toBe("");
    expect(source.direction).toBe("ltr");
    expect(source.label(0)).toBe("1");
  });

  it.each([
    ["a start of 0", "0 << /S /r >> 2 << /S /D /St 0 >>"],
    ["an unknown style", "0 << /S /r >> 2 << /S /X >>"],
    ["a number in place of a dictionary", "0 << /S /r >> 2 5"],
  ])("is numbered from 1 where one of its labels has %s", async (_, labels) => {
    const catalog = `/PageLabels << /Nums [${labels}] >>`;
    const source = await openTiny({ pages: [red, red, red], catalog });
    expect([0, 1, 2].map((index) => source.label(index))).toEqual(["1", "2", "3"]);
  });

  it.each([1, 700, 1019, 1020, 1024])("opens with %d bytes before its mark", async (count) => {
    const before = new Uint8Array(count).fill(0x20);
    const bytes = tinyPdf({ pages: [red, red] });
    const source = await open(new Uint8Array([...before, ...bytes]));
    expect(source.pageCount).toBe(2);
    expect(colourAt(await source.draw(1, 20, never), 0.5, 0.5)).toBe("255,0,0");
  });

  it("is drawn as wide as asked, on white, the head of the page upwards", async () => {
    const source = await openTiny({ pages: ["0 0 1 rg 0 150 200 150 re f"] });
    const picture = await source.draw(0, 400, never);
    expect([picture.width, picture.height]).toEqual([400, 600]);
    expect(colourAt(picture, 0.5, 0.25)).toBe("0,0,255");
    expect(colourAt(picture, 0.5, 0.75)).toBe("255,255,255");
  });

  it("is drawn within bounds whatever is asked and whatever its size", async () => {
    const source = await openTiny({ pages: [red], mediaBox: "[0 0 10 14000]" });
    const picture = await source.draw(0, 1e6, never);
    expect(picture.height).toBeLessThanOrEqual(4096);
    expect(picture.width).toBeGreaterThanOrEqual(1);
  });

  it("draws text in fonts that it does not bring", async () => {
    const source = await openTiny({
      pages: ["BT /F1 300 Tf 0 0 Td (\\156) Tj ET"],
      resources: "/Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /ZapfDingbats >> >>",
    });
    const picture = await source.draw(0, 200, never);
    // The letter n of this font is a black square.
    expect(colourAt(picture, 0.5, 0.7)).toBe("0,0,0");
  });

  it("draws JPEG 2000", async () => {
    const source = await openTiny(jpeg2000);
    expect(colourAt(await source.draw(0, 100, never), 0.5, 0.5)).toBe("200,30,30");
  });

  it("draws the layers that the file shows, and not those that it hides", async () => {
    const source = await openTiny({
      pages: [
        "/OC /Shown BDC 1 0 0 rg 0 0 200 300 re f EMC /OC /Hidden BDC 0 0 1 rg 0 0 200 300 re f EMC",
      ],
      resources: "/Properties << /Shown 10 0 R /Hidden 11 0 R >>",
      objects: ["<< /Type /OCG /Name (Shown) >>", "<< /Type /OCG /Name (Hidden) >>"],
      catalog: "/OCProperties << /OCGs [10 0 R 11 0 R] /D << /OFF [11 0 R] >> >>",
    });
    expect(colourAt(await source.draw(0, 20, never), 0.5, 0.5)).toBe("255,0,0");
  });

  it("with files attached is opened, and a portfolio is rejected by the names in it", async () => {
    const file = (name: string): string =>
      `<< /Type /Filespec /F (${name}) /UF (${name}) /EF << /F 11 0 R >> >>`;
    const names = ["a.pdf", "b\\012.pdf", "c.txt", "d.pdf"];
    const tree = names.map((name, k) => `(${k}) ${file(name)}`).join(" ");
    const pdf = {
      pages: [red],
      catalog: "/Names << /EmbeddedFiles 10 0 R >>",
      objects: [
        `<< /Names [${tree}] >>`,
        "<< /Type /EmbeddedFile /Length 4 >>\nstream\n%PDF\nendstream",
      ],
    };
    expect((await openTiny(pdf)).pageCount).toBe(1);
    const portfolio = openTiny({ ...pdf, catalog: `${pdf.catalog} /Collection << /View /D >>` });
    expect(await messageOf(portfolio)).toBe(
      "book.pdf is a portfolio, which holds a.pdf, b .pdf, c.txt and others; save them by a program that shows portfolios, and open one.",
    );
    // Without files in it its own pages are all that there is.
    const empty = { pages: [red], catalog: "/Collection << /View /D >>" };
    expect((await openTiny(empty)).pageCount).toBe(1);
  });

  it("finds the character maps and decoders that files refer to", async () => {
    const files = new PackedDataFactory();
    const map = await files.fetch({ kind: "cMapUrl", filename: "UniJIS-UTF16-H.bcmap" });
    expect(map.length).toBe(39443);
    const decoder = await files.fetch({ kind: "wasmUrl", filename: "jbig2.wasm" });
    expect([...decoder.subarray(0, 4)]).toEqual([0, 0x61, 0x73, 0x6d]);
    await expect(files.fetch({ kind: "wasmUrl", filename: "../x" })).rejects.toThrow();
  });

  it("stops drawing when aborted, and draws again afterwards", async () => {
    const source = await openTiny({ pages: [red, red] });
    const controller = new AbortController();
    const drawing = source.draw(0, 300, controller.signal);
    controller.abort(new Error("turned on"));
    await expect(drawing).rejects.toThrow("turned on");
    expect((await source.draw(0, 300, never)).width).toBe(300);
  });

  it("draws the same page twice at once", async () => {
    const source = await openTiny({ pages: [red] });
    const pictures = await Promise.all([source.draw(0, 50, never), source.draw(0, 90, never)]);
    expect(pictures.map(({ width }) => width)).toEqual([50, 90]);
  });

  it("rejects once it is closed", async () => {
    const source = await openTiny({ pages: [red] });
    source.close();
    source.close();
    expect(await messageOf(source.draw(0, 50, never))).toBe("book.pdf is closed; open it again.");
  });

  it("draws a page once more where the worker drops the drawing", async () => {
    const source = await openTiny({ pages: [red] });
    const { postMessage } = Worker.prototype;
    let drops = 1;
    vi.spyOn(Worker.prototype, "postMessage").mockImplementation(function (
      this: Worker,
      message: { action?: string; data?: { renderTaskId: string } },
      ...more: unknown[]
    ) {
      const post = (what: unknown): void => Reflect.apply(postMessage, this, [what, ...more]);
      if (message.action === "ExecuteOperatorList" && drops-- > 0) {
        const { renderTaskId } = message.data!;
        post({
          ...message,
          action: "CleanupRenderTask",
          callbackId: undefined,
          data: { renderTaskId },
        });
      }
      post(message);
    });
    expect(colourAt(await source.draw(0, 20, never), 0.5, 0.5)).toBe("255,0,0");
    expect(drops).toBeLessThan(0);
    // What never succeeds ends nevertheless.
    drops = 2;
    expect(await messageOf(source.draw(0, 30, never))).toMatch(
      /^Page 1 of book\.pdf cannot be drawn/,
    );
  });

  it("leaves no worker behind", async () => {
    const started: Worker[] = [];
    const ended = new Set<Worker>();
    const terminate = Worker.prototype.terminate;
    vi.spyOn(Worker.prototype, "terminate").mockImplementation(function (this: Worker) {
      ended.add(this);
      terminate.call(this);
    });
    vi.stubGlobal(
      "Worker",
      class extends Worker {
        constructor(url: string | URL, options?: WorkerOptions) {
          super(url, options);
          started.push(this);
        }
      },
    );
    const source = await openTiny({ pages: [red] });
    await source.draw(0, 20, never);
    source.close();
    // Those of books that were closed before may end meanwhile.
    await eventually(() => started.filter((one) => !ended.has(one))).toEqual([]);
    expect(started.length).toBe(2);
    vi.unstubAllGlobals();
  });

  it("runs no script", async () => {
    const source = await openTiny({
      pages: [red],
      catalog: "/OpenAction << /S /JavaScript /JS (app.alert\\(1\\); globalThis.ran = true) >>",
    });
    await source.draw(0, 20, never);
    expect("ran" in globalThis).toBe(false);
  });
});

describe("a PDF that is protected by a password", () => {
  const bytes = () => Uint8Array.from(atob(protectedPdf), (letter) => letter.charCodeAt(0));

  it("opens with it", async () => {
    const source = await openSource(bytes(), { password: "secret" });
    expect(await source.size(0)).toEqual({ width: 200, height: 300 });
    source.close();
  });

  it("asks until it is given, and says whether one was wrong", async () => {
    const passwords = ["guess", "secret"];
    const asked: boolean[] = [];
    const askPassword = async (isWrong: boolean) => {
      asked.push(isWrong);
      return passwords.shift() ?? null;
    };
    (await openSource(bytes(), { askPassword })).close();
    expect(asked).toEqual([false, true]);
  });

  it("fails in a sentence if none is given, and ends if nobody waits any more", async () => {
    const none = openSource(bytes(), { password: "guess", askPassword: async () => null });
    expect(await messageOf(none)).toContain("is protected by a password");
    const controller = new AbortController();
    const opening = openSource(bytes(), {
      signal: controller.signal,
      askPassword: () => {
        controller.abort(new Error("another book"));
        return new Promise(() => {});
      },
    });
    await expect(opening).rejects.toThrow("another book");
  });
});

describe("an unreadable PDF fails in one sentence", () => {
  it("protected by a password", async () => {
    const bytes = Uint8Array.from(atob(protectedPdf), (letter) => letter.charCodeAt(0));
    expect(await messageOf(open(bytes, "secret.pdf"))).toBe(
      "secret.pdf is protected by a password; remove the password and open it again.",
    );
  });

  it("damaged", async () => {
    const bytes = new TextEncoder().encode("%PDF-1.7\nnothing else");
    expect(await messageOf(open(bytes, "torn.pdf"))).toBe(
      "torn.pdf is damaged or no PDF; repair the file or get it again.",
    );
  });

  it("empty", async () => {
    expect(await messageOf(open(new Uint8Array(), "empty.pdf"))).toBe(
      "empty.pdf is empty; get the file again.",
    );
  });

  it.each([
    ["throws as it is loaded", "throw new TypeError('Promise.try is none')", "Promise.try is none"],
    ["throws at a message", "onmessage = () => { throw new Error('not so') }", "not so"],
    [
      "sends what the page cannot take",
      "import.meta.url.endsWith('#renderer') || postMessage({ sourceName: 'worker', targetName: 'main', action: 'sing' })",
      "Unknown action from worker: sing",
    ],
  ])("with a worker that %s", async (_, script, message) => {
    const opening = openSource(new File([tinyPdf({ pages: [red] })], "book.pdf"), {
      pdfWorker: `data:text/javascript,${encodeURIComponent(script)}`,
    });
    const sentence = await messageOf(opening);
    expect(sentence).toMatch(/^book\.pdf cannot be read \(.*\); update the browser, or get the/);
    expect(sentence).toContain(message);
  });

  it("with more bytes than a PDF may have, whether the server says how many or not", async () => {
    const { pdfBytes } = limits;
    const bounds = limits as { pdfBytes: number };
    bounds.pdfBytes = 2_000_000;
    try {
      const start = tinyPdf({ pages: [red] });
      const file = new File([start, new Uint8Array(2_000_000)], "large.pdf");
      const sentence = " is larger than 2 MB; split it and open a part.";
      expect(await messageOf(openSource(file))).toBe(`large.pdf${sentence}`);
      let isCancelled = false;
      vi.spyOn(globalThis, "fetch").mockImplementation(async () => {
        const parts = [start];
        const body = new ReadableStream({
          pull: (stream) => stream.enqueue(parts.shift() ?? new Uint8Array(100_000)),
          cancel: () => {
            isCancelled = true;
          },
        });
        return new Response(body, { headers: { "Content-Type": "application/pdf" } });
      });
      const endless = openSource("https://book.test/endless.pdf");
      expect(await messageOf(endless)).toBe(`endless.pdf${sentence}`);
      await clock.until(() => isCancelled);
    } finally {
      bounds.pdfBytes = pdfBytes;
    }
  });

  it("with a worker that gives no sign of life", async () => {
    const setTimeout = vi.spyOn(globalThis, "setTimeout");
    const opening = openSource(new File([tinyPdf({ pages: [red] })], "book.pdf"), {
      pdfWorker: "data:text/javascript,",
    });
    const sentence = messageOf(opening);
    const waiting = () => setTimeout.mock.calls.find(([, time]) => time === startingTime);
    await eventually(waiting).toBeDefined();
    (waiting() as [() => void])[0]();
    expect(await sentence).toContain("the browser did not start the script that reads it");
  });

  it.each([
    [
      "at once",
      () => {
        throw new DOMException("Forbidden", "SecurityError");
      },
    ],
    [
      "later",
      (worker: Worker) => void clock.task().then(() => worker.dispatchEvent(new Event("error"))),
    ],
  ])("in a browser that fails to start its worker %s", async (_, fail) => {
    vi.stubGlobal(
      "Worker",
      class extends EventTarget {
        constructor() {
          super();
          fail(this as unknown as Worker);
        }
        postMessage() {}
        terminate() {}
      },
    );
    const sentence = await messageOf(open(tinyPdf({ pages: [red] })));
    vi.unstubAllGlobals();
    expect(sentence).toContain("allow blob: in worker-src of this page's Content-Security-Policy");
  });

  it("and neither is a page that a failing worker was to draw", async () => {
    const workers: Worker[] = [];
    vi.stubGlobal(
      "Worker",
      class extends Worker {
        constructor(url: string | URL, options?: WorkerOptions) {
          super(url, options);
          workers.push(this);
        }
      },
    );
    const source = await openTiny({ pages: [red] });
    vi.unstubAllGlobals();
    workers[0].postMessage = () => {};
    const drawing = messageOf(source.draw(0, 20, never));
    workers[0].dispatchEvent(new ErrorEvent("error", { message: "RangeError: no memory" }));
    expect(await drawing).toBe(
      "Page 1 of book.pdf cannot be drawn (WorkerFailure: RangeError: no memory); update the browser, or get the file again.",
    );
  });

  it("repaired where it can be", async () => {
    const whole = tinyPdf({ pages: [red] });
    const source = await open(whole.slice(0, whole.length - 20));
    expect(colourAt(await source.draw(0, 20, never), 0.5, 0.5)).toBe("255,0,0");
  });
});

/** A page protected by qpdf --encrypt secret owner 256. */
const protectedPdf =
  "JVBERi0xLjcKJb/3ov4KMSAwIG9iago8PCAvRXh0ZW5zaW9ucyA8PCAvQURCRSA8PCAvQmFzZVZlcnNpb24gLzEuNyAvRXh0ZW5zaW9uTGV2ZWwgOCA+PiA+PiAvUGFnZXMgMyAwIFIgL1R5cGUgL0NhdGFsb2cgPj4KZW5kb2JqCjIgMCBvYmoKPDwgPj4KZW5kb2JqCjMgMCBvYmoKPDwgL0NvdW50IDEgL0tpZHMgWyA0IDAgUiBdIC9UeXBlIC9QYWdlcyA+PgplbmRvYmoKNCAwIG9iago8PCAvQ29udGVudHMgNSAwIFIgL01lZGlhQm94IFsgMCAwIDIwMCAzMDAgXSAvUGFyZW50IDMgMCBSIC9SZXNvdXJjZXMgPDwgPj4gL1R5cGUgL1BhZ2UgPj4KZW5kb2JqCjUgMCBvYmoKPDwgL0xlbmd0aCA0OCAvRmlsdGVyIC9GbGF0ZURlY29kZSA+PgpzdHJlYW0KKFv5PCLCJv8uFjT7O6YONKVZjn3taf1Z4mLaGQvYGsE2NdXfOxyeJUNUeLpTDoCyZW5kc3RyZWFtCmVuZG9iago2IDAgb2JqCjw8IC9DRiA8PCAvU3RkQ0YgPDwgL0F1dGhFdmVudCAvRG9jT3BlbiAvQ0ZNIC9BRVNWMyAvTGVuZ3RoIDMyID4+ID4+IC9GaWx0ZXIgL1N0YW5kYXJkIC9MZW5ndGggMjU2IC9PIDw0ZWJkNTA3NzE2YmQxMDZkNTRlNzkyYTNmNmY1ZGFmYTc1YzlmMDY1ZDUxOGRmMWEwNzZmNzA4MTNhZjIwYmNlYWM2MTYwNDUwYzkzZDhhMjdlNzg3ZWYxYWRjN2E4MjQ+IC9PRSA8N2RmN2Y1MmIyNDU0OTBhY2QyNWRlYmJlYjNhY2NjZDQ5OTk2OTQzZDFmNmM4Y2FiZGE3NjljODgyNDI3ZGI4OT4gL1AgLTQgL1Blcm1zIDxlMTNhY2QzZGExN2NlY2QxMDY3ZWNmZjU4NDc2OTQ4ND4gL1IgNiAvU3RtRiAvU3RkQ0YgL1N0ckYgL1N0ZENGIC9VIDwwZDZiMmIwMTFhZGFhNTBkNjVkYmEzOTEyYTY5ZDA4MGQyODNhNThiMmJjOWRhZGNhZGJiNjM2YzM5ZTRmYmUzOWFjNzBhN2FjYjQwNTA3YWE2Y2ZjMDZkZTIwYmFhOTI+IC9VRSA8YTlkODE4YzBmYmEwNWFmZjcwNjg1NzY1YTlmYTQxNzUwMzE3MDAxNjFiYjVjNzMzMTIyMDc1OWQ2ZWQ4NDQwNj4gL1YgNSA+PgplbmRvYmoKeHJlZgowIDcKMDAwMDAwMDAwMCA2NTUzNSBmIAowMDAwMDAwMDE1IDAwMDAwIG4gCjAwMDAwMDAxMzAgMDAwMDAgbiAKMDAwMDAwMDE1MSAwMDAwMCBuIAowMDAwMDAwMjEwIDAwMDAwIG4gCjAwMDAwMDAzMTYgMDAwMDAgbiAKMDAwMDAwMDQzNCAwMDAwMCBuIAp0cmFpbGVyIDw8IC9JbmZvIDIgMCBSIC9Sb290IDEgMCBSIC9TaXplIDcgL0lEIFs8OTVkMDIyMTBiNzc4OTZmNzk2MzBiNTgzM2I0YTBlZjk+PDk1ZDAyMjEwYjc3ODk2Zjc5NjMwYjU4MzNiNGEwZWY5Pl0gL0VuY3J5cHQgNiAwIFIgPj4Kc3RhcnR4cmVmCjk4MQolJUVPRgo=";
